"""Mass flow through the faces between cells, the mass balance of every cell, and the sparse derivatives of both.

The pressure flow takes the mean of 1/h³ between the two cells, with h linear, and the mean fluidity between their
pressures (`rheology`). So the narrowest place limits the flow. The Couette flow U rho h is second-order upwind: half of
the upstream difference is added, limited to half of the cell's own film.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from ..._base import BoolArray, FloatArray
from .inlet import Inlet, inlet
from .problem import Problem
from .rheology import CellFluid, cell_fluid, mean_fluidity, thinning


@dataclass(frozen=True)
class PressureFlow:
    """Flow through faces [m²/s] and its derivatives by p and h of the cells before and behind, each with the shape of
    the faces."""

    flow: np.ndarray
    by_p: tuple[np.ndarray, np.ndarray]
    by_h: tuple[np.ndarray, np.ndarray]


def pressure_flow(problem: Problem, fluid: CellFluid, p: FloatArray, h: FloatArray, axis: int) -> PressureFlow:
    """Return the pressure flow through the faces behind the cells along ``axis``: along x behind all but the last row,
    along y behind all (periodic)."""

    def continued(f: FloatArray) -> FloatArray:
        """Return ``f``; along y with its first column once more behind the last, because it is periodic."""
        return f if axis == 0 else np.concatenate([f, f[:, :1]], axis=1)

    def before(f: FloatArray) -> FloatArray:
        return f[:-1] if axis == 0 else f[:, :-1]

    def behind(f: FloatArray) -> FloatArray:
        return f[1:] if axis == 0 else f[:, 1:]

    p = continued(p)
    h = continued(h)
    density_at = continued(fluid.density)
    log_viscosity = continued(fluid.log_viscosity)
    log_slope = continued(fluid.log_slope)
    density_slope = continued(fluid.density_slope)
    laws = [tuple(continued(f) if np.ndim(f) else f for f in law) for law in fluid.critical]

    def mean(f: FloatArray) -> FloatArray:
        return 0.5 * (before(f) + behind(f))

    film = mean(h)
    density = mean(density_at)
    log_fluidity, l_before, l_behind = mean_fluidity(before(log_viscosity), behind(log_viscosity))
    fluidity = np.exp(log_fluidity)
    critical = [mean(tau_c) if np.ndim(tau_c) else tau_c for tau_c, _ in laws]
    newtonian = problem.lubricant.viscosity * problem.sliding / (film * fluidity)
    thinner, exponent, parts = thinning(problem.lubricant, newtonian, critical, along=axis == 0)
    cubed = (before(h) * behind(h)) ** 2 / film
    mobility = density * cubed * fluidity / (12 * problem.lubricant.viscosity * problem.spacing[axis]) * thinner
    flow = mobility * (before(p) - behind(p))

    def by_p(side: Callable[..., Any], by_log: FloatArray, sign: float) -> FloatArray:
        change = (1 - exponent) * by_log * side(log_slope) + 0.5 * side(density_slope) / density
        for part, tau_c, (_, slope) in zip(parts, critical, laws):
            if np.ndim(tau_c):
                change = change - part * 0.5 * (side(slope) if np.ndim(slope) else slope) / tau_c
        return sign * mobility + flow * change

    by_before, by_behind = (flow * (2 / side(h) - (1 + exponent) / (2 * film)) for side in (before, behind))
    return PressureFlow(flow, (by_p(before, l_before, 1.0), by_p(behind, l_behind, -1.0)), (by_before, by_behind))


@dataclass(frozen=True)
class CouetteFlow:
    """Couette flow through the faces behind every cell along x [m²/s] (nx, ny); derivatives by rho h of that cell and
    of the one before it [m/s], and by the filled part of the cell [m²/s]."""

    flow: np.ndarray
    by_own: np.ndarray
    by_before: np.ndarray
    by_fill: np.ndarray


def couette_flow(problem: Problem, mass: FloatArray, fill: float | FloatArray, U: float) -> CouetteFlow:
    """Return the Couette flow U rho h through the faces. ``mass`` (nx, ny): rho h [m]; ``fill``: the filled part of the
    cells. In the first cell the parabola gives the upstream difference."""
    step = np.empty_like(mass)
    step[1:] = mass[1:] - mass[:-1]
    step[0] = problem.x[0] / problem.radius * problem.spacing[0]
    free = np.abs(step) < mass
    half = np.where(step >= mass, mass, np.where(free, step, -mass)) / 2
    by_own = np.where(free | (step > 0), 0.5, -0.5)
    by_before = np.where(free, -0.5, 0.0)
    by_own[0] = np.where(free[0], 0.0, by_own[0])
    by_before[0] = 0.0
    full = U * (mass + half)
    return CouetteFlow(fill * full, fill * U * (1 + by_own), fill * U * by_before, full)


@dataclass(frozen=True, kw_only=True)
class MassBalance:
    """Outflow minus inflow of each cell, ``residual`` [m/s] (nx, ny), and its parts.

    flow_gap: the gap for the flow, at least the floor [m]. ``end``: the pressure flow out of the last cells, beyond
    which p = 0; they have ruptured, but for a film that is squeezed out.
    """

    residual: np.ndarray
    flow_gap: np.ndarray
    fluid: CellFluid
    along: PressureFlow
    across: PressureFlow
    end: PressureFlow
    couette: CouetteFlow
    inlet: Inlet


def mass_balance(
    problem: Problem,
    pressure: FloatArray,
    gap: FloatArray,
    fill: float | FloatArray = 1.0,
    *,
    follows_lubricant: bool = False,
) -> MassBalance:
    """Return the steady mass balance of the cells at pressure [Pa], gap [m] and filled part [-] (nx, ny);
    ``follows_lubricant``: without the Couette flow, of cells that move with it (`state.TimeHistory`)."""
    dx, dy = problem.spacing
    film = np.maximum(gap, problem.floor)
    fluid = cell_fluid(problem.lubricant, np.maximum(pressure, 0.0))
    along, across = (pressure_flow(problem, fluid, pressure, film, axis) for axis in (0, 1))
    last = np.stack([np.maximum(pressure[-1], 0.0), np.zeros_like(pressure[-1])])
    end = pressure_flow(problem, cell_fluid(problem.lubricant, last), last, np.stack([film[-1]] * 2), 0)
    couette = couette_flow(problem, fluid.density * film, fill, 0.0 if follows_lubricant else problem.speed)
    upstream = inlet(problem, pressure[0], film[0])
    residual = couette.flow.copy()
    residual[1:] -= couette.flow[:-1]
    residual[0] -= upstream.flow
    residual[-1] += end.flow[0]
    residual[:-1] += along.flow
    residual[1:] -= along.flow
    residual /= dx
    residual += (across.flow - np.roll(across.flow, 1, axis=1)) / dy
    return MassBalance(
        residual=residual,
        flow_gap=film,
        fluid=fluid,
        along=along,
        across=across,
        end=end,
        couette=couette,
        inlet=upstream,
    )


class Stencil:
    """Coefficients ``data`` (6, nx, ny) of a cell's own value, of its neighbours up and down stream (W, WW; E) and
    across (S, N)."""

    NAMES = ("WW", "W", "S", 0, "N", "E")

    def __init__(self, shape: tuple[int, int]):
        self.data = np.zeros((len(self.NAMES), *shape))

    def add(self, name: int | str, values: FloatArray, here: slice = slice(None)) -> None:
        """Add ``values`` to the coefficients of the neighbour ``name``, in the rows ``here``."""
        self.data[self.NAMES.index(name)][here] += values

    @staticmethod
    @lru_cache(maxsize=8)
    def neighbours(nx: int, ny: int) -> np.ndarray:
        """Return the numbers (i ny + j) of the cells that the coefficients belong to (6, nx, ny); the own where there
        is none."""
        numbers = np.arange(nx * ny).reshape(nx, ny)
        neighbours = np.stack(
            [numbers, numbers, np.roll(numbers, 1, axis=1), numbers, np.roll(numbers, -1, axis=1), numbers]
        )
        neighbours[0, 2:] = numbers[:-2]
        neighbours[1, 1:] = numbers[:-1]
        neighbours[5, :-1] = numbers[1:]
        return neighbours


def derivatives(problem: Problem, at: MassBalance, open_: BoolArray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return d residual/dp [m/(s Pa)], /dh [1/s] and /dfill [m/s] as the data of a `Stencil` each; by h of ``open_``
    cells (bool) (nx, ny) only."""
    dx, dy = problem.spacing
    by_p, by_h, by_fill = (Stencil(at.flow_gap.shape) for _ in range(3))
    for stencil, along, across in ((by_p, at.along.by_p, at.across.by_p), (by_h, at.along.by_h, at.across.by_h)):
        stencil.add(0, along[0] / dx, here=slice(None, -1))
        stencil.add("E", along[1] / dx, here=slice(None, -1))
        stencil.add("W", -along[0] / dx, here=slice(1, None))
        stencil.add(0, -along[1] / dx, here=slice(1, None))
        stencil.add(0, across[0] / dy)
        stencil.add("N", across[1] / dy)
        stencil.add("S", -np.roll(across[0], 1, axis=1) / dy)
        stencil.add(0, -np.roll(across[1], 1, axis=1) / dy)
    by_own_cell = at.couette.by_own / dx
    before = at.couette.by_before / dx
    for stencil, factor in ((by_h, at.fluid.density), (by_p, at.fluid.density_slope * at.flow_gap)):
        stencil.add(0, by_own_cell * factor)
        stencil.add("W", before[1:] * factor[:-1], here=slice(1, None))
        stencil.add("W", -by_own_cell[:-1] * factor[:-1], here=slice(1, None))
        stencil.add("WW", -before[1:-1] * factor[:-2], here=slice(2, None))
    by_fill.add(0, at.couette.by_fill / dx)
    by_fill.add("W", -at.couette.by_fill[:-1] / dx, here=slice(1, None))
    by_p.add(0, at.end.by_p[0] / dx, here=slice(-1, None))
    by_h.add(0, (at.end.by_h[0] + at.end.by_h[1]) / dx, here=slice(-1, None))
    by_p.add(0, -at.inlet.by_pressure / dx, here=slice(0, 1))
    by_h.add(0, -at.inlet.by_film / dx, here=slice(0, 1))
    by_h.data *= np.asarray(open_, bool).ravel()[Stencil.neighbours(*at.flow_gap.shape)]
    return by_p.data, by_h.data, by_fill.data
