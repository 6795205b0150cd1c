"""The report of a finite-element solve; nothing in this package comes from `lubfric`."""

import math
from dataclasses import dataclass
from typing import TypeVar

CONVERGED = "converged"
ITERATION_LIMIT = "iteration_limit"
STAGNATED = "stagnated"
DIVERGED = "diverged"
T = TypeVar("T")


class InputError(ValueError):
    """An input outside its allowed range, raised before any work."""


def require(fits: bool, message: str, allowed: str) -> None:  # noqa: FBT001 - a condition, as of an assertion
    """Raise `InputError` with the ``message`` and what is ``allowed``, where it does not fit."""
    if not fits:
        raise InputError(f"{message}; allowed: {allowed}")


class SolveError(RuntimeError):
    """A solve stopped short of its tolerance; carries its ``report`` and whatever ``result`` it had."""

    def __init__(self, message: str, report: "SolveReport | None" = None, result: object = None):
        super().__init__(message, report, result)
        self.report = report
        self.result = result

    def __str__(self) -> str:
        return self.args[0]


@dataclass(frozen=True, kw_only=True)
class SolveReport:
    """Outcome of an iterative solve, converged when ``residual`` (largest of ``residuals``) <= ``tolerance``.

    solver : name of the algorithm
    status : "converged", "iteration_limit", "stagnated" or "diverged"
    iterations : outer iterations taken
    tolerance : dimensionless, as the residuals
    residuals : final value of each measured residual by name
    history : largest residual after each iteration
    """

    solver: str
    status: str
    iterations: int
    tolerance: float
    residuals: dict[str, float]
    history: tuple[float, ...] = ()

    @property
    def residual(self) -> float:
        """The largest of the residuals; infinite where one is not a number."""
        return max((r if math.isfinite(r) else math.inf) for r in self.residuals.values())

    @property
    def converged(self) -> bool:
        """True when the residual met the tolerance."""
        return self.status == CONVERGED

    @property
    def message(self) -> str:
        """One line: what happened and how far it got."""
        return (
            f"{self.solver}: {self.status} after {self.iterations} iterations, "
            f"residual {self.residual:.2e} (tolerance {self.tolerance:.2e})"
        )

    def checked(self, result: T) -> T:
        """Return ``result``, if the solve converged; else `SolveError` with this report and the ``result``."""
        if not self.converged:
            raise SolveError(self.message, self, result)
        return result
