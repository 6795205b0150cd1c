"""Friction, and the split of the load between asperity spots and the film between them.

With one pressure, no equation tells film and contact apart, so the split is a rule:

    A cell belongs to an asperity spot where the bodies touch (h = floor), or where p > 50 MPa, a Newtonian film would
    be sheared above the boundary friction, eta Δu/h > f_b p, and h is less than half its mean over the section.

The second condition finds the summits of a light contact, which carry films of nanometres. Alone it would also mark the
whole of a thick film at high pressure, whose stress is at its limit for another reason. The third condition leaves that
to the film. `LoadSplit` has the load by other rules. The friction coefficient hardly depends on the rule, because the
stress is f_b p on spots, follows the lubricant's law in the film, and is limited to f_b p in a Newtonian film above 50
MPa too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..oil import shear_stress, viscosity
from .problem import Problem
from .state import FLUID, TOUCHING, Look

PRESSED = 50e6  # Pa
CLOSE = 0.5  # of the mean gap of the section


@dataclass(frozen=True)
class LoadSplit:
    """Load [N/m] on the cells that four rules select, from the narrowest: ``touching`` (h = floor); ``spots`` (the rule
    of this module); ``saturated``: p > 50 MPa and eta Δu/h > f_b p, or touching; and the ``whole`` load, film and all.
    """

    touching: float
    spots: float
    saturated: float
    whole: float


@dataclass(frozen=True)
class Forces:
    """Forces per width [N/m] on the moving body: f_b p over the spots, Couette and rolling shear of the film; the
    ``split`` of the load; and ``spots``, ``wet`` (bool) and ``shear`` [Pa] on the cells (nx, ny)."""

    boundary: float
    couette: float
    rolling: float
    split: LoadSplit
    spots: np.ndarray
    wet: np.ndarray
    shear: np.ndarray


def forces(problem: Problem, at: Look, pressed=PRESSED, close=CLOSE) -> Forces:
    """Forces of a solved state; ``pressed`` [Pa] and ``close`` [-] are the two numbers of the rule."""
    p, h, kind = at.state.pressure, at.balance.film, at.state.kind
    touching, fluid = kind == TOUCHING, kind == FLUID
    f_b, rate = problem.boundary_friction, problem.sliding / h
    with np.errstate(over="ignore"):
        newtonian = viscosity(problem.lubricant, p) * rate
    saturated = fluid & (p > pressed) & (newtonian > f_b * p)
    spots = touching | saturated & (h < close * h.mean(axis=1)[:, None])
    shear = np.where(fluid, _film_shear(problem, p, rate, saturated), 0.0)
    shear[spots] = f_b * p[spots]
    wet = fluid & ~spots
    cell = problem.spacing[0] / p.shape[1]

    def carried(where):
        return float(p[where].sum()) * cell

    split = LoadSplit(carried(touching), carried(spots), carried(touching | saturated), problem.load)
    return Forces(
        f_b * split.spots,
        float(shear[wet].sum()) * cell + problem.lubricant.viscosity * problem.sliding * at.balance.inlet.shearing,
        _rolling(problem, at, wet),
        split,
        spots,
        wet,
        shear,
    )


def _film_shear(problem: Problem, p, rate, saturated):
    with np.errstate(over="ignore"):
        law = shear_stress(problem.lubricant, p, rate)
    if problem.lubricant.newtonian:
        law = np.where(saturated, np.minimum(law, problem.boundary_friction * p), law)
    return law


def _rolling(problem: Problem, at: Look, wet) -> float:
    """∫ (h/2) dp/dx [N/m], upstream included."""
    p, h = at.state.pressure, at.balance.film
    both = (wet[1:] & wet[:-1]) | (wet[:-1] & (p[1:] == 0)) | (wet[1:] & (p[:-1] == 0))
    inside = float((0.25 * (h[1:] + h[:-1]) * (p[1:] - p[:-1]))[both].sum()) / p.shape[1]
    return inside + at.balance.inlet.rolling
