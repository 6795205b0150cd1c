"""Height maps: read, prepared, generated, filtered and measured."""

from .generate import ACFS, generate_surface
from .height_map import Surface
from .outliers import outliers
from .prepare import FORMS
from .read import read_surface
from .statistics import correlation_length, rms_slope
from .table import DECIMALS
from .units import UNITS

__all__ = [
    "ACFS",
    "DECIMALS",
    "FORMS",
    "Surface",
    "UNITS",
    "correlation_length",
    "generate_surface",
    "outliers",
    "read_surface",
    "rms_slope",
]
