"""Samples of strips, each some 90 correlation lengths long across the motion: of an endless generated surface, or
windows of a measured map.

`Sample.joined` joins the first strips to one line, which load sharing solves as one contact with one film and one
approach.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from .._base import FieldsOnly, FloatArray, validate
from ..errors import InputError
from ..quantities import counted
from ..scene import ROUGH_SECTIONS, Roughness, Scene, has_moving_roughness, longest_contact
from ..surface import Surface, surface_generator
from .cells import (
    COLUMNS_MULTIPLE,
    Cells,
    cells_of_a_box,
    choose_cells,
    correlation_lengths,
    half_width_to_resolve,
    length_or_half,
    no_cells,
    reach_of,
)
from .contract import PIECE_LENGTH, Sample
from .maps import is_extended, is_measured, rough_bodies, statistics, whole_maps
from .windows import blend_of, joined_maps, spread_order, starts_of

# Correlation lengths along y of a strip: ten blocks of nine lengths (models/shared/statistics.py). A choice: longer
# strips may be longer than a point needs. Half and twice this value change f by up to 3.8 %, its interval by up to 2.5
# % and the work by up to 10 % less (constants.csv).
STRIP_LENGTHS = 90.0

# Correlation lengths in the Hertz half-width from which on a strip half as long has as many asperity contacts. Not
# measured.
WIDE_HALF_WIDTH = 5.0

# Correlation lengths along y of a strip whose roughness moves, where the half-width has `WIDE_HALF_WIDTH` of them:
# other places pass through the contact in time. Not measured: the sampling error is reported with a strip of any
# length.
MOVING_STRIP_LENGTHS = 30.0

# Correlation lengths of the `Sample.first_strips`: 20 blocks, whose scatter is known to 1/sqrt(38) = 16 %. Half and
# twice as many change f by up to 1.7 %, within the sampling tolerance of 2 % (`python -m
# verification.campaigns.constants`).
FIRST_LENGTHS = 180.0

# Correlation lengths, at most: 512 strips. A sample that needs more is stated with the error it has. A choice: a larger
# value takes longer and more memory.
MOST_LENGTHS = 46080.0

# Cells of joined strips, at most, for memory: 24 MB for each field. A choice: a larger value takes more memory, a
# smaller one leaves wide contacts shorter strips.
MOST_JOINED_CELLS = 3_000_000

# Cells of the strips that are kept for a longer sample, at most, for memory: 16 MB of heights. A choice: a smaller
# value makes strips again.
KEPT_CELLS = 2_000_000

# Correlation lengths along the motion between windows of a measured map that count as independent: a Gaussian
# correlation is 1e-7 there, an exponential one 0.02. A choice between these.
WINDOW_DISTANCE = 4.0

# A window passes into the next one on its width over this [-], at most. A choice: most of a window stays as measured.
LEAST_OVER_BLEND = 4

# Rows of a window of a measured map, and of a piece, are a multiple of this [-], so that cells can be joined twice. A
# choice: more cuts off more rows.
WINDOW_ROWS_MULTIPLE = 4

# Windows from which on none has to reach over the ends of the map: their scatter is known to 1/sqrt(14) = 27 %. A
# choice: a larger value lets windows reach over the ends of more maps.
ENOUGH_WINDOWS = 8

# Deviation of the Sq of strips from that of their map, relative, below which it is not stated. A convention.
SMALL_DEVIATION = 0.02

# Half of the 95 % interval of a normal distribution over its standard deviation. By definition.
NORMAL_REACH = 1.96

# Stream of seeds of strips. A choice: any number, but another than that of pieces.
SEEDS_OF_STRIPS = 0

# Stream of seeds of pieces. A choice: another one than that of strips.
SEEDS_OF_PIECES = 1


@dataclass(frozen=True, kw_only=True)
class GeneratedStrips(FieldsOnly, Sample):
    """Strips of one endless generated surface, or of two whose heights are added.

    ``roughness``: of each rough body, with its section of the scene.
    """

    cells: Cells
    correlation_lengths: tuple[float, float]
    strip_length: float
    first_strips: int
    available_strips: int
    available_pieces: int
    has_exact_sq: bool
    roughness: tuple[tuple[Roughness, str], ...]

    def rows_of(self, count: int) -> int:
        return count * self.cells.rows(self.strip_length)

    def of_body(self, body: int) -> GeneratedStrips:
        smooth = ROUGH_SECTIONS[1 - body]
        parts = ((replace(rough, sq=0.0) if name == smooth else rough, name) for rough, name in self.roughness)
        return replace(self, roughness=tuple(parts))

    def joined(self, indices: Sequence[int]) -> Surface:
        blend = blend_of(self.correlation_lengths[1], self.cells.spacing[1])
        shape = self._shape_of_strip
        known = self._known
        strips = [known.get(index) or self._made_strip(index) for index in indices]
        known.update((i, s) for i, s in zip(indices, strips) if i < KEPT_CELLS // math.prod(shape))
        return replace(strips[0], heights=joined_maps([strip.heights for strip in strips], blend))

    def piece(self, index: int, length: float = PIECE_LENGTH) -> Surface:
        fx, fy = self.cells.coarsening
        rows = self.cells.rows(length * self.correlation_lengths[1]) * fy
        return self._generator(SEEDS_OF_PIECES, self.cells.native_spacing, (self.cells.columns * fx, rows))(index)

    @cached_property
    def _known(self) -> dict[int, Surface]:
        """The first strips that were made so far, by their number, on which alone they depend."""
        return {}

    @property
    def sq(self) -> float:
        return math.hypot(*(rough.sq or 0.0 for rough, _ in self.roughness))

    @property
    def lengths_by_slopes(self) -> tuple[float, float]:
        """The mean square of the slopes of a Gaussian surface is 2 Sq²/l². That of two is the sum of both."""
        if any(rough.acf != "gaussian" or not rough.sq for rough, _ in self.roughness):
            return self.correlation_lengths
        lengths = np.array([correlation_lengths(rough) for rough, _ in self.roughness])
        squares = np.array([rough.sq or 0.0 for rough, _ in self.roughness]) ** 2
        (along, across) = np.sqrt(squares.sum() / (squares / lengths.T**2).sum(axis=1))
        return float(along), float(across)

    @property
    def _shape_of_strip(self) -> tuple[int, int]:
        """Cells of a strip along x and y, with those that blend into the next strip."""
        return self.cells.columns, self.rows + blend_of(self.correlation_lengths[1], self.cells.spacing[1])

    @cached_property
    def _made_strip(self) -> Callable[[int], Surface]:
        """The function that makes a strip from its number. All have one spectrum, which takes as long as a strip."""
        return self._generator(SEEDS_OF_STRIPS, self.cells.spacing, self._shape_of_strip)

    def _generator(self, stream: int, spacing: tuple[float, float], shape: tuple[int, int]) -> Callable[[int], Surface]:
        """Return the function that makes a map of the ``stream`` from its number."""
        bodies = [_one_body(rough, name, stream, spacing, shape) for rough, name in self.roughness]

        def made(index: int) -> Surface:
            first, *others = (body(index) for body in bodies)
            return first.combined(*others) if others else first

        return made


def _one_body(
    rough: Roughness, name: str, stream: int, spacing: tuple[float, float], shape: tuple[int, int]
) -> Callable[[int], Surface]:
    make = surface_generator((shape[0] * rough.oversize, shape[1]), spacing, **statistics(rough))

    def made(index: int) -> Surface:
        words = (rough.seed, stream, index, *(() if name == "surface" else (1,)))  # far apart for neighbouring numbers
        surface = make(int(np.random.SeedSequence(words).generate_state(1)[0]))
        return surface if rough.oversize == 1 else surface.cropped(shape).scaled(sq=rough.sq or 0.0)

    return made


@dataclass(frozen=True, kw_only=True)
class MeasuredStrips(Sample):
    """Windows of a measured ``surface``, on its own cells or on every second, fourth, ... of them.

    ``starts``: first columns of the windows that the map holds independently. They are used in this order, so that any
    number of them is spread over the map. Beyond its ends the map is continued by its mirror image.
    """

    cells: Cells
    correlation_lengths: tuple[float, float]
    strip_length: float
    first_strips: int
    available_strips: int
    available_pieces: int
    surface: Surface
    starts: tuple[int, ...]
    bodies: tuple[Surface, ...] = ()
    maps_before_extension: tuple[Surface, ...] = ()
    is_homogeneous: bool = False

    def rows_of(self, count: int) -> int:
        return self._rows(count * (self.surface.shape[1] - self._blend))

    def of_body(self, body: int) -> MeasuredStrips:
        return replace(self, surface=self.bodies[body])

    @property
    def whole_map(self) -> Surface:
        return self.surface

    def map_in_words(self, surface: Surface) -> str:
        return self.surface.describe()

    def described(self, surface: Surface) -> list[str]:
        (deviation, explained) = self.sq_deviation(surface)
        lines = super().described(surface)
        if abs(deviation) < SMALL_DEVIATION:
            return lines
        side = "above" if deviation > 0 else "below"
        return [
            *lines,
            f"Sq of the strips is {100 * abs(deviation):.2g} % {side} that of the map (a sample of this size differs "
            f"by up to {float(f'{100 * explained:.2g}'):g} % at 95 %)",
        ]

    def sq_deviation(self, surface: Surface) -> tuple[float, float]:
        """Return how far Sq of ``surface`` deviates from that of the map (`Sample.sq_deviation`).

        The variance of heights over an area A scatters by (Sku - 1)/N, and falls short by that of their mean, 2/N or
        less, where A has N = A/(π lx ly/2) independent places: the integral of the squared autocorrelation, of a
        Gaussian and of an exponential one alike (Bendat and Piersol, Random Data, ch. 8)."""
        whole = self.surface
        if whole.sq == 0 or surface.sq == 0:
            return 0.0, 0.0
        area = min(math.prod(surface.size), math.prod(whole.size))  # windows overlap
        part = 0.5 * math.pi * math.prod(self.correlation_lengths) / area
        scatter = 0.5 * math.sqrt(max(whole.sku - 1.0, 0.0) * part)
        return surface.sq / whole.sq - 1.0, NORMAL_REACH * scatter + part

    def ends_after(self, count: int) -> bool:
        return count >= self.available_strips

    def strips_without_extension(self, scene: Scene) -> int:
        parts = {name: {"extension": "none"} for _, name in rough_bodies(scene)}
        plain = scene.with_(**parts)
        surface = self.maps_before_extension[0]
        cells = _cells_of_map(plain, surface, self.correlation_lengths, reach_of(scene, self.surface.sq))
        return len(_window_starts(plain, surface, self.correlation_lengths, cells, surface.shape[0]))

    def joined(self, indices: Sequence[int]) -> Surface:
        fx, fy = self.cells.coarsening
        windows = [self._columns(self.starts[index])[fx // 2 :: fx] for index in indices]
        heights = joined_maps(windows, self._blend)
        rows = self._rows(heights.shape[1]) * fy
        shape = f"{self.cells.columns * fx} x {self.surface.shape[1]} cells"
        lengths = (1e6 * count * self.surface.spacing[1] for count in (rows, len(windows) * self.surface.shape[1]))
        used, measured = (f"{length:.5g} µm" for length in lengths)
        note = (
            f"{counted(len(windows), 'windows')} of {shape}, joined along y; {used} of their {measured} are used: each "
            f"window passes smoothly into the next one, and the last into the first, over {self._blend} cells, so that "
            f"no edge carries load, and the length is a whole multiple of {WINDOW_ROWS_MULTIPLE} cells of "
            f"{1e6 * self.cells.spacing[1]:.3g} µm"
        )
        return self._made(heights[:, fy // 2 : rows : fy], self.cells.spacing, note)

    def piece(self, index: int, length: float = PIECE_LENGTH) -> Surface:
        return self._piece(index, length)

    def pictured_piece(self, length: float = PIECE_LENGTH) -> Surface:
        return self._piece(0, length, int(self._columns(self.starts[0]).max(axis=0).argmax()))

    def _piece(self, index: int, length: float, row: int | None = None) -> Surface:
        """Return a `piece` in the middle of its window, or around ``row`` of it, as far as the window goes."""
        window = self._columns(self.starts[index])
        blend = self._blend
        rows = self._rows_of_piece(length)
        most = window.shape[1] - rows - blend
        middle = most // 2 if row is None else min(max(row - (rows + blend) // 2, 0), most)
        first = 0 if self.piece_is_strip(length) else middle
        piece = joined_maps([window[:, first : first + rows + blend]], blend)[:, :rows]
        return self._made(piece, self.surface.spacing, "a piece on the map's own cells")

    def length_of_piece(self, length: float) -> float:
        return self._rows_of_piece(length) * self.surface.spacing[1]

    def piece_is_strip(self, length: float) -> bool:
        (_, fy) = self.cells.coarsening
        return self._rows_of_piece(length) == self.rows_of(1) * fy

    def _rows_of_piece(self, length: float) -> int:
        """Return the number of native rows of a piece of this ``length`` [correlation lengths]."""
        unit = WINDOW_ROWS_MULTIPLE * self.cells.coarsening[1]
        wanted = round(length * self.correlation_lengths[1] / self.surface.spacing[1])
        return min(self.surface.shape[1] - self._blend, wanted) // unit * unit

    def _rows(self, native_rows: int) -> int:
        """Return the number of cells along y on so many ``native_rows`` of the map: a `WINDOW_ROWS_MULTIPLE`."""
        return native_rows // (WINDOW_ROWS_MULTIPLE * self.cells.coarsening[1]) * WINDOW_ROWS_MULTIPLE

    @property
    def _blend(self) -> int:
        return _blended_rows(self.surface, self.correlation_lengths)

    def _columns(self, start: int) -> np.ndarray:
        columns = start + np.arange(self.cells.columns * self.cells.coarsening[0])
        last = self.surface.shape[0] - 1
        return self.surface.heights[np.minimum(np.where(columns < 0, -1 - columns, columns), 2 * last + 1 - columns)]

    def _made(self, heights: FloatArray, spacing: tuple[float, float], note: str) -> Surface:
        notes = (*self.surface.notes, note)
        new: dict[str, Any] = {"heights": heights, "spacing": spacing, "periodic_axes": (False, True), "notes": notes}
        return replace(self.surface, mask=None, **new)


def strips_of(scene: Scene, read: tuple[Surface, ...] = ()) -> Sample:
    """Return strips of the scene's surface, generated or measured. ``read``: the measured maps, if `whole_maps` read
    them before."""
    return measured_strips(scene, *(read or whole_maps(scene))) if is_measured(scene) else generated_strips(scene)


def generated_strips(scene: Scene) -> GeneratedStrips:
    """Return strips of the generated surface of ``scene``. Along x they are as long as its patch, or as the contact if
    that is longer; where the patch is the area A, as the patch."""
    section = scene.contact
    bodies = [rough for rough, _ in rough_bodies(scene)]
    sq = math.hypot(*(rough.sq or 0.0 for rough in bodies))
    if section.shape is None or section.spacing is None:
        raise no_cells(bodies, reach_of(scene, sq))
    spacing = validate.spacing("contact.spacing", section.spacing)
    half_width = scene.bodies.half_width
    along_x, along_y = zip(*(correlation_lengths(rough) for rough in bodies if rough.sq))
    shortest = (min(along_x), min(along_y))
    lengths = (max(along_x), max(along_y))
    if section.region == "box":
        cells = cells_of_a_box(
            spacing, lengths=shortest, half_width=half_width_to_resolve(scene, sq), shape=section.shape
        )
    else:
        cells = choose_cells(
            spacing, shortest, half_width_to_resolve(scene, sq), max(section.shape[0] * spacing[0], reach_of(scene, sq))
        )
    narrow = WIDE_HALF_WIDTH * lengths[0] / half_width
    length_ratio = STRIP_LENGTHS if narrow > 1 else STRIP_LENGTHS / 2  # of a strip, over the correlation length along y
    if has_moving_roughness(scene):  # other places pass through the contact in time
        length_ratio = min(STRIP_LENGTHS, MOVING_STRIP_LENGTHS * max(1.0, narrow))
    length = min(length_ratio * lengths[1], MOST_JOINED_CELLS / 2 / cells.columns * cells.spacing[1])
    available = int(min(MOST_LENGTHS / length_ratio, MOST_JOINED_CELLS / (cells.columns * cells.rows(length))))
    first = min(round(FIRST_LENGTHS / length_ratio), available)
    return GeneratedStrips(
        cells=cells,
        correlation_lengths=lengths,
        strip_length=length,
        first_strips=first,
        available_strips=available,
        available_pieces=available,
        has_exact_sq=len(bodies) == 1 and bodies[0].sk is None,
        roughness=tuple(rough_bodies(scene)),
    )


def measured_strips(scene: Scene, surface: Surface, *bodies: Surface) -> MeasuredStrips:
    """Return windows of a measured map under the cylinder of ``scene``. The map is levelled and filled, with x along
    the motion. ``bodies``: the part of each of two.

    A map with fewer than eight complete windows gets further ones, which reach over its ends, where it is continued by
    its mirror image. The Hertz strip of every window lies on the map itself: beyond it only single high summits touch.
    """
    maps = surface, *bodies
    if scene.contact.spacing is not None:
        maps = tuple(each.resampled(spacing=scene.contact.spacing) for each in maps)
    reach = reach_of(scene, maps[0].sq)
    surface, *parts = (each.continued(reach) for each in maps) if is_extended(scene) else maps
    lengths = length_or_half(surface, 0), length_or_half(surface, 1)
    cells = _cells_of_map(scene, surface, lengths, reach)
    starts = _window_starts(scene, surface, lengths, cells, maps[0].shape[0])
    kept = surface.shape[1] - _blended_rows(surface, lengths)
    length = kept * surface.spacing[1]
    count = len(starts)
    if length < WINDOW_ROWS_MULTIPLE * cells.spacing[1] * (1 - 1e-9):
        raise InputError(
            f"the map is {surface.shape[1]} cells wide along y, across the motion, too few for a line contact; give a "
            f"wider one, or numerics.sampling = 'patch' (periodic along y)"
        )
    most = max(1, min(count, int(MOST_JOINED_CELLS * cells.spacing[1] / (cells.columns * length))))
    first = min(most, max(1, math.ceil(FIRST_LENGTHS * lengths[1] / length * (1 - 1e-9))))
    starts = [starts[i] for i in spread_order(count)]
    return MeasuredStrips(
        cells=cells,
        correlation_lengths=lengths,
        strip_length=length,
        first_strips=first,
        available_strips=most,
        available_pieces=count,
        surface=surface,
        starts=tuple(starts),
        bodies=tuple(parts),
        maps_before_extension=tuple(maps[1:] or maps),
    )


def _blended_rows(surface: Surface, lengths: tuple[float, float]) -> int:
    """Return on how many rows a window of the map ``surface``, of correlation ``lengths`` [m], passes into the next
    one."""
    return min(blend_of(lengths[1], surface.spacing[1]), surface.shape[1] // LEAST_OVER_BLEND)


def _cells_of_map(scene: Scene, surface: Surface, lengths: tuple[float, float], reach: float) -> Cells:
    """Return the cells of windows of the map ``surface``, of correlation ``lengths`` [m], that are ``reach`` [m] long
    along x, or as long as the patch of the scene or the map."""
    if scene.contact.shape is not None:
        reach = scene.contact.shape[0] * surface.spacing[0]
    cells = choose_cells(
        surface.spacing, lengths, half_width_to_resolve(scene, surface.sq), min(reach, surface.size[0])
    )
    while cells.columns * cells.coarsening[0] > surface.shape[0]:
        cells = replace(cells, columns=cells.columns - COLUMNS_MULTIPLE)
    if cells.columns < 1:
        raise InputError(
            f"the map is {surface.shape[0]} cells long along x; allowed: at least "
            f"{COLUMNS_MULTIPLE * cells.coarsening[0]}"
        )
    return cells


def _window_starts(
    scene: Scene, surface: Surface, lengths: tuple[float, float], cells: Cells, columns_of_map: int
) -> list[int]:
    """Return the first columns of windows that the map ``surface`` holds independently, on these ``cells``; where they
    are few, of windows that reach over the ends of its first ``columns_of_map`` as well: what follows is their mirror
    image, under which the same asperities carry the load once more."""
    half_width = longest_contact(scene).bodies.half_width
    dx = surface.spacing[0]
    columns = cells.columns * cells.coarsening[0]
    step = max(1, round(max(WINDOW_DISTANCE * lengths[0], 2 * half_width) / dx))
    if columns <= columns_of_map:
        starts = starts_of(columns_of_map, columns, step, 0)
        if len(starts) >= ENOUGH_WINDOWS:
            return starts
    overhang = min(max(0, math.floor(0.5 * columns - half_width / dx)), surface.shape[0])
    if columns > columns_of_map + 2 * overhang:  # the Hertz strip is longer than the map, whose middle is under its own
        return [(columns_of_map - columns) // 2]
    return starts_of(columns_of_map, columns, step, overhang)
