"""What a table of numbers is: a map of heights, a list of points, or a profile; and rows or columns of coordinates."""

import math
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..units import worded
from .header import LENGTH_UNITS, LENGTHS, Header
from .points import grid_lines

# How a table is told from a list of points: choices, between maps and lists of the programs in docs/inputs.md.
PROFILE_LINES = 8  # lines from which a table of one or two columns is a profile
POINT_LINES = 9  # lines from which a table of three columns may be a list of points (3 x 3)
LONG_LIST = 30  # lines of three columns that cannot be a map
MOST_COLUMNS = 6  # a list of points may have columns beside x, y, z
EVEN_PRINTED = 0.02  # of a step: coordinates are printed to few digits
EVEN_EXACT = 1e-6  # of a step: coordinates with all their digits
SAME_SPACING = 0.02  # relative difference up to which the step of coordinates is the given spacing
FEWEST_COORDINATES = 4  # coordinates along one side; from `SURE_COORDINATES` on they may be rounded
SURE_COORDINATES = 6


@dataclass(frozen=True, kw_only=True)
class Border:
    """Coordinates in the first row (along a line of the file) and in the first column (from line to line), None where
    there are none: their steps in the unit of the file."""

    steps: tuple[float | None, float | None]

    def worded(self) -> str:
        """Return where the coordinates are."""
        along, down = self.steps
        if along is not None and down is not None:
            return "first row and first column are coordinates"
        return f"first {'row is' if down is None else 'column is'} coordinates"


def kind_of_table(name: str, table: np.ndarray) -> str:
    """Return "map", "points" or "profile". Raise `InputError` for a table that looks like none of them."""
    lines, columns = table.shape
    if min(lines, columns) == 1 and max(lines, columns) >= PROFILE_LINES:
        return "profile"
    if lines < columns and lines <= 3 and columns >= LONG_LIST:
        message = f"file {name} has {lines} lines of {columns} numbers, which is not a map"
        if _rises(table[0]):
            message += ": the first line rises like a coordinate"
        raise InputError(
            message, recommendation="give points as three columns x y z, a profile as generate_surface says"
        )
    if columns == 2 and lines >= PROFILE_LINES:
        if _rises(table[:, 0]):
            return "profile"
        if lines >= LONG_LIST:
            raise InputError(
                f"file {name} has {lines} lines of two numbers, which is not a map", allowed="a map of heights"
            )
    if columns >= 3 and columns <= MOST_COLUMNS and lines >= POINT_LINES:
        for first in range(columns - 2):
            if _is_grid(table[:, first], table[:, first + 1]):
                if columns == 3:
                    return "points"
                message = f"file {name} has {columns} columns, of which two are coordinates of a grid"
                raise InputError(message, recommendation="leave only the three columns x y z")
        if columns == 3 and lines >= LONG_LIST:
            if _rises(table[:, 0]):
                return "profile"
            _explain_points(name, table)
    return "map"


def _explain_points(name: str, table: np.ndarray) -> None:
    """Raise `InputError` for three columns that are neither a map nor points on a grid."""
    try:
        for axis, column in zip("xy", range(2)):
            grid_lines(axis, table[:, column])
    except InputError as problem:
        message = f"file {name} has three columns, and they are not points x y z on a grid: {problem.said}"
        raise InputError(message, allowed=problem.allowed) from None
    message = f"file {name} has {len(table)} lines of three numbers, and they are not points x y z on a grid"
    raise InputError(message, allowed="each point of the grid once, with most of them")


def _is_grid(x: np.ndarray, y: np.ndarray) -> bool:
    """Return whether two columns are the coordinates of points on a uniform grid, each given once, most of them
    given."""
    if not (np.isfinite(x).all() and np.isfinite(y).all()):
        return False
    try:
        i, nx, _, _ = grid_lines("x", x)
        j, ny, _, _ = grid_lines("y", y)
    except InputError:
        return False
    if nx < 2 or ny < 2 or nx * ny > 2 * x.size or nx * ny < 0.9 * x.size:
        return False
    return np.unique(i * ny + j).size == x.size


def _rises(values: np.ndarray) -> bool:
    """Return whether values rise or fall all the way, as a coordinate does."""
    steps = np.diff(values)
    return bool(values.size >= FEWEST_COORDINATES and ((steps > 0).all() or (steps < 0).all()))


def _step(values: np.ndarray) -> float | None:
    """Return the step of values that rise or fall evenly, None of others."""
    if values.size < FEWEST_COORDINATES or not np.isfinite(values).all():
        return None
    step = (values[-1] - values[0]) / (values.size - 1)
    limit = EVEN_PRINTED if values.size >= SURE_COORDINATES else EVEN_EXACT
    off = np.abs(values - (values[0] + step * np.arange(values.size))).max()
    return abs(float(step)) if step and off <= limit * abs(step) else None


def border_of(table: np.ndarray) -> tuple[Border | None, np.ndarray]:
    """Return the coordinates around a table of heights, and the heights without them. A plane, whose every row is even,
    has none."""
    if min(table.shape) < FEWEST_COORDINATES:
        return None, table
    along = _step(table[0, 1:])
    down = _step(table[1:, 0])
    if along is not None and _step(table[1, 1:]) is not None:
        along = None
    if down is not None and _step(table[1:, 1]) is not None:
        down = None
    if along is None and down is None:
        return None, table
    if along is not None and down is None and _step(table[0]) is None and math.isfinite(table[0, 0]):
        return None, table  # a row that is even but for its first number
    if down is not None and along is None and _step(table[:, 0]) is None and math.isfinite(table[0, 0]):
        return None, table
    heights = table[1 if along is not None else 0 :, 1 if down is not None else 0 :]
    return Border(steps=(along, down)), heights


