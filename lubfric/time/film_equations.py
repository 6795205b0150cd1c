"""One implicit time step of the line contact: its complementarity equations and their Jacobian.

    d(rho H)/dT + u d(rho H)/dX = d/dX( Φ rho H³/(6 nu eta) dP/dX )   where P > 0,
    the film no thinner than the gap where P = 0 (Swift-Stieber)

The units are those of `lubfric.film.FilmProblem` for a reference speed, and T = t U_ref/(unit of x). The time
derivative is ``rate (rho H - memory)``. Any implicit formula has that form (BDF2: `lubfric.time.march`), and rate = 0
gives the steady state. Shear makes the flow Φ times the Newtonian one (`lubfric.film.thinning`). The unknowns z are the
pressures at all nodes, and H00 in H = H00 + c X²/2 + K P.

Mass is balanced in control volumes around the nodes. The Couette flow takes film and density by third-order upwind
interpolation. The Poiseuille flow takes a centred film and the logarithmic mean of the fluidity. At both end nodes P
equals the pressure of the film outside (`outside`).

A lubricant that begins at a distance upstream (``inlet``) has P = 0 there and farther upstream, and fills the gap from
there on; without entrainment on either side.

The equation r of every node holds in the sense ``P >= 0, r >= 0, P r = 0``. In the cavitated zone r > 0 is the rate at
which the gap grows beyond the lubricant that flows in. Where the film forms again, the zone behind the rupture counts
as full: mass is conserved in the pressurised film, but not through cavitation.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._base import FloatArray
from ..film import FilmProblem, log_mean_fluidity
from .film_grid import FixedGrid
from .march import Memory

# Gauss-Legendre rule on 0 to 1. 24 points are a choice: more take longer, fewer err where the pressure bends.
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(24)
_POINTS = 0.5 * (_POINTS + 1.0)
_WEIGHTS = 0.5 * _WEIGHTS


# relative distance from the inlet within which a node lies on it. A choice, by rounding.
AT_INLET = 1e-9
# pressure or load beyond an end without lubricant, and its derivatives by flow, squeeze rate and film. By definition.
NO_PRESSURE = (0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, kw_only=True)
class Spring:
    """A spring that carries load in addition to the film; its load falls with the mean film ``weights`` @ H.

    Its load is ``load`` ((``opening`` - mean film)/(``opening`` - ``mean``))^``power``: 0 from a mean film of
    ``opening`` on. An elastic cell has the power 1, a Hertz contact 3/2, a rough surface more. Where the spring carries
    more than e times ``load``, its load is a straight line.
    """

    weights: np.ndarray
    opening: float
    mean: float
    load: float
    power: float

    def at(self, H: np.ndarray) -> tuple[float, float]:
        """Return the load, and its derivative by the mean film."""
        reach = self.opening - self.mean
        approach = (self.opening - float(self.weights @ H)) / reach
        if approach <= 0.0:
            return 0.0, 0.0
        bent = min(approach, math.exp(1.0 / self.power))
        load = self.load * bent**self.power
        slope = self.power * load / bent
        return load + slope * (approach - bent), -slope / reach


def outside(
    a: float, film: float, curvature: float, nu: float, speed: float, flow: float, rate: float
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return the pressure at a of the film beyond the last node, up to infinity, and its load. Each comes with its
    derivatives by the flow f, the squeeze rate v and the film h_a.

    The film is parabolic and isoviscous. At the distance s > a from the line of centres it is h = h_a + c (s² - a²)/2.
    The flow towards the contact is f + v (s - a), with f the flow at a and v = dh/dt. Reynolds' equation in the units
    of `lubfric.film.FilmProblem` is dp/ds = 6 nu (f + v (s - a) - U h)/h³, with U the speed towards the contact. So the
    pressure at a and the load beyond it are linear in U, f and v. The integrals are taken by Gauss quadrature in a/s.
    """
    s, h, weight = _nodes(a, film, curvature)

    def moment(power: int, lever: int) -> float:
        return float(np.sum(weight * (s - a) ** lever / h**power))

    def tail(lever: int) -> tuple[float, float, float, float]:
        two = moment(2, lever)
        three = moment(3, lever)
        lifted = moment(3, lever + 1)
        by_film = -2.0 * speed * three + 3.0 * (flow * moment(4, lever) + rate * moment(4, lever + 1))
        value = speed * two - flow * three - rate * lifted
        return 6.0 * nu * value, -6.0 * nu * three, -6.0 * nu * lifted, 6.0 * nu * by_film

    return tail(0), tail(1)


