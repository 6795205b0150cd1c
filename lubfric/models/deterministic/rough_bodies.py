"""The maps of a point for the deterministic model: of strips, of pieces and of the rough bodies that move; and their
control."""

from dataclasses import replace

from ...contact import HalfSpaceContact
from ...scene import has_moving_roughness, moving_bodies
from ...surface import Surface
from ..shared import AttenuatedSummitsKey, Prepared, contact_on_strip
from .moving import RoughBody
from .summits import SummitControl, control_of

# Strips over which the control of moving roughness is averaged, at most: its error is a seventh of their scatter. A
# choice: a larger value costs time, a smaller one leaves more scatter.
CONTROL_STRIPS = 48

# Cells of all these strips together, at most: about a second of processor time. A choice: a smaller value leaves more
# scatter.
CONTROL_CELLS = 4_000_000


def map_of_strip(prepared: Prepared, index: int) -> Surface:
    """Return the map of strip ``index`` alone, which the deterministic model solves by itself: on the cells of the
    sample; of a patch at rest all of it, on native cells."""
    if prepared.sample.refines_in_place and not has_moving_roughness(prepared.scene):
        return prepared.surface
    return map_of_contact(prepared, contact_on_strip(prepared, prepared.sample, index))


def map_of_contact(prepared: Prepared, rough_contact: HalfSpaceContact) -> Surface:
    """Return the heights of ``rough_contact``, of a strip or a piece, as a map."""
    return replace(prepared.surface, heights=rough_contact.heights, spacing=rough_contact.spacing, mask=None)


def bodies_of(prepared: Prepared, index: int, speed: float) -> list[RoughBody]:
    """Return the rough bodies of strip ``index``. In pure rolling two are one: surface 1."""
    moving = moving_bodies(prepared.scene)
    if len({ratio for _, ratio in moving}) == 1:
        return [RoughBody(map_of_strip(prepared, index), abs(speed) * moving[0][1], moving[0][0] == "counterface")]
    maps = maps_of_bodies(prepared, index)
    return [RoughBody(maps[name], abs(speed) * ratio, name == "counterface") for name, ratio in moving]


def maps_of_bodies(prepared: Prepared, index: int) -> dict[str, Surface]:
    """Return the map of each rough body on strip ``index``, by its section."""
    moving = [name for name, _ in moving_bodies(prepared.scene)]
    sample = prepared.sample
    if len(moving) < 2 or prepared.has_one_map_for_all_bodies:  # the only map is that of surface 1
        return dict.fromkeys(moving[:1], map_of_strip(prepared, index))
    return {name: sample.of_body(k).strip(index) for k, name in enumerate(moving)}


def summit_control(prepared: Prepared) -> SummitControl | None:
    """Return the control of the moving roughness of ``prepared``; None where there are no other strips to know its mean
    from. It does not depend on the speed, and is made once."""
    if not prepared.sample.represents_more:
        return None

    def make() -> SummitControl:
        sample = prepared.sample
        count = max(1, min(sample.available_strips, CONTROL_STRIPS, CONTROL_CELLS // sample.strip(0).heights.size))
        return control_of([sample.strip(index) for index in range(count)], prepared.scene.bodies.half_width)

    key = AttenuatedSummitsKey(coarsening=prepared.sample.cells.coarsening)
    return prepared.memo.get(key, make)
