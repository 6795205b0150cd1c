"""Samples of which there is no more: one patch that a scene requests, a map that was given, and contacts that have no
cells to solve strip by strip."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from .._base import FieldsOnly
from ..contact import centred_axis
from ..scene import Scene
from ..surface import Surface
from .cells import Cells, cells_of_a_box, length_or_half
from .contract import PIECE, Sample


@dataclass(frozen=True, kw_only=True)
class SinglePatch(Sample):
    """One patch, ``surface``, of which there is no more."""

    cells: Cells
    lengths: tuple[float, float]
    surface: Surface
    bodies: tuple[Surface, ...] = ()
    first: int = 1
    available: int = 1
    pieces: int = 1
    is_single_patch: bool = True

    @property
    def length(self) -> float:  # type: ignore[override]
        """Return the length of the patch along y [m]."""
        return self.surface.size[1]

    def joined(self, indices: Sequence[int]) -> Surface:
        heights = self.cells.thinned(self.surface.heights, self.cells.coarsening)
        return replace(self.surface, heights=heights, spacing=self.cells.coarse, mask=None)

    def piece(self, index: int, length: float = PIECE) -> Surface:
        return self.surface

    def first_map(self) -> Surface:
        return self.surface

    def of_body(self, body: int) -> SinglePatch:
        return replace(self, surface=self.bodies[body])

    def rows_of(self, count: int) -> int:
        return self.surface.shape[1] // self.cells.coarsening[1]


@dataclass(frozen=True)
class UnresolvedSample(FieldsOnly, Sample):
    """The map ``surface`` of a contact that is not solved on its cells: a contact curve, independent asperities, or a
    contact from outside."""

    surface: Surface
    first: int = 1
    available: int = 1
    pieces: int = 1
    is_single_patch: bool = True
    is_resolved: bool = False

    @property
    def cells(self) -> Cells:  # type: ignore[override]
        """The cells of the map."""
        return Cells((1, 1), self.surface.spacing, self.surface.shape[0])

    @cached_property
    def lengths(self) -> tuple[float, float]:  # type: ignore[override]
        """Correlation lengths [m] of the map along x and y; half the map where they are longer."""
        return length_or_half(self.surface, 0), length_or_half(self.surface, 1)

    @property
    def length(self) -> float:  # type: ignore[override]
        """Return the length of the map along y [m]."""
        return self.surface.size[1]

    def joined(self, indices: Sequence[int]) -> Surface:
        return self.surface

    def piece(self, index: int, length: float = PIECE) -> Surface:
        return self.surface

    def of_body(self, body: int) -> UnresolvedSample:
        raise NotImplementedError("a contact without cells moves no body through the film")

    def rows_of(self, count: int) -> int:
        return self.surface.shape[1]


def single_patch(
    scene: Scene, lengths: tuple[float, float], surface: Surface, bodies: tuple[Surface, ...] = ()
) -> SinglePatch:
    """Return the patch ``surface`` of ``scene``, of correlation ``lengths`` [m], on cells that divide its own.

    ``bodies``: the part of each of two rough bodies.
    """
    first = float(centred_axis(surface.shape[0], surface.spacing[0])[0])
    cells = cells_of_a_box(surface.spacing, lengths, scene.bodies.half_width, surface.shape, first)
    patch = SinglePatch(cells=cells, lengths=lengths, surface=surface, bodies=bodies)
    return patch.native() if scene.numerics.grid == "given" else patch
