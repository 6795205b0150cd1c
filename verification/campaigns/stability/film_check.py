"""Check whether a film is a solution. The check follows from the equations and contains no code of the solvers.

The pressure is read as piecewise linear between the nodes of the result. From it alone come the film in the middle of
every cell (the logarithmic kernel integrated in closed form), the flow through the cell (the fluidity 1/eta averaged
over the cell by Gauss points, with the exact pressure gradient), the load, and the sign conditions of cavitation.
"""

import math

import numpy as np

from lubfric.film import EHLResult

from ...fem.solvers.fluid import Fluid
from ...types import FloatArray, Keywords

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(12)


def deflection(points: np.ndarray, x: np.ndarray, p: np.ndarray, e_prime: float, reference: float) -> np.ndarray:
    """Return -(4/(pi E')) ∫ p ln(|points - x|/reference) dx of a piecewise linear pressure."""

    def log(t: FloatArray) -> FloatArray:
        return np.log(np.where(t == 0, 1.0, np.abs(t)) / reference)

    left = x[:-1] - points[:, None]
    right = x[1:] - points[:, None]
    slope = np.diff(p) / np.diff(x)
    at_point = p[:-1] - slope * left  # the linear piece continued to the point
    flat = right * (log(right) - 1) - left * (log(left) - 1)
    ramp = right**2 * (0.5 * log(right) - 0.25) - left**2 * (0.5 * log(left) - 0.25)
    return -4 / (math.pi * e_prime) * (at_point * flat + slope * ramp).sum(axis=1)


def film_deviations(result: EHLResult, case: Keywords) -> dict[str, float]:
    """Return deviations, all relative, of an `EHLResult` for the SI arguments ``case`` of its solver.

    - elastic: film at the nodes
    - load: relative
    - tension: -p/p_max
    - gap: film deficit behind the rupture point
    - flow: root mean square over the cells before rupture of (flow - q)/max(film, q), q the flow at rupture
    """
    sign = math.copysign(1.0, case["entrainment_speed"])
    order = slice(None) if sign > 0 else slice(None, None, -1)
    x = (sign * result.x)[order]
    p = result.pressure[order]
    h = result.film_thickness[order]
    radius = case["radius"]
    e_prime = case["e_prime"]
    shape = result.approach + deflection(x, x, p, e_prime, result.half_width) + x**2 / (2 * radius)
    before = x <= sign * result.rupture + 1e-12 * result.half_width
    flow = cell_flow(x, p, result, case)
    q = result.flow_film
    wet = before[1:]
    mid = 0.5 * (h[1:] + h[:-1])
    tail = 0.0 if case.get("inlet_length") else 0.5 * abs(x[0]) * p[0]
    load = 0.5 * ((p[1:] + p[:-1]) * np.diff(x)).sum() + tail
    at_rupture = h[before][-1]
    return {
        "elastic": float(np.max(np.abs(shape - h) / h)),
        "load": abs(load / case["load_per_width"] - 1),
        "tension": max(0.0, -float(p.min() / p.max())),
        "gap": max(0.0, 1 - float(h[~before].min() / at_rupture)) if (~before).any() else 0.0,
        "flow": float(np.sqrt(np.mean(((flow - q) / np.maximum(mid, q))[wet] ** 2))),
    }


def cell_flow(x: FloatArray, p: FloatArray, result: EHLResult, case: Keywords) -> np.ndarray:
    """Return mass flow through the middle of each cell over rho0 |U| [m]."""
    centre = 0.5 * (x[1:] + x[:-1])
    dx = np.diff(x)
    inside = 0.5 * (p[1:] + p[:-1])
    fluid = Fluid.of(case)
    bent = deflection(centre, x, p, case["e_prime"], result.half_width)
    h = result.approach + bent + centre**2 / (2 * case["radius"])
    steps = 0.5 * np.diff(p)[:, None] * POINTS
    fluidity = np.exp(-fluid.log_viscosity(np.maximum(inside[:, None] + steps, 0.0))) @ (0.5 * WEIGHTS)
    poiseuille = h**3 * fluidity * np.diff(p) / dx / (12 * case["viscosity"] * abs(case["entrainment_speed"]))
    return fluid.rho(inside) * (h - poiseuille)
