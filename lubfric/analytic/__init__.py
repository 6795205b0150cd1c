"""Closed forms that no solver of this library takes part in: what the solvers are checked against.

`hertz` dry smooth line and point contact; `westergaard` dry wavy contact; `rigid` lubrication of a
rigid cylinder; `grubin` the piezoviscous-elastic inlet; `film` regime numbers and film formulas.
"""
