"""The smooth film: what every film answers (`contract`), its levels from the simplest up, and its shear.

`levels`: isoviscous, piezoviscous, EHL, and the lowest that will do; `rigid`: closed forms between rigid surfaces, with
`rigid_error`, what they leave out; `shear`: the force on the surfaces.
"""
