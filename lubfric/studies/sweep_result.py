"""A Stribeck curve: `StribeckResult`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .._base import validate
from ..errors import InputError, Report
from ..sampling import FIELDS, FrictionResult, UncertaintyCurve, curve_of
from .adaptive import FEWEST, samples_of
from .interpolate import Interpolant, knee_of
from .sweep_points import CurveResult, Swept, columns_of, report_of


@dataclass(frozen=True, repr=False)
class StribeckResult(CurveResult):
    """Arrays over the speeds, in the order asked for; NaN where a point failed.

    Every number of `FrictionResult` is an array attribute of the same name and unit. All speeds use the same line of
    the surface, so their errors go up and down together.

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

    @property
    def _swept(self) -> Swept:
        return _over(self.speed)

    def at(self, speed) -> np.ndarray:
        """f at any speeds [m/s] between the slowest and the fastest, interpolated (`lubfric.studies.interpolate`). They
        have the direction of the curve: a finite piece of a surface slides differently back and forth."""
        contact, film = self.parts_at(speed)
        return contact + film

    def parts_at(self, speed) -> tuple[np.ndarray, np.ndarray]:
        """(from the contact spots, from the film): the two parts of f at any speeds [m/s], as `at`."""
        curve = self._interpolant
        known = curve.samples.speed
        sense = self._sense
        at = sense * validate.array("speed", validate.listed(speed), "m/s", ndim=1)
        if at.min() < known[0] * (1 - 1e-9) or at.max() > known[-1] * (1 + 1e-9):
            low, high = sorted((sense * known[0], sense * known[-1]))
            raise InputError(f"speed = {speed!r} m/s; allowed: {low:g} to {high:g} m/s, where the curve is known")
        return curve.boundary(at).reshape(np.shape(speed)), curve.film(at).reshape(np.shape(speed))

    @property
    def lift_off(self) -> float | None:
        """The speed [m/s], in the direction of the curve, at which the film lifts the surfaces off each other; None if
        the curve does not reach it."""
        found = self._interpolant.lift_off
        return None if found is None else self._sense * found

    @property
    def _sense(self) -> float:
        """The sign of the speeds."""
        return 1.0 if (self.speed > 0).any() else -1.0

    @cached_property
    def _interpolant(self) -> Interpolant:
        points = [p for p in self.points if p is not None and p.speed != 0]
        if (self.speed > 0).any() and (self.speed < 0).any():
            raise InputError("speeds run both ways; a curve between them has those of one direction: solve two curves")
        if len(points) < FEWEST or len({abs(p.speed) for p in points}) < len(points):
            raise InputError(f"{len(points)} speeds are solved; a curve between them needs {FEWEST} different ones")
        samples = samples_of(points)
        return Interpolant(samples, knee_of(samples))

    def plot(self, ax=None, **style):
        """Friction over speed, with its parts, on ``ax`` or new axes, which are returned; ``style``: of the line."""
        from .._base import curve_axes

        return curve_axes(self, ax, **style)

    def to_csv(self, path) -> None:
        """The table that ``lubfric run`` writes as stribeck.csv: one row a speed, the unit in the heading."""
        from .._base import write_whole
        from .sweep_table import csv_bytes

        write_whole(path, csv_bytes(self))


def collected(speeds, points, errors) -> StribeckResult:
    """The curve of ``points`` (None where failed) and ``errors`` {index: exception} at ``speeds`` [m/s]."""
    report = report_of("stribeck", "speed {:g} m/s", _over(speeds), points, errors)
    return StribeckResult(
        **columns_of(points) | {"speed": speeds},
        points=tuple(points),
        errors=errors,
        report=report,
        uncertainty=curve_of([None if p is None else p.uncertainty for p in points]),
        field_errors={n: np.array([np.nan if p is None else getattr(p.errors, n) for p in points]) for n in FIELDS},
    )


def _over(speeds: np.ndarray) -> Swept:
    return Swept("U", speeds, "m/s", "speeds")
