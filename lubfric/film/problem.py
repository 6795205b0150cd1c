"""The steady line contact in Moes' similarity variables.

With the units of `lubfric.film.hertz`, x = R U1^(1/4) X, h = R U1^(1/2) H, p = E' U1^(1/4) P:

    d/dX( rho H^3/(6 eta) dP/dX ) = d(rho H)/dX                  Reynolds
    H = H00 + X^2/2 - (4/pi) ∫ P(X') ln|X - X'| dX'              elastic film
    ∫ P dX = M                                                   load

rho and eta relative to their ambient values, d ln(eta)/dP = L at ambient pressure.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Any

import numpy as np

from .._base import FloatArray
from ..errors import InputError
from ..oil import ShearLaw, density_ratio, log_viscosity_ratio
from .formulas import moes_film, starved_inlet, starved_share
from .hertz import LineContact
from .thinning import thinned

# Film over Moes' film [-] above which a guess of the inlet makes no sense. A choice, near 1, where the inverse of the
# law is infinite.
MOST_STARVED = 0.995


def film_problem(line: LineContact) -> FilmProblem:
    """Return the contact in Moes' units, along its motion, with all the lubricant that its inlet takes. Raises
    `InputError` if the lubricant begins inside the dry contact."""
    problem = FilmProblem(line)
    length = line.lubricant.inlet_length
    half_width = problem.half_width * problem.length_unit
    if length is None:
        return problem
    if length <= half_width:
        message = f" = {length:g} m lies inside the dry contact, where no film begins"
        raise InputError(message, "inlet_length", f"more than its half-width {half_width:.4g} m")
    return replace(problem, inlet=length / problem.length_unit)


@dataclass(frozen=True)
class FilmProblem:
    """A line contact in Moes' units, seen along its motion: X points downstream.

    The lubricant begins at ``inlet``, None: nowhere, it is fully flooded. fed: None, or the flow q that arrives, with
    which the inlet is not known, and ``inlet`` is a guess of it; both in Moes' units. On the way to a solution the
    lubricant has so many ``times`` its critical stress (inf: its flow is Newtonian).
    """

    line: LineContact
    inlet: float | None = None
    fed: float | None = None
    times: float = 1.0

    # the numbers and units of the contact: M, L [-]; units of x [m], h [m], p [Pa]
    M = property(attrgetter("line.M"))
    L = property(attrgetter("line.L"))
    length_unit = property(attrgetter("line.length_unit"))
    film_unit = property(attrgetter("line.film_unit"))
    pressure_unit = property(attrgetter("line.pressure_unit"))

    @property
    def half_width(self) -> float:
        """Hertz half-width in units of x."""
        return math.sqrt(8.0 * self.M / math.pi)

    @property
    def flooded_film(self) -> float:
        """Moes' film of a flooded inlet."""
        return moes_film(self.M, self.L)

    @property
    def film_guess(self) -> float:
        """Moes' film; less if the lubricant begins within the length on which a flooded film builds up."""
        if self.inlet is None:
            return self.flooded_film
        if self.fed is not None:
            return min(self.fed, self.flooded_film)
        return self.flooded_film * starved_share(self.inlet, self.rise, self.half_width)

    @property
    def rise(self) -> float:
        """√(2 R h) of `flooded_film`, the length on which it builds up before a narrow contact."""
        return math.sqrt(2.0 * self.flooded_film)

    def inlet_of(self, flow: float) -> float:
        """Return where about the lubricant begins, if ``flow`` arrives and the full inlet takes more."""
        share = min(flow / self.flooded_film, MOST_STARVED)
        return starved_inlet(share, self.rise, self.half_width)

    def softened(self, share: float) -> FilmProblem:
        """Return the same contact with ``share`` of the pressure-viscosity coefficient (same units, same M)."""
        if share == 1.0:
            return self
        oil = self.line.lubricant
        oil = replace(oil, pressure_viscosity_coefficient=share * oil.pressure_viscosity_coefficient)
        return replace(self, line=replace(self.line, lubricant=oil))

    @property
    def thins_by(self) -> ShearLaw | None:
        """Return the law by which shear makes the flow thinner than a Newtonian one; None: it does not."""
        law = self.line.lubricant.flow_law
        sheared = self.line.sliding is not None and self.times < math.inf
        return law if law is not None and law.thins and sheared else None

    def thinned(self, fluidity: FloatArray, H: FloatArray, gradient: FloatArray) -> tuple[Any, ...]:
        """Factor Φ of the pressure flow where 1/eta, film and dP/dX are given (n,), s dΦ/ds and b dΦ/db (`thinned`)."""
        line = self.line
        law = self.thins_by
        if law is None:
            return 1.0, 0.0, 0.0
        critical = self.times * law.critical(0.0)[0]
        sliding = abs(line.sliding or 0.0)
        s = line.lubricant.viscosity * sliding / (self.film_unit * critical) / (fluidity * H)
        b = 0.5 * self.pressure_unit * self.film_unit / (self.length_unit * critical) * np.abs(gradient) * H
        return thinned(law, s, b)

    def log_viscosity(self, P: FloatArray) -> tuple[np.ndarray, np.ndarray]:
        """Return ln(eta/eta0) and its derivative with respect to P."""
        value, slope = log_viscosity_ratio(self.line.lubricant, P * self.pressure_unit)
        return value, slope * self.pressure_unit

    def density(self, P: FloatArray) -> tuple[np.ndarray, np.ndarray]:
        """Return rho/rho0 and its derivative with respect to P."""
        value, slope = density_ratio(self.line.lubricant, P * self.pressure_unit)
        return value, slope * self.pressure_unit
