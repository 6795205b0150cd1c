"""What a fit is given: a measured curve of friction with its units, and the numbers of a scene that are sought."""

import re
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base import figures, read_columns, validate, with_default_errors
from ..errors import InputError
from ..quantities import worded_value
from ..scene import Scene, refuse_far_value
from ..units import check_all_have_units
from .points import SPEED
from .vary import FITTED, Between, check_key, check_temperature, check_viscosity, unit_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SLIDE_ROLL_RATIO_COLUMN = "slide_roll_ratio"
MARKS = "D^vos"  # of the ramps in a picture
OTHER_AXIS = {  # what a column of another kind may be, by its unit
    "-": "a slide-roll ratio goes into slide_roll_ratio (--ratio)",
    "m/s": "a speed goes into speed (--speed)",
}

# Limits by choice.
SHORTEST_RAMP = 2  # points of a ramp
LARGEST_MEASURED = 2.0  # coefficient: clean metals in vacuum have more, no lubricated contact has
LOGARITHMIC = 10.0  # ratio of positive bounds from which a parameter is sought in its logarithm


@dataclass(frozen=True, eq=False)
class Measured:
    """Measured friction coefficients.

    Attributes
    ----------
    x : entrainment speeds [m/s] or slide-roll ratios [-], (n,)
    coefficient : friction coefficients [-], (n,)
    deviation : standard deviation of each coefficient, (n,); None: the same share of each, not known
    legend : what a picture calls the points; "": `source`
    over : "speed" (a Stribeck curve) or "slide_roll_ratio" (a traction curve, at the speed of the scene)
    branch : number of the ramp to which each point belongs, (n,), 0, 1, ...: rising and falling speeds measured one
        after the other. None: one ramp. Points of different ramps may be at one speed
    rolling : whether the coefficients hold the rolling part of the friction of the film, as the force on one body does.
        False: it is excluded, as by rigs that average over both signs of slip
    """

    x: np.ndarray
    coefficient: np.ndarray
    deviation: np.ndarray | None = None
    _: KW_ONLY
    over: str = SPEED
    source: str = "measured"
    legend: str = ""
    rolling: bool = True
    branch: np.ndarray | None = None

    def __post_init__(self) -> None:
        validate.choice("over", self.over, (SPEED, SLIDE_ROLL_RATIO_COLUMN))
        validate.instance("rolling", self.rolling, bool, "True, or False if rolling is taken out of the coefficients")
        x = validate.array("x", self.x, "m/s" if self.over == SPEED else "-", ndim=1)
        object.__setattr__(self, "x", x.copy())
        for name in ("coefficient", "deviation") if self.deviation is not None else ("coefficient",):
            value = validate.array(name, getattr(self, name), "-", ndim=1)
            if value.size != x.size:
                raise InputError(f"{name} has {value.size} values for {x.size} of x; give as many")
            object.__setattr__(self, name, value.copy())
        if self.deviation is not None and np.any(self.deviation <= 0):
            place = int(np.argmax(self.deviation <= 0))
            raise InputError(f" = {self.deviation[place]:g}", f"deviation[{place}]", "> 0, or no deviation")
        wrong = np.abs(self.coefficient) > LARGEST_MEASURED
        if self.deviation is None:
            wrong |= self.coefficient <= 0
        if wrong.any():
            place = int(np.argmax(wrong))
            value = self.coefficient[place]
            ways = "give the deviation of each point, without which it is relative to the coefficient"
            if value > LARGEST_MEASURED:
                ways = "give the friction force over the load, and percent as such: 'mu [%]'"
            allowed = (
                f"above 0, up to {LARGEST_MEASURED:g}" if self.deviation is None else f"up to {LARGEST_MEASURED:g}"
            )
            raise InputError(f" = {value:g}", f"coefficient[{place}]", allowed, ways)
        if self.branch is not None:
            branch = np.array(self.branch)
            if branch.shape != x.shape or branch.dtype.kind not in "iu":
                raise InputError(f" has {branch.size} values", "branch", f"{x.size} whole numbers, one for each of x")
            object.__setattr__(self, "branch", branch.copy())
        for number in self.branches:
            x = self.x if self.branch is None else self.x[self.branch == number]
            if np.unique(x).size < x.size:
                raise InputError("x has a value twice; average repeated measurements")

    @property
    def branches(self) -> tuple[int, ...]:
        """The numbers of the ramps."""
        return (0,) if self.branch is None else tuple(np.unique(self.branch).tolist())

    def of_branch(self, number: int) -> "Measured":
        """Return the points of one ramp."""
        validate.choice("branch", number, self.branches)
        if self.branch is None:
            return self
        there = self.branch == number
        deviation = None if self.deviation is None else self.deviation[there]
        parts = {"coefficient": self.coefficient[there], "deviation": deviation, "branch": None}
        return replace(self, x=self.x[there], source=f"{self.source}, ramp {number + 1}", **parts)

    @property
    def hysteresis(self) -> float:
        """Root mean square relative difference [-] of the ramps from the first, where they overlap; 0 for one ramp."""
        if len(self.branches) < 2:
            return 0.0
        first = self.of_branch(self.branches[0])
        parts = [self.of_branch(number) for number in self.branches[1:]]
        differences = []
        for part in parts:
            there = (part.x >= first.x.min()) & (part.x <= first.x.max())
            order = np.argsort(first.x)
            level = np.interp(part.x[there], first.x[order], first.coefficient[order])
            differences.append(part.coefficient[there] / level - 1.0)
        relative = np.concatenate(differences)
        return float(np.sqrt(np.mean(relative**2))) if relative.size else 0.0

    @property
    def scale(self) -> np.ndarray:
        """The scale of misfits: the deviations, or the coefficients themselves, (n,)."""
        return self.coefficient if self.deviation is None else self.deviation

    def draw(self, axes: "Axes", *, is_signed: bool = False) -> None:
        """Draw the points on ``axes``, with their 95 % intervals, over the magnitude of what they are over, or over
        that itself (``is_signed``)."""
        error = None if self.deviation is None else 1.96 * self.deviation
        for place, number in enumerate(self.branches):
            there = slice(None) if self.branch is None else self.branch == number
            ramp = f", ramp {number + 1}" if len(self.branches) > 1 else ""
            style: dict[str, Any] = {"fmt": MARKS[place % len(MARKS)], "ms": 4, "color": "k", "mfc": "none", "lw": 1}
            bars = "" if error is None else " (bars: 95 %)"
            label = figures.plain_words(self.legend or self.source) + ramp + bars
            of_ramp = None if error is None else error[there]
            x = self.x[there] if is_signed else np.abs(self.x[there])
            axes.errorbar(x, self.coefficient[there], of_ramp, label=label, **style)

    def label(self, axes: "Axes") -> None:
        """Label the axis of what the points are over."""
        if self.over == SPEED:
            axes.set(xscale="log", xlabel=figures.speed_label(self.x))
            figures.plain_ticks(axes.xaxis)
        else:
            figures.log_if_wide(axes, "x", np.abs(self.x))
            figures.plain_ticks(axes.xaxis)
            axes.set_xlabel("slide-roll ratio (-)")


