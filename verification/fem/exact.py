"""Closed forms and one-dimensional quadratures for rigid films, which the finite elements are held against.

They are written from the equations, with nothing from `lubfric` nor from `verification.fem.solvers`. U is the
entrainment speed, the mean of the two surface speeds, so that d/dx(h^3/(12 eta) dp/dx) = U dh/dx.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from ..types import FloatArray

if TYPE_CHECKING:
    from scipy.integrate._ivp.ivp import OdeResult


@dataclass(frozen=True, kw_only=True)
class Slider:
    """A plane slider without side flow. Its film falls linearly from ``inlet`` to ``outlet`` over ``length``.

    Rayleigh (1918, doi:10.1080/14786440108635730), with K = inlet/outlet - 1.
    """

    viscosity: float
    speed: float
    length: float
    inlet: float
    outlet: float

    def film(self, x: FloatArray) -> FloatArray:
        """Return film thickness at x = x[0] in m."""
        return self.inlet + (self.outlet - self.inlet) * x[0] / self.length

    def pressure(self, x: FloatArray) -> FloatArray:
        """Return ``12 eta U L/(a^2 - b^2) (a - h)(h - b)/h^2`` with a the inlet and b the outlet film."""
        a = self.inlet
        b = self.outlet
        h = self.film(x)
        return 12 * self.viscosity * self.speed * self.length / (a**2 - b**2) * (a - h) * (h - b) / h**2

    @property
    def load(self) -> float:
        """``12 eta U L^2/(a - b)^2 [ln(a/b) - 2 (a - b)/(a + b)]``, N/m."""
        a = self.inlet
        b = self.outlet
        lift = np.log(a / b) - 2 * (a - b) / (a + b)
        return float(12 * self.viscosity * self.speed * (self.length / (a - b)) ** 2 * lift)

    @property
    def flow(self) -> float:
        """``2 U a b/(a + b)``, m^2/s."""
        return 2 * self.speed * self.inlet * self.outlet / (self.inlet + self.outlet)


@dataclass(frozen=True, kw_only=True)
class Parabola:
    """A rigid parabolic film ``h0 + x^2/(2R)``, flooded from ``x = inlet sqrt(2 R h0)``, with Reynolds' outlet.

    In X = x/sqrt(2 R h0) the pressure is ``12 eta U sqrt(2 R h0)/h0^2 P(X)`` with ``dP/dX = (X^2 - Xe^2)/(1 + X^2)^3``.
    Xe is such that P vanishes at the inlet (Martin 1916; Gumbel 1916; for inlet = -inf, Xe = 0.4751299).
    """

    viscosity: float
    speed: float
    radius: float
    film_thickness: float
    inlet: float = -np.inf

    @property
    def scale(self) -> float:
        """``sqrt(2 R h0)`` in m."""
        return float(np.sqrt(2 * self.radius * self.film_thickness))

    @property
    def pressure_scale(self) -> float:
        """``12 eta U sqrt(2 R h0)/h0^2`` in Pa."""
        return 12 * self.viscosity * self.speed * self.scale / self.film_thickness**2

    @property
    def exit(self) -> float:
        """Xe, the place where both P and dP/dX vanish."""
        return float(brentq(lambda xe: antiderivative(xe, xe) - antiderivative(self.inlet, xe), 0.1, 2, xtol=1e-15))

    def film(self, x: FloatArray) -> FloatArray:
        """Return film thickness at x[0] in m."""
        return self.film_thickness + x[0] ** 2 / (2 * self.radius)

    def pressure(self, x: FloatArray) -> FloatArray:
        """Return pressure at x[0] in m, 0 beyond the exit."""
        xe = self.exit
        big = np.minimum(x[0] / self.scale, xe)
        return self.pressure_scale * (antiderivative(big, xe) - antiderivative(xe, xe))

    @property
    def load(self) -> float:
        """``integral p dx`` in N/m, by parts: ``- integral X dP``."""
        xe = self.exit
        lift = self._integral(lambda t: -np.tan(t) * (np.tan(t) ** 2 - xe**2) * np.cos(t) ** 4)
        return self.pressure_scale * self.scale * lift

    @property
    def flow(self) -> float:
        """``U h(exit)``, m^2/s."""
        return self.speed * self.film_thickness * (1 + self.exit**2)

    @property
    def couette(self) -> float:
        """``integral eta dx/h`` from inlet to exit, friction for unit sliding speed, N s/m^2."""
        return self.viscosity * self.scale / self.film_thickness * float(np.arctan(self.exit) - np.arctan(self.inlet))

    @property
    def rolling(self) -> float:
        """``integral (h/2) dp/dx dx``, N/m."""
        xe = self.exit
        lift = self._integral(lambda t: (np.tan(t) ** 2 - xe**2) * np.cos(t) ** 2)
        return self.pressure_scale * self.film_thickness / 2 * lift

    def _integral(self, f: Callable[[float], float]) -> float:
        """Return integral over t from inlet to exit, with X = tan t."""
        return float(quad(f, np.arctan(self.inlet), np.arctan(self.exit), epsabs=1e-13, epsrel=1e-13)[0])


def antiderivative(big_x: FloatArray | float, xe: float) -> FloatArray:
    """Return ``integral (X^2 - Xe^2)/(1 + X^2)^3 dX``, with X = tan t."""
    t = np.arctan(big_x)
    second = t / 2 + np.sin(2 * t) / 4
    fourth = 3 * t / 8 + np.sin(2 * t) / 4 + np.sin(4 * t) / 32
    return second - (1 + xe**2) * fourth


@dataclass(frozen=True, kw_only=True)
class ExponentialPad:
    """A pad of finite width with the film ``inlet exp(-g x)``, from ``inlet`` to ``outlet`` over ``length``.

    p = 0 on all four sides, with |y| <= width/2. The pressure is p = sum_n f_n(x) cos(k_n y) with k_n = n pi/width and
    n odd. Each f_n solves ``f'' - 3 g f' - k^2 f = c_n exp(2 g x)``, which is done by exponentials. The series is
    summed to ``terms`` terms. The tail of its load falls like ``terms^-4``, once ``k_n length`` is beyond 1.
    """

    viscosity: float
    speed: float
    length: float
    width: float
    inlet: float
    outlet: float
    terms: int = 400

    @property
    def decay(self) -> float:
        """g in 1/m."""
        return float(np.log(self.inlet / self.outlet) / self.length)

    def film(self, x: FloatArray) -> FloatArray:
        """Return film thickness at x[0] in m."""
        return self.inlet * np.exp(-self.decay * x[0])

    def modes(self) -> tuple[FloatArray, ...]:
        """Return for each n: k, particular amplitude, coefficients and exponents of the two homogeneous parts.

        The rising exponential is written about the outlet, so that neither overflows.
        """
        g = self.decay
        n = np.arange(1, 2 * self.terms, 2)
        k = n * np.pi / self.width
        drive = 4 / (n * np.pi) * (-1.0) ** ((n - 1) // 2)
        c = -12 * self.viscosity * self.speed * g / self.inlet**2 * drive
        root = np.sqrt(9 * g**2 + 4 * k**2)
        up = (3 * g + root) / 2
        down = (3 * g - root) / 2
        special = c / (4 * g**2 - 6 * g**2 - k**2)
        last = np.exp(2 * g * self.length)
        back = np.exp(-up * self.length)
        forth = np.exp(down * self.length)
        # special + first + second back = 0;  special last + first forth + second = 0
        first = special * (last * back - 1) / (1 - back * forth)
        second = -special * last - first * forth
        return k, special, first, second, up, down

    def pressure(self, x: FloatArray) -> FloatArray:
        """Return pressure at (x[0], x[1]) in m."""
        p = np.zeros(np.shape(x[0]))
        for k, special, first, second, up, down in zip(*self.modes(), strict=True):
            homogeneous = first * np.exp(down * x[0]) + second * np.exp(up * (x[0] - self.length))
            p += (special * np.exp(2 * self.decay * x[0]) + homogeneous) * np.cos(k * x[1])
        return p

    @property
    def load(self) -> float:
        """``integral p``, N."""
        k, special, first, second, up, down = self.modes()
        length = self.length
        g = self.decay
        homogeneous = first * np.expm1(down * length) / down - second * np.expm1(-up * length) / up
        along = special * np.expm1(2 * g * length) / (2 * g) + homogeneous
        return float((along * 2 / k * np.sin(k * self.width / 2)).sum())

    @property
    def wide_load(self) -> float:
        """Load per width of the infinitely wide pad, N/m, by quadrature."""
        g = self.decay
        length = self.length
        third = np.expm1(3 * g * length) / (3 * g)
        second = np.expm1(2 * g * length) / (2 * g)
        neck = second / third  # Q/U times 1/inlet: makes the pressure vanish at both ends
        scale = 12 * self.viscosity * self.speed / self.inlet**2
        lift = quad(lambda x: (length - x) * (np.exp(2 * g * x) - neck * np.exp(3 * g * x)), 0, length, epsrel=1e-13)[0]
        return float(scale * lift)

    @property
    def narrow_load(self) -> float:
        """Load of the infinitely narrow pad, N: ``eta U width^3 g integral h^-2 dx`` (Michell, Ocvirk)."""
        over = np.expm1(2 * self.decay * self.length) / (2 * self.decay * self.inlet**2)
        return float(self.viscosity * self.speed * self.width**3 * self.decay * over)


def reduced_to_true(reduced: FloatArray, alpha: float) -> FloatArray:
    """Return Barus pressure from the isoviscous one q of the same film: ``p = -ln(1 - alpha q)/alpha`` (Blok)."""
    return -np.log1p(-alpha * reduced) / alpha


def roelands_to_true(reduced: FloatArray, exponent: float, index: float, pressure: float = 1.96e8) -> FloatArray:
    """Return Roelands pressures from isoviscous ones, inverting ``q = integral_0^p eta(0)/eta(s) ds``.

    ``eta/eta0 = exp(exponent ((1 + s/pressure)^index - 1))``; solved point by point to rounding.
    """

    def fluidity(s: float) -> float:
        return float(np.exp(-exponent * ((1 + s / pressure) ** index - 1)))

    def solve(q: float) -> float:
        def over(p: float) -> float:
            return quad(fluidity, 0, p, epsrel=1e-12, epsabs=0)[0] - q if p else -q

        high = q
        while over(high) < 0:
            high *= 1.5
            if high > 1e3 * q:
                raise ValueError(f"no Roelands pressure belongs to a reduced pressure of {q:.4g} Pa")
        return float(brentq(over, 0, high, rtol=1e-13))

    flat = [solve(float(q)) if q > 0 else 0.0 for q in np.ravel(reduced)]
    return np.reshape(flat, np.shape(reduced))


def gas_slider(slider: Slider, ambient: float, points: np.ndarray) -> np.ndarray:
    """Return gauge pressure [Pa] of an isothermal ideal gas under a plane slider (Harrison 1913) at ``points`` in m.

    ``(p h^3/(12 eta)) dp/dx = p U h - q``, with absolute p, is integrated from the outlet upstream, which is the stable
    direction. The flow q is found such that the inlet is at ambient pressure. The relative error is below 1e-9.
    """

    def upstream(q: float, where: FloatArray | None = None) -> OdeResult:
        def rate(x: float, p: FloatArray) -> FloatArray:
            h = slider.film(np.array([x]))
            return 12 * slider.viscosity * (slider.speed / h**2 - q / (p * h**3))

        span = (slider.length, 0.0)
        return solve_ivp(rate, span, [ambient], "LSODA", t_eval=where, rtol=1e-11, atol=1e-9 * ambient)

    start = ambient * slider.speed * slider.outlet
    top = ambient * slider.speed * slider.inlet
    q = brentq(lambda q: upstream(q).y[0, -1] - ambient, start * (1 + 1e-9), top, xtol=1e-13 * top)
    order = np.argsort(-points)
    values = np.empty_like(points)
    values[order] = upstream(q, points[order]).y[0] - ambient
    return values
