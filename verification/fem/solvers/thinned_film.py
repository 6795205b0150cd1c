"""The film of a fluid that shear thins, by finite elements: the flow of `ehl_film` with its Poiseuille part multiplied.

The factor is found from the profile across the film: the stress is linear, tau_m + z dp/dx, the rate of shear follows
from it, its mean is the sliding over the film and its first moment the flow. Both are summed by Simpson's rule, and
tau_m and the rate at a stress are found by Newton's method, in complex numbers, so that the tangent is exact.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from ...types import ComplexArray, FloatArray
from .ehl import EHLSolution, LineContact, solution_of, solve_ehl
from .ehl_film import FilmEquations
from .ehl_newton import Iterate, newton

STATIONS = 41  # across the film
STAGES = (125.0, 25.0, 5.0, 1.0)  # times the critical stress
SMALLEST = 1e-7  # of b, by which the first moment is divided
Z = np.linspace(-1, 1, STATIONS)
SIMPSON = np.where(np.arange(STATIONS) % 2, 4.0, 2.0)
SIMPSON[[0, -1]] = 1.0
SIMPSON /= SIMPSON.sum()


@dataclass(frozen=True)
class Law:
    """Rate of shear over stress, in units of the critical stress tau_c [Pa]: sinh of it (Ree-Eyring, exponent None), or
    Carreau's, ``stress = rate (1 + rate^2)^((n - 1)/2)`` with its exponent n."""

    critical: float
    exponent: float | None = None

    def rate(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the rate at the stress x and its derivative, real or complex."""
        if self.exponent is None:
            return np.sinh(x), np.cosh(x)
        n = self.exponent
        sign = np.where(np.real(x) < 0, -1.0, 1.0)
        size = x * sign + 1e-30
        r = np.where(np.real(size) < 1, size, size ** (1 / n))
        for _ in range(9):  # on the logarithm of both sides
            steep = 1 + (n - 1) * r * r / (1 + r * r)
            r = r * np.exp((np.log(size) - np.log(r) - (n - 1) / 2 * np.log(1 + r * r)) / steep)
        return r * sign, r / size / (1 + (n - 1) * r * r / (1 + r * r))


@dataclass(frozen=True, kw_only=True)
class ThinnedFilm(FilmEquations):
    """A `FilmEquations` of a fluid with a ``law``; stress_per_film [Pa]: the Newtonian stress of sliding at the film
    b^2/R and eta = eta0; pull [Pa]: h dp/dx/2 at that film and dP/dX = 1."""

    law: Law = Law(math.inf)
    stress_per_film: float = 0.0
    pull: float = 0.0

    def factor(
        self, P: ComplexArray | FloatArray, P1: ComplexArray | FloatArray, H: ComplexArray | FloatArray
    ) -> ComplexArray | FloatArray:
        """Return by which the pressure flow is larger than a Newtonian one."""
        s = self.stress_per_film * np.exp(self.log_viscosity(P)) / H / self.law.critical
        b = self.pull * np.where(np.real(P1) < 0, -P1, P1) * H / self.law.critical + SMALLEST
        s, b = np.broadcast_arrays(s[..., None], b[..., None])
        n = self.law.exponent
        a = np.log(s + np.sqrt(1 + s * s)) if n is None else s * (1 + s * s) ** ((n - 1) / 2)
        for _ in range(12):
            rate, slope = self.law.rate(a + b * Z)
            a = a - ((rate * SIMPSON).sum(-1, keepdims=True) - s) / (slope * SIMPSON).sum(-1, keepdims=True)
        moment = (self.law.rate(a + b * Z)[0] * Z * SIMPSON).sum(-1)
        return 3 * moment / b[..., 0]

    def flux(
        self,
        P: ComplexArray | FloatArray,
        P1: ComplexArray | FloatArray,
        H: ComplexArray | FloatArray,
        H1: ComplexArray | FloatArray,
        size: FloatArray,
    ) -> ComplexArray | FloatArray:
        """Return the flux with the thinned pressure flow."""
        return super().flux(P, P1, H, H1, size) + (1 - self.factor(P, P1, H)) * self.mobility(P, H) * P1


def solve_thinned(
    contact: LineContact, law: Law, sliding: float, *, refinements: int = 1
) -> tuple[EHLSolution, EHLSolution]:
    """Return the Newtonian solution on the finest mesh, and from it that of the fluid with a ``law`` between surfaces
    that slide at ``sliding`` [m/s]."""
    newtonian = solve_ehl(contact, refinements=refinements)[-1]
    body = newtonian.body
    plain = newtonian.film
    units = {
        "stress_per_film": contact.fluid.viscosity * sliding / contact.film_unit,
        "pull": 0.5 * contact.film_unit * contact.hertz_pressure / contact.half_width,
    }
    end = Iterate(newtonian.displacement, newtonian.P, newtonian.approach, newtonian.P <= 0)
    for times in STAGES:
        stage = replace(law, critical=times * law.critical)
        film = ThinnedFilm(
            line=plain.line,
            fluid=plain.fluid,
            hertz_pressure=plain.hertz_pressure,
            speed_parameter=plain.speed_parameter,
            penalty=plain.penalty,
            **units,
            law=stage,
        )
        end, flow, report = newton(body, film, end, 1e-7, 40)
        report.checked(None)
    return newtonian, solution_of(contact, newtonian.layout, body, film, end, flow=flow, report=report)
