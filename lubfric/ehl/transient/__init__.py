"""The film in time: `solve_transient_ehl`, and the steps of which load sharing in time is made.

`fixed_grid` is the grid, `squeeze` has the equations of one implicit step, `tail` is the film beyond the grid, and
`active_set` solves a step. `setting` is one contact with its histories, units, grid and first state, which
`lubfric.march` takes through time. `solve` is the whole run.
"""

from .solve import solve_transient_ehl

__all__ = ["solve_transient_ehl"]
