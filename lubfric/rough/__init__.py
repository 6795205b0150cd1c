"""The rough contact under a film: what every contact offers (`contract`), and the contacts that exist.

- `half_space`: every point of the surface, under a cylinder; `half_space_grid` makes its coarser and shorter grids.
- `flat`: nominally flat, read from a curve: the `contact_curve` of the half-space, or the `asperity_curve`.
- `asperities`: independent asperities under a cylinder.

`make` chooses the one that a scene asks for, with the heights from `height_map`.
"""
