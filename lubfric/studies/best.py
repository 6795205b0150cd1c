"""The combination of design with the lowest friction, or power loss, at each operating condition of a study, and the
combinations that it cannot be distinguished from within the intervals of the points."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._base import validate
from ..errors import InputError
from ..models.shared import half_width_of_error, is_by_sliding
from ..quantities import COLUMN_OF_ERROR
from ..scene import inputs_not_given
from .conditions import design_keys, operating_keys, points_are_designs
from .operating_points import DURATION, INTERVAL_COLUMNS, mean_over_cycle
from .tables import columns_of_study

# Parts of the uncertainty budget of f by ranges of inputs, which designs have in common where the inputs are not
# varied.
SHARED_PARTS = ("not_given", "inputs")

# Models whose model-form errors of similar designs were compared.
COMPARED_MODELS = ("quick", "paper")

# Keys by which these designs differed.
COMPARED_KEYS = frozenset(
    {
        "surface.sq",
        "surface.ra",
        "surface.correlation_length",
        "counterface.sq",
        "counterface.ra",
        "counterface.correlation_length",
        "bodies.radius",
        "bodies.boundary_friction_coefficient",
        "lubricant.viscosity",
    }
)

# Correlation of the model-form errors of two designs that differ by `COMPARED_DISTANCE` at most [-]. Measured on pairs
# of random contacts at rest and rolling (`python -m verification.campaigns.calibration pairs`): with it 95 to 100 % of
# the differences, by motion and model, are within their 95 % error.
CORRELATION_OF_DESIGNS = 0.75

# Distance of two designs, the sum of the changes of ln of their keys, up to which that holds [-]: a factor of 2, the
# largest that was compared. What is left of 1 - `CORRELATION_OF_DESIGNS` grows with the distance beyond it: a choice,
# as nothing was measured there.
COMPARED_DISTANCE = math.log(2.0)


@dataclass(frozen=True, kw_only=True)
class BestDesign:
    """The combination of design with the lowest friction, or power loss, at an operating condition, or over all of
    them.

    Attributes
    ----------
    condition : values [SI] of the operating keys there, by key; empty: over all conditions
    design : values [SI] of the design keys, by key
    value, interval : magnitude of the number there, and the ends of its 95 % interval (NaN: not known)
    row : number of the point in study.csv, from 1 as the tables count; None over all conditions
    rivals : the other designs that it cannot be distinguished from, the lowest first
    rival_rows : numbers of their points, in the same order; none over all conditions
    unknown_rivals : number of the rivals whose interval is not known
    compared : number of designs with a known number there, this one included
    """

    condition: dict[str, Any]
    design: dict[str, Any]
    value: float
    interval: tuple[float, float]
    row: int | None
    rivals: tuple[dict[str, Any], ...]
    rival_rows: tuple[int, ...]
    unknown_rivals: int
    compared: int

    @property
    def common_design(self) -> dict[str, Any]:
        """The values of design keys that this combination and all its rivals have in common."""
        return {
            key: value
            for key, value in self.design.items()
            if all(np.array_equal(rival[key], value) for rival in self.rivals)
        }


def best(result: Any, quantity: str = "coefficient") -> tuple[BestDesign, ...]:
    """Return the combination of the design keys with the lowest ``quantity`` at each operating condition, as a
    `BestDesign` each.

    Conditions are the load, the speeds, the slide-roll ratio, the temperature of the oil, and where an operating point
    lies; all else that is varied is design. Operating points that vary a design key, such as the roughness, and state
    no position, angle or time are each a design as a whole, load and speed included. Two points cannot be distinguished
    where the difference of their numbers is within the error of this difference. Errors count by the sides of the
    intervals that face each other. Numerical and sampling errors are taken as independent. Model-form errors of similar
    designs by the quick model or that of the paper are correlated (`CORRELATION_OF_DESIGNS`), all others are taken as
    independent. Ranges of inputs that both designs share move both numbers the same way: only the difference of the two
    changes counts. A point without a known interval cannot be distinguished from any other. Where f is that of rolling
    resistance (`is_by_sliding`), it is not compared.

    Parameters
    ----------
    quantity : "coefficient" or "power_loss", whose magnitude is compared

    Returns
    -------
    tuple : in the order of the points; conditions with fewer than two designs with a known number are omitted

    Raises
    ------
    InputError : the curves chose their own speeds, at which they cannot be compared; or operating points vary no design
    """
    if result.paired and not design_keys(result.plan):
        raise InputError(
            "the operating points vary no design: all their columns count as conditions of one cycle",
            recommendation="give designs in vary; result['power_loss'] has all points",
        )
    (columns, points) = compared_points(result, quantity)
    value = points.value
    ends = points.ends
    (conditions, designs) = (groups_of(columns, keys(result.plan)) for keys in (operating_keys, design_keys))
    best_ones = []
    for condition in range(int(conditions.max(initial=-1)) + 1):
        rows = np.flatnonzero((conditions == condition) & np.isfinite(value))
        if np.unique(designs[rows]).size < 2:
            continue
        (lowest, others) = _ranked(points.at(rows))
        best_ones.append(
            BestDesign(
                condition=_at(columns, operating_keys(result.plan), rows[lowest]),
                design=_at(columns, design_keys(result.plan), rows[lowest]),
                value=float(value[rows[lowest]]),
                interval=_interval(ends[:, rows[lowest]]),
                row=int(rows[lowest]) + 1,
                rivals=tuple(_at(columns, design_keys(result.plan), row) for row in rows[others]),
                rival_rows=tuple(int(row) + 1 for row in rows[others]),
                unknown_rivals=int(np.isnan(ends[0, rows[others]]).sum()),
                compared=np.unique(designs[rows]).size,
            )
        )
    return tuple(best_ones)


def best_mean(result: Any, quantity: str = "coefficient") -> BestDesign | None:
    """Return the combination of the design keys with the lowest mean of a ``quantity`` over all operating conditions,
    weighted by their duration if they have one; None where fewer than two designs have a known number at all of several
    conditions. Conditions at which f of some design is that of rolling resistance do not count in its mean.

    The interval is the mean of those of the points, whose errors are taken as fully correlated. ``quantity``,
    comparison and errors: as of `best`.

    Raises `InputError` as `best` does, and where each operating point is a design, as there is no mean over it.
    """
    if points_are_designs(result.plan):
        raise InputError(
            "each operating point is a design of its own, which has no mean over conditions",
            recommendation=f"result.best({quantity!r}) compares them",
        )
    (columns, points) = compared_points(result, quantity)
    value = points.value
    (conditions, designs) = (groups_of(columns, keys(result.plan)) for keys in (operating_keys, design_keys))
    is_compared = ~np.isin(conditions, conditions[~_counts(columns, quantity)])
    count = np.unique(conditions[is_compared]).size
    weights = columns.get(DURATION, np.ones(value.size))
    complete = []
    for design in range(int(designs.max(initial=-1)) + 1):
        rows = np.flatnonzero((designs == design) & np.isfinite(value) & is_compared)
        if rows.size == count == np.unique(conditions[rows]).size:
            complete.append(rows)
    if count < 2 or len(complete) < 2:
        return None
    averaged = _mean_points(points, complete, weights)
    means = averaged.value
    mean_ends = averaged.ends
    (lowest, others) = _ranked(averaged)
    names = [_at(columns, design_keys(result.plan), rows[0]) for rows in complete]
    return BestDesign(
        condition={},
        design=names[lowest],
        value=float(means[lowest]),
        interval=_interval(mean_ends[:, lowest]),
        row=None,
        rivals=tuple(names[other] for other in others),
        rival_rows=(),
        unknown_rivals=int(np.isnan(mean_ends[0, others]).sum()),
        compared=len(complete),
    )


@dataclass(frozen=True, kw_only=True)
class ComparedPoints:
    """Points, or designs, that are compared.

    Attributes
    ----------
    value : magnitude of the number, (n,)
    ends : of its 95 % interval, (2, n); NaN where it is not known
    own : sides of the interval, below and above, by the errors that a point has for itself, (2, n)
    by_model : sides by the model-form error, (2, n)
    by_inputs : sides by the ranges of inputs, (2, n)
    inputs : number of the set of inputs with a range, (n,): points with the same share the values of these inputs
    place : ln of the `COMPARED_KEYS` of the design that are varied, (k, n)
    kind : number of the combination of its other keys, (n,); -1 where model-form errors were not compared
    """

    value: np.ndarray
    ends: np.ndarray
    own: np.ndarray
    by_model: np.ndarray
    by_inputs: np.ndarray
    inputs: np.ndarray
    place: np.ndarray
    kind: np.ndarray

    def at(self, rows: np.ndarray) -> ComparedPoints:
        """Return the points in ``rows``."""
        return ComparedPoints(**{name: numbers[..., rows] for name, numbers in vars(self).items()})


def _mean_points(points: ComparedPoints, designs: list[np.ndarray], weights: np.ndarray) -> ComparedPoints:
    """Return the means of ``points`` over the rows of each of the ``designs``, with the means of all their errors."""

    def mean(numbers: np.ndarray) -> np.ndarray:
        means = [[mean_over_cycle(row[rows], weights[rows]) for rows in designs] for row in np.atleast_2d(numbers)]
        return np.array(means).reshape(*numbers.shape[:-1], len(designs))

    sets: dict[tuple[int, ...], int] = {}
    inputs = [sets.setdefault(tuple(points.inputs[rows].tolist()), len(sets)) for rows in designs]
    first = [rows[0] for rows in designs]
    return ComparedPoints(
        value=mean(points.value),
        ends=mean(points.ends),
        own=mean(points.own),
        by_model=mean(points.by_model),
        by_inputs=mean(points.by_inputs),
        inputs=np.array(inputs),
        place=points.place[:, first],
        kind=points.kind[first],
    )


def compared_points(result: Any, quantity: str) -> tuple[dict[str, np.ndarray], ComparedPoints]:
    """Return the columns of a study, and its points with the magnitude of a ``quantity``."""
    validate.choice("quantity", quantity, INTERVAL_COLUMNS)
    if result.chosen:
        raise InputError("curves that choose their own speeds cannot be compared; give the same speeds to all")
    columns = columns_of_study(result)
    (f, ends_of_f) = _magnitude(columns, "coefficient")
    (magnitude, ends) = _magnitude(columns, quantity)
    value = np.where(_counts(columns, quantity), magnitude, np.nan)
    parts = {name: columns[COLUMN_OF_ERROR[name]] for name in ("numerical", "sampling", "freedom", *SHARED_PARTS)}
    of_model = np.nan_to_num(columns[COLUMN_OF_ERROR["model"]])  # the interval does not contain one that is not known
    of_sample = [half_width_of_error(*pair) for pair in zip(parts["sampling"].tolist(), parts["freedom"].tolist())]
    own_of_f = f * np.hypot(parts["numerical"], of_sample)
    by_inputs_of_f = f * np.hypot(*(np.nan_to_num(parts[name]) for name in SHARED_PARTS))
    sides_of_f = np.abs(ends_of_f - f)
    of_interval = np.where(sides_of_f > 0, sides_of_f, np.inf)
    sides = np.abs(ends - value)
    (place, kind) = _places_of_designs(result, columns)
    return columns, ComparedPoints(
        value=value,
        ends=ends,
        own=sides * np.minimum(own_of_f / of_interval, 1.0),
        by_model=sides * np.minimum(f * of_model / of_interval, 1.0),
        by_inputs=sides * np.minimum(by_inputs_of_f / of_interval, 1.0),
        inputs=_sets_of_inputs(result, columns),
        place=place,
        kind=kind,
    )


def _counts(columns: dict[str, np.ndarray], quantity: str) -> np.ndarray:
    """Return at which points a ``quantity`` is compared, (n,): f where it comes from sliding, the power loss
    everywhere."""
    return is_by_sliding(columns) if quantity == "coefficient" else np.ones(columns[quantity].size, dtype=bool)


def _magnitude(columns: dict[str, np.ndarray], quantity: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the magnitude of a ``quantity`` at each point, (n,), and the ends of its interval, (2, n)."""
    value = np.abs(columns[quantity])
    unknown = np.full(value.size, np.nan)
    low, high = (columns.get(name, unknown) for name in INTERVAL_COLUMNS[quantity])
    ends = np.sort(np.abs([low, high]), axis=0)
    return value, np.where(low * high < 0, [0.0 * low, ends[1]], ends)


