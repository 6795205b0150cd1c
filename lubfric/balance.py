"""Load sharing: F_T = F_C + F_H and the lubricant volume of Eq. (8), closed by one bracketed root."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from .ehl import EHLResult
from .errors import ConvergenceError
from .patch.closure import Closure
from .report import CONVERGED, Report
from .roots import increasing_root

BOUNDS = (-40.0, 30.0)  # of ln(F_H/F_C): film shares down to 4e-18, contact shares to 1e-13
THICKER = 0.5  # less of ln(F_H/F_C) than guessed, to begin with, where a film is imposed
NEARLY_SEPARATED = 3.0  # where to look next to a speed at which the film carries everything


@dataclass(frozen=True)
class Balance:
    """One operating point in balance; film is None without entrainment. Loads in N.

    slope: of the residual over ``split``, from the last two points of the root (None: not known).
    """

    film_load: float
    contact_load: float
    film: EHLResult | None
    closure: Closure
    report: Report
    slope: float | None = None

    @property
    def split(self) -> float:
        """ln(F_H/F_C), the unknown of the root, as a start for a neighbouring speed."""
        if self.contact_load == 0:
            return NEARLY_SEPARATED
        return math.log(self.film_load / self.contact_load) if self.film_load > 0 else BOUNDS[0]


def share_load(
    total_load, solve_film, close, *, guess, tolerance, start=None, shift=0.0, touching=False, joint=None
) -> Balance:
    """Divide ``total_load`` [N] between film and contact.

    ``solve_film(load, start)`` gives the film at a load [N]; ``close(film, contact_load, start)`` the
    `Closure` of the rough contact under it. The volume residual (gap - film)/(gap + film) increases
    with the film's share, so ln(F_H/F_C) has one root; the load balance holds by construction.
    Stops at |residual| <= tolerance. ``guess``: of ln(F_H/F_C); ``start``: a neighbouring Balance, its ln(F_H/F_C)
    moved by ``shift``; ``touching``: it is known that the film of the whole load does not clear the summits.
    ``joint(film_load, contact_load, film, contact)`` gives film and closure, started from a film and a contact, where
    the film depends on the contact as well.
    """
    whole, notes = _whole(total_load, solve_film, close, tolerance, start, touching)
    if whole is not None and whole.closure.volume_residual <= 0:
        return whole
    last = {"film": start.film if start else whole and whole.film, "contact": start.closure.contact if start else None}
    seen = []

    def residual(split):
        film_load = total_load / (1 + math.exp(-split))
        contact_load = total_load / (1 + math.exp(split))
        if joint:
            film, closure = joint(film_load, contact_load, last["film"], last["contact"])
        else:
            film = solve_film(film_load, last["film"])
            closure = close(film, contact_load, last["contact"])
        last.update(film=film, contact=closure.contact)
        seen.append((split, closure.volume_residual))
        return closure.volume_residual, (film_load, contact_load, film, closure)

    root = increasing_root(
        residual,
        start.split + shift if start else guess,
        step=0.7 if start else 1.5,
        bounds=BOUNDS,
        tolerance=tolerance,
        slope=start.slope if start else None,
    )
    film_load, contact_load, film, closure = root.payload
    report = _report(root.history, root.status, tolerance, film, closure, *notes)
    return Balance(film_load, contact_load, film, closure, report, _slope(seen) or (start.slope if start else None))


def separated(total_load, solve_film, close, tolerance, start_film=None) -> Balance:
    """All the load on the film: in balance, with no contact, where its closure has a volume residual <= 0."""
    film = solve_film(total_load, start_film)
    closure = close(film, 0.0, None)
    return Balance(
        total_load,
        0.0,
        film,
        closure,
        _report([0.0], CONVERGED, tolerance, film, closure, "separated: the film clears the summits"),
    )


def _whole(total_load, solve_film, close, tolerance, start, touching):
    """`separated`, unless it is known that the summits touch, or the film of the whole load fails: then the balance
    that is found, one of a kind, is what excludes separation."""
    if touching:
        return None, ()
    try:
        return separated(total_load, solve_film, close, tolerance, start.film if start else None), ()
    except ConvergenceError as error:
        return None, (f"the film of the whole load was not solved ({error})",)


def _slope(seen) -> float | None:
    """Of the last two points; None where they tell nothing."""
    if len(seen) < 2:
        return None
    (a, fa), (b, fb) = seen[-2:]
    return (fb - fa) / (b - a) if (fb - fa) * (b - a) > 0 else None


def share_by_separation(
    total_load, solve_film, close, carry, *, guess, tolerance, start=None, shift=0.0, touching=False
) -> Balance:
    """Divide ``total_load`` [N] the paper's way: a film load gives a film, which imposed on the contact gives its load.

    ``carry(film, start)`` gives (contact load [N], `Closure`); the volume balance holds by construction and
    ln((F_C + F_H)/F_T), which increases with F_H, is brought to zero. ``close``, asked only whether the full film
    clears the surface, and the rest as in `share_load`. The search begins at thicker films than the guess: a film
    far too thin would press the contact flat.
    """
    whole, notes = _whole(total_load, solve_film, close, tolerance, start, touching)
    if whole is not None and whole.closure.volume_residual <= 0:
        return whole
    last = {"film": start.film if start else whole and whole.film, "contact": start.closure.contact if start else None}

    def residual(split):
        film_load = total_load / (1 + math.exp(-split))
        film = solve_film(film_load, last["film"])
        contact_load, closure = carry(film, last["contact"])
        last.update(film=film, contact=closure.contact or last["contact"])
        return math.log((contact_load + film_load) / total_load), (film_load, contact_load, film, closure)

    root = increasing_root(
        residual, (start.split + shift if start else guess) - THICKER, step=0.7, bounds=BOUNDS, tolerance=tolerance
    )
    film_load, contact_load, film, closure = root.payload
    report = _report(root.history, root.status, tolerance, film, closure, *notes)
    report = replace(
        report, residuals=report.residuals | {"load": min(root.history), "volume": abs(closure.volume_residual)}
    )
    return Balance(film_load, contact_load, film, closure, report)


def _report(history, status, tolerance, film, closure, *notes) -> Report:
    residuals = {"volume": history and min(history), "load": 0.0}
    if film is not None:
        residuals["film"] = film.report.residual
    if closure.contact is not None:
        residuals["contact"] = closure.contact.report.residual
    return Report(
        solver="load sharing",
        status=status,
        iterations=len(history),
        residual=min(history),
        tolerance=tolerance,
        residuals=residuals,
        history=tuple(history),
        evaluations=len(history),
        notes=tuple(notes),
    )
