"""The Stribeck curve between its points, and the choice of speeds from which it is known everywhere."""

from .choose import next_speed
from .interpolate import Interpolant, Samples

__all__ = ["Interpolant", "Samples", "next_speed"]
