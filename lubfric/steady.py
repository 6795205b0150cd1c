"""The friction coefficient of one operating point: scene -> film -> contact -> balance -> friction."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace

from . import validate
from .deterministic import point as deterministic
from .deterministic.refine import Refined
from .errors import InputError
from .model import Model, at_tolerance
from .oil.describe import estimate_in_words
from .point.adapt import Solved, solved
from .point.balance import Balance
from .point.decision import Decision
from .point.judge import judged_validity
from .report import Report
from .scene import FASTEST, Scene
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
    deterministic: Refined | None = None

    @property
    def starts(self) -> bool:
        """A neighbouring speed can start from it: it has its fields, and a film."""
        return self.deterministic is not None or (self.balance is not None and self.balance.film is not None)

    def without_fields(self) -> FrictionResult:
        """Its numbers alone."""
        return replace(self, balance=None, deterministic=None)


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
    (docs/levels.md, ``result.decision``); ``model="full"``: everything, on the scene's own grid; ``"deterministic"``: no
    load is shared, one pressure carries it (docs/deterministic.md).
    ``start``: the result of a neighbouring speed of the same map, for a warm start.
    ``fields``: film and contact in ``result.balance`` are wanted on the scene's own contact grid.
    Stops when |mean gap - mean film|/(mean gap + mean film) over A <= numerics.volume_tolerance, divided by the share
    of the film in f. Raises `InputError` before any work, `ConvergenceError` with report and result when a part does
    not converge, `ValidityError` with the result where an assumption fails so badly that f means nothing and
    ``numerics.accept`` is false (``raise_on_failure=False`` returns either result, but a failed film or contact always raises).
    """
    begun = time.perf_counter()
    ready = at_tolerance(scene, tolerance, model)
    if speed is None:
        speed = ready.scene.motion.entrainment_speed
    speed = validate.number("speed", speed, "m/s", minimum=-FASTEST, maximum=FASTEST)
    if start is not None:
        validate.instance("start", start, FrictionResult, "what lubfric.friction returned, or None")
    if ready.scene.numerics.model == "deterministic" and speed != 0:
        found = deterministic.deterministic_point(
            ready.scene, ready.surface, speed, start.deterministic if start else None
        )
        result = _deterministic_result(ready, speed, found, begun)
    else:
        point = solved(ready, speed, start.balance if start else None, given_grid=fields)
        result = _result(ready, speed, point, begun)
    if not math.isfinite(result.coefficient):
        raise InputError(
            f"f = {result.coefficient} at a speed of {speed:g} m/s: numbers overflow; allowed: speeds, viscosities and stresses "
            "of a lubricated contact"
        )
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


def _deterministic_result(model: Model, speed: float, found: Refined, begun: float) -> FrictionResult:
    scene, result = model.scene, found.result
    bodies, width = scene.bodies, scene.bodies.width
    decision = Decision(
        film="deterministic",
        contact="asperity spots",
        tolerance=scene.numerics.tolerance,
        film_words=deterministic.words(found),
        forced=("grid",) if scene.numerics.grid == "given" else (),
        notes=deterministic.notes(found),
    )
    passed = deterministic.validity(model, speed, found)
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
    )
