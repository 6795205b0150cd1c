"""Lines from a measured map: windows, which lie across the motion, are cut from the map and stacked into one line."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..contact import extended
from ..errors import InputError
from ..scene import Scene
from ..surface import Surface, correlation_length
from .lines_cells import EVEN, Cells, choose_cells, reach_of

APART = 4.0  # correlation lengths along the motion between windows that are independent
BLEND = 2.0  # correlation lengths along y over which one window passes into the next
ENOUGH = 8  # windows for an honest standard error


@dataclass(frozen=True)
class MeasuredLines:
    """Lines of a measured ``surface``, on its own cells or on every second, fourth, ... of them.

    ``starts``: first columns of the windows that the map holds independently. They are used in this order, so that any
    number of them is spread over the map. A longer line contains the shorter ones. Beyond its ends the map is continued
    by its mirror image (`measured_lines`).
    """

    scene: Scene
    surface: Surface
    cells: Cells
    lengths: tuple[float, float]
    starts: tuple[int, ...]
    nested: bool = True
    exact_sq: bool = False

    @property
    def window(self) -> float:
        """Length [m] that one window adds to a line."""
        return (self.surface.shape[1] - self._blend()) * self.surface.spacing[1]

    @property
    def pieces(self) -> float:
        """One for each window."""
        return len(self.starts)

    @property
    def available(self) -> float:
        """Longest line [m] that the map holds."""
        unit, (count, step) = (
            4 * self.cells.factors[1],
            (self.surface.shape[1] - self._blend(), self.surface.spacing[1]),
        )
        return len(self.starts) * count // unit * unit * step

    def line(self, index: int, length: float) -> Surface:
        """The shortest line of whole windows that is at least ``length`` [m] long, or the line of all windows.
        ``index`` is not used."""
        count = min(len(self.starts), max(1, math.ceil(length / self.window * (1 - 1e-9))))
        fx, fy = self.cells.factors
        pieces = [self._columns(start)[fx // 2 :: fx] for start in self.starts[:count]]
        stacked = stack(pieces, self._blend())
        rows = stacked.shape[1] // (4 * fy) * 4 * fy
        note = f"{count} windows of {self.cells.count * fx} x {self.surface.shape[1]} cells, stacked along y"
        return self._made(stacked[:, fy // 2 : rows : fy], self.cells.coarse, note)

    def windows(self, length: float) -> int:
        """How many windows a line of ``length`` [m] holds."""
        return max(1, round(length / self.window))

    def pair(self, index: int, length: float) -> Surface:
        """A piece of window number ``index`` on the map's own cells."""
        fx, fy = self.cells.factors
        whole = self._columns(self.starts[index])
        blend, unit = self._blend(), 4 * fy
        rows = min(whole.shape[1] - blend, round(length / self.surface.spacing[1])) // unit * unit
        first = (whole.shape[1] - rows - blend) // 2
        piece = whole[:, first : first + rows + blend]
        return self._made(stack([piece], blend)[:, :rows], self.surface.spacing, "a piece on the map's own cells")

    def again(self, scene: Scene) -> MeasuredLines | None:
        """The same lines for another scene with the same windows."""
        other = measured_lines(scene, self.surface, self.lengths)
        return other if (other.cells, other.starts) == (self.cells, self.starts) else None

    def halved(self) -> MeasuredLines:
        """The same lines on cells half as long."""
        return replace(self, cells=self.cells.halved())

    def _blend(self) -> int:
        return min(max(1, round(BLEND * self.lengths[1] / self.surface.spacing[1])), self.surface.shape[1] // 4)

    def _columns(self, start: int) -> np.ndarray:
        columns = start + np.arange(self.cells.count * self.cells.factors[0])
        last = self.surface.shape[0] - 1
        return self.surface.heights[np.minimum(np.where(columns < 0, -1 - columns, columns), 2 * last + 1 - columns)]

    def _made(self, heights, spacing, note) -> Surface:
        return replace(
            self.surface,
            heights=heights,
            spacing=spacing,
            mask=None,
            periodic_axes=(False, True),
            notes=(*self.surface.notes, note),
        )


def stack(pieces, blend: int) -> np.ndarray:
    """Join arrays (nx, ny) one after the other along y, and the last to the first.

    The last ``blend`` cells of each are laid over the first of the next. Their weights are cos and sin, whose squares
    add to 1, about the mean of all.
    """
    mean = float(np.mean([p.mean() for p in pieces]))
    angle = 0.5 * np.pi * (np.arange(blend) + 0.5) / blend
    out = []
    for before, piece in zip([pieces[-1], *pieces[:-1]], pieces):
        part = piece[:, : piece.shape[1] - blend].copy()
        part[:, :blend] = mean + np.sin(angle) * (piece[:, :blend] - mean) + np.cos(angle) * (before[:, -blend:] - mean)
        out.append(part)
    return np.concatenate(out, axis=1)


def measured_lines(scene, surface: Surface, lengths: tuple[float, float] | None = None) -> MeasuredLines:
    """Lines of a measured map under the cylinder of ``scene``. The map is levelled and filled, with x along the motion.
    ``lengths``: its correlation lengths [m] along x and y, where they are known.

    A map with fewer than eight whole windows gets further ones, which reach over its ends. There it is continued by its
    mirror image. The Hertz strip of every window lies on the map itself: beyond the strip only single high summits
    touch.
    """
    if scene.contact.spacing is not None:
        surface = surface.resampled(spacing=scene.contact.spacing)
    reach = reach_of(scene, surface.sq)
    if extended(scene):
        surface = surface.continued(reach)
    half_width, (dx, _) = scene.bodies.half_width, surface.spacing
    lengths = lengths or (length_or_half(surface, 0), length_or_half(surface, 1))
    if scene.contact.shape is not None:
        reach = scene.contact.shape[0] * dx
    cells = choose_cells(surface.spacing, lengths, half_width, min(reach, surface.size[0]))
    fine = cells.count * cells.factors[0]
    while fine > surface.shape[0]:
        cells = replace(cells, count=cells.count - 4)
        fine = cells.count * cells.factors[0]
    if cells.count < 1:
        raise InputError(f"the map is {surface.shape[0]} cells long along x; allowed: at least {4 * cells.factors[0]}")
    step = max(1, round(max(APART * lengths[0], 2 * half_width) / dx))
    beyond = 0 if extended(scene) else min(max(0, math.floor(0.5 * fine - half_width / dx)), surface.shape[0])
    starts = _starts(surface.shape[0], fine, step, 0)
    if len(starts) < ENOUGH:
        starts = _starts(surface.shape[0], fine, step, beyond)
    found = MeasuredLines(scene, surface, cells, lengths, tuple(starts[i] for i in spread(len(starts))))
    if found.window < EVEN * cells.coarse[1] * (1 - 1e-9):
        raise InputError(
            f"the map is {surface.shape[1]} cells wide along y, across the motion: no line can be made of that; give a "
            f"wider one, or numerics.sampling = 'patch' (its rows go on along y as they are)"
        )
    return found


def _starts(count: int, window: int, step: int, beyond: int) -> list[int]:
    """First columns of windows that lie ``step`` apart on a map of ``count`` columns. ``beyond``: how many of them
    reach over either end."""
    room = count + 2 * beyond - window
    most = room // step
    return [(room - most * step) // 2 - beyond + step * k for k in range(most + 1)]


def length_or_half(surface: Surface, axis: int) -> float:
    """Correlation length [m] at 1/e; half the map where it is longer."""
    try:
        return correlation_length(surface, axis)
    except InputError:
        return 0.5 * surface.size[axis]


def spread(count: int) -> list[int]:
    """0 .. count - 1 in an order that begins in the middle, each number as far from those before as possible."""
    left = set(range(count))
    order: list[int] = []
    while left:
        middle = 0.5 * (count - 1)
        best = max(left, key=lambda i: (min((abs(i - j) for j in order), default=0), -abs(i - middle), -i))
        order.append(best)
        left.remove(best)
    return order
