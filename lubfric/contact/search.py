"""Single-precision search for a better pressure on the cells that may touch: one convolution an iteration.

The unknown is the change of the pressure since the gap was last computed in double precision, so rounding is relative
to that change. The free cells are those whose pressure may change: they are in elastic contact (0 < p < H), or overlap
without pressure, or have yielded and opened. On them the gap is the gradient of the energy.

An iteration has three parts. First, a conjugate direction leads to a trial, by a length that is learnt from the steps
before. (The preconditioner is |k|, the inverse of the half-space. The direction is kept when the set changes, where I.
A. Polonsky and L. M. Keer, Wear 231 (1999) 206-219, doi:10.1016/S0043-1648(99)00113-1 restart.) Second, the trial is
cut to 0..H and made to carry the load. Third, the change from the *known* pressure, whose gap is available, to the
trial is convolved, and the step along it is exact. The new pressure is cut again, so it may differ from the known one
on some cells. That difference is convolved together with the next trial.

The exact search takes two or three convolutions an iteration: its preconditioner is a transform, its step is exact for
the free cells, and what the limits cut off is convolved at once. It converges where a small change of the contact set
changes the pressure a lot: for nearly rigid bodies, and after rounds that gained nothing.
"""

import math
from collections.abc import Callable

import numpy as np

from .._base import BoolArray, FloatArray, count_work
from .candidate_cells import CandidateCells, stencil
from .operator import filtered, wavenumber
from .problem import ContactProblem, TrialContact, dot, with_load, zero_level

# Counted work [s of a usual core] of an iteration, over n log2 n of its n cells: 0.9 to 1.2e-9 was measured on maps of
# 256 x 256 and 512 x 512 (`lubfric.solve_contact`, tolerance 1e-8).
ITERATION = 1.2e-9
# Counted work [s of a usual core] of an iteration, whatever its cells: measured on strips of some 100 candidate cells.
LEAST_ITERATION = 1.5e-4

# Length of the first step over that of an exact preconditioner [-]. Halved and doubled by `python -m
# verification.campaigns.benchmarks.contact_constants`.
FIRST_PACE = 0.35
# Relative error of the load in the trials of a round [-]; less in later ones, in proportion to the residual. A choice,
# far below the tolerance of a contact.
LOAD_ERROR = 1e-6
# Power of the relative length of a step in the next pace [-]. Halved and doubled by `python -m
# verification.campaigns.benchmarks.contact_constants`.
LEARNING = 0.3
# Least and greatest part of the way to the trial [-]. A choice: a smaller value damps more, a larger one may overshoot.
# Half and twice this value change f by less than .01 % and the work by up to 27 % (constants.csv).
STEP_PARTS = (0.3, 2.0)
# Shifts of a trial, at most, to make it carry the load. A choice: a bound; less leaves an error of the load to the next
# trial.
SHIFTS = 12
# Iterations without a tenth off the best residual after which a round ends. Halved and doubled by `python -m
# verification.campaigns.benchmarks.contact_constants`.
ROUND_PATIENCE = 8
# Load over hardness times free cells [-] above which the exact search frees more cells. A choice: rounding is below
# what it leaves.
CAPACITY = 0.999


