"""What all kinds of curves have in common: solved points over one number, each of which may have failed."""

from __future__ import annotations

from typing import NamedTuple, TypeVar

import numpy as np

from .._base import Shown
from ..errors import CONVERGED, ITERATION_LIMIT, ConvergenceError, Report, ValidityError
from ..sampling import FrictionResult, together
from ..sharing import Validity, entries_of, gathered, in_a_cell

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


class Swept(NamedTuple):
    """The quantity of a curve: its symbol, its ``values`` (n,), their unit, and what several of them are called."""

    symbol: str
    values: np.ndarray
    unit: str
    plural: str


class CurveResult(Shown):
    """Base of the results of curves: ``points`` (None where failed), ``errors`` {index: exception}, ``report``."""

    points: tuple[FrictionResult | None, ...]
    errors: dict[int, Exception]
    report: Report

    @property
    def _swept(self) -> Swept:
        raise NotImplementedError

    def entries(self, index: int) -> tuple[Validity, ...]:
        """The assumptions that are violated at any of the points, refused or not."""
        return entries_of(self.points[index], self.errors.get(index))

    @property
    def told(self) -> list[str]:
        """The entries of each point in one cell of a table."""
        return [in_a_cell(self.entries(i)) for i in range(len(self.points))]

    @property
    def validity(self) -> tuple[str, ...]:
        """One sentence for each assumption that is violated somewhere."""
        _, values, unit, plural = self._swept
        return gathered([(float(v), self.entries(i)) for i, v in enumerate(values)], unit, plural)

    def cite(self) -> str:
        """The papers behind what was used at any of the points, one a line, the model's first."""
        return together(point for point in self.points if point is not None)

    def _facts(self) -> dict[str, str]:
        symbol, values, unit, plural = self._swept
        facts, good = {"": f"{values.size} {plural}"}, np.array([point is not None for point in self.points])
        if good.any():
            known, f = values[good], np.array([point.coefficient for point in self.points if point is not None])
            facts |= {symbol: f"{known.min():.4g} to {known.max():.4g} {unit}", "f": f"{f.min():.4g} to {f.max():.4g}"}
        return facts | {"failed": str(len(self.errors)), "cautions": str(len(self.validity))}


def columns_of(points) -> dict[str, np.ndarray]:
    """Every number of ``points`` by name, NaN where one is None."""
    return {name: np.array([np.nan if p is None else getattr(p, name) for p in points]) for name in QUANTITIES}


def report_of(solver: str, name: str, swept: Swept, points, errors: dict[int, Exception]) -> Report:
    """The largest residual of the points over the largest of their tolerances, with a note for each that failed."""
    worst = max((p.report.residual for p in points if p is not None), default=np.inf)
    tolerance = max((p.report.tolerance for p in points if p is not None), default=0.0)
    return Report(
        solver,
        ITERATION_LIMIT if errors else CONVERGED,
        swept.values.size - len(errors),
        float(worst),
        float(tolerance),
        notes=tuple(f"{name.format(swept.values[i])}: {error}" for i, error in sorted(errors.items())),
        advice=failed_points(swept.plural),
    )


def failed_points(plural: str) -> str:
    """A hint where to find the points that did not fail."""
    return f"the other {plural} are in .result, the reason of each failed one in its .errors"


R = TypeVar("R", bound=CurveResult)


def judged(result: R, raise_on_failure: bool) -> R:
    """``result``, or the exception that says what failed: `ValidityError` if all that failed was refused as invalid."""
    if not raise_on_failure:
        return result
    errors = result.errors
    refused = [error for error in errors.values() if isinstance(error, ValidityError)]
    if errors and len(refused) == len(errors):
        raise ValidityError("; ".join(result.validity), tuple(e for error in refused for e in error.entries), result)
    if errors:
        raise ConvergenceError(f"{result.report.message}; first: {errors[min(errors)]}", result.report, result)
    result.report.raise_if_failed(result)
    return result
