"""What a solver says about its own work: status, residuals, tolerance, history."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field

from .errors import ConvergenceError

CONVERGED = "converged"
ITERATION_LIMIT = "iteration_limit"
STAGNATED = "stagnated"
DIVERGED = "diverged"

ADVICE = {
    CONVERGED: "",
    ITERATION_LIMIT: "loosen the tolerance (of a scene: numerics.tolerance), or raise max_iterations where it is given",
    STAGNATED: "the residual stopped falling: loosen the tolerance or refine the grid",
    DIVERGED: "the iteration left the physical range: check the input, or start closer",
}


@dataclass(frozen=True)
class Report:
    """The outcome of an iterative solve.

    ``residual`` is the largest of ``residuals``; the solve converged when it is <= ``tolerance``.
    Each residual is dimensionless and measures something a user cares about (complementarity,
    penetration, load, volume, mass), never the size of a step. What each means is written in the
    docstring of the solver that made the report.

    Attributes
    ----------
    solver : name of the algorithm that produced the result
    status : one of "converged", "iteration_limit", "stagnated", "diverged"
    iterations : outer iterations taken
    residual, tolerance : dimensionless
    residuals : final value of each measured residual by name
    history : largest residual after each iteration
    evaluations : number of expensive kernels (convolutions, linear solves, inner solves)
    advice : what to do about it where the status alone does not tell; in ``message``
    notes : choices the solver made that a reader of the result should know
    """

    solver: str
    status: str
    iterations: int
    residual: float
    tolerance: float
    residuals: dict[str, float] = field(default_factory=dict)
    history: tuple[float, ...] = ()
    evaluations: float = 0
    notes: tuple[str, ...] = ()
    advice: str = ""

    @property
    def converged(self) -> bool:
        """True when the residual met the tolerance."""
        return self.status == CONVERGED

    @property
    def message(self) -> str:
        """One line: what happened, how far it got, and what to do about it."""
        text = (
            f"{self.solver}: {self.status} after {self.iterations} iterations, "
            f"residual {self.residual:.2e} (tolerance {self.tolerance:.2e})"
        )
        advice = "" if self.converged else self.advice or ADVICE[self.status]
        return f"{text}; {advice}" if advice else text

    def raise_if_failed(self, result=None) -> None:
        """Raise `ConvergenceError` carrying this report (and ``result``) unless it converged."""
        if not self.converged:
            raise ConvergenceError(self.message, self, result)

    def as_dict(self) -> dict:
        """Plain types only, ready for JSON."""
        return asdict(self) | {"converged": self.converged}
