"""The smooth film: what every film offers (`contract`), its levels from the simplest up, and its shear.

`levels`: isoviscous, piezoviscous, EHL, and the choice of the lowest that is enough; `rigid`: closed forms between
rigid surfaces, and `rigid_error`, what they leave out; `shear`: the force on the surfaces.
"""
