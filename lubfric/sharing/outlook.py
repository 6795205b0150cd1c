"""A forecast from closed forms of what will be modelled, for `lubfric info`, which solves nothing."""

from __future__ import annotations

from ..film import LEVELS, LeftOut, given_level, lowest_level
from ..scene import Scene, budget
from ..surface import Surface
from .decision import Decision

SURE = 2.0  # factor between Moes' film and any film: outside of it contact or separation is certain


def outlook(scene: Scene, surface: Surface, speed: float) -> str:
    """Film level at the whole load and whether the summits of ``surface`` will touch at ``speed`` [m/s], in words.

    In contact the film carries less and may do with a simpler level; that and the grid are decided by the solve.
    """
    numerics = scene.numerics
    if speed == 0 or numerics.film_level == "none":
        why = "no entrainment" if speed == 0 else "left out (forced)"
        return f"film: none, {why}; contact: carries everything"
    line = scene.line_contact(speed)
    level, left_out = given_level(LEVELS, numerics), LeftOut()
    allowed = budget.FILM_LEVEL * numerics.tolerance
    if level is None:
        level, left_out = lowest_level(LEVELS, line, allowed)
    words = Decision(
        film=level.name,
        contact="",
        tolerance=numerics.tolerance,
        film_words=level.words,
        left_out=left_out,
        film_tolerance=numerics.tolerances.film if level.numerical else 0.0,
    ).film_text
    if level.numerical and 0 < left_out.total < 10:
        words += f" (rigid: {100 * left_out.total:.3g} % off, budget {100 * allowed:.2g} %)"
    summit = float(surface.heights.max() - surface.heights.mean())
    sigma, film = max(surface.sq, 1e-12), line.moes_film
    touching = "touching" if SURE * film < summit else "none" if film > SURE * summit else "none or a few summits"
    return f"{words}; contact: {touching}, clearance about {(film - summit) / sigma:.2g} sigma"
