"""Exact compliance of an elastic layer bonded to a rigid base, wave by wave, and how it nears the half-space.

A frictionless pressure ``p cos(k x)`` on the surface of a layer of thickness d moves it down by ``C(k) p cos(k x)``.
Two waves in x and y are one wave along (kx, ky). So the same C(|k|) serves plane strain and three dimensions.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad

from ...types import FloatArray
from .report import require

SMALL = 0.5  # of 2 k d, below which sinh(2kd) - 2kd is summed as a series
FAR = 60.0  # of k d, beyond which layer and half-space are the same in double precision


@dataclass(frozen=True)
class Elastic:
    """An isotropic body against a rigid one: ``young`` E in Pa, ``poisson`` in (-1, 0.5)."""

    young: float
    poisson: float

    def __post_init__(self) -> None:
        require(0 < self.young < np.inf, f"young = {self.young} Pa", "finite, > 0")
        require(-1 < self.poisson < 0.5, f"poisson = {self.poisson}", "(-1, 0.5), both ends excluded")

    @classmethod
    def from_e_prime(cls, e_prime: float, poisson: float) -> Elastic:
        """Return the body whose half-space has ``2/E' = (1 - nu^2)/E``."""
        return cls(e_prime * (1 - poisson**2) / 2, poisson)

    @property
    def e_prime(self) -> float:
        """E' in Pa."""
        return 2 * self.young / (1 - self.poisson**2)

    @property
    def oedometric(self) -> float:
        """Stiffness [Pa] against compression without lateral strain, ``E (1 - nu)/((1 + nu)(1 - 2 nu))``."""
        return self.young * (1 - self.poisson) / ((1 + self.poisson) * (1 - 2 * self.poisson))


def half_space_compliance(k: FloatArray | float, body: Elastic) -> FloatArray:
    """Return ``4/(E' |k|)`` in m/Pa for wavenumbers k > 0 in rad/m (Johnson 1985, Contact Mechanics, ch. 13)."""
    return 4 / (body.e_prime * np.asarray(k, dtype=float))


def layer_compliance(k: FloatArray | float, thickness: float, body: Elastic) -> FloatArray:
    """Return downward surface displacement of a bonded layer per pressure, m/Pa, at wavenumbers k >= 0 in rad/m.

    With s = k d and a Papkovich-Neuber (or Airy) solution whose four constants in each wave follow from no
    displacement at the base, no shear and the given pressure at the surface::

        C = 2 (1 - nu^2)/(E k) * [(3 - 4 nu) sinh 2s - 2 s]
            / [(3 - 4 nu) cosh 2s + 2 s^2 + 5 - 12 nu + 8 nu^2]

    for every admissible nu (G. Carbone & L. Mangialardi, J. Mech. Phys. Solids 56 (2008) 684-706,
    doi:10.1016/j.jmps.2007.05.009). Limits: ``4/(E' k)`` for s -> inf, ``d (1 + nu)(1 - 2 nu)/(E (1 - nu))``
    for s -> 0. Written here with powers of exp(-2s), so that it neither overflows nor cancels.
    """
    k = np.abs(np.asarray(k, dtype=float))
    s = k * thickness
    nu = body.poisson
    t = np.exp(-2 * s)
    kappa = 3 - 4 * nu
    excess = np.where(2 * s < SMALL, sinh_excess(2 * np.minimum(s, SMALL)) * t, (1 - t**2) / 2 - 2 * s * t)
    over_s = np.divide(excess, s, out=np.zeros_like(s), where=s > 0)
    above = kappa * over_s + 4 * (1 - 2 * nu) * t
    below = kappa * (1 + t**2) / 2 + (2 * s**2 + 5 - 12 * nu + 8 * nu**2) * t
    return 4 / body.e_prime * thickness * above / below


def sinh_excess(x: float | FloatArray) -> FloatArray:
    """Return ``sinh(x) - x`` for x up to 1, without cancellation, by five terms. The relative error is below 1e-11."""
    y = np.asarray(x) ** 2
    return x * y / 6 * (1 + y / 20 * (1 + y / 42 * (1 + y / 72 * (1 + y / 110))))


def missing(s: float, poisson: float) -> float:
    """Return ``1 - C_layer/C_half-space`` at s = k d, which is how much stiffer the layer is.

    For large s it is near ``q(s) exp(-2 s)`` with ``q = (4 s^2 + 4 s + 2 (5 - 12 nu + 8 nu^2))/(3 - 4 nu)``.
    """
    t = np.exp(-2 * s)
    kappa = 3 - 4 * poisson
    square = 2 * s**2 + 5 - 12 * poisson + 8 * poisson**2
    return float(t * (kappa * t + square + 2 * s) / (kappa * (1 + t**2) / 2 + square * t))


def curvature_number(poisson: float) -> float:
    """Return ``J = integral of s missing(s) ds`` over s > 0, which bends the surface of a layer next to a narrow load.

    Under a line load w the displacement differences of layer and half-space differ by ``(w/pi) integral (C_half-space -
    C_layer)(1 - cos k x) dk``. For x << d this is ``(2 w J/(pi E')) (x/d)^2``. So a Hertz contact of half-width b sees
    a curvature that is larger by the fraction ``J b^2/(2 d^2)``, and its peak pressure rises by half of that. (Derived
    here; the study `layer` finds it by finite elements.)
    """
    return float(quad(lambda s: s * missing(s, poisson), 0, FAR, epsabs=1e-12, epsrel=1e-10, limit=200)[0])
