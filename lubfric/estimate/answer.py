"""The numbers of one operating point by load sharing, and their errors."""

import math
import time
from dataclasses import replace
from typing import Any

from ..models.load_sharing import (
    Response,
    SampleSolution,
    decided,
    limits_exceeded,
    quantities,
    touched_length,
)
from ..models.shared import (
    Prepared,
    Validity,
    of_error,
)
from ..models.shared import exponents as film_exponents
from ..oil import estimate_in_words
from .errors_of import errors_of
from .ranges import with_ranges
from .result import FrictionResult

CLOSER = "f is good to that error; a tighter numerics.tolerance or a larger map makes it smaller"


def load_sharing_answer(
    found: SampleSolution, prepared: Prepared, speed: float, begun: float, why: str = ""
) -> FrictionResult:
    """The answer of the sample ``found`` of ``prepared`` at ``speed`` [m/s]. ``begun``: the starting time, by
    `time.perf_counter`; ``why``: the reason for this model, in words."""
    scene = prepared.scene
    numbers = _numbers(prepared, speed, found)
    uncertainty, errors = errors_of(scene, found)
    factors, _ = _cells(found)
    sample = {"coarsening": factors, "strips": found.count, "change_by_cells": found.change("gap")}
    decision = decided(scene, found.contact, found.balance, numbers["clearance"], why, **sample)
    tolerance = scene.numerics.tolerance
    warnings = (
        *_finer(found.change("finer_grid_change"), tolerance),
        *of_error(uncertainty.numerical, tolerance, CLOSER),
    )
    oil = scene.lubricant.oil
    temperature = scene.lubricant.temperature
    known = () if oil is None or temperature is None else (estimate_in_words(oil, temperature),)
    validity = (*limits_passed(found, prepared, speed), *warnings)
    notes = (*found.balance.report.notes, decision.text, *known, *(entry.text for entry in validity), uncertainty.text)
    result = FrictionResult(
        **numbers,
        seconds=time.perf_counter() - begun,
        report=replace(found.balance.report, notes=notes),
        uncertainty=uncertainty,
        errors=errors,
        decision=decision,
        validity=validity,
        balance=replace(found.balance, contact=replace(found.balance.contact, fields=found.solved.contact.fields)),
        heights=found.contact.heights if found.sample.is_resolved else None,  # type: ignore[attr-defined]
    )
    return with_ranges(prepared, result)


def limits_passed(found: SampleSolution, prepared: Prepared, speed: float) -> tuple[Validity, ...]:
    """Entries for every limit of Eq. (8) that ``found`` is beyond."""
    return limits_exceeded(prepared, speed, found.balance, _cells(found)[1])


def _cells(found: SampleSolution) -> tuple[tuple[int, int], float]:
    """Length of the cells that were solved, in cells of the map, along each axis; and the share of the load on the edge
    columns, on the map's own cells."""
    factors = found.sample.cells.coarsening
    if found.sample.is_single_patch and factors != (1, 1):
        return factors, found.effect.edge_load_ratio
    return factors, found.contact.on_the_ends(found.solved.contact) / factors[0]


def _finer(change: float, tolerance: float) -> tuple[Validity, ...]:
    """A warning where cells half as long as the map's own would change f by more than ``tolerance``."""
    if not change > tolerance:
        return ()
    what = "change of f by cells half as long, estimated"
    remedy = "use a map on shorter cells"
    consequence = "the map is too coarse for its roughness; the interval of f does not include that"
    return (Validity(what, 100 * change, 100 * tolerance, "%", consequence, remedy),)


def _numbers(prepared: Prepared, speed: float, found: SampleSolution) -> dict[str, Any]:
    """All numbers of the sample but the time, by name."""
    scene = prepared.scene
    balance = found.balance
    sq = prepared.surface.sq
    contact = balance.contact
    film = balance.film
    loads = (balance.film_load, balance.contact_load)
    separated = balance.contact_load == 0
    touched = touched_length(contact) * found.effect.touched / found.effect.area
    numbers = quantities(balance.forces, film, loads, contact.mean_film if separated else contact.mean_gap)
    return numbers | {
        "power_loss": math.nan,  # by `with_power_loss`
        "full_load_film": math.nan,  # by `full_load_numbers`
        "lambda_ratio": math.nan,
        "speed": speed,
        "real_contact_area_fraction": contact.real_contact_area_fraction,
        "real_contact_area": touched * scene.bodies.width,
        "plastic_area_fraction": contact.plastic_area_fraction,
        "film_to_roughness_ratio": numbers["central_film"] / sq if sq > 0 else math.inf,
        "load_residual": (sum(loads) - scene.bodies.load) / scene.bodies.load,
        "volume_residual": 0.0 if film is None or separated else found.solved.contact.volume_residual,
        "clearance": (contact.mean_film - contact.mean_gap) / max(sq, 1e-12) if separated else math.nan,
        "steepness": _steepness(prepared, speed, found.response, balance),
    }


def _steepness(prepared: Prepared, speed: float, response: Response | None, balance) -> float:
    """d ln(F_H/F_C)/d ln U: at a given division of the load the film grows as U^e, by closed forms at F_H. NaN where
    film and contact do not share the load."""
    if response is None or balance.film is None or balance.contact_load == 0:
        return math.nan
    scene = prepared.scene
    line = replace(scene.line_contact(speed), load_per_width=balance.film_load / scene.bodies.width)
    return -film_exponents(line)[2] * response.log_load_ratio_per_gap * balance.contact.mean_film
