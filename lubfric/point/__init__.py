"""One operating point: film and rough contact share a load (docs/levels.md, docs/architecture.md).

- `operating_point`: film and contact at one division of the load. `balance`: the root that finds the division
  (`total_pressure`: where the contact deflects the film too). `forces`: friction, and its sensitivity to the film.
- `adapt`: the loop that models no more than the tolerance needs. `tolerances`: what a balance shows to be needed.
  `grids`: the contact on finer grids.
- `decision`, `judge`: what the reader of a result is told. `outlook`: a forecast of it without a solve.
"""
