"""A measured curve of friction with its units: from arrays, or from named columns of a text file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._base import read_columns, validate
from ..errors import InputError

SPEED, SLIP = "speed", "slide_roll_ratio"


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
                raise InputError(f"{name} has {value.size} values for {x.size} of x; give as many")
            object.__setattr__(self, name, value.copy())
        if self.deviation is not None and np.any(self.deviation <= 0):
            raise InputError("deviation holds values that are not positive; give positive ones, or leave it out")
        if self.deviation is None and np.any(self.coefficient <= 0):
            raise InputError(
                "coefficient holds values that are not positive, whose relative deviation means nothing; allowed: > 0, "
                "or give a deviation"
            )
        if np.unique(x).size < x.size:
            raise InputError("x holds a value twice; average repeated measurements")


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
    A unit in the heading, in square or round brackets, is converted (`lubfric._base.tables`).
    """
    if (speed is None) == (slide_roll_ratio is None):
        raise InputError("a measured curve has one axis; give the heading of speed, or that of slide_roll_ratio")
    over, heading = (SLIP, str(slide_roll_ratio)) if speed is None else (SPEED, speed)
    units = ("m/s" if over == SPEED else "-", "-", "-")
    names = (heading, coefficient) if deviation is None else (heading, coefficient, deviation)
    for name in names:
        validate.instance("heading", name, str, "words, as they stand in the file")
    file = validate.folder("path", path)
    columns = [np.array(c) for c in read_columns(file, names, units, must_say=("m/s",))]
    order = np.argsort(columns[0], kind="stable")
    x, f, *spread = (column[order] for column in columns)
    return Measured(x, f, spread[0] if spread else None, over, file.name)
