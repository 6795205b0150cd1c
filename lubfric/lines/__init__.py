"""Long lines of a rough surface, generated or of a measured map: where `lubfric.sampling` takes its samples from.

`contract`: what a source of lines answers; `generated` and `windows`: the two sources, made for a scene by `make`;
`cells`: their coarse cells, `pieces`: parts of them on the scene's own; `length`: how long a line has to be, `outlook`:
foretold.
"""
