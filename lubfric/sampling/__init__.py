"""How sure a friction coefficient is of the roughness it was computed with, and the long line that makes it as sure as
asked.

A finite piece of a rough surface is a sample. `influence` reads its error off one solved contact, `response` carries it
to the friction; `lubfric.lines` makes lines of any length, `grid_pair` corrects their coarse cells and `line_friction`
puts it together.
"""
