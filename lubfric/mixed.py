"""The friction coefficient of one operating point: scene -> film -> contact -> balance -> friction."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace

import numpy as np

from . import validate
from .asperity_patch import AsperityPatch, asperity_curve
from .balance import Balance, share_by_separation, share_load
from .contact_curve import contact_curve
from .ehl import solve_ehl
from .flat_patch import FlatPatch
from .halfspace import half_space
from .patch import CylinderPatch, centred_axis, strip_weight
from .report import CONVERGED, Report
from .rough_map import contact_map
from .scene import Scene
from .shear import ShearForce, shear_force
from .surface import Surface

STRIP_POINTS = 128
BEYOND = 1.5         # of the total load: how far a contact curve reaches when a film may be imposed on it


@dataclass(frozen=True)
class Model:
    """A scene made ready: its height map, and the contact operator or curve that every speed shares.

    Made by `prepare`, accepted wherever a scene is, and safe to share: nothing in it changes.
    """

    scene: Scene
    surface: Surface
    patch: CylinderPatch | FlatPatch | AsperityPatch


@dataclass(frozen=True)
class FrictionResult:
    """One operating point. Forces in N, lengths in m, speed in m/s, fractions of the area A.

    coefficient: (f_b F_C + F_sh)/F_T (paper, Eq. 9); min_film, central_film: of the smooth film that
    carries F_H (NaN without entrainment); film_to_roughness_ratio: central_film/Sq. The residuals are
    relative: load (F_C + F_H - F_T)/F_T and volume (gap - film)/(gap + film). ``balance`` holds the fields: the film
    (`EHLResult`) and, for a cylinder in contact, the dry contact (`ContactResult`).
    """

    speed: float
    coefficient: float
    contact_load: float
    film_load: float
    shear_force: float
    couette_force: float
    rolling_force: float
    boundary_force: float
    real_contact_area_fraction: float
    plastic_area_fraction: float
    min_film: float
    central_film: float
    mean_gap: float
    film_to_roughness_ratio: float
    load_residual: float
    volume_residual: float
    seconds: float
    report: Report
    balance: Balance | None = None


def prepare(scene: Scene) -> Model:
    """Build what does not depend on the speed: the height map and the contact operator or curve."""
    surface = contact_map(scene)
    heights = surface.heights - surface.heights.mean()
    build = _flat_patch if scene.contact.geometry == "flat" else _cylinder_patch
    return Model(scene, surface, build(scene, heights, surface.spacing))


def _flat_patch(scene: Scene, heights, spacing) -> FlatPatch:
    bodies, numerics, contact = scene.bodies, scene.numerics, scene.contact
    area = 2 * bodies.half_width * bodies.width
    heaviest = bodies.load / area * (BEYOND if numerics.closure == "separation" else 1.0)
    if contact.model == "half-space":
        operator = half_space(heights.shape, spacing, bodies.e_prime, workers=numerics.workers)
        curve = contact_curve(heights, spacing, bodies.e_prime, heaviest=heaviest, hardness=bodies.hardness,
                              tolerance=numerics.pressure_tolerance, operator=operator)
    else:
        curve = asperity_curve(heights, spacing, bodies.e_prime, heaviest=heaviest, definition=contact.model,
                               reading=contact.asperity_separation, hardness=bodies.hardness)
    x = centred_axis(STRIP_POINTS, 2 * bodies.half_width / STRIP_POINTS)
    return FlatPatch(curve, x, area)


def _cylinder_patch(scene: Scene, heights, spacing) -> CylinderPatch | AsperityPatch:
    bodies, numerics, contact = scene.bodies, scene.numerics, scene.contact
    x = centred_axis(heights.shape[0], spacing[0])
    weight = np.ones(x.size) if contact.region == "box" else strip_weight(x, spacing[0], bodies.half_width)
    if contact.model != "half-space":
        return AsperityPatch(heights, spacing, x, weight, bodies.e_prime, bodies.width, bodies.hardness, contact.model,
                             contact.asperity_separation, numerics.pressure_tolerance)
    operator = half_space(heights.shape, spacing, bodies.e_prime, ("free", "periodic"), workers=numerics.workers)
    return CylinderPatch(heights, spacing, x, weight, operator, bodies.width, bodies.hardness,
                         numerics.pressure_tolerance)


def friction(scene: Scene | Model, speed: float | None = None, *, start: FrictionResult | None = None,
             fields: bool = False, raise_on_failure: bool = True) -> FrictionResult:
    """Friction coefficient of ``scene`` at an entrainment speed [m/s] (default: the scene's own).

    The film and the rough contact share the load so that F_T = F_C + F_H and the lubricant volume
    of Eq. (8) hold together (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z). Without
    entrainment the contact carries everything; when the film clears the summits no contact is solved.

    ``start``: the result (with fields) of a neighbouring speed of the same model, for a warm start.
    ``fields``: keep film and contact in ``result.balance``.
    Stops when |mean gap - mean film|/(mean gap + mean film) over A <= numerics.volume_tolerance. Raises
    `InputError` before any work, `ConvergenceError` with report and result when a part does not converge
    (``raise_on_failure=False`` returns the unconverged balance, but a failed film or contact always raises).
    """
    begun = time.perf_counter()
    model = scene if isinstance(scene, Model) else prepare(scene)
    scene = model.scene
    speed = scene.motion.entrainment_speed if speed is None else validate.number("speed", speed, "m/s")
    balance = _dry(model) if speed == 0 else _balanced(model, speed, start.balance if start else None)
    result = _result(model, speed, balance, time.perf_counter() - begun)
    if raise_on_failure:
        result.report.raise_if_failed(result)
    return result if fields else replace(result, balance=None)


def _balanced(model: Model, speed: float, start: Balance | None) -> Balance:
    scene = model.scene
    bodies, lubricant = scene.bodies, scene.lubricant
    scaled = scene.numerics.film_deflection == "scaled"

    def solve_film(load, start):
        modulus = bodies.e_prime * (load / bodies.load if scaled else 1.0)
        return solve_ehl(load_per_width=load / bodies.width, radius=bodies.radius, e_prime=modulus,
                         entrainment_speed=speed, viscosity=lubricant.viscosity,
                         pressure_viscosity_coefficient=lubricant.pressure_viscosity_coefficient,
                         viscosity_law=lubricant.viscosity_law, density=lubricant.density_law,
                         tolerance=scene.numerics.film_tolerance, start=start)

    def close(film, contact_load, start):
        return model.patch.close(film.film_at(model.patch.x), contact_load, start, _contact_shape(model, film))

    def carry(film, start):
        return model.patch.carry(film.film_at(model.patch.x), start, _contact_shape(model, film))

    reference = max(2 * model.surface.sq, 1e-12)
    film_share = 4.895 * lubricant.viscosity * abs(speed) * bodies.radius * bodies.width / (reference * bodies.load)
    share = min(film_share, 0.9)                       # rigid isoviscous film of two sigma
    options = {"guess": math.log(share / (1 - share)), "tolerance": scene.numerics.volume_tolerance, "start": start}
    if scene.numerics.closure == "load":
        balance = share_load(bodies.load, solve_film, close, **options)
    else:
        balance = share_by_separation(bodies.load, solve_film, close, carry, **options)
    model.patch.check(balance.closure)
    return balance


def _contact_shape(model: Model, film) -> np.ndarray | None:
    """What the surface is pressed under, up to a constant, where it is not the film itself (None).

    With Johnson's modulus the film holds the deflection of the whole load; the contact adds its own share itself.
    """
    if model.scene.numerics.film_deflection == "hydrodynamic":
        return None
    parabola = model.patch.x**2 / (2 * film.radius)
    share = film.e_prime / model.scene.bodies.e_prime
    return parabola + share * (film.film_at(model.patch.x) - parabola)


def _dry(model: Model) -> Balance:
    """No entrainment, no film: the contact carries the whole load under the undeformed cylinder."""
    bodies = model.scene.bodies
    closure = model.patch.close(model.patch.x**2 / (2 * bodies.radius), bodies.load)
    model.patch.check(closure)
    report = Report("load sharing", CONVERGED, 0, 0.0, model.scene.numerics.volume_tolerance,
                    residuals={"volume": 0.0, "load": 0.0}, notes=("no entrainment: all contact",))
    return Balance(0.0, bodies.load, None, closure, report)


def _result(model: Model, speed: float, balance: Balance, seconds: float) -> FrictionResult:
    scene, closure, film = model.scene, balance.closure, balance.film
    bodies, motion = scene.bodies, scene.motion
    shear = ShearForce(0.0, 0.0)
    if film is not None:
        shear = shear_force(film, scene.lubricant, entrainment_speed=speed, slide_roll_ratio=motion.slide_roll_ratio,
                            radius=bodies.radius, width=bodies.width, cavitated=scene.numerics.cavitated_shear,
                            contact_fraction=lambda x: np.interp(x, closure.x, closure.contact_fraction, 0.0, 0.0))
    boundary = bodies.boundary_friction_coefficient * balance.contact_load * (motion.slide_roll_ratio != 0)
    central = film.central_film if film is not None else math.nan
    sq = model.surface.sq
    return FrictionResult(
        speed=speed, coefficient=(boundary + shear.total) / bodies.load, contact_load=balance.contact_load,
        film_load=balance.film_load, shear_force=shear.total, couette_force=shear.couette,
        rolling_force=shear.rolling, boundary_force=boundary,
        real_contact_area_fraction=closure.real_contact_area_fraction,
        plastic_area_fraction=closure.plastic_area_fraction,
        min_film=film.min_film if film is not None else math.nan, central_film=central, mean_gap=closure.mean_gap,
        film_to_roughness_ratio=central / sq if sq > 0 else math.inf,
        load_residual=(balance.contact_load + balance.film_load - bodies.load) / bodies.load,
        volume_residual=0.0 if film is None else closure.volume_residual,
        seconds=seconds, report=balance.report, balance=balance)
