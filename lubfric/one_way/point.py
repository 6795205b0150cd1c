"""Load sharing in the contact's own gap: a dry contact, one film in its gap, and one root F_C + F_H = F_T.

There is no area A and no volume balance. The contact shapes the gap, and the film on its spots lifts it (`lift`). The
film does not deform the gap (hence one-way). If just touching surfaces, lifted by the film that the first summit keeps,
would carry more than the load, the bodies are lifted off each other, undeformed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from .._base import Root, increasing_root
from ..deterministic import Problem
from ..errors import CONVERGED, Report
from ..oil import shear_stress
from .film import Kept
from .lift import GUESS
from .lift import TOLERANCE as LIFT_TOLERANCE
from .together import Together, together
from .trial import Before, Trial, both_conditions, presses, too_much_film, too_thick, touching_film

TOLERANCE = 2e-3  # of the load
SHARES, LIFTS = (-9.0, 9.0), (-9.0, 9.0)  # ln(F_H/F_C); ln(lift/scale)
THINNER = 0.5  # of the load over the lift, in logarithms, roughly: 1 between smooth bodies
EVEN = 0.5  # of the mean gap: a film on the spots that is thicker is that of a whole contact (docs/model-error.md)
PRESSED = 50e6  # Pa: a Newtonian film above it is sheared at no more than f_b p


@dataclass(frozen=True)
class OneWay:
    """One operating point. x (nx,) [m]; gap [m], pressure of the contact and of the film [Pa], closed and ruptured
    (bool), (nx, ny); forces per width [N/m].

    - spot_film [m]: the film on the spots of the contact, by which the gap is lifted.
    - unknown: ln(F_H/F_C) or, if the bodies are lifted off, ln(lift/scale). A neighbour starts from it, together with
      the film of Moes [m] and the slope of the balance over it, or the tangent of both conditions (`together`; None:
      not known).
    - left_out [-]: the deflection of the bodies by the film, which the closure leaves out: its rms over the Hertz
      strip, over the mean gap there.
    """

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
    moes_film: float
    slope: float | None
    tangent: np.ndarray | None
    left_out: float
    report: Report

    @property
    def coefficient(self) -> float:
        """f [-]."""
        return (self.boundary + self.couette + self.rolling) / (self.contact_load + self.film_load)


@dataclass(frozen=True)
class Solved:
    """A root of the balance, and the tangent that `together` left."""

    root: Root
    tangent: np.ndarray | None = None


def solve_one_way(problem: Problem, start: OneWay | None = None, tolerance=TOLERANCE) -> OneWay:
    """The division of the load at which contact and film carry the load: |F_C + F_H - F_T| <= tolerance F_T.

    Raises `ConvergenceError` if there is none.
    """
    if start is None:
        touching = touching_film(problem)
        first, before = touching.film_load > problem.load, Before(touching.kept, 0.0)
    else:
        first, before = start.lifted, _before(problem, start)
    tried = []
    for apart in (first, not first):
        near = start if start is not None and start.lifted == apart else None
        found = _root(problem, apart, near, before, tolerance)
        tried.append((apart, found))
        if abs(found.root.value) <= tolerance and not (apart and presses(problem, found.root.payload)):
            break
    else:
        apart, found = min(tried, key=lambda one: abs(one[1].root.value))
    root = found.root
    report = Report(
        "one-way load sharing", root.status, len(root.history), abs(root.value), tolerance,
        {"load": abs(root.value)}, root.history, root.payload.film.sets,
        _notes(problem, root.payload, apart),
    )  # fmt: skip
    result = _result(
        problem, root.payload, apart, found, report, start.slope if start and start.lifted == apart else None
    )
    report.raise_if_failed(result)
    return result


def _notes(problem: Problem, at: Trial, apart: bool) -> tuple[str, ...]:
    if apart:
        return ("the bodies are lifted off each other, undeformed",)
    even = at.spot_film / float(at.gap[_strip(problem)].mean())
    if even <= EVEN:
        return ()
    return (
        f"the film on the spots has {even:.2f} of the mean gap: a film carries what is counted as contact, and f may "
        "be a tenth too low",
    )


def _root(problem: Problem, apart: bool, near: OneWay | None, before: Before, tolerance: float) -> Solved:
    """The root: over the lift, if the bodies are ``apart``; else over the film's share of the load, with the film on
    the spots found at the same time. If that does not converge, the film on the spots is found for every share."""
    if not apart and problem.lubricant.viscosity_law != "constant":
        found = _both(problem, near, before, tolerance)
        if found.converged:
            value, split = float(found.values[0]), float(found.unknowns[0])
            history = tuple(tolerance * missed for missed in found.history)
            return Solved(Root(split, value, found.payload, history, CONVERGED), found.tangent)
    return Solved(
        increasing_root(
            partial(too_thick, problem) if apart else partial(too_much_film, problem),
            near.unknown if near else 0.0,
            step=0.7,
            bounds=LIFTS if apart else SHARES,
            tolerance=tolerance,
            slope=(near.slope if near else None) or (THINNER if apart else None),
            first=(None, before),
        )
    )


def _both(problem: Problem, near: OneWay | None, before: Before, tolerance: float) -> Together:
    """The share of the film and ln of the film on the spots [m], found together."""
    moes, lowest = problem.contact.moes_film, math.log(problem.floor)
    height = GUESS * moes if near is None else near.spot_film * moes / near.moes_film
    return together(
        partial(both_conditions, problem),
        np.array([near.unknown if near else 0.0, math.log(height)]),
        near.tangent if near else None,
        lowest=lowest,
        tolerances=np.array([tolerance, LIFT_TOLERANCE]),
        first=before,
    )


def _before(problem: Problem, near: OneWay) -> Before:
    """The film of ``near`` on the cells of ``problem``."""
    return Before(Kept(on_cells(near, problem.x, problem.heights.shape[1])), near.spot_film)


def on_cells(near: OneWay, x, columns: int) -> np.ndarray:
    """Where the film of ``near`` has ruptured, read off its nearest cells at ``x`` [m] and ``columns`` along y."""
    (nx, ny), step = near.ruptured.shape, near.x[1] - near.x[0]
    along = np.clip(np.rint((x - near.x[0]) / step).astype(int), 0, nx - 1)
    across = ((np.arange(columns) + 0.5) * ny / columns).astype(int)
    return near.ruptured[along][:, across]


def _result(problem: Problem, at: Trial, apart: bool, found: Solved, report: Report, slope: float | None) -> OneWay:
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
        found.root.x,
        problem.contact.moes_film,
        found.root.slope or slope,
        found.tangent,
        _left_out(problem, p, at.gap),
        report,
    )


def _left_out(problem: Problem, pressure, gap) -> float:
    strip = _strip(problem)
    return float(problem.operator.apply(pressure)[strip].std() / gap[strip].mean())


def _strip(problem: Problem) -> np.ndarray:
    return np.abs(problem.x) <= max(problem.contact.half_width, 0.5001 * problem.spacing[0])
