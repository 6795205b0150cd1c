"""Operating points in pairs: a table with the load, the speeds, the radius or any other number of a scene in each row,
as along the path of contact of a gear, over the turn of a cam, or of a duty cycle."""

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .._base import name_and_unit, read_columns, table_headings, validate
from ..errors import InputError
from ..quantities import KEYS, OF_CYCLE, OF_SURFACES, RADII_OF_SURFACES, Quantity
from ..scene import SLIDE_ROLL_RATIO_KEY, SLIP_KEY, Scene, likely_unit, other_convention, reduced_radius, typical
from ..units import UNITS, check_all_have_units, converted, in_si, kind_of, printed, spelled
from .vary import MOST_COMBINATIONS, VARIED_SECTIONS, Axis, check_key

POINT = "point"  # name of the dimension of a table of operating points
U1 = "u1"
U2 = "u2"
SLIDING_COLUMN = "sliding_speed"
DURATION = "duration"
POSITION = "position"
ANGLE = "angle"

# Names of columns in place of the keys of a scene.
COLUMN_NAMES = {
    "speed": "motion.entrainment_speed",
    "entrainment_speed": "motion.entrainment_speed",
    "slide_roll_ratio": "motion.slide_roll_ratio",
    "srr": "motion.slide_roll_ratio",
    "slip_percent": "motion.slip_percent",
    "radius": "bodies.radius",
    "load": "bodies.load",
    "width": "bodies.width",
    "hertz_pressure": "bodies.hertz_pressure",
    "viscosity": "lubricant.viscosity",
}

# Speeds of both surfaces, of which speed and slide-roll ratio follow.
SPEEDS_OF_SURFACES = OF_SURFACES

# Columns that say where a point lies. They change no number; means over a cycle weigh by the duration.
COORDINATES = OF_CYCLE | {"time": Quantity("s", "time")}
# Columns along which points have an order.
ORDERED_BY = (POSITION, ANGLE, "time")

# Columns that are no keys of a scene, by their names.
NAMED_COLUMNS = COORDINATES | SPEEDS_OF_SURFACES | RADII_OF_SURFACES

ENTRAINMENT = "motion.entrainment_speed"
RADIUS = "bodies.radius"
RADII = "bodies.radii"
# What to do with a column of another kind than that of its name, by the SI unit.
OTHER_LOAD = {
    "N/m": "a load per length times the length of the line, bodies.width, is the load; head the column load [N]"
}
BOTH_RADII = "give both R1 and R2, the radii of surface 1 and 2"
TEMPERATURE = "temperature"
CELSIUS_KEY = "lubricant.temperature_celsius"
KELVIN = "lubricant.temperature"


@dataclass(frozen=True, kw_only=True)
class OperatingPoints:
    """A table of operating points: ``axis`` with a row of values [SI] for each point, by the keys of a scene;
    ``speeds`` [m/s] of entrainment; ``coordinates`` (n,) [SI] by name, which change no number, among them R1, R2, u1,
    u2 and sliding_speed as they were given; ``notes``: how columns without a unit were read, in sentences."""

    axis: Axis
    speeds: tuple[float, ...]
    coordinates: dict[str, tuple[float, ...]]
    notes: tuple[str, ...] = ()


def operating_points(scene: Scene, table: Any) -> OperatingPoints:
    """Return the operating points of ``table`` for a ``scene``.

    Parameters
    ----------
    scene : gives what the table does not
    table : a path of a text file with headings, a list of rows (dicts), a dict of columns, or a pandas DataFrame. A
        column is a key of a scene ("bodies.load"), or one of radius, R1, R2, width, load, hertz_pressure, speed, u1,
        u2, sliding_speed, slide_roll_ratio, slip_percent, temperature, viscosity; or position, angle, time, duration,
        which change no number. A unit may be in the heading, "load [kN]", or with a value, "2 kN"; that of a
        temperature has to. A key that takes a name, such as lubricant.grade, has it in its cells

    Raises
    ------
    InputError : a column or a value is none of a scene, or two columns say the same
    """
    columns, notes = _columns(table)
    lengths = {len(values) for values in columns.values()}
    if len(lengths) != 1 or lengths == {0}:
        lengths_in_words = ", ".join(f"{name}: {len(values)}" for name, values in columns.items()) or "no columns"
        raise InputError(f"points: the columns of the table have different lengths, or none ({lengths_in_words})")
    if lengths.pop() > MOST_COMBINATIONS:
        raise InputError("points: too many rows", allowed=f"up to {MOST_COMBINATIONS:.0e}")
    coordinates = {name: tuple(columns.pop(name)) for name in COORDINATES if name in columns}
    if any(value < 0 for value in coordinates.get(DURATION, ())):
        raise InputError("points: duration has a negative value; give durations in s")
    of_surfaces = SPEEDS_OF_SURFACES | RADII_OF_SURFACES
    coordinates |= {name: tuple(columns[name]) for name in of_surfaces if name in columns}
    columns = _with_radius(_with_speeds(columns))
    seen: set[str] = set()
    for key in columns:
        if key != ENTRAINMENT:
            check_key("points", scene, key, seen, VARIED_SECTIONS)
            seen.add(key)
    count = len(next(iter(columns.values()), next(iter(coordinates.values()), ())))
    speeds = columns.pop(ENTRAINMENT, None) or [scene.motion.entrainment_speed] * count
    for row, speed in enumerate(speeds):
        validate.of_key(ENTRAINMENT, speed, f"points, row {row + 1}: speed")
    rows = list(zip(*columns.values())) if columns else [()] * count
    axis = Axis(POINT, tuple(columns), tuple(rows))
    for row in range(count):
        try:
            scene.with_keys(axis.at(row))
        except InputError as error:
            raise InputError(f"points, row {row + 1}: {error}") from None
    return OperatingPoints(axis=axis, speeds=tuple(map(float, speeds)), coordinates=coordinates, notes=notes)


