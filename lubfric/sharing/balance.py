"""Load sharing: one bracketed root closes F_T = F_C + F_H and the balance of lubricant volume, Eq. (8)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial
from typing import Self

from .._base import Root, increasing_root
from ..contact import ContactState
from ..errors import CONVERGED, ITERATION_LIMIT, Report
from ..film import Film, FilmLevel
from . import total_pressure
from .forces import Forces, forces
from .operating_point import OperatingPoint, Start, Trial
from .split import BOUNDS, divided, foretold_split

THICKER = 0.5  # less of ln(F_H/F_C) than guessed, to begin with, where a film is imposed
NEARLY_SEPARATED = 3.0  # where to look next to a speed at which the film carries everything
SPLIT, FLATTEST, ROOTS = 4.0, 0.1, 4  # of ln(F_H/F_C), where a film is imposed; a slope not known; searches
LARGEST_DRIFT = 0.3  # of ln(F_H/F_C), that one step between speeds is taken to miss like the one before
LIGHTER = 0.05  # relative step of a load
FIRST_STEP, NEXT_STEP = 1.5, 0.7  # of ln(F_H/F_C): from a guess, and from a neighbour or a guess on the safe side


@dataclass(frozen=True)
class Balance:
    """One operating point in balance, loads in N. ``film`` and its ``level`` are None without entrainment.

    - ``slope``: d residual/d ``split``, from the last two points of the root, or predicted (None: not known).
      ``gap_slope``: the same, or less, from what was solved alone (None: not known).
    - ``states``: the contact on each grid on the way here, the coarsest first. A neighbour starts from them.
    - ``coarse``: volume residual on the first of these grids less that on the last, under the same film.
    - ``drift``: by how much the prediction of ``split`` from the speed before was too low, over the ln of the ratio of
      the two speeds.
    """

    film_load: float
    contact_load: float
    film: Film | None
    contact: ContactState
    report: Report
    forces: Forces
    level: FilmLevel | None
    slope: float | None = None
    states: tuple[ContactState, ...] = ()
    coarse: float = 0.0
    drift: float = 0.0
    gap_slope: float | None = None

    @property
    def closure(self) -> ContactState:
        """``contact``, by the name it had up to version 0.1."""
        return self.contact

    @property
    def split(self) -> float:
        """ln(F_H/F_C), the unknown of the root, as a start for a neighbouring speed."""
        if self.contact_load == 0:
            return NEARLY_SEPARATED
        return math.log(self.film_load / self.contact_load) if self.film_load > 0 else BOUNDS[0]

    @property
    def gap_sensitivity(self) -> float:
        """`Forces.gap_sensitivity`. Without a ``gap_slope`` an error of the gap counts like one of the film: a
        predicted slope says nothing about a light contact, whose residual may depend on the film alone."""
        return self.forces.gap_sensitivity

    @property
    def lubricated(self) -> Lubricated | None:
        """This balance if it has a film, else None."""
        return None

    @property
    def closed(self) -> Self:
        """The balance with the loads at which its volume residual would be zero, by the slope."""
        return self.moved(-self.contact.volume_residual / self.slope) if self.slope and self.contact_load > 0 else self

    def moved(self, step: float) -> Self:
        """The loads divided as if ``split`` were larger by ``step``; film and contact stay as they are."""
        film_load, contact_load = divided(self.film_load + self.contact_load, self.split + step)
        return replace(self, film_load=film_load, contact_load=contact_load)


@dataclass(frozen=True)
class Lubricated(Balance):
    """A balance with a film."""

    film: Film
    level: FilmLevel

    @property
    def lubricated(self) -> Lubricated:
        """This balance."""
        return self

    @property
    def trial(self) -> Trial:
        """Film and contact as a point of the root."""
        touched = None if self.contact.pressure is None else self.contact
        return Trial(
            film=self.film,
            contact=self.contact,
            film_load=self.film_load,
            contact_load=self.contact_load,
            touched=touched,
            solved=(self.film.cells,),
        )


def balanced(point: OperatingPoint, start: Balance | None = None, known: Trial | None = None) -> Lubricated:
    """Find the division of the load at which film and contact agree, by the closure ``numerics.closure``.

    - "load": the residual (gap - film)/(gap + film) of the volume increases with the film's share. So there is one root
      in ln(F_H/F_C). The load balance holds by construction.
    - "separation", the paper's way: the film of a film load is imposed on the contact, which gives the contact load.
      ln((F_C + F_H)/F_T) increases with F_H and is brought to zero. The volume balance holds by construction.

    Stops at |residual - settings.aim| <= settings.balance_tolerance. ``start``: a neighbour, from which
    `lubfric.sharing.split` predicts this balance. ``known``: film and contact of this point at the split of ``start``,
    for the closure by load. That the summits touch is either known before, or shown by the root.
    """
    by_load = point.scene.numerics.closure == "load"
    first = Start() if start is None else Start(start.film, start.contact)
    begin, foretold = (point.guessed_split(), None) if start is None else _begin(point, start)
    if by_load:
        root = increasing_root(
            partial(volume_residual, point),
            begin,
            step=FIRST_STEP if start is None else NEXT_STEP,
            bounds=(_heaviest(point), BOUNDS[1]),
            tolerance=point.settings.balance_tolerance,
            slope=foretold,
            first=(None, first) if known is None else (known.contact.volume_residual - point.settings.aim, known),
        )
    else:
        root = _imposed(point, begin - THICKER, first)
    found = root.payload
    residuals = {"volume": min(root.history), "load": 0.0}
    if not by_load:
        residuals = {"volume": abs(found.contact.volume_residual), "load": min(root.history)}
    if not by_load:
        return _balance(point, found, residuals, root.history, root.status, ())
    slope = root.slope or foretold
    gap_slope = slope if len(root.history) > 1 else _slope_of_contact(point, found)
    return _balance(point, found, residuals, root.history, root.status, (), slope, gap_slope)


def _heaviest(point: OperatingPoint) -> float:
    """The split at which the contact carries all that it can."""
    load, most = point.scene.bodies.load, point.contact.capacity
    return max(math.log((load - most) / most), BOUNDS[0]) if most < load else BOUNDS[0]


def _slope_of_contact(point: OperatingPoint, found: Trial) -> float | None:
    """d residual/d ``split`` under the same film, where the contact is read from a curve. A film gets thinner with its
    load, so the slope of both together is larger. None: it takes a solve, or the contact is full."""
    gap, load = found.contact.mean_gap, found.contact_load
    if not point.contact.nominally_flat or not load or gap <= 0:
        return None
    lighter = point.contact.close(found.film.film_at(point.contact.x), (1 - LIGHTER) * load)
    return 0.5 * (lighter.mean_gap / gap - 1) / LIGHTER * found.film_load / (load + found.film_load)


def separated(point: OperatingPoint, start: Film | None = None) -> Lubricated:
    """The balance with all the load on the film, if the surfaces are separated: the volume residual of the unloaded
    contact is <= 0."""
    found = point.trial(point.scene.bodies.load, 0.0, Start(start))
    notes = ("separated: the film clears the summits",)
    return _balance(point, found, {"volume": 0.0, "load": 0.0}, (0.0,), CONVERGED, notes)


def volume_residual(point: OperatingPoint, split: float, last: Start) -> tuple[float, Trial]:
    """Volume residual of a trial (film and contact each at its own share of the load), less the residual aimed at."""
    film_load, contact_load = divided(point.scene.bodies.load, split)
    if point.scene.numerics.film_deflection == "total":
        found = total_pressure.film_and_contact(point, film_load, contact_load, last)
    else:
        found = point.trial(film_load, contact_load, last)
    return found.contact.volume_residual - point.settings.aim, found


def load_residual(point: OperatingPoint, split: float, last: Start) -> tuple[float, Trial]:
    """ln((F_C + F_H)/F_T) of the film at its share of the load, and of the contact on which it is imposed."""
    load = point.scene.bodies.load
    found = point.trial_with_imposed_film(divided(load, split)[0], last)
    return math.log((found.contact_load + found.film_load) / load), found


def _imposed(point: OperatingPoint, begin: float, first: Start) -> Root:
    """The root of `load_residual`. Where the contact gains what the film loses, the sum of the loads hardly tells the
    division. So the search also goes on until residual/slope is within `SPLIT` of the tolerance, or until it fails."""
    tolerance, value, x, last = point.settings.balance_tolerance, None, begin, first
    before: tuple[float, ...] = ()
    for _ in range(ROOTS):
        root = increasing_root(
            partial(load_residual, point), x, step=NEXT_STEP, bounds=BOUNDS, tolerance=tolerance, first=(value, last)
        )
        root = replace(root, history=(*before, *root.history[bool(before) :]))
        needed = SPLIT * point.settings.balance_tolerance * abs(root.slope or FLATTEST)
        if point.scene.numerics.balance_tolerance is not None or abs(root.value) <= needed or root.status != CONVERGED:
            return root
        tolerance, value, x, last, before = needed, root.value, root.x, root.payload, root.history
    return replace(root, status=ITERATION_LIMIT)


def _begin(point: OperatingPoint, start: Balance) -> tuple[float, float | None]:
    """The split at which this balance is expected, from that of ``start``, and the slope of the residual there."""
    if start.film is None or start.film.entrainment_speed == 0:
        return start.split, start.slope
    split, slope = foretold_split(point, start.film.entrainment_speed, start.split, start.slope)
    again = start.drift * math.log(abs(point.speed / start.film.entrainment_speed))
    return split + min(max(again, -LARGEST_DRIFT), LARGEST_DRIFT), slope


def drift(point: OperatingPoint, start: Balance, found: Balance) -> float:
    """`Balance.drift` of what was ``found`` from ``start``. The error of the prediction is much the same from one speed
    to the next near full film, and under loads that deflect the film."""
    if start.film is None or start.contact_load == 0 or found.contact_load == 0:
        return 0.0
    before = start.film.entrainment_speed
    step = math.log(abs(point.speed / before)) if before else 0.0
    if not step:
        return start.drift
    foretold = foretold_split(point, before, start.closed.split, start.slope)[0]
    return (found.closed.split - foretold) / step


def _balance(
    point: OperatingPoint, found: Trial, residuals, history, status, notes, slope=None, gap_slope=None
) -> Lubricated:
    residuals = residuals | {"film": found.film.report.residual}
    if found.contact.fields is not None:
        residuals["contact"] = found.contact.fields.report.residual
    if point.scene.numerics.film_deflection == "total":
        residuals |= total_pressure.residuals(point.scene, found)
        notes = (*notes, *total_pressure.notes(point.scene, found))
    report = Report(
        solver="load sharing",
        status=status,
        iterations=len(history),
        residual=min(history),
        tolerance=point.settings.balance_tolerance,
        residuals=residuals,
        history=tuple(history),
        evaluations=len(history),
        notes=tuple(notes),
    )
    level = point.settings.level
    return Lubricated(
        film_load=found.film_load,
        contact_load=found.contact_load,
        film=found.film,
        contact=found.contact,
        report=report,
        forces=forces(point.scene, level, found, slope, gap_slope),
        level=level,
        slope=slope,
        gap_slope=gap_slope,
    )
