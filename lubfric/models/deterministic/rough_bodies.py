"""Points whose roughness moves through the film: its maps, and what the deterministic model would cost there."""

from dataclasses import replace

from ...contact import HalfSpaceContact
from ...samples import Sample
from ...scene import (
    Scene,
    moves,
    moving_bodies,
)
from ...surface import Surface
from ..shared import (
    Prepared,
    on_strip,
)
from .moving import RoughBody
from .moving_strip import effort_for, moving_work
from .problem import (
    reach,
)

ON_LONGER = 0.5  # work on cells twice as long along y, over that on the shorter ones
MOST_WORK = 120.0  # s, counted: beyond it "auto" leaves moving roughness to Eq. (8)


def strip_surface(prepared: Prepared, index: int) -> Surface:
    """The map of strip ``index``; of a patch at rest all of it, on its own cells."""
    if prepared.sample.is_single_patch and not moves(prepared.scene):
        return prepared.surface
    return map_of(prepared, on_strip(prepared, prepared.sample, index))


def map_of(prepared: Prepared, contact: HalfSpaceContact) -> Surface:
    """The map of ``contact``, a strip or a piece."""
    return replace(prepared.surface, heights=contact.heights, spacing=contact.spacing, mask=None)


def bodies_of(prepared: Prepared, index: int, speed: float) -> list[RoughBody]:
    """The rough bodies of strip ``index``. In pure rolling two are one: surface 1."""
    found = moving_bodies(prepared.scene)
    if len({ratio for _, ratio in found}) == 1:
        return [RoughBody(strip_surface(prepared, index), abs(speed) * found[0][1], found[0][0] == "counterface")]
    maps = maps_of(prepared, index)
    return [RoughBody(maps[name], abs(speed) * ratio, name == "counterface") for name, ratio in found]


def maps_of(prepared: Prepared, index: int) -> dict[str, Surface]:
    """Of strip ``index`` the map of each rough body, by its section."""
    found = [name for name, _ in moving_bodies(prepared.scene)]
    sample = prepared.sample
    if len(found) < 2 or prepared.joint:  # of a joint map all is that of surface 1
        return dict.fromkeys(found[:1], strip_surface(prepared, index))
    return {name: sample.of_body(k).strip(index) for k, name in enumerate(found)}


def moving_strip_work(scene: Scene, sample: Sample, sq: float, speed: float, factors: tuple[int, int]) -> float:
    """Counted work [s] of one strip of moving roughness on cells ``factors`` times as long as those of ``sample``, and
    on cells twice as long, about; ``sq`` [m]: of the surface."""
    (fx, fy) = factors
    (dx, dy) = sample.cells.coarse
    line = scene.line_contact(abs(speed))
    effort = effort_for(line, sq)
    ends = reach(line, sq, inlet=effort.inlet, outlet=effort.outlet)
    cells = sum(ends) / (fx * dx) * sample.length / (fy * dy)
    fastest = abs(speed) * max(abs(ratio) for _, ratio in moving_bodies(scene))
    return (1 + ON_LONGER) * moving_work(line, sq, fx * dx, fastest, sample.cells.count * dx, cells)


def too_costly(prepared: Prepared, speed: float, factors: tuple[int, int]) -> str:
    """Why moving roughness is left to Eq. (8) under "auto", in words; "" if it is not."""
    scene = prepared.scene
    sample = prepared.sample
    work = moving_strip_work(scene, sample, prepared.surface.sq, speed, factors) if moves(scene) else 0.0
    if work <= MOST_WORK:
        return ""
    return (
        "Eq. (8) alone: the roughness moves, and one strip with one gap and one pressure would take about "
        f"{work:.2g} s of processor time, more than {MOST_WORK:g} s; numerics.model = 'deterministic' asks for it"
    )
