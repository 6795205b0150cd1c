"""Quantities that change in time.

`kinds`: `Constant`, `Ramp`, `Harmonic`, `Table`, all of them a `History`; `read`: one of them from a number, a scene
file or a CSV file; `plan`: `lubfric.Transient`, which of a scene's quantities change and for how long.
"""

from .kinds import Constant, Harmonic, History, Ramp, Table

__all__ = ["Constant", "Harmonic", "History", "Ramp", "Table"]
