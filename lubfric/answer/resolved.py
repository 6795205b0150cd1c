"""A film in a resolved gap as a `FrictionResult`: what one pressure and the one-way closure have in common."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace

from ..heat.point import inlet_at
from ..point.decision import Decision
from ..prepared import Prepared
from ..report import Report
from ..result import FrictionResult
from ..scene import Scene
from ..validity.entry import Validity


@dataclass(frozen=True)
class Resolved:
    """One operating point as a film in a resolved gap gives it.

    - ``film``, ``contact``: levels by name; ``film_words``: the film in words; ``notes``: how it was solved.
    - ``coefficient``: f [-]; loads and forces are per width [N/m].
    - ``contact_area`` [m²]: of the width of one patch; ``contact_fraction``, ``plastic_fraction``: of the Hertz strip.
    - gaps [m]; ``load_residual`` [-]; ``report``: of the solve; ``entries``: assumptions that do not hold.
    """

    film: str
    contact: str
    film_words: str
    notes: tuple[str, ...]
    coefficient: float
    contact_load: float
    film_load: float
    boundary: float
    couette: float
    rolling: float
    contact_fraction: float
    contact_area: float
    plastic_fraction: float
    min_gap: float
    central_gap: float
    mean_gap: float
    load_residual: float
    report: Report
    entries: tuple[Validity, ...]


def resolved_result(prepared: Prepared, speed: float, found: Resolved, begun: float) -> FrictionResult:
    """The numbers of ``found`` for the whole width, isothermal. ``begun``: when the solve began, by
    `time.perf_counter`."""
    scene, width, sq = prepared.scene, prepared.scene.bodies.width, prepared.surface.sq
    entries = (*found.entries, *_heat_left_out(scene, speed, found))
    decision = Decision(
        film=found.film,
        contact=found.contact,
        tolerance=scene.numerics.tolerance,
        film_words=found.film_words,
        forced=("grid",) if scene.numerics.grid == "given" else (),
        notes=found.notes,
    )
    return FrictionResult(
        speed=speed,
        coefficient=found.coefficient,
        contact_load=found.contact_load * width,
        film_load=found.film_load * width,
        shear_force=(found.couette + found.rolling) * width,
        couette_force=found.couette * width,
        rolling_force=found.rolling * width,
        boundary_force=found.boundary * width,
        real_contact_area_fraction=found.contact_fraction,
        real_contact_area=found.contact_area * width / prepared.surface.size[1],
        plastic_area_fraction=found.plastic_fraction,
        min_film=found.min_gap,
        central_film=found.central_gap,
        mean_gap=found.mean_gap,
        film_to_roughness_ratio=found.central_gap / sq if sq > 0 else math.inf,
        inlet_film_factor=1.0,
        flash_temperature_rise=0.0,
        film_temperature_rise=0.0,
        load_residual=found.load_residual,
        volume_residual=math.nan,
        seconds=time.perf_counter() - begun,
        report=replace(found.report, notes=(decision.text, *(entry.text for entry in entries))),
        decision=decision,
        validity=entries,
    )


def _heat_left_out(scene: Scene, speed: float, found: Resolved) -> tuple[Validity, ...]:
    """A caution where the heat that these models leave out would matter.

    It would matter by the heat of the inlet, or by the viscosity that the film loses. For that the mean rise of the
    film over its walls is ``tau du h/(12 k)``.
    """
    inlet, _ = inlet_at(scene, speed)
    if inlet is None:
        return ()
    lubricant, sliding = scene.lubricant, abs(scene.motion.slide_roll_ratio * speed)
    stress = abs(found.couette) / (2 * scene.bodies.half_width)
    rise = stress * sliding * found.central_gap / (12 * lubricant.conductivity)
    change = max(1 - inlet.factor, rise * (lubricant.temperature_coefficient or 0.0))
    if not change > scene.numerics.tolerance:
        return ()
    return (
        Validity(
            "heat, by what it takes off the film or its viscosity,",
            change,
            scene.numerics.tolerance,
            "",
            "this model is isothermal: the film is thinner and shears more easily than it says",
            "load sharing (numerics.model = 'auto', closure = 'load') has the heat; heat = 'off' asks for none",
        ),
    )
