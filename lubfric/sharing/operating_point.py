"""Film and rough contact at one speed, on one grid, to given tolerances: each at its own load, or both together."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..contact import ContactState, RoughContact
from ..errors import InputError
from ..film import Film, FilmLevel, LineContact
from ..oil import Lubricant
from ..scene import Scene
from .heat import film_lubricant
from .prepared import Prepared


@dataclass(frozen=True)
class Settings:
    """Film level; relative tolerances of the film and of the volume balance; the least number of cells of a numerical
    film; tolerance of the contact (None: its own); and the volume residual to aim at, which finer grids are expected to
    remove."""

    level: FilmLevel
    film_tolerance: float
    balance_tolerance: float
    film_cells: int = 0
    contact_tolerance: float | None = None
    aim: float = 0.0


@dataclass(frozen=True)
class Start:
    """Where a trial starts: from the film of a neighbour, and from the last contact that touched (None: none).

    ``solved``: cells of the films of this balance so far, the latest last. From the second film on all keep to one
    grid, because otherwise the root of the balance would have a jump.
    """

    film: Film | None = None
    touched: ContactState | None = None
    solved: tuple[int, ...] = ()

    @property
    def least_cells(self) -> int:
        """Least number of cells of the next film."""
        return max(self.solved[1:], default=0)


@dataclass(frozen=True, kw_only=True)
class Trial(Start):
    """Film and contact at one division of the load [N]. The next trial starts from it."""

    film: Film
    contact: ContactState
    film_load: float
    contact_load: float


@dataclass(frozen=True)
class OperatingPoint:
    """A model at one speed [m/s], not 0, with ``settings``, on ``contact``: the scene's own, coarser, or a part of it.

    ``alone``: the film of the whole load, where it was solved. The first numerical film may start from it.
    """

    prepared: Prepared
    speed: float
    contact: RoughContact
    settings: Settings
    alone: Film | None = None

    @property
    def scene(self) -> Scene:
        """The scene of the model."""
        return self.prepared.scene

    def line(self, film_load: float) -> LineContact:
        """The smooth line contact of a film that carries ``film_load`` [N]. Where the scene asks for it, it has
        Johnson's modulus E' F_H/F_T, with which the Hertz strip is that of the whole load."""
        bodies = self.scene.bodies
        share = film_load / bodies.load if self.scene.numerics.film_deflection == "scaled" else 1.0
        return LineContact(
            film_load / bodies.width, bodies.radius, bodies.e_prime * share, self.speed, self._film_lubricant
        )

    def trial(self, film_load: float, contact_load: float, start: Start, imposed=None) -> Trial:
        """The film that carries ``film_load`` [N], and under it the contact that carries ``contact_load`` [N].
        ``imposed``: a further pressure that deflects the film."""
        found = self.film(film_load, start, imposed)
        film, shape = self.film_on(self.contact, found)
        contact = self._contact.close(film, contact_load, start.touched, shape)
        return self._trial(film_load, contact_load, found, contact, start)

    def trial_with_imposed_film(self, film_load: float, start: Start) -> Trial:
        """The film that carries ``film_load`` [N], and the contact on which it is imposed. The load of the contact
        follows."""
        found = self.film(film_load, start)
        film, shape = self.film_on(self.contact, found)
        contact_load, contact = self._contact.carry(film, start.touched, shape)
        return self._trial(film_load, contact_load, found, contact, start)

    def film_on(self, contact: RoughContact, film: Film) -> tuple[np.ndarray, np.ndarray]:
        """Film [m] at the x of ``contact``, and the shape under which the surface is pressed there, up to a constant.

        The shape is the film, unless the film already contains the deflection by the whole load (Johnson's modulus, or
        the total pressure). Then it is the film less the contact's share, because the contact adds its own deflection.
        """
        thickness, way = film.film_at(contact.x), self.scene.numerics.film_deflection
        if way == "total":
            return thickness, thickness - film.imposed_deflection(contact.x)
        if way != "scaled":
            return thickness, thickness
        parabola = contact.x**2 / (2 * film.radius)
        return thickness, parabola + film.e_prime / self.scene.bodies.e_prime * (thickness - parabola)

    def suffices(self, whole: RoughContact, film: Film, state: ContactState) -> bool:
        """Whether the point's own contact, a part of ``whole``, is enough: nothing outside it touches, in ``state``
        under ``film``."""
        return self.contact is whole or whole.holds(self.contact, self.film_on(whole, film)[1], state)

    def guessed_split(self) -> float:
        """ln(F_H/F_C) at which the rigid isoviscous film is two Sq thick."""
        thickness = max(2 * self.prepared.surface.sq, 1e-12)
        share = min(self.line(self.scene.bodies.load).rigid_film / thickness, 0.9)
        return math.log(share / (1 - share))

    def film(self, film_load: float, start: Start, imposed=None) -> Film:
        """The film that carries ``film_load`` [N], also deflected by the line pressure ``imposed``."""
        near = start.film if start.film is not None and start.film.cells else self.alone
        found = self.settings.level.solve(
            self.line(film_load),
            tolerance=self.settings.film_tolerance,
            cells=max(self.settings.film_cells, start.least_cells),
            imposed=imposed,
            start=near,
        )
        if found.entrainment_speed != self.speed:  # its shear would be that of other surfaces
            raise InputError(
                f"film level {self.settings.level.name!r} gives a film with entrainment_speed = "
                f"{found.entrainment_speed:g} m/s; allowed: that of its line, {self.speed:g} m/s (of a film solved at "
                "another one: dataclasses.replace(film, contact=line))"
            )
        return found

    @staticmethod
    def _trial(film_load: float, contact_load: float, film: Film, contact: ContactState, start: Start) -> Trial:
        return Trial(
            film=film,
            contact=contact,
            film_load=film_load,
            contact_load=contact_load,
            touched=start.touched if contact.pressure is None else contact,
            solved=(*start.solved, film.cells),
        )

    @cached_property
    def _film_lubricant(self) -> Lubricant:
        """The lubricant with the viscosity that it has in the inlet."""
        return film_lubricant(self.scene, self.speed)

    @property
    def _contact(self) -> RoughContact:
        tolerance = self.settings.contact_tolerance
        return self.contact if tolerance is None else self.contact.tightened(tolerance)
