"""The film in time: `solve_transient_ehl`, and the steps that load sharing in time is made of.

`fixed_grid`, `squeeze` (the equations of one implicit step), `tail` (the film beyond the grid), `active_set` (a step
solved). `setting`: one contact with its histories, units, grid and first state, which `lubfric.march` marches; `solve`:
the run.
"""

from .solve import solve_transient_ehl

__all__ = ["solve_transient_ehl"]
