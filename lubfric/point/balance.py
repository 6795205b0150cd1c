"""Load sharing: F_T = F_C + F_H and the lubricant volume of Eq. (8), closed by one bracketed root."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial

from ..errors import ConvergenceError
from ..film.contract import Film, FilmLevel
from ..model import Model
from ..report import CONVERGED, Report
from ..roots import increasing_root
from ..rough.contract import ContactState
from . import total_pressure
from .operating_point import OperatingPoint, Trial

BOUNDS = (-40.0, 30.0)  # of ln(F_H/F_C): film shares down to 4e-18, contact shares to 1e-13
THICKER = 0.5  # less of ln(F_H/F_C) than guessed, to begin with, where a film is imposed
NEARLY_SEPARATED = 3.0  # where to look next to a speed at which the film carries everything
FIRST_STEP, NEIGHBOUR_STEP = 1.5, 0.7  # of ln(F_H/F_C)


@dataclass(frozen=True)
class Balance:
    """One operating point in balance, loads in N; film and its level are None without entrainment.

    slope: of the residual over ``split``, from the last two points of the root (None: not known).
    """

    film_load: float
    contact_load: float
    film: Film | None
    contact: ContactState
    report: Report
    slope: float | None = None
    level: FilmLevel | None = None

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

    def moved(self, step: float) -> Balance:
        """The loads divided as if ``split`` were larger by ``step``; film and contact as they were."""
        film_load, contact_load = divided(self.film_load + self.contact_load, self.split + step)
        return replace(self, film_load=film_load, contact_load=contact_load)


def divided(load: float, split: float) -> tuple[float, float]:
    """(F_H, F_C) of ``load`` at split = ln(F_H/F_C)."""
    return load / (1 + math.exp(-split)), load / (1 + math.exp(split))


def balanced(point: OperatingPoint, start: Balance | None = None) -> Balance:
    """The division of the load at which film and contact agree, the way ``numerics.closure`` asks for.

    "load": the residual (gap - film)/(gap + film) of the volume increases with the film's share, so ln(F_H/F_C) has one
    root; the load balance holds by construction. "separation", the paper's way: the film of a film load, imposed on the
    contact, gives its load; ln((F_C + F_H)/F_T), which increases with F_H, is brought to zero and the volume holds by
    construction. Where the film of the whole load clears the summits it carries it all. Stops at |residual| <=
    settings.volume_tolerance. ``start``: a neighbour, its split moved as if a film at the same gap carried in proportion
    to its speed.
    """
    whole, notes = _whole(point, start)
    if whole is not None and whole.contact.volume_residual <= 0:
        found = whole
    elif point.scene.numerics.closure == "load":
        found = _balanced_volume(point, _first(start, whole), start, notes)
    else:
        found = _balanced_load(point, _first(start, whole), start, notes)
    return total_pressure.told(point.scene, found) if point.scene.numerics.film_deflection == "total" else found


def separated(point: OperatingPoint, start: Film | None = None) -> Balance:
    """All the load on the film: in balance, with no contact, where the volume residual of its contact is <= 0."""
    load = point.scene.bodies.load
    return _separated(point, point.with_contact(0.0, point.with_film(load, Trial(film=start))))


def dry(model: Model) -> Balance:
    """No film: the contact carries the whole load under the undeformed cylinder."""
    bodies = model.scene.bodies
    contact = model.contact.close(model.contact.x**2 / (2 * bodies.radius), bodies.load)
    report = Report(
        "load sharing",
        CONVERGED,
        0,
        0.0,
        model.scene.numerics.volume_tolerance,
        residuals={"volume": 0.0, "load": 0.0},
        notes=("no entrainment: all contact",),
    )
    return Balance(0.0, bodies.load, None, contact, report)


def volume_residual(point: OperatingPoint, split: float, last: Trial) -> tuple[float, Trial]:
    """That of the contact solved at its share of the load under the film solved at its own."""
    film_load, contact_load = divided(point.scene.bodies.load, split)
    if point.scene.numerics.film_deflection == "total":
        found = total_pressure.film_and_contact(point, film_load, contact_load, last)
    else:
        found = point.with_contact(contact_load, point.with_film(film_load, last))
    return found.contact.volume_residual, found


def load_residual(point: OperatingPoint, split: float, last: Trial) -> tuple[float, Trial]:
    """ln((F_C + F_H)/F_T) of the film solved at its share of the load and imposed on the contact."""
    load = point.scene.bodies.load
    found = point.with_imposed_film(point.with_film(divided(load, split)[0], last))
    value = math.log((found.contact_load + found.film_load) / load)
    return value, found


def _balanced_volume(point: OperatingPoint, first: Trial, start: Balance | None, notes) -> Balance:
    root = increasing_root(
        partial(volume_residual, point),
        _split(point, start),
        step=NEIGHBOUR_STEP if start else FIRST_STEP,
        bounds=BOUNDS,
        tolerance=point.settings.volume_tolerance,
        slope=start.slope if start else None,
        first=first,
    )
    found, report = root.payload, _report(point, root.payload, root.history, root.status, notes)
    slope = root.slope or (start.slope if start else None)
    return Balance(found.film_load, found.contact_load, found.film, found.contact, report, slope, point.settings.level)


def _balanced_load(point: OperatingPoint, first: Trial, start: Balance | None, notes) -> Balance:
    """The search begins at thicker films than the guess: a film far too thin would press the contact flat."""
    root = increasing_root(
        partial(load_residual, point),
        _split(point, start) - THICKER,
        step=NEIGHBOUR_STEP,
        bounds=BOUNDS,
        tolerance=point.settings.volume_tolerance,
        first=first,
    )
    found, report = root.payload, _report(point, root.payload, root.history, root.status, notes)
    residuals = {"load": min(root.history), "volume": abs(found.contact.volume_residual)}
    report = replace(report, residuals=report.residuals | residuals)
    return Balance(found.film_load, found.contact_load, found.film, found.contact, report, level=point.settings.level)


def _whole(point: OperatingPoint, start: Balance | None) -> tuple[Balance | None, tuple[str, ...]]:
    """`separated`, unless it is known that the summits touch, or the film of the whole load fails: then the balance
    that is found, one of a kind, is what excludes separation."""
    if point.settings.touching:
        return None, ()
    try:
        return separated(point, start.film if start else None), ()
    except ConvergenceError as error:
        return None, (f"the film of the whole load was not solved ({error})",)


def _first(start: Balance | None, whole: Balance | None) -> Trial:
    """What the first trial starts from: a neighbour, or the film of the whole load."""
    solved = () if whole is None else (whole.film.cells,)
    if start is not None:
        return Trial(film=start.film, start=start.contact, solved=solved)
    return Trial(film=None if whole is None else whole.film, solved=solved)


def _split(point: OperatingPoint, start: Balance | None) -> float:
    """Where the search begins."""
    if start is None:
        return point.guessed_split()
    if start.film is None or start.film.entrainment_speed == 0:
        return start.split
    return start.split + math.log(abs(point.speed / start.film.entrainment_speed))


def _separated(point: OperatingPoint, found: Trial) -> Balance:
    report = _report(point, found, [0.0], CONVERGED, ("separated: the film clears the summits",))
    return Balance(found.film_load, 0.0, found.film, found.contact, report, level=point.settings.level)


def _report(point: OperatingPoint, found: Trial, history, status: str, notes) -> Report:
    residuals = {"volume": history and min(history), "load": 0.0, "film": found.film.report.residual}
    if found.contact.fields is not None:
        residuals["contact"] = found.contact.fields.report.residual
    return Report(
        solver="load sharing",
        status=status,
        iterations=len(history),
        residual=min(history),
        tolerance=point.settings.volume_tolerance,
        residuals=residuals,
        history=tuple(history),
        evaluations=len(history),
        notes=tuple(notes),
    )
