"""Newton's method with active sets and a line search; and implicit steps in time towards the steady state, for starts
from which it does not converge."""

import math
from dataclasses import KW_ONLY, dataclass, field

import numpy as np

from ..._base import BoolArray, count_work, keep_freed_memory
from .counted_work import work_of_steps
from .linear import CYCLES, GMRES_RESIDUAL, MOST_KRYLOV, Change, System
from .problem import Problem
from .state import Iterate, State, TimeHistory, admissible, evaluated, residuals, update_active_sets

# The comments state how results change with half and with twice the value of a constant, on the counted work of eight
# films, light, heavy, soft and moving (`python -m verification.campaigns.newton_constants
# lubfric.models.deterministic.newton.`).

# Least part of the gap of a cell that a step leaves [-]. Half this value changes nothing; twice this value takes 4 %
# less work, 22 % less on a soft film.
KEEP = 0.2

# Distance, over the smallest gap (`problem.FLOOR`), by which a cell may sink below the smallest gap in a step [-]:
# otherwise cells at this gap would stop all others. Half this value takes 2 % less work (15 % less on a soft film),
# twice this value changes nothing.
MOST_SINKING = 3.0

# Least part of a Newton step that is taken, whatever limit the gaps of single cells set [-]. Half and twice this value
# change the work by 1 %.
LEAST_STEP_PART = 0.1

# Halvings of a step, at most, while it is not accepted [-]: a bound. Half and twice this value change nothing.
STEP_HALVINGS = 10

# Imbalance of mass [-] above which a step is judged by the change that the equations require next: a heavily loaded
# film finds its shape before its imbalance falls, and advances by quarters of a step where the imbalance decides. With
# this rule 200 random films at rest take 16 % less work, and 16 that move 3 % less. Half and twice this value change
# nothing.
FAR_IMBALANCE = 0.5

# Factor by which the measure of a step may grow in it [-]. Halved, which requires the measure to halve in each step, it
# takes 91 % more work, twice this value 10 % more.
STEP_GROWTH = 1.05

# This factor in a step as short as `LEAST_STEP_PART`, and the factor by which the imbalance of all cells may grow in
# any step [-]: at rest, cells that change their kind are solved by another equation in the next step. Half this value
# takes five times the work, twice 3 % more.
SURGE = 2.0

# Number of steps within which the residual has to fall [-]. Half and twice this value change nothing.
NEWTON_PATIENCE = 20

# Ratio of the residual to its least value before these steps, to which it has to fall [-]. Half this value changes
# nothing, twice this value takes 6 % more work on a soft film.
PROGRESS = 0.95

# First step in time over dx/U [-]. Half and twice take 14 % less work on a soft film: the value is not tuned to this
# film.
FIRST_TIME_STEP = 3.0

# Factor of a step in time after one that was not solved [-]. Half this value takes 15 % less work on a soft film, twice
# 26 % more.
TIME_STEP_SHRINKAGE = 0.25

# Steps in time solved in a row, from which on they grow [-]: where the next one fails, its Newton steps are lost. With
# `TIME_STEP_SHRINKAGE` = 0.5, no waiting and `IMBALANCE_PART` = 0.3, four films of a soft roller (E' 19 GPa, film/Sq
# 0.05) took 723 factorisations from the dry contact; with these values they take 315. Alone, half takes 8 % and twice
# 55 % less work on the soft film of the campaign.
WAIT = 3

# Factors of a step in time after one that was solved [-]: after at most `EASY_STEPS` Newton steps, and after more.
# Halved, so that they never grow, takes 39 % less work on a soft film, twice 24 % more.
GROW = (2.0, 1.5)

# Newton steps, up to which a step in time was easy [-]. Half this value takes 9 % less work on a soft film; twice this
# value changes nothing.
EASY_STEPS = 5

# Step in time over dx/U, below which the steps in time have failed [-]: a bound. Half and twice this value change
# nothing.
LEAST_TIME_STEP = 1e-3

# Step in time over dx/U, above which the film is steady [-]: a bound. Half and twice this value change nothing.
LAST_TIME_STEP = 1e5

# Newton steps in a step in time, at most [-]. Half this value takes 27 % less work on a soft film, twice 55 % more.
INNER = 8

