"""The scene of one moment: the values of the histories take the place of its constants. And the inlet that heats
itself."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..heat.point import film_lubricant, inlet_at
from ..history import Constant, History
from ..history.plan import Transient
from ..scene import Scene

FASTER = 1e6  # slide-roll ratio beyond which a moment counts as one of sliding alone
LOOKS = 257  # times at which a run is looked through


@dataclass(frozen=True)
class SceneInTime:
    """What ``scene`` is at each time of ``plan``."""

    scene: Scene
    plan: Transient

    def at(self, time: float, before: bool = True) -> Scene:
        """Just before ``time`` [s], or just after: with the load, radius, speed, slide-roll ratio and viscosity of the
        moment. Its hardness is left out: the contact has it."""
        bodies, oil, motion = self.scene.bodies, self.scene.lubricant, self.scene.motion
        speed = self._value("speed", motion.entrainment_speed, time, before)
        return replace(
            self.scene,
            bodies=replace(
                bodies,
                load=self._value("load", bodies.load, time, before),
                radius=self._value("radius", bodies.radius, time, before),
                hardness=None,
            ),
            lubricant=replace(oil, viscosity=self._value("viscosity", oil.viscosity, time, before)),
            motion=replace(
                motion, entrainment_speed=speed, slide_roll_ratio=_ratio(self.sliding(time, before), speed), speeds=()
            ),
        )

    def sliding(self, time: float, before: bool = True) -> float:
        """u2 - u1 [m/s]."""
        if self.plan.sliding is not None:
            return self.plan.sliding.before(time) if before else self.plan.sliding.at(time)
        motion = self.scene.motion
        return motion.slide_roll_ratio * self._value("speed", motion.entrainment_speed, time, before)

    @property
    def histories(self) -> tuple[History, ...]:
        """All that changes."""
        plan = self.plan
        given = (plan.speed, plan.sliding, plan.load, plan.radius, plan.viscosity)
        return tuple(h for h in given if h is not None)

    def _value(self, name: str, constant: float, time: float, before: bool) -> float:
        history = getattr(self.plan, name)
        if history is None:
            return constant
        return history.before(time) if before else history.at(time)


@dataclass(frozen=True)
class WarmInlet(History):
    """Ambient viscosity [Pa s] in the inlet, which the shear of the moment keeps warmer than the oil around. The
    inlet is passed in less than b/U, so its heat is that of steady motion."""

    source: SceneInTime

    def at(self, time: float) -> float:
        return _warm(self.source.at(time, before=False))

    def before(self, time: float) -> float:
        return _warm(self.source.at(time))

    def stops(self, duration: float) -> tuple[float, ...]:
        """Those of all histories."""
        return tuple(sorted({t for h in self.source.histories for t in h.stops(duration)}))

    def jumps(self, duration: float) -> tuple[float, ...]:
        """Those of all histories."""
        return tuple(sorted({t for h in self.source.histories for t in h.jumps(duration)}))

    def range(self, duration: float) -> tuple[float, float]:
        """As far as `LOOKS` times and every stop show."""
        low, high = self._seen
        return low, high

    @cached_property
    def _seen(self) -> tuple[float, float]:
        found = [f(t) for t in _looks(self.source) for f in (self.before, self.at)]
        return min(found), max(found)


def inlet_viscosity(source: SceneInTime) -> History:
    """The viscosity [Pa s] that the film is solved with: that of the scene, or its history. Where the heat of the
    inlet would thin the film by more than its share of the tolerance at some time, that of a warm inlet."""
    scene, plan = source.scene, source.plan
    cold = plan.viscosity or Constant(scene.lubricant.viscosity)
    if scene.numerics.heat == "off" or not scene.lubricant.heats:
        return cold
    if scene.numerics.heat == "auto" and scene.numerics.model != "full":
        if not any(inlet_at(now, now.motion.entrainment_speed)[1] for now in map(source.at, _looks(source))):
            return cold
    return WarmInlet(SceneInTime(scene.with_(numerics={"heat": "on"}), plan))


def _warm(now: Scene) -> float:
    return film_lubricant(now, now.motion.entrainment_speed).viscosity


def _looks(source: SceneInTime) -> list[float]:
    duration = source.plan.duration
    stops = {t for h in source.histories for t in (*h.stops(duration), *h.jumps(duration))}
    return sorted({*np.linspace(0, duration, LOOKS).tolist(), *stops})


def _ratio(sliding: float, speed: float) -> float:
    """Slide-roll ratio, no larger than `FASTER`."""
    if sliding == 0:
        return 0.0
    if abs(sliding) > FASTER * abs(speed):
        return math.copysign(FASTER, sliding)
    return sliding / speed
