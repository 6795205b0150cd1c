"""Solved points over one number, each of which may have failed: what Stribeck and traction curves have in common, and
their tables."""

from collections.abc import Sequence
from typing import Any, ClassVar, TypeVar

import numpy as np

from .._base import Renamed, Shown, table_bytes, validate
from ..errors import CONVERGED, ITERATION_LIMIT, ConvergenceError, Report, ValidityError, returned
from ..estimate import (
    UNCERTAINTY_COLUMNS,
    FrictionResult,
    UncertaintyCurve,
    cite_together,
    curve_of,
    row_of_uncertainty,
    span_to_quote,
)
from ..models.shared import GatheredTexts, Violation, gathered_on_curve, in_a_cell, violations_of
from ..quantities import COLUMN_OF_ERROR, NUMBERS, counted, heading


class CurveResult(Renamed, Shown):
    """Base of the results of curves: ``points`` (None where failed), ``errors`` {index: exception}, ``report``.
    ``result["contact_load"]`` is an array of that number of all points, NaN where one failed.

    A subclass has the quantity of the curve as ``SWEPT``: the name of its attribute, its symbol, its unit, and what
    several of its values are called.
    """

    SWEPT: ClassVar[tuple[str, str, str, str]]
    points: tuple[FrictionResult | None, ...]
    errors: dict[int, Exception]
    report: Report
    _RENAMED = {"entries": "violations", "told": "validity_cells"}

    def __getitem__(self, name: str) -> np.ndarray:
        return columns_of(self.points)[validate.choice("column", name, NUMBERS)]

    @property
    def slide_roll_ratios(self) -> np.ndarray:
        """The slide-roll ratio of every point [-], (n,); of a subclass."""
        raise NotImplementedError

    @property
    def without_rolling(self) -> np.ndarray:
        """f at every point as the mean of both surfaces [-], without rolling resistance, as the mean over both signs
        of slip; NaN where a point failed."""
        pairs = zip(self.points, self.slide_roll_ratios)
        return np.array([np.nan if point is None else without_rolling(point, ratio) for point, ratio in pairs])

    @property
    def uncertainty(self) -> UncertaintyCurve:
        """The uncertainty of f at every point: arrays of the numbers of `Uncertainty`, ``interval`` (n, 2)."""
        return curve_of([None if point is None else point.uncertainty for point in self.points])

    @property
    def power_loss_interval(self) -> np.ndarray:
        """95 % interval of the power loss at every point [W], (n, 2); NaN where a point failed."""
        missing = (np.nan, np.nan)
        rows = [missing if point is None else point.power_loss_interval for point in self.points]
        return np.array(rows).reshape(-1, 2)

    @property
    def total_seconds(self) -> float:
        """Wall-clock time of all points together [s], each as it was solved, also by an earlier call."""
        return float(np.nansum(self["seconds"]))

    def violations(self, index: int) -> tuple[Violation, ...]:
        """Return the assumptions that are violated at a point, refused or not."""
        return violations_of(self.points[index], self.errors.get(index))

    @property
    def validity_cells(self) -> list[str]:
        """The violations of each point in one cell of a table."""
        return [in_a_cell(self.violations(i)) for i in range(len(self.points))]

    @property
    def validity(self) -> tuple[str, ...]:
        """One text for each assumption that is violated somewhere, which begins with where."""
        return tuple(each.text_with_head for each in self.gathered)

    @property
    def gathered(self) -> tuple[GatheredTexts, ...]:
        """The violations of all points, in one record for each assumption."""
        name, _, unit, plural = self.SWEPT
        values = getattr(self, name).tolist()
        return gathered_on_curve([(value, self.violations(i)) for i, value in enumerate(values)], unit, plural)

    def cite(self, format: str = "text") -> str:
        """Return the publications of the methods used at any of the points, the model's first: one a line, or with
        ``format`` "bibtex" as BibTeX entries, or "methods" as a paragraph (`FrictionResult.cite`)."""
        (name, _, unit, plural) = self.SWEPT
        swept = [value for value, point in zip(getattr(self, name).tolist(), self.points) if point is not None]
        is_speed = name == "speed"  # each point states its own
        inputs = [span_to_quote(f"{len(swept)} {plural}", swept, unit or "-")] if swept and not is_speed else []
        return cite_together((point for point in self.points if point is not None), format, inputs)

    def _facts(self) -> dict[str, str]:
        name, symbol, unit, plural = self.SWEPT
        facts = {"": counted(len(self.points), plural)}
        good = np.isfinite(self["coefficient"])
        if good.any():
            known = getattr(self, name)[good]
            f = self["coefficient"][good]
            facts |= {
                symbol: f"{known.min():.4g} to {known.max():.4g} {unit}".rstrip(),
                "f": f"{f.min():.4g} to {f.max():.4g}",
            }
        warnings = [each for each in self.gathered if not each.is_note]
        return facts | {"failed": str(len(self.errors)), "warnings": str(len(warnings))}


