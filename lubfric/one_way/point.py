"""Load sharing with the contact's own gap: a dry contact, one film in its gap, one root F_C + F_H = F_T.

There is no area A and no volume balance. The contact shapes the gap. The film carries what it carries there, and does
not deform it (hence one-way). Where the gap of just touching surfaces would carry more than the load, the bodies are
lifted, undeformed.
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
from ..lubricant import Lubricant, shear_stress
from ..report import Report
from ..roots import Root, increasing_root
from .film import GapFilm, gap_film
from .limit import pressure_limit

TOLERANCE = 2e-3  # of the load
SHARES, LIFTS = (-9.0, 9.0), (-9.0, 9.0)  # ln(F_H/F_C); ln(lift/scale)
PRESSED = 50e6  # Pa: a Newtonian film above it is sheared at no more than f_b p


@dataclass(frozen=True)
class OneWay:
    """One operating point. x (nx,) [m]; gap [m], pressure of the contact and of the film [Pa], closed and ruptured
    (bool), (nx, ny); forces per width [N/m]; unknown: ln(F_H/F_C) or, where the bodies are lifted, ln(lift/scale), from
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

    @property
    def ruptured(self) -> np.ndarray:
        """Where the film has ruptured (bool)."""
        return self.film.ruptured


@dataclass(frozen=True)
class Before:
    """What a first trial takes from a neighbour on the same cells."""

    ruptured: np.ndarray
    contact: None = None


def solve_one_way(problem: Problem, start: OneWay | None = None, tolerance=TOLERANCE) -> OneWay:
    """The division of the load at which contact and film in its gap carry it: |F_C + F_H - F_T| <= tolerance F_T.

    Raises `ConvergenceError` where no division does.
    """
    scale = max(float(problem.heights.std()), problem.contact.moes_film)
    touching = float(problem.rigid_gap.min())
    if start is not None:
        lifted = start.lifted
    else:
        lifted = _lifted(problem, touching, 1e-3 * scale, None).film_load > problem.load
    for lift in (lifted, not lifted):
        f = partial(_too_thick, problem, touching, scale) if lift else partial(_too_much_film, problem)
        near = start if start is not None and start.lifted == lift else None
        root = increasing_root(
            f,
            near.unknown if near else 0.0,
            step=0.7,
            bounds=LIFTS if lift else SHARES,
            tolerance=tolerance,
            slope=near.slope if near else None,
            first=(None, _before(problem, near) if near else None),
        )
        if abs(root.value) <= tolerance:
            break
    report = Report(
        "one-way load sharing", root.status, len(root.history), abs(root.value), tolerance,
        {"load": abs(root.value)}, root.history, root.payload.film.sets,
        ("the bodies are lifted off each other, undeformed",) if lift else (),
    )  # fmt: skip
    result = _result(problem, root.payload, lift, root, report)
    report.raise_if_failed(result)
    return result


def _before(problem: Problem, near: OneWay) -> Before | None:
    same = near.gap.shape == problem.heights.shape and np.allclose(near.x, problem.x, atol=1e-3 * problem.spacing[0])
    return Before(near.ruptured) if same else None


def _too_much_film(problem: Problem, split: float, last: Trial | Before | None):
    """ln of what the film should carry beside the contact, over what it does; it increases with the film's share."""
    contact_load = problem.load / (1 + math.exp(split))
    lighter = replace(problem, contact=replace(problem.contact, load_per_width=contact_load))
    dry = dry_contact(lighter, start=last.contact if last else None)
    closed = dry.pressure > 0
    gap = np.where(closed, problem.floor, np.maximum(dry.gap, problem.floor))
    trial = _filled(problem, gap, closed, contact_load, dry, last)
    wanted = problem.load - contact_load
    return math.log(wanted / trial.film_load), trial


def _too_thick(problem: Problem, touching: float, scale: float, log_lift: float, last: Trial | Before | None):
    trial = _lifted(problem, touching, scale * math.exp(log_lift), last)
    return math.log(problem.load / trial.film_load), trial


def _lifted(problem: Problem, touching: float, lift: float, last: Trial | Before | None) -> Trial:
    gap = problem.rigid_gap - touching + lift
    return _filled(problem, np.maximum(gap, problem.floor), np.zeros(gap.shape, bool), 0.0, None, last)


def _filled(problem: Problem, gap, closed, contact_load: float, dry, last: Trial | Before | None) -> Trial:
    lubricant = problem.lubricant
    plain = problem.with_lubricant(Lubricant(lubricant.viscosity, viscosity_law="constant"))
    film = gap_film(plain, gap, closed, last.ruptured if last else None)
    law = np.positive if lubricant.viscosity_law == "constant" else true_pressure(lubricant)
    limit = pressure_limit(lubricant, gap, problem.sliding, problem.boundary_friction)
    pressure = np.where(closed, 0.0, np.minimum(law(film.reduced), limit))
    carried = float(pressure.sum()) * problem.spacing[0] / gap.shape[1] + film.inlet.load
    return Trial(contact_load, dry, gap, closed, film, pressure, carried)


def _result(problem: Problem, at: Trial, lifted: bool, root: Root, report: Report) -> OneWay:
    lubricant, p, cell = problem.lubricant, at.pressure, problem.spacing[0] / at.gap.shape[1]
    wet = ~at.closed & ~at.film.ruptured
    tau = shear_stress(lubricant, p, problem.sliding / at.gap)
    if lubricant.eyring_stress is None and lubricant.limiting_stress_coefficient is None:
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
        lifted,
        root.x,
        root.slope,
        report,
    )
