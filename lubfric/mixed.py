"""The friction coefficient of one operating point: scene -> film -> contact -> balance -> friction."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace

import numpy as np

from . import validate
from .balance import Balance
from .cautions import cautions
from .errors import InputError
from .halfspace import half_space
from .levels.balance_at import forces
from .levels.decision import Decision
from .levels.settle import settle
from .patch.asperities import AsperityPatch, asperity_curve
from .patch.contact_curve import contact_curve
from .patch.cylinder import CylinderPatch, centred_axis, strip_weight
from .patch.flat import FlatPatch
from .report import Report
from .rough_map import check_grid, contact_map
from .scene import Scene
from .surface import Surface

STRIP_POINTS = 128
BEYOND = 1.5  # of the total load: how far a contact curve reaches when a film may be imposed on it


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
    carries F_H (NaN without entrainment); mean_gap: between the rough surfaces (the film when they are separated);
    film_to_roughness_ratio: central_film/Sq; real_contact_area [m^2]: of the whole line. The residuals are relative: load (F_C + F_H - F_T)/F_T and volume (gap - film)/(gap + film). ``balance`` holds the fields: the film
    (`EHLResult` or `RigidFilm`) and, for a cylinder in contact, the dry contact (`ContactResult`). ``decision``: how much
    was modelled, and the numbers it was judged by (``decision.text`` in words).
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
    real_contact_area: float
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
    decision: Decision | None = None


def prepare(scene: Scene, surface: Surface | None = None, *, like: Model | None = None) -> Model:
    """Build what does not depend on the speed: the height map and the contact operator or curve.

    ``surface``: a height map to use as it is, grid and all, instead of the scene's own; it is taken as periodic
    along y under a cylinder, along x and y when flat (`Surface.periodic` makes it so).
    ``like``: a model of the same map, bodies' E' and hardness, whose map and operator or curve serve again, for another
    load (a curve: no heavier one), lubricant, motion or tolerance (a curve: no tighter one).
    """
    if like is not None:
        return _another(scene, like)
    if surface is None:
        surface = contact_map(scene)
    else:
        check_grid(scene, surface)
    flat = scene.contact.geometry == "flat"
    if flat and scene.numerics.contact_level == "semi-periodic":
        raise InputError(
            "numerics.contact_level = 'semi-periodic' needs contact.geometry = 'cylinder'; a flat contact is "
            "periodic both ways"
        )
    if not flat and scene.numerics.contact_level == "flat":
        flat, surface = True, surface.periodic("mirror", axes=(True, False))
    heights = surface.heights - surface.heights.mean()
    build = _flat_patch if flat else _cylinder_patch
    return Model(scene, surface, build(scene, heights, surface.spacing))


def _flat_patch(scene: Scene, heights, spacing) -> FlatPatch:
    bodies, numerics, contact = scene.bodies, scene.numerics, scene.contact
    area = 2 * bodies.half_width * bodies.width
    heaviest = bodies.load / area * (BEYOND if numerics.closure == "separation" else 1.0)
    if contact.model == "half-space":
        operator = half_space(heights.shape, spacing, bodies.e_prime, workers=numerics.workers)
        curve = contact_curve(
            heights,
            spacing,
            bodies.e_prime,
            heaviest=heaviest,
            hardness=bodies.hardness,
            tolerance=numerics.pressure_tolerance,
            accuracy=0.3 * numerics.tolerance,
            operator=operator,
        )
    else:
        curve = asperity_curve(
            heights,
            spacing,
            bodies.e_prime,
            heaviest=heaviest,
            definition=contact.model,
            reading=contact.asperity_separation,
            hardness=bodies.hardness,
        )
    return _strip(scene, curve)


def _strip(scene: Scene, curve) -> FlatPatch:
    """``curve`` under the Hertz strip of the scene's load."""
    half_width = scene.bodies.half_width
    return FlatPatch(
        curve, centred_axis(STRIP_POINTS, 2 * half_width / STRIP_POINTS), 2 * half_width * scene.bodies.width
    )


def _another(scene: Scene, like: Model) -> Model:
    """The model of another scene on the map, operator and curve of ``like``."""
    old = like.scene
    for name, a, b in (
        ("surface", scene.surface, old.surface),
        ("contact", scene.contact, old.contact),
        ("bodies.e_prime", scene.bodies.e_prime, old.bodies.e_prime),
        ("bodies.hardness", scene.bodies.hardness, old.bodies.hardness),
    ):
        if a != b:
            raise InputError(f"{name} = {a!r} is not that of the model to be used again; allowed: {b!r}")
    if not isinstance(like.patch, FlatPatch):
        check_grid(scene, like.surface)
        operator = getattr(like.patch, "operator", None)
        return Model(scene, like.surface, _cylinder_patch(scene, like.patch.heights, like.patch.spacing, operator))
    pressure, heaviest = scene.bodies.mean_hertz_pressure, float(like.patch.curve.mean_pressure[0])
    if pressure > heaviest * (1 + 1e-9):
        raise InputError(
            f"bodies.load = {scene.bodies.load:g} N needs {pressure:.4g} Pa of a contact curve that ends at "
            f"{heaviest:.4g} Pa; allowed: lighter loads, or prepare with the heaviest first"
        )
    if scene.numerics.tolerance < old.numerics.tolerance:
        raise InputError(
            f"numerics.tolerance = {scene.numerics.tolerance:g} is tighter than that of the contact curve; "
            f"allowed: at least {old.numerics.tolerance:g}, or prepare again"
        )
    return Model(scene, like.surface, _strip(scene, like.patch.curve))


