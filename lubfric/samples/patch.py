"""Samples of which there is no more: one patch that a scene requests, a map that was given, and contacts that have no
cells to solve strip by strip."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from .._base import FieldsOnly, FloatArray
from ..contact import HalfSpace, RoughContact, centred_axis
from ..scene import Numerics, Scene
from ..surface import Surface
from .cells import Cells, cells_of_a_box, length_or_half
from .contract import PIECE_LENGTH, Sample
from .rough_contacts import flat_contact_of, independent_asperities_of
from .windows import is_mirror_image


class OnlyMap(Sample):
    """A sample whose map is all that there is: what its kinds share."""

    first_strips = 1
    available_strips = 1
    available_pieces = 1
    represents_more = False
    refines_in_place = True

    def distinct_rows(self, heights: FloatArray) -> int:
        return int(heights.shape[1]) // (2 if is_mirror_image(heights) else 1)

    def tolerance_between(self, numerics: Numerics) -> float:
        return numerics.tolerance

    def renewal_length(self, half_width: float) -> float:
        return math.nan

    def in_words(self, count: int) -> str:
        return "the patch"

    def piece_in_words(self) -> str:
        return "the patch"

    def described(self, surface: Surface) -> list[str]:
        return [surface.describe()]


@dataclass(frozen=True, kw_only=True)
class SinglePatch(OnlyMap):
    """One patch, ``surface``, of which there is no more."""

    cells: Cells
    correlation_lengths: tuple[float, float]
    surface: Surface
    bodies: tuple[Surface, ...] = ()

    @property
    def strip_length(self) -> float:  # type: ignore[override]
        """Return the length of the patch along y [m]."""
        return self.surface.size[1]

    def joined(self, indices: Sequence[int]) -> Surface:
        heights = self.cells.thinned(self.surface.heights, self.cells.coarsening)
        return replace(self.surface, heights=heights, spacing=self.cells.spacing, mask=None)

    def piece(self, index: int, length: float = PIECE_LENGTH) -> Surface:
        return self.surface

    def stated_map(self) -> Surface:
        return self.surface

    def of_body(self, body: int) -> SinglePatch:
        return replace(self, surface=self.bodies[body])

    def rows_of(self, count: int) -> int:
        return self.surface.shape[1] // self.cells.coarsening[1]


@dataclass(frozen=True, kw_only=True)
class UnresolvedSample(FieldsOnly, OnlyMap):
    """The map ``surface`` of a contact that is not solved on its cells: a contact curve, independent asperities, or the
    ``given_contact`` one from outside."""

    surface: Surface
    given_contact: RoughContact | None = None
    is_resolved: bool = False

    @property
    def cells(self) -> Cells:  # type: ignore[override]
        """The cells of the map."""
        return Cells((1, 1), self.surface.spacing, self.surface.shape[0])

    @cached_property
    def correlation_lengths(self) -> tuple[float, float]:  # type: ignore[override]
        """Correlation lengths [m] of the map along x and y; half the map where they are longer."""
        return length_or_half(self.surface, 0), length_or_half(self.surface, 1)

    @property
    def strip_length(self) -> float:  # type: ignore[override]
        """Return the length of the map along y [m]."""
        return self.surface.size[1]

    def joined(self, indices: Sequence[int]) -> Surface:
        return self.surface

    def piece(self, index: int, length: float = PIECE_LENGTH) -> Surface:
        return self.surface

    def contact(
        self, scene: Scene, count: int, operator: Callable[[tuple[int, int], tuple[float, float]], HalfSpace]
    ) -> RoughContact:
        if self.given_contact is not None:
            return self.given_contact
        heights = self.surface.heights - self.surface.heights.mean()
        make = flat_contact_of if scene.contact.geometry == "flat" else independent_asperities_of
        return make(scene, heights, self.surface.spacing)

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
    cells = cells_of_a_box(
        surface.spacing, lengths=lengths, half_width=scene.bodies.half_width, shape=surface.shape, first=first
    )
    return SinglePatch(cells=cells, correlation_lengths=lengths, surface=surface, bodies=bodies)
