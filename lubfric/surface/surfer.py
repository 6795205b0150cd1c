"""Height maps as Surfer writes them to text (.grd, DSAA): five lines of header, then rows of constant y from the
lowest."""

from pathlib import Path

import numpy as np

from .._base import FloatArray
from ..errors import InputError
from .header import LENGTH_UNITS

SURFER_FIRST_WORD = "DSAA"
BINARY = (b"DSBB", b"DSRB")  # the first bytes of the other formats with the same suffix

# A height from which on a point is blank (Surfer writes 1.70141e+38). By definition of the format.
BLANK = 1.7e38

# Relative difference up to which the lowest and the highest height agree with those of the header, which are printed. A
# choice: they have four digits or more.
SAME_HEIGHT = 1e-3

# Numbers of the header: the points along x and y, then the lowest and highest x, y and height. By definition of the
# format.
HEADER = 8


def read_surfer(
    path: Path, text: str, units: tuple[str, str, str] | None
) -> tuple[FloatArray, tuple[float, float], tuple[str, ...]]:
    """Return the heights[ix, iy] [m] of a file, NaN where blank, its spacing [m], and notes. ``units``: as the caller
    gives them, because the file does not state them.

    Raises `InputError` for a file that is cut off or contradicts itself, and without ``units``.
    """
    name = f"path = {str(path)!r}"
    if units is None:
        message = f"{name} is a grid of Surfer, which does not state the units of x, y and the heights"
        raise InputError(message, recommendation="give unit, such as 'um', or (unit of x and y, unit of the heights)")
    words = text.split()[1:]
    try:
        numbers = np.array(words, float)
        nx, ny = (int(word) for word in words[:2])
    except ValueError:
        raise InputError(f"{name} begins as a grid of Surfer and has words among its numbers") from None
    if nx < 2 or ny < 2 or numbers.size != HEADER + nx * ny or not np.isfinite(numbers).all():
        message = f"{name} has {max(numbers.size - HEADER, 0)} heights, and its header states {nx} x {ny}"
        raise InputError(message, recommendation="give the whole file")
    x_low, x_high, y_low, y_high, lowest, highest = numbers[2:HEADER]
    if not (x_low < x_high and y_low < y_high):
        raise InputError(f"{name} states x from {x_low:g} to {x_high:g} and y from {y_low:g} to {y_high:g}")
    values = np.where(numbers[HEADER:] >= BLANK, np.nan, numbers[HEADER:])
    if not np.isfinite(values).any():
        raise InputError(f"{name} has no point that is not blank")
    ends = np.array([np.nanmin(values), np.nanmax(values)])
    if np.abs(ends - (lowest, highest)).max() > SAME_HEIGHT * max(ends[1] - ends[0], np.abs(ends).max()):
        message = f"{name} states heights from {lowest:g} to {highest:g} and has {ends[0]:g} to {ends[1]:g}"
        raise InputError(message, recommendation="export it again")
    steps = (LENGTH_UNITS[units[0]] * (x_high - x_low) / (nx - 1), LENGTH_UNITS[units[1]] * (y_high - y_low) / (ny - 1))
    notes = (f"grid of Surfer, x, y and heights in {', '.join(units)} as given", "x runs along the lines of the file")
    return LENGTH_UNITS[units[2]] * values.reshape(ny, nx).T, steps, notes
