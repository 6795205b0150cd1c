"""A smooth line contact by a plain Newton method on the full matrix: the yardstick of the chart of films.

Nodes lie at even distances, without nested grids or graded meshes. The flow between two nodes is U rho h by
second-order upwinding, less rho h³/(12 eta) dp/dx with the logarithmic mean of rho/eta. The film ruptures where the
pressure would be negative (Swift and Stieber). Elasticity is exact for pressures that are constant around each node. It
starts from the dry contact, and does not converge in every case.
"""

import math
from dataclasses import dataclass

import numpy as np
import scipy.linalg

from ..fem.solvers.ehl import LineContact
from ..fem.solvers.fluid import slope
from ..types import Keywords

INLET = (4.5, 8.0)  # length upstream: in Hertz half-widths, and in lengths sqrt(2 R h) of the film; the longer counts
OUTLET = (1.5, 1.0)  # length downstream, likewise
LARGEST_GROWTH = 3.0  # of ln(eta) at any node in one step
MOST_THINNER = 0.7  # of the film at any node that one step takes away
MOST = 150  # steps
TOLERANCE = 1e-8  # of the lost mass over the inflow, of the load, and of a tension over the Hertz pressure


@dataclass(frozen=True, kw_only=True)
class DenseFilm:
    """Nodes x [m], pressure [Pa], film [m], flow film [m]; ``converged``, and the steps."""

    x: np.ndarray
    pressure: np.ndarray
    film: np.ndarray
    flow_film: float
    converged: bool
    steps: int

    @property
    def min_film(self) -> float:
        """The smallest film before the rupture [m]."""
        wet = self.pressure > 0
        return float(self.film[: np.flatnonzero(wet)[-1] + 2].min())


def dense_newton(case: Keywords, nodes: int) -> DenseFilm:
    """Return the film of ``case``, the arguments of `lubfric.solve_ehl`, on so many ``nodes``."""
    contact = LineContact.of(case)
    b = contact.half_width
    film = (3 / contact.load_number + 2.6 * contact.load_number**-0.2) * contact.moes_film  # rigid and elastic limits
    thick = math.sqrt(2 * contact.radius * film)
    x = np.linspace(-max(INLET[0] * b, INLET[1] * thick), max(OUTLET[0] * b, OUTLET[1] * thick), nodes)
    stiff = _deflections(x, contact.e_prime)
    p = contact.hertz_pressure * np.sqrt(np.maximum(1 - (x / b) ** 2, 0.0))
    approach = film - float((x**2 / (2 * contact.radius) + stiff @ p)[np.argmin(np.abs(x))])
    p, approach, steps, converged = _solved(contact, x, stiff, p, approach)
    h = x**2 / (2 * contact.radius) + stiff @ p + approach
    inflow = float(_balance(contact, x, stiff, p, h)[0][0]) / contact.entrainment_speed
    return DenseFilm(x=x, pressure=p, film=h, flow_film=inflow, converged=converged, steps=steps)


def _deflections(x: np.ndarray, e_prime: float) -> np.ndarray:
    """Return the deflection [m] of each node per pressure [Pa] at each: the logarithm, integrated over a cell."""
    cell = x[1] - x[0]
    distance = x[:, None] - x

    def integral(s: np.ndarray) -> np.ndarray:
        return s * np.log(np.abs(s))

    return -4 / (math.pi * e_prime) * (integral(distance + cell / 2) - integral(distance - cell / 2) - cell)


