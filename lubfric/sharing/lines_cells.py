"""The cells of a long line: as long as the correlation length and the Hertz strip allow."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

CELLS_PER_LENGTH = 4.0  # of the correlation length
CELLS_PER_HALF_WIDTH = 2.0  # of the Hertz strip, along x
EVEN = 4  # cells along x come in fours: two coarser grids to start from
FAST = 16  # and along y in sixteens
SUMMITS = 4.5  # Sq


@dataclass(frozen=True)
class Cells:
    """Cells of a line: ``factors`` (fx, fy) of the scene's own ``spacing`` [m], ``count`` along x."""

    factors: tuple[int, int]
    spacing: tuple[float, float]
    count: int

    @property
    def coarse(self) -> tuple[float, float]:
        """Spacing [m] of the line."""
        return self.spacing[0] * self.factors[0], self.spacing[1] * self.factors[1]

    def halved(self) -> Cells:
        """Cells half as long along each axis, or as near to that as the scene's own cells allow."""
        factors = max(1, self.factors[0] // 2), max(1, self.factors[1] // 2)
        return Cells(factors, self.spacing, self.count * self.factors[0] // factors[0])

    def columns(self, length: float) -> int:
        """Number of cells along y of a line of about ``length`` [m]: one that suits the Fourier transform and can be
        halved."""
        from scipy.fft import next_fast_len

        return FAST * next_fast_len(max(1, round(length / (FAST * self.coarse[1]))), real=True)

    def axis(self) -> np.ndarray:
        """Cell centres [m] along x about the line of contact."""
        return (np.arange(self.count) - 0.5 * (self.count - 1)) * self.coarse[0]


def choose_cells(spacing, lengths, half_width: float, reach: float) -> Cells:
    """Choose the cells: at least four in each of the correlation ``lengths`` [m], and two in the half-width of the
    strip.

    Their lengths are ``spacing`` [m] times powers of two. Along x they cover at least ``reach`` [m].
    """
    fx, fy = _factors(spacing, lengths, half_width)
    return Cells((fx, fy), tuple(spacing), EVEN * math.ceil(reach / (EVEN * fx * spacing[0]) - 1e-9))


def cells_of_a_box(spacing, lengths, half_width: float, columns: int) -> Cells:
    """The same cells over exactly ``columns`` of the scene's own cells along x."""
    fx, fy = _factors(spacing, lengths, half_width)
    while columns % fx:
        fx //= 2
    return Cells((fx, fy), tuple(spacing), columns // fx)


def reach_of(scene, sq: float) -> float:
    """Length [m] along x that contains the contact: it ends where an undeformed cylinder, resting on the ends of the
    Hertz strip, has risen by `SUMMITS` Sq."""
    bodies = scene.bodies
    return 2 * math.sqrt(bodies.half_width**2 + 2 * bodies.radius * SUMMITS * sq)


def _factors(spacing, lengths, half_width: float) -> tuple[int, int]:
    along = min(lengths[0] / CELLS_PER_LENGTH, half_width / CELLS_PER_HALF_WIDTH)
    return _power_of_two(along / spacing[0]), _power_of_two(lengths[1] / (CELLS_PER_LENGTH * spacing[1]))


def _power_of_two(ratio: float) -> int:
    factor = 1
    while 2 * factor <= ratio * (1 + 1e-9):
        factor *= 2
    return factor
