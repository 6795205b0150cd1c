"""The scene of one moment, in which the values of the histories replace its constants; and the inlet that heats
itself."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..scene import Constant, History, Scene, Transient
from ..sharing import film_lubricant, inlet_at

FASTER = 1e6  # slide-roll ratio beyond which a moment counts as one of sliding alone
LOOKS = 257  # times at which a run is looked through


def changes(scene: Scene) -> Transient:
    """What changes in a scene of a run in time."""
    assert scene.transient is not None
    return scene.transient


def scene_at(scene: Scene, time: float, before: bool = True) -> Scene:
    """``scene``, whose ``transient`` says what changes, just before ``time`` [s], or just after: with the load, radius,
    speed, slide-roll ratio and viscosity of the moment. Its hardness is left out, because the contact has it."""
    bodies, oil, motion = scene.bodies, scene.lubricant, scene.motion
    speed = _value(scene, "speed", motion.entrainment_speed, time, before)
    ratio = _ratio(sliding_at(scene, time, before), speed)
    return replace(
        scene,
        bodies=replace(
            bodies,
            load=_value(scene, "load", bodies.load, time, before),
            radius=_value(scene, "radius", bodies.radius, time, before),
            hardness=None,
        ),
        lubricant=replace(oil, viscosity=_value(scene, "viscosity", oil.viscosity, time, before)),
        motion=replace(motion, entrainment_speed=speed, slide_roll_ratio=ratio, speeds=()),
    )


def sliding_at(scene: Scene, time: float, before: bool = True) -> float:
    """u2 - u1 [m/s]."""
    motion = scene.motion
    speed = _value(scene, "speed", motion.entrainment_speed, time, before)
    return _value(scene, "sliding", motion.slide_roll_ratio * speed, time, before)


def _value(scene: Scene, name: str, constant: float, time: float, before: bool) -> float:
    history = getattr(changes(scene), name)
    if history is None:
        return constant
    return history.before(time) if before else history.at(time)


@dataclass(frozen=True)
class WarmInlet(History):
    """Ambient viscosity [Pa s] in the inlet, which the shear of the moment keeps warmer than the oil around. The inlet
    is passed in less than b/U, so its heat is taken as that of steady motion."""

    scene: Scene

    def at(self, time: float) -> float:
        return _warm(scene_at(self.scene, time, before=False))

    def before(self, time: float) -> float:
        return _warm(scene_at(self.scene, time))

    def range(self, duration: float) -> tuple[float, float]:
        """The range that `LOOKS` times and every stop show."""
        low, high = self._seen
        return low, high

    @cached_property
    def _seen(self) -> tuple[float, float]:
        found = [f(t) for t in _looks(self.scene) for f in (self.before, self.at)]
        return min(found), max(found)


def inlet_viscosity(scene: Scene) -> History:
    """The viscosity [Pa s] with which the film is solved: that of the scene, or its history. If the heat of the inlet
    would at some time thin the film by more than its share of the tolerance, it is that of the warm inlet."""
    cold = changes(scene).viscosity or Constant(scene.lubricant.viscosity)
    if scene.numerics.heat == "off" or not scene.lubricant.heats:
        return cold
    if scene.numerics.heat == "auto" and scene.numerics.model != "full":
        moments = (scene_at(scene, time) for time in _looks(scene))
        if not any(inlet_at(now, now.motion.entrainment_speed)[1] for now in moments):
            return cold
    return WarmInlet(scene.with_(numerics={"heat": "on"}))


def _warm(now: Scene) -> float:
    return film_lubricant(now, now.motion.entrainment_speed).viscosity


def _looks(scene: Scene) -> list[float]:
    plan = changes(scene)
    stops = {t for h in plan.histories for t in (*h.stops(plan.duration), *h.jumps(plan.duration))}
    return sorted({*np.linspace(0, plan.duration, LOOKS).tolist(), *stops})


def _ratio(sliding: float, speed: float) -> float:
    """Slide-roll ratio, no larger than `FASTER`."""
    if sliding == 0:
        return 0.0
    if abs(sliding) > FASTER * abs(speed):
        return math.copysign(FASTER, sliding)
    return sliding / speed
