"""The lines solved so far, and whether they are enough."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from ..contact import HalfSpaceContact
from ..scene import budget
from ..sharing import LONGEST, MOST, MOST_CELLS, PAIR, Balance, Lines, Prepared, Solved, divided, next_length
from .at_split import at, grown, quantities, redivided
from .grid_pair import FEWEST, GridStep, gap_left, grid_step, lost_summits, mean_error, mean_of, second_order
from .influence import BlockError, add_errors
from .joined import Joined, joined
from .line_record import LineRecord, Pooled, length_of, pooled, record
from .missed import hidden_share, missed_share
from .response import Response, respond, slopes_of
from .uncertainty import too_few

MOST_PAIRS, PAIR_SHARE = 12, 0.5  # of the sampling tolerance
KEPT = 0.5  # of the share of the grid: what pieces taken at a neighbouring speed may leave open
LEAST_MORE = 0.25  # of the length so far
FARTHEST = 0.5  # of ln(F_H/F_C), by which what the cells change may be corrected
CLOSE = 1.0  # Sq: clearance below which summits may be lost to the cells of a line


@dataclass(frozen=True)
class Anchor:
    """The first line in contact. Its response is used for all lines. ``grid``: the effect of its cells."""

    contact: HalfSpaceContact
    point: Solved
    response: Response
    grid: tuple[GridStep, ...]


@dataclass(frozen=True)
class Sample:
    """Lines of ``prepared``, solved at one speed. ``first``: that of the pilot; ``anchor``: the first in contact."""

    prepared: Prepared
    speed: float
    first: Solved
    records: tuple[LineRecord, ...] = ()
    anchor: Anchor | None = None

    @property
    def lines(self) -> Lines:
        """The lines of the model."""
        return lines_of_model(self.prepared)

    @property
    def known(self) -> Anchor:
        """The anchor, if a line touches."""
        if self.anchor is None:
            raise ValueError("no line touches yet")
        return self.anchor

    @property
    def together(self) -> Pooled:
        """All lines, pooled."""
        return pooled(self.records)

    @property
    def joined(self) -> Joined:
        """The contact load of all lines as one."""
        lengths, loads = zip(*((r.length, r.contact_load) for r in self.records))
        return joined(lengths, loads, self.prepared.scene.bodies.load, self.known.response.film_exponent)

    @property
    def reached(self) -> float:
        """Relative standard error of f so far."""
        if self.first.balance.film is None:
            return 0.0
        if self.anchor is None:
            return self.missed
        return self.anchor.response.relative("coefficient", self.gap_error.error)

    @property
    def gap_error(self) -> BlockError:
        """Standard error of the mean gap [m] at given load, by all lines and by the effect of their cells."""
        return add_errors(self.together.gap, mean_error(self.known.grid))

    @property
    def doubted(self) -> float:
        """`reached`, made larger if there is only the first line.

        A standard error from few blocks is itself known to 1/sqrt(2 nu) only, with nu degrees of freedom. If a line
        counted as long enough whenever its blocks happen to scatter little, the stated error would be too small. So the
        first line counts as long enough only if even 1 + 1/sqrt(nu) times its error is within what is asked.
        """
        if self.anchor is None or len(self.records) > 1:
            return self.reached
        return self.reached * (1 + 1 / math.sqrt(max(self.gap_error.freedom, 1)))

    @property
    def missed(self) -> float:
        """Contact that lines without any may have missed by chance: its relative effect on f, from the summits of the
        pilot and the length of all lines."""
        prepared, first = self.prepared, self.first
        found = missed_share(prepared, first.balance.film, first.balance.forces, self.lines.lengths[1])
        found = found if math.isfinite(found) else math.inf  # too short to tell
        return found * length_of(prepared.contact) / sum(r.length for r in self.records)

    @property
    def few(self) -> bool:
        """Whether so few spots carry the load that the interval would be too narrow, if that matters."""
        asked = self.prepared.scene.numerics.sampling_tolerance
        return self.anchor is not None and too_few(self.together.participation, self.reached, asked)

    @property
    def too_coarse(self) -> bool:
        """Whether the cells of the lines change the division of the load by more than can be corrected, or f by more
        than is allowed beyond first order. That is judged by the anchor or, where the film clears the summits, by the
        summits that the cells cut off."""
        if self.lines.cells.factors == (1, 1) or self.first.balance.film is None:
            return False
        if self.anchor is None:
            return len(self.records) == 1 and self._summits_lost
        response, grid = self.anchor.response, self.anchor.grid
        left = response.relative("coefficient", second_order(grid, response.split))
        allowed = budget.CONTACT_GRID * self.prepared.scene.numerics.tolerance
        return left > allowed or abs(response.split * mean_of(grid, "gap", 0.0)) > FARTHEST

    @cached_property
    def _summits_lost(self) -> bool:
        """Whether the surface on the scene's own cells would touch under the film of the pilot by more than f allows: a
        piece of it has a summit that is higher than on the cells of the lines by more than its clearance."""
        prepared, balance = self.prepared, self.first.balance.lubricated
        if balance is None:
            return False
        clearance = balance.contact.mean_film - balance.contact.mean_gap
        if clearance > CLOSE * prepared.surface.sq:
            return False
        point = at(prepared, self.speed, prepared.contact, balance)
        piece = self.lines.pair(0, PAIR * self.lines.lengths[1])
        depth = lost_summits(self.lines, piece, point, balance.film) - clearance
        allowed = budget.CONTACT_GRID * prepared.scene.numerics.tolerance
        return depth > 0 and hidden_share(prepared, balance.forces, piece, depth) > allowed

    def wanted(self) -> float:
        """Length [m] of the next line; 0 if no more is needed, or there is no more."""
        lines, asked, so_far = self.lines, self.prepared.scene.numerics.sampling_tolerance, self.together.length
        room = min(lines.available, MOST * lines.lengths[1]) - so_far
        reached = self.doubted
        if self.too_coarse or room < LEAST_MORE * so_far or (reached <= asked and not self.few):
            return 0.0
        contact: Any = self.prepared.contact  # of half-spaces, on the cells of the line
        held = MOST_CELLS / contact.heights.shape[0] * contact.spacing[1]
        more = next_length(so_far, max(reached, asked), asked, min(LONGEST * lines.lengths[1], held, room))
        return so_far + more if lines.nested else more

    def with_line(self, contact, point: Solved, before: tuple[GridStep, ...] = ()) -> Sample:
        """The sample with one more line. A longer line of a measured map replaces the shorter one. ``before``: the
        effect of the grid at a neighbouring speed."""
        lines, balance, length = self.lines, point.balance, length_of(contact)
        kept = () if lines.nested else self.records
        if balance.contact_load == 0:
            return replace(self, records=(*kept, LineRecord(length)))
        anchor = self.anchor or _anchor(self.prepared, self.speed, contact, point, before)
        found = record(
            contact,
            balance.contact,
            balance.contact_load,
            anchor.response.slopes,
            lines.lengths[1],
            lines.windows(length),
            exact_sq=lines.exact_sq,
        )
        return replace(self, records=(*kept, found), anchor=anchor)


def lines_of_model(prepared: Prepared) -> Lines:
    """The source of the line of ``prepared``, for more lines."""
    if prepared.lines is None:
        raise ValueError("a model of one patch has no further lines")
    return prepared.lines


def _anchor(prepared, speed: float, contact, point: Solved, before) -> Anchor:
    response = response_of(prepared, speed, contact, point.balance)
    return Anchor(contact, point, response, _grid(prepared, speed, point, response, before))


def response_of(prepared, speed: float, contact, balance: Balance) -> Response:
    """`Response` of a balance on ``contact``."""
    scene, wet = prepared.scene, balance.lubricated
    if wet is None:
        thickness = under = contact.x**2 / (2 * scene.bodies.radius)
    else:
        point = at(prepared, speed, contact, wet)
        thickness, under = point.film_on(contact, wet.film)

    def close(load):
        return contact.close(thickness, load, balance.contact, under)

    slopes = slopes_of(balance.contact, balance.contact_load, scene.bodies.width, close)
    if wet is None:
        return Response(slopes)

    def at_split(split):
        load = divided(scene.bodies.load, split)[1]
        area = slopes.area_factor(load - wet.contact_load, scene.bodies.width, wet.contact.real_contact_area_fraction)
        return quantities(point, redivided(point, replace(wet, contact=grown(wet.contact, area)), load))

    return respond(scene.bodies.width, balance, slopes, at_split)


def _grid(prepared, speed: float, found: Solved, response: Response, before) -> tuple[GridStep, ...]:
    """Compare pieces on finer cells, until their scatter is a small part of the sampling tolerance. Those of a
    neighbouring speed are used if they are enough at this load too."""
    lines, numerics, balance = lines_of_model(prepared), prepared.scene.numerics, found.balance.lubricated
    if lines.cells.factors == (1, 1) or balance is None:
        return ()
    load = balance.contact_load
    per_gap = response.per_gap("coefficient")
    enough = budget.CONTACT_GRID * numerics.tolerance / per_gap
    scatter = PAIR_SHARE * numerics.sampling_tolerance / per_gap
    most = min(MOST_PAIRS, lines.pieces)
    near = tuple(step.at_load(load) for step in before)
    if near and _settled(near, most, scatter) and gap_left(near) <= KEPT * enough:
        return near
    steps: list[GridStep] = []
    point = at(prepared, speed, found.contact, balance)
    while not _settled(steps, most, scatter):
        length = PAIR * lines.lengths[1]
        steps.append(grid_step(lines, len(steps), length, point, balance.film, load, response.slopes.gap, enough))
    return tuple(steps)


def _settled(steps, most: float, scatter: float) -> bool:
    """Whether these pieces are enough: the error of their mean is within ``scatter`` [m], there are no more pieces, or
    there are three that are too short for blocks."""
    short = len(steps) >= FEWEST and not math.isfinite(steps[0].error.error)
    return len(steps) > 0 and (short or len(steps) >= most or mean_error(steps).error <= scatter)