def _columns(table: Any) -> tuple[dict[str, list[Any]], tuple[str, ...]]:
    """Return the columns of ``table`` in SI units, by the keys of a scene or the names of `NAMED_COLUMNS`; and how
    those without a unit were read, in sentences."""
    if isinstance(table, (str, Path)):
        path = validate.folder("points", table)
        headings = table_headings(path, (*COLUMN_NAMES, TEMPERATURE, *NAMED_COLUMNS, *KEYS))
        if any(_is_of_radii(heading) for heading in headings):
            raise InputError(
                "points: a file has one number in a column", recommendation=f"{BOTH_RADII} in place of radii"
            )
        of_headings = [_quantity(*name_and_unit(heading)) for heading in headings]
        units = [quantity.unit for _, quantity in of_headings]
        words = {
            heading: typical(key) if key in KEYS else None
            for heading, (key, _) in zip(headings, of_headings)
            if key not in NAMED_COLUMNS
        }
        columns_of_file = read_columns(path, headings, units, of_other_kind=OTHER_LOAD, words=words)
        given: dict[str, list[Any]] = dict(zip(headings, columns_of_file))
        in_file = True
    else:
        given = _with_both_radii(_as_columns(table))
        in_file = False
    columns: dict[str, list[Any]] = {}
    notes: list[str] = []
    for heading, values in given.items():
        name, unit = name_and_unit(str(heading))
        key, quantity = _quantity(name, unit)
        if key in columns:
            raise InputError(f"points: two columns give {key}; omit one of them")
        if in_file:
            columns[key] = list(values)
        else:
            if not unit:
                plain = [validate.python_value(value) for value in values]
                check_all_have_units(f"points: {heading}", plain, [quantity.unit] * len(plain))
            columns[key] = [_value(heading, key, value, unit, quantity) for value in values]
        if not unit:
            _check_without_unit(name.strip(), key, quantity, values)
            notes += _notes_without_unit(name, key, quantity, values)
    return columns, tuple(notes)


def _check_without_unit(name: str, key: str, quantity: Quantity, values: Any) -> None:
    """Raise `InputError` where a plain number of the column ``name`` is outside the range of machines, and is inside it
    in another unit."""
    judged_as = key
    if key in SPEEDS_OF_SURFACES:
        judged_as = ENTRAINMENT
    elif key in RADII_OF_SURFACES:
        judged_as = RADII
    for value in _plain_numbers(values):
        likely = printed(likely_unit(judged_as, value))
        if likely:
            unit = printed(quantity.unit)
            read_as = f"{value:.4g} {unit}".rstrip()
            raise InputError(
                f": the column {name} has no unit, so {value:.4g} is read as {read_as}, which no machine has",
                "points",
                recommendation=f"write the heading {name} [{likely}]"
                + (f", or {name} [{unit}] for {read_as}" if unit else ""),
            )


def _plain_numbers(values: Any) -> list[float]:
    """Return the numbers other than 0 among the ``values`` of a column."""
    plain = [validate.python_value(value) for value in values]
    return [v for v in plain if isinstance(v, (int, float)) and not isinstance(v, bool) and v != 0]