def refuse_profile(
    name: str,
    table: np.ndarray,
    header: Header | None,
    units: tuple[str, str, str] | None,
    spacing: tuple[float, float] | None = None,
    named: tuple[tuple[str, str, str], str] | None = None,
) -> None:
    """Raise `InputError` for a profile, with the statistics that make a surface of it. ``units``, ``spacing`` [m]: as
    the user gives them; ``named``: the units that the headings name, and the headings. They must not contradict each
    other."""
    values = table.ravel() if min(table.shape) == 1 else table[:, 1]
    message = f"file {name} contains a profile of {values.size} points, not a map of heights"
    _refuse_other_unit(message, header, units, named)
    units = units if named is None else named[0]
    recommendation = (
        "measure a map; or remove the key file and generate a surface with these statistics: write sq and "
        "correlation_length into [surface], one length for a surface that is alike in all directions, or [along, "
        "across the motion]"
    )
    z = values[np.isfinite(values)]
    if z.size >= PROFILE_LINES:
        place = np.linspace(-1.0, 1.0, z.size)
        z = z - np.polyval(np.polyfit(place, z, 1), place)
        unit = ""
        stated = None if header is None else header.stated.get("z unit")
        if stated is not None:
            unit = stated.unit or ""
        elif units is not None:
            unit = units[2]
        scale = LENGTHS.get(unit) or LENGTH_UNITS.get(unit)
        sq = float(z.std())
        message += f" (Sq {sq:.4g} {unit or 'in the unit of the file'} about its mean line"
        if scale is not None:
            message = f"{message[: message.rindex('(')]}(Sq {worded(sq * scale, 'm')} about its mean line"
        length = _correlation_steps(z)
        if length is not None:
            message += (
                f", correlation length {_length_in_words(length, table, units, spacing, is_named=named is not None)}"
            )
        message += ")"
    raise InputError(message, recommendation=recommendation)


def _refuse_other_unit(
    message: str,
    header: Header | None,
    units: tuple[str, str, str] | None,
    named: tuple[tuple[str, str, str], str] | None,
) -> None:
    """Raise `InputError`, with a ``message`` before it, where the unit of the heights that the user gives is not that
    which the file names."""
    if units is None:
        return
    in_file = None if named is None else (named[0][2], repr(named[1][:60]))
    stated = None if header is None else header.stated.get("z unit")
    if stated is not None and stated.unit is not None:
        in_file = (stated.unit, stated.worded())
    if in_file is not None and LENGTHS[in_file[0]] != LENGTH_UNITS[units[2]]:
        raise InputError(
            f"{message}; unit = {units[2]!r} is given, and the file says {in_file[0]}: {in_file[1]}",
            recommendation="measure a map; for the statistics of this profile omit unit, or correct the heading",
        )


def _length_in_words(
    length: float,
    table: np.ndarray,
    units: tuple[str, str, str] | None,
    spacing: tuple[float, float] | None,
    *,
    is_named: bool,
) -> str:
    """Return a ``length`` of so many steps of a profile as text, in m where ``units`` or ``spacing`` say it; and that
    both contradict each other, where they do. ``is_named``: whether the file names the ``units``."""
    given = None if spacing is None else spacing[0]
    if min(table.shape) == 1:
        return f"{length:.3g} steps" if given is None else worded(length * given, "m")
    x = table[:, 0]
    step = abs(float(x[-1] - x[0])) / (x.size - 1)
    scale = None if units is None else LENGTHS.get(units[0]) or LENGTH_UNITS.get(units[0])
    if given is None:
        in_file = f"{length * step:.4g} in the unit of its first column"
        return (
            in_file
            if scale is None
            else f"{worded(length * step * scale, 'm')} with its first column in {units and units[0]}"
        )
    possible = [units[0]] if is_named and units is not None else [*LENGTHS]
    fitting = [unit for unit in possible if abs(step * LENGTHS[unit] / given - 1) < SAME_SPACING]
    if fitting:
        return f"{worded(length * given, 'm')} with its first column in {fitting[0]}, as spacing says"
    if is_named and scale is not None:
        return (
            f"{worded(length * step * scale, 'm')} with its first column in {possible[0]}, of which the steps, "
            f"{worded(step * scale, 'm')}, contradict spacing = {given:.4g} m"
        )
    return (
        f"{worded(length * given, 'm')} by spacing = {given:.4g} m, which the steps of its first column, {step:.4g}, "
        "contradict in every unit"
    )


def _correlation_steps(z: np.ndarray) -> float | None:
    """Return the first lag, in steps, at which the autocorrelation of a levelled profile falls to 1/e."""
    from scipy.signal import correlate

    n = z.size
    acf = correlate(z, z, mode="full", method="fft")[n - 1 : n - 1 + n // 2] / (n - np.arange(n // 2))
    if acf.size < 2 or acf[0] <= 0:
        return None
    acf = acf / acf[0]
    below = np.flatnonzero(acf <= math.exp(-1))
    if below.size == 0:
        return None
    k = int(below[0])
    return float(k - 1 + (acf[k - 1] - math.exp(-1)) / (acf[k - 1] - acf[k]))