@with_default_errors
def read_measured(
    path: str | Path,
    *,
    coefficient: str,
    speed: str | None = None,
    slide_roll_ratio: str | None = None,
    deviation: str | float | None = None,
    rolling: bool = True,
    legend: str | None = None,
) -> Measured:
    """Read a measured curve from a text file with a heading; commas, semicolons or tabs separate its columns.

    Nothing is guessed: you name the columns.

    Parameters
    ----------
    path : file
    coefficient : heading of the friction coefficients, as in the file
    speed, slide_roll_ratio : heading of the speeds, or of the slide-roll ratios (one of the two)
    deviation : heading of the standard deviations, or one for all points [-]; None: not known
    legend : what a picture calls the points; None: the name of the file without its ending
    rolling : False where the rolling part is taken out of the coefficients (`Measured`)

    Returns
    -------
    Measured

    Raises
    ------
    InputError : a file or a column is missing, or a heading of speeds has no unit

    Notes
    -----
    A unit in the heading, in square or round brackets, or in a line below the headings, is converted
    (`lubfric._base.tables`). A preamble may precede the table. Speeds that rise and then fall (or the other way round,
    and so on) are ramps: ``measured.branch`` has the number of each point's ramp, `Measured.of_branch` the points of
    one, and ``measured.hysteresis`` what is between them.
    """
    if (speed is None) == (slide_roll_ratio is None):
        raise InputError("a measured curve has one axis; give the heading of speed, or that of slide_roll_ratio")
    over, heading = (SLIDE_ROLL_RATIO_COLUMN, str(slide_roll_ratio)) if speed is None else (SPEED, speed)
    units = ("m/s" if over == SPEED else "-", "-", "-")
    names = (heading, coefficient, deviation) if isinstance(deviation, str) else (heading, coefficient)
    for name in names:
        validate.instance("heading", name, str, "words, as in the file")
    file = validate.folder("path", path)
    columns = [np.array(c) for c in read_columns(file, names, units, must_say=("m/s",), of_other_kind=OTHER_AXIS)]
    branch = ramps(columns[0])
    order = np.argsort(columns[0], kind="stable")
    x, f, *spread = (column[order] for column in columns)
    if deviation is not None and not isinstance(deviation, str):
        spread = [np.full(x.size, validate.number("deviation", deviation, "-", above=0.0))]
    try:
        return Measured(
            x,
            f,
            deviation=spread[0] if spread else None,
            over=over,
            source=file.name,
            legend=file.stem if legend is None else legend,
            rolling=rolling,
            branch=None if branch is None else branch[order],
        )
    except InputError as error:
        place = re.fullmatch(r"(coefficient|deviation)\[(\d+)\]", error.quantity)
        if place is None:
            raise
        column = coefficient if place[1] == "coefficient" else deviation
        row = f"file {file.name}, column {column!r}, row {order[int(place[2])] + 1} of its numbers"
        raise InputError(error.said, f"{row}: {place[1]}", error.allowed, error.recommendation) from None


