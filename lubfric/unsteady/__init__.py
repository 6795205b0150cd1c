"""Friction of contacts whose speed, load, radius or viscosity change in time: `lubfric.transient`.

What changes: `lubfric.history`; the scene of a moment: `at_a_time`. The run: `setup`, `start` (the state at t = 0),
`sharing` (what is marched), `run` (the march), `checkpoint` (what an interrupted run goes on from). What it gives:
`moment` and `film_shear` (the numbers of one moment), `result`; `command` and `plot` behind ``lubfric run``.
"""
