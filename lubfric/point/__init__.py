"""One operating point: film and rough contact share a load (docs/levels.md, docs/architecture.md).

`operating_point`: film, contact and their meeting at one division of the load; `balance`: the division that holds, by
one root (`total_pressure`: with the film deflected by the contact too); `forces`: what resists the sliding, and how
much of a film's error reaches it. `adapt`: the loop that models no more than the tolerance needs, with `tolerances`,
what a balance shows to be needed, and `grids`, the contact on finer grids. `decision`, `judge`: what a reader is
told; `outlook`: the same foretold without a solve.
"""
