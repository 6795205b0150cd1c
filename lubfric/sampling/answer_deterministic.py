"""The deterministic model, one gap with one pressure, as a `FrictionResult`: its numbers, and what a reader has to
know."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from ..deterministic import Refined, deterministic_point
from ..quantities import NUMBERS
from ..scene import Scene
from ..sharing import Prepared, Validity, inlet_at, of_error, of_motion, of_pressure, of_thickness
from .decision import Decision
from .result import FrictionResult
from .uncertainty import field_errors_of, not_sampled

NO_PLACES = "not estimated for one pressure of film and contact"
DRAWN, CUT = 0.1, 0.1  # lubricant drawn from touching cells, load of a Newtonian film sheared beyond f_b p: told above


def deterministic_answer(prepared: Prepared, speed: float, begun: float) -> FrictionResult:
    """Solve ``prepared`` at ``speed`` [m/s], which is not 0. ``begun``: the starting time, by `time.perf_counter`. The
    film is isothermal."""
    scene, surface = prepared.scene, prepared.surface
    found = deterministic_point(scene, surface, speed)
    tolerance, numbers = scene.numerics.tolerance, _numbers(prepared, speed, found)
    decision = Decision("deterministic", _words(found), "boundary film", tolerance, notes=_notes(found))
    hot = _heat_left_out(scene, speed, found.result.couette, numbers["central_film"])
    entries = (*_entries(prepared, speed, found), *hot)
    return FrictionResult(
        **(numbers | {"seconds": time.perf_counter() - begun}),
        report=replace(found.result.report, notes=(decision.text, *(entry.text for entry in entries))),
        uncertainty=not_sampled(found.error, scene, surface.size[1], NO_PLACES),
        errors=field_errors_of({} if found.error is None else {"coefficient": found.error}, NO_PLACES),
        decision=decision,
        validity=entries,
        deterministic=found,
    )


def _numbers(prepared: Prepared, speed: float, found: Refined) -> dict[str, Any]:
    """All numbers of the point but the time, by name; NaN where the model has no such number."""
    result, bodies, sq = found.result, prepared.scene.bodies, prepared.surface.sq
    return dict.fromkeys(NUMBERS, math.nan) | {
        "speed": speed,
        "coefficient": result.coefficient,
        "contact_load": result.split.spots * bodies.width,
        "film_load": bodies.load - result.split.spots * bodies.width,
        "shear_force": (result.couette + result.rolling) * bodies.width,
        "couette_force": result.couette * bodies.width,
        "rolling_force": result.rolling * bodies.width,
        "boundary_force": result.boundary * bodies.width,
        "real_contact_area_fraction": result.spot_fraction,
        "real_contact_area": result.spot_length * bodies.width,
        "plastic_area_fraction": result.plastic_fraction,
        "min_film": result.min_gap,
        "central_film": result.central_gap,
        "mean_gap": result.mean_gap,
        "film_to_roughness_ratio": result.central_gap / sq if sq > 0 else math.inf,
        "inlet_film_factor": 1.0,
        "flash_temperature_rise": 0.0,
        "film_temperature_rise": 0.0,
        "load_residual": result.report.residuals["load"],
    }


def _words(found: Refined) -> str:
    """The film of ``found`` in one phrase: its grids and their estimated error."""
    shapes = " and ".join(f"{r.pressure.shape[0]} x {r.pressure.shape[1]}" for r in found.results[-2:])
    error = "" if found.error is None else f", estimated error {100 * found.error:.2g} % of f"
    return f"one pressure with the contact on {shapes} cells{error}"


def _notes(found: Refined) -> tuple[str, ...]:
    """The division of the load by each rule, and how the finest grid was solved, in words."""
    result = found.result
    split, load = result.split, result.load
    return (
        f"load on touching cells {100 * split.touching / load:.3g} %, on gaps below the boundary film "
        f"{100 * split.thin / load:.3g} %, on thicker Newtonian films at f_b p {100 * split.capped / load:.3g} %",
        f"f with half the boundary film {result.at_half_film:.3g}, with twice {result.at_twice_film:.3g}",
        *result.report.notes,
    )


def _entries(prepared: Prepared, speed: float, found: Refined) -> Iterator[Validity]:
    """Entries for all assumptions that are violated; those about bodies and map first."""
    scene, result = prepared.scene, found.result
    yield from prepared.known
    yield from of_motion(scene, speed, result.central_gap)
    yield from of_pressure(scene, result.top_pressure)
    yield from of_thickness(scene, result.central_gap)
    cut = result.split.capped / result.load
    if cut > CUT:
        consequence = "a Newtonian film would be sheared above f_b p there; its stress was limited to that"
        remedy = "choose lubricant.eyring_stress or a limiting stress"
        yield Validity("share of the load on a saturated film", cut, CUT, "", consequence, remedy)
    if result.drawn > DRAWN:
        consequence = "f depends on the 1 nm of lubricant that touching bodies are said to keep, by about a percent"
        remedy = "read f to a percent or two: hardly any lubricant passes the contact"
        yield Validity("share of the lubricant out of touching cells", result.drawn, DRAWN, "", consequence, remedy)
    yield from of_error(found.error, scene.numerics.tolerance, "a finer contact.spacing, a larger tolerance")


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
            "load sharing (numerics.model = 'auto') has the heat; heat = 'off' asks for none",
        ),
    )
