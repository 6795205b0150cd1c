"""From a scene to a run in time: histories, grid, operators and first state."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..ehl.transient.active_set import StepSolution
from ..ehl.transient.setting import FINER, ContactHistory, Setting, make_setting
from ..ehl.transient.solve import TIME_SHARE
from ..errors import InputError
from ..history import Constant, History
from ..history.plan import Transient
from ..march.bdf import March, Memory
from ..march.course import Plan, Progress, plan_of
from ..prepared import Prepared, prepare
from ..sampling.patch_error import correlation_along_y
from ..scene import Scene
from .at_a_time import SceneInTime, inlet_viscosity
from .line import long_enough
from .sharing import Contact, Sharing, make_sharing, share_step
from .start import first_state


@dataclass(frozen=True)
class Run:
    """All that a run in time needs and nothing that changes in it; start: the state at t = 0.

    grid_error: relative error of the films of the steady start from the grid (NaN from another start).
    """

    prepared: Prepared
    plan: Transient
    sharing: Sharing
    start: StepSolution
    grid_error: float

    def course(self, times: np.ndarray) -> Plan:
        """The march with outputs at ``times`` [s]."""
        setting = self.sharing.setting
        histories = (*setting.histories, *self.in_time.histories)
        tolerance = self.plan.tolerance or TIME_SHARE * self.prepared.scene.numerics.tolerances.film
        return plan_of(times, histories, setting.first_step, tolerance)

    def begun(self) -> Progress:
        """The progress at t = 0."""
        setting = self.sharing.setting
        return Progress(March((setting.level(0.0, self.start),), setting.first_step, self.start.payload))

    @property
    def in_time(self) -> SceneInTime:
        """Its scene at every time."""
        return SceneInTime(self.prepared.scene, self.plan)

    def solve(self, time: float, memory: Memory, z: np.ndarray, past: Contact) -> StepSolution:
        """Film and contact at ``time`` (`lubfric.march.bdf.Solver`)."""
        return share_step(self.sharing, time, memory, z, past)

    def error_of(self, solution: StepSolution, difference: np.ndarray) -> float:
        """Error of the film."""
        return self.sharing.setting.error_of(solution, difference)


def begin(scene: Scene | Prepared, plan: Transient) -> Run:
    """Check the scene, make it ready, find its first state."""
    base = scene.scene if isinstance(scene, Prepared) else scene
    if base.numerics.model == "deterministic":
        raise InputError("numerics.model = 'deterministic' is steady; allowed for a transient: 'auto', 'full'")
    if base.numerics.closure == "one-way":
        raise InputError("numerics.closure = 'one-way' is steady; allowed for a transient: 'load', 'separation'")
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
    prepared = long_enough(scene if isinstance(scene, Prepared) else prepare(scene), plan)
    tolerance = base.numerics.tolerances.film
    for finer in FINER:
        setting = _setting(prepared, plan, load, finer)
        sharing = make_sharing(
            setting, prepared.contact, base.bodies.width, _volume_tolerance(base), correlation_along_y(prepared)
        )
        start, grid_error = first_state(prepared, plan, sharing)
        if not grid_error > tolerance:  # NaN: no steady start to judge by
            break
    return Run(prepared, plan, sharing, start, grid_error)


def _refuse_steady_only(scene: Scene) -> None:
    """Raise `InputError` for what is asked of the steady model by name and a transient does not do."""
    done = {"film_level": ("auto", "ehl"), "closure": ("load",)}
    done["contact_level"] = ("auto", "flat", "semi-periodic")
    for name, allowed in done.items():
        value = getattr(scene.numerics, name)
        if value not in allowed:
            raise InputError(
                f"numerics.{name} = {value!r} is not done in a transient; allowed: {', '.join(map(repr, allowed))}"
            )


def _volume_tolerance(scene: Scene) -> float:
    return min(scene.numerics.tolerances.balance, 1e-4)


def _setting(prepared: Prepared, plan: Transient, load: History, finer: float) -> Setting:
    scene = prepared.scene
    bodies, lubricant = scene.bodies, scene.lubricant
    contact = ContactHistory(
        _PerWidth(load, bodies.width),
        plan.radius or Constant(bodies.radius),
        bodies.e_prime,
        plan.speed or Constant(scene.motion.entrainment_speed),
        inlet_viscosity(SceneInTime(scene, plan)),
        lubricant,
        plan.duration,
        plan.initial_film,
    )
    rough = prepared.surface.sq > 0.0
    sigma = max(prepared.surface.sq, 0.0)
    if not rough and plan.initial_film is None and contact.speed.before(0.0) == 0.0:
        raise InputError(
            "smooth surfaces at rest have no film to start from; allowed: transient.initial_film > 0 m, or "
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


@dataclass(frozen=True)
class _PerWidth(History):
    """A load history divided by the width."""

    source: History
    width: float

    def at(self, time: float) -> float:
        return self.source.at(time) / self.width

    def before(self, time: float) -> float:
        return self.source.before(time) / self.width

    def stops(self, duration: float) -> tuple[float, ...]:
        return self.source.stops(duration)

    def jumps(self, duration: float) -> tuple[float, ...]:
        return self.source.jumps(duration)

    def range(self, duration: float) -> tuple[float, float]:
        low, high = self.source.range(duration)
        return low / self.width, high / self.width