def parted(outcomes: Sequence[Any]) -> tuple[tuple[FrictionResult | None, ...], dict[int, Exception]]:
    """Return the points (None for what is no result), and the errors by index, of results, exceptions, or None."""
    points = tuple(outcome if isinstance(outcome, FrictionResult) else None for outcome in outcomes)
    return points, {i: outcome for i, outcome in enumerate(outcomes) if isinstance(outcome, Exception)}


def without_rolling(point: FrictionResult, slide_roll_ratio: float) -> float:
    """Return the mean of the friction coefficients of both surfaces at a point [-], each against its own sliding.

    Shear by sliding acts on both alike, and rolling resistance R opposes the motion of both: f is that of surface 2,
    and that of surface 1 is f - R/F_T at a positive slide-roll ratio, f + R/F_T at a negative one. Between smooth
    surfaces it is the mean of f over both signs of slip. In pure rolling f is against the entrainment.
    """
    sense = -1.0 if slide_roll_ratio < 0 else 1.0
    return point.coefficient - sense * 0.5 * point.rolling_resistance / (point.contact_load + point.film_load)


def columns_of(points: Sequence[Any]) -> dict[str, np.ndarray]:
    """Return every number of ``points`` by name, NaN where one is None."""
    return {name: np.array([np.nan if p is None else getattr(p, name) for p in points]) for name in NUMBERS}


def points_of_interpolation(points: Sequence[Any]) -> dict[str, np.ndarray]:
    """Return `columns_of` with the column of the numerical error of f, of which `lubfric.studies.interpolate` makes a
    curve."""
    numerical = [np.nan if p is None else p.uncertainty.numerical for p in points]
    return columns_of(points) | {COLUMN_OF_ERROR["numerical"]: np.array(numerical)}


def report_of(
    solver: str, names: list[str], plural: str, points: Sequence[Any], errors: dict[int, Exception]
) -> Report:
    """Return the largest residual of the points over the largest of their tolerances, with a note for each that failed;
    ``names`` of the points."""
    status = ITERATION_LIMIT if errors else CONVERGED
    reports = [p.report for p in points if p is not None]
    residual = float(max((report.residual for report in reports), default=np.inf))
    tolerance = float(max((report.tolerance for report in reports), default=0.0))
    notes = tuple(f"{names[i]}: {error}" for i, error in sorted(errors.items()))
    advice = f"the other {plural} are in .result, the reason of each failed one in its .errors"
    return Report(
        solver,
        status,
        iterations=len(points) - len(errors),
        residual=residual,
        tolerance=tolerance,
        notes=notes,
        advice=advice,
    )


R = TypeVar("R", bound=CurveResult)


def checked_curve(result: R, *, raise_on_failure: bool) -> R:
    """Return ``result``, or the exception that says what failed: `ValidityError` if all that failed was refused as
    invalid."""
    if not raise_on_failure:
        return result
    errors = result.errors
    refused = [error for error in errors.values() if isinstance(error, ValidityError)]
    if errors and len(refused) == len(errors):
        raise ValidityError("; ".join(result.validity), tuple(e for error in refused for e in error.violations), result)
    if errors:
        raise ConvergenceError(f"{result.report.message}; first: {errors[min(errors)]}", result.report, result)
    return returned(result)


def columns_of_curve(curve: CurveResult) -> dict[str, np.ndarray]:
    """Return the columns of numbers of a curve by name: its quantities, then the uncertainty of f."""
    swept = {curve.SWEPT[0]: getattr(curve, curve.SWEPT[0])}
    rows = [{} if point is None else row_of_uncertainty(point.uncertainty) for point in curve.points]
    columns = swept | columns_of(curve.points) | swept
    columns |= {name: np.array([row.get(name, np.nan) for row in rows]) for name in UNCERTAINTY_COLUMNS}
    return columns | dict(zip(("power_loss_low", "power_loss_high"), curve.power_loss_interval.T))


def models_of_points(curve: CurveResult) -> np.ndarray:
    """Return the name of the model that answered at each point of a curve; "" where none did."""
    return np.array(["" if point is None else point.decision.model for point in curve.points], str)


def csv_bytes(curve: CurveResult) -> bytes:
    """Return the table of a curve: one row a point, one column a quantity, the unit in the heading; then as text the
    model that answered, which assumptions are violated there, and the uncertainty of f. Its bytes follow from the
    inputs: it has no times."""
    columns = columns_of_curve(curve)
    named: dict[str, Any] = {heading(name): values for name, values in columns.items() if name != "seconds"}
    texts: dict[str, Any] = {
        "model": models_of_points(curve),
        "validity": curve.validity_cells,
        "uncertainty": list(curve.uncertainty.text),
    }
    return table_bytes(named | texts)
