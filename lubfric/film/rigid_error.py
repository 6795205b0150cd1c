"""What a rigid film leaves out, to first order, computed from the rigid film itself."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from ..oil import Lubricant, density_ratio, log_viscosity_ratio
from .contract import Film
from .kernel import hat_kernel
from .rigid import CELLS, unit_nodes

STRIDE = 2  # of the nodes: the deflection is smooth
STIFFEST = 50.0  # ln(eta/eta0): a rigid film of such pressures means nothing


@cache
def _unit_deflection() -> tuple[np.ndarray, np.ndarray]:
    """Nodes and kernel of the rigid film in units of sqrt(2 R h0): pure numbers."""
    nodes = unit_nodes()[::STRIDE]
    return nodes, hat_kernel(nodes, nodes)


def elastic_error(film: Film, lubricant: Lubricant) -> float:
    """First-order effect of the elastic deflection by the pressure of a rigid film on `unit_nodes`, at the same load.

    A small change d(x) of the film changes the reduced pressure by dq' = 12 eta0 U ((d - dr)/h³ - 3 (h - hr) d/h⁴),
    with hr the film at rupture, and dr such that dq vanishes there. It changes the load by ∫ (eta/eta0) dq dx. d is the
    deflection plus the shift that keeps the load. Returned is the larger of |d|/h at the centre and the change of ∫
    eta/h dx. For M -> 0 both are a number times M². Infinite if the viscosity rises above e^50.
    """
    nodes, kernel = _unit_deflection()
    sign = math.copysign(1.0, film.entrainment_speed)
    order = slice(None) if sign > 0 else slice(None, None, -1)
    p = film.pressure[order][: CELLS + 1 : STRIDE]
    rise = log_viscosity_ratio(lubricant, p)[0]
    if not rise.max() < STIFFEST:
        return math.inf
    thin = np.exp(rise)
    length = math.sqrt(2 * film.radius * film.min_film)
    x, h = length * nodes, film.min_film * (1 + nodes**2)
    bend = length / film.e_prime * (kernel @ p)
    bend -= np.interp(0.0, x, bend)
    cells = np.diff(x)

    def integral(values):
        return np.sum(0.5 * (values[1:] + values[:-1]) * cells)

    def load_change(d):
        slope = d / h**3 - 3 * (h - film.flow_film) * d / h**4
        slope = slope - integral(slope) / integral(h**-3) / h**3
        q = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * cells)])
        return integral(thin * q)

    change = bend - load_change(bend) / load_change(np.ones_like(h))
    central = abs(float(np.interp(0.0, x, change))) / film.min_film
    shear = abs(integral(thin * change / h**2)) / integral(thin / h)
    return float(max(central, shear))


def compression(film: Film, lubricant: Lubricant) -> float:
    """Largest relative rise of the density, which a film of constant density leaves out."""
    return float(density_ratio(lubricant, film.pressure.max())[0]) - 1
