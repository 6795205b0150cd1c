"""Points whose roughness moves through the film: its maps, and what the deterministic model would cost there."""

from dataclasses import replace

from ...contact import HalfSpaceContact
from ...samples import Sample
from ...scene import BOUNDARY_FRICTION_KEY, HARDNESS_KEY, Scene, has_moving_roughness, moving_bodies
from ...surface import Surface
from ..shared import Prepared, ReferenceKey, contact_on_strip
from .expected_friction import solved_ends_of_hardness
from .moving import RoughBody
from .moving_strip import EXPECTED_COURSE, OF_SHEAR, ExpectedCourse, effort_for, moving_work
from .problem import reach
from .summits import SummitControl, control_of

# Counted work [s] of the strips of a point and of their shorter cells, at most, whether the model is named or chosen; "auto"
# leaves a point whose first strip takes more to the quick answer (docs/models.md).
MOST_WORK_OF_POINT = 120.0

# Slide-roll ratio from which the ends of the stress of an oil are expected to be solved in motion [-], one of two: about half of
# them at ratios of .4 to 1.9, one of thirty below, on 26 contacts of verification.campaigns.moving_coverage with typical ranges.
SOLVED_ENDS_SLIDING = 0.3

# Strips over which the control of moving roughness is averaged, at most: its error is a seventh of their scatter.
CONTROL_STRIPS = 48

# Cells of all these strips together, at most: about a second of processor time.
CONTROL_CELLS = 4_000_000


def map_of_strip(prepared: Prepared, index: int) -> Surface:
    """Return the map of strip ``index`` alone, which the deterministic model solves by itself: on the cells of the sample; of a
    patch at rest all of it, on native cells."""
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

    key = ReferenceKey(prepared.sample.cells.coarsening, "attenuated summits", 0.0, forward=True)
    return prepared.memo.get(key, make)


def moving_point_work(
    scene: Scene,
    sample: Sample,
    surface: Surface,
    speed: float,
    *,
    sample_coarsening: tuple[float, float],
    course: ExpectedCourse = EXPECTED_COURSE,
) -> float:
    """Estimate the counted work [s] of a point at ``speed`` [m/s] on one strip of moving roughness, ends of input ranges included.

    The cells are ``sample_coarsening`` times as long as those of ``sample``, to which the ``surface`` belongs.
    """
    (fx, fy) = sample_coarsening
    (dx, dy) = sample.cells.spacing
    sq = surface.sq
    line = scene.line_contact(abs(speed))
    effort = effort_for(line, sq, fx * dx)
    ends = reach(line, sq, inlet=effort.inlet, outlet=effort.outlet)
    cells = sum(ends) / (fx * dx) * sample.strip_length / (fy * dy)
    fastest = abs(speed) * max(abs(ratio) for _, ratio in moving_bodies(scene))
    solved_ends = _solved_ends(scene, surface, speed)
    return moving_work(
        line,
        sq,
        cell=fx * dx,
        fastest=fastest,
        length=sample.cells.columns * dx,
        cells=cells,
        continuations=solved_ends + 1 if solved_ends else 0,  # one at the prepared inputs, which they are compared with
        course=course,
    )


def _solved_ends(scene: Scene, surface: Surface, speed: float) -> int:
    """Return how many ends of input ranges are expected to be solved where roughness moves: those of the shear of the oil where the
    bodies slide (`SOLVED_ENDS_SLIDING`), and of the hardness where asperities reach it."""
    slides = abs(scene.motion.slide_roll_ratio) > SOLVED_ENDS_SLIDING
    number = 0
    for name, *_ in scene.ranges:
        if name == HARDNESS_KEY:
            number += solved_ends_of_hardness(scene, surface, speed)
        elif name in OF_SHEAR:
            number += slides
        elif name != BOUNDARY_FRICTION_KEY:
            number += 2
    return number


def why_too_costly(prepared: Prepared, speed: float, sample_coarsening: tuple[float, float]) -> str:
    """Return why "auto" leaves moving roughness to the quick answer; "" if it does not."""
    scene = prepared.scene
    sample = prepared.sample
    work = (
        moving_point_work(scene, sample, prepared.surface, speed, sample_coarsening=sample_coarsening)
        if has_moving_roughness(scene)
        else 0.0
    )
    if work <= MOST_WORK_OF_POINT:
        return ""
    return (
        "not the deterministic model: the roughness moves, and one strip by the deterministic model would take about "
        f"{float(f'{work:.2g}'):g} s of counted work, more than {MOST_WORK_OF_POINT:g} s; numerics.model = 'deterministic' "
        "solves it"
    )
