"""The rough contact under a film: what every one answers (`contract`), and those there are.

`half_space`: every point of the surface, under a cylinder, on coarser and shorter grids by `grid`; `flat`: nominally
flat, read from a curve, `contact_curve` of the half-space or `asperity_curve`; `asperities`: independent asperities
under a cylinder. `make` takes the one that a scene asks for, on the heights of `height_map`.
"""
