"""A film in a resolved gap as a `FrictionResult`: what the deterministic model and the one-way closure have in
common."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from typing import Any

from ..errors import Report
from ..scene import Scene
from ..sharing import Decision, Prepared, Validity, inlet_at
from .result import FrictionResult


def resolved_result(
    prepared: Prepared,
    speed: float,
    begun: float,
    decision: Decision,
    report: Report,
    entries: tuple[Validity, ...],
    per_width: dict[str, Any],
    numbers: dict[str, Any],
) -> FrictionResult:
    """The result of a film in a resolved gap, which is isothermal.

    ``begun``: the starting time, by `time.perf_counter`; ``report``: of the solve; ``entries``: assumptions that are
    violated. By their names in `FrictionResult`: ``per_width``, the forces over the width [N/m]; ``numbers``, those
    that are not proportional to it.
    """
    scene, width, sq = prepared.scene, prepared.scene.bodies.width, prepared.surface.sq
    central = numbers["central_film"]
    entries = (*entries, *_heat_left_out(scene, speed, per_width["couette_force"], central))
    if scene.numerics.grid == "given":
        decision = replace(decision, forced=("grid",))
    return FrictionResult(
        speed=speed,
        **{name: force * width for name, force in per_width.items()},
        shear_force=(per_width["couette_force"] + per_width["rolling_force"]) * width,
        **numbers,
        film_to_roughness_ratio=central / sq if sq > 0 else math.inf,
        inlet_film_factor=1.0,
        flash_temperature_rise=0.0,
        film_temperature_rise=0.0,
        volume_residual=math.nan,
        seconds=time.perf_counter() - begun,
        report=replace(report, notes=(decision.text, *(entry.text for entry in entries))),
        decision=decision,
        validity=entries,
    )


def _heat_left_out(scene: Scene, speed: float, couette: float, film: float) -> tuple[Validity, ...]:
    """A caution if the heat that these models leave out would matter.

    It matters by the heat of the inlet, or by the viscosity that the film loses. For the latter, the mean rise of the
    film over its walls is ``tau du h/(12 k)``. ``couette``: its force [N/m].
    """
    inlet, _ = inlet_at(scene, speed)
    if inlet is None:
        return ()
    lubricant, sliding = scene.lubricant, abs(scene.motion.slide_roll_ratio * speed)
    stress = abs(couette) / (2 * scene.bodies.half_width)
    rise = stress * sliding * film / (12 * lubricant.conductivity)
    change = max(1 - inlet.factor, rise * (lubricant.temperature_coefficient or 0.0))
    if not change > scene.numerics.tolerance:
        return ()
    return (
        Validity(
            "loss of film or viscosity by heat",
            change,
            scene.numerics.tolerance,
            "",
            "this model is isothermal: in truth the film is thinner and shears more easily",
            "load sharing (numerics.model = 'auto', closure = 'load') has the heat; heat = 'off' asks for none",
        ),
    )
