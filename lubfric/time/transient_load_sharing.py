"""A run in time at one moment: its scene, in which the values of the histories replace the constants; its warm
inlet; and how a film that remembers its past and the rough contact share the load."""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..contact import ContactState, RoughContact
from ..errors import CONVERGED, ITERATION_LIMIT, ConvergenceError
from ..film import cubic
from ..models.shared import (
    Prepared,
    film_lubricant,
    inlet_at,
)
from ..scene import Constant, History, Scene, Transient
from .film_equations import Spring
from .film_setting import TIME_SHARE, Setting
from .march import Memory, Step

FASTER = 1e6  # slide-roll ratio beyond which a moment counts as one of sliding alone
SAMPLED_TIMES = 257  # times at which a run is looked through
FIRST_TOUCH = 1e-3  # of the load: tried when the film has just come too thin for separated surfaces
LAST_TOUCH = 1e-5  # of the load: below it, ask whether the film clears the surface
MOST_TRIALS = 16
LOOSEST = 1e-4  # tolerance on the volume


def transient_of(scene: Scene) -> Transient:
    """What changes in a scene of a run in time."""
    assert scene.transient is not None
    return scene.transient


def scene_at(scene: Scene, time: float, side: str = "before") -> Scene:
    """``scene``, whose ``transient`` says what changes, just "before" ``time`` [s], or "at" it: just after. It has the
    load, radius, speed, slide-roll ratio, f_b and viscosity of the moment. Its hardness is left out, because the
    contact has it, and so are its ranges."""

    def now(name: str, constant: float) -> float:
        return _value(scene, name, constant, time, side)

    bodies = scene.bodies
    oil = scene.lubricant
    speed = now("speed", scene.motion.entrainment_speed)
    sliding = sliding_at(scene, time, side)
    bodies = replace(
        bodies,
        load=now("load", bodies.load),
        radius=now("radius", bodies.radius),
        hardness=None,
        boundary_friction_coefficient=bodies.boundary_friction(sliding, oil.temperature),
        boundary_friction_table=None,
    )
    oil = replace(oil, viscosity=now("viscosity", oil.viscosity))
    alone = abs(sliding) > FASTER * abs(speed)
    ratio = math.copysign(FASTER, sliding) if alone else sliding / speed if sliding else 0.0
    motion = replace(scene.motion, entrainment_speed=speed, slide_roll_ratio=ratio, speeds=())
    return replace(scene, bodies=bodies, lubricant=oil, motion=motion, ranges=())


def sliding_at(scene: Scene, time: float, side: str = "before") -> float:
    """u2 - u1 [m/s]."""
    motion = scene.motion
    speed = _value(scene, "speed", motion.entrainment_speed, time, side)
    return _value(scene, "sliding", motion.slide_roll_ratio * speed, time, side)


def _value(scene: Scene, name: str, constant: float, time: float, side: str) -> float:
    history = getattr(transient_of(scene), name)
    return constant if history is None else getattr(history, side)(time)


@dataclass(frozen=True)
class WarmInlet(History):
    """Ambient viscosity [Pa s] in the inlet, which the shear of the moment keeps warmer than the oil around. The inlet
    is passed in less than b/U, so its heat is taken as that of steady motion."""

    scene: Scene

    def at(self, time: float) -> float:
        return self._warm(time, "at")

    def before(self, time: float) -> float:
        return self._warm(time, "before")

    def range(self, duration: float) -> tuple[float, float]:
        """The range that `SAMPLED_TIMES` times and every stop show."""
        return self._seen

    @cached_property
    def _seen(self) -> tuple[float, float]:
        found = [self._warm(t, side) for t in sampled_times(self.scene) for side in ("before", "at")]
        return min(found), max(found)

    def _warm(self, time: float, side: str) -> float:
        now = scene_at(self.scene, time, side)
        return film_lubricant(now, now.motion.entrainment_speed).viscosity


def inlet_viscosity(scene: Scene) -> History:
    """The viscosity [Pa s] with which the film is solved: that of the scene, or its history. If the heat of the inlet
    would at some time thin the film by more than its share of the tolerance, it is that of the warm inlet."""
    cold = transient_of(scene).viscosity or Constant(scene.lubricant.viscosity)
    if scene.numerics.heat == "off" or not scene.lubricant.heats:
        return cold
    if scene.numerics.heat == "auto":
        moments = (scene_at(scene, time) for time in sampled_times(scene))
        if not any(inlet_at(now, now.motion.entrainment_speed)[1] for now in moments):
            return cold
    return WarmInlet(scene.with_(numerics={"heat": "on"}))


def sampled_times(scene: Scene) -> list[float]:
    """Times [s] at which a run is looked through before it begins: `SAMPLED_TIMES` of them evenly, and all stops and jumps."""
    plan = transient_of(scene)
    stops = {t for h in plan.histories for t in (*h.stops(plan.duration), *h.jumps(plan.duration))}
    return sorted({*np.linspace(0, plan.duration, SAMPLED_TIMES).tolist(), *stops})


@dataclass(frozen=True)
class Contact:
    """The contact's part of a step: load [N], state, and softness -d(gap)/d(ln load) [m]."""

    load: float
    state: ContactState
    softness: float


