"""The numbers of one operating point by load sharing, and their errors."""

from __future__ import annotations

import math
import time
from dataclasses import replace

from ..oil import estimate_in_words
from ..sharing import Prepared, Response, Validity, judged, of_error
from ..sharing import exponents as film_exponents
from .decision import decided
from .errors_of import errors_of
from .result import FrictionResult
from .sample import Found, sampled

CLOSER = "f is good to that error; a tighter numerics.tolerance or a larger map makes it smaller"


def load_sharing_answer(prepared: Prepared, speed: float, fields: bool, begun: float) -> FrictionResult:
    """Solve ``prepared`` at ``speed`` [m/s] on its sample. ``fields``: solve on the map's own cells; ``begun``: the
    starting time, by `time.perf_counter`."""
    found, tolerance = sampled(prepared, speed, own_cells=fields), prepared.scene.numerics.tolerance
    result = _numbers(prepared, speed, found, begun)
    uncertainty, errors = errors_of(prepared.scene, found)
    cautions = (*_finer(found.change("beyond"), tolerance), *of_error(uncertainty.numerical, tolerance, CLOSER))
    report = replace(result.report, notes=(*result.report.notes, *(c.text for c in cautions), uncertainty.text))
    validity = (*result.validity, *cautions)
    return replace(result, uncertainty=uncertainty, errors=errors, report=report, validity=validity)


def _finer(change: float, tolerance: float) -> tuple[Validity, ...]:
    """A caution where cells half as long as the map's own would change f by more than ``tolerance``."""
    if not change > tolerance:
        return ()
    what, remedy = "change of f by cells half as long, estimated", "use a map on shorter cells"
    consequence = "the map is too coarse for its roughness; the interval of f does not include that"
    return (Validity(what, 100 * change, 100 * tolerance, "%", consequence, remedy),)


def _numbers(prepared: Prepared, speed: float, found: Found, begun: float) -> FrictionResult:
    """The numbers of the sample, without their errors."""
    scene, balance, sq = prepared.scene, found.balance, prepared.surface.sq
    contact, film, forces = balance.contact, balance.film, balance.forces
    central = film.central_film if film is not None else math.nan
    separated = balance.contact_load == 0
    factors = (1, 1) if found.strips is None else found.strips.cells.factors
    ends = found.contact.on_the_ends(found.solved.contact) / factors[0]
    if found.strips is not None and found.strips.whole and factors != (1, 1):
        ends = found.effect.ends
    passed = judged(prepared, speed, balance, ends)
    change = found.change("gap")
    decision = decided(
        scene, found.contact, balance, sq, coarsening=factors, strips=found.count, change_by_cells=change
    )
    oil, temperature = scene.lubricant.oil, scene.lubricant.temperature
    known = () if oil is None or temperature is None else (estimate_in_words(oil, temperature),)
    notes = (*balance.report.notes, decision.text, *known, *(entry.text for entry in passed))
    return FrictionResult(
        speed=speed,
        coefficient=forces.coefficient,
        contact_load=balance.contact_load,
        film_load=balance.film_load,
        shear_force=forces.shear.total,
        couette_force=forces.shear.couette,
        rolling_force=forces.shear.rolling,
        boundary_force=forces.boundary,
        real_contact_area_fraction=contact.real_contact_area_fraction,
        real_contact_area=float(contact.contact_fraction.sum() * (contact.x[1] - contact.x[0]) * scene.bodies.width),
        plastic_area_fraction=contact.plastic_area_fraction,
        min_film=film.min_film if film is not None else math.nan,
        central_film=central,
        mean_gap=contact.mean_film if separated else contact.mean_gap,
        film_to_roughness_ratio=central / sq if sq > 0 else math.inf,
        inlet_film_factor=forces.heat.film_factor,
        flash_temperature_rise=forces.heat.flash,
        film_temperature_rise=forces.heat.film,
        load_residual=(balance.contact_load + balance.film_load - scene.bodies.load) / scene.bodies.load,
        volume_residual=0.0 if film is None or separated else found.solved.contact.volume_residual,
        seconds=time.perf_counter() - begun,
        report=replace(balance.report, notes=notes),
        balance=replace(balance, contact=replace(contact, fields=found.solved.contact.fields)),
        heights=None if found.strips is None else found.contact.heights,  # type: ignore[attr-defined]
        decision=decision,
        validity=passed,
        steepness=_steepness(prepared, speed, found.response, balance),
    )


def _steepness(prepared: Prepared, speed: float, response: Response | None, balance) -> float:
    """d ln(F_H/F_C)/d ln U: at a given division of the load the film grows as U^e, by Moes' formula at F_H. NaN where
    film and contact do not share the load."""
    if response is None or balance.film is None or balance.contact_load == 0:
        return math.nan
    scene = prepared.scene
    line = replace(scene.line_contact(speed), load_per_width=balance.film_load / scene.bodies.width)
    return -film_exponents(line)[2] * response.split * balance.contact.mean_film
