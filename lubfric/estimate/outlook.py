"""A forecast of what a point will take, from closed forms: whether the summits touch, how many strips are solved and
how long that takes. Nothing is solved."""

import math
from dataclasses import dataclass

from ..film import LineContact, flooded_inlet
from ..models.deterministic import DIFFERENCE, MOST_WORK, SHORT, cells_of, moving_point_work, reach, work_of_steps
from ..models.load_sharing import load_sharing_error
from ..models.shared import ORDER, SAFETY, student
from ..oil import shear_stress
from ..samples import Sample
from ..scene import BY_LOAD_SHARING, FRICTION, Scene, gap_not_resolved, moves
from ..surface import Surface

CELL_SECONDS = 1.3e-6  # processor time of a cell of the strips in balance, about
PIECE_SECONDS = 0.7e-6  # of a cell of a piece on finer and finer cells, of the finest
# of a contact on a map that is solved whole; of each of its cells
PATCH_SECONDS = 0.03
MAP_SECONDS = 4e-8
# of the films of a point; how many times as many with heat
FILM_SECONDS = 0.015
HOT = 5.0
GAP = 1.6  # Sq: mean gap of a contact that carries most of the load, about
RISE = 0.4  # of the film of the whole load, by which it is wider, about
FLOOR = 0.25  # of f_b: friction where the film carries most, about
# of Newton's method on a strip of the deterministic model, and on smaller cells
STEPS = 9
FINER_STEPS = 6
LAST_STEPS = 20  # on cells a quarter as long, which a map shorter than a piece is solved on as a whole
AGAIN = 4  # of a strip whose neighbour is solved: at an end of the range of an input
IN_MOTION = 1.1  # processor time of moving roughness over its counted work, which is that of the systems alone
UNLIKE = 0.65  # scatter of the difference between the models over that of f
CLEAR = 3.5  # Sq: a film that thick hardly meets a summit
SURE = 2.0  # factor between the expected film and any film: outside of it contact or separation is certain


@dataclass(frozen=True)
class Forecast:
    """To an order of magnitude, at one ``speed`` [m/s]: in words, whether the summits touch by the expected film of the
    whole load; ``error``: relative standard error of f after the first strips; ``strips`` that
    ``numerics.sampling_tolerance`` needs, their ``length`` [m]; ``resolved``: strips by the deterministic model (0:
    Eq. (8) alone answers); and the processor time [s]. ``moving``: that of one strip of the deterministic model if its
    roughness moves and the film is not so thick that Eq. (8) is enough, else 0."""

    speed: float
    touching: str
    error: float
    strips: int
    length: float
    resolved: int
    seconds: float
    moving: float = 0.0


def forecast(scene: Scene, sample: Sample, surface: Surface, speed: float) -> Forecast:
    """What a point at ``speed`` [m/s] will take. ``surface``: that is solved first; ``strips``: None for a contact
    without cells.

    The mean gap over a line of length L and half-width b scatters as a mean of L (2b + sqrt(pi) lx)/(pi lx ly)
    independent heights. The effect on f follows from the share of the load that the rigid film of the whole load would
    carry if it were as thick as the gap.
    """
    film = scene.line_contact(speed).expected_film if speed else 0.0
    sq = surface.sq
    summit = float(surface.heights.max() - surface.heights.mean())
    seconds = FILM_SECONDS * (HOT if scene.lubricant.heats and scene.numerics.heat != "off" else 1.0)
    touching = "touching" if SURE * film < summit else "none" if film > SURE * summit else "none or a few summits"
    if sample.is_single_patch:
        if touching != "none":
            seconds += PATCH_SECONDS + MAP_SECONDS * surface.heights.size
        patch = (0, 0.0, 0.0) if not sample.is_resolved else _resolved(scene, sample, surface, speed, film, 0.0)
        resolved, work, moving = patch
        return Forecast(speed, touching, math.nan, 1, math.nan, resolved, seconds + work, moving)
    (lx, ly) = sample.lengths
    first = sample.first * sample.length
    target = scene.numerics.sampling_tolerance
    error = 0.0
    if speed and film <= CLEAR * sq:
        gap = GAP * sq + RISE * film
        share = min(film / gap, 1.0)
        scatter = sq * math.sqrt(math.pi * lx * ly / (first * (2 * scene.bodies.half_width + math.sqrt(math.pi) * lx)))
        error = scatter / gap * share / (1 - share + FLOOR)
    count = math.ceil(sample.first * max(1.0, SAFETY * (error / target) ** 2 if error > target else 1.0))
    count = min(count, sample.available)
    cells = sample.cells
    (fx, fy) = cells.coarsening
    (_, dy) = cells.coarse
    piece = 0.0 if cells.is_native else cells.count * fx * fy * sample.length / dy / 2
    if touching != "none":
        seconds += CELL_SECONDS * cells.count * count * sample.length / dy + PIECE_SECONDS * piece
    resolved, work, moving = _resolved(scene, sample, surface, speed, film, error * math.sqrt(sample.first))
    length = count * sample.length
    return Forecast(speed, touching, error, count, length, resolved, seconds + work, moving)


