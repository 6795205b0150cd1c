"""Roughness that moves through the film: implicit steps in time, each with the mass that the film stores.

    div( U rho θ h - rho h³ Φ/(12 eta) grad p ) + d(rho θ h)/dt = 0

In a step the lubricant passes one cell, and the step is BDF3, of third order: (11 m - 18 m1 + 9 m2 - 2 m3)/(6 dt), with
m the mass rho θ h, and mn that of n moments ago, n cells upstream; limited where a summit fills a gap (`state.stored`).
A step that Newton's method does not solve is taken by second order, or else by first. Along the way of the lubricant
both first terms of the balance are one, d(rho θ h)/dt. Waves that go with it lose nothing, and of a film at rest that
is third-order upwind. (In steps and cells that are at rest, waves of 12 cells lost half of their height in a
half-width. With BDF2 along the lubricant, ten cells in the half-width of a needle roller let 5.5 % less film through
its short inlet. Then f, which depends on the thinnest film, was 33 % too high; with BDF3 it is 6 % too high.)

Where all roughness is slower than U/2, or some is faster than 2 U, the fastest rough body moves by one cell in a step.
Then steps are BDF2 of the cell itself, the Couette flow is second-order upwind, and the first step is implicit Euler;
so are runs in time, whose speed changes from step to step. (A needle roller whose roughness moves at 0.2 U: f .0500, on
cells half as long .0505; in steps along the lubricant .0493 and .0482, at five to eight times the work. Third-order
upwind of cells at rest would change the steady film too.)

f is that of surface 2, the upper one, against its sliding u2 - u1, or against U in pure rolling (`Problem.sense`).
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from scipy.ndimage import uniform_filter1d

from ..._base import FloatArray
from ...errors import CONVERGED, ITERATION_LIMIT, Report
from ...film import LineContact
from ...surface import Surface
from .linear import GMRES_RESIDUAL
from .newton import Work, newton
from .problem import Problem, shifted
from .result import DeterministicResult, assemble
from .solve import solve_point
from .state import RUPTURED, TOUCHING, Iterate, State, TimeHistory, evaluated, extrapolated_mass, gap_of, residuals

# The comments state how results change with half and with twice the value of a constant, as in `moving_strip`.

# Default tolerance of the residual of a step (`residuals`) [-]. Measured: with 0.2 instead f of a roller of 1 GPa is
# the same to 1e-4.
MOVING_STEP_RESIDUAL = 1e-3

# LU factorisations of a step, at most [-]; a usual step takes 3 to 4. Half and twice this value change nothing.
MOST_STEP_FACTORISATIONS = 160

# Newton steps from one start, at most [-]. A choice: a bound, above what a step takes that converges.
MOST_NEWTON_STEPS = 40

# Newton steps from the moved state, at most, where the last step that began there failed [-]. In four contacts with Λ
# of .2 to .7 each such step took some 50 Newton steps in vain, and 16 in parts. They take 26, 20, 7 and 18 s with
# `MOST_NEWTON_STEPS` each time and a start from the unmoved state in between, and 16, 9, 5 and 9 s with this value and
# `STEPS_IN_PARTS`.
MOST_NEWTON_STEPS_AGAIN = 10

# Number of steps that begin in parts after one that had to [-], before the moved state is tried again. With 0 these
# contacts take 21, 10, 5 and 9 s.
STEPS_IN_PARTS = 4

# Euler steps into which a step in time is divided that Newton's method does not solve [-]. With 2 and 3 these contacts
# take 12, 8, 7, 9 and 14, 9, 7, 9 s, but with 2 some steps fail.
EULER_STEPS = 4

# Orders of a step along the lubricant [-]: the first, and those that follow where it is not solved. On an exponential
# surface (verification/campaigns/moving_coverage, seed 2) one step of 52 needs the second, which takes 5 LU
# factorisations.
STEP_ORDERS = (3, 2, 1)

# Distance over which the pressure is smoothed, to separate the part that moves with the roughness [half-widths]. Half
# this value takes 12 % more time, twice 3 %; f moves by 0.2 %, within the residual of a step.
SMOOTHED_HALF_WIDTHS = 0.4

# Part of the last change of the pressure that moves with the roughness, added at the start of a step [-]. With 0 a
# needle roller at .05 m/s takes 9 % more Newton steps, a flank with a slide-roll ratio of 1.28 5 to 30 %. Of sixteen
# random rolling contacts all of it takes 1 % more, some with much sliding 20 to 30 %.
EXTRAPOLATED = 0.5

# This part where all roughness moves by the same number of cells (`SAME_CELLS`) [-]. A needle roller with a slip of 1 %
# at .05, 2 and 5 m/s takes 18, 11 and 5 % fewer Newton steps than with a half, ten random contacts with a slide-roll
# ratio of .05 6 %; with one of .3, 1 %.
EXTRAPOLATED_TOGETHER = 1.0

# Largest difference, in cells a step, between the motion of a rough body and the mean motion, up to which all roughness
# counts as moving alike [-]. A convention: those of a slide-roll ratio of .1.
SAME_CELLS = 0.05

# Part of the largest pressure above which a cell counts in the mean gap that the start of a step keeps [-]. A choice:
# where the pressure is low, the film is thick.
PRESSED_PART = 0.1

# Steps in time after a start from rest that begin without a part of the last change [-]: the change from rest to motion
# does not go on. Without them the first steps of random contacts took 46, 29, 12, 11 Newton steps instead of 20, 7, 7,
# 7, those of a needle roller 38 and 59 instead of 19 and 13.
STEPS_FROM_REST = 2

# Least part of a Newton step that is taken in a step in time, whatever limit the gaps of single cells set [-]. Where
# two bodies move at unlike speeds, summits of both meet at its start, and single cells would limit seven of eight steps
# to 0.1 to 0.3. With 0.1, 0.3, 0.5 a gear flank with a slide-roll ratio of 1.36 takes 18, 13, 11 s of counted work, six
# other rolling contacts 68, 58, 60 s; f moves by up to 0.6, 1.5 %.
LEAST_PART_IN_MOTION = 0.3

# Relative difference up to which the lubricant passes one cell in a step [-]. A convention, far above rounding.
SAME_STEP = 1e-9


class Remembered(NamedTuple):
    """The ``state`` of a moment, and the ``mass`` [m] of its cells."""

    state: State
    mass: FloatArray


@dataclass(frozen=True, kw_only=True)
class Past:
    """What the steps after a moment need of it and of those before it.

    Attributes
    ----------
    at, before, earlier : the moment, and the two before it
    imbalance : what its step left in each cell [m/s]; None: nothing is carried
    """

    at: Remembered
    before: Remembered
    earlier: Remembered
    imbalance: FloatArray | None = None


@dataclass(frozen=True, kw_only=True)
class Moment:
    """The film ``at`` a ``time`` [s] since the roughness began to move; ``work``: what this step took; ``tolerance``:
    of its residuals [-]; ``order`` (of `STEP_ORDERS`): of a step along the lubricant; ``past``: what later steps need
    of it."""

    time: float
    at: Iterate
    work: Work
    tolerance: float
    past: Past
    order: int = STEP_ORDERS[0]

    @cached_property
    def result(self) -> DeterministicResult:
        """Its fields and forces."""
        left = residuals(self.at)
        worst = max(left.values())
        steps = self.work.factorisations
        cost = self.work.krylov
        name = "film under moving roughness"
        return assemble(
            self.at,
            Report(
                name,
                CONVERGED,
                iterations=steps,
                residual=worst,
                tolerance=self.tolerance,
                residuals=left,
                evaluations=cost,
            ),
        )


def moments(
    problem_at: Callable[[float], Problem],
    step: float,
    *,
    start: State | Past | None = None,
    tolerance: float = MOVING_STEP_RESIDUAL,
    carries_imbalance: bool = False,
    linear_accuracy: float = GMRES_RESIDUAL,
    shift: float = 0.0,
    extrapolated: float = EXTRAPOLATED,
) -> Iterator[Moment]:
    """Yield the film from moment to moment, without end, while the heights of its surfaces change with time.

    Parameters
    ----------
    problem_at : of a time [s], from 0 on, the `Problem` then: its ``heights`` [m] (nx, ny) are those of both bodies.
        Load and speed may change too, the grid may not
    step : [s]. If the lubricant passes one cell in it, the mass is followed along
    start : the state at time 0, or the `Moment.past` of the moment there, whose steps go on; None: the steady film
        there, of roughness at rest
    tolerance : of the residuals of a step (`lubfric.models.deterministic.state.residuals`); small waves need 1e-6 and
        less
    carries_imbalance : whether the mass that a step leaves out of balance is added to that of the next step. Then it
        does not add up over the steps, and a ``tolerance`` as large as 0.5 will do for the mean friction
    linear_accuracy : of GMRES (`System.solve`)
    shift : cells, and parts of one, by which the roughness moves in a step. Newton's method begins with its pressure
        there; the result does not depend on it
    extrapolated : part of the last change of that pressure that is added to it [-]; the result does not depend on it
        either

    The first is time 0 itself. Raises `ConvergenceError` where a step is not solved.
    """
    problem = problem_at(0.0)
    count = 0
    direct_from = 0
    most_direct = MOST_NEWTON_STEPS
    past = start if isinstance(start, Past) else _past_of(evaluated(problem, start or solve_point(problem).state))
    begins_anew = past.at is past.before
    at = evaluated(problem, past.at.state)
    smooth = max(1, round(SMOOTHED_HALF_WIDTHS * film_half_width(problem.line) / problem.spacing[0]))
    yield Moment(time=0.0, at=at, work=Work(0), tolerance=tolerance, past=past)
    while True:
        count += 1
        work = Work(MOST_STEP_FACTORISATIONS)
        problem = problem_at(count * step)
        history = _history(problem, at, past, step)
        how: dict[str, Any] = {
            "tolerance": tolerance,
            "most": MOST_NEWTON_STEPS,
            "linear_accuracy": linear_accuracy,
            "least_part": LEAST_PART_IN_MOTION,
        }
        order = STEP_ORDERS[0]
        rate = 0.0 if begins_anew and count <= STEPS_FROM_REST else extrapolated
        is_solved = False
        if count >= direct_from:
            state = _begun(problem, at, past.before.state, shift, smooth, rate) if shift else at.state
            result = newton(problem, state, work, history=history, **how | {"most": most_direct})
            is_solved = result.residual <= tolerance
            direct_from = count if is_solved else count + STEPS_IN_PARTS
            most_direct = MOST_NEWTON_STEPS if is_solved else MOST_NEWTON_STEPS_AGAIN
        if not is_solved:
            nearby = _in_parts(problem_at, at, time=(count - 1) * step, step=step, work=work, how=how)
            for order in STEP_ORDERS if history.follows_lubricant else STEP_ORDERS[:1]:
                history = _history(problem, at, past, step, order=order)
                result = newton(problem, nearby, work, history=history, **how)
                if result.residual <= tolerance:
                    break
        if not result.residual <= tolerance:
            name = f"film under moving roughness, step {count} of {step:.3g} s"
            advice = "try shorter cells, which shorten the step, or a higher speed, which makes the film thicker"
            cost = work.factorisations
            left = result.residuals
            Report(
                name,
                ITERATION_LIMIT,
                iterations=cost,
                residual=result.residual,
                tolerance=tolerance,
                residuals=left,
                advice=advice,
            ).raise_if_failed()
        at = result.at
        imbalance = np.where(at.state.kind == TOUCHING, 0.0, at.residual) if carries_imbalance else None
        past = Past(at=Remembered(at.state, at.mass), before=past.at, earlier=past.before, imbalance=imbalance)
        yield Moment(time=count * step, at=at, work=work, tolerance=tolerance, past=past, order=order)


def _past_of(at: Iterate) -> Past:
    """Return the past of a motion that begins from ``at``: before it all was as there."""
    first = Remembered(at.state, at.mass)
    return Past(at=first, before=first, earlier=first)


def _history(problem: Problem, at: Iterate, past: Past, step: float, *, order: int = STEP_ORDERS[0]) -> TimeHistory:
    """Return the history of the step from ``at`` to ``problem``; ``past``: that of ``at``; ``order``: of a step along
    the lubricant."""
    before = past.before
    earlier = past.earlier
    cell = problem.spacing[0]
    lost = 0.0 if past.imbalance is None else step * past.imbalance
    if max(abs(end.speed * step - cell) for end in (problem, at.problem)) > SAME_STEP * cell:
        if past.at is before:
            return TimeHistory(extrapolated=at.mass, step=step)
        return TimeHistory(extrapolated=extrapolated_mass(at.mass, before.mass) - lost, step=step, last=at.mass)

    def upstream(mass: FloatArray, cells: int = 1) -> FloatArray:
        """Return the mass so many ``cells`` before each cell; before the first one by the parabola."""
        for k in range(cells):
            entering = mass[:1] + (k * cell - problem.x[0]) / problem.radius * cell
            mass = np.concatenate([entering, mass[:-1]])
        return mass

    earlier_mass = upstream(earlier.mass, 2) if order == STEP_ORDERS[0] else None
    left = extrapolated_mass(at.mass, upstream(before.mass), 0.5 if order > 1 else 0.0, earlier_mass) - lost
    return TimeHistory(
        extrapolated=np.concatenate([0.0 * left[:1], left[:-1]]),  # what enters has no history
        step=step,
        last=upstream(at.mass) if order > 1 else None,
        earlier=upstream(before.mass, 2) if order == STEP_ORDERS[0] else None,
        follows_lubricant=True,
    )


def _in_parts(
    problem_at: Callable[[float], Problem], at: Iterate, *, time: float, step: float, work: Work, how: dict[str, Any]
) -> State:
    """Return the state after the step after ``time`` in `EULER_STEPS` Euler steps, as far as they are solved: a start
    only, because they do not keep the mass that the steps of second order keep."""
    for part in range(1, EULER_STEPS + 1):
        problem = problem_at(time + part * step / EULER_STEPS)
        history = TimeHistory(extrapolated=at.mass, step=step / EULER_STEPS)
        result = newton(problem, at.state, work, history=history, **how)
        if not result.residual <= how["tolerance"]:
            break
        at = result.at
    return at.state


def _begun(problem: Problem, at: Iterate, before: State, cells: float, smooth: int, rate: float) -> State:
    """Return the state with which the step from ``at`` to ``problem`` begins: `_moved`, with the load of ``at``, and
    with its mean gap where the pressure is above `PRESSED_PART` of the largest.

    The pressure that is moved carries another load, whose deflection closes a thin film: a third of all cells would
    touch. Of 14 rolling contacts of verification.campaigns.calibration two, with .58 and 1.59 cells in a step, take 22
    and 16 Newton steps in a step in time from the pressure moved by complete cells, and 8 and 12 so; the others take
    the same within 16 %.
    """
    state = _moved(at.state, before, cells, smooth, rate)
    state = replace(state, pressure=state.pressure * (at.state.pressure.sum() / state.pressure.sum()))
    gap = gap_of(problem, state)
    is_pressed = state.pressure > PRESSED_PART * state.pressure.max()
    missing = float((moved_downstream(at.gap, cells) - gap)[is_pressed].mean())
    return replace(state, approach=state.approach + missing)


def moved_downstream(values: FloatArray, cells: float) -> FloatArray:
    """Return ``values`` (nx, ny) moved by so many ``cells`` along x, linear between them; the first row enters, or the
    last one where they move upstream, by a negative number."""
    if cells < 0:
        return moved_downstream(values[::-1], -cells)[::-1]
    complete = math.floor(cells)
    part = cells - complete

    def by(rows: int) -> FloatArray:
        return np.concatenate([np.repeat(values[:1], rows, axis=0), values[: len(values) - rows]])

    return (1.0 - part) * by(complete) + part * by(complete + 1) if part else by(complete)


def _moved(state: State, before: State, cells: float, smooth: int, rate: float) -> State:
    """Return ``state`` with all that goes with the roughness moved by so many ``cells`` along x: dents, kinds of cells
    (by complete cells), and what the pressure has in addition to its mean over y and ``smooth`` cells along x. The part
    ``rate`` of its change since the moment ``before`` is added."""
    mean, old = (
        uniform_filter1d(each.pressure.mean(axis=1, keepdims=True), smooth, axis=0) for each in (state, before)
    )
    now = moved_downstream(state.pressure - mean, cells)
    rough = now + rate * (now - moved_downstream(before.pressure - old, 2 * cells))
    complete = math.floor(cells + 0.5)
    kind = moved_downstream(state.kind, complete)
    return replace(
        state,
        pressure=np.where(kind == RUPTURED, 0.0, np.maximum(mean + rough, 0.0)),
        fill=np.where(kind == RUPTURED, moved_downstream(state.fill, complete), 1.0),
        dent=moved_downstream(state.dent, complete),
        kind=kind,
        yielded=moved_downstream(state.yielded, complete),
    )


class RoughBody(NamedTuple):
    """The map of a body that moves at a ``speed`` [m/s] along x, all on the same cells; ``upper``: it is surface 2, and
    the map as seen from surface 1."""

    surface: Surface
    speed: float
    upper: bool = False


def travelling(problem: Problem, bodies: Sequence[RoughBody]) -> Callable[[float], Problem]:
    """Return the function of a time [s] that gives ``problem`` with the heights of ``bodies`` then.

    A map is laid out as by `lay_out`, and `shifted`."""
    shifts = [shifted(problem, body.surface) for body in bodies]

    def at(time: float) -> Problem:
        heights = [shift(body.speed * time) for shift, body in zip(shifts, bodies)]
        upper = [z for z, body in zip(heights, bodies) if body.upper]
        return replace(problem, heights=np.sum(heights, axis=0), upper=upper[0] if upper else None)

    return at


def film_half_width(line: LineContact) -> float:
    """Return the half-width of the Hertz strip [m], or that of the smooth film where that is wider."""
    return max(line.half_width, math.sqrt(2 * line.radius * line.moes_film))
