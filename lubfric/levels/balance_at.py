"""One balance of film and contact at chosen levels, on a chosen patch; and the friction of a balance."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from .. import balance as sharing
from ..balance import Balance
from ..report import CONVERGED, Report
from ..rigid_film import RigidFilm
from ..shear import ShearForce, shear_force
from .film_error import FilmError
from .film_level import film_at_level
from .total_deflection import film_and_contact, told


@dataclass(frozen=True)
class Settings:
    """Film level, relative tolerances of the film and of the volume balance, whether contact is certain; how many
    cells a numerical film has at least; tolerance of the contact (None: that of the patch)."""

    level: str
    film_tolerance: float
    volume_tolerance: float
    touching: bool = False
    film_cells: int = 0
    contact_tolerance: float | None = None


@dataclass(frozen=True)
class Forces:
    """What resists the sliding: f = (boundary + shear.total)/F_T.

    sensitivity: relative error of f per relative error of the film, a (f_b F_H + |F_sh|)/(f F_T). a is what a change of
    the film at a given gap does to its load, 1 for a rigid film and up to ten times that for an elastic one, from
    the slope that the balance was found with. quadrature: estimated error of the sum that F_sh is, relative to f F_T
    (`lubfric.shear.ShearForce`). A pressure spike that the grid does not hold shows here and not in the film.
    """

    coefficient: float
    boundary: float
    shear: ShearForce
    sensitivity: float
    quadrature: float = 0.0


@dataclass(frozen=True)
class Stage:
    """One balance, the friction of it, and the patch and settings it was found with."""

    balance: Balance
    forces: Forces
    patch: object
    settings: Settings
    film_error: FilmError


def balance_at(model, patch, speed: float, settings: Settings, start: Balance | None = None) -> Balance:
    """Divide the load of ``model.scene`` between a film of ``settings.level`` and ``patch``, by the scene's closure."""
    scene = model.scene
    bodies, numerics, lubricant = scene.bodies, scene.numerics, scene.lubricant
    if settings.contact_tolerance is not None:
        patch = replace(patch, tolerance=settings.contact_tolerance)
    solve_film, close, carry = _parts(model, patch, speed, settings)
    reference = max(2 * model.surface.sq, 1e-12)
    film_share = 4.895 * lubricant.viscosity * abs(speed) * bodies.radius * bodies.width / (reference * bodies.load)
    share = min(film_share, 0.9)  # rigid isoviscous film of two sigma
    options = {
        "guess": math.log(share / (1 - share)),
        "tolerance": settings.volume_tolerance,
        "touching": settings.touching,
    }
    if start is not None:
        options |= {"start": carried_over(start, patch), "shift": _shift(start, speed)}
    if numerics.film_deflection == "total":

        def joint(film_load, contact_load, film, contact):
            return film_and_contact(
                scene,
                patch,
                solve_film,
                close,
                film_load,
                contact_load,
                film,
                contact,
                0.5 * min(settings.volume_tolerance, settings.film_tolerance),
            )

        found = sharing.share_load(bodies.load, solve_film, close, joint=joint, **options)
        return told(scene, found)
    if numerics.closure == "load":
        return sharing.share_load(bodies.load, solve_film, close, **options)
    return sharing.share_by_separation(bodies.load, solve_film, close, carry, **options)


def separated_at(model, patch, speed: float, settings: Settings, start: Balance | None = None) -> Balance:
    """The film with all the load: in balance where the volume residual of its closure is <= 0."""
    solve_film, close, _ = _parts(model, patch, speed, settings)
    return sharing.separated(
        model.scene.bodies.load, solve_film, close, settings.volume_tolerance, start.film if start else None
    )


def dry(model, patch) -> Balance:
    """No film: the contact carries the whole load under the undeformed cylinder."""
    bodies = model.scene.bodies
    closure = patch.close(patch.x**2 / (2 * bodies.radius), bodies.load)
    report = Report(
        "load sharing",
        CONVERGED,
        0,
        0.0,
        model.scene.numerics.volume_tolerance,
        residuals={"volume": 0.0, "load": 0.0},
        notes=("no entrainment: all contact",),
    )
    return Balance(0.0, bodies.load, None, closure, report)