def _balance(
    contact: LineContact, x: np.ndarray, stiff: np.ndarray, p: np.ndarray, h: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the flow [m²/s] over each face between nodes, and its derivatives by the pressures and by the approach."""
    fluid = contact.fluid
    speed = contact.entrainment_speed
    cell = x[1] - x[0]
    n = x.size
    at = np.maximum(p, 0.0)
    h = np.maximum(h, 1e-3 * contact.moes_film)
    rho = fluid.rho(at)
    denser = slope(fluid.rho, at)
    content = rho * h
    content_by = rho[:, None] * stiff
    content_by[np.arange(n), np.arange(n)] += denser * h
    fluidity = np.log(rho / fluid.eta(at))
    fluidity_by = denser / rho - slope(fluid.log_viscosity, at)
    middle = (h[1:] + h[:-1]) / 2
    mobility = np.exp((fluidity[1:] + fluidity[:-1]) / 2) * middle**3 / (12 * cell)
    drop = p[1:] - p[:-1]
    upwind = np.append(content[:1], 1.5 * content[1:-1] - 0.5 * content[:-2])
    upwind_by = np.vstack([content_by[:1], 1.5 * content_by[1:-1] - 0.5 * content_by[:-2]])
    flow = speed * upwind - mobility * drop
    bent = (1.5 / middle * mobility * drop)[:, None]
    by = speed * upwind_by - bent * (stiff[1:] + stiff[:-1])
    face = np.arange(n - 1)
    by[face, face] += mobility - 0.5 * mobility * drop * fluidity_by[:-1]
    by[face, face + 1] -= mobility + 0.5 * mobility * drop * fluidity_by[1:]
    dense = np.append(rho[:1], 1.5 * rho[1:-1] - 0.5 * rho[:-2])
    return flow, by, speed * dense - 2 * bent[:, 0]


def _solved(
    contact: LineContact, x: np.ndarray, stiff: np.ndarray, p: np.ndarray, approach: float
) -> tuple[np.ndarray, float, int, bool]:
    """Return pressure, approach, steps and whether Newton's method converged, from ``p`` and ``approach`` on."""
    cell = x[1] - x[0]
    unit = contact.hertz_pressure
    load = contact.load_per_width
    inflow = contact.entrainment_speed * contact.moes_film
    held = p <= 0
    held[1:-1] = False
    for step in range(MOST):
        h = x**2 / (2 * contact.radius) + stiff @ p + approach
        flow, by, by_approach = _balance(contact, x, stiff, p, h)
        lost = np.zeros(x.size)
        lost[1:-1] = flow[1:] - flow[:-1]
        excess = p.sum() * cell / load - 1
        sorted_out = np.where(held, lost > 0, p < 0)
        sorted_out[[0, -1]] = True
        worst = max(float(np.abs(lost[~held]).sum() / inflow), abs(excess), float(max(-p.min(), 0)) / unit)
        if worst <= TOLERANCE and (sorted_out == held).all():
            return p, approach, step, True
        if not math.isfinite(worst):
            break
        held = sorted_out
        free = np.flatnonzero(~held)
        change = np.where(held, -p, 0.0)
        rows = (by[free] - by[free - 1]) / inflow
        matrix = np.empty((free.size + 1, free.size + 1))
        matrix[:-1, :-1] = rows[:, free] * unit
        matrix[:-1, -1] = (by_approach[free] - by_approach[free - 1]) * contact.film_unit / inflow
        matrix[-1, :-1] = cell * unit / load
        matrix[-1, -1] = 0.0
        right = -np.append(lost[free] / inflow + rows @ change, excess + cell * change.sum() / load)
        solution = scipy.linalg.solve(matrix, right, overwrite_a=True, check_finite=False)
        change[free] = solution[:-1] * unit
        law = contact.fluid.log_viscosity
        growth = float(np.abs(law(np.maximum(p + change, 0)) - law(np.maximum(p, 0))).max())
        rise = float(solution[-1]) * contact.film_unit
        thinner = float((-(rise + stiff @ change) / np.maximum(h, 1e-3 * contact.moes_film)).max())
        share = min(1.0, LARGEST_GROWTH / max(growth, 1e-9), MOST_THINNER / max(thinner, 1e-9))
        p = p + share * change
        approach += share * rise
    return p, approach, MOST, False