def _cylinder_patch(scene: Scene, heights, spacing, operator=None) -> CylinderPatch | AsperityPatch:
    bodies, numerics, contact = scene.bodies, scene.numerics, scene.contact
    x = centred_axis(heights.shape[0], spacing[0])
    weight = np.ones(x.size) if contact.region == "box" else strip_weight(x, spacing[0], bodies.half_width)
    if contact.model != "half-space":
        if numerics.film_deflection == "total":
            raise InputError(
                f"contact.model = {contact.model!r} under a cylinder has no deflection for film_deflection = "
                "'total'; allowed: 'half-space'"
            )
        return AsperityPatch(
            heights,
            spacing,
            x,
            weight,
            bodies.e_prime,
            bodies.width,
            bodies.hardness,
            contact.model,
            contact.asperity_separation,
            numerics.pressure_tolerance,
        )
    if operator is None:
        operator = half_space(heights.shape, spacing, bodies.e_prime, ("free", "periodic"), workers=numerics.workers)
    return CylinderPatch(
        heights, spacing, x, weight, operator, bodies.width, bodies.hardness, numerics.pressure_tolerance
    )


def friction(
    scene: Scene | Model,
    speed: float | None = None,
    *,
    start: FrictionResult | None = None,
    tolerance: float | None = None,
    model: str | None = None,
    fields: bool = False,
    raise_on_failure: bool = True,
) -> FrictionResult:
    """Friction coefficient of ``scene`` at an entrainment speed [m/s] (default: the scene's own).

    The film and the rough contact share the load so that F_T = F_C + F_H and the lubricant volume
    of Eq. (8) hold together (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z). Without
    entrainment the contact carries everything; when the film clears the summits no contact is solved.

    ``tolerance``: on the coefficient, relative, instead of ``numerics.tolerance``. No more is modelled than it needs
    (docs/levels.md, ``result.decision``); ``model="full"``: everything, on the scene's own grid.
    ``start``: the result of a neighbouring speed of the same map, for a warm start.
    ``fields``: film and contact in ``result.balance`` are wanted on the scene's own contact grid.
    Stops when |mean gap - mean film|/(mean gap + mean film) over A <= numerics.volume_tolerance, divided by the share
    of the film in f. Raises `InputError` before any work, `ConvergenceError` with report and result when a part does
    not converge (``raise_on_failure=False`` returns the unconverged balance, but a failed film or contact always raises).
    """
    begun = time.perf_counter()
    ready = at_tolerance(scene, tolerance, model)
    speed = ready.scene.motion.entrainment_speed if speed is None else validate.number("speed", speed, "m/s")
    balance, decision = settle(ready, speed, start.balance if start else None, given_grid=fields)
    result = _result(ready, speed, balance, decision, begun)
    if raise_on_failure:
        result.report.raise_if_failed(result)
    return result


def scene_of(scene: Scene | Model) -> Scene:
    """The scene of a model, or the scene itself; anything else is an `InputError`."""
    if isinstance(scene, Model):
        return scene.scene
    if not isinstance(scene, Scene):
        raise InputError(
            f"scene = {scene!r} is a {type(scene).__name__}; allowed: what lubfric.load_scene or "
            "lubfric.prepare returned"
        )
    return scene


def at_tolerance(scene: Scene | Model, tolerance: float | None, model: str | None) -> Model:
    """``scene`` made ready, its tolerance on f and its model ("auto" or "full") replaced where given."""
    changed = {name: value for name, value in (("tolerance", tolerance), ("model", model)) if value is not None}
    asked = scene_of(scene).with_(numerics=changed)
    if not isinstance(scene, Model):
        return prepare(asked)
    return prepare(asked, like=scene) if asked != scene.scene else scene


def _result(model: Model, speed: float, balance: Balance, decision: Decision, begun: float) -> FrictionResult:
    scene, closure, film = model.scene, balance.closure, balance.film
    found = forces(scene, speed, balance)
    central = film.central_film if film is not None else math.nan
    separated = balance.contact_load == 0
    notes = (*balance.report.notes, decision.text, *cautions(scene, balance, found.shear))
    sq = model.surface.sq
    return FrictionResult(
        speed=speed,
        coefficient=found.coefficient,
        contact_load=balance.contact_load,
        film_load=balance.film_load,
        shear_force=found.shear.total,
        couette_force=found.shear.couette,
        rolling_force=found.shear.rolling,
        boundary_force=found.boundary,
        real_contact_area_fraction=closure.real_contact_area_fraction,
        real_contact_area=float(closure.contact_fraction.sum() * (closure.x[1] - closure.x[0]) * scene.bodies.width),
        plastic_area_fraction=closure.plastic_area_fraction,
        min_film=film.min_film if film is not None else math.nan,
        central_film=central,
        mean_gap=closure.mean_film if separated else closure.mean_gap,
        film_to_roughness_ratio=central / sq if sq > 0 else math.inf,
        load_residual=(balance.contact_load + balance.film_load - scene.bodies.load) / scene.bodies.load,
        volume_residual=0.0 if film is None or separated else closure.volume_residual,
        seconds=time.perf_counter() - begun,
        report=replace(balance.report, notes=notes),
        balance=balance,
        decision=decision,
    )
