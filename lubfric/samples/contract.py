"""The contract of a sample: all that you need to know to write one.

A sample represents the infinite rough line contact. Strip number k of a sample on given cells is always the same
surface, so that a longer sample contains a shorter one. A model requests strips.

What it does with them depends on four facts of the surface and the contact, not on the class of the sample:

- `Sample.represents_more`: whether the strips stand for a larger surface. Then f scatters with the choice of strips,
  and other strips show by how much; else nothing scatters, and no control and no reference points of other strips
  exist.
- `Sample.refines_in_place`: whether shorter cells show the same strip, down to native ones. Else strips on other cells
  are others, and pieces of the surface show what shorter cells change.
- `Sample.is_resolved`: whether cells of the surface are solved at all. A contact curve has no places along the line to
  compare, and no gap for a film to flow in.
- `Sample.is_homogeneous`: whether strips differ by chance alone. Windows of a measured map may also differ because the
  surface does, which blocks within them do not show.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from typing import Self

from .._base import FloatArray
from ..contact import HalfSpace, RoughContact
from ..scene import Numerics, Scene
from ..surface import Surface
from ..units import worded
from .cells import Cells
from .rough_contacts import half_space_contact_of

# Correlation lengths along y of a piece on native cells: eight blocks of five lengths (models/shared/statistics.py), so
# that a piece states its own error. A choice: eight blocks of `LEAST_BLOCK_LENGTH`, and what rounding takes.
PIECE_LENGTH = 42.0


class Sample(ABC):
    """A sample of a rough surface: a frozen dataclass with these attributes and methods.

    Attributes
    ----------
    cells : cells of a strip along x, and their length in native cells, those of the scene
    correlation_lengths : correlation lengths [m] at 1/e along x and y
    strip_length : what one strip adds to the line [m], along y
    first_strips, available_strips : number of strips on which a line is solved first, and that there are
    available_pieces : number of pieces that there are
    has_exact_sq : whether every strip has the Sq of the surface
    is_homogeneous : whether all strips are parts of one random surface; False: windows of a measured map
    represents_more : whether its strips stand for a larger surface; False: they are all of it
    refines_in_place : whether shorter cells, down to native ones, are those of the same strip; a piece is then all of
        it
    is_resolved : whether the rough half-space is solved on the cells of its strips; False: the contact is a curve, made
        of independent asperities, or from outside
    bodies : of two rough bodies the part of each, where the sample is cut from maps of both; () else
    """

    cells: Cells
    correlation_lengths: tuple[float, float]
    strip_length: float
    first_strips: int
    available_strips: int
    available_pieces: int
    has_exact_sq: bool = False
    is_homogeneous: bool = True
    represents_more: bool = True
    refines_in_place: bool = False
    is_resolved: bool = True
    bodies: tuple[Surface, ...] = ()

    @abstractmethod
    def joined(self, indices: Sequence[int]) -> Surface:
        """Join the strips of these numbers along y, the last to the first: one map on `cells`, periodic along y, whose
        ``source`` says in words what the surface is."""

    @abstractmethod
    def piece(self, index: int, length: float = PIECE_LENGTH) -> Surface:
        """Return piece ``index`` of `available_pieces`, on native cells, some ``length`` correlation lengths long.

        Every n-th of its cells, along each axis, gives the coarse cells to compare it with (`Cells.thinned`).
        """

    def pictured_piece(self, length: float = PIECE_LENGTH) -> Surface:
        """Return the piece of a picture, as `piece`: of a map around the highest summit of a window."""
        return self.piece(0, length)

    def length_of_piece(self, length: float) -> float:
        """Return the length [m] along y of a piece of this ``length`` [correlation lengths], no longer than the
        surface."""
        return length * self.correlation_lengths[1]

    def piece_is_strip(self, length: float) -> bool:
        """Return whether a piece of this ``length`` [correlation lengths] is all of the strip of the same number."""
        return False

    @abstractmethod
    def of_body(self, body: int) -> Sample:
        """Return the same strips of one of two rough bodies, number 0 or 1, with the other one flat."""

    @abstractmethod
    def rows_of(self, count: int) -> int:
        """Return the number of cells along y of the first ``count`` strips joined."""

    def contact(
        self, scene: Scene, count: int, operator: Callable[[tuple[int, int], tuple[float, float]], HalfSpace]
    ) -> RoughContact:
        """Return the rough contact of ``scene`` on the first ``count`` strips, joined.

        ``operator``: makes the half-space operator of a grid, or finds it, from its shape and its spacing [m].
        """
        surface = self.joined(range(count))
        heights = surface.heights - surface.heights.mean()
        made = operator(surface.shape, surface.spacing)
        return half_space_contact_of(scene, heights, surface.spacing, operator=made, x=self.cells.axis())

    def on_field_cells(self) -> Self:
        """Return this sample on the cells on which its fields are shown: native ones if these show the same strip."""
        return self.native() if self.refines_in_place else self

    def coarsening_to_look_at(self, half_width: float) -> tuple[int, int]:
        """Return the length, in native cells, of cells that show a contact of this ``half_width`` [m]; native ones if
        these are solved anyway."""
        return (1, 1) if self.refines_in_place else self.cells.coarsening_to_look_at(half_width)

    def distinct_rows(self, heights: FloatArray) -> int:
        """Return how many of the rows of ``heights`` (nx, ny), a strip or some joined, are not the image of others."""
        return int(heights.shape[1])

    def tolerance_between(self, numerics: Numerics) -> float:
        """Return the tolerance on f between two points: neighbours may be solved on different numbers of strips."""
        return math.hypot(numerics.tolerance, numerics.sampling_tolerance)

    def renewal_length(self, half_width: float) -> float:
        """Return the distance [m] that a surface moves until another part of it is in a Hertz strip of this
        ``half_width`` [m]; NaN where there is no other part."""
        return 2 * half_width + math.sqrt(math.pi) * self.correlation_lengths[0]

    def in_words(self, count: int) -> str:
        """Return what the first ``count`` strips are, in words."""
        return "strip 1" if count == 1 else f"the first {count} strips, joined"

    def piece_in_words(self) -> str:
        """Return what a piece is, in words."""
        return "a piece of the surface"

    def piece_on_cells_in_words(self, spacing: tuple[float, float]) -> str:
        """Return what a piece on cells of this ``spacing`` [m] is, in words."""
        dx, dy = (f"{1e6 * step:.3g}" for step in spacing)
        return f"{self.piece_in_words()}, on cells of {dx} x {dy} µm"

    def described(self, surface: Surface) -> list[str]:
        """Return in words the map that the scene has, and ``surface``, its `stated_map`."""
        joined = (
            f"the first {self.first_strips} strips, joined along the line" if self.first_strips > 1 else "one strip"
        )
        statistics = (
            f"statistics of {joined}, whose Sq the lambda ratio of a steady point uses: "
            f"{replace(surface, source='').describe()}"
        )
        return [self.map_in_words(surface), statistics]

    def sq_deviation(self, surface: Surface) -> tuple[float, float]:
        """Return by how much, relative, the Sq of ``surface``, the `stated_map`, is above that of the `whole_map`, and
        the difference that a sample of this size explains, at 95 %. Zeros: both are the same map."""
        return 0.0, 0.0

    def map_in_words(self, surface: Surface) -> str:
        """Return in words the map that the scene has, of which ``surface`` is the `stated_map`."""
        length = worded(self.line_length(1), "m")
        return f"{surface.source}, sampled as an infinite line contact by strips of {length}; the sampling error sets their number"

    def ends_after(self, count: int) -> bool:
        """Return whether the surface itself, not the work on it, ends after ``count`` strips."""
        return False

    @property
    def refinement(self) -> tuple[int, int]:
        """How many times shorter the cells of a strip can be made along each axis while it remains the same surface:
        (1, 1) where strips on other cells are others."""
        return self.cells.coarsening if self.refines_in_place else (1, 1)

    def line_length(self, count: int) -> float:
        """Return the length [m] of the first ``count`` strips joined."""
        return self.rows_of(count) * self.cells.spacing[1]

    @property
    def rows(self) -> int:
        """The number of cells along y of one strip."""
        return self.rows_of(1)

    def strip(self, index: int) -> Surface:
        """Return strip ``index`` alone, its last rows passing into its first."""
        return self.joined([index])

    @property
    def lengths_by_slopes(self) -> tuple[float, float]:
        """Correlation lengths [m] along x and y by which cells are judged: of a Gaussian surface that has the slopes of
        this one. They are ``correlation_lengths``, but for two bodies with unlike ones."""
        return self.correlation_lengths

    def stated_map(self) -> Surface:
        """Return the map whose statistics are stated, as Sq: the `first_strips`, joined on `cells`; of a single patch
        all of it, on native cells. A prepared scene has it as its surface."""
        return self.joined(range(self.first_strips))

    @property
    def whole_map(self) -> Surface:
        """The map that the scene has: a measured one, of which strips are windows; else the `stated_map`."""
        return self.stated_map()

    @property
    def sq(self) -> float:
        """Sq [m] of the surface: of all of a measured map, or as it is generated."""
        return self.whole_map.sq

    @property
    def maps_before_extension(self) -> tuple[Surface, ...]:
        """The map of each rough body, or the only one of all, before it is continued by its mirror image."""
        return self.bodies or (self.whole_map,)

    def strips_without_extension(self, scene: Scene) -> int:
        """Return how many strips the maps of ``scene`` hold if none of them is continued by its mirror image."""
        return self.available_strips

    def is_on_surface_of(self, other: Sample) -> bool:
        """Return whether this sample is the ``other`` one, on the same cells or on others: `halved`, `native`."""
        names = [part.name for part in fields(self) if part.name != "cells"]  # type: ignore[arg-type]  # a dataclass
        return type(self) is type(other) and all(getattr(self, name) is getattr(other, name) for name in names)

    def halved(self) -> Self:
        """Return the same sample on cells half as long."""
        return replace(self, cells=self.cells.halved())  # type: ignore[type-var]  # every sample is a dataclass

    def native(self) -> Self:
        """Return the same sample on native cells, those of the scene."""
        return self if self.cells.is_native else self.halved().native()