# Residual of a step in time, at most [-]. Half this value takes 13 % less work on a soft film, twice this value changes
# nothing.
MOST_STEP_RESIDUAL = 0.1

# Residual of a step in time over the steady imbalance of mass [-]. With 0.6 a step may end before the one cell is solved
# that holds most of the imbalance: on a soft roller (E' 19 GPa, 50 x 160 cells) the march then took 500 factorisations
# in vain, and takes 250 with this value. Half this value takes 8 % more work on a soft film, twice this value 23 %.
IMBALANCE_PART = 0.3

# Part of the tolerance of a solution to which steps in time are solved, at least [-]. Half and twice this value change
# nothing.
STEP_TOLERANCE_PART = 1 / 3


@dataclass
class Work:
    """What the attempts at one point cost: LU factorisations, ``most`` at most, GMRES iterations, steps in time; and
    the largest residual before every Newton step."""

    most: int
    _: KW_ONLY
    factorisations: int = 0
    krylov: int = 0
    steps: int = 0
    history: list[float] = field(default_factory=list)

    @property
    def left(self) -> int:
        """Factorisations that may still be done."""
        return max(self.most - self.factorisations, 0)


@dataclass(frozen=True)
class NewtonResult:
    """The end of Newton's method, and its residuals."""

    at: Iterate
    residuals: dict[str, float]

    @property
    def residual(self) -> float:
        """The largest of its residuals."""
        return max(self.residuals.values())


def newton(
    problem: Problem,
    state: State,
    work: Work,
    *,
    tolerance: float,
    most: int,
    least: float = 0.0,
    history: TimeHistory | None = None,
    linear_accuracy: float = GMRES_RESIDUAL,
    patience: int = NEWTON_PATIENCE,
    ends_unsolved: bool = False,
    least_part: float = LEAST_STEP_PART,
) -> NewtonResult:
    """Take at most ``most`` Newton steps from ``state``, until the largest of `residuals` is <= ``tolerance``.

    Every state that is tried is made `admissible` first, and before every step cells touch or open as it requires
    (`update_active_sets`). A step leaves every cell at least a fifth of its gap, unless that is less than
    ``least_part`` of it. It is halved while its measure grows by more than `STEP_GROWTH` (`_advanced`). The method
    gives up after a step shorter than ``least`` of the whole; when a number is not finite; or when for ``patience``
    steps neither the residual has fallen nor the measure of the full step.
    ``history``: of an implicit step in time (None: the film is steady); ``linear_accuracy``: of the linear system of a
    step (`System.solve`). ``ends_unsolved``: whether the method also gives up at a linear system that takes all
    iterations of GMRES: between soft bodies it is nearly singular, and the steps that follow lead nowhere. Of twelve
    films between bodies of 19 and 0.26 GPa and 21 MPa seven meet such systems. They take 32 to 68 % less work so; f
    stays the same, but for one, by 0.4 % (tolerance of the residuals 0.3 %).
    """
    keep_freed_memory()
    residual_history: list[float] = []
    promised: list[float] = []
    most = min(most, work.left)
    at = evaluated(problem, admissible(problem, state, in_time=history is not None), history)
    while True:
        at = update_active_sets(at)
        result = NewtonResult(at, residuals(at))
        residual_history.append(result.residual)
        work.history.append(result.residual)
        if not math.isfinite(result.residual) or result.residual <= tolerance or len(residual_history) > most:
            return result
        if _has_stalled(residual_history, patience) and _has_stalled(promised, patience):
            return result
        try:
            system = System(at)
            step, iterations = system.solve(linear_accuracy)
        except RuntimeError:  # the LU is singular
            return result
        work.factorisations += 1
        work.krylov += iterations
        count_work(work_of_steps(at.gap.size, 1, iterations))
        if not np.all(np.isfinite(step.gap)):
            return result
        if ends_unsolved and iterations >= MOST_KRYLOV * CYCLES:
            return result
        at, measure, length = _advanced(system, step, least_part)
        promised.append(measure)
        if length < least:
            return result


def _has_stalled(history: list[float], patience: int) -> bool:
    return len(history) > patience and not min(history[-patience:]) <= PROGRESS * min(history[:-patience])