def _notes_without_unit(name: str, key: str, quantity: Quantity, values: Any) -> Iterator[str]:
    """Yield how the plain numbers of the column ``name`` without a unit were read, where that may be a mistake."""
    numbers = _plain_numbers(values)
    if not numbers:
        return
    if name in (POSITION, ANGLE):
        other = {POSITION: "position [mm]", ANGLE: "angle [deg]"}[name]
        largest = max(numbers, key=abs)
        yield (
            f"the column {name} has no unit: {largest:g} is read as {largest:g} {quantity.unit}; "
            f"head the column {other} for another unit"
        )
    question = other_convention(key, numbers)
    if question:
        yield f"the column {name} has no unit; {question}"


def _as_columns(table: Any) -> dict[str, list[Any]]:
    """Return the columns of rows, of columns or of a DataFrame by their headings."""
    if hasattr(table, "to_dict") and hasattr(table, "columns"):
        table = table.to_dict("list")
    if isinstance(table, Mapping):
        return {str(key): list(validate.listed(values)) for key, values in table.items()}
    if isinstance(table, (list, tuple)) and table and all(isinstance(row, Mapping) for row in table):
        names = list(dict.fromkeys(name for row in table for name in row))
        for number, row in enumerate(table, 1):
            missing = [name for name in names if name not in row]
            if missing:
                raise InputError(
                    f"points, row {number}: {', '.join(map(str, missing))} is missing; give it in each row"
                )
        return {name: [row[name] for row in table] for name in names}
    shown = validate.shown(table)
    raise InputError(f"points = {shown}", allowed="a file, a list of rows, a dict of columns, or a DataFrame")


def _quantity(name: str, unit: str | None) -> tuple[str, Quantity]:
    """Return the key of the column ``name``, or its name in `NAMED_COLUMNS`, and its quantity."""
    plain = name.strip()
    if plain.upper() in RADII_OF_SURFACES:
        plain = plain.upper()
    if plain in NAMED_COLUMNS:
        return plain, NAMED_COLUMNS[plain]
    if plain == TEMPERATURE:
        word = spelled(unit or "")
        if word not in ("K", "°C"):
            raise InputError(
                "points: the column temperature names no unit", allowed="temperature [°C], temperature [K]"
            )
        plain = CELSIUS_KEY if word == "°C" else KELVIN
    key = COLUMN_NAMES.get(plain.lower(), plain)
    if key not in KEYS and "." not in key:
        if re.search(r"\bload\b.*\bper\b|line ?load", plain.lower()):
            raise InputError(
                f": {plain!r} is not a column of operating points", "points", recommendation=OTHER_LOAD["N/m"]
            )
        near = validate.nearest(plain, [*COLUMN_NAMES, TEMPERATURE, *NAMED_COLUMNS])
        known = ", ".join([*COLUMN_NAMES, *RADII_OF_SURFACES, TEMPERATURE, *SPEEDS_OF_SURFACES, *COORDINATES])
        raise InputError(
            f"points: {plain!r} is not a column of operating points{near}", allowed=f"{known}, or section.key"
        )
    return key, KEYS.get(key, Quantity("-", key))


def _value(heading: str, key: str, value: Any, unit: str | None, quantity: Quantity) -> Any:
    """Return one value in the unit of its ``key``; ``unit``: of its heading."""
    value = validate.python_value(value)
    if isinstance(value, str) and key in KEYS and value in typical(key):
        return value
    if isinstance(value, str) and key in {*KEYS, *NAMED_COLUMNS}:
        value, given = in_si(f"points: {heading}", value)
        if given != _row(quantity.unit):
            raise InputError(f"points: {heading} = {value!r} is in {given}", allowed=f"a number in {quantity.unit}")
        return converted(value, given, quantity.unit) if given != quantity.unit else value
    if not unit or isinstance(value, str):
        return value
    word = spelled(unit)
    is_plane = key in RADII_OF_SURFACES and isinstance(value, float) and math.isinf(value)
    number = value if is_plane else validate.number(f"points: {heading}", value, unit)
    try:
        row = kind_of(word)
    except KeyError:
        raise InputError(f"points: the unit of {heading!r} is not known", allowed=quantity.unit) from None
    if row != _row(quantity.unit):
        advice = OTHER_LOAD.get(row, "")
        raise InputError(
            f": {heading!r} is in {row}", "points", allowed=f"a unit of {quantity.unit}", recommendation=advice
        )
    return converted(number, word, quantity.unit)


def _row(unit: str) -> str:
    """Return the SI unit of the row that holds ``unit``; ``unit`` itself where it names several or none."""
    return next((si for si, units in UNITS.items() if unit in units), unit)


def _is_of_radii(heading: str) -> bool:
    """Return whether a column holds the radii of both surfaces, as the key of a scene."""
    return name_and_unit(heading)[0] in (RADII, "radii")


