"""What an array holds, for types: numbers, integers, complex numbers, or yes and no."""

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.floating]
IntArray = npt.NDArray[np.integer]
ComplexArray = npt.NDArray[np.complexfloating]
BoolArray = npt.NDArray[np.bool]