def _advanced(system: System, step: Change, least: float) -> tuple[Iterate, float, float]:
    """Return the `admissible` state after the longest part of the ``step`` from that of the ``system`` which is
    accepted, the measure of the longest part that was tried, and the part that was accepted. No gap limits it to less
    than ``least``.

    The measure is what the equations ask for (`_asked`) while the imbalance of mass is above `FAR_IMBALANCE`, and that
    imbalance (`_imbalance`) below. At rest cells that change their kind do not count in it.
    """
    at = system.at
    apart = ~system.touching
    imbalance = _imbalance(at, apart)
    is_far = imbalance > FAR_IMBALANCE
    before = _asked(system, at, apart) if is_far else imbalance
    length = _longest(at, step, least)
    measures: list[float] = []
    for _ in range(STEP_HALVINGS):
        tried = admissible(at.problem, step.added(at.state, length), in_time=at.history is not None)
        new = evaluated(at.problem, tried, at.history)
        of_all = _imbalance(new, apart)
        counted = apart if at.history is not None else apart & (tried.kind == at.state.kind)
        if is_far:
            measures.append(_asked(system, new, counted))
        else:
            measures.append(of_all if counted is apart else _imbalance(new, counted))
        growth = STEP_GROWTH if length > least else SURGE
        if measures[-1] <= growth * before and of_all <= SURGE * imbalance:
            break
        length /= 2
    return new, measures[0], length


def _longest(at: Iterate, step: Change, least: float) -> float:
    lost = -step.gap - MOST_SINKING * at.problem.floor
    falling = (lost > 0) & (at.gap > at.problem.floor)
    return float(max(least, ((1 - KEEP) * at.gap[falling] / lost[falling]).min(initial=1.0)))


def _asked(system: System, new: Iterate, cells: BoolArray) -> float:
    """Return the change that the equations of the ``system`` for these ``cells`` ask in the state ``new`` of their own
    unknowns [-], as a mean over all cells, and the load error, relative.

    Each equation counts by the inverse of its sparse diagonal: a cell at high pressure passes little lubricant, so its
    mass residual is small where its pressure is far off.
    """
    asked = np.abs(system.row_weights * system.equations(new))
    return _finite(float(asked[:-1][cells.ravel()].sum() / cells.size + asked[-1]))


def _imbalance(new: Iterate, cells: BoolArray) -> float:
    """Return Σ |r| of the state ``new`` over these ``cells``, relative to the flow that enters, and the load error,
    relative."""
    flow = new.mean_flow * cells.shape[1] / new.problem.spacing[0]
    return _finite(float(np.abs(new.residual[cells]).sum()) / flow + abs(new.load_error) / new.problem.load)


def _finite(value: float) -> float:
    """Return ``value``, infinite where it is not a number."""
    return value if math.isfinite(value) else math.inf


def march(problem: Problem, state: State, work: Work, *, tolerance: float, most: int) -> State:
    """Let the film settle from ``state`` in implicit Euler steps, which grow while they are solved, until the steady
    imbalance of mass is <= ``tolerance``; at most ``most`` factorisations.

    Each step is solved to a part of the steady imbalance of mass that it begins with: the way there need not be exact.
    Behind furrows that asperity contacts shut off it is long, because valleys fill by what leaks in.
    """
    unit = problem.spacing[0] / problem.speed
    step = FIRST_TIME_STEP * unit
    last = work.factorisations + min(most, work.left)
    at = evaluated(problem, state)
    solved = 0
    while work.factorisations < last and LEAST_TIME_STEP * unit <= step <= LAST_TIME_STEP * unit:
        left = residuals(update_active_sets(at))["mass"]
        if left <= tolerance:
            break
        goal = max(STEP_TOLERANCE_PART * tolerance, min(MOST_STEP_RESIDUAL, IMBALANCE_PART * left))
        begun = work.factorisations
        most = min(INNER, last - begun)
        history = TimeHistory(extrapolated=at.mass, step=step)
        result = newton(problem, at.state, work, tolerance=goal, most=most, history=history, ends_unsolved=True)
        work.steps += 1
        if result.residual <= goal:
            at = evaluated(problem, result.at.state)
            solved += 1
            if solved >= WAIT:
                (after_easy_steps, after_more_steps) = GROW
                is_easy = work.factorisations - begun <= EASY_STEPS
                step *= after_easy_steps if is_easy else after_more_steps
        else:
            step *= TIME_STEP_SHRINKAGE
            solved = 0
    return at.state