def forces(scene, speed: float, balance: Balance) -> Forces:
    """Boundary and viscous friction of a balance (paper, Eqs. 9-12)."""
    bodies, motion = scene.bodies, scene.motion
    shear = _shear(scene, speed, balance)
    sliding = bodies.boundary_friction_coefficient * (motion.slide_roll_ratio != 0)
    boundary = sliding * balance.contact_load
    total = abs(boundary + shear.total)
    moved = sliding * balance.film_load * (balance.contact_load > 0) + abs(shear.couette) + abs(shear.rolling)
    gain = 1.0
    if balance.slope and balance.contact_load > 0:
        gain = max(1.0, 0.5 * balance.contact_load / (bodies.load * balance.slope))
    known = 0 < total < math.inf
    return Forces(
        (boundary + shear.total) / bodies.load,
        boundary,
        shear,
        gain * moved / total if known else 1.0,
        shear.quadrature / total if known else 0.0,
    )


def _shear(scene, speed, balance: Balance) -> ShearForce:
    film, closure = balance.film, balance.closure
    if film is None:
        return ShearForce(0.0, 0.0)
    with np.errstate(over="ignore", invalid="ignore"):  # a rigid film far above its range
        return shear_force(
            film,
            scene.lubricant,
            entrainment_speed=speed,
            radius=scene.bodies.radius,
            width=scene.bodies.width,
            slide_roll_ratio=scene.motion.slide_roll_ratio,
            cavitated=scene.numerics.cavitated_shear,
            contact_fraction=closure.touching,
        )


def carried_over(start: Balance, patch) -> Balance:
    """``start`` with its contact pressure, if any, on the cells of ``patch``: the nearest ones of its own."""
    closure = start.closure
    pressure = getattr(closure.contact, "pressure", closure.contact)
    heights = getattr(patch, "heights", None)
    if pressure is None or heights is None or pressure.shape == heights.shape and np.array_equal(closure.x, patch.x):
        return start
    step = closure.x[1] - closure.x[0]
    row = np.rint((patch.x - closure.x[0]) / step).astype(int)
    column = np.arange(heights.shape[1]) * pressure.shape[1] // heights.shape[1]
    inside = (row >= 0) & (row < closure.x.size)
    moved = np.where(inside[:, None], pressure[np.clip(row, 0, closure.x.size - 1)][:, column], 0.0)
    return replace(start, closure=replace(closure, contact=moved if moved.any() else None))


def moved_split(balance: Balance, step: float) -> Balance:
    """``balance`` with its loads divided as if ln(F_H/F_C) were larger by ``step``; film and closure as they were."""
    total, split = balance.film_load + balance.contact_load, balance.split + step
    return replace(balance, film_load=total / (1 + math.exp(-split)), contact_load=total / (1 + math.exp(split)))


def _shift(start: Balance, speed: float) -> float:
    """At the same gap a film carries about in proportion to its speed."""
    if start.film is None or start.film.entrainment_speed == 0:
        return 0.0
    return math.log(abs(speed / start.film.entrainment_speed))


def _parts(model, patch, speed, settings):
    scene = model.scene
    cells = []  # of the films so far: one and the same grid from the second on, or the root has a jump

    def solve_film(load, start, imposed=None):
        film = film_at_level(
            settings.level,
            scene,
            speed,
            load,
            tolerance=settings.film_tolerance,
            cells=max([settings.film_cells, *cells[1:]]),
            imposed=imposed,
            start=start,
        )
        cells.append(0 if isinstance(film, RigidFilm) else film.state.pressure.size)
        return film

    def close(film, contact_load, start):
        return patch.close(film.film_at(patch.x), contact_load, start, film_shape(scene, patch, film))

    def carry(film, start):
        shape = None if scene.numerics.film_deflection == "hydrodynamic" else film_shape(scene, patch, film)
        return patch.carry(film.film_at(patch.x), start, shape)

    return solve_film, close, carry


def film_shape(scene, patch, film) -> np.ndarray:
    """What the surface is pressed under, up to a constant, at the ``x`` of ``patch``: the film, or less of it.

    With Johnson's modulus, or under the total pressure, the film holds the deflection of the whole load; the contact adds
    its own share itself.
    """
    on_patch = film.film_at(patch.x)
    if scene.numerics.film_deflection == "hydrodynamic":
        return on_patch
    if scene.numerics.film_deflection == "total":
        return on_patch if isinstance(film, RigidFilm) else on_patch - film.imposed_deflection(patch.x)
    parabola = patch.x**2 / (2 * film.radius)
    return parabola + film.e_prime / scene.bodies.e_prime * (on_patch - parabola)
