"""Effects that are not modelled in a run in time: each at the moment at which it changes f the most."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..film import hertz
from ..models.shared import (
    ExpectedEffect,
    Prepared,
    UnmodelledEffect,
    expected_effects,
    is_near_zero,
    unmodelled_effects,
)
from ..quantities import counted
from ..scene import Scene
from ..units import worded
from .registry import may_move_roughness
from .result import TransientResult, rolls
from .roughness_in_motion import way_to_motion_in_time
from .scene_in_time import has_steady_film, scene_at

# Outputs of a run at which its effects are judged, about. A choice: each takes some milliseconds, and the extremes of
# the run are always among them.
JUDGED_OUTPUTS = 200

# Part of the mean |f| of a run below which a change relative to f says little of its losses. A choice.
LEAST_SHARE_OF_F = 0.2


# Relative difference of two values that count as equal. A choice: above that of the halves of a symmetrical cycle,
# whose moments are rounded.
ALIKE_PEAKS = 1e-3


@dataclass(frozen=True, kw_only=True)
class EffectsOfMoment:
    """Effects that are not modelled, at one moment of a run.

    Attributes
    ----------
    time : the moment [s]
    peak_pressure : largest Hertz pressure of the moment [Pa]
    friction : |f| of the moment [-]; 1 where it is not known, so that relative changes are compared
    effects : as of `lubfric.models.shared.unmodelled_effects` or `expected_effects`
    """

    time: float
    peak_pressure: float
    friction: float
    effects: Sequence[UnmodelledEffect | ExpectedEffect]


@dataclass(frozen=True, kw_only=True)
class EffectOverTime:
    """An effect that is not modelled, at the moment of a run at which it changes f the most.

    Attributes
    ----------
    effect : as of `EffectsOfMoment`, with the change relative to f of that moment
    time : the moment [s]; that of the highest pressure for an effect whose change of f is not estimated
    unknown : number of the moments at which its change of f is not estimated
    """

    effect: UnmodelledEffect | ExpectedEffect
    time: float
    unknown: int

    @property
    def moment_in_words(self) -> str:
        """The moment as text."""
        text = f"t = {worded(self.time, 's')}"
        if math.isnan(self.effect.largest_change):
            return f"{text} (highest pressure)"
        return f"{text} (not estimated at {self.unknown} other moments)" if self.unknown else text


def effects_of_run(prepared: Prepared, result: TransientResult) -> tuple[EffectOverTime, ...]:
    """Return the effects that are not modelled in a run, each at the output at which it changes f the most; none where
    no output entrains oil. Those by the film are not judged where there is no steady one (`has_steady_film`)."""
    f = np.abs(result.coefficient)
    moving = np.flatnonzero(rolls(result.columns) & np.isfinite(f))
    if not moving.size:
        return ()
    scenes = {index: scene_at(prepared.scene, float(result.time[index])) for index in moving.tolist()}
    pressures = np.array([_peak_pressure(scene) for scene in scenes.values()])
    evenly = moving[np.linspace(0, moving.size - 1, min(JUDGED_OUTPUTS, moving.size)).round().astype(int)]
    extremes = [pressures.argmax(), pressures.argmin(), f[moving].argmax(), f[moving].argmin()]
    extremes += [np.abs(result.entrainment_speed[moving]).argmax(), result.contact_load[moving].argmax()]
    way = way_to_motion_in_time(prepared.scene)
    moments = []
    for index in sorted({*evenly.tolist(), *moving[extremes].tolist()}):
        load = result.load[index]
        effects = unmodelled_effects(
            scenes[index],
            prepared.surface.sq,
            _speed_of_steady_film(prepared.scene, float(result.time[index])),
            (abs(float(result.boundary_force[index] / load)), float(f[index])),
            run=prepared.scene,
            includes_motion=may_move_roughness(prepared.scene),
            way_to_motion=way,
        )
        moments.append(
            EffectsOfMoment(
                time=float(result.time[index]),
                peak_pressure=_peak_pressure(scenes[index]),
                friction=float(f[index]),
                effects=effects,
            )
        )
    return largest_over_time(moments)


def expected_effects_of_run(scene: Scene, sq: float, times: Sequence[float]) -> tuple[EffectOverTime, ...]:
    """Return the effects that are not modelled in a run of ``scene``, whose surface has the standard deviation ``sq``
    [m], before it is solved: each at that of the ``times`` [s] at which the range of its relative change of f is
    widest. Those by the film are judged as in `effects_of_run`."""
    moments = []
    way = way_to_motion_in_time(scene)
    for time in times:
        now = scene_at(scene, time)
        speed = _speed_of_steady_film(scene, time)
        effects = expected_effects(
            now, sq, speed, run=scene, includes_motion=may_move_roughness(scene), way_to_motion=way
        )
        moments.append(EffectsOfMoment(time=time, peak_pressure=_peak_pressure(now), friction=1.0, effects=effects))
    return largest_over_time(moments)


def without_steady_film(scene: Scene, times: Sequence[float]) -> str:
    """Return at how many of the ``times`` [s] no film is steady, so that no effect on it is estimated there, as a
    sentence to be appended; "" where there is one at all."""
    count = sum(not has_steady_film(scene, time) for time in times)
    if not count:
        return ""
    return (
        f" At {count} of {counted(len(times), 'moments')}, as at a reversal, no film is steady; changes by the film are "
        "not estimated there."
    )


def _speed_of_steady_film(scene: Scene, time: float) -> float:
    """Return the entrainment speed [m/s] at ``time`` [s], without its sign; 0 where it makes no steady film."""
    return abs(scene_at(scene, time).motion.entrainment_speed) if has_steady_film(scene, time) else 0.0


def first_largest(values: Sequence[float]) -> int:
    """Return the index of the largest of ``values``, 0 or more; of several peaks that are as large, `ALIKE_PEAKS`, that
    of the first."""
    is_at_peak = np.asarray(values) >= (1.0 - ALIKE_PEAKS) * max(values)
    first = int(np.argmax(is_at_peak))
    end = first + int(np.argmin(np.append(is_at_peak[first:], False)))
    return first + int(np.argmax(values[first:end]))


def largest_over_time(moments: Sequence[EffectsOfMoment]) -> tuple[EffectOverTime, ...]:
    """Return each effect of the ``moments`` once: where the change of f by it, not relative to f, is largest. Moments
    at which f is so near 0 that a relative change says nothing, or below `LEAST_SHARE_OF_F` of the mean of all
    moments, count only where there are no others. An effect whose
    change is not estimated at any moment is that of the highest pressure. The largest change is first."""
    by_name: dict[str, list[tuple[EffectsOfMoment, UnmodelledEffect | ExpectedEffect]]] = {}
    for moment in moments:
        for effect in moment.effects:
            by_name.setdefault(effect.kind or effect.what, []).append((moment, effect))
    least = LEAST_SHARE_OF_F * float(np.mean([moment.friction for moment in moments])) if moments else 0.0
    chosen: list[tuple[float, EffectOverTime]] = []
    for pairs in by_name.values():
        known = [pair for pair in pairs if math.isfinite(pair[1].largest_change)]
        at_pressure = first_largest([moment.peak_pressure for moment, _ in pairs])
        moment, effect = max(known, key=partial(_rank, least=least)) if known else pairs[at_pressure]
        change = effect.largest_change * moment.friction if known else 0.0
        unknown = len(pairs) - len(known)
        chosen.append((change, EffectOverTime(effect=effect, time=moment.time, unknown=unknown)))
    return tuple(each for _, each in sorted(chosen, key=lambda pair: -pair[0]))


def _rank(pair: tuple[EffectsOfMoment, UnmodelledEffect | ExpectedEffect], least: float) -> tuple[bool, float]:
    """Return by what a moment of an effect is compared with others: whether its relative change says something, as |f|
    is ``least`` or more, and the change of f."""
    moment, effect = pair
    relative = effect.largest_change
    is_told = moment.friction >= least and not is_near_zero(moment.friction, relative)
    return is_told, relative * moment.friction


def _peak_pressure(scene: Scene) -> float:
    """Return the largest Hertz pressure [Pa] of the ``scene`` of one moment."""
    bodies = scene.bodies
    return hertz.line_peak_pressure(bodies.load / bodies.width, bodies.radius, bodies.e_prime)
