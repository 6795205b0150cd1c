"""The scene of a run in time at one moment: the values of the histories replace the constants; and its warm inlet."""

import math
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, TypeVar

from ..errors import InputError
from ..film import hertz
from ..models.shared import film_lubricant, inlet_at
from ..oil import Lubricant
from ..scene import Bodies, Constant, History, Motion, Scene, Transient, moving_bodies, sampled_times

Section = TypeVar("Section", Lubricant, Motion)

# [-] slide-roll ratio beyond which a moment counts as one of sliding alone; a choice: any number far above 2 does.
MOST_SLIDE_ROLL_RATIO = 1e6

# Bodies of moments that are remembered, of runs in which load and radius are constant; a choice.
REMEMBERED_BODIES = 100

# [-] part of a run over which the change of its speed is taken; a choice: small, and far above rounding.
SHORT_PART = 1e-6

# [-] the speed of a body is U plus this part of u2 - u1; by definition.
SLIDING_PART = {"surface": -0.5, "counterface": 0.5}


def transient_of(scene: Scene) -> Transient:
    """Return what changes in a scene of a run in time."""
    assert scene.transient is not None
    return scene.transient


def check_start(base: Scene) -> None:
    """Raise `InputError` for a steady start without entrainment."""
    transient = transient_of(base)
    speed = (transient.speed or Constant(base.motion.entrainment_speed)).before(0.0)
    if transient.initial == "steady" and transient.initial_film is None and speed == 0.0:
        raise InputError("transient.initial = 'steady' needs entrainment before t = 0; give 'rest', or a speed")


def scene_at(scene: Scene, time: float, side: str = "before") -> Scene:
    """Return ``scene``, whose ``transient`` says what changes, just "before" ``time`` [s], or "at" it: just after. It
    has the load, radius, speed, slide-roll ratio, f_b and viscosity of the moment. Its hardness is omitted, because the
    contact has it, and so are its ranges."""

    def now(name: str, constant: float) -> float:
        return value_at(scene, name, constant, time, side)

    bodies = scene.bodies
    oil = scene.lubricant
    motion = scene.motion
    speed = now("speed", motion.entrainment_speed)
    sliding = now("sliding", motion.slide_roll_ratio * speed)
    bodies = bodies_with(
        bodies,
        load=now("load", bodies.load),
        radius=now("radius", bodies.radius),
        boundary_friction=bodies.boundary_friction(sliding, oil.temperature),
    )
    oil = with_values(oil, viscosity=now("viscosity", oil.viscosity))
    ratio = 0.0
    if abs(sliding) > MOST_SLIDE_ROLL_RATIO * abs(speed):
        ratio = math.copysign(MOST_SLIDE_ROLL_RATIO, sliding)
    elif sliding:
        ratio = sliding / speed
    motion = with_values(motion, entrainment_speed=speed, slide_roll_ratio=ratio, speeds=())
    return replace(scene, bodies=bodies, lubricant=oil, motion=motion, ranges=())


@lru_cache(maxsize=REMEMBERED_BODIES)
def bodies_with(bodies: Bodies, *, load: float, radius: float, boundary_friction: float) -> Bodies:
    """Return ``bodies`` with the values of a moment, without hardness and without a table of f_b."""
    return replace(
        bodies,
        load=load,
        radius=radius,
        hardness=None,
        boundary_friction_coefficient=boundary_friction,
        boundary_friction_table=None,
    )


def with_values(section: Section, **values: Any) -> Section:
    """Return a ``section`` of a scene with these ``values``: itself, which is checked, if it has them."""
    has_them = all(getattr(section, name) == value for name, value in values.items())
    return section if has_them else replace(section, **values)


def sliding_at(scene: Scene, time: float, side: str = "before") -> float:
    """Return u2 - u1 [m/s]."""
    motion = scene.motion
    speed = value_at(scene, "speed", motion.entrainment_speed, time, side)
    return value_at(scene, "sliding", motion.slide_roll_ratio * speed, time, side)


def surface_speed(scene: Scene, body: str, time: float) -> float:
    """Return the speed [m/s] of the ``body`` with that section ("surface", "counterface"), just before ``time`` [s]."""
    speed = value_at(scene, "speed", scene.motion.entrainment_speed, time)
    sliding = value_at(scene, "sliding", scene.motion.slide_roll_ratio * speed, time)
    return speed + SLIDING_PART[body] * sliding


def has_steady_film(scene: Scene, time: float) -> bool:
    """Return whether the film just before ``time`` [s] may be that of steady motion: the entrainment speed is above
    that which passes the width of the contact, 2 b, with the acceleration a of the moment, sqrt(2 (2 b) a). At a
    reversal it is not, and the film there is what was entrained before (squeeze film)."""
    bodies = scene.bodies
    constant = scene.motion.entrainment_speed
    step = SHORT_PART * transient_of(scene).duration
    begin = max(time - step, 0.0)
    change = value_at(scene, "speed", constant, begin + step) - value_at(scene, "speed", constant, begin, "at")
    load = value_at(scene, "load", bodies.load, time)
    radius = value_at(scene, "radius", bodies.radius, time)
    half_width = hertz.line_half_width(load / bodies.width, radius, bodies.e_prime)
    speed = value_at(scene, "speed", constant, time)
    return speed**2 > 4.0 * half_width * abs(change) / step


def roughness_moves(scene: Scene) -> bool:
    """Return whether the roughness of a body moves at some time of a run."""
    rough = [name for name, _ in moving_bodies(scene)]
    return any(surface_speed(scene, name, time) for name in rough for time in sampled_times(scene))


def value_at(scene: Scene, name: str, constant: float, time: float, side: str = "before") -> float:
    """Return the value of what a run in time changes under ``name``, just "before" ``time`` [s] or "at" it;
    ``constant`` where nothing changes it."""
    history = getattr(transient_of(scene), name)
    return constant if history is None else getattr(history, side)(time)


def fastest_of_run(scene: Scene) -> float:
    """Return the largest entrainment or sliding speed [m/s] of a run, without its sign, at its `sampled_times`."""
    speed = scene.motion.entrainment_speed
    moments = [(time, side) for time in sampled_times(scene) for side in ("before", "at")]
    entraining = (abs(value_at(scene, "speed", speed, *moment)) for moment in moments)
    sliding = (abs(sliding_at(scene, *moment)) for moment in moments)
    return max(*entraining, *sliding)


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
        """Return the range that the `sampled_times` show."""
        return self._seen

    @cached_property
    def _seen(self) -> tuple[float, float]:
        temperatures = [self._warm(t, side) for t in sampled_times(self.scene) for side in ("before", "at")]
        return min(temperatures), max(temperatures)

    def _warm(self, time: float, side: str) -> float:
        now = scene_at(self.scene, time, side)
        return film_lubricant(now, now.motion.entrainment_speed).viscosity


def inlet_viscosity(scene: Scene) -> History:
    """Return the viscosity [Pa s] with which the film is solved: that of the scene, or its history. If the heat of the
    inlet would at some time thin the film by more than its share of the tolerance, it is that of the warm inlet."""
    cold = transient_of(scene).viscosity or Constant(scene.lubricant.viscosity)
    if scene.numerics.heat == "off" or not scene.lubricant.heats:
        return cold
    if scene.numerics.heat == "auto":
        moments = (scene_at(scene, time) for time in sampled_times(scene))
        if not any(inlet_at(now, now.motion.entrainment_speed)[1] for now in moments):
            return cold
    return WarmInlet(scene.with_(numerics={"heat": "on"}))
