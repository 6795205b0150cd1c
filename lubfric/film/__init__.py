"""The smooth film: what every film answers (`contract`), its levels from the simplest up, and its shear.

`rigid`: closed forms between rigid surfaces, with `rigid_error`, what they leave out; `numerical`: `lubfric.solve_ehl`;
`ladder`: the levels in order, and the lowest that will do; `shear`: the force on the surfaces.
"""
