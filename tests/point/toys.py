"""A film and a rough contact made outside of lubfric, whose balance is known in closed form."""

from dataclasses import dataclass, field

import numpy as np

from lubfric.contact import ContactState, RoughContact
from lubfric.errors import CONVERGED, Report
from lubfric.film import FilmLevel, LeftOut, ShearForce

EXACT = Report("exact", CONVERGED, 0, 0.0, 1e-6)


@dataclass(frozen=True)
class EvenFilm:
    """One thickness [m] everywhere: only what a balance and its shear ask for."""

    thickness: float
    load: float
    entrainment_speed: float
    radius: float
    e_prime: float
    report: Report = EXACT
    cells: int = 0
    imposed: None = None

    @property
    def pressure(self):
        return np.zeros(1)

    @property
    def min_film(self):
        return self.thickness

    @property
    def central_film(self):
        return self.thickness

    def film_at(self, x):
        return np.full(np.shape(x), self.thickness)

    def imposed_deflection(self, x):
        return np.zeros(np.shape(x))


@dataclass(frozen=True)
class EvenFilmLevel(FilmLevel):
    """h = stiffness U B/F_H, sheared over a length [m] by eta u_s/h; a length in ``neglects`` for the ladder."""

    name: str = "even"
    words: str = "even film"
    stiffness: float = 1.0
    length: float = 1e-3
    left: float = 0.0

    def solve(self, line, *, tolerance, cells=0, imposed=None, start=None):
        thickness = self.stiffness * abs(line.entrainment_speed) / line.load_per_width
        return EvenFilm(thickness, line.load_per_width, line.entrainment_speed, line.radius, line.e_prime)

    def left_out(self, film, line, allowed):
        return LeftOut({name: self.left for name in self.neglects})

    def shear(self, film, lubricant, *, slide_roll_ratio, width, contact_fraction, cavitated):
        rate = slide_roll_ratio * abs(film.entrainment_speed) / film.thickness
        return ShearForce(float(lubricant.viscosity * rate * self.length * width), 0.0)


@dataclass(frozen=True)
class Spring(RoughContact):
    """gap = touching - sigma (F_C/stiffness)^(2/3) [m], its load anywhere."""

    touching: float
    sigma: float
    stiffness: float
    x: np.ndarray = field(default_factory=lambda: np.linspace(-1e-6, 1e-6, 3))
    weight: np.ndarray = field(default_factory=lambda: np.ones(3))

    def close(self, film, load, start=None, shape=None):
        share = (load / self.stiffness) ** (2 / 3)
        return self.state(film, self.touching - min(self.sigma * share, 0.999 * self.touching))

    def carry(self, film, start=None, shape=None):
        gap = min(float(np.mean(film)), self.touching)
        return self.stiffness * ((self.touching - gap) / self.sigma) ** 1.5, self.state(film, gap)

    @property
    def name(self):
        return "a spring"

    def state(self, film, gap):
        return ContactState(gap, float(np.mean(film)), self.x, np.zeros(3), 0.0, 0.0)
