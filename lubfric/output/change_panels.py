"""Panels of the inputs of a study of few points: f of the points that differ in one input alone, with the part of its
interval that counts in their differences."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import studies
from .._base import figures
from ..quantities import worded_value
from .best_designs import condition_in_words

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Width [pt] and opacity of the bars of the whole interval, and of the part that counts in differences. Choices, by
# looking at the figures.
COMMON_BAR = (0.7, 0.35)
OWN_BAR = (3.5, 0.4)

# Size of the marks of a point [pt]. A choice, by looking at the figures.
POINT_MARK = 4.0

# Distance of the marks of two groups over one value, as a part of the axis, and blank above and below the bars, as a
# part of their range. Choices, by looking at the figures.
GROUPS_APART = 0.04
BLANK_AROUND = 0.15

# Range of f and of the parts that count in differences over the width of the intervals, below which a picture from 0
# shows no difference. A choice, by looking at the figures.
HIDDEN = 0.5

OWN_PART = "part of it that counts in differences within a line"
INTERVAL_OF_POINT = "95 % interval of f"


@dataclass(frozen=True, kw_only=True)
class Chain:
    """Points of a study that differ in one input alone.

    Attributes
    ----------
    rows : of the points in the columns of the study, in the order of the input
    own : half the width of the part of the interval of f that counts in differences between these points, (n,)
    common : what else is varied, as text
    """

    rows: tuple[int, ...]
    own: np.ndarray
    common: str


def chains_of(result: studies.StudyResult) -> dict[str, list[Chain]]:
    """Return the chains of the points of a study with a known f and interval that differ in one input alone, by its
    key."""
    rows: dict[str, list[list[int]]] = {}
    common: dict[str, list[str]] = {}
    for change in studies.single_changes(result):
        (first, last) = change.rows
        for key in change.before:
            lists = rows.setdefault(key, [])
            if lists and lists[-1][-1] == first:
                lists[-1].append(last)
            else:
                lists.append([first, last])
                common.setdefault(key, []).append(condition_in_words(change.common))
    chains = {key: [_chain(result, *pair) for pair in zip(lists, common[key])] for key, lists in rows.items()}
    return {key: known for key, each in chains.items() if (known := [one for one in each if one is not None])}


def _chain(result: studies.StudyResult, rows: list[int], common: str) -> Chain | None:
    """Return the chain of the points in ``rows``; None where an error of a difference is not known.

    The parts of two points that count, added as independent ones, are at least the error of their difference."""
    pairs = list(zip(rows, rows[1:]))
    errors = [0.5 * (one.interval[1] - one.interval[0]) for one in studies.differences(result, "coefficient", pairs)]
    if not np.isfinite(errors).all():
        return None
    sides = np.array(errors) / math.sqrt(2.0)
    own = np.maximum(np.append(sides, 0.0), np.insert(sides, 0, 0.0))
    return Chain(rows=tuple(rows), own=own, common=common)


def hides_differences(result: studies.StudyResult, key: str) -> bool:
    """Return whether all points of a study differ in this ``key`` alone, and what they have in common makes most of the
    intervals of f, so that an axis that shows these shows no difference."""
    chains = chains_of(result).get(key, [])
    if len(chains) != 1 or len(chains[0].rows) < result.status.size:
        return False
    columns = studies.columns_of_study(result)
    (low, high) = (columns[name] for name in studies.INTERVAL_COLUMNS["coefficient"])
    f = columns["coefficient"][list(chains[0].rows)]
    shown = float(np.max(f + chains[0].own) - np.min(f - chains[0].own))
    return shown < HIDDEN * float(np.median(high - low))


def draw_chains(axes: Axes, result: studies.StudyResult, key: str, chains: list[Chain]) -> tuple[float, float]:
    """Draw f of ``chains`` over the values of a ``key``, a line for each, with thin bars of the intervals and thick ones
    of the part that counts in differences; return the ends of the thick ones."""
    columns = studies.columns_of_study(result)
    values = columns[key]
    names = [] if values.dtype.kind in "fi" else list(dict.fromkeys(values.tolist()))
    if names:
        along = np.array([names.index(value) for value in values.tolist()], dtype=float)
        label = studies.name_of(key)
    else:
        (along, label) = studies.shown_numbers(key, values)
    f = columns["coefficient"]
    (low, high) = (columns[name] for name in studies.INTERVAL_COLUMNS["coefficient"])
    step = GROUPS_APART * (float(np.ptp(along)) or 1.0)
    colours = [figures.BLUE] if len(chains) == 1 else list(studies.line_colours(np.linspace(0.0, 1.0, len(chains))))
    ends = []
    for number, (chain, colour) in enumerate(zip(chains, colours)):
        rows = np.array(chain.rows)
        x = along[rows] + step * (number - 0.5 * (len(chains) - 1))
        sides = (f[rows] - chain.own, f[rows] + chain.own)
        axes.vlines(x, low[rows], high[rows], color=[colour], lw=COMMON_BAR[0], alpha=COMMON_BAR[1])
        axes.vlines(x, *sides, color=[colour], lw=OWN_BAR[0], alpha=OWN_BAR[1])
        at = f"at {chain.common}" if chain.common else "f"
        axes.plot(x, f[rows], "o-", ms=POINT_MARK, lw=1.0, color=colour, label=figures.plain_words(at))
        ends += [float(sides[0].min()), float(sides[1].max())]
    if names:
        studies.name_places(axes, [worded_value(key, name) for name in names])
    else:
        studies.tick_values(axes, along)
    axes.set_xlabel(label)
    figures.key_above(axes, 1)
    return min(ends), max(ends)


def show_ends(axes: Axes, ends: list[tuple[float, float]]) -> None:
    """Let the axis of f show the ``ends`` of the thick bars of its panels, beyond which the thin ones may go on."""
    low = min(pair[0] for pair in ends)
    high = max(pair[1] for pair in ends)
    blank = BLANK_AROUND * (high - low)
    axes.set_ylim(low - blank, high + blank)


def handles_of_chains(result: studies.StudyResult, axes: Axes) -> list[Any]:
    """Return the entries of a key for `draw_chains` on ``axes``."""
    from matplotlib.lines import Line2D

    (low, high) = (result[name] for name in studies.INTERVAL_COLUMNS["coefficient"])
    (bottom, top) = axes.get_ylim()
    goes_on = bool(np.nanmin(low) < bottom or np.nanmax(high) > top)
    whole = INTERVAL_OF_POINT + (", which goes on beyond the picture" if goes_on else "")
    grey: dict[str, Any] = {"color": figures.GREY}
    return [
        Line2D([], [], **grey, lw=COMMON_BAR[0], alpha=0.6, label=whole),
        Line2D([], [], **grey, lw=OWN_BAR[0], alpha=OWN_BAR[1], label=OWN_PART),
    ]
