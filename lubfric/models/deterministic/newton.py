"""Newton's method with active sets and a line search; and implicit steps in time towards the steady state, for starts
from which it does not converge."""

import math
from dataclasses import KW_ONLY, dataclass, field

import numpy as np

from ..._base import BoolArray, count_work, keep_freed_memory
from .counted_work import work_of_steps
from .linear import CYCLES, GMRES_RESIDUAL, MOST_KRYLOV, Change, System
from .problem import Problem
from .state import TOUCHING, Iterate, State, TimeHistory, admissible, evaluated, residuals, update_active_sets

# The effects of half and twice a constant are those on the counted work of eight films, light, heavy, soft and moving
# (`python -m verification.campaigns.newton_constants lubfric.models.deterministic.newton.`).

# Part of its gap that a step leaves in every cell, at least [-]. Half changes nothing; twice takes 4 % less work, 22 %
# less on a soft film.
KEEP = 0.2

# Floors by which a cell may nevertheless sink below the floor in a step [-]: cells at the floor would stop all others.
# Half takes 2 % less work (15 % less on a soft film), twice changes nothing.
MOST_SINKING = 3.0

# Part of a Newton step that is taken, whatever the gap of a cell says [-]. Half and twice change the work by 1 %.
LEAST_STEP_PART = 0.1

# Halvings of a step, at most, while the mass residual grows [-]: a bound. Half and twice change nothing.
STEP_HALVINGS = 10

# Factor by which the residual may grow in a step [-]. Half of it, which asks the residual to halve, takes 69 % more
# work, twice 8 % more. On last levels of a roller of 1 GPa 2 takes 9, 13, 8, 9, 15, 24 Newton steps where 1.05 takes
# 11, 12, 12, 11, 13, 16, and 10 takes up to 35.
RESIDUAL_GROWTH = 1.05

# Factor by which the residual may grow in a step as short as `LEAST_STEP_PART`, or at rest by cells that change their
# kind [-]: the next step solves those by another equation. Half and twice change nothing. Without them a starved film
# takes 20 % more Newton steps; with them in steps in time a roller of 1 GPa takes 22 % more.
SURGE = 2.0

# Steps in which the residual has to fall [-]. Half and twice change nothing.
NEWTON_PATIENCE = 20

# Residual over the least one before these steps, to which it has to fall [-]. Half changes nothing, twice takes 6 %
# more work on a soft film.
PROGRESS = 0.95

# First step in time over dx/U [-]. Half and twice take 14 % less work on a soft film: it is not tuned to it.
FIRST_TIME_STEP = 3.0

# Factor of a step in time after one that was not solved [-]. Half takes 15 % less work on a soft film,
# twice 26 % more.
TIME_STEP_SHRINKAGE = 0.25

# Steps in time solved in a row, from which on they grow [-]: where the next one fails, its Newton steps are lost. With
# `TIME_STEP_SHRINKAGE` = 0.5, no waiting and `IMBALANCE_PART` = 0.3, four films of a soft roller (E' 19 GPa, film/Sq
# 0.05) took 723 factorisations from the dry contact; with these values they take 315. Alone, half takes 8 % and twice
# 55 % less work on the soft film of the campaign.
WAIT = 3

# Factors of a step in time after one that was solved [-]: after at most `EASY_STEPS` Newton steps, and after more.
# Halved, so that they never grow, takes 39 % less work on a soft film, twice 24 % more.
GROW = (2.0, 1.5)

# Newton steps, up to which a step in time was easy [-]. Half takes 9 % less work on a soft film;
# twice changes nothing.
EASY_STEPS = 5

# Step in time over dx/U, below which the steps in time have failed [-]: a bound. Half and twice change
# nothing.
LEAST_TIME_STEP = 1e-3

# Step in time over dx/U, above which the film is steady [-]: a bound. Half and twice change nothing.
LAST_TIME_STEP = 1e5

# Newton steps in a step in time, at most [-]. Half takes 27 % less work on a soft film, twice 55 % more.
INNER = 8

# Residual of a step in time, at most [-]. Half takes 13 % less work on a soft film, twice changes nothing.
MOST_STEP_RESIDUAL = 0.1

# Residual of a step in time over the steady imbalance of mass [-]. Half takes 16 % less work
# on a soft film; with twice it is not solved.
IMBALANCE_PART = 0.6

# Part of the tolerance of a solution to which steps in time are solved, at least [-]. Half and twice change
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
    ``least_part`` of it. It is halved while the mass residual of the cells that do not touch grows by more than
    `RESIDUAL_GROWTH`. At rest those that change their kind may let it grow by `SURGE`; in steps in time single cells
    would rupture and refill in turn so. The method gives up after a step shorter than ``least`` of the whole; when a
    number is not finite; or when for ``patience`` steps neither the residual has fallen nor the residual that the full
    step would have led to. (The latter falls first, while a heavily loaded film finds its shape in short steps.)
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
    at = evaluated(problem, admissible(problem, state), history)
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
            step, iterations = System(at).solve(linear_accuracy)
        except RuntimeError:  # the LU is singular
            return result
        work.factorisations += 1
        work.krylov += iterations
        count_work(work_of_steps(at.gap.size, 1, iterations))
        if not np.all(np.isfinite(step.gap)):
            return result
        if ends_unsolved and iterations >= MOST_KRYLOV * CYCLES:
            return result
        at, full_merit, length = _advanced(at, step, least_part)
        promised.append(full_merit)
        if length < least:
            return result


def _has_stalled(history: list[float], patience: int) -> bool:
    return len(history) > patience and not min(history[-patience:]) <= PROGRESS * min(history[:-patience])


def _advanced(at: Iterate, step: Change, least: float) -> tuple[Iterate, float, float]:
    """Return the `admissible` state after the longest part of ``step`` that is accepted, the merit of the longest
    part that was tried, and the part that was accepted. No gap limits it to less than ``least``."""
    apart = at.state.kind != TOUCHING
    length = _longest(at, step, least)
    before = _merit(at, apart)
    merits: list[float] = []
    for _ in range(STEP_HALVINGS):
        tried = admissible(at.problem, step.added(at.state, length))
        new = evaluated(at.problem, tried, at.history)
        of_all = _merit(new, apart)
        merits.append(of_all if at.history is not None else _merit(new, apart & (tried.kind == at.state.kind)))
        growth = RESIDUAL_GROWTH if length > least else SURGE
        if merits[-1] <= growth * before and of_all <= SURGE * before:
            break
        length /= 2
    return new, merits[0], length


def _longest(at: Iterate, step: Change, least: float) -> float:
    lost = -step.gap - MOST_SINKING * at.problem.floor
    falling = (lost > 0) & (at.gap > at.problem.floor)
    return float(max(least, ((1 - KEEP) * at.gap[falling] / lost[falling]).min(initial=1.0)))


def _merit(at: Iterate, cells: BoolArray) -> float:
    """Return Σ |r| over these ``cells``, and the load error, both relative."""
    flow = at.mean_flow * cells.shape[1] / at.problem.spacing[0]
    merit = float(np.abs(at.residual[cells]).sum()) / flow + abs(at.load_error) / at.problem.load
    return merit if math.isfinite(merit) else math.inf


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
