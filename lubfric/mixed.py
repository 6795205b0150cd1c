"""The friction coefficient of one operating point: scene -> film -> contact -> balance -> friction."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace

import numpy as np

from . import validate
from .asperity_patch import AsperityPatch, asperity_curve
from .balance import Balance
from .contact_curve import contact_curve
from .flat_patch import FlatPatch
from .halfspace import half_space
from .levels.balance_at import forces
from .levels.decision import Decision
from .levels.settle import settle
from .patch import CylinderPatch, centred_axis, strip_weight
from .report import Report
from .rough_map import contact_map
from .scene import Scene
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
             tolerance: float | None = None, model: str | None = None, fields: bool = False,
             raise_on_failure: bool = True) -> FrictionResult:
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


def at_tolerance(scene: Scene | Model, tolerance: float | None, model: str | None) -> Model:
    """``scene`` made ready, its tolerance on f and its model ("auto" or "full") replaced where given."""
    changed = {name: value for name, value in (("tolerance", tolerance), ("model", model)) if value is not None}
    ready = isinstance(scene, Model)
    asked = (scene.scene if ready else scene).with_(numerics=changed)
    if not ready:
        return prepare(asked)
    return replace(scene, scene=asked) if changed else scene


def _result(model: Model, speed: float, balance: Balance, decision: Decision, begun: float) -> FrictionResult:
    scene, closure, film = model.scene, balance.closure, balance.film
    found = forces(scene, speed, balance)
    central = film.central_film if film is not None else math.nan
    sq = model.surface.sq
    return FrictionResult(
        speed=speed, coefficient=found.coefficient, contact_load=balance.contact_load,
        film_load=balance.film_load, shear_force=found.shear.total, couette_force=found.shear.couette,
        rolling_force=found.shear.rolling, boundary_force=found.boundary,
        real_contact_area_fraction=closure.real_contact_area_fraction,
        plastic_area_fraction=closure.plastic_area_fraction,
        min_film=film.min_film if film is not None else math.nan, central_film=central, mean_gap=closure.mean_gap,
        film_to_roughness_ratio=central / sq if sq > 0 else math.inf,
        load_residual=(balance.contact_load + balance.film_load - scene.bodies.load) / scene.bodies.load,
        volume_residual=0.0 if film is None else closure.volume_residual, seconds=time.perf_counter() - begun,
        report=replace(balance.report, notes=(*balance.report.notes, decision.text)), balance=balance, decision=decision)
