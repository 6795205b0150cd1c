"""The numbers of one operating point and their errors, on a long line or on one patch."""

from __future__ import annotations

import math
import time
from dataclasses import replace

from ..oil import estimate_in_words
from ..scene import Scene
from ..sharing import Prepared, Solved, judged_validity, of_error, solved_as_deflected
from .estimate import of_line
from .line_friction import line_friction
from .model_form import load_sharing_error
from .other_cells import by_half_cells, too_coarse
from .patch_area import areas_on_own_cells
from .patch_error import of_patch
from .result import FrictionResult
from .uncertainty import field_errors_of, not_sampled

NO_FILM = "what the film would carry, which numerics.film_level = 'none' leaves out, is not known"
CLOSER = "f is good to that error; a tighter numerics.tolerance or a larger map makes it smaller"


def load_sharing_answer(
    prepared: Prepared, speed: float, start: FrictionResult | None, fields: bool, begun: float
) -> FrictionResult:
    """Solve ``prepared`` at ``speed`` [m/s], on its long line if it has one, else on its patch.

    ``start``: the result of a neighbouring speed; ``fields``: True: solve on the patch's own grid; ``begun``: the
    starting time, by `time.perf_counter`.
    """
    if speed != 0 and (start is None or start.contact_load == 0):  # without film it is the dry contact that is solved
        foretell_ends(prepared, speed)
    if prepared.lines is not None:
        chosen, line = line_friction(prepared, speed, None if start is None else start.line)
        result = replace(_numbers(chosen, speed, line.point, line.together.ends, begun), line=line.start)
        uncertainty, errors = of_line(chosen.scene, line)
        change = line.by_half_cells
    else:
        balance = None if start is None else start.balance
        chosen, point = solved_as_deflected(prepared, speed, balance, given_grid=fields)
        areas = areas_on_own_cells(chosen, speed, point)
        ends = chosen.contact.on_the_ends(point.balance.contact)
        result = _numbers(chosen, speed, point, ends, begun)
        result = replace(result, **{name: value for name, (value, _) in areas.items()})  # type: ignore[arg-type]
        uncertainty, errors = of_patch(chosen, speed, point, areas)
        change = by_half_cells(chosen, speed, point)
    if speed != 0 and chosen.scene.numerics.film_level == "none":
        uncertainty = not_sampled(None, chosen.scene, chosen.surface.size[1], NO_FILM)
        errors = field_errors_of({}, NO_FILM)
    else:
        uncertainty = replace(uncertainty, model_form=_model_form(prepared.scene, result))
    tolerance = prepared.scene.numerics.tolerance
    cautions = (*too_coarse(change, tolerance), *of_error(uncertainty.numerical, tolerance, CLOSER))
    report = replace(result.report, notes=(*result.report.notes, *(c.text for c in cautions), uncertainty.text))
    validity = (*result.validity, *cautions)
    return replace(result, uncertainty=uncertainty, errors=errors, report=report, validity=validity)


def foretell_ends(prepared: Prepared, speed: float) -> None:
    """Raise `InputError` if the contact is sure to reach the ends of its patch at ``speed`` [m/s], not 0."""
    prepared.contact.foretell(prepared.scene.bodies, prepared.scene.line_contact(speed).moes_film)


def _model_form(scene: Scene, result: FrictionResult) -> float:
    """The error of the model; NaN except for a cylinder with a half-space contact, which is the case that was
    studied."""
    if scene.contact.geometry != "cylinder" or scene.contact.model != "half-space":
        return math.nan
    return load_sharing_error(result.film_to_roughness_ratio, result.contact_load / scene.bodies.load)


def _numbers(prepared: Prepared, speed: float, point: Solved, ends: float, begun: float) -> FrictionResult:
    """The numbers of ``point``, without their errors; ``ends``: as for `judged_validity`."""
    scene, balance = prepared.scene, point.balance
    contact, film, found = balance.contact, balance.film, balance.forces
    central = film.central_film if film is not None else math.nan
    separated = balance.contact_load == 0
    passed = judged_validity(prepared, speed, balance, ends)
    oil, temperature = scene.lubricant.oil, scene.lubricant.temperature
    known = () if oil is None or temperature is None else (estimate_in_words(oil, temperature),)
    notes = (*balance.report.notes, point.decision.text, *known, *(entry.text for entry in passed))
    sq = prepared.surface.sq
    return FrictionResult(
        speed=speed,
        coefficient=found.coefficient,
        contact_load=balance.contact_load,
        film_load=balance.film_load,
        shear_force=found.shear.total,
        couette_force=found.shear.couette,
        rolling_force=found.shear.rolling,
        boundary_force=found.boundary,
        real_contact_area_fraction=contact.real_contact_area_fraction,
        real_contact_area=float(contact.contact_fraction.sum() * (contact.x[1] - contact.x[0]) * scene.bodies.width),
        plastic_area_fraction=contact.plastic_area_fraction,
        min_film=film.min_film if film is not None else math.nan,
        central_film=central,
        mean_gap=contact.mean_film if separated else contact.mean_gap,
        film_to_roughness_ratio=central / sq if sq > 0 else math.inf,
        inlet_film_factor=found.heat.film_factor,
        flash_temperature_rise=found.heat.flash,
        film_temperature_rise=found.heat.film,
        load_residual=(balance.contact_load + balance.film_load - scene.bodies.load) / scene.bodies.load,
        volume_residual=0.0 if film is None or separated else contact.volume_residual,
        seconds=time.perf_counter() - begun,
        report=replace(balance.report, notes=notes),
        balance=balance,
        decision=point.decision,
        validity=passed,
    )
