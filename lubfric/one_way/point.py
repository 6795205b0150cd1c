"""Load sharing with the contact's own gap: a dry contact, one film in its gap, one root F_C + F_H = F_T.

There is no area A and no volume balance. The contact shapes the gap, and the film on its spots lifts it (`lift`). The
film carries what it carries there, and does not deform it (hence one-way). Where the gap of just touching surfaces,
with the film that the first summit keeps, would carry more than the load, the bodies are lifted further, undeformed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..contact import ContactResult
from ..deterministic.problem import Problem
from ..deterministic.start import dry_contact
from ..film.rigid import true_pressure
from ..lubricant import shear_stress
from ..report import Report
from ..roots import Root, increasing_root
from .film import GapFilm, gap_film
from .lift import GUESS, Lifted, lifted, spots_of, surplus
from .limit import pressure_limit

TOLERANCE = 2e-3  # of the load
SHARES, LIFTS = (-9.0, 9.0), (-9.0, 9.0)  # ln(F_H/F_C); ln(lift/scale)
PRESSED = 50e6  # Pa: a Newtonian film above it is sheared at no more than f_b p


@dataclass(frozen=True)
class OneWay:
    """One operating point. x (nx,) [m]; gap [m], pressure of the contact and of the film [Pa], closed and ruptured
    (bool), (nx, ny); forces per width [N/m]; spot_film [m]: that on the spots of the
    contact, by which its gap is lifted; unknown: ln(F_H/F_C) or, where the bodies are lifted, ln(lift/scale), from
    which a neighbour starts, and slope of the balance over it (None: not known)."""

    x: np.ndarray
    gap: np.ndarray
    contact_pressure: np.ndarray
    film_pressure: np.ndarray
    closed: np.ndarray
    ruptured: np.ndarray
    contact_load: float
    film_load: float
    boundary: float
    couette: float
    rolling: float
    lifted: bool
    spot_film: float
    unknown: float
    slope: float | None
    report: Report

    @property
    def coefficient(self) -> float:
        """f [-]."""
        return (self.boundary + self.couette + self.rolling) / (self.contact_load + self.film_load)


@dataclass(frozen=True)
class Trial:
    """A gap, what the contact carries in it, and its film."""

    contact_load: float
    contact: ContactResult | None
    gap: np.ndarray
    closed: np.ndarray
    film: GapFilm
    pressure: np.ndarray
    film_load: float
    spot_film: float

    @property
    def ruptured(self) -> np.ndarray:
        """Where the film has ruptured (bool)."""
        return self.film.ruptured


@dataclass(frozen=True)
class Before:
    """What a first trial takes from a neighbour; where the film has ruptured if it is on the same cells."""

    ruptured: np.ndarray | None
    spot_film: float
    contact: None = None


def solve_one_way(problem: Problem, start: OneWay | None = None, tolerance=TOLERANCE) -> OneWay:
    """The division of the load at which contact and film in its gap carry it: |F_C + F_H - F_T| <= tolerance F_T.

    Raises `ConvergenceError` where no division does.
    """
    first = start.lifted if start is not None else _touching_film(problem).film_load > problem.load
    tried = []
    for apart in (first, not first):
        root = _root(problem, apart, start if start is not None and start.lifted == apart else None, tolerance)
        tried.append((apart, root))
        if abs(root.value) <= tolerance and not (apart and _presses(problem, root.payload)):
            break
    else:
        apart, root = min(tried, key=lambda one: abs(one[1].value))
    report = Report(
        "one-way load sharing", root.status, len(root.history), abs(root.value), tolerance,
        {"load": abs(root.value)}, root.history, root.payload.film.sets,
        ("the bodies are lifted off each other, undeformed",) if apart else (),
    )  # fmt: skip
    result = _result(problem, root.payload, apart, root, report)
    report.raise_if_failed(result)
    return result


def _root(problem: Problem, apart: bool, near: OneWay | None, tolerance: float) -> Root:
    """Of the load over the lift of bodies that are ``apart``, or over the film's share of it."""
    return increasing_root(
        partial(_too_thick, problem) if apart else partial(_too_much_film, problem),
        near.unknown if near else 0.0,
        step=0.7,
        bounds=LIFTS if apart else SHARES,
        tolerance=tolerance,
        slope=near.slope if near else None,
        first=(None, _before(problem, near) if near else None),
    )


