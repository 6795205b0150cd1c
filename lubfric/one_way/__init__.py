"""Load sharing one way: a film in the gap of the dry contact."""

from .output import one_way_arrays, plot_one_way
from .point import OneWay
from .refine import one_way_point

__all__ = ["OneWay", "one_way_arrays", "one_way_point", "plot_one_way"]
