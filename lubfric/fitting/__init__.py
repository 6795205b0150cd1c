"""Parameters of a scene from a measured Stribeck or traction curve."""

from .fit import fit
from .measured import Measured, read_measured
from .outlook import explain_fit
from .result import FitResult

__all__ = ["FitResult", "Measured", "explain_fit", "fit", "read_measured"]
