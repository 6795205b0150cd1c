"""The combination of design with the lowest friction, or power loss, at each operating condition of a study, and the
combinations that it cannot be distinguished from within the intervals of the points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .._base import validate
from ..errors import InputError
from .conditions import design_keys, operating_keys
from .operating_points import DURATION, INTERVAL_COLUMNS, mean_over_cycle
from .tables import columns_of_study


@dataclass(frozen=True, kw_only=True)
class BestDesign:
    """The combination of design with the lowest friction, or power loss, at an operating condition, or over all of them.

    Attributes
    ----------
    condition : values [SI] of the operating keys there, by key; empty: over all conditions
    design : values [SI] of the design keys, by key
    value, interval : magnitude of the number there, and the ends of its 95 % interval (NaN: not known)
    row : number of the point in study.csv, from 1; 0 over all conditions
    rivals : the other designs that it cannot be distinguished from, the lowest first
    rival_rows : numbers of their points, in the same order; none over all conditions
    unknown_rivals : number of the rivals whose interval is not known
    compared : number of designs with a known number there, this one included
    """

    condition: dict[str, Any]
    design: dict[str, Any]
    value: float
    interval: tuple[float, float]
    row: int
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
    """Return the combination of the design keys with the lowest ``quantity`` at each operating condition, as a `BestDesign`
    each.

    Conditions are the load, the speeds, the slide-roll ratio, the temperature of the oil, and where an operating point lies; all
    else that is varied is design. Two points cannot be distinguished where the difference of their numbers is within the root sum of
    squares of the parts of their intervals that face each other: their errors are taken as independent. Errors that they have in
    common would make the difference better known. A point without a known interval cannot be distinguished from any other.

    Parameters
    ----------
    quantity : "coefficient" or "power_loss", whose magnitude is compared

    Returns
    -------
    tuple : in the order of the points; conditions with fewer than two designs with a known number are omitted

    Raises
    ------
    InputError : the curves chose their own speeds, at which they cannot be compared
    """
    (columns, value, ends) = _compared(result, quantity)
    (conditions, designs) = (_groups(columns, keys(result.plan)) for keys in (operating_keys, design_keys))
    best_ones = []
    for condition in range(int(conditions.max(initial=-1)) + 1):
        rows = np.flatnonzero((conditions == condition) & np.isfinite(value))
        if np.unique(designs[rows]).size < 2:
            continue
        (lowest, others) = _ranked(value[rows], ends[:, rows])
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
    """Return the combination of the design keys with the lowest mean of a ``quantity`` over all operating conditions, weighted by
    their duration if they have one; None where fewer than two designs have a known number at all of several conditions.

    The interval is the mean of those of the points, whose errors are taken as fully correlated. ``quantity``, comparison and errors:
    as of `best`.
    """
    (columns, value, ends) = _compared(result, quantity)
    (conditions, designs) = (_groups(columns, keys(result.plan)) for keys in (operating_keys, design_keys))
    count = int(conditions.max(initial=-1)) + 1
    weights = columns.get(DURATION, np.ones(value.size))
    complete = []
    for design in range(int(designs.max(initial=-1)) + 1):
        rows = np.flatnonzero((designs == design) & np.isfinite(value))
        if rows.size == count == np.unique(conditions[rows]).size:
            complete.append(rows)
    if count < 2 or len(complete) < 2:
        return None
    means = np.array([mean_over_cycle(value[rows], weights[rows]) for rows in complete])
    mean_ends = np.array([[mean_over_cycle(end[rows], weights[rows]) for rows in complete] for end in ends])
    (lowest, others) = _ranked(means, mean_ends)
    names = [_at(columns, design_keys(result.plan), rows[0]) for rows in complete]
    return BestDesign(
        condition={},
        design=names[lowest],
        value=float(means[lowest]),
        interval=_interval(mean_ends[:, lowest]),
        row=0,
        rivals=tuple(names[other] for other in others),
        rival_rows=(),
        unknown_rivals=int(np.isnan(mean_ends[0, others]).sum()),
        compared=len(complete),
    )


def _compared(result: Any, quantity: str) -> tuple[dict[str, np.ndarray], np.ndarray, np.ndarray]:
    """Return the columns of a study, and of each point the magnitude of a ``quantity`` and the ends (2, n) of its interval."""
    validate.choice("quantity", quantity, INTERVAL_COLUMNS)
    if result.chosen:
        raise InputError("curves that choose their own speeds cannot be compared; give the same speeds to all")
    columns = columns_of_study(result)
    unknown = np.full(result.status.size, np.nan)
    low, high = (columns.get(name, unknown) for name in INTERVAL_COLUMNS[quantity])
    ends = np.sort(np.abs([low, high]), axis=0)
    return columns, np.abs(columns[quantity]), np.where(low * high < 0, [0.0 * low, ends[1]], ends)


def _groups(columns: dict[str, np.ndarray], keys: tuple[str, ...]) -> np.ndarray:
    """Return the number of the combination of the values of ``keys`` of each point, in the order in which they occur, (n,)."""
    count = len(next(iter(columns.values())))
    rows = zip(*(columns[key].tolist() for key in keys)) if keys else [()] * count
    numbers: dict[tuple[Any, ...], int] = {}
    return np.array([numbers.setdefault(tuple(row), len(numbers)) for row in rows], dtype=int)


def _ranked(value: np.ndarray, ends: np.ndarray) -> tuple[int, np.ndarray]:
    """Return which ``value`` (n,) is the lowest, and which others cannot be distinguished from it by the ``ends`` (2, n) of the intervals, the
    lowest first."""
    order = np.argsort(value, kind="stable")
    lowest = int(order[0])
    above = ends[1, lowest] - value[lowest]
    are_distinct = value - value[lowest] > np.hypot(above, value - ends[0])
    return lowest, np.array([row for row in order[1:] if not are_distinct[row]], dtype=int)


def _at(columns: dict[str, np.ndarray], keys: tuple[str, ...], row: int) -> dict[str, Any]:
    return {key: columns[key][row].item() for key in keys}


def _interval(ends: np.ndarray) -> tuple[float, float]:
    return float(ends[0]), float(ends[1])
