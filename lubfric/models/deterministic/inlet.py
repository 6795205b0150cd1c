"""The film upstream of the grid, in closed form: there the gap is the parabola, and the viscosity rises little.

With h(x) known, Reynolds' equation is one integral: Q(x) = 12 eta0 ∫ (U h - q)/(h³ Φ) dx', with Q the reduced pressure
∫ eta0/eta dp, q the flow and Φ the thinning at ambient pressure, from -infinity on, or from where the lubricant begins.
The substitution x = -a/t maps it to 0 < t < 1, or part of it, where everything is smooth.

If a film of given thickness arrives (`Lubricant.inlet_film`), no more than U times it flows in. The mass balance of the
cells then finds where the lubricant fills the gap; or, if that is upstream of them, Q falls to 0 there.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from ..._base import FloatArray
from ...film import true_pressure
from .problem import Problem
from .rheology import cell_fluid, mean_fluidity, thinning

if TYPE_CHECKING:
    from ...oil import Lubricant


# Gauss points of the integrals upstream of the grid [-]. Half and twice as many change f of the scene "paper" by
# 1e-8.
INLET_POINTS = 24

# Reduced pressure Q upstream of the grid times alpha, at most [-]: no converged film has as much. A choice, below the 1
# at which the pressure by Barus is infinite.
MOST_ALPHA_Q = 0.8


@cache
def _rule() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the Gauss points and weights on (0, 1), and the matrix of the integrals from 0 to each point."""
    node, weight = np.polynomial.legendre.leggauss(INLET_POINTS)
    values = np.polynomial.legendre.legvander(node, INLET_POINTS)  # of P_0..P_n at the nodes
    order = np.arange(INLET_POINTS)
    coefficients = (2 * order[:, None] + 1) / 2 * (values[:, :INLET_POINTS].T * weight)
    integral = np.empty((INLET_POINTS, INLET_POINTS))
    integral[:, 0] = node + 1
    integral[:, 1:] = (values[:, 2:] - values[:, : INLET_POINTS - 1]) / (2 * order[1:] + 1)
    return (node + 1) / 2, weight / 2, integral @ coefficients / 2


@dataclass(frozen=True, kw_only=True)
class Inlet:
    """Values of every row: flow [m²/s] into the grid, and its derivatives by p of the first cell and by h of the first
    face. Also the load [N/m] carried upstream, and the derivatives of its mean over the rows by the same; and the
    integrals upstream ``shearing`` ∫ eta/eta0 dx/h [-] and ``rolling`` ∫ (h/2) dp [N/m]. All arrays (ny,)."""

    flow: np.ndarray
    by_pressure: np.ndarray
    by_film: np.ndarray
    load: np.ndarray
    load_by_pressure: np.ndarray
    load_by_film: np.ndarray
    shearing: np.ndarray
    rolling: np.ndarray


def inlet(problem: Problem, pressure: FloatArray, thickness: FloatArray) -> Inlet:
    """Return the `Inlet` upstream of the first cells, whose ``pressure`` [Pa] and ``thickness`` [m] are given (ny,). To
    the face before them the film continues up the parabola."""
    lubricant = problem.lubricant
    speed = problem.speed
    radius = problem.radius
    t, weight, integral = _rule()
    x = problem.x[0]
    dx = problem.spacing[0]
    thickness = thickness - x * dx / (2 * radius) + dx**2 / (8 * radius)
    start = -(x - dx / 2)
    begins = 0.0 if lubricant.inlet_length is None else start / lubricant.inlet_length
    t = begins + (1 - begins) * t
    weight = (1 - begins) * weight
    integral = (1 - begins) * integral
    stretch = start / t**2
    shape = (start / t) ** 2 / (2 * radius) - start**2 / (2 * radius) + problem.edge_log * np.log(t)
    gap = thickness[:, None] + shape
    flow_factor = _ambient_thinning(problem, gap)
    viscous = 12 * lubricant.viscosity
    by_square = viscous * stretch / (gap * gap * flow_factor)  # viscous/(h³ Φ) times h, along t
    b = by_square / gap
    A = speed * (by_square @ weight)
    B = b @ weight
    A_h = -2 * speed * B
    B_h = -3 * ((b / gap) @ weight)
    reduced, reduced_slope = _reduced(lubricant, np.maximum(pressure, 0.0))
    T = 2 * thickness**3 * _ambient_thinning(problem, thickness) / (viscous * dx)
    T_h = 3 * T / thickness
    top = speed * thickness + T * (A - reduced)
    below = 1 + T * B
    flow = top / below
    by_film = (speed + T_h * (A - reduced) + T * A_h - flow * (T_h * B + T * B_h)) / below
    by_pressure = -T / below * reduced_slope
    most = np.inf if lubricant.inlet_film is None else speed * lubricant.inlet_film
    fed = flow > most
    flow, by_film, by_pressure = np.where(fed, [[most], [0.0], [0.0]], [flow, by_film, by_pressure])
    up_to = b @ integral.T
    Q = speed * (by_square @ integral.T) - flow[:, None] * up_to
    if fed.any():  # from the pressure at the face upstream
        Q += np.where(fed, reduced - (speed * thickness - flow) / T - (A - flow * B), 0.0)[:, None]
    wet = ~fed[:, None] | (Q > 0)
    p = true_pressure(lubricant)(np.clip(Q, 0.0, MOST_ALPHA_Q / max(lubricant.pressure_viscosity_coefficient, 1e-30)))
    slope = np.exp(cell_fluid(lubricant, p).log_viscosity)
    by_flow = -(slope * up_to) @ (weight * stretch)
    at_given_flow = np.where(fed, (slope * wet) @ (weight * stretch) * reduced_slope, by_flow * by_pressure)
    by_gap = (slope * (-2 * speed * up_to + 3 * flow[:, None] * ((b / gap) @ integral.T))) @ (weight * stretch)
    return Inlet(
        flow=flow,
        by_pressure=by_pressure,
        by_film=by_film,
        load=p @ (weight * stretch),
        load_by_pressure=at_given_flow / thickness.size,
        load_by_film=np.where(fed, 0.0, by_gap + by_flow * by_film) / thickness.size,
        shearing=(wet * slope * stretch / gap) @ weight,
        rolling=0.5 * (wet * gap * slope * (speed * by_square - flow[:, None] * b)) @ weight,
    )


def _ambient_thinning(problem: Problem, gap: FloatArray) -> Any:
    lubricant = problem.lubricant
    critical = [law.critical(0.0)[0] or np.inf for law in lubricant.shear_laws]
    return thinning(lubricant, lubricant.viscosity * problem.sliding / gap, critical, along=True)[0]


def _reduced(lubricant: Lubricant, pressure: FloatArray) -> tuple[np.ndarray, np.ndarray]:
    """Return ∫_0^p eta0/eta dp and its derivative, with the viscosity exponential between 0 and p."""
    fluid = cell_fluid(lubricant, pressure)
    log_mean, _, by = mean_fluidity(np.zeros_like(pressure), fluid.log_viscosity)
    mean = np.exp(log_mean)
    return mean * pressure, mean * (1 + by * fluid.log_slope * pressure)