@dataclass(frozen=True)
class TransientLoadSharing:
    """A solver of `lubfric.time.march`: film and rough contact share the load of the moment.

    ``prepared``: the strip of rough surface of the run; ``setting``: of the film; ``to_patch`` gives the film [m] at
    the points of the contact's patch from H, and its ``mean_row`` the mean film over A; ``tolerance``: of the volume.
    ``correlation_length``: of the heights along y [m]; ``area``, ``plastic``: factors by which contact area and plastic
    area on the strip's cells are those on the scene's own (NaN: not known).
    """

    prepared: Prepared
    setting: Setting
    to_patch: np.ndarray
    mean_row: np.ndarray
    tolerance: float
    correlation_length: float
    area: float = 1.0
    plastic: float = 1.0
    stops = ()

    @property
    def first_step(self) -> float:
        """After a start or a jump [s]."""
        return self.setting.first_step

    @property
    def time_error(self) -> float:
        """Largest local error of a step, unless it is said."""
        return TIME_SHARE * self.scene.numerics.tolerance_of("film")

    @property
    def x(self) -> np.ndarray:
        """Of the nodes [m]."""
        return self.setting.grid.x * self.setting.problem.length_unit

    @property
    def cells(self) -> str:
        """Of the grid, in words."""
        return f"{self.setting.grid.n} cells"

    @property
    def scene(self) -> Scene:
        """With all that changes in time."""
        return self.prepared.scene

    @property
    def patch(self) -> RoughContact:
        """The rough contact."""
        return self.prepared.contact

    def error_of(self, solution: Step, difference: np.ndarray) -> float:
        """Error of the film."""
        return self.setting.error_of(solution, difference)

    def solve(self, time: float, memory: Memory | None, z: np.ndarray, past: Contact) -> Step:
        """Film and contact at ``time`` [s]; the `Contact` is the payload of the solution.

        A `Spring` stands for the contact in the film's load balance. Then the contact is solved at the load of the
        spring, and its gap gives the next spring (a secant in ln load), until |gap - film|/(gap + film) <= tolerance.
        """
        touch = past.load
        softness = past.softness
        seen = None
        total = self.setting.contact.load.before(time)
        state = past.state
        mean = past.state.mean_gap
        solution: Step
        for _ in range(MOST_TRIALS):
            spring = None
            if touch > 0.0:
                spring = Spring(self.mean_row, mean, touch / self.setting.load_unit, softness)
            solution = self.setting.solve(time, memory, z, spring)
            if solution.status != CONVERGED:
                return solution
            load = solution.terms.spring[0] * self.setting.load_unit
            if spring is not None and load < LAST_TOUCH * total:
                load = 0.0
            film = self.to_patch @ solution.terms.H
            found = self._close(film, load, state)
            if found is None:
                break
            if load == 0.0:
                if found.volume_residual <= 0.0:
                    if spring is None:
                        return replace(solution, payload=Contact(0.0, found, softness))
                    touch = 0.0
                    z = solution.z
                    state = found
                    seen = None
                    continue
                load = min(FIRST_TOUCH * total, max(touch, LAST_TOUCH * total))
                touching = found.mean_gap
                found = self._close(film, load, state)
                if found is None:
                    break
                softness = max(touching - found.mean_gap, 1e-3 * touching)
            elif abs(found.volume_residual) <= self.tolerance:
                return replace(solution, payload=Contact(load, found, _softness(softness, seen, load, found)))
            softness = _softness(softness, seen, load, found)
            seen = (load, found.mean_gap)
            touch = load
            mean = found.mean_gap
            state = found
            z = solution.z
        return replace(solution, status=ITERATION_LIMIT)

    def _close(self, film: np.ndarray, load: float, start: ContactState) -> ContactState | None:
        """The contact at ``load`` [N] under ``film`` [m]; None if it cannot be solved."""
        if film.min() <= 0.0 and load == 0.0:
            return None
        try:
            return self.patch.close(film, load, start)
        except ConvergenceError:
            return None


def make_load_sharing(prepared: Prepared, setting: Setting, *of_strip: float) -> TransientLoadSharing:
    """The `TransientLoadSharing` on the strip ``prepared``, with the operators between the film's grid and the patch. ``of_strip``:
    its correlation length and factors."""
    p = setting.problem
    patch = prepared.contact
    x = patch.x / p.length_unit
    unit_vectors = np.eye(setting.grid.n + 1)
    to_patch = np.stack([cubic(setting.grid.x, e, x) for e in unit_vectors], axis=1) * p.film_unit
    tolerance = min(prepared.scene.numerics.tolerance_of("balance"), LOOSEST)
    return TransientLoadSharing(
        prepared, setting, to_patch, patch.weight @ to_patch / patch.weight.sum(), tolerance, *of_strip
    )


def _softness(old: float, seen, load: float, found: ContactState) -> float:
    """Secant of the gap over the logarithm of the load, if it is meaningful."""
    if seen is None or abs(math.log(load / seen[0])) < 1e-6:
        return old
    slope = (seen[1] - found.mean_gap) / math.log(load / seen[0])
    return min(max(slope, 0.3 * old), 3.0 * old) if slope > 0.0 else old
