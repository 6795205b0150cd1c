"""The levels of the film, the simplest first, and the choice of the lowest one that is enough for a line contact."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import cast

from ..oil import Lubricant
from .contract import Film, FilmLevel, LeftOut
from .ehl import Effort, solve_line_contact
from .ehl_result import EHLResult
from .imposed import line_pressure
from .line_contact import LineContact
from .rigid import RigidFilm, isoviscous_film, piezoviscous_film
from .rigid_error import compression, elastic_error
from .shear import ShearForce


@dataclass(frozen=True)
class Isoviscous(FilmLevel):
    """Martin's film: no deflection, constant viscosity, no compression."""

    name: str = "isoviscous"
    words: str = "rigid isoviscous"
    neglects: tuple[str, ...] = ("elastic", "piezoviscous", "density")

    def solve(
        self, line: LineContact, *, tolerance: float, cells: int = 0, imposed=None, start: Film | None = None
    ) -> RigidFilm:
        """The film in closed form; only ``line`` is used."""
        return isoviscous_film(line)

    def left_out(self, film: Film, line: LineContact, allowed: float = math.inf) -> LeftOut:
        """To first order; the piezoviscous part is the difference between the two rigid films."""
        elastic, density = elastic_error(film, line.lubricant), compression(film, line.lubricant)
        parts = {"elastic": elastic}
        if elastic + density <= allowed:
            parts["piezoviscous"] = abs(piezoviscous_film(line).min_film / film.min_film - 1)
        return LeftOut(parts | {"density": density})


@dataclass(frozen=True)
class Piezoviscous(FilmLevel):
    """The film with the viscosity law of the lubricant: no deflection, no compression."""

    name: str = "piezoviscous"
    words: str = "rigid piezoviscous"
    neglects: tuple[str, ...] = ("elastic", "density")

    def solve(
        self, line: LineContact, *, tolerance: float, cells: int = 0, imposed=None, start: Film | None = None
    ) -> RigidFilm:
        """The film, always to 1e-9; only ``line`` is used."""
        return piezoviscous_film(line)

    def left_out(self, film: Film, line: LineContact, allowed: float = math.inf) -> LeftOut:
        """What it leaves out, to first order."""
        return LeftOut({"elastic": elastic_error(film, line.lubricant), "density": compression(film, line.lubricant)})


@dataclass(frozen=True)
class Elastohydrodynamic(FilmLevel):
    """Full EHL, on as many cells as the tolerance needs."""

    name: str = "ehl"
    words: str = "full EHL"
    numerical: bool = True

    def solve(
        self, line: LineContact, *, tolerance: float, cells: int = 0, imposed=None, start: Film | None = None
    ) -> EHLResult:
        """An `EHLResult`; a ``start`` of another kind is not used."""
        return solve_line_contact(
            line,
            Effort(tolerance, cells),
            imposed=line_pressure(imposed),
            start=start if isinstance(start, EHLResult) else None,
        )

    def shear(self, film: Film, lubricant: Lubricant, **point) -> ShearForce:
        """The shear force, with the rolling force that the film itself knows."""
        return super().shear(film, lubricant, **{"rolling": cast(EHLResult, film).rolling} | point)


LEVELS: tuple[FilmLevel, ...] = (Isoviscous(), Piezoviscous(), Elastohydrodynamic())


def higher(levels: Sequence[FilmLevel], level: FilmLevel, other: FilmLevel) -> FilmLevel:
    """The level that leaves out less, of two."""
    return max(level, other, key=levels.index)


def given_level(levels: Sequence[FilmLevel], numerics) -> FilmLevel | None:
    """The level that the scene fixes; None if it is to be chosen.

    A level can be fixed by name. The last level is fixed if everything is to be modelled, and if the total pressure
    deflects the film, since rigid films have no deflection.
    """
    if numerics.film_level != "auto":
        return next(level for level in levels if level.name == numerics.film_level)
    everything = numerics.model == "full" or numerics.film_deflection == "total"
    return levels[-1] if everything else None


def lowest_level(levels: Sequence[FilmLevel], line: LineContact, allowed: float) -> tuple[FilmLevel, LeftOut]:
    """The simplest level that leaves out no more than ``allowed`` (relative) of the film of ``line``, and what it
    leaves out.

    Each level is judged by its own film. A level is passed over if it leaves out a part that was too large at the level
    before. What is left out grows with the load.
    """
    found = LeftOut()
    for level in levels[:-1]:
        if found.of(level.neglects).total <= allowed:
            found = level.left_out(level.solve(line, tolerance=allowed), line, allowed)
            if found.total <= allowed:
                return level, found
    return levels[-1], found


def level_for(levels: Sequence[FilmLevel], numerics, line: LineContact, allowed: float) -> tuple[FilmLevel, LeftOut]:
    """The level given, or the lowest that leaves out no more than ``allowed`` of the film of ``line``; and what it
    leaves out."""
    given = given_level(levels, numerics)
    level, left_out = (given, LeftOut()) if given else lowest_level(levels, line, allowed)
    return level, left_out if left_out.total <= allowed else LeftOut()
