"""Mass flow through the faces between cells, and its derivatives by p and h of the cells on both sides.

The pressure flow takes the mean of 1/h³ between the two cells, with h linear, and the mean fluidity between their
pressures (`rheology`). So the narrowest place limits the flow. The Couette flow U rho h is second-order upwind: half of
the upstream difference is added, limited to half of the cell's own film.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .problem import Problem
from .rheology import CellFluid, mean_fluidity, thinning


@dataclass(frozen=True)
class PressureFlow:
    """Flow through faces [m²/s] and its derivatives by p and h of the cells before and behind, each with the shape of
    the faces."""

    flow: np.ndarray
    by_p: tuple[np.ndarray, np.ndarray]
    by_h: tuple[np.ndarray, np.ndarray]


def pressure_flow(problem: Problem, fluid: CellFluid, p, h, axis: int) -> PressureFlow:
    """Pressure flow through the faces behind the cells along ``axis``: along x behind all but the last row, along y
    behind all (periodic)."""
    before, behind = _sides(axis)
    step = problem.spacing[axis]
    film = 0.5 * (before(h) + behind(h))
    log_fluidity, l_before, l_behind = mean_fluidity(before(fluid.log_viscosity), behind(fluid.log_viscosity))
    fluidity = np.exp(log_fluidity)
    density = 0.5 * (before(fluid.density) + behind(fluid.density))
    limit = None if fluid.limit is None else 0.5 * (before(fluid.limit) + behind(fluid.limit))
    newtonian = problem.lubricant.viscosity * problem.sliding / (film * fluidity)
    thin = thinning(problem.lubricant, newtonian, limit, along=axis == 0)
    cubed = (before(h) * behind(h)) ** 2 / film
    mobility = density * cubed * fluidity / (12 * problem.lubricant.viscosity * step)
    exponent: float | np.ndarray = 0.0
    limited: float | np.ndarray = 0.0
    if thin is not None:
        mobility = mobility * thin.factor
        exponent, limited = thin.exponent, thin.limit_exponent
    flow = mobility * (before(p) - behind(p))
    by_before, by_behind = (flow * (2 / side(h) - (1 + exponent) / (2 * film)) for side in (before, behind))

    def by_p(side, by_log, sign):
        laws = (1 - exponent) * by_log * side(fluid.log_slope) + 0.5 * side(fluid.density_slope) / density
        if limit is not None:
            laws = laws - limited * 0.5 * fluid.limit_slope / limit
        return sign * mobility + flow * laws

    return PressureFlow(flow, (by_p(before, l_before, 1.0), by_p(behind, l_behind, -1.0)), (by_before, by_behind))


def _sides(axis: int):
    """Functions that give the values before and behind each face."""
    if axis == 0:
        return (lambda f: f[:-1]), (lambda f: f[1:])
    return (lambda f: f), (lambda f: np.roll(f, -1, axis=1))


@dataclass(frozen=True)
class CouetteFlow:
    """Through the faces behind every cell along x [m²/s] (nx, ny); derivatives by rho h of that cell and of the one
    before it [m/s], and by the filled part of the cell [m²/s]."""

    flow: np.ndarray
    by_own: np.ndarray
    by_before: np.ndarray
    by_fill: np.ndarray


def couette_flow(problem: Problem, mass, fill=1.0) -> CouetteFlow:
    """Couette flow U rho h through the faces. ``mass`` (nx, ny): rho h [m]; ``fill``: the filled part of the cells. In
    the first cell the parabola gives the upstream difference."""
    x, dx = problem.x, problem.spacing[0]
    step = np.empty_like(mass)
    step[1:] = mass[1:] - mass[:-1]
    step[0] = x[0] / problem.radius * dx
    free = np.abs(step) < mass
    half = np.where(step >= mass, mass, np.where(free, step, -mass)) / 2
    by_own = np.where(free, 0.5, np.where(step > 0, 0.5, -0.5))
    by_before = np.where(free, -0.5, 0.0)
    by_own[0] = np.where(free[0], 0.0, by_own[0])
    by_before[0] = 0.0
    U = problem.speed
    full = U * (mass + half)
    return CouetteFlow(fill * full, fill * U * (1 + by_own), fill * U * by_before, full)
