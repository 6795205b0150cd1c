"""How well a finite piece of roughness determines the friction coefficient, and a line that is long enough for it.

A finite piece of a rough surface is a sample. `influence` reads its error off one solved contact, and `response` turns
that into an error of the friction. `lubfric.lines` makes lines of any length, `grid_pair` corrects for their coarse
cells, and `line_friction` combines all of this.
"""