def _sets_of_inputs(result: Any, columns: dict[str, np.ndarray]) -> np.ndarray:
    """Return the number of the set of inputs with a range that each point has, (n,). An input that the study varies is
    another one at each design, also where its range is the same."""
    scenes = result.plan.scenes
    designs = groups_of(columns, design_keys(result.plan))
    varied = {*design_keys(result.plan)}
    sets: dict[Any, int] = {}
    numbers = []
    of_scenes = [((scene.ranges, inputs_not_given(scene)), {name for name, *_ in scene.ranges}) for scene in scenes]
    for row, design in enumerate(designs.tolist()):
        (inputs, names) = of_scenes[row * len(scenes) // designs.size]
        is_varied = bool(varied & (names | {name.partition(".")[0] for name in names}))
        numbers.append(sets.setdefault((inputs, design if is_varied else None), len(sets)))
    return np.array(numbers, dtype=int)


def _places_of_designs(result: Any, columns: dict[str, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Return where the design of each point lies, as `ComparedPoints.place` and `ComparedPoints.kind`."""
    keys = design_keys(result.plan)
    numbers = [
        key for key in keys if key in COMPARED_KEYS and columns[key].dtype.kind == "f" and (columns[key] > 0).all()
    ]
    count = len(next(iter(columns.values())))
    place = np.array([np.log(columns[key]) for key in numbers]).reshape(len(numbers), count)
    kind = groups_of(columns, tuple(key for key in keys if key not in numbers))
    is_compared = result.plan.scene.numerics.model in COMPARED_MODELS
    return place, kind if is_compared else np.full(count, -1)


def _correlation(points: ComparedPoints, row: int) -> np.ndarray:
    """Return the correlation of the model-form error of each of ``points`` with that in ``row``, (n,)."""
    distance = np.abs(points.place - points.place[:, [row]]).sum(axis=0)
    multiple = np.maximum(distance / COMPARED_DISTANCE, 1.0)
    correlation = np.maximum(1.0 - multiple * (1.0 - CORRELATION_OF_DESIGNS), 0.0)
    is_alike = (points.kind == points.kind[row]) & (points.kind >= 0)
    return np.where(is_alike, correlation, 0.0)


def groups_of(columns: dict[str, np.ndarray], keys: tuple[str, ...]) -> np.ndarray:
    """Return the number of the combination of the values of ``keys`` of each point, in the order in which they occur,
    (n,)."""
    count = len(next(iter(columns.values())))
    rows = zip(*(columns[key].tolist() for key in keys)) if keys else [()] * count
    numbers: dict[tuple[Any, ...], int] = {}
    return np.array([numbers.setdefault(tuple(row), len(numbers)) for row in rows], dtype=int)


def _ranked(points: ComparedPoints) -> tuple[int, np.ndarray]:
    """Return which of ``points`` has the lowest value, and which others cannot be distinguished from it, the lowest
    first."""
    value = points.value
    order = np.argsort(value, kind="stable")
    lowest = int(order[0])
    are_distinct = value - value[lowest] > error_of_differences(points, lowest)
    return lowest, np.array([row for row in order[1:] if not are_distinct[row]], dtype=int)


def error_of_differences(points: ComparedPoints, lowest: int) -> np.ndarray:
    """Return by how much the differences of all ``points`` from the one in the row ``lowest`` may be smaller at 95 %,
    (n,): the errors of both by the sides of the intervals that face each other, without what they have in common."""
    shared = np.abs(points.by_inputs - points.by_inputs[:, [lowest]]).max(axis=0)
    apart = np.hypot(points.by_inputs[1, lowest], points.by_inputs[0])
    by_inputs = np.where(points.inputs == points.inputs[lowest], shared, apart)
    own = np.hypot(points.own[1, lowest], points.own[0])
    above = points.by_model[1, lowest]
    below = points.by_model[0]
    by_model = np.sqrt(above**2 + below**2 - 2.0 * _correlation(points, lowest) * above * below)
    return np.asarray(np.sqrt(own**2 + by_model**2 + by_inputs**2))


def _at(columns: dict[str, np.ndarray], keys: tuple[str, ...], row: int) -> dict[str, Any]:
    return {key: columns[key][row].item() for key in keys}


def _interval(ends: np.ndarray) -> tuple[float, float]:
    return float(ends[0]), float(ends[1])