def _resolved(
    scene: Scene, sample: Sample, surface: Surface, speed: float, film: float, scatter: float
) -> tuple[int, float, float]:
    """Number of strips of the deterministic model, all their work [s], and that of one if its roughness moves, else 0.
    ``film`` [m]: expected; ``scatter``: of f between strips, relative."""
    numerics = scene.numerics
    sq = surface.sq
    both = cells_of(scene, sample)
    moving = moving_point_work(scene, sample, sq, speed, both) if speed and moves(scene) else 0.0
    if speed == 0 or scene.transient is not None or numerics.model in BY_LOAD_SHARING or gap_not_resolved(scene):
        return 0, 0.0, moving
    rolling = rolling_share(scene.line_contact(speed), scene.bodies.mean_hertz_pressure) if moving else 0.0
    if sq == 0 or load_sharing_error(film / sq, 0.0, 0.0, 1.0, rolling)[1] <= numerics.model_tolerance:
        return 0, 0.0, 0.0
    allowed = math.hypot(DIFFERENCE * numerics.model_tolerance / student(ORDER), numerics.sampling_tolerance)
    count = min(max(1, math.ceil(SAFETY * (UNLIKE * scatter / allowed) ** 2)), sample.available)
    ends = 2 * sum(name != FRICTION for name, *_ in scene.ranges)
    if moving and moving > MOST_WORK and numerics.model == "auto":
        return 0, 0.0, moving
    if moving:
        count = min(count, max(1, int(MOST_WORK / moving)))  # no more are solved
        return count, IN_MOTION * count * moving, moving
    (fx, fy) = both
    (dx, dy) = sample.cells.coarse
    (ux, uy) = sample.cells.coarsening
    cells = sum(reach(scene.line_contact(abs(speed)), sq)) / (fx * dx) * sample.length / (fy * dy)
    finer = (
        0.5 * cells * fx * fy * (ux * uy if sample.is_single_patch else 1)
    )  # a patch may be solved down to its own cells
    short = not sample.is_single_patch and sample.length < SHORT * sample.lengths[1] and fx * ux >= 4 <= fy * uy
    work = work_of_steps(4 * cells, FINER_STEPS) + work_of_steps(16 * cells, LAST_STEPS) if short else 0.0
    again = work_of_steps(finer if sample.is_single_patch else cells, AGAIN) * (ends + (ends > 0))
    return count, count * work_of_steps(cells, STEPS) + work_of_steps(finer, FINER_STEPS) + again + work, 0.0


def rolling_share(line: LineContact, pressure: float) -> float:
    """Expected share of rolling in the friction of the film of ``line`` under a mean ``pressure`` [Pa], to a factor of
    two: pressure builds up in the inlet, and the Hertz strip and the film about it are sheared."""
    oil = line.lubricant
    film = line.expected_film
    b = line.half_width
    sliding = abs(line.sliding or 0.0)
    length = math.sqrt(2 * line.radius * film)
    eta = oil.viscosity
    rolling = eta * abs(line.entrainment_speed) * flooded_inlet(length, b)
    sheared = film * float(shear_stress(oil, pressure, sliding / film)) * b + eta * sliding * length
    return rolling / (rolling + sheared)
