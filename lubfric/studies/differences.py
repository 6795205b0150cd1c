"""Differences of f and of the power loss between two points of a study, with the error of the difference, and pairs of
points that differ in one input alone."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from .best import compared_points, error_of_differences, groups_of
from .conditions import COMPUTATION, operating_keys, points_are_designs
from .operating_points import ORDERED_BY, POINT
from .tables import columns_of_study


class Difference(NamedTuple):
    """Change of the magnitude of a number between two points.

    ``before``: the magnitude at the first point; ``value``: the change, both in SI; ``interval``: ends of its 95 %
    interval, NaN where an error is not known.
    """

    before: float
    value: float
    interval: tuple[float, float]

    @property
    def is_distinct(self) -> bool:
        """Whether the interval does not contain 0."""
        return self.interval[0] > 0 or self.interval[1] < 0


@dataclass(frozen=True, kw_only=True)
class SingleChange:
    """Two points that differ in one input alone.

    Attributes
    ----------
    rows : of both points in the columns of a study, from 0
    before, after : values [SI] of the input at both, by key; several keys where these change together at all points
    common : values [SI] of what else is varied, by key; of an operating point where it lies
    """

    rows: tuple[int, int]
    before: dict[str, Any]
    after: dict[str, Any]
    common: dict[str, Any]


def differences(result: Any, quantity: str, pairs: Sequence[tuple[int, int]]) -> list[Difference]:
    """Return the `Difference` of a ``quantity``, "coefficient" or "power_loss", between the rows of each of ``pairs``.

    Errors as of `best`: what both points have in common cancels. Model-form errors at different operating conditions
    are independent. NaN where f of one point is that of rolling resistance (`is_by_sliding`).
    """
    (columns, points) = compared_points(result, quantity)
    condition = groups_of(columns, operating_keys(result.plan))
    changes = []
    for first, last in pairs:
        both = points.at(np.array([first, last]))
        if condition[first] != condition[last]:
            both = replace(both, kind=np.full(2, -1))
        value = float(both.value[1] - both.value[0])
        below = float(error_of_differences(both, 0)[1])
        above = float(error_of_differences(both, 1)[0])
        changes.append(Difference(before=float(both.value[0]), value=value, interval=(value - below, value + above)))
    return changes


def single_changes(result: Any) -> list[SingleChange]:
    """Return the neighbouring points that differ in one input of a study alone, by input: numbers in their order, words
    in that of the study. None of curves that chose their speeds. The operating points of a cycle, whose columns change
    together, are no input, nor are seeds and keys of the computation."""
    if result.chosen:
        return []
    columns = columns_of_study(result)
    varied = [key for key in result.coords if np.unique(columns[key]).size > 1]
    of_cycle = result.paired and not points_are_designs(result.plan)
    fixed = [key for key in varied if of_cycle and result.coords[key][0] == POINT]
    inputs: dict[tuple[int, ...], list[str]] = {}
    for key in varied:
        if key not in fixed and not key.startswith(COMPUTATION):
            inputs.setdefault(tuple(groups_of(columns, (key,)).tolist()), []).append(key)
    inputs = {codes: keys for codes, keys in inputs.items() if not set(keys) & set(ORDERED_BY)}
    places = np.arange(result.status.size) % result.status.shape[-1] if of_cycle else np.zeros(result.status.size, int)
    changes = []
    for keys in inputs.values():
        others = [key for key in varied if key not in keys]
        at = _common_keys(others, fixed)
        for rows in _pairs(columns, keys, others, places):
            before, after = ({key: columns[key][row].item() for key in keys} for row in rows)
            common = {key: columns[key][rows[0]].item() for key in at}
            changes.append(SingleChange(rows=rows, before=before, after=after, common=common))
    return changes


def _common_keys(others: Sequence[str], fixed: Sequence[str]) -> list[str]:
    """Return the keys that say at which values of ``others`` an input changes; of the ``fixed`` columns of an operating
    point where it lies, if that is known."""
    where = [key for key in fixed if key in ORDERED_BY] or list(fixed)
    return [key for key in others if key not in fixed or key in where]


def _pairs(
    columns: dict[str, np.ndarray], keys: Sequence[str], others: Sequence[str], places: np.ndarray
) -> Iterator[tuple[int, int]]:
    """Yield the rows of neighbours in the first of ``keys`` that have the ``others`` and the ``places`` in common."""
    known = np.isfinite(columns["power_loss"]) | np.isfinite(columns["coefficient"])
    codes = groups_of(columns, tuple(keys))
    values = columns[keys[0]]
    order = values if values.dtype.kind in "fi" else codes
    common = groups_of(columns | {POINT: places}, (POINT, *others))
    sorted_rows = np.argsort(common, kind="stable")
    for group in np.split(sorted_rows, np.flatnonzero(np.diff(common[sorted_rows])) + 1):
        rows = group[known[group]]
        (_, first) = np.unique(codes[rows], return_index=True)
        rows = rows[np.sort(first)]
        rows = rows[np.argsort(order[rows], kind="stable")].tolist()
        yield from zip(rows, rows[1:])
