"""One EHL line contact solved twice: by full-system finite elements and by `lubfric`."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass

import numpy as np

import lubfric

from ..fem.ehl import LineContact, Solution, solve_ehl
from ..fem.fluid import Fluid

ALPHA, E_PRIME, RADIUS = 2.2e-8, 2.2e11, 0.01
VISCOSITY = math.exp(ALPHA * 1.96e8 / 0.68 - 9.67)  # Roelands' z is 0.68
CONSTANT, COMPRESSIBLE = "constant", "dowson-higginson"


@dataclass(frozen=True)
class Pair:
    """One contact solved both ways: on all finite-element meshes, coarsest first, and by `lubfric`."""

    point: tuple[float, float, str]
    solutions: list[Solution]
    line: lubfric.EHLResult
    seconds: float

    @property
    def finest(self) -> Solution:
        """The solution on the finest mesh."""
        return self.solutions[-1]

    @property
    def label(self) -> str:
        """M, L, and the density law if it matters, in words."""
        M, L, density = self.point
        return f"M = {M:g}, L = {L:g}" + ("" if density == CONSTANT else ", compressible")

    def differences(self, s: Solution) -> tuple[float, float, float]:
        """Relative differences of flow film and smallest film, and the root mean square of that of the film over the
        contact, in flow films.

        The contact reaches here to 1.2 times the place where the film is expected to rupture.
        """
        width = 1.2 * s.layout.edges[1] * s.contact.half_width
        x = np.linspace(-width, width, 2001)
        off = s.at(x)[1] - self.line.film_at(x)
        return (
            s.flow_film / self.line.flow_film - 1,
            s.min_film / self.line.min_film - 1,
            float(np.sqrt(np.mean(off**2))) / self.line.flow_film,
        )


def make_contact(M: float, L: float, density_law: str = CONSTANT) -> LineContact:
    """A steel contact with Moes' numbers M and L > 0, Roelands oil."""
    speed_number = (L / (ALPHA * E_PRIME)) ** 4
    fluid = Fluid(VISCOSITY, "roelands", ALPHA, density_law=density_law.replace("-", "_"))
    return LineContact(
        M * math.sqrt(speed_number) * E_PRIME * RADIUS,
        RADIUS,
        E_PRIME,
        speed_number * E_PRIME * RADIUS / (2 * VISCOSITY),
        fluid,
    )


def solved(point: tuple[float, float, str], refinements: int) -> Pair:
    """Both solvers on one contact."""
    contact = make_contact(*point)
    start = time.perf_counter()
    solutions = solve_ehl(contact, refinements=refinements)
    seconds = time.perf_counter() - start
    line = lubfric.solve_ehl(
        load_per_width=contact.load_per_width,
        radius=contact.radius,
        e_prime=contact.e_prime,
        entrainment_speed=contact.entrainment_speed,
        viscosity=contact.fluid.viscosity,
        pressure_viscosity_coefficient=contact.fluid.pressure_viscosity_coefficient,
        density_law=point[2],
        tolerance=3e-5,
    )
    return Pair(point, solutions, line, seconds)
