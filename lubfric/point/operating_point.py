"""Film and rough contact at one speed, on one grid, to given tolerances: each of them at a load, and both together."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..film.contract import Film, FilmLevel
from ..heat.point import film_lubricant
from ..line_contact import LineContact
from ..lubricant import Lubricant
from ..model import Model
from ..rough.contract import ContactState, RoughContact
from ..scene import Scene


@dataclass(frozen=True)
class Settings:
    """Film level, relative tolerances of the film and of the volume balance; how many cells a numerical film has at least;
    tolerance of the contact (None: its own)."""

    level: FilmLevel
    film_tolerance: float
    volume_tolerance: float
    film_cells: int = 0
    contact_tolerance: float | None = None


@dataclass(frozen=True)
class Trial:
    """Film and contact at one division of the load [N], found or to start from.

    start: the contact that the next one starts from, the last that touched; solved: cells of the films of this balance
    so far, the latest last. From the second on they keep to one grid, or the root of the balance has a jump.
    """

    film_load: float = 0.0
    contact_load: float = 0.0
    film: Film | None = None
    contact: ContactState | None = None
    start: ContactState | None = None
    solved: tuple[int, ...] = ()

    @property
    def least_cells(self) -> int:
        """Of the next film."""
        return max(self.solved[1:], default=0)

    def touching(self, contact_load: float, contact: ContactState) -> Trial:
        """The same film with the contact found."""
        start = self.start if contact.pressure is None else contact
        return replace(self, contact_load=contact_load, contact=contact, start=start)


@dataclass(frozen=True)
class OperatingPoint:
    """A model at one speed [m/s], not 0, to ``settings``, on ``contact``: the model's own, coarser, or a part of it."""

    model: Model
    speed: float
    contact: RoughContact
    settings: Settings

    @property
    def scene(self) -> Scene:
        """Of the model."""
        return self.model.scene

    def line(self, film_load: float) -> LineContact:
        """The smooth line contact of a film that carries ``film_load`` [N]; with Johnson's modulus E' F_H/F_T where the
        scene asks for it, so that the strip is that of the whole load."""
        bodies = self.scene.bodies
        share = film_load / bodies.load if self.scene.numerics.film_deflection == "scaled" else 1.0
        return LineContact(
            film_load / bodies.width, bodies.radius, bodies.e_prime * share, self.speed, self._film_lubricant
        )

    def with_film(self, film_load: float, last: Trial, imposed=None) -> Trial:
        """``last`` with the film that carries ``film_load`` [N] instead of its own."""
        film = self.settings.level.solve(
            self.line(film_load),
            tolerance=self.settings.film_tolerance,
            cells=max(self.settings.film_cells, last.least_cells),
            imposed=imposed,
            start=last.film,
        )
        return replace(last, film_load=film_load, film=film, solved=(*last.solved, film.cells))

    def with_contact(self, contact_load: float, last: Trial) -> Trial:
        """``last`` with the contact that carries ``contact_load`` [N] under its film."""
        film, shape = self.imposed_on(self.contact, last.film)
        return last.touching(contact_load, self._contact.close(film, contact_load, last.start, shape))

    def with_imposed_film(self, last: Trial) -> Trial:
        """``last`` with the load that the contact carries where its film is imposed on it."""
        film, shape = self.imposed_on(self.contact, last.film)
        return last.touching(*self._contact.carry(film, last.start, shape))

    def imposed_on(self, contact: RoughContact, film: Film) -> tuple[np.ndarray, np.ndarray]:
        """Film [m] at the x of ``contact``, and what the surface is pressed under there, up to a constant: the film, or less.

        With Johnson's modulus, or under the total pressure, the film holds the deflection of the whole load; the contact
        adds its own share itself.
        """
        thickness, way = film.film_at(contact.x), self.scene.numerics.film_deflection
        if way == "hydrodynamic":
            return thickness, thickness
        if way == "total":
            return thickness, thickness - film.imposed_deflection(contact.x)
        parabola = contact.x**2 / (2 * film.radius)
        return thickness, parabola + film.e_prime / self.scene.bodies.e_prime * (thickness - parabola)

    def suffices(self, whole: RoughContact, film: Film, state: ContactState) -> bool:
        """Nothing of ``whole`` outside the point's own contact, a part of it in ``state`` under ``film``, touches."""
        return self.contact is whole or whole.holds(self.contact, self.imposed_on(whole, film)[1], state)

    def guessed_split(self) -> float:
        """ln(F_H/F_C) where the rigid isoviscous film is two Sq thick."""
        scene, thickness = self.scene, max(2 * self.model.surface.sq, 1e-12)
        bodies = scene.bodies
        whole = 4.895 * scene.lubricant.viscosity * abs(self.speed) * bodies.radius * bodies.width
        share = min(whole / (thickness * bodies.load), 0.9)
        return math.log(share / (1 - share))

    @cached_property
    def _film_lubricant(self) -> Lubricant:
        """As viscous as it is in the inlet."""
        return film_lubricant(self.scene, self.speed)

    @property
    def _contact(self) -> RoughContact:
        tolerance = self.settings.contact_tolerance
        return self.contact if tolerance is None else self.contact.tightened(tolerance)
