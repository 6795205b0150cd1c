"""The contract of a sample: all that you need to know to write one.

A sample represents the infinite rough line contact. Strip number k of a sample on given cells is always the same
surface, so that a longer sample contains a shorter one. A model requests strips and does not depend on the kind of
sample.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import replace
from typing import Self

from ..surface import Surface
from .cells import Cells

PIECE = 42.0  # correlation lengths along y: a piece on native cells, which shows what the cells of the sample change


class Sample(ABC):
    """A sample of a rough surface: a frozen dataclass with these attributes and methods.

    Attributes
    ----------
    cells : cells of a strip along x, and their length in native cells, those of the scene
    lengths : correlation lengths [m] at 1/e along x and y
    length : what one strip adds to the line [m], along y
    first, available : number of strips that are solved first, and that there are
    pieces : number of pieces that there are
    windows : whether each strip is a window of a measured map, which may differ from place to place
    exact_sq : whether every strip has the Sq of the surface
    is_single_patch : whether one patch is all that there is: its only strip, its only piece
    is_resolved : whether the rough half-space is solved on the cells of its strips; False: the contact is a curve, made
        of independent asperities, or from outside, and there is nothing to solve strip by strip
    bodies : of two rough bodies the part of each, where the sample is cut from maps of both; () else
    """

    cells: Cells
    lengths: tuple[float, float]
    length: float
    first: int
    available: int
    pieces: int
    windows: bool = False
    exact_sq: bool = False
    is_single_patch: bool = False
    is_resolved: bool = True
    bodies: tuple[Surface, ...] = ()

    @abstractmethod
    def joined(self, indices: Sequence[int]) -> Surface:
        """Join the strips of these numbers along y, the last to the first: one map on `cells`, periodic along y."""

    @abstractmethod
    def piece(self, index: int, length: float = PIECE) -> Surface:
        """Return piece ``index`` of `pieces`, on native cells, some ``length`` correlation lengths long.

        Every n-th of its cells, along each axis, gives the coarse cells to compare it with (`Cells.thinned`).
        """

    @abstractmethod
    def of_body(self, body: int) -> Sample:
        """Return the same strips of one of two rough bodies, number 0 or 1, with the other one flat."""

    @abstractmethod
    def rows_of(self, count: int) -> int:
        """Return the number of cells along y of the first ``count`` strips joined."""

    @property
    def rows(self) -> int:
        """The number of cells along y of one strip."""
        return self.rows_of(1)

    def stack(self, count: int) -> Surface:
        """Join the first ``count`` strips."""
        return self.joined(range(count))

    def strip(self, index: int) -> Surface:
        """Return strip ``index`` alone, its last rows passing into its first."""
        return self.joined([index])

    @property
    def map(self) -> Surface:
        """The map that the scene has: of a measured one the whole, else what is solved first."""
        return self.first_map()

    def first_map(self) -> Surface:
        """Return the map that is solved first; of a single patch on native cells."""
        return self.stack(self.first)

    def halved(self) -> Self:
        """Return the same sample on cells half as long."""
        return replace(self, cells=self.cells.halved())  # type: ignore[type-var]  # every sample is a dataclass

    def native(self) -> Self:
        """Return the same sample on native cells, those of the scene."""
        return self if self.cells.is_native else self.halved().native()