def _with_both_radii(given: dict[str, list[Any]]) -> dict[str, list[Any]]:
    """Return the columns of a table with R1 and R2 in place of pairs of radii."""
    columns: dict[str, list[Any]] = {}
    for heading, values in given.items():
        if not _is_of_radii(heading):
            columns[heading] = values
            continue
        unit = name_and_unit(heading)[1]
        pairs = [validate.python_value(value) for value in values]
        wrong = next((row for row in pairs if not isinstance(row, (list, tuple)) or len(row) != 2), None)
        if wrong is not None:
            shown = validate.shown(wrong)
            raise InputError(f"points: {heading} = {shown}", allowed="a pair of radii in each row, [R1, R2]")
        for place, name in enumerate(RADII_OF_SURFACES):
            name = name if unit is None else f"{name} [{unit}]"
            if name in given:
                raise InputError(f"points: {heading} and {name} both give the radii; omit one of them")
            columns[name] = [pair[place] for pair in pairs]
    return columns


def _with_radius(columns: dict[str, list[Any]]) -> dict[str, list[Any]]:
    """Return the columns with the reduced radius in place of the radii of both surfaces, 1/R = 1/R1 + 1/R2."""
    columns = dict(columns)
    both = [columns.pop(name, None) for name in RADII_OF_SURFACES]
    first, second = both
    if first is None and second is None:
        return columns
    if first is None or second is None:
        raise InputError(f"points: {BOTH_RADII}, or radius, the reduced radius R1 R2/(R1 + R2)")
    if RADIUS in columns:
        raise InputError("points: R1 and R2 give the radius; omit radius")
    columns[RADIUS] = []
    for row, radii in enumerate(zip(first, second), 1):
        try:
            columns[RADIUS].append(reduced_radius(radii))
        except InputError as error:
            raise InputError(f"points, row {row}: {error}") from None
    return columns


def _with_speeds(columns: dict[str, list[Any]]) -> dict[str, list[Any]]:
    """Return the columns with speed and slide-roll ratio in place of the speeds of the surfaces."""
    columns = dict(columns)
    if SLIP_KEY in columns and SLIDE_ROLL_RATIO_KEY in columns:
        raise InputError("points: slip_percent and slide_roll_ratio both give the sliding; omit one of them")
    pair = [columns.pop(name, None) for name in (U1, U2)]
    sliding = columns.pop(SLIDING_COLUMN, None)
    if (pair[0] is None) != (pair[1] is None):
        raise InputError("points: give both u1 and u2, or speed and slide_roll_ratio or slip_percent")
    twice = [key for key in (ENTRAINMENT, SLIDE_ROLL_RATIO_KEY, SLIP_KEY) if key in columns]
    if pair[0] is not None and (twice or sliding is not None):
        raise InputError(
            f"points: u1 and u2 give the speed and the ratio; leave {', '.join(twice) or SLIDING_COLUMN} out"
        )
    if sliding is not None and (SLIDE_ROLL_RATIO_KEY in columns or SLIP_KEY in columns or ENTRAINMENT not in columns):
        raise InputError(
            "points: sliding_speed goes with speed, and takes the place of slide_roll_ratio and slip_percent"
        )
    if SLIP_KEY in columns:
        columns[SLIDE_ROLL_RATIO_KEY] = [in_percent / 100 for in_percent in columns.pop(SLIP_KEY)]
    if pair[0] is not None:
        columns[ENTRAINMENT] = [0.5 * (u1 + u2) for u1, u2 in zip(*pair)]
        sliding = [u2 - u1 for u1, u2 in zip(*pair)]
    if sliding is not None:
        speeds = columns[ENTRAINMENT]
        still = next((row for row, speed in enumerate(speeds, 1) if speed == 0), None)
        if still is not None:
            raise InputError(f"points, row {still}: no entrainment (u1 + u2 = 0)", allowed="a speed other than 0 m/s")
        columns[SLIDE_ROLL_RATIO_KEY] = [difference / speed for difference, speed in zip(sliding, speeds)]
    return columns


# Columns of a study with an interval, and the columns of its ends.
INTERVAL_COLUMNS = {
    "coefficient": ("interval_low", "interval_high"),
    "power_loss": ("power_loss_low", "power_loss_high"),
}


def mean_over_cycle(values: np.ndarray, durations: np.ndarray) -> float:
    """Return the mean of ``values`` (n,) weighted by the ``durations`` (n,); NaN where one that counts is not known."""
    counted = durations > 0
    total = float(durations.sum())
    return float(np.sum(values[counted] * durations[counted])) / total if total > 0 else math.nan