def outside_shear(
    a: float, film: float, curvature: float, nu: float, speed: float, flow: float, rate: float
) -> tuple[float, float]:
    """Return (∫ ds/h, ∫ (h/2) dp/ds ds) beyond a, of the film of `outside`."""
    s, h, weight = _nodes(a, film, curvature)
    return float(np.sum(weight / h)), 3.0 * nu * float(np.sum(weight * (flow + rate * (s - a) - speed * h) / h**2))


def _nodes(a: float, film: float, curvature: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return points s beyond a, the film there, and the weights ds."""
    s = a / _POINTS
    return s, film + 0.5 * curvature * (s * s - a * a), _WEIGHTS * s * s / a


@dataclass(frozen=True, kw_only=True)
class StepTerms:
    """One evaluation at P: what a solution is read from, and what the Jacobian needs. A pair (rho, H) is given at the
    faces, for the Couette flow (``up``) and for the Poiseuille flow (``centre``)."""

    P: np.ndarray
    H: np.ndarray
    rho: tuple[Any, ...]  # value and slope
    log_slope: np.ndarray  # of the viscosity
    up: tuple[Any, ...]
    centre: tuple[Any, ...]
    fluidity: tuple[Any, ...]
    gradient: np.ndarray
    thinning: tuple[Any, ...]  # Φ, s dΦ/ds, b dΦ/db
    flux: np.ndarray  # towards +X, (n,)
    stored: np.ndarray  # per unit time in each control volume
    r: np.ndarray  # node equations
    ends: tuple[Any, ...]  # pressure and load beyond each end, with their derivatives
    carried: float  # ∫ P dX with the tails of ends that are not cavitated
    spring: tuple[float, float]
    balance: float  # carried + spring - load


@dataclass(frozen=True, kw_only=True)
class StepEquations:
    """The equations of one implicit step, with a ``memory`` of the past: at a speed u, a load M, a curvature c =
    R_ref/R and an ambient viscosity nu, relative to the reference. ``spring``: carries load in addition to the
    film; ``inlet``: distance [X] upstream at which the lubricant begins (None: it floods the inlet)."""

    grid: FixedGrid
    problem: FilmProblem
    memory: Memory
    speed: float
    load: float
    curvature: float = 1.0
    viscosity: float = 1.0
    spring: Spring | None = None
    inlet: float | None = None

    @property
    def dry(self) -> np.ndarray:
        """Whether each node lies upstream of the lubricant, (n + 1,)."""
        if self.inlet is None:
            return np.zeros(self.grid.n + 1, bool)
        upstream = -self.grid.x * np.sign(self.speed) if self.speed else np.abs(self.grid.x)
        return upstream >= self.inlet * (1.0 - AT_INLET)

    def evaluate(self, z: np.ndarray) -> StepTerms:
        """Evaluate all equations at z."""
        grid = self.grid
        memory = self.memory
        speed = self.speed
        P = z[:-1]
        H = grid.kernel @ P + (z[-1] + 0.5 * self.curvature * grid.x**2)
        log_eta, log_slope = self.problem.log_viscosity(P)
        rho = self.problem.density(P)
        up = grid.upwind(speed)
        centred = grid.centred
        up_rho = up(rho[0])
        up_H = up(H)
        mid_rho = centred(rho[0])
        mid_H = centred(H)
        fluidity = tuple(f / self.viscosity for f in log_mean_fluidity(log_eta))
        gradient = np.diff(P) / (6.0 * grid.cells)
        thinning = self.problem.thinned(fluidity[0], mid_H, 6.0 * gradient)
        flux = speed * up_rho * up_H - mid_rho * mid_H**3 * fluidity[0] * gradient * thinning[0]
        stored = memory.rate * (rho[0] * H - memory.film) * grid.weights
        r = np.empty_like(P)
        r[1:-1] = stored[1:-1] + flux[1:] - flux[:-1]
        dry = self.dry
        ends = []
        carried = float(grid.weights @ P)
        for end, sign in ((0, 1.0), (-1, -1.0)):
            if dry[end]:
                ends.append((NO_PRESSURE, NO_PRESSURE))
                continue
            flow = sign * flux[end] + stored[end]
            rate = memory.rate * (H[end] - memory.film[end])
            pressure, load = outside(abs(grid.x[end]), H[end], self.curvature, self.viscosity, sign * speed, flow, rate)
            r[end] = P[end] - pressure[0]
            carried += load[0] if pressure[0] > 0.0 else 0.0
            ends.append((pressure, load))  # type: ignore[arg-type]
        r[dry] = P[dry]
        shared = self.spring.at(H) if self.spring else (0.0, 0.0)
        return StepTerms(
            P=P,
            H=H,
            rho=rho,
            log_slope=log_slope,
            up=(up_rho, up_H),
            centre=(mid_rho, mid_H),
            fluidity=fluidity,
            gradient=gradient,
            thinning=thinning,
            flux=flux,
            stored=stored,
            r=r,
            ends=tuple(ends),
            carried=carried,
            spring=shared,
            balance=carried + shared[0] - self.load,
        )

    def jacobian(self, t: StepTerms) -> np.ndarray:
        """Return the derivatives (n + 2, n + 2) of (r, balance) by z."""
        grid = self.grid
        memory = self.memory
        n = self.grid.n
        G = self._flux_slopes(t)
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
        for end, face, sign, (pressure, load) in zip((0, n), (0, -1), (1.0, -1.0), t.ends):
            flow = sign * G[face] + stored[end]
            film = np.append(grid.kernel[end], 1.0)

            def slope(value: float, by_flow: float, by_rate: float, by_film: float) -> FloatArray:
                return by_flow * flow + (by_rate * memory.rate + by_film) * film

            J[end] = -slope(*pressure)
            J[end, end] += 1.0
            if pressure[0] > 0.0:
                J[n + 1] += slope(*load)
        dry = np.flatnonzero(self.dry)
        J[dry] = 0.0
        J[dry, dry] = 1.0
        if self.spring is not None and t.spring[1]:
            J[n + 1, :-1] += t.spring[1] * (self.spring.weights @ grid.kernel)
            J[n + 1, -1] += t.spring[1] * self.spring.weights.sum()
        return J

    def _flux_slopes(self, t: StepTerms) -> np.ndarray:
        """Return the derivatives (n, n + 2) of the fluxes through the faces by z: by film, gradient, viscosity and
        density."""
        grid = self.grid
        speed = self.speed
        n = self.grid.n
        up = grid.upwind(speed)
        centred = grid.centred
        mean, by_left, by_right = t.fluidity
        rho, H = t.centre
        thinner, by_stress, by_gradient = t.thinning
        couette = speed * t.up[0]
        poiseuille = (3.0 * thinner - by_stress + by_gradient) * rho * H**2 * mean * t.gradient
        G = np.empty((n, n + 2))
        np.multiply(couette[:, None], up.kernel, out=G[:, :-1])
        G[:, :-1] -= poiseuille[:, None] * centred.kernel
        G[:, -1] = couette - poiseuille
        i = np.arange(n)
        cube = rho * H**3
        by_P = cube * mean / (6.0 * grid.cells) * (thinner + by_gradient)
        by_log = cube * t.gradient * (thinner - by_stress)
        G[i, i] += by_P - by_log * by_left * t.log_slope[:-1]
        G[i, i + 1] -= by_P + by_log * by_right * t.log_slope[1:]
        slope = t.rho[1]
        if slope.any():
            rows = i[:, None]
            G[rows, up.columns] += (speed * t.up[1])[:, None] * up.values * slope[up.columns]
            steep = centred.values * slope[centred.columns]
            G[rows, centred.columns] -= (H**3 * mean * t.gradient * thinner)[:, None] * steep
        return G

    def missing_flow(self, t: StepTerms) -> float:
        """Return the largest mass that is missing in a pressurised control volume, over the flow that the motion drags
        through it; 0 at rest."""
        if self.speed == 0.0:
            return 0.0
        wet = t.P[1:-1] > 0.0
        missing = np.abs(t.r[1:-1][wet]) / (t.H[1:-1][wet] * abs(self.speed))
        return float(np.max(missing, initial=0.0))

    def residual(self, t: StepTerms) -> float:
        """Return the largest relative residual: of the mass in the pressurised control volumes (relative to what they
        contain, per step or per passage of their film), of tension in the cavitated ones and of lubricant created
        there, of the load, and of the pressure at the ends."""
        scale = t.H * (self.memory.rate * self.grid.weights + abs(self.speed)) + 1e-300
        top = max(float(t.P.max()), 1e-300)
        mass = t.r[1:-1] / scale[1:-1]
        wet = t.P[1:-1] > 0.0
        missing = np.max(np.abs(mass[wet]), initial=0.0)
        created = np.max(-mass[~wet], initial=0.0)
        ends = np.max(np.abs(np.minimum(t.P, t.r)[[0, -1]])) / top
        load = abs(t.balance) / max(abs(self.load), 1e-300)
        return float(np.max([missing, created, -t.P.min() / top, ends, load]))
