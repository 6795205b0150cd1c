"""Levels of the film: which of them a load needs, and a solver for each."""

from __future__ import annotations

from ..ehl import EHLResult, solve_ehl
from ..rigid_film import RigidFilm, isoviscous_film, piezoviscous_film
from ..scene import Scene
from .film_error import FilmError, rigid_error

ISOVISCOUS, PIEZOVISCOUS, EHL = "isoviscous", "piezoviscous", "ehl"
WORDS = {ISOVISCOUS: "rigid isoviscous", PIEZOVISCOUS: "rigid piezoviscous", EHL: "full EHL", "none": "none"}
RIGID = {ISOVISCOUS: isoviscous_film, PIEZOVISCOUS: piezoviscous_film}


def higher(level: str, other: str) -> str:
    """The one that leaves out less."""
    order = (ISOVISCOUS, PIEZOVISCOUS, EHL)
    return max(level, other, key=order.index)


def film_at_level(
    level: str, scene: Scene, speed: float, load: float, *, tolerance: float, cells: int = 0, imposed=None, start=None
):
    """The film that carries ``load`` [N] at ``speed`` [m/s]: a `RigidFilm`, or an `EHLResult` to ``tolerance`` on ``cells`` or
    more, deflected by the pressure ``imposed`` (of `solve_ehl`) too."""
    bodies, lubricant = scene.bodies, scene.lubricant
    share = load / bodies.load if scene.numerics.film_deflection == "scaled" else 1.0
    common = dict(
        load_per_width=load / bodies.width,
        radius=bodies.radius,
        e_prime=bodies.e_prime * share,
        entrainment_speed=speed,
    )
    if level != EHL:
        return RIGID[level](lubricant=lubricant, **common)
    return solve_ehl(
        viscosity=lubricant.viscosity,
        viscosity_law=lubricant.viscosity_law,
        density=lubricant.density_law,
        pressure_viscosity_coefficient=lubricant.pressure_viscosity_coefficient,
        tolerance=tolerance,
        least_cells=cells,
        imposed_pressure=imposed,
        start=start if isinstance(start, EHLResult) else None,
        **common,
    )


def lowest_level(scene: Scene, speed: float, load: float, budget: float) -> tuple[str, FilmError]:
    """The simplest level that leaves out no more than ``budget``, relative, of the film at ``load`` [N], and its error.

    Judged by the rigid films themselves: `lubfric.levels.film_error`. What is left out grows with the load.
    """
    thin = film_at_level(ISOVISCOUS, scene, speed, load, tolerance=budget)
    error = rigid_error(thin, scene.lubricant)
    if not error.total <= budget:
        return EHL, error
    thick = film_at_level(PIEZOVISCOUS, scene, speed, load, tolerance=budget)
    error = rigid_error(thin, scene.lubricant, thick)
    if error.total <= budget:
        return ISOVISCOUS, error
    error = rigid_error(thick, scene.lubricant)
    return (PIEZOVISCOUS if error.total <= budget else EHL), error


def level_error(film, scene: Scene, speed: float) -> FilmError:
    """What a film of any level leaves out (of full EHL: nothing)."""
    if not isinstance(film, RigidFilm):
        return FilmError()
    if film.report.solver.endswith("piezoviscous film"):
        return rigid_error(film, scene.lubricant)
    thick = film_at_level(PIEZOVISCOUS, scene, speed, film.load * scene.bodies.width, tolerance=0.0)
    return rigid_error(film, scene.lubricant, thick)
