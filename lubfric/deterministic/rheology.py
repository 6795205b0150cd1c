"""How a sheared fluid resists a pressure flow: the fluidity between two cells, and its change by the sliding.

The pressure flow through a face is ``-rho h³/(12 eta) Φ dp/dx``. 1/eta is averaged over the pressures between the two
cells, so that the flow follows the reduced pressure ∫ dp/eta. Φ >= 1 is the factor by which the sliding thins the
fluid. With s = eta Δu/(h tau), the Newtonian stress over a characteristic stress tau, it is:

- Ree-Eyring, tau = tau_E: along the sliding the tangent of its law, sqrt(1 + s²); across it the secant, s/asinh(s)
  (perturbation of a Couette flow: T. F. Conry, S. Wang, C. Cusano, J. Tribol. 109 (1987) 648-654,
  doi:10.1115/1.3261526);
- Carreau, tau = G: the tangent (1 + s²)^((3 - n)/2)/(1 + n s²), and the secant (1 + s²)^((1 - n)/2);
- limiting stress, tau = tau_0 + Λ p: the secant of ``1/eta_eff = 1/eta + Δu/(h tau)``, 1 + s in both directions, which
  is added to that of Eyring. (The tangent of a fluid at its limit is infinite.)
"""

from dataclasses import dataclass

import numpy as np

from ..oil import Lubricant, density_ratio, log_viscosity_ratio

THICKEST = 300.0  # of ln(eta/eta0): the exponential beyond it is not told from a solid's


@dataclass(frozen=True)
class CellFluid:
    """The laws at the pressures of the cells: ln(eta/eta0), rho/rho0, tau_0 + Λ p [Pa] (None: no limit), and their
    derivatives by p [1/Pa], [1/Pa], [-]."""

    log_viscosity: np.ndarray
    log_slope: np.ndarray
    density: np.ndarray
    density_slope: np.ndarray
    limit: np.ndarray | None
    limit_slope: float


def cell_fluid(lubricant: Lubricant, pressure) -> CellFluid:
    """The laws of ``lubricant`` at ``pressure`` [Pa], any shape."""
    log_viscosity, log_slope = log_viscosity_ratio(lubricant, pressure)
    density, density_slope = density_ratio(lubricant, pressure)
    coefficient = lubricant.limiting_stress_coefficient
    limit = None
    if coefficient is not None:
        limit = lubricant.limiting_stress_offset + coefficient * np.maximum(pressure, 0.0)
    return CellFluid(
        np.minimum(log_viscosity, THICKEST), log_slope, density, density_slope, limit, float(coefficient or 0.0)
    )


def mean_fluidity(left, right) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """ln of the mean of exp(-l) between l = ``left`` and ``right`` (l linear between them), and its derivatives by
    both."""
    d = right - left
    small = np.abs(d) < 1e-3
    size = np.abs(np.where(small, 1.0, d))
    mean = np.where(small, 1.0 - np.abs(d) / 2 + d * d / 6, -np.expm1(-size) / size)  # of exp(-(l - low))
    higher = np.where(small, -0.5 + np.abs(d) / 12, np.exp(-size) / -np.expm1(-size) - 1 / size)  # d ln(mean)/d|d|
    lower = -1.0 - higher
    falling = left > right
    log_mean = np.log(mean) - np.minimum(left, right)
    return log_mean, np.where(falling, higher, lower), np.where(falling, lower, higher)


def thinning(lubricant: Lubricant, newtonian_stress, limit, along: bool):
    """Φ [-] at the Newtonian stress eta Δu/h [Pa] on faces, with ``limit`` [Pa] their tau_0 + Λ p, or None; its
    derivative d ln Φ/d ln s; and the part of the derivative that belongs to the limiting stress."""
    eyring = lubricant.eyring_stress
    if lubricant.newtonian:
        return 1.0, 0.0, 0.0
    factor, slope = np.ones_like(newtonian_stress), np.zeros_like(newtonian_stress)
    if lubricant.carreau is not None:
        G, n = lubricant.carreau
        square = (newtonian_stress / G) ** 2
        factor = (1 + square) ** ((3 - n) / 2) / (1 + n * square) if along else (1 + square) ** ((1 - n) / 2)
        slope = (1 - n) * square / (1 + square)
        if along:
            slope = (3 - n) * square / (1 + square) - 2 * n * square / (1 + n * square)
        slope = slope * factor
    if eyring is not None:
        s = newtonian_stress / eyring
        if along:
            factor = np.hypot(1.0, s)
            slope = s * (s / factor)
        else:
            thick = s > 1e-4
            safe = np.where(thick, s, 1.0)
            factor = np.where(thick, safe / np.arcsinh(safe), 1.0 + s * s / 6)
            slope = np.where(thick, factor - factor**2 / np.hypot(1.0, safe), s * s / 3)
    limited = np.zeros_like(factor)
    if limit is not None:
        limited = newtonian_stress / limit
        factor = factor + limited
    return factor, (slope + limited) / factor, limited / factor
