"""The friction coefficient of one operating point: scene -> film -> contact -> balance -> friction."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace

from . import validate
from .model import Model, at_tolerance
from .oil.describe import estimate_in_words
from .point.adapt import Solved, solved
from .point.balance import Balance
from .point.decision import Decision
from .point.judge import judged_validity
from .report import Report
from .scene import Scene
from .validity.entry import Validity, refused


@dataclass(frozen=True)
class FrictionResult:
    """One operating point. Forces in N, lengths in m, speed in m/s, fractions of the area A.

    coefficient: (f_b F_C + F_sh)/F_T (paper, Eq. 9); min_film, central_film: of the smooth film that
    carries F_H (NaN without entrainment); mean_gap: between the rough surfaces (the film when they are separated);
    film_to_roughness_ratio: central_film/Sq; real_contact_area [m^2]: of the whole line. inlet_film_factor: on the film, by the
    heat of the inlet; flash_temperature_rise, film_temperature_rise [K]: largest, of the surfaces and (mean across) of the film above
    them (1, 0, 0 where heat is left out). The residuals are relative: load
    (F_C + F_H - F_T)/F_T and volume (gap - film)/(gap + film). ``balance`` holds the fields: the film
    (``balance.film``, an `EHLResult` or `RigidFilm`) and, for a cylinder in contact, the dry contact
    (``balance.contact.fields``, a `ContactResult`). ``decision``: how much was modelled, and the numbers it was judged by
    (``decision.text`` in words); ``validity``: the assumptions that do not hold
    (`lubfric.Validity`); a severe one is there only where it was accepted.
    """

    speed: float
    coefficient: float
    contact_load: float
    film_load: float
    shear_force: float
    couette_force: float
    rolling_force: float
    boundary_force: float
    real_contact_area_fraction: float
    real_contact_area: float
    plastic_area_fraction: float
    min_film: float
    central_film: float
    mean_gap: float
    film_to_roughness_ratio: float
    inlet_film_factor: float
    flash_temperature_rise: float
    film_temperature_rise: float
    load_residual: float
    volume_residual: float
    seconds: float
    report: Report
    balance: Balance | None = None
    decision: Decision | None = None
    validity: tuple[Validity, ...] = ()


def friction(
    scene: Scene | Model,
    speed: float | None = None,
    *,
    start: FrictionResult | None = None,
    tolerance: float | None = None,
    model: str | None = None,
    fields: bool = False,
    raise_on_failure: bool = True,
) -> FrictionResult:
    """Friction coefficient of ``scene`` at an entrainment speed [m/s] (default: the scene's own).

    The film and the rough contact share the load so that F_T = F_C + F_H and the lubricant volume
    of Eq. (8) hold together (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z). Without
    entrainment the contact carries everything; when the film clears the summits no contact is solved.

    ``tolerance``: on the coefficient, relative, instead of ``numerics.tolerance``. No more is modelled than it needs
    (docs/levels.md, ``result.decision``); ``model="full"``: everything, on the scene's own grid.
    ``start``: the result of a neighbouring speed of the same map, for a warm start.
    ``fields``: film and contact in ``result.balance`` are wanted on the scene's own contact grid.
    Stops when |mean gap - mean film|/(mean gap + mean film) over A <= numerics.volume_tolerance, divided by the share
    of the film in f. Raises `InputError` before any work, `ConvergenceError` with report and result when a part does
    not converge, `ValidityError` with the result where an assumption fails so badly that f means nothing and
    ``numerics.accept`` is false (``raise_on_failure=False`` returns either result, but a failed film or contact always raises).
    """
    begun = time.perf_counter()
    ready = at_tolerance(scene, tolerance, model)
    speed = ready.scene.motion.entrainment_speed if speed is None else validate.number("speed", speed, "m/s")
    result = _result(ready, speed, solved(ready, speed, start.balance if start else None, given_grid=fields), begun)
    if raise_on_failure:
        result.report.raise_if_failed(result)
        refused(result.validity, ready.scene.numerics.accept, result)
    return result


def _result(model: Model, speed: float, point: Solved, begun: float) -> FrictionResult:
    scene, balance, found = model.scene, point.balance, point.forces
    contact, film = balance.contact, balance.film
    central = film.central_film if film is not None else math.nan
    separated = balance.contact_load == 0
    passed = judged_validity(model, speed, balance, found)
    oil = scene.lubricant.oil
    known = (estimate_in_words(oil, scene.lubricant.temperature),) if oil else ()
    notes = (*balance.report.notes, point.decision.text, *known, *(entry.text for entry in passed))
    sq = model.surface.sq
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
