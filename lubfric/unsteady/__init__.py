"""Friction of contacts whose speed, load, radius or viscosity change in time: `lubfric.transient`.

- What changes: `lubfric.history`; the scene of a moment: `at_a_time`.
- The run: `setup`, `start` (the state at t = 0), `sharing` (one implicit step), `run` (the loop over time),
  `checkpoint` (from which an interrupted run continues).
- The result: `moment` and `film_shear` (the numbers of one moment), `result`; `command` and `plot` for ``lubfric run``.
"""
