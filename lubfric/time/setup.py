"""From a scene to a run in time: histories, grid, operators and first state."""

from __future__ import annotations

import math

import numpy as np

from ..errors import InputError
from ..scene import Constant, History, Scene
from ..sharing import Prepared, prepare, scene_of
from .at_a_time import changes, inlet_viscosity
from .film_active_set import StepSolution
from .film_setting import FINER, ContactHistory, Setting, make_setting
from .line import long_enough
from .sharing import Sharing, make_sharing
from .start import first_state

DONE = {  # what a run in time does of the options of the steady model
    "model": ("auto", "full"),
    "closure": ("load",),
    "film_level": ("auto", "ehl"),
    "contact_level": ("auto", "flat", "semi-periodic"),
    "film_deflection": ("auto", "hydrodynamic"),
    "cavitated_shear": ("none",),
}


def begin(scene: Scene | Prepared) -> tuple[Sharing, StepSolution, float]:
    """Check a scene with a ``transient`` and make it ready. Returns the `Sharing`, the state at t = 0, and the relative
    error by the grid of the films of a steady start (NaN for another start)."""
    base = scene_of(scene)
    plan = changes(base)
    for name, allowed in DONE.items():
        value = getattr(base.numerics, name)
        if value not in allowed:
            raise InputError(
                f" = {value!r} is not for a run in time", f"numerics.{name}", ", ".join(map(repr, allowed))
            )
    load = plan.load or Constant(base.bodies.load)
    if load.range(plan.duration)[1] > base.bodies.load * (1 + 1e-9):
        raise InputError(
            f"transient.load rises to {load.range(plan.duration)[1]:g} N; allowed: up to bodies.load = "
            f"{base.bodies.load:g} N, whose Hertz strip is the area A"
        )
    prepared, cells = long_enough(scene if isinstance(scene, Prepared) else prepare(scene))
    for finer in FINER:
        sharing = make_sharing(prepared, _setting(prepared, load, finer), cells)
        start, grid_error = first_state(sharing)
        if not grid_error > base.numerics.tolerances.film:  # NaN: no steady start to judge by
            break
    return sharing, start, grid_error


def _setting(prepared: Prepared, load: History, finer: float) -> Setting:
    scene = prepared.scene
    bodies, plan = scene.bodies, changes(scene)
    contact = ContactHistory(
        load,
        plan.radius or Constant(bodies.radius),
        bodies.e_prime,
        plan.speed or Constant(scene.motion.entrainment_speed),
        inlet_viscosity(scene),
        scene.lubricant,
        plan.duration,
        plan.initial_film,
        bodies.width,
    )
    rough = prepared.surface.sq > 0.0
    sigma = max(prepared.surface.sq, 0.0)
    if not rough and plan.initial_film is None and contact.speed.before(0.0) == 0.0:
        raise InputError(
            "smooth surfaces at rest have no film to start from; give transient.initial_film > 0 m, or "
            "an entrainment speed before t = 0"
        )
    reach = float(np.max(np.abs(prepared.contact.x))) if rough else 0.0
    return make_setting(
        contact,
        scene.numerics.tolerances.film,
        shared=rough,
        reach=reach,
        film_range=(sigma, 2.0 * sigma) if rough else (math.inf, 0.0),
        finer=finer,
    )
