"""Long lines of a rough surface, generated or cut from a measured map, from which `lubfric.sampling` takes its samples.

- `contract`: what a source of lines must offer.
- `generated` and `windows`: the two sources; `make` makes one for a scene.
- `cells`: the coarse cells of a line; `pieces`: parts of a line on the scene's own cells.
- `length`: how long a line has to be; `outlook`: a forecast of that.
"""
