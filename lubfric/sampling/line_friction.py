"""Friction of an endless rough line to a given standard error: first a pilot line, then more lines, then the cells."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from ..contact import ContactState, HalfSpaceContact
from ..sharing import (
    Balance,
    Cells,
    Lubricated,
    Prepared,
    Solved,
    balanced,
    divided,
    line_contact,
    on_halved_cells,
    separated,
    solved,
    solved_as_deflected,
)
from .at_split import at, grown, quantities, redivided
from .grid_pair import GridStep, mean_of
from .influence import BlockError
from .line_record import Pooled
from .response import Response
from .sample import Anchor, Sample, lines_of_model

SHORTER = 1.5  # times shorter than wanted: a line solved before is still taken
LINE_BALANCE = 1.0  # of the sampling tolerance: what correcting a further line to first order may move f by
MOST_CORRECTED = 0.05  # of f, by such a correction: what it leaves is of second order
MOST_MOVED = 0.1  # of ln(F_H/F_C), by such a correction: a light contact follows it exponentially
LOOSEST_LINE = 0.03  # volume residual of a further line
LIGHT = 0.1  # of the load on the contact: it touches for sure


@dataclass(frozen=True)
class Used:
    """A line beyond the pilot: the ``length`` [m] asked for, its contact (None: to be made again), and its last
    state."""

    length: float
    contact: HalfSpaceContact | None
    state: ContactState


@dataclass(frozen=True)
class LineStart:
    """Where a neighbouring speed starts from: the balance of the pilot, the ``cells`` of its lines, the further lines,
    and the change by the grid."""

    first: Balance
    cells: Cells
    used: tuple[Used, ...] = ()
    grid: tuple[GridStep, ...] = ()

    def bare(self) -> LineStart:
        """Without the parts that can be made again to the same bits."""
        return replace(self, used=tuple(replace(line, contact=None) for line in self.used))


@dataclass(frozen=True)
class LineFound:
    """The balance that follows from all lines and the correction for their grid, and what is known of its error.

    - ``first``: the balance of the pilot line, uncorrected; ``cells``: those of the lines; ``used``: the further lines.
    - ``too_coarse``: finer cells are needed.
    - ``response``: None if there is no contact; ``gap_error``: standard error of the mean gap [m] at given load.
    - ``unshared``: what joining the lines leaves open of their gap [m] (`lubfric.sampling.joined`).
    - ``missed``: contact that the lines may have missed by chance where none was found: its relative effect on f.
    - ``map_ends``: the map has no longer line.
    """

    point: Solved
    first: Balance
    cells: Cells
    together: Pooled
    response: Response | None = None
    gap_error: BlockError = BlockError(0.0, 1)
    grid: tuple[GridStep, ...] = ()
    unshared: float = 0.0
    missed: float = 0.0
    map_ends: bool = False
    too_coarse: bool = False
    used: tuple[Used, ...] = ()

    @property
    def by_half_cells(self) -> float:
        """Estimated relative change of f on cells half as long as the scene's own; NaN where they were not reached."""
        if self.response is None or not self.grid:
            return math.nan
        return self.response.relative("coefficient", mean_of(self.grid, "beyond", math.nan))

    @property
    def by_cells(self) -> float:
        """Relative change of f by the cells of the lines, for which it is corrected."""
        if self.response is None:
            return 0.0
        return self.response.relative("coefficient", mean_of(self.grid, "gap", 0.0))

    @property
    def start(self) -> LineStart:
        """The start for a neighbouring speed."""
        return LineStart(self.first, self.cells, self.used, self.grid)


def line_friction(prepared: Prepared, speed: float, start: LineStart | None = None) -> tuple[Prepared, LineFound]:
    """Solve ``prepared`` (with a long line) at ``speed`` [m/s]: on more lines until the standard error of f is within
    ``numerics.sampling_tolerance``, and on finer cells until their effect can be corrected for.

    Returns the model, with the deflection of its film chosen, and a `LineFound`. ``start``: the result for the same
    model at a neighbouring speed.
    """
    chosen, found = _on_cells(prepared, speed, start)
    while found.too_coarse:
        prepared = on_halved_cells(prepared)
        chosen, found = _on_cells(prepared, speed, found.start)
    return chosen, found


def _on_cells(prepared: Prepared, speed: float, start: LineStart | None) -> tuple[Prepared, LineFound]:
    """`line_friction` on the cells that the lines have. From a neighbour on other cells only the balance is used."""
    cells = lines_of_model(prepared).cells
    if start is not None and start.cells != cells:
        start = LineStart(start.first, cells)
    before = start.grid if start else ()
    prepared, first = solved_as_deflected(prepared, speed, start.first if start else None, given_grid=True)
    sample = Sample(prepared, speed, first).with_line(prepared.contact, first, before)
    used: tuple[Used, ...] = ()
    while (length := sample.wanted()) > 0:
        length, contact, state = _next_line(sample, length, used, start)
        if sample.anchor is None:
            found = solved(
                replace(prepared, contact=contact), speed, replace(first.balance, contact=state), given_grid=True
            )
        else:
            found = _on_line(sample, contact, state)
        sample = sample.with_line(contact, found, before)
        used = (*used, Used(length, contact, replace(found.balance.contact, fields=None)))
    return prepared, replace(_found(sample), used=used, too_coarse=sample.too_coarse)


