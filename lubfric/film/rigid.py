"""The film between rigid surfaces, with the same interface as an `EHLResult`.

``h = h0 + x²/2R`` with Swift-Stieber rupture, at constant density. In the reduced pressure ``q = ∫ dp eta0/eta(p)``
Reynolds' equation is the isoviscous one. Its closed form is `lubfric.film.rigid_cylinder.pressure`. The load fixes h0:
directly for a constant viscosity, by one bracketed root with a viscosity law.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache, lru_cache

import numpy as np

from ..errors import CONVERGED, Report
from ..oil import Lubricant, log_viscosity_ratio, viscosity
from . import rigid_cylinder as rigid
from .line_contact import LineContact, OfLineContact

INLET, OUTLET = 30.0, 6.0  # ends of the nodes, in units of sqrt(2 R h0)
CELLS = 256  # before rupture, even in arsinh(x/sqrt(2 R h0))
TABLE = 4000  # points of q(p), up to alpha p = FARTHEST
FARTHEST = 1e4


@dataclass(frozen=True)
class RigidFilm(OfLineContact):
    """Steady rigid film, SI units, the names those of `EHLResult`; arrays (n,), x ascending.

    The nodes are x = sqrt(2 R h0) `unit_nodes`, then the cavitated ones; mirrored where entrainment_speed < 0.
    """

    x: np.ndarray
    pressure: np.ndarray
    film_thickness: np.ndarray
    viscosity: np.ndarray
    min_film: float
    central_film: float
    flow_film: float
    rupture: float
    contact: LineContact
    report: Report
    cells: int = 0  # no grid to refine
    imposed: None = None  # nothing deflects it

    def film_at(self, x) -> np.ndarray:
        """Film thickness [m] at any positions ``x`` [m]."""
        return self.min_film + np.asarray(x, dtype=float) ** 2 / (2 * self.radius)

    def imposed_deflection(self, x) -> np.ndarray:
        """Zero [m]: the surfaces are rigid."""
        return np.zeros(np.shape(x))


@cache
def unit_nodes() -> np.ndarray:
    """x/sqrt(2 R h0) of the nodes before rupture, the last at the rupture point."""
    return np.sinh(np.linspace(-math.asinh(INLET), math.asinh(rigid.rigid_constants().rupture), CELLS + 1))


@cache
def _all_nodes() -> np.ndarray:
    """x/sqrt(2 R h0) of all nodes, those of the cavitated film too."""
    nodes = unit_nodes()
    return np.concatenate([nodes, np.geomspace(1.0, OUTLET / nodes[-1], 17)[1:] * nodes[-1]])


@cache
def _unit_pressure() -> tuple[np.ndarray, np.ndarray]:
    """The isoviscous pressure at `unit_nodes`, and the weights of its integral over x/sqrt(2 R h0), which include the
    inlet's tail ~ 1/x³ before the first node: pure numbers."""
    nodes = unit_nodes()
    cells = np.diff(nodes)
    weight = 0.5 * (np.append(cells, 0.0) + np.append(0.0, cells))
    weight[0] -= 0.5 * nodes[0]
    return rigid.pressure(nodes, 0.5, radius=1.0, entrainment_speed=1.0, viscosity=1 / 48), weight


def isoviscous_film(line: LineContact) -> RigidFilm:
    """The film of a constant viscosity, h0 = 4.895 eta0 U R/w. The viscosity returned is the lubricant's at that
    pressure. E' is kept, but not used."""
    return _film(line, line.rigid_film, np.positive, "rigid isoviscous film")


