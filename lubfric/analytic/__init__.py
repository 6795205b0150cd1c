"""Closed forms against which the solvers are checked; no solver of this library takes part in them.

`hertz` dry smooth line and point contact; `westergaard` dry wavy contact; `rigid` lubrication of a rigid cylinder;
`grubin` the piezoviscous-elastic inlet; `film` regime numbers and film formulas.
"""
