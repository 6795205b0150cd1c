"""From a scene to what is marched in time: histories, grid, operators and first state."""

from __future__ import annotations

import math

import numpy as np

from ..ehl.transient.active_set import StepSolution
from ..ehl.transient.setting import FINER, ContactHistory, Setting, make_setting
from ..errors import InputError
from ..history import Constant, History
from ..prepared import Prepared, prepare, scene_of
from ..scene import Scene
from .at_a_time import changes, inlet_viscosity
from .line import long_enough
from .sharing import Sharing, make_sharing
from .start import first_state


def begin(scene: Scene | Prepared) -> tuple[Sharing, StepSolution, float]:
    """Check a scene with a ``transient`` and make it ready. Returns what is marched, the state at t = 0, and the
    relative error of the films of a steady start by the grid (NaN from another start)."""
    base = scene_of(scene)
    plan = changes(base)
    if base.numerics.model == "deterministic":
        raise InputError("numerics.model = 'deterministic' is steady; for a run in time give 'auto' or 'full'")
    if base.numerics.closure == "one-way":
        raise InputError("numerics.closure = 'one-way' is steady; for a run in time give 'load'")
    if base.numerics.film_deflection not in ("auto", "hydrodynamic") or base.numerics.cavitated_shear != "none":
        raise InputError(
            "a transient needs numerics.film_deflection = 'hydrodynamic' (or 'auto'), found "
            f"{base.numerics.film_deflection!r}, and cavitated_shear = 'none', found {base.numerics.cavitated_shear!r}"
        )
    _refuse_steady_only(base)
    load = plan.load or Constant(base.bodies.load)
    if load.range(plan.duration)[1] > base.bodies.load * (1 + 1e-9):
        raise InputError(
            f"transient.load rises to {load.range(plan.duration)[1]:g} N; allowed: up to bodies.load = "
            f"{base.bodies.load:g} N, whose Hertz strip is the area A"
        )
    prepared = long_enough(scene if isinstance(scene, Prepared) else prepare(scene))
    for finer in FINER:
        sharing = make_sharing(prepared, _setting(prepared, load, finer))
        start, grid_error = first_state(sharing)
        if not grid_error > base.numerics.tolerances.film:  # NaN: no steady start to judge by
            break
    return sharing, start, grid_error


def _refuse_steady_only(scene: Scene) -> None:
    """Raise `InputError` for what is asked of the steady model by name and a transient does not do."""
    done = {"film_level": ("auto", "ehl"), "closure": ("load",)}
    done["contact_level"] = ("auto", "flat", "semi-periodic")
    for name, allowed in done.items():
        value = getattr(scene.numerics, name)
        if value not in allowed:
            raise InputError(
                f"numerics.{name} = {value!r} is not for a run in time; allowed: {', '.join(map(repr, allowed))}"
            )


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
