"""Rough surfaces: `Surface`, made by `generate_surface` or `read_surface`, measured by `statistics`."""

from .generate import generate_surface
from .height_map import Surface
from .read import read_instrument_file, read_surface
from .statistics import autocorrelation, correlation_length, rms_slope

__all__ = [
    "Surface",
    "autocorrelation",
    "correlation_length",
    "generate_surface",
    "read_instrument_file",
    "read_surface",
    "rms_slope",
]
