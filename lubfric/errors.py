"""What a solver says about its own work, and every exception that the library raises on purpose."""

import math
from dataclasses import KW_ONLY, asdict, dataclass, field
from typing import Any, NoReturn, TypeVar

T = TypeVar("T", bound=Any)  # a result with a report


class LubfricError(Exception):
    """Base class: catch this to catch everything that lubfric raises on purpose.

    ``hints`` say what the likely cause is, each in a sentence. They are added on the way up, and begin the message.
    ``asks``: whether one of them is a question, after which the message says what holds if the answer is no.
    """

    hints: tuple[str, ...] = ()
    asks: bool = False

    def hint(self, text: str, *, asks: bool = False) -> None:
        """Add a likely cause, a sentence, once; nothing if the text is empty. ``asks``: whether it is a question."""
        if text and text not in self.hints:
            self.hints += (text,)
            self.asks = self.asks or asks

    def __str__(self) -> str:
        return " ".join((*self.hints, *(["If not:"] if self.asks else []), self.worded()))

    def worded(self) -> str:
        """Return the message without the hints."""
        return str(self.args[0]) if self.args else ""


class InputError(LubfricError, ValueError):
    """An input is outside its allowed range; raised before any work starts, or where numbers overflow.

    The message names the quantity, the value, the allowed range and the unit. The error has these as attributes:
    ``quantity``, with which the message begins (``also``: others that it is about), ``allowed``, and
    ``recommendation``, which says what to do if there is no range.
    """

    def __init__(
        self, said: str, quantity: str = "", allowed: str = "", recommendation: str = "", also: tuple[str, ...] = ()
    ):
        super().__init__(said, quantity, allowed, recommendation, also)
        self.said = said
        self.quantity = quantity
        self.allowed = allowed
        self.recommendation = recommendation
        self.also = also

    @property
    def way_out(self) -> NoReturn:
        """Raise `AttributeError`: the attribute has another name today."""
        raise AttributeError("InputError.way_out is called InputError.recommendation now")

    def worded(self) -> str:
        allowed = self.allowed and f"; allowed: {self.allowed}"
        return f"{self.quantity}{self.said}{allowed}{self.recommendation and '; ' + self.recommendation}"


class TooManyCellsError(InputError):
    """A film between rough surfaces needs more cells than are solved; raised before it is solved."""


class OutputError(LubfricError, OSError):
    """A file could not be written or read: a full disk, a missing right, a folder that went away.

    The message names the file and what the operating system said. Files that were complete before stay.
    """


class ConvergenceError(LubfricError, RuntimeError):
    """A solver stopped before it reached the requested tolerance.

    ``report`` is the solver's `lubfric.Report`. ``result`` is what the solver had when it stopped (or ``None``), so
    that nothing computed is lost. Both survive pickling.
    """

    def __init__(self, message: str, report: Any = None, result: Any = None):
        super().__init__(message, report, result)
        self.message = message
        self.report = report
        self.result = result


class WorkLimitError(ConvergenceError):
    """A point, or a run, needs more counted work than ``numerics.max_work`` [s] allows.

    ``limit`` is that number; ``reached``: what was done until then, as text, and ``result``: the same. The work is
    counted from cells and steps, never by a clock.
    """

    def __init__(self, limit: float, report: Any = None, result: Any = None, reached: str = ""):
        message = f"the solve needs more work than numerics.max_work = {limit:.4g} s; raise it, or loosen tolerance"
        super().__init__(reached and f"{message}. {reached}" or message, report, result)
        self.args = (limit, report, result, reached)
        self.limit = limit
        self.reached = reached

    def worded(self) -> str:
        """Return the message without the hints."""
        return self.message


class TooCostlyError(ConvergenceError):
    """The first steps in time of a strip forecast more counted work than "auto" gives a point. A cheaper model answers
    then."""


class ValidityError(LubfricError, ValueError):
    """A converged solution is outside the range of the model, so that its coefficient is no answer.

    ``violations`` are the `lubfric.Violation`s that refuse it. ``result`` is the complete result (or ``None``), so
    that nothing computed is lost. With ``numerics.accept = true`` it is returned instead. The error survives pickling.
    """

    def __init__(self, message: str, violations: Any = (), result: Any = None):
        super().__init__(message, violations, result)
        self.message = message
        self.violations = violations
        self.result = result


CONVERGED = "converged"
ITERATION_LIMIT = "iteration_limit"
STAGNATED = "stagnated"
DIVERGED = "diverged"
WORK_LIMIT = "work_limit"
STOPPED = "interrupted"

ADVICE = {
    CONVERGED: "",
    ITERATION_LIMIT: "loosen the tolerance (of a scene: numerics.tolerance), or raise max_iterations where it is given",
    STAGNATED: "the residual stopped falling: loosen the tolerance or refine the grid",
    DIVERGED: "the iteration left the physical range: check the input, or start closer",
    WORK_LIMIT: "raise numerics.max_work, or loosen tolerance",
    STOPPED: "the same command continues from there",
}


def worst(residuals: dict[str, float]) -> float:
    """Return the largest of ``residuals``; infinite if one is no finite number."""
    return max(residuals.values()) if all(map(math.isfinite, residuals.values())) else math.inf


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
    status : one of "converged", "iteration_limit", "stagnated", "diverged", "work_limit",
        "interrupted"
    iterations : outer iterations taken
    residual, tolerance : dimensionless
    residuals : final value of each measured residual by name
    history : largest residual after each iteration
    evaluations : number of expensive kernels (convolutions, linear solves, inner solves)
    advice : what to do about it where the status alone does not say it; in ``message``
    summary : what happened, as text, where iterations and the largest residual do not say it; in ``message``
    notes : choices the solver made that a reader of the result should know
    """

    solver: str
    status: str
    _: KW_ONLY
    iterations: int
    residual: float
    tolerance: float
    residuals: dict[str, float] = field(default_factory=dict)
    history: tuple[float, ...] = ()
    evaluations: float = 0
    notes: tuple[str, ...] = ()
    advice: str = ""
    summary: str = ""

    def __post_init__(self) -> None:
        if self.converged:  # nothing is to be done
            object.__setattr__(self, "advice", "")

    @property
    def converged(self) -> bool:
        """True when the residual met the tolerance."""
        return self.status == CONVERGED

    @property
    def message(self) -> str:
        """One line: which solver, and its `outcome`."""
        return f"{self.solver}: {self.outcome}"

    @property
    def outcome(self) -> str:
        """What happened, how far it got, and what to do about it."""
        text = self.summary or (
            f"{self.status} after {self.iterations} iteration{'' if self.iterations == 1 else 's'}, "
            f"residual {self.residual:.2e} (tolerance {self.tolerance:.2e})"
        )
        advice = self.advice or ADVICE[self.status]
        return f"{text}; {advice}" if advice else text

    def raise_if_failed(self, result: Any = None) -> None:
        """Raise `ConvergenceError` carrying this report (and ``result``) unless it converged."""
        if not self.converged:
            raise ConvergenceError(self.message, self, result)

    def as_dict(self) -> dict[str, Any]:
        """Return the report in plain types alone, ready for JSON."""
        return asdict(self) | {"converged": self.converged}


def returned(result: T, *, raise_on_failure: bool = True) -> T:
    """Return ``result``, which has a ``report``; where that failed, and an exception is requested, raise the
    `ConvergenceError` that carries both."""
    if raise_on_failure:
        result.report.raise_if_failed(result)
    return result
