"""Single-precision search for a better pressure on the cells that may touch: one convolution an iteration.

Unknown is the change of the pressure since the gap was last computed in double precision, so that rounding is
relative to the change. The free cells, whose pressure may change, are in elastic contact (0 < p < H), overlap without
pressure, or have yielded and opened; on them the gap is the gradient of the energy. A conjugate direction (|k|, the
inverse of the half-space, as preconditioner; kept when the set changes, where I. A. Polonsky and L. M. Keer, Wear 231
(1999) 206-219, doi:10.1016/S0043-1648(99)00113-1 restart) leads by a length learnt from the steps before to a trial,
which is cut to 0..H and made to carry the load. What is convolved is the way from the *known* pressure, whose gap is
at hand, to the trial; the step along it is exact. What the new pressure has more than the known one (cells cut
again) is convolved together with the next trial.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..halfspace.operator import filtered, wavenumber
from .projection import with_load
from .residual import dot
from .stencil import Stencil

FIRST_PACE = 0.35  # of the step that the preconditioner would take were it the inverse
LOAD_ERROR = 1e-6  # of the load, in the trials of a round; less in later ones, in proportion to the residual
LEARNING = 0.3  # power of the relative length of a step in the next pace
STEPS = (0.3, 2.0)  # of the way to the trial
SHIFTS = 12  # of a trial at most
TRANSFORMED = 0.7  # share of contact from which the preconditioner is the transform, not nine points
REACH = 2.0  # of the deepest overlap: cells with a gap below it may come into touch
NARROWINGS = (4, 8, 12, 16, 24, 32)  # iterations after which cells are left out
NEAR, WORTH = 0.7, 0.8  # of the deepest overlap: gaps of cells that are kept; of the cells: most to be kept
FORGOTTEN = 1e-6  # of the mean pressure in contact: less is not waited for
FIELDS = ("lower", "upper", "gap", "change", "known", "direction", "residue")
HUGE = np.float32(1e20)  # times any pressure: beyond all others
CAPACITY = 0.999  # of the hardness times the free cells, beyond which they have to be more
PATIENCE = 8  # iterations without a tenth off the best residual


class Descent:
    """Fields on ``cells`` in single precision: pressures in units of the mean one in contact, gaps in those of its
    scale.

    ``state``: where it begins. ``load`` [Pa cells]: what the pressure has to carry, or None where the approach is
    prescribed. ``pace``: of an earlier descent, or `FIRST_PACE`.
    ``careful``: every step exact for the cells that are free, what the limits cut off convolved at once: two or three
    convolutions an iteration, and sure where the pressure is far from small changes of the set (nearly rigid bodies).
    """

    def __init__(self, problem, cells, state, load: float | None, pace: float, careful: bool):
        base, scale = cells.take(state.pressure), state.scale
        total, operator = float(base.sum()), problem.operator
        if not math.isfinite(scale):  # no pressure yet
            scale = max(-float(state.gap.min()), 1e-9 * max(problem.roughness, min(operator.spacing)))
        ripple = operator.e_prime * scale / min(operator.spacing)
        self.unit = total / np.count_nonzero(base) if total > 0 else ripple
        self.cells, self.pace, self.given = cells, pace, load is not None
        self.load = math.nan if load is None else load / self.unit
        self.target = 0.0 if load is None else (load - total) / self.unit
        self.slack = LOAD_ERROR * min(1.0, state.residual) * total / self.unit
        self.hardness = problem.hardness
        base /= self.unit
        self.lower = np.negative(base, dtype=np.float32)
        self.upper = None
        if math.isfinite(problem.hardness):
            self.upper = (problem.hardness / self.unit - base).astype(np.float32)
        self.gap = cells.take(state.gap, np.float32, 1 / scale)
        self.compliance = self.unit / scale
        self.change, self.known = np.zeros_like(self.gap), np.zeros_like(self.gap)
        self.direction: Any = None
        self.residue: Any = None
        self.power = 1.0
        self.level, self.iterations, self.convolutions = 0.0, 0, 0
        self.history: list[float] = []
        factor = operator.e_prime / 4 / self.compliance
        self.careful = careful
        self.stiffness: Any = None
        self.stencil: Stencil | None = None
        if careful or np.count_nonzero(base) > TRANSFORMED * state.pressure.size:
            self.stiffness = (factor * wavenumber(cells.shape, operator.spacing)).astype(np.float32)
        else:
            self.stencil = Stencil(cells.shape, operator.spacing, operator.boundary, cells.index, factor)

    def run(self, tolerance: float, limit: int) -> None:
        """Iterate until the residual is <= tolerance as far as these cells show, or falls no more, or ``limit``
        times."""
        best, waiting = math.inf, 0
        while True:
            free, weight, residue, worst = self._look()
            self.history.append(worst)
            best, waiting = (worst, 0) if worst < 0.9 * best else (best, waiting + 1)
            if worst <= tolerance or waiting > PATIENCE or self.iterations == limit:
                return
            self.iterations += 1
            if self.iterations in NARROWINGS and not self.careful and self._narrowed(free):
                free, weight, residue, worst = self._look()
            self._turn(weight, residue)
            if self.careful:
                self._move_carefully(free, residue)
            else:
                self._move(self._trial(free))

    def found(self, pressure) -> np.ndarray:
        """``pressure`` [Pa], the field it began with, changed."""
        values = self.cells.take(pressure)
        values += self.unit * self.change.astype(float)
        values[self.change <= self.lower] = 0.0
        np.maximum(values, 0.0, out=values)
        if self.upper is not None:
            values[self.change >= self.upper] = self.hardness
        return self.cells.spread(values)

    def _look(self):
        """Free cells (as flags and as 1 or 0), gap on them without its mean, and the worst residual."""
        inside = self.change > self.lower
        yielded = False
        if self.upper is not None:
            yielded = self.change >= self.upper
            inside &= ~yielded
            self._follow(inside, yielded)
        free = self.gap < self.level
        free ^= yielded
        free |= inside
        if self.careful and self.upper is not None and self.given:
            free = self._enough(free, yielded)
        weight = free.astype(np.float32)
        count = np.count_nonzero(free)
        if self.given and self.upper is None and count:
            self.level = dot(self.gap, weight) / count
        residue = self.gap - np.float32(self.level)
        residue *= weight
        size = np.abs(residue)
        total = float(self.change.sum()) - float(self.lower.sum())
        misfit = (dot(self.change, size) - dot(self.lower, size)) / total if total > 0 else math.inf
        overlap = -float(residue.min() if self.upper is None else residue[~yielded].min(initial=0.0))
        self.overlap = overlap
        excess = abs(total - self.load) / self.load if self.given else 0.0
        return free, weight, residue, max(overlap, misfit, excess)

    def _follow(self, inside, yielded) -> None:
        """Level where cells may yield: mean gap in elastic contact, or between the highest yielded and lowest free."""
        if not self.given:
            return
        if inside.any():
            self.level = float(self.gap[inside].mean())
        elif yielded.any():
            highest = float(self.gap[yielded].max())
            self.level = 0.5 * (highest + float(self.gap[~yielded].min(initial=highest)))

    def _enough(self, free, yielded) -> np.ndarray:
        """The free cells, or everything that has not yielded for good when they could not carry their share."""
        share = float((self.change - self.lower).sum(where=free)) + self.target - float(self.change.sum())
        limit = self.hardness / self.unit
        if share <= CAPACITY * limit * np.count_nonzero(free):
            return free
        return ~yielded | (self.gap > self.level)

    def _narrowed(self, free) -> bool:
        """Leave out cells that came nowhere near touch, where they are many."""
        near = self.gap < self.level + NEAR * self.overlap
        near |= free
        near |= np.abs(self.known - self.lower) > FORGOTTEN
        near |= self.change > self.lower
        if not 0 < np.count_nonzero(near) <= WORTH * near.size:
            return False
        kept = np.flatnonzero(near)
        self.cells = self.cells.narrowed(kept)
        self.target -= float(self.change.sum()) - float(self.change.take(kept).sum())
        for name in FIELDS:
            values = getattr(self, name)
            if values is not None:
                setattr(self, name, values.take(kept))
        if self.stencil is not None:
            self.stencil = self.stencil.on(self.cells.index)
        return True

    def _turn(self, weight, residue) -> None:
        """Conjugate direction on the free cells (Polak-Ribiere, never negative)."""
        steep = self._preconditioned(residue)
        power = dot(residue, steep)
        if self.direction is None:
            self.direction = np.negative(steep)
        else:
            keep = max(0.0, (power - dot(self.residue, steep)) / self.power) if self.power > 0 else 0.0
            self.direction *= np.float32(keep)
            self.direction -= steep
        if self.given:
            self.direction -= np.float32(dot(self.direction, weight) / max(weight.sum(), 1.0))
        self.direction *= weight
        self.residue, self.power = residue, power

    def _preconditioned(self, residue) -> np.ndarray:
        if self.stencil is not None:
            return self.stencil(residue)
        self.convolutions += 1
        field = self.cells.field(residue)
        return self.cells.gather(filtered(field, self.stiffness, field.shape, self.cells.operator.workers))

    def _trial(self, free) -> np.ndarray:
        """Change of pressure a pace along the direction, within the limits, with the load."""
        aim = np.float32(self.pace) * self.direction
        aim += self.change
        trial, shift = self._within(aim.copy()), 0.0
        if not self.given:
            return trial
        for _ in range(SHIFTS):
            missing = self.target - float(trial.sum())
            if abs(missing) <= self.slack:
                return trial
            movable = trial > self.lower
            if self.upper is not None:
                movable &= trial < self.upper
                movable &= free
            count = np.count_nonzero(movable)
            if not count:
                break
            shift += missing / count
            self._within(np.add(aim, np.float32(shift), out=trial))
            if self.upper is not None or shift > 0:
                np.copyto(trial, self.change, where=~free)
        return self._projected(aim)

    def _projected(self, aim) -> np.ndarray:
        """The trial by a bracketed shift of all cells, in double precision: where few of many cells stay in contact, or
        the free ones cannot carry their share."""
        base = np.negative(self.lower, dtype=float)
        limit = self.hardness / self.unit
        pressure = with_load(base + aim, self.target + float(base.sum()), limit)
        return self._rounded(pressure, base, np.s_[:])

    def _within(self, values) -> np.ndarray:
        np.maximum(values, self.lower, out=values)
        return values if self.upper is None else np.minimum(values, self.upper, out=values)

    def _rounded(self, pressure, base, cells) -> np.ndarray:
        """Change of the pressure on ``cells`` in single precision, the limits met to the last digit."""
        change = np.where(pressure <= 0, self.lower[cells], (pressure - base).astype(np.float32))
        if self.upper is not None:
            change = np.where(pressure >= self.hardness / self.unit, self.upper[cells], change)
        return change

    def _move_carefully(self, free, residue) -> None:
        """The step that is exact along the direction, then within the limits, with the load, on the free cells."""
        answer = self._answer(self.direction)
        curvature, slope = dot(self.direction, answer), dot(residue, self.direction)
        if not (curvature > 0 and slope < 0):
            self.direction = None
            return
        step = -slope / curvature
        aim = (self.change + np.float32(step) * self.direction)[free]
        base = np.negative(self.lower[free], dtype=float)
        new, limit = base + aim, self.hardness / self.unit
        if self.given:
            share = float((self.change - self.lower).sum(where=free)) + self.target - float(self.change.sum())
            new = with_load(new, share, limit)
        else:
            np.clip(new, 0.0, limit, out=new)
        way = np.negative(self.change)
        self.change[free] = self._rounded(new, base, free)
        way += self.change
        self.gap += self._answer(way)
        self.known[:] = self.change

    def _answer(self, way) -> np.ndarray:
        """Change of the gap under a change of pressure."""
        answer = self.cells.gather(self.cells.operator.apply(self.cells.field(way)))
        self.convolutions += 1
        return answer * np.float32(self.compliance)

    def _move(self, trial) -> None:
        """From the known pressure towards the trial, by the step that is exact along the change it asks for."""
        way = trial - self.known
        answer = self._answer(way)
        asked = np.subtract(trial, self.change, out=self.change)
        slope = dot(self.gap, asked) - self.level * float(asked.sum())
        curvature = dot(asked, answer)
        step = -slope / curvature if curvature > 0 else 1.0
        step = min(max(step, STEPS[0] if self.given else 0.0), STEPS[1])
        way *= np.float32(step)
        self.known += way
        answer *= np.float32(step)
        self.gap += answer
        self.pace *= max(step, STEPS[0]) ** LEARNING
        yielded = None if self.upper is None else trial >= self.upper
        np.maximum(self.known, self.lower, out=self.change)
        trial -= self.lower  # cells that the trial unloads stay so: without branches, of which a mask has many
        trial *= HUGE
        trial += self.lower
        np.minimum(self.change, trial, out=self.change)
        if self.upper is not None:
            np.minimum(self.change, self.upper, out=self.change)
            np.copyto(self.change, self.upper, where=yielded)
