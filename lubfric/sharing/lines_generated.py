"""Lines of a generated surface: pieces of one endless surface, as many and as long as needed."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .._base import spacing as checked_spacing
from ..contact import rough_bodies
from ..errors import InputError
from ..scene import Roughness, Scene
from ..surface import Surface, generate_surface
from .lines_cells import Cells, cells_of_a_box, choose_cells, reach_of

LINE, PAIR = 0, 1  # streams of seeds


@dataclass(frozen=True)
class GeneratedLines:
    """Lines of the surface of ``scene`` on ``cells``; correlation ``lengths`` [m] at 1/e along x and y."""

    scene: Scene
    cells: Cells
    lengths: tuple[float, float]
    available: float = math.inf
    pieces: float = math.inf
    nested: bool = False

    @property
    def exact_sq(self) -> bool:
        """True for the roughness of one body. The sum of two bodies has the Sq that it happens to have."""
        return len(rough_bodies(self.scene)) == 1

    def windows(self, length: float) -> int:
        """A generated line is one piece."""
        return 1

    def line(self, index: int, length: float) -> Surface:
        """Line number ``index``, about ``length`` [m] long, on the coarse cells."""
        return self._piece((LINE, index), self.cells, length)

    def pair(self, index: int, length: float) -> Surface:
        """A piece on the scene's own cells. Every n-th of its cells, in each direction, gives the coarse cells to
        compare it with."""
        fx, fy = self.cells.factors
        columns = self.cells.columns(length) * fy
        return self._piece((PAIR, index), Cells((1, 1), self.cells.spacing, self.cells.count * fx), length, columns)

    def again(self, scene: Scene) -> GeneratedLines | None:
        """The same lines for another scene with the same cells."""
        other = generated_lines(scene)
        return other if other.cells == self.cells else None

    def halved(self) -> GeneratedLines:
        """The same lines on cells half as long."""
        return GeneratedLines(self.scene, self.cells.halved(), self.lengths)

    def _piece(self, stream, cells: Cells, length: float, columns: int | None = None) -> Surface:
        shape = cells.count, columns or cells.columns(length)
        maps = [_one_body(rough, name, stream, cells, shape) for rough, name in rough_bodies(self.scene)]
        return maps[0] if len(maps) == 1 else maps[0].combined(maps[1])


def _one_body(rough: Roughness, name: str, stream, cells: Cells, shape) -> Surface:
    surface = generate_surface(
        (shape[0] * rough.oversize, shape[1]),
        cells.coarse,
        sq=rough.sq,
        correlation_length=rough.correlation_length,
        acf=rough.acf,
        decay_level=rough.decay_level,
        seed=seed_of(rough.seed, *stream, *(() if name == "surface" else (1,))),
    )
    return surface if rough.oversize == 1 else surface.cropped(shape).scaled(sq=rough.sq or 0.0)


def generated_lines(scene: Scene) -> GeneratedLines:
    """Lines of the generated surface of ``scene``, with the heights of both bodies added.

    Along x they are as long as the patch of the scene, or as long as the contact if that is longer. Where the patch is
    the area A, they are as long as the patch.
    """
    patch, bodies = scene.contact, [rough for rough, _ in rough_bodies(scene)]
    if patch.shape is None or patch.spacing is None:
        raise InputError("contact.shape and contact.spacing [m] are needed for a generated surface")
    spacing, half_width = checked_spacing("contact.spacing", patch.spacing), scene.bodies.half_width
    along_x, along_y = zip(*(lengths_of(rough) for rough in bodies if rough.sq))
    lengths, blocks = (min(along_x), min(along_y)), (max(along_x), max(along_y))
    if patch.region == "box":
        return GeneratedLines(scene, cells_of_a_box(spacing, lengths, half_width, patch.shape[0]), blocks)
    sq = math.hypot(*(rough.sq or 0.0 for rough in bodies))
    reach = max(patch.shape[0] * spacing[0], reach_of(scene, sq))
    return GeneratedLines(scene, choose_cells(spacing, lengths, half_width, reach), blocks)


def lengths_of(rough) -> tuple[float, float]:
    """Correlation lengths [m] at 1/e along x and y."""
    decay = -math.log(rough.decay_level)
    factor = decay if rough.acf == "exponential" else math.sqrt(decay)
    both = np.broadcast_to(np.asarray(rough.correlation_length, dtype=float), 2)
    return float(both[0]) / factor, float(both[1]) / factor


def seed_of(*words: int) -> int:
    """One seed from several numbers; far apart for neighbouring numbers."""
    return int(np.random.SeedSequence(words).generate_state(1)[0])
