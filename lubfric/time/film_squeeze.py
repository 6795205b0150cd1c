"""One implicit time step of the line contact: its complementarity equations and their Jacobian.

    d(rho H)/dT + u d(rho H)/dX = d/dX( rho H³/(6 nu eta) dP/dX )   where P > 0,
    the film no thinner than the gap where P = 0 (Swift-Stieber)

The units are those of `lubfric.film.problem` for a reference speed, and T = t U_ref/(unit of x). The time derivative is
``rate (rho H - memory)``. Any implicit formula has that form (BDF2: `lubfric.time.bdf`), and rate = 0 gives the steady
state. The unknowns z are the pressures at all nodes, and H00 in H = H00 + c X²/2 + K P.

Mass is balanced in control volumes around the nodes. The Couette flow takes film and density by third-order upwind
interpolation. The Poiseuille flow takes a centred film and the logarithmic mean of the fluidity. At both end nodes P
equals the pressure of the film outside (`lubfric.time.film_tail`).

The equation r of every node holds in the sense ``P >= 0, r >= 0, P r = 0``. In the cavitated zone r > 0 is the rate at
which the gap grows beyond the lubricant that flows in. Where the film forms again, the zone behind the rupture counts
as full: mass is conserved in the pressurised film, but not through cavitation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..film import Problem, log_mean_fluidity
from .bdf import Memory
from .film_grid import FixedGrid
from .film_tail import Tail, outside


@dataclass(frozen=True)
class Conditions:
    """Speed u, load M, curvature c = R_ref/R and ambient viscosity nu at one time, relative to the reference."""

    speed: float
    load: float
    curvature: float = 1.0
    viscosity: float = 1.0


@dataclass(frozen=True)
class Spring:
    """A spring that carries load beside the film; its load falls exponentially with the mean film ``weights`` @ H.

    Its load is ``load`` exp((``mean`` - mean film)/``length``), and a straight line beyond one length of compression.
    """

    weights: np.ndarray
    mean: float
    load: float
    length: float

    def at(self, H: np.ndarray) -> tuple[float, float]:
        """The load, and its derivative by the mean film."""
        depth = (self.mean - float(self.weights @ H)) / self.length
        if depth > 1.0:
            return self.load * np.e * depth, -self.load * np.e / self.length
        load = self.load * np.exp(depth)
        return load, -load / self.length


@dataclass(frozen=True)
class StepTerms:
    """One evaluation: P, H, rho (value and slope), values at the faces, r, and what the Jacobian needs."""

    P: np.ndarray
    H: np.ndarray
    rho: tuple
    log_slope: np.ndarray
    up: tuple  # rho, H of the Couette flow
    centre: tuple  # rho, H of the Poiseuille flow
    fluidity: tuple
    gradient: np.ndarray
    flux: np.ndarray  # towards +X, (n,)
    stored: np.ndarray  # per unit time in each control volume
    r: np.ndarray  # node equations
    ends: tuple[tuple[Tail, Tail], tuple[Tail, Tail]]
    carried: float  # ∫ P dX with the tails of ends that are not cavitated
    spring: tuple[float, float]
    balance: float  # carried + spring - load


def evaluate(
    grid: FixedGrid, problem: Problem, now: Conditions, memory: Memory, spring: Spring | None, z: np.ndarray
) -> StepTerms:
    """All equations at z."""
    P = z[:-1]
    H = grid.kernel @ P + (z[-1] + 0.5 * now.curvature * grid.x**2)
    log_eta, log_slope = problem.log_viscosity(P)
    rho = problem.density(P)
    up = grid.upwind(now.speed)
    up_rho, up_H, mid_rho, mid_H = up(rho[0]), up(H), grid.centred(rho[0]), grid.centred(H)
    fluidity = tuple(f / now.viscosity for f in log_mean_fluidity(log_eta))
    gradient = np.diff(P) / (6.0 * grid.cells)
    flux = now.speed * up_rho * up_H - mid_rho * mid_H**3 * fluidity[0] * gradient
    stored = memory.rate * (rho[0] * H - memory.film) * grid.weights
    r = np.empty_like(P)
    r[1:-1] = stored[1:-1] + flux[1:] - flux[:-1]
    ends, carried = [], float(grid.weights @ P)
    for end, sign in ((0, 1.0), (-1, -1.0)):
        pressure, load = outside(
            abs(grid.x[end]),
            H[end],
            now.curvature,
            now.viscosity,
            sign * now.speed,
            sign * flux[end] + stored[end],
            memory.rate * (H[end] - memory.film[end]),
        )
        r[end] = P[end] - pressure.value
        carried += load.value if pressure.value > 0.0 else 0.0
        ends.append((pressure, load))
    shared = spring.at(H) if spring else (0.0, 0.0)
    return StepTerms(
        P,
        H,
        rho,
        log_slope,
        (up_rho, up_H),
        (mid_rho, mid_H),
        fluidity,
        gradient,
        flux,
        stored,
        r,
        (ends[0], ends[1]),
        carried,
        shared,
        carried + shared[0] - now.load,
    )


def jacobian(grid: FixedGrid, now: Conditions, memory: Memory, spring: Spring | None, t: StepTerms) -> np.ndarray:
    """Derivatives (n + 2, n + 2) of (r, balance) by z."""
    n = grid.n
    up, mid = grid.upwind(now.speed), grid.centred
    couette = now.speed * t.up[0]
    poiseuille = 3.0 * t.centre[0] * t.centre[1] ** 2 * t.fluidity[0] * t.gradient
    G = np.empty((n, n + 2))
    np.multiply(couette[:, None], up.kernel, out=G[:, :-1])
    G[:, :-1] -= poiseuille[:, None] * mid.kernel
    G[:, -1] = couette - poiseuille
    _local(grid, now, t, up, mid, G)
    J = np.empty((n + 2, n + 2), order="F")
    inertia = memory.rate * grid.weights * t.rho[0]
    np.subtract(G[1:], G[:-1], out=J[1:n])
    stored = np.empty((n + 1, n + 2))
    np.multiply(inertia[:, None], grid.kernel, out=stored[:, :-1])
    stored[:, -1] = inertia
    i = np.arange(n + 1)
    stored[i, i] += memory.rate * grid.weights * t.H * t.rho[1]
    J[1:n] += stored[1:n]
    J[n + 1, :-1] = grid.weights
    J[n + 1, -1] = 0.0
    for k, (end, sign) in enumerate(((0, 1.0), (n, -1.0))):
        flow = sign * G[0 if k == 0 else n - 1] + stored[end]
        film = np.append(grid.kernel[end], 1.0)
        pressure, load = t.ends[k]
        J[end] = -(pressure.by_flow * flow + (pressure.by_rate * memory.rate + pressure.by_film) * film)
        J[end, end] += 1.0
        if pressure.value > 0.0:
            J[n + 1] += load.by_flow * flow + (load.by_rate * memory.rate + load.by_film) * film
    if spring is not None and t.spring[1]:
        J[n + 1, :-1] += t.spring[1] * (spring.weights @ grid.kernel)
        J[n + 1, -1] += t.spring[1] * spring.weights.sum()
    return J


def _local(grid: FixedGrid, now: Conditions, t: StepTerms, up, mid, G: np.ndarray) -> None:
    """Add the derivatives of the fluxes through the faces by gradient, viscosity and density."""
    i = np.arange(grid.n)
    mean, by_left, by_right = t.fluidity
    cube = t.centre[0] * t.centre[1] ** 3
    by_P = cube * mean / (6.0 * grid.cells)
    G[i, i] += by_P - cube * t.gradient * by_left * t.log_slope[:-1]
    G[i, i + 1] -= by_P + cube * t.gradient * by_right * t.log_slope[1:]
    slope = t.rho[1]
    if slope.any():
        rows = i[:, None]
        G[rows, up.columns] += (now.speed * t.up[1])[:, None] * up.values * slope[up.columns]
        G[rows, mid.columns] -= (t.centre[1] ** 3 * mean * t.gradient)[:, None] * mid.values * slope[mid.columns]
