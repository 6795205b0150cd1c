"""Names of types that many modules share: what an array holds, and data whose keys decide the type of each value."""

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

# What a function returns that was given to another.
T = TypeVar("T")

FloatArray = npt.NDArray[np.floating]
IntArray = npt.NDArray[np.integer]
ComplexArray = npt.NDArray[np.complexfloating]
BoolArray = npt.NDArray[np.bool]
# One real or complex number, or an array of them. A function of `Numbers` that returns an array returns a NumPy number
# for one number.
Numbers = float | complex | np.ndarray
# A function of coordinates, pressures or other real arrays, value by value.
Law = Callable[[FloatArray], FloatArray]
# Keyword arguments or sections of a scene. `Any`: each key has a type of its own, which the called function checks.
Keywords = dict[str, Any]
# A row of plain values as JSON and CSV hold it. `Any`: each column has a type of its own.
PlainRow = dict[str, Any]
# The value of a keyword argument that is passed on. `Any`: the function that it is passed to states its type.
Option = Any
# What was solved, in plain types, as JSON gives it back. `Any`: its shape is that of what was solved.
PlainValue = Any
# A row of a table. `Any`: each column has a type of its own.
TableRow = Sequence[Any]
