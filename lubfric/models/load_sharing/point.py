"""Film and rough contact at one speed: each at its own share of the load."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...contact import ContactState, RoughContact
from ...film import Effort, EHLResult, LineContact, solve_line_contact
from ...oil import Lubricant
from ...scene import Scene
from ..shared import film_lubricant


@dataclass(frozen=True, kw_only=True)
class Settings:
    """How closely a balance is solved.

    Attributes
    ----------
    film_tolerance, balance_tolerance : relative tolerances of the film and of the volume balance
    film_cells : least number of cells of the film
    contact_tolerance : of the rough contact; None: its own
    is_correctable : whether what the root leaves open is corrected to first order afterwards
    """

    film_tolerance: float
    balance_tolerance: float
    film_cells: int = 0
    contact_tolerance: float | None = None
    is_correctable: bool = False


@dataclass(frozen=True, kw_only=True)
class Trial:
    """Film and contact at one division of the load.

    Attributes
    ----------
    film, contact_state : both at their loads
    film_load, contact_load : F_H and F_C [N]
    last_touching : the last contact that touched; None: none did
    film_cells : cells of the films so far. From the second on all keep to one grid, because otherwise the root of the
        balance would have a jump
    """

    film: EHLResult
    contact_state: ContactState
    film_load: float
    contact_load: float
    last_touching: ContactState | None = None
    film_cells: int = 0


@dataclass(frozen=True)
class Point:
    """``scene`` at one speed [m/s], not 0, on ``rough_contact``, solved with ``settings``."""

    scene: Scene
    speed: float
    rough_contact: RoughContact
    settings: Settings

    def line(self, film_load: float) -> LineContact:
        """Return the smooth line contact of a film that carries ``film_load`` [N]. Unless the film is deflected by its
        own pressure alone, it has Johnson's modulus E' F_H/F_T, with which the Hertz strip is that of the total load
        (K. L. Johnson, J. A. Greenwood, S. Y. Poon, Wear 19 (1972) 91-108, doi:10.1016/0043-1648(72)90445-0)."""
        bodies = self.scene.bodies
        share = film_load / bodies.load if self.scene.numerics.film_deflection == "scaled" else 1.0
        load = film_load / bodies.width
        e_prime = bodies.e_prime * share
        return replace(self.scene.line_contact(self.speed), load_per_width=load, e_prime=e_prime, lubricant=self.oil)

    def film(self, film_load: float, start: EHLResult | None = None, cells: int = 0) -> EHLResult:
        """Solve the film that carries ``film_load`` [N]."""
        effort = Effort(self.settings.film_tolerance, max(self.settings.film_cells, cells))
        return solve_line_contact(self.line(film_load), effort, start=start)

    def on(self, rough_contact: RoughContact, film: EHLResult) -> tuple[np.ndarray, np.ndarray]:
        """Return the film [m] at the x of ``rough_contact``, and the shape under which the surface is pressed there, up
        to a constant.

        The shape is the film, unless the film contains the deflection by the total load (Johnson's modulus). Then it
        is the film less the contact's share, because the contact adds its own deflection.
        """
        thickness = film.film_at(rough_contact.x)
        if self.scene.numerics.film_deflection != "scaled":
            return thickness, thickness
        parabola = rough_contact.x**2 / (2 * film.radius)
        return thickness, parabola + film.e_prime / self.scene.bodies.e_prime * (thickness - parabola)

    def trial(self, film_load: float, contact_load: float, last: Trial | None = None) -> Trial:
        """Solve the film of ``film_load`` [N], and under it the contact that carries ``contact_load`` [N], from
        ``last``."""
        if last is None:
            film = self.film(film_load)
            contact_state = self.pressed(self.rough_contact, film, contact_load, None)
            last_touching = None
            cells = 0
        else:
            film = self.film(film_load, last.film, last.film_cells)
            contact_state = self.pressed(self.rough_contact, film, contact_load, last.last_touching)
            last_touching = last.last_touching
            cells = max(film.cells, last.film_cells)
        if contact_load > 0:
            last_touching = contact_state
        return Trial(
            film=film,
            contact_state=contact_state,
            film_load=film_load,
            contact_load=contact_load,
            last_touching=last_touching,
            film_cells=cells,
        )

    def pressed(
        self, rough_contact: RoughContact, film: EHLResult, load: float, start: ContactState | None
    ) -> ContactState:
        """Press ``rough_contact`` under ``film``, with ``load`` [N]."""
        thickness, shape = self.on(rough_contact, film)
        return self.tight(rough_contact).close(thickness, load, start, shape)

    def tight(self, rough_contact: RoughContact) -> RoughContact:
        """Return ``rough_contact``, solved as closely as the settings ask."""
        tolerance = self.settings.contact_tolerance
        return rough_contact if tolerance is None else rough_contact.tightened(tolerance)

    @cached_property
    def oil(self) -> Lubricant:
        """The lubricant with the viscosity that it has in the inlet."""
        return film_lubricant(self.scene, self.speed)