def _before(problem: Problem, near: OneWay) -> Before:
    same = near.gap.shape == problem.heights.shape and np.allclose(near.x, problem.x, atol=1e-3 * problem.spacing[0])
    return Before(near.ruptured if same else None, near.spot_film)


def _too_much_film(problem: Problem, split: float, last: Trial | Before | None):
    """ln of what the film should carry beside the contact, over what it does; it increases with the film's share."""
    contact_load = problem.load / (1 + math.exp(split))
    lighter = replace(problem, contact=replace(problem.contact, load_per_width=contact_load))
    dry = dry_contact(lighter, start=last.contact if last else None)
    gap = np.where(dry.pressure > 0, 0.0, np.maximum(dry.gap, 0.0))
    spots = spots_of(dry.pressure)
    raised = lifted(problem, gap, spots, last.spot_film or None, last.ruptured) if last else lifted(problem, gap, spots)
    trial = _filled(problem, raised, dry.pressure > 0, contact_load, dry)
    wanted = problem.load - contact_load
    return math.log(wanted / trial.film_load), trial


def _too_thick(problem: Problem, log_lift: float, last: Trial | Before | None):
    scale = max(float(problem.heights.std()), problem.contact.moes_film)
    trial = _lifted(problem, scale * math.exp(log_lift), last)
    return math.log(problem.load / trial.film_load), trial


def _lifted(problem: Problem, lift: float, last: Trial | Before | None) -> Trial:
    gap = np.maximum(problem.rigid_gap - problem.rigid_gap.min() + lift, problem.floor)
    film = gap_film(problem, gap, last.ruptured if last else None)
    return _filled(problem, Lifted(gap, film, 0.0), np.zeros(gap.shape, bool), 0.0, None)


def _touching_film(problem: Problem) -> Trial:
    """With the film that the first summit is taken to keep."""
    return _lifted(problem, max(GUESS * problem.contact.moes_film, problem.floor), None)


def _presses(problem: Problem, trial: Trial) -> bool:
    """Whether the highest summit of bodies that are apart should carry: its film is too thin for its flow."""
    height = float(trial.gap.min())
    return surplus(problem, spots_of(trial.gap == height), height, trial.film) < 0


def _filled(problem: Problem, raised: Lifted, closed, contact_load: float, dry) -> Trial:
    lubricant, gap, film = problem.lubricant, raised.gap, raised.film
    limit = pressure_limit(lubricant, gap, problem.sliding, problem.boundary_friction)
    pressure = np.where(closed, 0.0, np.minimum(true_pressure(lubricant)(film.reduced), limit))
    carried = float(pressure.sum()) * problem.spacing[0] / gap.shape[1] + film.inlet.load
    return Trial(contact_load, dry, gap, closed, film, pressure, carried, raised.height)


def _result(problem: Problem, at: Trial, apart: bool, root: Root, report: Report) -> OneWay:
    lubricant, p, cell = problem.lubricant, at.pressure, problem.spacing[0] / at.gap.shape[1]
    wet = ~at.closed & ~at.film.ruptured
    tau = shear_stress(lubricant, p, problem.sliding / at.gap)
    if lubricant.newtonian:
        tau = np.where(p > PRESSED, np.minimum(tau, problem.boundary_friction * p), tau)
    inlet = at.film.inlet
    film_faces = ~at.closed[1:] & ~at.closed[:-1]
    rolling = 0.25 * (at.gap[1:] + at.gap[:-1]) * (p[1:] - p[:-1])
    return OneWay(
        problem.x,
        at.gap,
        np.zeros(p.shape) if at.contact is None else at.contact.pressure,
        p,
        at.closed,
        at.film.ruptured,
        at.contact_load,
        at.film_load,
        problem.boundary_friction * at.contact_load,
        float(tau[wet].sum()) * cell + lubricant.viscosity * problem.sliding * inlet.shearing,
        float(rolling[film_faces].sum()) / p.shape[1] + inlet.rolling,
        apart,
        at.spot_film,
        root.x,
        root.slope,
        report,
    )
