"""A measured curve of friction with its units: from arrays, or from named columns of a text file."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import validate
from ..errors import InputError

SPEED, SLIP = "speed", "slide_roll_ratio"
UNITS = {
    SPEED: {"m/s": 1.0, "mm/s": 1e-3, "cm/s": 1e-2, "km/h": 1 / 3.6},
    SLIP: {"-": 1.0, "%": 0.01},
    "coefficient": {"-": 1.0, "%": 0.01},
}


@dataclass(frozen=True, eq=False)
class Measured:
    """Measured friction coefficients.

    Attributes
    ----------
    x : entrainment speeds [m/s] or slide-roll ratios [-], (n,)
    coefficient : friction coefficients [-], (n,)
    deviation : standard deviation of each coefficient, (n,); None: the same share of each, not known
    over : "speed" (a Stribeck curve) or "slide_roll_ratio" (a traction curve, at the speed of the scene)
    """

    x: np.ndarray
    coefficient: np.ndarray
    deviation: np.ndarray | None = None
    over: str = SPEED
    source: str = "measured"

    def __post_init__(self):
        validate.choice("over", self.over, (SPEED, SLIP))
        x = validate.array("x", self.x, "m/s" if self.over == SPEED else "-", ndim=1)
        values = {"x": x, "coefficient": validate.array("coefficient", self.coefficient, "-", ndim=1)}
        if self.deviation is not None:
            values["deviation"] = validate.array("deviation", self.deviation, "-", ndim=1)
        for name, value in values.items():
            if value.size != x.size:
                raise InputError(f"{name} has {value.size} values for {x.size} of x; allowed: as many")
            object.__setattr__(self, name, value)
        if self.deviation is not None and np.any(self.deviation <= 0):
            raise InputError("deviation holds values that are not positive; allowed: > 0, or leave it out")
        if self.deviation is None and np.any(self.coefficient <= 0):
            raise InputError(
                "coefficient holds values that are not positive, whose relative deviation means nothing; "
                "allowed: > 0, or "
                "give a deviation"
            )
        if np.unique(x).size < x.size:
            raise InputError("x holds a value twice; allowed: each once (average repeated measurements)")


def read_measured(
    path,
    *,
    coefficient: str,
    speed: str | None = None,
    slide_roll_ratio: str | None = None,
    deviation: str | None = None,
) -> Measured:
    """Read a measured curve from a text file with a heading; commas, semicolons or tabs separate its columns.

    Nothing is guessed: you name the columns.

    Parameters
    ----------
    path : file
    coefficient : heading of the friction coefficients, as it stands in the file
    speed, slide_roll_ratio : heading of the speeds, or of the slide-roll ratios (one of the two)
    deviation : heading of the standard deviations; None: not known

    Returns
    -------
    Measured

    Raises
    ------
    InputError : a file or a column is missing, or a heading of speeds has no unit

    Notes
    -----
    A unit in the heading, in square or round brackets, is converted: m/s, mm/s, cm/s, km/h; -, %.
    """
    if (speed is None) == (slide_roll_ratio is None):
        raise InputError("a measured curve has one axis; allowed: the heading of speed, or that of slide_roll_ratio")
    over, heading = (SLIP, str(slide_roll_ratio)) if speed is None else (SPEED, speed)
    table = _table(Path(path))
    columns = [_column(table, heading, over, path), _column(table, coefficient, "coefficient", path)]
    if deviation is not None:
        columns.append(_column(table, deviation, "coefficient", path))
    order = np.argsort(columns[0], kind="stable")
    x, f, *spread = (column[order] for column in columns)
    return Measured(x, f, spread[0] if spread else None, over, Path(path).name)


def _table(path: Path) -> dict[str, list[str]]:
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"measured file {str(path)!r} cannot be read: {error}") from None
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    if len(lines) < 2:
        raise InputError(f"measured file {str(path)!r} has no heading and rows; allowed: a table with both")
    mark = max(";\t,", key=lines[0].count)
    rows = list(csv.reader(lines, delimiter=mark))
    names = [name.strip() for name in rows[0]]
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(names):
            raise InputError(f"{path.name}, row {number}: {len(row)} values for {len(names)} headings")
    columns = {name: [row[i].strip() for row in rows[1:]] for i, name in enumerate(names)}
    return {name: [v.replace(",", ".") for v in values] if mark != "," else values for name, values in columns.items()}


def _column(table: dict, heading: str, quantity: str, path) -> np.ndarray:
    if heading not in table:
        known = ", ".join(map(repr, table))
        raise InputError(f"{path} has no column {heading!r}{validate.nearest(heading, table)}; allowed: {known}")
    found = re.search(r"[\[(]\s*([^\])]*?)\s*[\])]\s*$", heading)
    units = UNITS[quantity]
    if found is None and quantity == SPEED:
        raise InputError(
            f"column {heading!r} of {path} names no unit; allowed: {heading} [unit], of {', '.join(units)}"
        )
    unit = found.group(1) if found else "-"
    validate.choice(f"unit of column {heading!r}", unit or "-", tuple(units))
    try:
        return np.array(table[heading], dtype=float) * units[unit or "-"]
    except ValueError as error:
        raise InputError(f"column {heading!r} of {path} holds no numbers: {error}") from None
