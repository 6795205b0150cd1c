"""What will be modelled, foretold from closed forms: `lubfric info` solves nothing."""

from __future__ import annotations

from ..analytic.film import moes_flow_film
from ..scene import Scene
from .decision import FILM_SHARE, Decision
from .film_error import FilmError
from .film_level import EHL, lowest_level

SURE = 2.0  # factor between Moes' film and any film: outside of it contact or separation is certain


def forecast(scene: Scene, surface, speed: float) -> str:
    """Film level at the whole load and whether the summits of ``surface`` will touch at ``speed`` [m/s], in words.

    In contact the film carries less and may do with a simpler level; that and the grid are decided by the solve.
    """
    bodies, lubricant, numerics = scene.bodies, scene.lubricant, scene.numerics
    if speed == 0 or numerics.film_level == "none":
        return "film: none, no entrainment; contact: carries everything"
    film = moes_flow_film(
        load_per_width=bodies.load / bodies.width,
        radius=bodies.radius,
        e_prime=bodies.e_prime,
        entrainment_speed=abs(speed),
        viscosity=lubricant.viscosity,
        pressure_viscosity_coefficient=lubricant.pressure_viscosity_coefficient,
    )
    level, error = numerics.forced_film_level, FilmError()
    if level == "auto":
        level, error = lowest_level(scene, speed, bodies.load, FILM_SHARE * numerics.tolerance)
    words = Decision(
        film=level,
        contact="",
        tolerance=numerics.tolerance,
        film_error=error,
        forced=(),
        film_tolerance=numerics.film_tolerance,
    ).text.split("; ")[0]
    if level == EHL and 0 < error.total < 10:
        words += f" (rigid: {100 * error.total:.2g} % off, budget {100 * FILM_SHARE * numerics.tolerance:.2g} %)"
    summit = float(surface.heights.max() - surface.heights.mean())
    sigma = max(surface.sq, 1e-12)
    touching = "touching" if SURE * film < summit else "none" if film > SURE * summit else "none or a few summits"
    return f"{words}; contact: {touching}, clearance about {(film - summit) / sigma:.2g} sigma"
