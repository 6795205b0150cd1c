"""The answer at one speed: the sample of the surface, the models, the interval of f."""

from .cite import together
from .estimate import of_line
from .friction import friction
from .grid_pair import mean_of
from .line_friction import LineFound, line_friction
from .moment_error import moment_error
from .patch_error import correlation_along_y
from .result import FrictionResult
from .sample import lines_of_model
from .uncertainty import FIELDS, Uncertainty, UncertaintyCurve, curve_of, percent, student

__all__ = [
    "FIELDS",
    "FrictionResult",
    "LineFound",
    "Uncertainty",
    "UncertaintyCurve",
    "correlation_along_y",
    "curve_of",
    "friction",
    "line_friction",
    "lines_of_model",
    "mean_of",
    "moment_error",
    "of_line",
    "percent",
    "student",
    "together",
]
