"""The levels of the film in order, and the lowest one that is enough for a line contact."""

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
    """The level that the scene fixes, or None where it is to be chosen.

    It is fixed by name. It is the last one where everything is to be modelled, and where the total pressure deflects
    the film, since rigid films have no deflection.
    """
    if numerics.film_level != "auto":
        return next(level for level in levels if level.name == numerics.film_level)
    everything = numerics.model == "full" or numerics.film_deflection == "total"
    return levels[-1] if everything else None


def lowest_level(levels: Sequence[FilmLevel], line: LineContact, allowed: float) -> tuple[FilmLevel, LeftOut]:
    """The simplest level that leaves out no more than ``allowed`` (relative) of the film of ``line``, and what it
    leaves out.

    Each level is judged by its own film. A level is passed over where it shares a part that the level before was found
    to leave out too much of. What is left out grows with the load.
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
    """The level given, or the lowest that leaves out no more than ``allowed`` of the film of ``line``; and what it
    leaves out."""
    given = given_level(levels, numerics)
    level, left_out = (given, LeftOut()) if given else lowest_level(levels, line, allowed)
    return level, left_out if left_out.total <= allowed else LeftOut()
