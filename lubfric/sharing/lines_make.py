"""Whether a scene is solved on a long line, and on which one."""

from __future__ import annotations

from ..contact import HalfSpaceContact, measured, rough_bodies, whole_map
from ..scene import Scene
from ..surface import Surface
from .lines_contract import Lines
from .lines_generated import generated_lines
from .lines_length import MOST_CELLS, PILOT
from .lines_pieces import line_contact
from .lines_windows import measured_lines


def takes_line(scene: Scene) -> bool:
    """Whether ``scene`` is solved on a line: it has a rough half-space under a cylinder, does not ask for one patch,
    and leaves the level of modelling to the tolerances."""
    numerics, contact = scene.numerics, scene.contact
    levels = numerics.model == "auto" and numerics.contact_level == "auto" and numerics.closure != "one-way"
    modelled = contact.geometry == "cylinder" and contact.model == "half-space"
    return (
        numerics.sampling == "line" and levels and modelled and any(rough.sq != 0.0 for rough, _ in rough_bodies(scene))
    )


def lines_of(scene: Scene) -> Lines:
    """Lines of the scene's surface, generated or measured; on the scene's own cells if ``numerics.grid`` is given."""
    found = measured_lines(scene, whole_map(scene)) if measured(scene) else generated_lines(scene)
    if scene.numerics.grid == "given":
        while found.cells.factors != (1, 1):
            found = found.halved()
    return found


def first_line(lines: Lines) -> Surface:
    """The line that is solved first. It is 180 correlation lengths long, if memory and map allow."""
    longest = MOST_CELLS / lines.cells.count * lines.cells.coarse[1]
    return lines.line(0, min(PILOT * lines.lengths[1], longest))


def pilot(scene: Scene, lines: Lines) -> tuple[Surface, HalfSpaceContact]:
    """The first line and the contact on it."""
    surface = first_line(lines)
    return surface, line_contact(scene, surface)
