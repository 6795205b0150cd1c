"""The sample of a rough surface: strips of it, each some 90 correlation lengths long across the motion.

Strip number k of a scene on given cells is always the same. `Strips.stack` joins the first strips to one line, which is
solved as one contact with one film and one approach. Strips come from an endless generated surface, from windows of a
measured map, or there is one only: the patch that a scene asks for, or a map that was given.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from .._base import FieldsOnly, validate
from ..contact.rough_contract import centred_axis
from ..errors import InputError
from ..quantities import counted
from ..scene import ROUGH, Roughness, Scene, moves
from ..surface import Surface, surface_generator
from .cells import (
    EVEN,
    Cells,
    blend_of,
    cells_of_a_box,
    choose_cells,
    correlation_lengths,
    length_or_half,
    reach_of,
    spread,
    stacked,
    starts_of,
)
from .maps import (
    extended,
    measured,
    rough_bodies,
    statistics,
    whole_maps,
)

# correlation lengths: of a strip, of a piece on the scene's own cells
STRIP = 90.0
PIECE = 42.0
WIDE = 5.0  # correlation lengths along x in b: from there a strip half as long has spots enough, and where roughness
PASSING = 30.0  # moves, one of so many
FIRST = 180.0  # correlation lengths that are solved first
MOST = 46080.0  # correlation lengths, at most
MOST_CELLS = 3_000_000  # of a stack: memory
KEPT_CELLS = 2_000_000  # of the strips from which a longer stack goes on
APART = 4.0  # correlation lengths along the motion between windows that are independent
ENOUGH = 8  # windows for an honest standard error
# streams of seeds
STRIPS = 0
PIECES = 1


@dataclass(frozen=True)
class Strips:
    """Strips of the surface of ``scene`` on ``cells``.

    ``lengths`` [m]: correlation lengths at 1/e along x and y; ``length`` [m]: what one strip adds to a stack;
    ``first``, ``available``: number of strips that are solved first, and that there are; ``pieces``: number of pieces.
    ``windows``: whether each strip is a window of a measured map, which may differ from place to place. ``exact_sq``:
    whether every strip has the Sq of the surface; ``whole``: whether a piece is all that there is. ``bodies``: of a
    measured map, or of a patch, that two bodies make up, the part of each.
    """

    scene: Scene
    cells: Cells
    lengths: tuple[float, float]
    length: float
    first: int = 1
    available: int = 1
    pieces: int = 1
    windows: bool = False
    exact_sq: bool = False
    is_single_patch: bool = False
    bodies: tuple[Surface, ...] = ()

    @property
    def rows(self) -> int:
        """The number of cells along y of one strip."""
        raise NotImplementedError

    def joined(self, indices: Sequence[int]) -> Surface:
        """The strips of these numbers joined along y, the last to the first: periodic, on ``cells``."""
        raise NotImplementedError

    def stack(self, count: int) -> Surface:
        """The first ``count`` strips joined."""
        return self.joined(range(count))

    def strip(self, index: int) -> Surface:
        """Strip number ``index`` alone, its last rows passing into its first."""
        return self.joined([index])

    def piece(self, index: int, length: float = PIECE) -> Surface:
        """A piece on the scene's own cells, some ``length`` correlation lengths long: number ``index`` of ``pieces``.
        Every n-th of its cells, in each direction, gives the coarse cells to compare it with."""
        raise NotImplementedError

    def halved(self) -> Strips:
        """The same strips on cells half as long."""
        return replace(self, cells=self.cells.halved())


@dataclass(frozen=True)
class GeneratedStrips(FieldsOnly, Strips):
    """Strips of one endless generated surface, or of two whose heights are added."""

    @property
    def rows(self) -> int:
        return self.cells.rows(self.length)

    def joined(self, indices: Sequence[int]) -> Surface:
        blend = blend_of(self.lengths[1], self.cells.coarse[1])
        shape = self.cells.count, self.rows + blend
        known = self._known
        strip = self._generator(STRIPS, self.cells.coarse, shape)
        strips = [known.get(index) or strip(index) for index in indices]
        known.update((i, s) for i, s in zip(indices, strips) if i < KEPT_CELLS // math.prod(shape))
        return replace(strips[0], heights=stacked([strip.heights for strip in strips], blend))

    def piece(self, index: int, length: float = PIECE) -> Surface:
        fx, fy = self.cells.coarsening
        rows = self.cells.rows(length * self.lengths[1]) * fy
        return self._generator(PIECES, self.cells.spacing, (self.cells.count * fx, rows))(index)

    @cached_property
    def _known(self) -> dict[int, Surface]:
        """The first strips that were made so far, by their number, on which alone they depend."""
        return {}

    def _generator(self, stream: int, spacing, shape) -> Callable[[int], Surface]:
        """The function that makes a map of the ``stream`` from its number."""
        bodies = [_one_body(rough, name, stream, spacing, shape) for rough, name in rough_bodies(self.scene)]

        def made(index: int) -> Surface:
            first, *others = (body(index) for body in bodies)
            return first.combined(*others) if others else first

        return made


def _one_body(rough: Roughness, name: str, stream: int, spacing, shape) -> Callable[[int], Surface]:
    make = surface_generator((shape[0] * rough.oversize, shape[1]), spacing, **statistics(rough))

    def made(index: int) -> Surface:
        words = (rough.seed, stream, index, *(() if name == "surface" else (1,)))  # far apart for neighbouring numbers
        surface = make(int(np.random.SeedSequence(words).generate_state(1)[0]))
        return surface if rough.oversize == 1 else surface.cropped(shape).scaled(sq=rough.sq or 0.0)

    return made


@dataclass(frozen=True)
class MeasuredStrips(Strips):
    """Windows of a measured ``surface``, on its own cells or on every second, fourth, ... of them.

    ``starts``: first columns of the windows that the map holds independently. They are used in this order, so that any
    number of them is spread over the map. Beyond its ends the map is continued by its mirror image.
    """

    surface: Surface = field(kw_only=True)
    starts: tuple[int, ...] = field(kw_only=True)

    @property
    def rows(self) -> int:
        return self._rows(self.surface.shape[1] - self._blend)

    def joined(self, indices: Sequence[int]) -> Surface:
        fx, fy = self.cells.coarsening
        pieces = [self._columns(self.starts[index])[fx // 2 :: fx] for index in indices]
        heights = stacked(pieces, self._blend)
        rows = self._rows(heights.shape[1]) * fy
        shape = f"{self.cells.count * fx} x {self.surface.shape[1]} cells"
        note = f"{counted(len(pieces), 'windows')} of {shape}, stacked along y"
        return self._made(heights[:, fy // 2 : rows : fy], self.cells.coarse, note)

    def piece(self, index: int, length: float = PIECE) -> Surface:
        whole = self._columns(self.starts[index])
        blend = self._blend
        unit = 4 * self.cells.coarsening[1]
        wanted = round(length * self.lengths[1] / self.surface.spacing[1])
        rows = min(whole.shape[1] - blend, wanted) // unit * unit
        first = (whole.shape[1] - rows - blend) // 2
        piece = stacked([whole[:, first : first + rows + blend]], blend)[:, :rows]
        return self._made(piece, self.surface.spacing, "a piece on the map's own cells")

    def _rows(self, columns: int) -> int:
        """The number of cells along y on so many ``columns`` of the map: a multiple of four."""
        return columns // (4 * self.cells.coarsening[1]) * 4

    @property
    def _blend(self) -> int:
        return min(blend_of(self.lengths[1], self.surface.spacing[1]), self.surface.shape[1] // 4)

    def _columns(self, start: int) -> np.ndarray:
        columns = start + np.arange(self.cells.count * self.cells.coarsening[0])
        last = self.surface.shape[0] - 1
        return self.surface.heights[np.minimum(np.where(columns < 0, -1 - columns, columns), 2 * last + 1 - columns)]

    def _made(self, heights, spacing, note) -> Surface:
        notes = (*self.surface.notes, note)
        new = {"heights": heights, "spacing": spacing, "periodic_axes": (False, True), "notes": notes}
        return replace(self.surface, mask=None, **new)


@dataclass(frozen=True)
class OnePatch(Strips):
    """One patch, ``surface``, of which there is no more."""

    surface: Surface = field(kw_only=True)

    @property
    def rows(self) -> int:
        return self.surface.shape[1] // self.cells.coarsening[1]

    def joined(self, indices: Sequence[int]) -> Surface:
        heights = self.cells.thinned(self.surface.heights, self.cells.coarsening)
        return replace(self.surface, heights=heights, spacing=self.cells.coarse, mask=None)

    def piece(self, index: int, length: float = PIECE) -> Surface:
        return self.surface


def strips_of(scene: Scene) -> Strips:
    """Strips of the scene's surface, generated or measured; on the scene's own cells if ``numerics.grid`` is given."""
    found: Strips = measured_strips(scene, *whole_maps(scene)) if measured(scene) else generated_strips(scene)
    while scene.numerics.grid == "given" and not found.cells.is_native:
        found = found.halved()
    return found


def alone(strips: Strips, body: int) -> Strips:
    """The same strips of one of two rough bodies, number 0 or 1, with the other one flat."""
    if isinstance(strips, (MeasuredStrips, OnePatch)):
        return replace(strips, surface=strips.bodies[body])
    other = ROUGH[1 - body]
    smooth = replace(getattr(strips.scene, other), sq=0.0)
    return replace(strips, scene=replace(strips.scene, **{other: smooth}))


def generated_strips(scene: Scene) -> GeneratedStrips:
    """Strips of the generated surface of ``scene``. Along x they are as long as its patch, or as the contact if that is
    longer; where the patch is the area A, as the patch."""
    patch = scene.contact
    bodies = [rough for rough, _ in rough_bodies(scene)]
    if patch.shape is None or patch.spacing is None:
        raise InputError("contact.shape and contact.spacing [m] are needed for a generated surface")
    spacing = validate.spacing("contact.spacing", patch.spacing)
    half_width = scene.bodies.half_width
    along_x, along_y = zip(*(correlation_lengths(rough) for rough in bodies if rough.sq))
    shortest = (min(along_x), min(along_y))
    lengths = (max(along_x), max(along_y))
    if patch.region == "box":
        cells = cells_of_a_box(spacing, shortest, half_width, patch.shape)
    else:
        sq = math.hypot(*(rough.sq or 0.0 for rough in bodies))
        cells = choose_cells(spacing, shortest, half_width, max(patch.shape[0] * spacing[0], reach_of(scene, sq)))
    narrow = WIDE * lengths[0] / half_width
    long = STRIP if narrow > 1 else STRIP / 2
    if moves(scene):  # other places pass through the contact in time
        long = min(STRIP, PASSING * max(1.0, narrow))
    length = min(long * lengths[1], MOST_CELLS / 2 / cells.count * cells.coarse[1])
    available = int(min(MOST / long, MOST_CELLS / (cells.count * cells.rows(length))))
    first = min(round(FIRST / long), available)
    return GeneratedStrips(scene, cells, lengths, length, first, available, available, exact_sq=len(bodies) == 1)


def measured_strips(scene: Scene, surface: Surface, *bodies: Surface) -> MeasuredStrips:
    """Windows of a measured map under the cylinder of ``scene``. The map is levelled and filled, with x along the
    motion. ``bodies``: the part of each of two.

    A map with fewer than eight whole windows gets further ones, which reach over its ends, where it is continued by its
    mirror image. The Hertz strip of every window lies on the map itself: beyond it only single high summits touch.
    """
    maps = surface, *bodies
    if scene.contact.spacing is not None:
        maps = tuple(one.resampled(spacing=scene.contact.spacing) for one in maps)
    reach = reach_of(scene, maps[0].sq)
    surface, *parts = (one.continued(reach) for one in maps) if extended(scene) else maps
    half_width = scene.bodies.half_width
    (dx, _) = surface.spacing
    lengths = length_or_half(surface, 0), length_or_half(surface, 1)
    if scene.contact.shape is not None:
        reach = scene.contact.shape[0] * dx
    cells = choose_cells(surface.spacing, lengths, half_width, min(reach, surface.size[0]))
    while cells.count * cells.coarsening[0] > surface.shape[0]:
        cells = replace(cells, count=cells.count - EVEN)
    if cells.count < 1:
        raise InputError(
            f"the map is {surface.shape[0]} cells long along x; allowed: at least {4 * cells.coarsening[0]}"
        )
    fine = cells.count * cells.coarsening[0]
    step = max(1, round(max(APART * lengths[0], 2 * half_width) / dx))
    beyond = 0 if extended(scene) else min(max(0, math.floor(0.5 * fine - half_width / dx)), surface.shape[0])
    starts = starts_of(surface.shape[0], fine, step, 0)
    if len(starts) < ENOUGH:
        starts = starts_of(surface.shape[0], fine, step, beyond)
    kept = surface.shape[1] - min(blend_of(lengths[1], surface.spacing[1]), surface.shape[1] // 4)
    length = kept * surface.spacing[1]
    count = len(starts)
    if length < EVEN * cells.coarse[1] * (1 - 1e-9):
        raise InputError(
            f"the map is {surface.shape[1]} cells wide along y, across the motion: no line can be made of that; give a "
            f"wider one, or numerics.sampling = 'patch' (its rows go on along y as they are)"
        )
    most = max(1, min(count, int(MOST_CELLS * cells.coarse[1] / (cells.count * length))))
    first = min(most, max(1, math.ceil(FIRST * lengths[1] / length * (1 - 1e-9))))
    starts = [starts[i] for i in spread(count)]
    own: dict[str, Any] = {"surface": surface, "bodies": tuple(parts), "starts": tuple(starts), "windows": True}
    return MeasuredStrips(scene, cells, lengths, length, first, most, count, **own)


def one_patch(scene: Scene, lengths: tuple[float, float], surface: Surface, *bodies: Surface) -> OnePatch:
    """The patch ``surface`` of ``scene``, of correlation ``lengths`` [m], on cells that divide its own. ``bodies``: the
    part of each of two."""
    first = float(centred_axis(surface.shape[0], surface.spacing[0])[0])
    cells = cells_of_a_box(surface.spacing, lengths, scene.bodies.half_width, surface.shape, first)
    while scene.numerics.grid == "given" and not cells.is_native:
        cells = cells.halved()
    return OnePatch(scene, cells, lengths, surface.size[1], is_single_patch=True, surface=surface, bodies=bodies)
