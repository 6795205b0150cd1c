"""Axes, units and coordinates that an array of heights brings along, as an `xarray.DataArray` does, against what a map
is: x before y, metres, ascending and even steps."""

from typing import Any

import numpy as np

from ..errors import InputError
from ..units import in_si

# Relative difference of a step of the coordinates and the spacing from which they contradict each other [-]:
# coordinates are often kept to six digits. A choice: a smaller value refuses rounded coordinates.
LABEL_TOLERANCE = 1e-3

METRES = ("", "m", "metre", "metres", "meter", "meters")


def check_labels(heights: Any, spacing: tuple[float, float]) -> None:
    """Raise `InputError` where the labels of ``heights`` contradict a map in metres with this ``spacing`` [m]; an array
    without labels has none that could."""
    axes = getattr(heights, "dims", None)
    if not isinstance(axes, tuple) or len(axes) != 2 or not hasattr(heights, "coords"):
        return
    if axes == ("y", "x"):
        raise InputError("heights has the axes ('y', 'x')", recommendation="give heights.transpose('x', 'y')")
    unit = _unit_of(heights)
    if unit not in METRES:
        raise InputError(
            f"heights is in {unit!r} (attrs['units'])", recommendation="convert it to metres, and set the unit to 'm'"
        )
    for axis, step in zip(axes, spacing):
        if axis in heights.coords:
            _check_coordinate(heights.coords[axis], axis, step)


def _check_coordinate(coordinate: Any, axis: Any, step: float) -> None:
    """Raise `InputError` where a ``coordinate`` of floating point is not one of even steps of ``step`` [m]; whole
    numbers count points."""
    values = np.asarray(coordinate)
    if values.dtype.kind != "f" or values.ndim != 1 or values.size < 2:
        return
    unit = _unit_of(coordinate)
    metre = 1.0 if unit in METRES else in_si(f"coordinate {axis!r} of heights", f"1 {unit}")[0]
    steps = metre * np.diff(values)
    if (steps < 0).all():
        raise InputError(
            f"heights has descending coordinates {axis!r}", recommendation=f"give heights.sortby({axis!r})"
        )
    if not (np.abs(steps - step) <= LABEL_TOLERANCE * step).all():
        least = steps.min()
        largest = steps.max()
        message = (
            f"heights has coordinates {axis!r} with steps of {least:.4g} to {largest:.4g} m, and spacing = {step:.4g} m"
        )
        raise InputError(
            message, recommendation="give the spacing of the coordinates, or heights without them (heights.values)"
        )


def _unit_of(labelled: Any) -> str:
    """Return the unit in the attributes of a labelled array; "" where it has none."""
    attributes = getattr(labelled, "attrs", {})
    return str(attributes.get("units", attributes.get("unit", ""))).strip()
