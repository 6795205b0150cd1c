"""The cells of a strip: as long as the correlation length and the Hertz strip allow, in powers of two of the
scene's."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..errors import InputError
from ..scene import Bodies, Roughness, Scene, has_moving_roughness, longest_contact
from ..surface import Surface, correlation_length
from ..units import worded

# Cells in the shortest correlation length of the grid that a message suggests [-]. Not measured: a summit of a Gaussian
# surface is some correlation lengths wide.
EXAMPLE_CELLS = 10

# Longest correlation lengths along x of the grid that a message suggests [-]. Not measured.
EXAMPLE_LENGTHS_ALONG_X = 16.0

# Correlation length [m] for which a message suggests a grid where none is given. Not measured.
EXAMPLE_LENGTH = 1e-5

# Cells across the Hertz strip in a picture: an asperity contact of the built-in scene then has five across. Changes no
# number. A choice, by looking at the figures.
ACROSS = 40

# Cells in a correlation length, at least: with five f is within 1 % (docs/measurements.md, cells per correlation
# length), and pieces on shorter cells correct the rest.
CELLS_PER_LENGTH = 4.0

# Cells in the Hertz half-width along x, at least. Half as many change f of the scene "paper" by nothing, where the
# correlation length decides (`python -m verification.campaigns.constants`).
CELLS_PER_HALF_WIDTH = 2.0

# Cells in half of the length of the rough contact (`length_of_rough_contact`), at least, where roughness moves: with
# fewer the stated error by the cells of the deterministic model, in proportion to the third power of their length
# (docs/tolerances.md), is above 6 %. A needle roller with ridges along the motion had 72 % on 4 cells, 9 % on 8. A
# choice between error and work, which is in proportion to its square.
CELLS_PER_HALF_WIDTH_IN_MOTION = 6.0

# Cells along x come in multiples of this number, so that their transforms are fast and pieces can be thinned. A choice:
# it allows two halvings. Half and twice this value change f by up to 1.4 %, its interval by up to 1.3 % and the work by
# up to 40 % (constants.csv).
COLUMNS_MULTIPLE = 4

# Cells along y come in multiples of this number times a fast length of the transform, so that lengths can be halved
# four times.
ROWS_MULTIPLE = 16

# Height [Sq] up to which asperities may touch: 3 in a million points of a Gaussian surface are higher. A choice: a
# larger value takes wider strips. Half and twice this value change f by up to 1.8 %, its interval by up to 1.5 % and
# the work by up to 21 % (constants.csv).
HIGHEST_SUMMITS = 4.5


@dataclass(frozen=True)
class Cells:
    """The cells of a strip.

    - ``coarsening`` (fx, fy): length of a cell in native cells, those of the scene, of ``native_spacing`` [m].
    - ``columns``: number nx of cells along x, the first axis of arrays of heights (nx, ny).
    - ``first_x`` [m]: centre of the first native cell along x (None: such that the cells lie evenly about the line of
      contact).
    """

    coarsening: tuple[int, int]
    native_spacing: tuple[float, float]
    columns: int
    first_x: float | None = None

    @property
    def spacing(self) -> tuple[float, float]:
        """Length of a cell [m] along x and y."""
        return self.native_spacing[0] * self.coarsening[0], self.native_spacing[1] * self.coarsening[1]

    @property
    def is_native(self) -> bool:
        """Whether they are the scene's own."""
        return self.coarsening == (1, 1)

    def halved(self) -> Cells:
        """Return cells half as long along each axis, or as near to that as the scene's own cells allow."""
        coarsening = max(1, self.coarsening[0] // 2), max(1, self.coarsening[1] // 2)
        return replace(self, coarsening=coarsening, columns=self.columns * self.coarsening[0] // coarsening[0])

    def coarsenings(self) -> list[tuple[int, int]]:
        """Return the coarsening of these cells and of ever shorter ones, each half the one before, down to native."""
        steps = [self.coarsening]
        cells = self
        while not cells.is_native:
            cells = cells.halved()
            steps.append(cells.coarsening)
        return steps

    def coarsening_to_look_at(self, half_width: float) -> tuple[int, int]:
        """Return the longest coarsening, from that of these cells down to native ones, that leaves `ACROSS` cells in
        the Hertz strip of this ``half_width`` [m]; native cells where they are longer."""
        longest = self.longest_to_look_at(half_width)
        for coarsening in self.coarsenings():
            if max(n * step for n, step in zip(coarsening, self.native_spacing)) <= longest:
                return coarsening
        return (1, 1)

    @staticmethod
    def longest_to_look_at(half_width: float) -> float:
        """Return the length [m] of cells of which `ACROSS` are in the Hertz strip of this ``half_width`` [m]."""
        return 2 * half_width / ACROSS

    def rows(self, length: float) -> int:
        """Return the number of cells along y of a strip of about ``length`` [m]: one that suits the Fourier
        transform."""
        from scipy.fft import next_fast_len

        rows = max(1, round(length / (ROWS_MULTIPLE * self.spacing[1])))
        return ROWS_MULTIPLE * int(next_fast_len(rows, real=True))

    def axis(self, coarsening: tuple[int, int] | None = None) -> np.ndarray:
        """Return the cell centres [m] along x of these cells, or of those of another ``coarsening`` that share columns
        with them."""
        fx = self.coarsening[0]
        first = self.first_x
        if first is None:
            first = -0.5 * (self.columns - 1) * self.spacing[0] - fx // 2 * self.native_spacing[0]
        native_centres = first + np.arange(self.columns * fx) * self.native_spacing[0]
        step = fx if coarsening is None else coarsening[0]
        return native_centres[fx // 2 % step :: step]

    def thinned(self, heights: np.ndarray, coarsening: tuple[int, int]) -> np.ndarray:
        """Return every n-th of ``heights`` on native cells, n the ``coarsening`` along each axis; along x those at
        `axis`."""
        fx, fy = coarsening
        return heights[self.coarsening[0] // 2 % fx :: fx, fy // 2 :: fy]


def half_width_to_resolve(scene: Scene, sq: float) -> float:
    """Return the half-width [m] in which `CELLS_PER_HALF_WIDTH` cells are enough: that of the Hertz strip, or a part of
    that of the rough contact of ``sq`` [m] where roughness moves."""
    half_width = scene.bodies.half_width
    if has_moving_roughness(scene):
        return min(half_width, CELLS_PER_HALF_WIDTH * longest_cell_in_motion(scene, sq))
    return half_width


def longest_cell_in_motion(scene: Scene, sq: float) -> float:
    """Return the length [m] along x of the longest cells that resolve the rough contact of ``sq`` [m] where roughness
    moves (`CELLS_PER_HALF_WIDTH_IN_MOTION`)."""
    return 0.5 * _length_to(scene.bodies, sq) / CELLS_PER_HALF_WIDTH_IN_MOTION


def choose_cells(spacing: tuple[float, float], lengths: tuple[float, float], half_width: float, reach: float) -> Cells:
    """Return cells of which at least four are in each of the correlation ``lengths`` [m], and two in the half-width of
    the Hertz strip.

    Their lengths are ``spacing`` [m] times powers of two. Along x they cover at least ``reach`` [m].
    """
    fx, fy = longest_coarsening(spacing, lengths, half_width)
    return Cells(
        (fx, fy),
        (spacing[0], spacing[1]),
        COLUMNS_MULTIPLE * math.ceil(reach / (COLUMNS_MULTIPLE * fx * spacing[0]) - 1e-9),
    )


def cells_of_a_box(
    spacing: tuple[float, float],
    *,
    lengths: tuple[float, float],
    half_width: float,
    shape: tuple[int, int],
    first: float | None = None,
) -> Cells:
    """Return the largest cells over exactly the columns of ``shape``; where ``first`` is given, over exactly its rows
    too."""
    fx, fy = longest_coarsening(spacing, lengths, half_width)
    while shape[0] % (2 * fx) and fx > 1:
        fx //= 2
    while first is not None and shape[1] % (2 * fy) and fy > 1:
        fy //= 2
    return Cells((fx, fy), (spacing[0], spacing[1]), shape[0] // fx, first)


def correlation_lengths(rough: Roughness) -> tuple[float, float]:
    """Return the correlation lengths [m] at 1/e along x and y of a generated surface."""
    decay = -math.log(rough.decay_level)
    factor = decay if rough.acf == "exponential" else math.sqrt(decay)
    both = np.broadcast_to(np.asarray(rough.correlation_length, dtype=float), 2)
    return float(both[0]) / factor, float(both[1]) / factor


def no_cells(bodies: Sequence[Roughness], reach: float = 0.0, name: str = "surface") -> InputError:
    """Return the error of a generated surface ``name`` without cells, with an example: cells of a tenth of the shortest
    correlation length of the ``bodies``, as many as `EXAMPLE_LENGTHS_ALONG_X` of the longest one and ``reach`` [m]
    need."""
    known = [rough for rough in bodies if rough.correlation_length is not None]
    lengths = [length for rough in known for length in correlation_lengths(rough)] or [EXAMPLE_LENGTH]
    spacing = float(f"{min(lengths) / EXAMPLE_CELLS:.1g}")
    along = 32 * math.ceil(max(reach, EXAMPLE_LENGTHS_ALONG_X * max(lengths)) / spacing / 32)
    example = f'for example shape = [{along}, {along // 2}] and spacing = "{worded(spacing, "m")}"'
    return InputError(
        f"contact.shape and contact.spacing [m] are needed for a generated {name}",
        recommendation=f"{example}: twice the spacing is the shortest wavelength that the surface has",
    )


def length_or_half(surface: Surface, axis: int) -> float:
    """Return the correlation length [m] at 1/e; half the map where it is longer."""
    try:
        return correlation_length(surface, axis)
    except InputError:
        return 0.5 * surface.size[axis]


def reach_of(scene: Scene, sq: float) -> float:
    """Return the length [m] along x that contains the contact at all times: it ends where an undeformed cylinder,
    resting on the ends of the Hertz strip, has risen by `HIGHEST_SUMMITS` Sq."""
    rise = HIGHEST_SUMMITS * sq
    return _length_to(longest_contact(scene, rise).bodies, rise)


def length_of_rough_contact(scene: Scene, sq: float) -> float:
    """Return the length [m] along x below which the ends of a patch may cut the contact off, at some time of a run: an
    undeformed cylinder, resting on the ends of the Hertz strip, has risen by one Sq there.

    Of generated patches at loads of 0.5 to 40 times the roughness, those that ended at 0.25 and 0.5 Sq had more than 1
    % of the contact load on their edge columns, those at 1 Sq and above less.
    """
    return _length_to(longest_contact(scene, sq).bodies, sq)


def _length_to(bodies: Bodies, rise: float) -> float:
    """Return the length [m] along x between the places where the undeformed cylinder, resting on the ends of the Hertz
    strip of ``bodies``, has risen by ``rise`` [m]."""
    return 2 * math.sqrt(bodies.half_width**2 + 2 * bodies.radius * rise)


def longest_coarsening(
    spacing: tuple[float, float], lengths: tuple[float, float], half_width: float
) -> tuple[int, int]:
    """Return the coarsening, in powers of two, of the longest cells that still resolve the correlation ``lengths`` and
    the Hertz strip [m]."""
    along = min(lengths[0] / CELLS_PER_LENGTH, half_width / CELLS_PER_HALF_WIDTH)
    return _power_of_two(along / spacing[0]), _power_of_two(lengths[1] / (CELLS_PER_LENGTH * spacing[1]))


def _power_of_two(ratio: float) -> int:
    factor = 1
    while 2 * factor <= ratio * (1 + 1e-9):
        factor *= 2
    return factor