class CandidateSearch:
    """The search on ``cells`` (`lubfric.contact.candidate_cells.CandidateCells`), from the state ``state`` of a
    complete patch.

    ``load`` [Pa cells]: what the pressure has to carry, or None if the approach is prescribed; ``pace``: that of an
    earlier search, or `FIRST_PACE`; ``exact``: whether steps are exact.

    Pressures are in units of the mean pressure in contact, gaps in units of the scale of ``state``. These arrays have
    one value for each cell:

    - ``lower``, ``upper``: smallest and largest allowed change of the pressure (to zero, and to the hardness).
    - ``change``: the change of the pressure so far; ``known``: the part of it that is convolved already; ``gap``: the
      gap under the known part.
    - ``weight``: 1 on free cells, else 0; ``residue``: the gap above its zero level on free cells; ``before``: the
      residue from which ``direction``, the direction of the step, was made.
    - ``trial``: the change of the pressure at which the next step aims.
    """

    def __init__(
        self,
        problem: ContactProblem,
        cells: CandidateCells,
        state: TrialContact,
        load: float | None,
        pace: float,
        *,
        exact: bool,
    ):
        operator = problem.operator
        base = cells.take(state.pressure)
        scale = state.scale
        total = float(base.sum())
        loaded = np.count_nonzero(base)
        if not math.isfinite(scale):  # no pressure yet
            scale = max(-float(state.gap.min()), 1e-9 * max(problem.roughness, min(operator.spacing)))
        self.unit = total / loaded if total > 0 else operator.e_prime * scale / min(operator.spacing)
        self.compliance = self.unit / scale
        self.cells = cells
        self.pace = pace
        self.exact = exact
        self.given = load is not None
        self.load = math.nan if load is None else load / self.unit
        self.target = 0.0 if load is None else (load - total) / self.unit
        self.slack = LOAD_ERROR * min(1.0, state.residual) * total / self.unit
        self.hardness = problem.hardness / self.unit
        self.plastic = math.isfinite(problem.hardness)
        base /= self.unit
        self.lower = np.negative(base, dtype=np.float32)
        self.upper = (self.hardness - base).astype(np.float32)  # the difference in double precision
        del base
        self.gap = cells.take(state.gap, np.float32, 1 / scale)
        self.change, self.known, self.direction, self.before = (np.zeros_like(self.gap) for _ in range(4))
        self.weight, self.residue, self.trial = (np.empty_like(self.gap) for _ in range(3))
        self.power = 0.0
        self.level = 0.0
        self.overlap = 0.0
        self.iterations = 0
        self.convolutions = 0
        self.count = 0
        self.history: list[float] = []
        factor = operator.e_prime / 4 / self.compliance
        if exact:
            stiffness = (factor * wavenumber(cells.shape, operator.spacing)).astype(np.float32)
            of = stiffness, cells.shape, operator.workers
            self.turned: Callable[[np.ndarray], np.ndarray] = lambda values: cells.gather(
                filtered(cells.field(values), *of)
            )
        else:
            self.turned = stencil(cells, operator.spacing, operator.boundary, factor)

    def run(self, tolerance: float, limit: int) -> None:
        """Iterate until the residual on these cells is <= tolerance, until it no longer falls, or ``limit`` times."""
        best = math.inf
        waiting = 0
        while True:
            self._look()
            worst = self._worst(tolerance)
            self.history.append(worst)
            best, waiting = (worst, 0) if worst < 0.9 * best else (best, waiting + 1)
            if worst <= tolerance or waiting > ROUND_PATIENCE or self.iterations == limit:
                return
            self.iterations += 1
            count_work(LEAST_ITERATION + ITERATION * self.change.size * math.log2(self.change.size + 1))
            self._turn()
            if self.exact:
                self._exact_step()
            else:
                self._step()

    def new_pressure(self, pressure: np.ndarray, hardness: float) -> np.ndarray:
        """Return ``pressure`` [Pa], the field with which the search began, with its changes; yielded cells have the
        hardness [Pa] to the last digit."""
        values = self.cells.take(pressure)
        values += np.multiply(self.change, self.unit, dtype=float)
        values *= self.change > self.lower
        np.maximum(values, 0.0, out=values)
        np.copyto(values, hardness, where=self.change >= self.upper)
        return self.cells.spread(values)

    def _look(self) -> None:
        """Find the zero level of the gap, the free cells, the residue on them and the deepest overlap."""
        yielded = self.change >= self.upper
        inside = (self.change > self.lower) & ~yielded
        if self.given:
            self.level = zero_level(self.gap, yielded, inside, self.level)
        free = self.gap < np.float32(self.level)
        free ^= yielded
        free |= inside
        if self.exact and self.given:
            capacity = CAPACITY * self.hardness * np.count_nonzero(free)
            if self._share(free) > capacity:  # all that has not yielded for good has to help
                free = ~yielded | (self.gap > self.level)
        self.weight[:] = free
        self.count = int(np.count_nonzero(free))
        np.subtract(self.gap, np.float32(self.level), out=self.residue)
        self.residue *= self.weight
        self.overlap = max(0.0, -float(self.residue.min()))

    def _share(self, free: BoolArray) -> float:
        """Return the load that the free cells have to carry."""
        return float((self.change - self.lower).sum(where=free)) + self.target - float(self.change.sum())

    def _worst(self, tolerance: float) -> float:
        """Return the worst residual on these cells. Overlap is the worst as a rule, so the others are not looked at
        while it is above ``tolerance``."""
        if self.overlap > tolerance:
            return self.overlap
        pressure = self.change - self.lower
        total = float(pressure.sum())
        misfit = dot(pressure, np.abs(self.residue)) / total if total > 0 else math.inf
        excess = abs(total - self.load) / self.load if self.given else 0.0
        return max(self.overlap, misfit, excess)

    def _turn(self) -> None:
        """Return the conjugate direction on the free cells (Polak-Ribiere, never negative), along which a given load
        does not change. The residue becomes the one before."""
        turned = self.turned(self.residue)
        self.convolutions += self.exact
        power = dot(self.residue, turned)
        keep = max(0.0, (power - dot(self.before, turned)) / self.power) if self.power > 0 else 0.0
        self.power = power
        self.direction *= np.float32(keep)
        self.direction -= turned
        if self.given:
            self.direction -= np.float32(dot(self.direction, self.weight) / max(self.count, 1))
        self.direction *= self.weight
        self.residue, self.before = self.before, self.residue

    def _step(self) -> None:
        """Go from the known pressure towards the trial, by the step that is exact along that change."""
        self._try()
        way = np.subtract(self.trial, self.known, out=self.residue)
        gradient_change = self.trial - self.change
        answer = self._answer(way)
        slope = dot(self.before, gradient_change)
        curvature = dot(gradient_change, answer) * self.compliance
        step = -slope / curvature if curvature > 0 else 1.0
        step = min(max(step, STEP_PARTS[0] if self.given else 0.0), STEP_PARTS[1])
        self.pace *= max(step, STEP_PARTS[0]) ** LEARNING
        self.known += np.multiply(way, np.float32(step), out=gradient_change)
        self.gap += np.multiply(answer, np.float32(step * self.compliance), out=gradient_change)
        self._limit(self.known, self.change)
        np.copyto(self.change, self.lower, where=self.trial <= self.lower)  # cells that the trial unloads stay so
        if self.plastic:
            np.copyto(self.change, self.upper, where=self.trial >= self.upper)

    def _try(self) -> None:
        """Make the trial: the change of pressure by one pace along the direction, within the limits and with the
        load."""
        aim = np.multiply(self.direction, np.float32(self.pace), out=self.residue)
        aim += self.change
        self._limit(aim, self.trial)
        shift = 0.0
        for _ in range(SHIFTS if self.given else 0):
            missing = self.target - float(self.trial.sum())
            if abs(missing) <= self.slack:
                return
            movable = self.trial > self.lower
            if self.plastic:
                movable &= self.trial < self.upper
            count = np.count_nonzero(movable)
            if not count:
                break
            shift += missing / count
            np.multiply(self.weight, np.float32(shift), out=self.trial)
            self.trial += aim
            self._limit(self.trial, self.trial)
        if self.given:
            self._project(aim)

    def _limit(self, values: FloatArray, out: FloatArray) -> None:
        """Return ``values`` within the limits, into ``out``; `numpy.clip` with arrays takes six times as long."""
        np.maximum(values, self.lower, out=out)
        if self.plastic:
            np.minimum(out, self.upper, out=out)

    def _project(self, aim: FloatArray) -> None:
        """Make the trial by a bracketed shift of all cells, in double precision.

        This is needed when few of many cells stay in contact, or when the free cells cannot carry their share. Then all
        cells are free, and the direction is not kept.
        """
        base = np.negative(self.lower, dtype=float)
        pressure = with_load(base + aim, self.target + float(base.sum()), self.hardness)
        self.trial[:] = self._rounded(pressure, base, np.s_[:])
        np.subtract(self.gap, np.float32(self.level), out=self.before)
        self.power = 0.0

    def _exact_step(self) -> None:
        """Return the step that is exact along the direction, then brought within the limits and to the load, on the
        free cells."""
        curvature = dot(self.direction, self._answer(self.direction)) * self.compliance
        slope = dot(self.before, self.direction)
        if not (curvature > 0 and slope < 0):
            self.power = 0.0
            return
        free = self.weight > 0
        base = np.negative(self.lower[free], dtype=float)
        new = base + (self.change + np.float32(-slope / curvature) * self.direction)[free]
        new = with_load(new, self._share(free), self.hardness) if self.given else np.clip(new, 0.0, self.hardness)
        self.change[free] = self._rounded(new, base, free)
        self.gap += self._answer(self.change - self.known) * np.float32(self.compliance)
        self.known[:] = self.change

    def _rounded(self, pressure: FloatArray, base: FloatArray, cells: slice | BoolArray) -> np.ndarray:
        """Return the change of the pressure on ``cells`` in single precision, the limits met to the last digit."""
        change = np.where(pressure <= 0, self.lower[cells], (pressure - base).astype(np.float32))
        return np.where(pressure >= self.hardness, self.upper[cells], change)

    def _answer(self, way: FloatArray) -> np.ndarray:
        """Return the deflection under a change of pressure, to be multiplied by the compliance."""
        self.convolutions += 1
        return self.cells.gather(self.cells.deflection(self.cells.field(way)))
