"""The numbers of a deterministic operating point as a `FrictionResult`."""

from __future__ import annotations

import math
import time
from dataclasses import replace

from ..model import Model
from ..point.decision import Decision
from ..result import FrictionResult
from ..sampling.uncertainty import field_errors_of, not_sampled
from .point import notes, validity, words
from .refine import Refined

NO_PLACES = "not estimated for one pressure of film and contact"


def deterministic_result(model: Model, speed: float, found: Refined, begun: float) -> FrictionResult:
    """The numbers of ``found``; ``begun``: when its solve did, by `time.perf_counter`."""
    scene, result = model.scene, found.result
    bodies, width = scene.bodies, scene.bodies.width
    decision = Decision(
        film="deterministic",
        contact="asperity spots",
        tolerance=scene.numerics.tolerance,
        film_words=words(found),
        forced=("grid",) if scene.numerics.grid == "given" else (),
        notes=notes(found),
    )
    passed = validity(model, speed, found)
    contact_load = result.split.spots * width
    dx, dy = result.spacing
    across = result.pressure.shape[1] * dy
    return FrictionResult(
        speed=speed,
        coefficient=result.coefficient,
        contact_load=contact_load,
        film_load=bodies.load - contact_load,
        shear_force=(result.couette + result.rolling) * width,
        couette_force=result.couette * width,
        rolling_force=result.rolling * width,
        boundary_force=result.boundary * width,
        real_contact_area_fraction=result.spot_fraction,
        real_contact_area=float(result.spots.sum()) * dx * dy * width / across,
        plastic_area_fraction=result.plastic_fraction,
        min_film=result.min_gap,
        central_film=result.central_gap,
        mean_gap=result.mean_gap,
        film_to_roughness_ratio=result.central_gap / model.surface.sq if model.surface.sq > 0 else math.inf,
        inlet_film_factor=1.0,
        flash_temperature_rise=0.0,
        film_temperature_rise=0.0,
        load_residual=result.report.residuals["load"],
        volume_residual=math.nan,
        seconds=time.perf_counter() - begun,
        report=replace(result.report, notes=(decision.text, *(entry.text for entry in passed))),
        decision=decision,
        validity=passed,
        deterministic=found,
        uncertainty=not_sampled(found.error, scene, across, NO_PLACES),
        errors=field_errors_of({} if found.error is None else {"coefficient": found.error}, NO_PLACES),
    )
