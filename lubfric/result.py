"""What one operating point gives: `FrictionResult`."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from .deterministic.refine import Refined
from .one_way.point import OneWay
from .point.balance import Balance
from .point.decision import Decision
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
