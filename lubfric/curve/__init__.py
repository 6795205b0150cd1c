"""The Stribeck curve between its points, and the speeds at which it must be solved to be known everywhere."""

from .choose import next_speed
from .interpolate import Interpolant, Samples

__all__ = ["Interpolant", "Samples", "next_speed"]