def piezoviscous_film(line: LineContact) -> RigidFilm:
    """The film of the lubricant's viscosity law at constant density; E' is kept, not used.

    ln h0 is the root of ∫ p dx = w, to 1e-9. A Barus film carries any load at h0 above Blok's limit.
    """
    from scipy.optimize import brentq

    if line.lubricant.viscosity_law == "constant":
        return _film(line, line.rigid_film, np.positive, "rigid piezoviscous film")
    law, (pressure, weight) = true_pressure(line.lubricant), _unit_pressure()

    def surplus(log_h0):
        h0 = math.exp(log_h0)
        p = law(_pressure_unit(line, h0) * pressure)
        carried = math.sqrt(2 * line.radius * h0) * float(np.einsum("i,i", weight, p))
        return math.log(carried / line.load_per_width) if math.isfinite(carried) else 1e3

    low = math.log(line.rigid_film) - 1e-3
    high = low + 0.1
    while surplus(high) > 0:
        low, high = high, high + 2 * (high - low)
    h0 = math.exp(brentq(surplus, low, high, xtol=1e-9, rtol=1e-12))
    return _film(line, h0, law, "rigid piezoviscous film")


def _pressure_unit(line: LineContact, h0: float) -> float:
    """12 eta0 U sqrt(2 R h0)/h0² [Pa]: the isoviscous pressure is this times that of `_unit_pressure`."""
    return 12 * line.lubricant.viscosity * abs(line.entrainment_speed) * math.sqrt(2 * line.radius * h0) / h0**2


@lru_cache(maxsize=16)
def true_pressure(lubricant: Lubricant):
    """p(q) [Pa] by the lubricant's law: the inverse of q = ∫ dp eta0/eta(p), infinite above the largest possible q."""
    if lubricant.viscosity_law == "constant":
        return np.positive
    alpha = lubricant.pressure_viscosity_coefficient
    if lubricant.viscosity_law == "barus":

        def barus(q):
            with np.errstate(divide="ignore"):
                return -np.log1p(-np.minimum(alpha * q, 1.0)) / alpha

        return barus
    p, q = _table(lubricant)
    ratio = np.append(1.0, p[1:] / q[1:])  # smooth where q is small
    return lambda reduced: reduced * np.interp(reduced, q, ratio, right=math.inf)


def reduced_pressure(lubricant: Lubricant):
    """q(p) = ∫ dp eta0/eta(p) [Pa] by the lubricant's law: the inverse of `true_pressure`."""
    if lubricant.viscosity_law == "constant":
        return np.positive
    alpha = lubricant.pressure_viscosity_coefficient
    if lubricant.viscosity_law == "barus":
        return lambda pressure: -np.expm1(-alpha * pressure) / alpha
    p, q = _table(lubricant)
    return lambda pressure: np.interp(pressure, p, q)


def _table(lubricant: Lubricant) -> tuple[np.ndarray, np.ndarray]:
    """Pressures and reduced pressures [Pa]."""
    p = np.expm1(np.linspace(0.0, math.log1p(FARTHEST), TABLE)) / lubricant.pressure_viscosity_coefficient
    fluidity = np.exp(-np.minimum(log_viscosity_ratio(lubricant, p)[0], 700.0))
    return p, np.concatenate([[0.0], np.cumsum(0.5 * (fluidity[1:] + fluidity[:-1]) * np.diff(p))])


def _film(line: LineContact, h0: float, law, solver: str) -> RigidFilm:
    constants, scale = rigid.rigid_constants(), math.sqrt(2 * line.radius * h0)
    x, (unit, weight) = scale * _all_nodes(), _unit_pressure()
    p = np.zeros(x.size)
    p[: CELLS + 1] = law(_pressure_unit(line, h0) * unit)
    p[CELLS] = 0.0
    sign = math.copysign(1.0, line.entrainment_speed)
    order = slice(None) if sign > 0 else slice(None, None, -1)
    carried = scale * float(np.einsum("i,i", weight, p[: CELLS + 1]))
    residual = abs(carried / line.load_per_width - 1)
    with np.errstate(over="ignore"):  # far above its range: infinite beyond e^709, as in an EHLResult
        eta = viscosity(line.lubricant, p)[order]
    return RigidFilm(
        x=(sign * x)[order],
        pressure=p[order],
        film_thickness=(h0 + x**2 / (2 * line.radius))[order],
        viscosity=eta,
        min_film=h0,
        central_film=h0,
        flow_film=constants.flow_film_ratio * h0,
        rupture=sign * scale * constants.rupture,
        contact=line,
        report=Report(solver, CONVERGED, 0, residual, 1e-3, residuals={"load": residual}),
    )