def _next_line(sample: Sample, length: float, used: tuple[Used, ...], start: LineStart | None):
    """The next line after those ``used``: the length [m] asked for, the line, and a state to start from. It is the line
    of the neighbouring speed if that is long enough, else a new one of ``length``."""
    index, before = len(used), start.used if start is not None else ()
    known = [line.contact for line in (*used, *before) if line.contact is not None]
    if start is not None and index < len(start.used) and start.used[index].length >= length / SHORTER:
        there = start.used[index]
        return there.length, there.contact or _line(sample.prepared, index, there.length, known), there.state
    state = replace(sample.first.balance.contact, fields=None, pressure=None)
    return length, _line(sample.prepared, index, length, known), state


def _line(prepared: Prepared, index: int, length: float, known: list[HalfSpaceContact]) -> HalfSpaceContact:
    return line_contact(prepared.scene, lines_of_model(prepared).line(index + 1, length), known)


def _on_line(sample: Sample, contact, state: ContactState) -> Solved:
    """Balance on one more line. It starts from the balance of the lines so far, with level and grid of the anchor's
    film.

    The volume is closed only as tightly as `LINE_BALANCE` demands. The residual is turned into a change of the load, to
    first order: by the slope that the last two evaluations of the root give, or else by the response of the anchor.
    """
    anchor, scene = sample.known, sample.prepared.scene
    there = _lubricated(anchor)
    here = redivided(at(sample.prepared, sample.speed, anchor.contact, there), there, sample.together.contact_load)
    point = at(sample.prepared, sample.speed, contact, there)
    slope = -0.5 / (anchor.response.split * there.contact.mean_film)
    point = replace(point, settings=replace(point.settings, balance_tolerance=_looseness(sample)))
    if here.contact_load < LIGHT * scene.bodies.load:
        alone = separated(point, here.film)
        if alone.contact.volume_residual <= 0:
            return Solved(alone, anchor.point.decision, contact)
    found = balanced(point, replace(here, contact=state, slope=slope))
    found.report.raise_if_failed(found)
    return Solved(replace(found, contact_load=found.closed.contact_load), anchor.point.decision, contact)


def _looseness(sample: Sample) -> float:
    """Volume residual (G - h)/(G + h) of a further line whose correction changes f by `LINE_BALANCE` of the sampling
    tolerance, and by `MOST_CORRECTED` at most, and ln(F_H/F_C) by `MOST_MOVED`."""
    response, film = sample.known.response, sample.known.point.balance.contact.mean_film
    moved = response.per_gap("coefficient") * 2 * film  # f, per residual
    allowed = min(LINE_BALANCE * sample.prepared.scene.numerics.sampling_tolerance, MOST_CORRECTED)
    nearer = min(MOST_MOVED / abs(response.split * 2 * film), LOOSEST_LINE)
    return min(allowed / moved, nearer) if moved else nearer


def _found(sample: Sample) -> LineFound:
    together, anchor, first, cells = sample.together, sample.anchor, sample.first, sample.lines.cells
    if first.balance.film is None:
        return LineFound(first, first.balance, cells, together, sample.known.response)
    ended = sample.reached > sample.prepared.scene.numerics.sampling_tolerance and sample.lines.nested
    if anchor is None:
        return LineFound(first, first.balance, cells, together, missed=sample.missed, map_ends=ended)
    shared = sample.joined
    return LineFound(
        _divided(sample, together, shared.load),
        first.balance,
        cells,
        together,
        anchor.response,
        sample.gap_error,
        anchor.grid,
        anchor.response.gap_of_load(shared.open / shared.load),
        map_ends=ended,
    )


def _lubricated(anchor: Anchor) -> Lubricated:
    balance = anchor.point.balance.lubricated
    if balance is None:
        raise ValueError("a line without film has nothing to divide")
    return balance


def _divided(sample: Sample, together: Pooled, shared: float) -> Solved:
    """The point of the anchor, with the load divided as all lines, which carry ``shared`` [N] as one, and the grid
    demand."""
    anchor, scene = sample.known, sample.prepared.scene
    balance = _lubricated(anchor)
    whole = replace(balance, contact_load=shared, film_load=scene.bodies.load - shared)
    split = whole.split + anchor.response.split * mean_of(anchor.grid, "gap", 0.0)
    point = at(sample.prepared, sample.speed, anchor.contact, balance)
    load = divided(scene.bodies.load, split)[1]
    more, slopes = load - together.contact_load, anchor.response.slopes
    state = replace(
        balance.contact,
        contact_fraction=together.columns,
        real_contact_area_fraction=together.area_fraction,
        plastic_area_fraction=max(together.plastic_fraction + mean_of(anchor.grid, "plastic", 0.0), 0.0),
    )
    by_load = slopes.area_factor(more, scene.bodies.width, together.area_fraction)
    state = grown(state, mean_of(anchor.grid, "area", 1.0) * by_load)
    final = redivided(point, replace(balance, contact=state), load)
    film = quantities(point, final)["mean_gap"] + mean_of(anchor.grid, "film", 0.0)
    state = replace(state, mean_gap=film, mean_film=film)
    return Solved(replace(final, contact=state), anchor.point.decision, anchor.contact)
