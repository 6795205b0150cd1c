"""A Stribeck curve: `StribeckResult`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .. import validate
from ..curve.interpolate import Interpolant, knee_of
from ..errors import InputError
from ..report import CONVERGED, ITERATION_LIMIT, Report
from ..result import FrictionResult
from ..sampling.uncertainty import FIELDS, UncertaintyCurve, curve_of
from ..show import Shown
from ..show.cite import together
from ..studies.adaptive import FEWEST, samples_of
from ..validity.entry import Validity
from ..validity.gather import entries_of, gathered

FAILED_SPEEDS = "the other speeds are in .result, the reason of each failed one in its .errors"
NOT_NUMBERS = (
    "report",
    "balance",
    "decision",
    "validity",
    "deterministic",
    "one_way",
    "uncertainty",
    "errors",
    "methods",
    "line",
)
QUANTITIES = tuple(f for f in FrictionResult.__dataclass_fields__ if f not in NOT_NUMBERS)


@dataclass(frozen=True, repr=False)
class StribeckResult(Shown):
    """Arrays over the speeds, in the order asked for; NaN where a point failed.

    Every number of `FrictionResult` is an array attribute of the same name and unit. One line of the surface serves all
    speeds, so their errors go up and down together.

    Attributes
    ----------
    speed : entrainment speeds [m/s], (n,)
    coefficient : friction coefficients [-], (n,)
    points : the results themselves (None where failed)
    errors : {index: the exception raised there}. The `ValidityError` of a point outside the range of the model carries
        the point's result
    validity : the assumptions that do not hold, gathered over the speeds
    uncertainty : arrays of the numbers of `Uncertainty`; ``interval`` is (n, 2)
    field_errors : {quantity: its relative errors, (n,)}
    report : whether all speeds were solved
    """

    speed: np.ndarray
    coefficient: np.ndarray
    contact_load: np.ndarray
    film_load: np.ndarray
    shear_force: np.ndarray
    couette_force: np.ndarray
    rolling_force: np.ndarray
    boundary_force: np.ndarray
    real_contact_area_fraction: np.ndarray
    real_contact_area: np.ndarray
    plastic_area_fraction: np.ndarray
    min_film: np.ndarray
    central_film: np.ndarray
    mean_gap: np.ndarray
    film_to_roughness_ratio: np.ndarray
    inlet_film_factor: np.ndarray
    flash_temperature_rise: np.ndarray
    film_temperature_rise: np.ndarray
    load_residual: np.ndarray
    volume_residual: np.ndarray
    seconds: np.ndarray
    points: tuple[FrictionResult | None, ...]
    errors: dict[int, Exception]
    report: Report
    uncertainty: UncertaintyCurve
    field_errors: dict[str, np.ndarray]

    def entries(self, index: int) -> tuple[Validity, ...]:
        """Assumptions that do not hold at a speed, refused or not."""
        return entries_of(self.points[index], self.errors.get(index))

    def at(self, speed) -> np.ndarray:
        """f at any speeds [m/s] between the slowest and the fastest, interpolated (`lubfric.curve.interpolate`)."""
        contact, film = self.parts_at(speed)
        return contact + film

    def parts_at(self, speed) -> tuple[np.ndarray, np.ndarray]:
        """(from the contact spots, from the film): the two parts of f at any speeds [m/s], as `at`."""
        curve = self._interpolant
        known = curve.samples.speed
        at = np.abs(validate.array("speed", np.atleast_1d(speed), "m/s", ndim=1))
        if at.min() < known[0] * (1 - 1e-9) or at.max() > known[-1] * (1 + 1e-9):
            raise InputError(
                f"speed = {speed!r} m/s; allowed: {known[0]:g} to {known[-1]:g} m/s, where the curve is known"
            )
        return curve.boundary(at).reshape(np.shape(speed)), curve.film(at).reshape(np.shape(speed))

    @property
    def lift_off(self) -> float | None:
        """The speed [m/s] at which the film lifts the surfaces off each other; None where the curve does not reach
        it."""
        return self._interpolant.lift_off

    @cached_property
    def _interpolant(self) -> Interpolant:
        points = [p for p in self.points if p is not None and p.speed != 0]
        if len(points) < FEWEST or len({abs(p.speed) for p in points}) < len(points):
            raise InputError(
                f"{len(points)} speeds are solved; allowed for a curve between them: {FEWEST} different ones"
            )
        samples = samples_of(points)
        return Interpolant(samples, knee_of(samples))

    def plot(self, ax=None, **style):
        """Friction over speed, with its parts, on ``ax`` or new axes, which are returned; ``style``: of the line."""
        from ..show.axes import curve_axes

        return curve_axes(self, ax, **style)

    def cite(self) -> str:
        """The papers behind what was used at any of the speeds, one a line, the model's first."""
        return together(point for point in self.points if point is not None)

    def _facts(self) -> dict[str, str]:
        facts = {"": f"{self.speed.size} speeds"}
        if self.speed.size > len(self.errors):
            good = np.isfinite(self.coefficient)
            facts |= {
                "U": f"{self.speed[good].min():.4g} to {self.speed[good].max():.4g} m/s",
                "f": f"{self.coefficient[good].min():.4g} to {self.coefficient[good].max():.4g}",
            }
        facts["failed"] = str(len(self.errors))
        facts["not held"] = str(len(self.validity))
        return facts

    @property
    def validity(self) -> tuple[str, ...]:
        """One sentence for each assumption that does not hold somewhere."""
        return gathered([(float(u), self.entries(i)) for i, u in enumerate(self.speed)])


def collected(speeds, points, errors) -> StribeckResult:
    """The curve of ``points`` (None where failed) and ``errors`` {index: exception} at ``speeds`` [m/s]."""
    columns = {name: np.array([np.nan if p is None else getattr(p, name) for p in points]) for name in QUANTITIES}
    columns["speed"] = speeds
    worst = max((p.report.residual for p in points if p is not None), default=np.inf)
    tolerance = max((p.report.tolerance for p in points if p is not None), default=0.0)
    status = ITERATION_LIMIT if errors else CONVERGED
    notes = tuple(f"speed {speeds[i]:g} m/s: {error}" for i, error in sorted(errors.items()))
    report = Report(
        "stribeck", status, speeds.size - len(errors), float(worst), float(tolerance), notes=notes, advice=FAILED_SPEEDS
    )
    return StribeckResult(
        **columns,
        points=tuple(points),
        errors=errors,
        report=report,
        uncertainty=curve_of([None if p is None else p.uncertainty for p in points]),
        field_errors=_field_errors(points),
    )


def _field_errors(points) -> dict[str, np.ndarray]:
    """Relative errors by quantity, NaN where a point failed."""
    return {name: np.array([np.nan if p is None else getattr(p.errors, name) for p in points]) for name in FIELDS}
