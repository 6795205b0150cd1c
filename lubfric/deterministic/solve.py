"""One deterministic operating point on one grid: Newton's method, and other ways if it fails."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace

from ..errors import CONVERGED, DIVERGED, ITERATION_LIMIT, Report
from .march import march
from .newton import Found, newton
from .problem import Problem
from .result import DeterministicResult, assemble
from .start import dry_contact, dry_start
from .state import State

TOLERANCE = 1e-5
FROM_NEIGHBOUR, DIRECT, MARCHED = 40, 50, 500  # LU factorisations: from a state nearby, from the dry contact, in time
MOST = 800  # of all ways together, unless it is said
FASTER = (16.0, 256.0)  # times the speed: where a cold start is tried when it fails at the speed itself
LOOSE = 1e-3  # tolerance of solutions on the way
LONGER, SHORTEST = 1.5, 0.05  # what a step in ln(speed) grows by, and the least one
ADVICE = "longer cells, or a sweep of nearer speeds from a faster one, may lead there"
THIN_STRESS, THIN_OFFSET = 0.09, 2e6  # limiting stress over the pressure, and at ambient [Pa], of the fluid that starts
# a Newtonian


@dataclass(frozen=True)
class Start:
    """A ``state`` to begin from, made when it is needed, and the ``speed`` [m/s] to which it belongs."""

    state: Callable[[], State]
    speed: float


def solve_point(
    problem: Problem, *, starts: Iterable[Start] = (), tolerance=TOLERANCE, most=MOST, raise_on_failure=True
) -> DeterministicResult:
    """Gap, pressure and friction of ``problem`` on its own grid.

    Tried in turn until one converges:

    - Newton's method from each of ``starts`` (`lubfric.deterministic.transfer`), directly and through speeds in
      between;
    - from the dry contact, lifted by Moes' film;
    - for a Newtonian lubricant, from the solution with a limiting shear stress;
    - from the state that implicit steps in time reach from the first of ``starts``;
    - from higher speeds, step by step;
    - without ``starts``, from the state that implicit steps in time reach from the dry contact.

    Together they take at most ``most`` factorisations. ``report.notes`` says which one it was. Converged when the
    largest of `lubfric.deterministic.state.residuals` is <= tolerance. Raises `ConvergenceError` with report and
    result.
    """
    work = Work(most)
    tried: list[tuple[str, Found]] = []
    for attempt in _attempts(problem, starts, tolerance, work):
        tried.append(attempt)
        if attempt[1].residual <= tolerance:
            break
    name, found = min(tried, key=lambda one: one[1].residual if one[1].residual >= 0 else math.inf)
    report = _report(found, tolerance, work, name)
    if not report.converged:
        ways = ", ".join(f"{way} ({at.residual:.1e})" for way, at in tried)
        spent = f"{work.factorisations} of {most} factorisations"
        report = replace(report, advice=f"tried in {spent}, with the residual left: {ways}; {ADVICE}")
    result = assemble(problem, found.look, report)
    if raise_on_failure:
        report.raise_if_failed(result)
    return result


@dataclass
class Work:
    """The cost of the attempts at one point: LU factorisations, at ``most`` so many, GMRES iterations, steps in time;
    and their residuals."""

    most: int = MOST
    factorisations: int = 0
    krylov: int = 0
    steps: int = 0
    history: list[float] = field(default_factory=list)

    @property
    def left(self) -> int:
        """Factorisations that may still be done."""
        return max(self.most - self.factorisations, 0)

    def direct(self, problem, state, tolerance, most=DIRECT) -> Found:
        """`newton`, counted."""
        found = newton(problem, state, tolerance=tolerance, most=min(most, self.left))
        self.factorisations += found.factorisations
        self.krylov += found.krylov
        self.history += found.history
        return found

    def walk(self, problem, state, speed, tolerance) -> Found:
        """From a solution at ``speed`` [m/s] on the same grid to ``problem``, through speeds in between."""
        whole = math.log(speed / problem.speed)
        left, step = whole, whole / 2
        while True:
            to = left - step if abs(step) < abs(left) else 0.0
            goal = tolerance if to == 0 else max(tolerance, LOOSE)
            found = self.direct(problem.at_speed(math.exp(to) * problem.speed), state, goal, FROM_NEIGHBOUR)
            if found.residual <= goal:
                left, state, step = to, found.look.state, LONGER * step
            else:
                step = (left - to) / 2
            if left == 0 or abs(step) < SHORTEST:
                return found

    def in_time(self, problem, state, tolerance) -> Found:
        """`march`, then `newton`, counted."""
        way = march(problem, state, most=min(MARCHED, self.left))
        self.factorisations += way.factorisations
        self.krylov += way.krylov
        self.steps += way.steps
        return self.direct(problem, way.state, tolerance)


def _attempts(problem: Problem, starts, tolerance, work: Work) -> Iterator[tuple[str, Found]]:
    near: State | None = None
    for start in starts:
        state = start.state()
        near = state if near is None else near
        yield "from a neighbouring state", work.direct(problem, state, tolerance, FROM_NEIGHBOUR)
        if start.speed != problem.speed:
            yield "step by step from a neighbouring speed", work.walk(problem, state, start.speed, tolerance)
    dry = dry_contact(problem)
    cold = dry_start(problem, dry, problem.contact.moes_film)
    yield "from the dry contact", work.direct(problem, cold, tolerance)
    lubricant = problem.lubricant
    if lubricant.newtonian:
        thin = problem.with_lubricant(
            replace(lubricant, limiting_stress_coefficient=THIN_STRESS, limiting_stress_offset=THIN_OFFSET)
        )
        helped = work.direct(thin, cold, tolerance)
        if helped.residual <= tolerance:
            yield "from a fluid with a limiting stress", work.direct(problem, helped.look.state, tolerance)
    if near is not None:
        yield "in time from a neighbouring state", work.in_time(problem, near, tolerance)
    for times in FASTER:
        fast = problem.at_speed(times * problem.speed)
        helped = work.direct(fast, dry_start(fast, dry, fast.contact.moes_film), LOOSE)
        if helped.residual <= LOOSE:
            yield "step by step from a faster speed", work.walk(problem, helped.look.state, fast.speed, tolerance)
    if near is None:
        yield "in time from the dry contact", work.in_time(problem, cold, tolerance)


def _report(found: Found, tolerance: float, work: Work, name: str) -> Report:
    worst = found.residual
    status = CONVERGED if worst <= tolerance else ITERATION_LIMIT if math.isfinite(worst) else DIVERGED
    return Report(
        "deterministic mixed film",
        status,
        work.factorisations,
        worst if math.isfinite(worst) else math.inf,
        tolerance,
        found.residuals,
        tuple(work.history),
        work.krylov,
        (
            f"started {name}; {work.factorisations} factorisations, {work.krylov} iterations, {work.steps} "
            "steps in time",
        ),
    )
