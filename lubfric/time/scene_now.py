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


def scene_at(scene: Scene, time: float, side: str = "before") -> Scene:
    """``scene``, whose ``transient`` says what changes, just "before" ``time`` [s], or "at" it: just after. It has the
    load, radius, speed, slide-roll ratio and viscosity of the moment. Its hardness is left out, because the contact has
    it."""

    def now(name: str, constant: float) -> float:
        return _value(scene, name, constant, time, side)

    bodies, oil = scene.bodies, scene.lubricant
    bodies = replace(bodies, load=now("load", bodies.load), radius=now("radius", bodies.radius), hardness=None)
    oil = replace(oil, viscosity=now("viscosity", oil.viscosity))
    speed, sliding = now("speed", scene.motion.entrainment_speed), sliding_at(scene, time, side)
    alone = abs(sliding) > FASTER * abs(speed)
    ratio = math.copysign(FASTER, sliding) if alone else sliding / speed if sliding else 0.0
    motion = replace(scene.motion, entrainment_speed=speed, slide_roll_ratio=ratio, speeds=())
    return replace(scene, bodies=bodies, lubricant=oil, motion=motion)


def sliding_at(scene: Scene, time: float, side: str = "before") -> float:
    """u2 - u1 [m/s]."""
    motion = scene.motion
    speed = _value(scene, "speed", motion.entrainment_speed, time, side)
    return _value(scene, "sliding", motion.slide_roll_ratio * speed, time, side)


def _value(scene: Scene, name: str, constant: float, time: float, side: str) -> float:
    history = getattr(changes(scene), name)
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
        """The range that `LOOKS` times and every stop show."""
        return self._seen

    @cached_property
    def _seen(self) -> tuple[float, float]:
        found = [self._warm(t, side) for t in _looks(self.scene) for side in ("before", "at")]
        return min(found), max(found)

    def _warm(self, time: float, side: str) -> float:
        now = scene_at(self.scene, time, side)
        return film_lubricant(now, now.motion.entrainment_speed).viscosity


def inlet_viscosity(scene: Scene) -> History:
    """The viscosity [Pa s] with which the film is solved: that of the scene, or its history. If the heat of the inlet
    would at some time thin the film by more than its share of the tolerance, it is that of the warm inlet."""
    cold = changes(scene).viscosity or Constant(scene.lubricant.viscosity)
    if scene.numerics.heat == "off" or not scene.lubricant.heats:
        return cold
    if scene.numerics.heat == "auto":
        moments = (scene_at(scene, time) for time in _looks(scene))
        if not any(inlet_at(now, now.motion.entrainment_speed)[1] for now in moments):
            return cold
    return WarmInlet(scene.with_(numerics={"heat": "on"}))


def _looks(scene: Scene) -> list[float]:
    plan = changes(scene)
    stops = {t for h in plan.histories for t in (*h.stops(plan.duration), *h.jumps(plan.duration))}
    return sorted({*np.linspace(0, plan.duration, LOOKS).tolist(), *stops})