def ramps(x: np.ndarray) -> np.ndarray | None:
    """Return the number of the ramp of each of the speeds ``x``, in the order of the measurement; None for one ramp,
    and for speeds in no order. A ramp rises or falls all the way; where a speed is repeated at the turn, the next ramp
    begins."""
    steps = np.diff(x)
    if x.size < 2 * SHORTEST_RAMP or (steps > 0).all() or (steps < 0).all():
        return None
    number = np.zeros(x.size, int)
    direction = 0.0
    for place, step in enumerate(steps.tolist(), 1):
        number[place] = number[place - 1]
        if step == 0.0:
            number[place] += 1
            direction = 0.0
        elif direction and np.sign(step) != direction:
            number[place] += 1
            direction = 0.0
        else:
            direction = float(np.sign(step))
    lengths = np.bincount(number)
    if lengths.min() < SHORTEST_RAMP or lengths.size > x.size // 3 + 1:
        return None
    return number


def values_at(parameters: dict[str, Between], unit: np.ndarray) -> dict[str, float]:
    """Return {key: value} of ``parameters`` at positions ``unit`` in [0, 1] between their bounds, (p,)."""
    return {key: float(bounds.at(share)) for (key, bounds), share in zip(parameters.items(), unit)}


def parameters_of(scene: Scene, bounds: Mapping[str, Any]) -> dict[str, Between]:
    """Return what is sought, of {"section.key": (low, high)}: in its logarithm where the bounds are a factor of 10 or
    more apart. The scene is checked at both ends of each."""
    if not isinstance(bounds, dict) or not bounds:
        raise InputError('parameters must be a dict such as {"bodies.boundary_friction_coefficient": (0.05, 0.2)}')
    check_temperature("parameters", scene, set(bounds))
    check_viscosity(scene, [set(bounds)])
    parameters: dict[str, Between] = {}
    for key, pair in bounds.items():
        check_key("parameters", scene, key, parameters, FITTED)
        if not isinstance(pair, (tuple, list)) or len(pair) != 2:
            raise InputError(f"parameters[{key!r}] = {pair!r}; allowed: a pair (lowest, highest)")
        check_all_have_units(f"parameters[{key!r}]", pair, [unit_of(key)] * 2)
        low = validate.number(f"parameters[{key!r}] lowest", pair[0], unit_of(key))
        high = validate.number(f"parameters[{key!r}] highest", pair[1], unit_of(key))
        if high <= low:
            ends = f"lowest = {worded_value(key, low)} is not below highest = {worded_value(key, high)}"
            raise InputError(f"parameters[{key!r}] {ends}; write the lower one first")
        for end, written in ((low, pair[0]), (high, pair[1])):
            scene.with_keys({key: end})
            refuse_far_value(f"parameters[{key!r}]", key, written)
        parameters[key] = Between(low, high, "log" if low > 0 and high >= LOGARITHMIC * low else "linear")
    return parameters
