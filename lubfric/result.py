"""What one operating point gives: `FrictionResult`."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field, replace

from .deterministic.refine import Refined
from .model import Model
from .oil.describe import estimate_in_words
from .one_way.point import OneWay
from .point.adapt import Solved
from .point.balance import Balance
from .point.decision import Decision
from .point.judge import judged_validity
from .report import Report
from .sampling.line_friction import LineStart
from .sampling.uncertainty import FieldErrors, Uncertainty
from .show.point import PointShown
from .validity.entry import Validity


@dataclass(frozen=True, repr=False)
class FrictionResult(PointShown):
    """One operating point. Forces in N, lengths in m, speed in m/s, fractions of the area A.

    coefficient: (f_b F_C + F_sh)/F_T (paper, Eq. 9); min_film, central_film: of the smooth film that
    carries F_H (NaN without entrainment); mean_gap: between the rough surfaces (the film when they are separated);
    film_to_roughness_ratio: central_film/Sq; real_contact_area [m^2]: of the whole line. inlet_film_factor: on the
    film, by the heat of the inlet; flash_temperature_rise, film_temperature_rise [K]: largest, of the surfaces and
    (mean across) of the film above them (1, 0, 0 where heat is left out). The residuals are relative: load
    (F_C + F_H - F_T)/F_T and volume (gap - film)/(gap + film). ``balance`` holds the fields: the film
    (``balance.film``, an `EHLResult` or `RigidFilm`) and, for a cylinder in contact, the dry contact
    (``balance.contact.fields``, a `ContactResult`). ``decision``: how much was modelled, and the numbers it was judged
    by (``decision.text`` in words); ``validity``: the assumptions that do not hold
    (`lubfric.Validity`); a severe one is there only where it was accepted.

    ``uncertainty``: of the coefficient, from solvers and grids and because a finite surface stands for all of it (an
    `Uncertainty`: docs/uncertainty.md); ``errors``: relative, of every other number (`FieldErrors`), as
    ``errors.contact_load``. ``line``: what the long line of a scene leaves for a neighbouring speed to start from;
    ``balance`` then has the fields of its first 180 correlation lengths, and forces and areas are those of all of it.
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
    one_way: tuple[OneWay, ...] = ()
    uncertainty: Uncertainty = Uncertainty()
    errors: FieldErrors = FieldErrors()
    line: LineStart | None = field(default=None, repr=False)

    @property
    def starts(self) -> bool:
        """A neighbouring speed can start from it: it has its fields, and a film."""
        whole = self.deterministic is not None or bool(self.one_way)
        return whole or (self.balance is not None and self.balance.film is not None)

    def without_fields(self) -> FrictionResult:
        """Its numbers alone."""
        return replace(self, balance=None, deterministic=None, one_way=(), line=None)


def result_of(model: Model, speed: float, point: Solved, begun: float) -> FrictionResult:
    """The numbers of ``point``; ``begun``: when its solve did, by `time.perf_counter`."""
    scene, balance = model.scene, point.balance
    contact, film, found = balance.contact, balance.film, balance.forces
    central = film.central_film if film is not None else math.nan
    separated = balance.contact_load == 0
    passed = judged_validity(model, speed, balance)
    oil, temperature = scene.lubricant.oil, scene.lubricant.temperature
    known = () if oil is None or temperature is None else (estimate_in_words(oil, temperature),)
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
