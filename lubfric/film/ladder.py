"""The levels of the film in order, and the lowest of them that a line contact may do with."""

from __future__ import annotations

from collections.abc import Sequence

from ..line_contact import LineContact
from ..scene import Numerics
from .contract import FilmLevel, LeftOut
from .numerical import Elastohydrodynamic
from .rigid_levels import Isoviscous, Piezoviscous

LEVELS: tuple[FilmLevel, ...] = (Isoviscous(), Piezoviscous(), Elastohydrodynamic())


def higher(levels: Sequence[FilmLevel], level: FilmLevel, other: FilmLevel) -> FilmLevel:
    """The one of the two that leaves out less."""
    return max(level, other, key=levels.index)


def given_level(levels: Sequence[FilmLevel], numerics: Numerics) -> FilmLevel | None:
    """The level that the scene gives: by name; the last where everything is to be modelled, or where the film is
    deflected by the total pressure, which rigid films have nothing of; None where it is to be chosen."""
    if numerics.film_level != "auto":
        return next(level for level in levels if level.name == numerics.film_level)
    everything = numerics.model == "full" or numerics.film_deflection == "total"
    return levels[-1] if everything else None


def lowest_level(levels: Sequence[FilmLevel], line: LineContact, allowed: float) -> tuple[FilmLevel, LeftOut]:
    """The simplest level that leaves out no more than ``allowed``, relative, of the film of ``line``, and what it does.

    Each is judged by its own film. One whose share of what the level before was found to leave out is too much already
    is passed over. What is left out grows with the load.
    """
    found = LeftOut()
    for level in levels[:-1]:
        if found.of(level.neglects).total <= allowed:
            found = level.left_out(level.solve(line, tolerance=allowed), line, allowed)
            if found.total <= allowed:
                return level, found
    return levels[-1], found


def level_for(
    levels: Sequence[FilmLevel], numerics: Numerics, line: LineContact, allowed: float
) -> tuple[FilmLevel, LeftOut]:
    """The level given, or the lowest that leaves out no more than ``allowed`` of the film of ``line``, and what that
    is."""
    given = given_level(levels, numerics)
    level, left_out = (given, LeftOut()) if given else lowest_level(levels, line, allowed)
    return level, left_out if left_out.total <= allowed else LeftOut()
