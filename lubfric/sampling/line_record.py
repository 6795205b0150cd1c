"""The results of one line, and of several lines together."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ..contact import ContactState
from .influence import (
    BlockError,
    block_error,
    gap_influence,
    line_load,
    participation,
    spot_loads,
    strip_gap,
    weighted_errors,
)
from .response import Slopes

FEWEST_WINDOWS = 3
NOTHING = BlockError(math.inf, 0)


@dataclass(frozen=True)
class LineRecord:
    """One line in balance.

    - Its length [m], and the contact load [N] of the whole width.
    - Standard errors at given load: of its mean gap [m], its contact area fraction of A [-] and its contact area per
      length [m].
    - The loads of its short blocks, its area fractions and its contact area per length.
    - ``columns``: the share of its length in contact at each x (nx,); ``ends``: the share of its load on the first and
      the last.

    A line whose film clears its summits has no spots, and no errors of its own.
    """

    length: float
    contact_load: float = 0.0
    gap: BlockError = NOTHING
    area: BlockError = NOTHING
    touched: BlockError = NOTHING
    spots: np.ndarray = field(default_factory=lambda: np.zeros(0))
    area_fraction: float = 0.0
    plastic_fraction: float = 0.0
    touched_length: float = 0.0
    columns: np.ndarray | float = 0.0
    ends: float = 0.0


def length_of(contact) -> float:
    """Length of a line [m]."""
    return contact.heights.shape[1] * contact.spacing[1]


def record(
    contact,
    state: ContactState,
    load: float,
    slopes: Slopes,
    correlation_length: float,
    windows: int = 1,
    rows: slice = slice(None),
    exact_sq: bool = False,
) -> LineRecord:
    """The `LineRecord` of ``contact`` at ``load`` [N].

    ``correlation_length`` [m]: along y; ``windows``: number of windows of a measured map along y; ``rows``: those along
    y that count, if the others only mirror them; ``exact_sq``: the line was made with the Sq of the surface, so scatter
    that its places share with their own Sq is no error.

    The standard error comes from blocks along y. If there are three windows or more, it is the larger of that and the
    one from windows, which shows whether a surface differs from place to place.
    """
    by_place, step = line_load(contact, state)[rows], contact.spacing[1]
    pressure = np.zeros(contact.heights.shape) if state.pressure is None else state.pressure
    touching = pressure[:, rows] > 0
    touched = touching.sum(axis=0) * contact.spacing[0]
    squares = np.square(contact.heights[:, rows]).mean(axis=0) if exact_sq else None

    def error(values, slope):
        return _larger(gap_influence(values, by_place, slope), step, correlation_length, windows, squares)

    return LineRecord(
        by_place.size * step,
        load,
        error(strip_gap(contact, state)[rows], slopes.gap),
        error(contact.weight @ touching / contact.weight.sum(), slopes.area),
        error(touched, slopes.touched),
        spot_loads(by_place, step, correlation_length),
        state.real_contact_area_fraction,
        state.plastic_area_fraction,
        float(touched.mean()),
        state.contact_fraction,
        contact.on_the_ends(state),
    )


def _larger(values, step, correlation_length, windows, exact) -> BlockError:
    blocks = block_error(values, step, correlation_length, exact)
    if windows < FEWEST_WINDOWS:
        return blocks
    size = values.size // windows
    means = values[: size * windows].reshape(windows, size).mean(axis=1)
    by_window = BlockError(float(means.std(ddof=1)) / math.sqrt(windows), windows - 1)
    known = [e for e in (blocks, by_window) if math.isfinite(e.error)]
    return max(known, key=lambda e: e.error)


@dataclass(frozen=True)
class Pooled:
    """Several lines together, each weighted by its length [m]; names as in `LineRecord`. ``ends``: the largest."""

    length: float
    contact_load: float
    gap: BlockError
    area: BlockError
    touched: BlockError
    participation: float
    area_fraction: float
    plastic_fraction: float
    touched_length: float
    columns: np.ndarray
    ends: float


def pooled(records) -> Pooled:
    """The mean over ``records``. Their errors add as independent ones. A line without contact counts as uncertain as
    one with contact, for its length.

    The loads are averaged by length, each of its own balance (`lubfric.sampling.joined` for that of one line).
    """
    length = sum(r.length for r in records)

    def mean(name):
        return sum(r.length * getattr(r, name) for r in records) / length

    return Pooled(
        length,
        mean("contact_load"),
        _over_lines(records, "gap"),
        _over_lines(records, "area"),
        _over_lines(records, "touched"),
        participation(np.concatenate([r.spots for r in records])),
        mean("area_fraction"),
        mean("plastic_fraction"),
        mean("touched_length"),
        mean("columns"),
        max(r.ends for r in records),
    )


def _over_lines(records, name: str) -> BlockError:
    """Error of the mean over ``records`` of the quantity ``name``."""
    touching = [r for r in records if r.spots.size]
    part, length = sum(r.length for r in touching), sum(r.length for r in records)
    if not touching:
        return NOTHING
    found = weighted_errors([(r.length / part, getattr(r, name)) for r in touching])
    return BlockError(found.error * math.sqrt(part / length), found.freedom)
