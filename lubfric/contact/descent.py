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
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .fields import begun
from .long_waves import worth
from .operator import filtered, wavenumber
from .projection import with_load
from .residual import dot
from .stencil import Stencil

FIRST_PACE = 0.35  # of the step that the preconditioner would take were it the inverse
LOAD_ERROR = 1e-6  # of the load, in the trials of a round; less in later ones, in proportion to the residual
LEARNING = 0.3  # power of the relative length of a step in the next pace
STEPS = (0.3, 2.0)  # of the way to the trial
SHIFTS = 12  # of a trial at most
TRANSFORMED = 0.7  # share of contact from which, on short axes, the preconditioner is the transform, not nine points
REACH = 2.0  # of the deepest overlap: cells with a gap below it may come into touch
NARROWINGS = (4, 8, 12, 16, 24, 32)  # iterations after which cells are left out
NEAR, WORTH = 0.7, 0.6  # of the deepest overlap: gaps of cells that are kept; of the cells: most to be kept
FORGOTTEN = 1e-6  # of the mean pressure in contact: less is not waited for
PATIENCE = 8  # iterations without a tenth off the best residual


class Descent:
    """The search on ``cells``, from the `State` ``state``.

    ``load`` [Pa cells]: what the pressure has to carry, or None if the approach is prescribed; ``pace``: that of an
    earlier descent, or `FIRST_PACE`.
    """

    def __init__(self, problem, cells, state, load: float | None, pace: float):
        base, scale = cells.take(state.pressure), state.scale
        total, operator = float(base.sum()), problem.operator
        if not math.isfinite(scale):  # no pressure yet
            scale = max(-float(state.gap.min()), 1e-9 * max(problem.roughness, min(operator.spacing)))
        loaded = np.count_nonzero(base)
        self.unit = total / loaded if total > 0 else operator.e_prime * scale / min(operator.spacing)
        self.cells, self.pace, self.given = cells, pace, load is not None
        self.load = math.nan if load is None else load / self.unit
        self.target = 0.0 if load is None else (load - total) / self.unit
        self.slack = LOAD_ERROR * min(1.0, state.residual) * total / self.unit
        self.hardness = problem.hardness
        base /= self.unit
        limited = math.isfinite(problem.hardness)
        upper = (problem.hardness / self.unit - base).astype(np.float32) if limited else None
        self.compliance = self.unit / scale
        lower = np.negative(base, dtype=np.float32)
        del base
        self.fields = begun(cells.take(state.gap, np.float32, 1 / scale), lower, upper)
        self.blocks = self.fields.blocks()
        self.power = self.level = self.overlap = 0.0
        self.iterations = self.convolutions = 0
        self.history: list[float] = []
        self._precondition(operator, not worth(cells.shape) and loaded > TRANSFORMED * state.pressure.size)

    def _precondition(self, operator, by_transform: bool) -> None:
        factor = operator.e_prime / 4 / self.compliance
        self.stiffness: Any = None
        self.stencil: Stencil | None = None
        if by_transform:
            self.stiffness = (factor * wavenumber(self.cells.shape, operator.spacing)).astype(np.float32)
        else:
            self.stencil = Stencil(self.cells.shape, operator.spacing, operator.boundary, self.cells.index, factor)

    def run(self, tolerance: float, limit: int) -> None:
        """Iterate until the residual on these cells is <= tolerance, until it no longer falls, or ``limit`` times."""
        best, waiting = math.inf, 0
        while True:
            self._look()
            worst = self._worst(tolerance)
            self.history.append(worst)
            best, waiting = (worst, 0) if worst < 0.9 * best else (best, waiting + 1)
            if worst <= tolerance or waiting > PATIENCE or self.iterations == limit:
                return
            self.iterations += 1
            if self.iterations in NARROWINGS and self._narrowed():
                self._look()
            self._step(self._turn())

    def found(self, pressure) -> np.ndarray:
        """``pressure`` [Pa], the field with which the search began, with its changes."""
        values = self.cells.take(pressure)
        for b in self.blocks:
            own = values[b.part]
            own += np.multiply(b.change, self.unit, dtype=float)
            own *= b.change > b.lower
            np.maximum(own, 0.0, out=own)
            if b.upper is not None:
                np.copyto(own, self.hardness, where=b.change >= b.upper)
        return self.cells.spread(values)

    def _look(self) -> None:
        """Mark the free cells, and find the residue on them and the deepest overlap."""
        if self.fields.upper is not None and self.given:
            self._follow()
        count, height = self._mark()
        if self.fields.upper is None and self.given and count:
            self.level = height / count
        self.count, self.overlap = count, 0.0
        for b in self.blocks:
            np.subtract(b.gap, np.float32(self.level), out=b.residue)
            b.residue *= b.weight
            lowest = b.residue if b.upper is None else np.multiply(b.residue, b.change < b.upper, out=b.spare[1])
            self.overlap = max(self.overlap, -float(lowest.min()))

    def _worst(self, tolerance: float) -> float:
        """The worst residual on these cells. Overlap is the worst as a rule, so the others are not looked at while it
        is above ``tolerance``."""
        if self.overlap > tolerance:
            return self.overlap
        total = misfit = 0.0
        for b in self.blocks:
            pressure, apart, _, _ = b.spare
            np.subtract(b.change, b.lower, out=pressure)
            total += float(pressure.sum())
            misfit += dot(pressure, np.abs(b.residue, out=apart))
        excess = abs(total - self.load) / self.load if self.given else 0.0
        return max(self.overlap, misfit / total if total > 0 else math.inf, excess)

    def _follow(self) -> None:
        """The zero level of the gap where cells may yield: the mean gap in elastic contact, or a value between the
        highest yielded and the lowest free cell."""
        f = self.fields
        yielded = f.change >= f.upper
        inside = (f.change > f.lower) & ~yielded
        if inside.any():
            self.level = float(f.gap[inside].mean())
        elif yielded.any():
            highest = float(f.gap[yielded].max())
            self.level = 0.5 * (highest + float(f.gap[~yielded].min(initial=highest)))

    def _mark(self) -> tuple[int, float]:
        """Mark the free cells; returns their number and the sum of the gap on them."""
        count, height = 0, 0.0
        for b in self.blocks:
            _, _, free, inside = b.spare
            np.less(b.gap, np.float32(self.level), out=free)
            np.greater(b.change, b.lower, out=inside)
            if b.upper is not None:
                yielded = b.change >= b.upper
                free ^= yielded
                inside &= ~yielded
            free |= inside
            b.weight[...] = free
            count += int(np.count_nonzero(free))
            height += dot(b.gap, b.weight)
        return count, height

    def _narrowed(self) -> bool:
        """Leave out the cells that came nowhere near contact, if they are many."""
        f, near = self.fields, self._near()
        if not 0 < np.count_nonzero(near) <= WORTH * near.size:
            return False
        kept = np.flatnonzero(near)
        self.cells = self.cells.narrowed(kept)
        self.target -= float(f.change.sum()) - float(f.change.take(kept).sum())
        self.blocks = []  # they hold on to the fields as they were
        f.narrow(kept)
        self.blocks = f.blocks()
        if self.stencil is not None:
            self.stencil = self.stencil.on(self.cells.index)
        return True

    def _near(self) -> np.ndarray:
        """Flags of the cells that are in contact, were, or came near it."""
        near = self.fields.gap < self.level + NEAR * self.overlap
        for b in self.blocks:
            number, _, flag, _ = b.spare
            own = near[b.part]
            own |= np.greater(b.weight, 0, out=flag)
            pressure = np.abs(np.subtract(b.known, b.lower, out=number), out=number)
            own |= np.greater(pressure, FORGOTTEN, out=flag)
            own |= np.greater(b.change, b.lower, out=flag)
        return near

    def _turn(self) -> np.float32:
        """Conjugate direction on the free cells (Polak-Ribiere, never negative). Returns its mean on them, which is
        still in it: a given load does not change along a direction."""
        f = self.fields
        if self.stencil is not None:
            self.stencil.apply(f.residue, f.trial)
        else:
            field = self.cells.field(f.residue)
            f.trial[:] = self.cells.gather(filtered(field, self.stiffness, field.shape, self.cells.operator.workers))
            self.convolutions += 1
        power = sum(dot(b.residue, b.trial) for b in self.blocks)
        cross = sum(dot(b.before, b.trial) for b in self.blocks)
        keep = np.float32(max(0.0, (power - cross) / self.power) if self.power > 0 else 0.0)
        lean = 0.0
        for b in self.blocks:
            b.direction *= keep
            b.direction -= b.trial
            lean += dot(b.direction, b.weight) if self.given else 0.0
        self.power = power
        for each in (f, *self.blocks):
            each.residue, each.before = each.before, each.residue
        return np.float32(lean / max(self.count, 1))

    def _step(self, mean: np.float32) -> None:
        """Go from the known pressure towards the trial, by the step that is exact along that change. ``mean``: what
        `_turn` has left in the direction."""
        self._try(mean)
        for b in self.blocks:
            np.subtract(b.trial, b.known, out=b.residue)
        answer = self._answer(self.fields.residue)
        slope = curvature = 0.0
        for b in self.blocks:
            asked = np.subtract(b.trial, b.change, out=b.spare[0])
            slope += dot(b.before, asked)
            curvature += dot(asked, answer[b.part])
        curvature *= self.compliance
        step = -slope / curvature if curvature > 0 else 1.0
        step = min(max(step, STEPS[0] if self.given else 0.0), STEPS[1])
        self.pace *= max(step, STEPS[0]) ** LEARNING
        for b in self.blocks:
            b.move(answer[b.part], step, step * self.compliance)

    def _try(self, mean: np.float32) -> None:
        """Make the trial: the change of pressure by one pace along the direction less its ``mean``, within the limits
        and with the load."""
        pace, carried = np.float32(self.pace), 0.0
        for b in self.blocks:
            b.without(mean)
            np.multiply(b.direction, pace, out=b.residue)
            b.residue += b.change
            carried += b.aimed(b.residue)
        shift = 0.0
        for _ in range(SHIFTS if self.given else 0):
            missing = self.target - carried
            if abs(missing) <= self.slack:
                return
            count = sum(b.movable() for b in self.blocks)
            if not count:
                break
            shift += missing / count
            carried = 0.0
            for b in self.blocks:
                aim = np.multiply(b.weight, np.float32(shift), out=b.spare[0])
                aim += b.residue
                carried += b.aimed(aim)
        if self.given:
            self._project()

    def _project(self) -> None:
        """Make the trial by a bracketed shift of all cells, in double precision.

        This is needed when few of many cells stay in contact, or when the free cells cannot carry their share. Then all
        cells are free, and the direction is not kept.
        """
        f = self.fields
        base = np.negative(f.lower, dtype=float)
        pressure = with_load(base + f.residue, self.target + float(base.sum()), self.hardness / self.unit)
        f.trial[:] = self._rounded(pressure, base, np.s_[:])
        np.subtract(f.gap, np.float32(self.level), out=f.before)
        self.power = 0.0

    def _rounded(self, pressure, base, cells) -> np.ndarray:
        """Change of the pressure on ``cells`` in single precision, the limits met to the last digit."""
        f = self.fields
        change = np.where(pressure <= 0, f.lower[cells], (pressure - base).astype(np.float32))
        if f.upper is not None:
            change = np.where(pressure >= self.hardness / self.unit, f.upper[cells], change)
        return change

    def _answer(self, way) -> np.ndarray:
        """Deflection under a change of pressure, to be multiplied by the compliance."""
        self.convolutions += 1
        return self.cells.gather(self.cells.operator.apply(self.cells.field(way)))
