"""Waves across the motion on one body of a smooth line contact, as `lubfric` has them: at rest, or moving in time.

The speed of the waves is that of their body over the entrainment speed U: 0 at rest, 1 in pure rolling, 0.5 and 1.5 at
slide-roll ratios of 1. The other body then slides over them at 2 |speed - 1| U.
"""

import math
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from lubfric.film import LineContact
from lubfric.models.deterministic import DeterministicResult, Problem, lay_out, moments, reach, solve_point
from lubfric.surface import Surface

PRECISION = 1e-9  # of the balances at rest
STEP_PRECISION = 1e-6  # of a step in time
SWEEP = 3.0  # half-widths that the film travels before anything counts


@dataclass(frozen=True)
class Smooth:
    """A smooth line contact, one cell wide: its ``problem`` and ``film``; ``speed`` of the waves that are to come."""

    problem: Problem
    film: DeterministicResult
    speed: float

    @property
    def half_width(self) -> float:
        """Half-width of Hertz [m]."""
        return self.problem.line.half_width

    @property
    def middle(self) -> int:
        """The cell at x = 0."""
        return int(np.argmin(np.abs(self.film.x)))


def laid_out(line: LineContact, speed: float, cells: float, ends: tuple[float, float] = (2.5, 1.5)) -> Smooth:
    """Return the contact with so many ``cells`` in a half-width, between its ``ends`` [half-widths]."""
    step = line.half_width / cells
    b = line.half_width
    flat = Surface(np.zeros((64, 1)), (step, step), periodic_axes=(True, True))
    sliding = 2 * abs(speed - 1) * line.entrainment_speed
    problem = lay_out(flat, line, sliding=sliding, boundary_friction=0.09, ends=(ends[0] * b, ends[1] * b))
    return Smooth(problem, solve_point(problem, tolerance=PRECISION), speed)


def smooth_film(line: LineContact, sliding: float) -> DeterministicResult:
    """Return the film without roughness by the deterministic model, on 512 cells."""
    step = sum(reach(line, 0.0)) / 512
    flat = Surface(np.zeros((64, 1)), (step, step), periodic_axes=(True, True))
    return solve_point(lay_out(flat, line, sliding=sliding, boundary_friction=0.09))


def at_rest(smooth: Smooth, k: float, height: float, phase: float = 0.0) -> DeterministicResult:
    """Return the film over waves ``height cos(k x - phase)`` [m] that rest."""
    wavy = replace(smooth.problem, heights=height * np.cos(k * smooth.film.x - phase)[:, None])
    return solve_point(wavy, start=smooth.film.state, tolerance=PRECISION)


def history(smooth: Smooth, k: float, height: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return times [s] of one period of moving waves of ``height`` [m], when their start is forgotten; gap [m] and
    pressure [Pa] then (time, x). In a step the lubricant moves by a cell, or nearly."""
    x = smooth.film.x
    pace = smooth.speed * smooth.problem.speed
    period = 2 * math.pi / (k * pace)
    count = max(8, round(period * smooth.problem.speed / smooth.problem.spacing[0]))
    first = math.ceil(SWEEP * smooth.half_width / smooth.problem.speed / (period / count))

    def problem(time: float) -> Problem:
        return replace(smooth.problem, heights=height * np.cos(k * (x - pace * time))[:, None])

    moving = moments(problem, period / count, start=smooth.film.state, tolerance=STEP_PRECISION)
    values = [(m.time, m.at.gap[:, 0], m.at.state.pressure[:, 0]) for m in islice(moving, first, first + count)]
    times, gaps, pressures = (np.array(part) for part in zip(*values))
    return times, gaps, pressures


def response(smooth: Smooth, k: float, height: float) -> tuple[np.ndarray, np.ndarray]:
    """Return change of gap [m/m] and pressure [Pa/m] per height of exp(i k x) at one moment, complex (nx,). ``height``
    [m] is small."""
    if not smooth.speed:
        two = [at_rest(smooth, k, height, phase) for phase in (0.0, math.pi / 2)]
        parts = [((film.gap - smooth.film.gap)[:, 0], (film.pressure - smooth.film.pressure)[:, 0]) for film in two]
        gap, pressure = (cos + 1j * sin for cos, sin in zip(*parts))
        return gap / height, pressure / height
    times, gaps, pressures = history(smooth, k, height)
    turn = 2 / times.size / height * np.exp(1j * k * smooth.speed * smooth.problem.speed * times)
    return turn @ gaps, turn @ pressures
