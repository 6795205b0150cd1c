"""A scene made ready: all that its speeds share."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TypeVar

import numpy as np

from ..._base import FieldsOnly, Renamed, Shown, count_work, validate
from ...contact import BOUNDARY, HalfSpace, HalfSpaceContact, RoughContact, half_space
from ...samples import PIECE_LENGTH, Sample, half_space_contact_of, is_measured
from ...scene import Scene
from ...surface import Surface
from ...units import worded
from .memo import JoinedKey, Key, Memo, OperatorKey, PieceKey, PieceMapKey, StripKey
from .violation import Violation

T = TypeVar("T")


@dataclass(frozen=True, repr=False, kw_only=True)
class Prepared(FieldsOnly, Renamed, Shown):
    """A scene prepared by `lubfric.prepare`. It is accepted wherever a scene is, and safe to share: only its cache
    (`Memo`) changes, which does not affect results.

    Attributes
    ----------
    scene : the scene
    surface : the map whose statistics are stated (`Sample.stated_map`): the first strips, joined; a patch on native
        cells
    rough_contact : the contact on the first strips, on the cells of ``sample``; of a patch too
    contact_work : counted work [s] of that contact, added to the work of each point that uses it; `lubfric.prepare`
        counts none of it
    violations : assumptions of the model that bodies and map violate, known before any solve
    sample : what represents the infinite rough line contact
    has_given_map, has_given_contact : whether a map, or a contact, was given to `lubfric.prepare`
    """

    scene: Scene
    surface: Surface
    rough_contact: RoughContact
    sample: Sample
    contact_work: float = 0.0
    violations: tuple[Violation, ...] = ()
    has_given_map: bool = False
    has_given_contact: bool = False
    _RENAMED = {
        "contact": "rough_contact",
        "known": "violations",
        "given": "is_given",
        "strips": "sample",
        "joint": "has_one_map_for_all_bodies",
        "remembered": "memo",
    }

    @property
    def is_given(self) -> bool:
        """Whether a map or a contact was given to `lubfric.prepare`, so that it cannot be extended."""
        return self.has_given_map or self.has_given_contact

    @property
    def is_given_or_measured(self) -> bool:
        """Whether heights or contact come from outside: given to `lubfric.prepare`, or read from a file of the
        scene."""
        return self.is_given or is_measured(self.scene)

    @property
    def has_one_map_for_all_bodies(self) -> bool:
        """Whether one map was given to `lubfric.prepare` for all bodies, so that the part of each in it is not
        known."""
        return self.has_given_map and not self.sample.bodies

    @cached_property
    def memo(self) -> Memo:
        """What is remembered between speeds; neither compared nor pickled."""
        return Memo()

    def _facts(self) -> dict[str, str]:
        return {"": self.scene.name, "map": self.surface.describe()}


def way_to_shorter_cells(prepared: Prepared, *, along_x: bool = False) -> str:
    """Return how the native cells of ``prepared`` become half as long, or only so ``along_x``, as text."""
    what = "a map with cells" if prepared.is_given_or_measured else "a contact.spacing"
    (dx, dy) = (0.5 * length for length in prepared.sample.cells.native_spacing)
    if along_x:
        return f"{what} along x of at most {worded(dx, 'm')}"
    lengths = worded(dx, "m") if math.isclose(dx, dy) else f"{worded(dx, 'm')} along x and {worded(dy, 'm')} along y"
    return f"{what} of at most {lengths}"


def why_no_rough_film(prepared: Prepared, speed: float) -> str:
    """Return why no film flows between rough surfaces on cells at ``speed`` [m/s], as text; "" if one does."""
    if speed == 0:
        return "nothing is entrained"
    if not prepared.sample.is_resolved:
        return "the contact has no cells to solve strip by strip"
    return "the surfaces are smooth" if prepared.surface.sq == 0 else ""


def remembered(
    prepared: Prepared,
    sample: Sample,
    key: Key[T],
    make: Callable[[], T],
    cells: Callable[[T], int] = lambda value: 0,
) -> T:
    """Return what ``make`` gives on ``sample``, made once for ``key`` (`Memo.get`).

    A `Key` knows the cells of the sample and not its surface. So what is made on another surface than that of
    ``prepared``, as on one of its bodies (`Sample.of_body`), is not remembered.
    """
    return prepared.memo.get(key, make, cells) if sample.is_on_surface_of(prepared.sample) else make()


def contact_on_joined_strips(prepared: Prepared, sample: Sample, count: int) -> RoughContact:
    """Return the contact on the first ``count`` strips of ``sample``, joined to one line; of an unresolved one the only
    contact.

    ``sample``: that of ``prepared``, on any cells, or one of its bodies (`Sample.of_body`).
    """

    def make() -> RoughContact:
        if not sample.is_resolved:
            count_work(prepared.contact_work)
            return prepared.rough_contact
        return contact_at_inputs(prepared, sample, count, prepared.scene)

    return remembered(prepared, sample, JoinedKey(sample.cells.coarsening, count), make, cells_of_contact)


def contact_at_inputs(prepared: Prepared, sample: Sample, count: int, scene: Scene) -> RoughContact:
    """Return the contact of ``scene``, which differs from the prepared one in inputs only, on the first ``count``
    strips of ``sample``."""
    return sample.contact(scene, count, partial(operator_on, prepared.memo, prepared.scene))


def contact_on_strip(prepared: Prepared, sample: Sample, index: int) -> HalfSpaceContact:
    """Return the contact on strip ``index`` of ``sample`` alone."""

    def make() -> HalfSpaceContact:
        surface = sample.strip(index)
        return _contact(prepared, surface.heights, surface.spacing, sample.cells.axis())

    key = StripKey(sample.cells.coarsening, index)
    return remembered(prepared, sample, key, make, lambda contact: contact.heights.size)


def pictured_contact(
    prepared: Prepared, sample: Sample, *, coarsening: tuple[int, int], length: float = PIECE_LENGTH
) -> HalfSpaceContact:
    """Return the contact on the piece of ``sample`` for a picture (`Sample.pictured_piece`), on cells of this
    ``coarsening``."""
    return _contact_of_piece(prepared, sample, sample.pictured_piece(length), coarsening)


def contact_on_piece(
    prepared: Prepared, sample: Sample, index: int, *, coarsening: tuple[int, int], length: float = PIECE_LENGTH
) -> HalfSpaceContact:
    """Return the contact on piece ``index`` of ``sample`` (`Sample.piece`), on cells of this ``coarsening``."""
    strip_coarsening = sample.cells.coarsening

    def make() -> HalfSpaceContact:
        surface = remembered(
            prepared, sample, PieceMapKey(strip_coarsening, index, length), lambda: sample.piece(index, length)
        )
        return _contact_of_piece(prepared, sample, surface, coarsening)

    key = PieceKey(strip_coarsening, index, length, coarsening)
    return remembered(prepared, sample, key, make, lambda contact: contact.heights.size)


def _contact_of_piece(
    prepared: Prepared, sample: Sample, surface: Surface, coarsening: tuple[int, int]
) -> HalfSpaceContact:
    """Return the contact on a piece ``surface`` of ``sample``, on cells of this ``coarsening``."""
    heights = sample.cells.thinned(surface.heights, coarsening)
    spacing = surface.spacing[0] * coarsening[0], surface.spacing[1] * coarsening[1]
    return _contact(prepared, heights, spacing, sample.cells.axis(coarsening))


def _contact(prepared: Prepared, heights: np.ndarray, spacing: tuple[float, float], x: np.ndarray) -> HalfSpaceContact:
    scene = prepared.scene
    (nx, ny) = heights.shape
    operator = operator_on(prepared.memo, scene, (nx, ny), spacing)
    return half_space_contact_of(scene, heights - heights.mean(), spacing, operator=operator, x=x)


def operator_on(memo: Memo, scene: Scene, shape: tuple[int, int], spacing: tuple[float, float]) -> HalfSpace:
    """Return the half-space operator of ``scene`` on a grid, made once for ``memo``."""
    return memo.get(
        OperatorKey(shape, (spacing[0], spacing[1]), scene.bodies.e_prime),
        lambda: half_space(shape, spacing, scene.bodies.e_prime, BOUNDARY, workers=scene.numerics.workers),
        lambda operator: operator.symbol.size,
    )


def cells_of_contact(rough_contact: RoughContact) -> int:
    """Return the number of cells that a contact holds."""
    return math.prod(rough_contact.grid or (0,))


def scene_of(scene: Scene | Prepared) -> Scene:
    """Return the scene that was prepared, or the scene itself; anything else is an `InputError`."""
    if isinstance(scene, Prepared):
        return scene.scene
    validate.instance("scene", scene, Scene, "what lubfric.load_scene or lubfric.prepare returned")
    return scene
