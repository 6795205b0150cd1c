"""The levels between rigid surfaces: isoviscous in closed form, piezoviscous by one root."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..line_contact import LineContact
from .contract import Film, FilmLevel, LeftOut
from .rigid import RigidFilm, isoviscous_film, piezoviscous_film
from .rigid_error import compression, elastic_error


@dataclass(frozen=True)
class Isoviscous(FilmLevel):
    """Martin's film: no deflection, no rise of the viscosity, no compression."""

    name: str = "isoviscous"
    words: str = "rigid isoviscous"
    neglects: tuple[str, ...] = ("elastic", "piezoviscous", "density")

    def solve(
        self, line: LineContact, *, tolerance: float, cells: int = 0, imposed=None, start: Film | None = None
    ) -> RigidFilm:
        """The film in closed form; only ``line`` is used."""
        return isoviscous_film(line)

    def left_out(self, film: Film, line: LineContact, allowed: float = math.inf) -> LeftOut:
        """To first order; the piezoviscous part is the difference of the two rigid films."""
        found = {"elastic": elastic_error(film, line.lubricant), "density": compression(film, line.lubricant)}
        if not found["elastic"] + found["density"] <= allowed:
            return LeftOut(found)
        thick = piezoviscous_film(line)
        return LeftOut(
            {"elastic": found["elastic"], "piezoviscous": abs(thick.min_film / film.min_film - 1)}
            | {"density": found["density"]}
        )


@dataclass(frozen=True)
class Piezoviscous(FilmLevel):
    """The viscosity law of the lubricant: no deflection, no compression."""

    name: str = "piezoviscous"
    words: str = "rigid piezoviscous"
    neglects: tuple[str, ...] = ("elastic", "density")

    def solve(
        self, line: LineContact, *, tolerance: float, cells: int = 0, imposed=None, start: Film | None = None
    ) -> RigidFilm:
        """The film to 1e-9 always; only ``line`` is used."""
        return piezoviscous_film(line)

    def left_out(self, film: Film, line: LineContact, allowed: float = math.inf) -> LeftOut:
        """What it leaves out, to first order."""
        return LeftOut({"elastic": elastic_error(film, line.lubricant), "density": compression(film, line.lubricant)})
