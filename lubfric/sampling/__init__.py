"""How well the roughness that was computed determines a friction coefficient, and the long line that determines it as
well as asked.

A finite piece of a rough surface is a sample. `influence` reads its error off one solved contact, and `response`
carries it to the friction. `lubfric.lines` makes lines of any length, `grid_pair` corrects their coarse cells, and
`line_friction` puts it together.
"""
