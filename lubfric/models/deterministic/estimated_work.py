"""What a point by the deterministic model will take, from closed forms and the counted work of its steps
(`counted_work`). Nothing is solved.

Constants that name no other source are measured on the points of ``python -m verification.campaigns.estimates``.
"""

import math
from dataclasses import replace

from ...samples import PIECE_LENGTH, Sample
from ...scene import (
    BOUNDARY_FRICTION_KEY,
    HARDNESS_KEY,
    LENGTH_KEYS,
    Scene,
    has_moving_roughness,
    moving_bodies,
    why_gap_not_resolved,
)
from ...surface import Surface
from ..contract import AUTO
from ..shared import FREEDOM_NOT_COUNTED, STRIPS_SAFETY, Prepared, is_smooth_over_cells, student
from ..work_estimate import MeasuredTime, WorkEstimate
from .cells_in_motion import CellsInMotion, unlikeness
from .counted_work import MOST_WORK_OF_POINT
from .expected_friction import expected_friction, solved_ends_of_hardness, solved_ends_of_shear
from .expected_steps import expected_steps
from .expected_steps_in_time import StepFacts
from .first_steps import FirstSteps
from .ladder import SOFT_CELL_ERROR
from .levels import DIFFERENCE_SHARE, HALVED_WORK, STRIPS_GROWTH, STRIPS_SPARE
from .moving import film_half_width
from .moving_strip import (
    COURSE_ON_LONG_CELLS,
    EXPECTED_COURSE,
    OF_SHEAR,
    PILOT_WAY,
    ExpectedCourse,
    effort_for,
    moving_work,
)
from .pieces import LENGTH_OF_LAST_PIECE, LENGTH_OF_SHORT_STRIP
from .problem import are_soft, reach, why_too_many
from .shorter_cells import PIECES_SHARE
from .strip import error_of_patch
from .strip_on_two_grids import (
    MapCoarsening,
    coarsening_at_rest,
    patch_coarsening_to_look_at,
    sample_coarsening_of,
    shortened,
)

# Where the map is shorter than a piece, this part of the points solves all of it again on cells a quarter as long [-].
QUARTER_OF_SHORT_STRIP = 0.5

# Change of f of a patch at rest from cells twice as long [-], of a cell along x as long as correlation length and Hertz
# half-width, where it is largest; the exponents of the cell over these; the logarithm of the film of the smooth contact
# over Sq at which it is largest, and its fall with the square of the distance from there; the standard deviation of its
# logarithm. Fitted to 212 changes of random patches of `python -m verification.campaigns.estimates`.
CHANGE_OF_PATCH = 0.33
CHANGE_BY_LENGTH = 0.67
CHANGE_BY_HALF_WIDTH = 0.39
LARGEST_CHANGE = -0.42
CHANGE_BY_FILM = 0.53
CHANGE_SPREAD = 1.4

# The least such change where the film of the smooth contact is above Sq, over the square of the cell along x over the
# Hertz half-width [-]: 56, 14, 3.5, .9 % at .75, .38, .19, .09; on a measured map f changed by 10 to 21, 3 to 45, 4 to
# 50, .6 to 1.4 % there.
CHANGE_OF_FILM = 1.0

# Factor on that change where the heights are not smooth over a cell [-]: on those of the patches whose autocorrelation
# is exponential.
CHANGE_IF_NOT_SMOOTH = 1.5

# Error of f by the cells that a solve is expected to estimate, over the last change of f from longer to shorter cells
# [-] (`error_by_cells`, `error_of_patch`). It is 0.3 to 3, by the ratio of the last two changes. A choice between
# these.
ERROR_OVER_CHANGE = 1.5

# A strip or a piece is solved on longer cells first, whose work is this part of that on its own cells [-]. It follows
# from a quarter of the cells each time, 1/4 + 1/16 + ...
ON_LONGER_CELLS = 0.3

# Where the sampling error needs fewer strips than this [-], the first strip is enough. It was in 10 of 11 random points
# below this number, and in none of 14 above it.
ENOUGH_ALONE = 0.3

# Number of pieces that are solved on cells half as long where a point has more than one strip [-]. It was 1 to 7, with
# a mean of 2.8, in 13 of these 14 points.
PIECES_OF_MORE_STRIPS = 3.0

# `PIECES_OF_MORE_STRIPS` where the heights are not smooth over a cell, and f scatters more [-]: 1 to 32, 5 in the
# geometric mean of 8 points on exponential surfaces.
PIECES_IF_NOT_SMOOTH = 5.0

# Number of these pieces where one strip is enough and the film is below `RUBBED_FILM`, so that shorter cells change f
# little [-]. A piece was solved at 2 of 9 of these points, and at all others with one strip.
PIECES_OF_RUBBED = 0.25

# Film of the smooth contact over Sq below which f is nearly f_b [-]. A choice: it moves estimates alone.
RUBBED_FILM = 0.25

# The same limit for a short strip, all of which is solved on shorter cells [-]. Of three random points those below it
# (.05 and .07) solved no shorter cells, and that above it (.13) did. A choice between them.
RUBBED_FILM_OF_SHORT_STRIP = 0.1

# A strip is solved a second time at a load 3 % larger. This solve takes this part of the Newton steps of a strip that
# starts from a solved one nearby [-].
OF_SLOPE = 0.5

# Part of these points that solve a piece on cells a quarter as long, where one strip is enough [-].
LAST_LEVEL_OF_ONE_STRIP = 0.2

# Part of the points that solve a piece on cells a quarter as long, where more strips are solved [-].
LAST_LEVEL_OF_MORE_STRIPS = 0.4

# The same part, for any number of strips, where the heights are not smooth over a cell [-]. It was 6 of 7 random points
# on exponential surfaces.
LAST_LEVEL_IF_NOT_SMOOTH = 0.85

# Part of these points that go on to still shorter cells [-]. It was 3 of these 6.
SHORTER_IF_NOT_SMOOTH = 0.5

# Processor time of roughness at rest over its counted work [-]: .5 to .86 in ten runs of
# ``verification.campaigns.estimates``.
AT_REST = 0.64

# Processor time [s] of a patch at rest whose cells are so few that their work takes none: .04 to .08 in ten random
# patches of the same.
SECONDS_OF_PATCH = 0.05

# Processor time of roughness at rest on long cells over its counted work [-]: .5 to 1.1 in 20 random points of the
# same, most of all where the arrays are small.
AT_REST_ON_LONG_CELLS = 0.9

# What is expected of a strip of moving roughness for its time. The strip at rest takes 2 to 9 steps in time in ten runs
# of ``verification.campaigns.estimates``. The distance that the roughness travels is that of `expected_way`.
COURSE_OF_TIME = replace(EXPECTED_COURSE, rest=4.0)

# Part of a complete pass of the map that a strip of moving roughness travels, over the root of the number of strips
# that the sampling error is expected to need (`_needed_strips`) [-]. Fitted to the first answers of 30 contacts of
# verification.campaigns.moving_coverage: rms .40 of the logarithm of the distance, with one distance for all .49. Where
# the distance was taken in proportion to the number itself, it was .47.
PASSED_PART = 1.2

# Processor time of moving roughness on many cells over its counted work [-]. Fitted with `SMALL_ARRAYS` to 33 strips of
# 22 runs of verification.campaigns.estimates, by the deterministic and the quick model, on 280 to 14,400 cells: rms .15
# of the logarithm, 1.5 at most.
IN_MOTION = 0.57

# A Newton step on this number of cells spends as long in the calls of numpy, which the counted work omits, as on its
# cells [-]. Fitted.
SMALL_ARRAYS = 2250.0

# Change of ln f with ln of the boundary film that is expected of moving roughness [-], where the full-load film over Sq
# is within `MIXED_FILMS`: the larger of the values between which it lies in most of the 301 contacts of
# verification.campaigns.calibration, 0 and 0.6. A fifth of them have more than 0.4, with which a strip may be solved
# again on cells half as long along y.
EXPECTED_STEEPNESS = 0.6
MIXED_FILMS = (0.3, 1.7)

# Factor on the work where that may happen (`shorter_ones_pay`) [-]: between 1, where it does not, and 1 plus
# `HALVED_WORK`, with the weight of a fourth. It did in 2 of 31 contacts of verification.campaigns.moving_coverage.
MAY_BE_HALVED = 1.2

# Scatter over the strips of the difference in f between the two models, over the scatter of f itself [-].
UNLIKE = 0.65

# Relative standard error of f of a strip whose map has passed, over the root of the expected scatter (`_needed_strips`)
# of one area of the correlation lengths over that of the map [-]. Fitted with its exponent to 51 contacts of
# verification.campaigns.moving_coverage and verification.campaigns.estimates.
SCATTER_IN_MOTION = 0.45

# Cautious error (`StandardError.cautious`) over the error [-], with some ten degrees of freedom. It follows from that
# method.
CAUTIOUS = 1.3

# Half-widths of the Hertz strip along y that are solved again for a picture [-]. A choice, by looking at the figures.
PICTURED_LENGTH = 10.0

# Correlation lengths along y of such a picture, at least [-]. A choice, by looking at the figures.
LEAST_PICTURED_LENGTH = 8.0

# The estimate for a model that is not solved: no work. By definition.
NO_WORK = WorkEstimate(strips=0, seconds=0.0, has_answer=False)


def estimated_work(
    scene: Scene, sample: Sample, surface: Surface, speed: float, cheaper: WorkEstimate | None
) -> WorkEstimate:
    """Return what a point at ``speed`` [m/s] will take in addition to the strips of the ``cheaper`` model, if there is
    one."""
    numerics = scene.numerics
    sq = surface.sq
    if speed == 0 or sq == 0 or not sample.is_resolved:
        return NO_WORK
    if why_too_many(_cells_of_strip(scene, sample, sq=sq, speed=speed)):
        return NO_WORK
    if scene.transient is not None or why_gap_not_resolved(scene):
        strip_seconds = _seconds_in_motion(scene, sample, surface, speed) if has_moving_roughness(scene) else 0.0
        return WorkEstimate(strips=0, seconds=0.0, has_answer=False, strip_seconds=strip_seconds)
    if numerics.model == AUTO and cheaper is not None and cheaper.expected_model_error <= numerics.model_tolerance:
        return NO_WORK
    if has_moving_roughness(scene):
        return _work_in_motion(scene, sample, surface, speed)
    scatter = 0.0
    if cheaper is not None and sample.represents_more and math.isfinite(cheaper.expected_sampling_error):
        scatter = cheaper.expected_sampling_error * math.sqrt(sample.first_strips)
    allowed = math.hypot(
        DIFFERENCE_SHARE * numerics.model_tolerance / student(FREEDOM_NOT_COUNTED), numerics.sampling_tolerance
    )
    wanted = STRIPS_SAFETY * (UNLIKE * scatter / allowed) ** 2
    count = min(max(1, math.ceil(wanted)), sample.available_strips)
    if wanted > ENOUGH_ALONE:
        count = min(max(count, int(STRIPS_GROWTH[0])), sample.available_strips)
    ends = _solved_ends(scene, surface, speed)
    is_smooth = is_smooth_over_cells(surface.heights)
    work = _work_at_rest(scene, sample, sq=sq, speed=speed, count=count, ends=ends, is_smooth=is_smooth)
    if numerics.max_work is not None:
        work = min(work, numerics.max_work)  # which ends it
    return WorkEstimate(
        strips=count,
        seconds=AT_REST * work + (SECONDS_OF_PATCH if sample.refines_in_place else 0.0),
        fine_fields_seconds=work_of_fine_fields(scene, sample, sq, speed, coarsening_at_rest(scene, sample)),
    )


def _work_in_motion(scene: Scene, sample: Sample, surface: Surface, speed: float) -> WorkEstimate:
    """Return the same of moving roughness."""
    strip_seconds = _seconds_in_motion(scene, sample, surface, speed)
    numerics = scene.numerics
    if numerics.model == AUTO and _is_too_costly(scene, sample, surface, speed):
        return WorkEstimate(strips=0, seconds=0.0, has_answer=False, strip_seconds=strip_seconds)
    sample_coarsening = sample_coarsening_of(scene, sample)
    pace = _pace_in_motion(scene, sample, sq=surface.sq, speed=speed, sample_coarsening=sample_coarsening)
    ended = math.inf if numerics.max_work is None else pace * numerics.max_work
    affordable = max(1.0, pace * MOST_WORK_OF_POINT / strip_seconds)
    needed = _needed_strips(scene, sample, sq=surface.sq, speed=speed)
    count = min(max(1.0, needed), affordable, sample.available_strips)
    longest = strip_seconds
    if count * HALVED_WORK <= affordable and _may_be_halved(scene, sample, surface, speed):
        longest = (1.0 + HALVED_WORK) * strip_seconds
        strip_seconds *= MAY_BE_HALVED
    return WorkEstimate(
        strips=round(count),
        seconds=min(count * strip_seconds, ended),
        strip_seconds=strip_seconds,
        longest_strip_seconds=longest,
        most_seconds=ended,
        length=sample.line_length(round(count)),
    )


def _needed_strips(scene: Scene, sample: Sample, *, sq: float, speed: float) -> float:
    """Return how many strips of moving roughness of ``sq`` [m] the sampling error at ``speed`` [m/s] needs, if all of a
    map passes; of less than one, a part of it.

    f scatters by the asperity load ratio s, as of single contacts, sqrt(s (1 - s)), times the
    `ExpectedFriction.contrast`.
    """
    expected = expected_friction(scene, sq, speed)
    scatter = math.sqrt(expected.share * (1.0 - expected.share)) * expected.contrast
    (lx, ly) = sample.correlation_lengths
    passed = sample.cells.columns * sample.cells.spacing[0] + 2.0 * scene.bodies.half_width
    error = SCATTER_IN_MOTION * math.sqrt(scatter * lx * ly / (passed * sample.strip_length))
    return STRIPS_SPARE[0] * (CAUTIOUS * error / scene.numerics.sampling_tolerance) ** 2


def _work_at_rest(
    scene: Scene, sample: Sample, *, sq: float, speed: float, count: int, ends: float, is_smooth: bool
) -> float:
    """Return the counted work [s] of ``count`` strips whose roughness rests, of shorter cells, and of so many ``ends``
    of input ranges; ``is_smooth``: whether the heights are smooth over a cell."""
    (fx, fy) = sample_coarsening_of(scene, sample)
    (dx, dy) = sample.cells.spacing
    (ux, uy) = sample.cells.coarsening
    cells = _cells_of_strip(scene, sample, sq=sq, speed=speed)
    columns = sum(reach(scene.line_contact(abs(speed)), sq)) / (fx * dx)
    steps = expected_steps(scene, sq, speed, columns)
    if sample.refines_in_place or sample.piece_is_strip(LENGTH_OF_LAST_PIECE):
        return _work_in_levels(scene, sample, sq=sq, speed=speed, count=count, ends=ends, is_smooth=is_smooth)
    lengths = sample.correlation_lengths[1] / sample.strip_length
    if lengths * LENGTH_OF_SHORT_STRIP > 1:
        return _work_of_short_strip(scene, sample, sq=sq, speed=speed, count=count, ends=ends, is_smooth=is_smooth)
    strips = count * (1 + ON_LONGER_CELLS) * steps.work(cells, steps.first)
    again = steps.work(cells, steps.again) * (OF_SLOPE + ends)
    left = fx * ux, fy * uy
    pieces = 0.0
    if max(left) >= 2:
        finer = min(left[0], 2) * min(left[1], 2) * PIECE_LENGTH * lengths * cells
        line = scene.line_contact(abs(speed))
        is_rubbed = is_smooth and line.moes_film < RUBBED_FILM * sq and not are_soft(line, sq)
        number = PIECES_OF_RUBBED if is_rubbed else 1.0
        if count > 1:
            number = PIECES_OF_MORE_STRIPS if is_smooth else PIECES_IF_NOT_SMOOTH
        on_shorter = expected_steps(scene, sq, speed, min(left[0], 2) * columns)
        pieces += number * (1 + ON_LONGER_CELLS) * on_shorter.work(finer, on_shorter.first)
    if max(left) >= 4:
        finest = min(left[0], 4) * min(left[1], 4) * LENGTH_OF_LAST_PIECE * lengths * cells
        part = _part_of_last_level(scene, sq=sq, speed=speed, cell=0.5 * fx * dx, count=count, is_smooth=is_smooth)
        on_shortest = expected_steps(scene, sq, speed, min(left[0], 4) * columns)
        pieces += part * (1 + ON_LONGER_CELLS) * on_shortest.work(finest, on_shortest.first)
        if min(left) >= 8 and not is_smooth:
            on_still_shorter = expected_steps(scene, sq, speed, 8 * columns)
            pieces += part * SHORTER_IF_NOT_SMOOTH * on_still_shorter.work(4 * finest, on_still_shorter.first)
    if scene.numerics.max_work is not None:
        pieces = min(pieces, PIECES_SHARE * max(scene.numerics.max_work - strips, 0.0))
    return strips + pieces + again


def _work_in_levels(
    scene: Scene, sample: Sample, *, sq: float, speed: float, count: int, ends: float, is_smooth: bool
) -> float:
    """Return the counted work [s] of a patch at rest, or of ``count`` strips no longer than `LENGTH_OF_LAST_PIECE`, on
    shorter and shorter cells, and of so many ``ends`` of input ranges: the geometric mean over where the shorter cells
    may end.

    A patch, or one of the strips, is solved on them until the estimated error is within the tolerance
    (`_log_change_of_patch`), or they take too much work; the ends on the last ones, or on the first of strips.
    ``is_smooth``: whether the heights are smooth over a cell.
    """
    numerics = scene.numerics
    is_patch = sample.refines_in_place
    over_first_change = error_of_patch((1.0,)) if is_patch else ERROR_OVER_CHANGE
    (dx, dy) = sample.cells.native_spacing
    columns = sum(reach(scene.line_contact(abs(speed)), sq)) / dx
    rows = sample.strip_length / dy

    def shorten(coarsening: tuple[int, int]) -> tuple[int, int]:
        (fx, fy) = coarsening
        return shortened(scene, sample, MapCoarsening((fx, fy))) if is_patch else (max(1, fx // 2), max(1, fy // 2))

    (sx, sy) = sample_coarsening_of(scene, sample)
    coarsening = sx * sample.cells.coarsening[0], sy * sample.cells.coarsening[1]
    first_cell = coarsening[0] * dx
    (on_longer, _) = _solves_on(scene, sample, (2 * coarsening[0], 2 * coarsening[1]), sq=sq, speed=speed)
    (first, again) = _solves_on(scene, sample, coarsening, sq=sq, speed=speed)
    work = count * (on_longer + first) + OF_SLOPE * again
    most = MOST_WORK_OF_POINT if numerics.max_work is None else PIECES_SHARE * numerics.max_work
    log_work = 0.0
    left = 1.0  # probability that the cells are shortened so far
    halvings = 0
    while (shorter := shorten(coarsening)) != coarsening:
        (next_first, next_again) = _solves_on(scene, sample, shorter, sq=sq, speed=speed)
        part = 1.0
        is_needed = numerics.grid == "given" or (not is_patch and halvings == 0 and not is_smooth)
        if not is_needed:
            cell = first_cell / 2**halvings  # along y alone they change f no more than along both
            log_change = _log_change_of_patch(scene, sample, sq=sq, speed=speed, cell=cell)
            log_change += 0.0 if is_smooth else math.log(CHANGE_IF_NOT_SMOOTH)
            over_change = ERROR_OVER_CHANGE if halvings else over_first_change
            part = _part_above(numerics.tolerance / over_change, log_change)
        log_work += left * (1.0 - part) * math.log(work + ends * again)
        left *= part
        if why_too_many(columns * rows / (shorter[0] * shorter[1])) or (halvings > 0 and next_first > most):
            break
        coarsening = shorter
        work += next_first
        again = next_again if is_patch else again
        halvings += 1
    return math.exp(log_work + left * math.log(work + ends * again))


def _part_above(change: float, log_expected: float) -> float:
    """Return the probability that a change of f is above ``change`` [-], if ``log_expected`` is the mean of its
    logarithm."""
    return 0.5 * math.erfc((math.log(change) - log_expected) / (math.sqrt(2.0) * CHANGE_SPREAD))


def _log_change_of_patch(scene: Scene, sample: Sample, *, sq: float, speed: float, cell: float) -> float:
    """Return the logarithm of the change of f to a ``cell`` along x of this length [m] from one twice as long that is
    expected of a patch at rest."""
    log_ratio = math.log(scene.line_contact(abs(speed)).moes_film / sq)
    by_film = -CHANGE_BY_FILM * (log_ratio - LARGEST_CHANGE) ** 2
    by_length = CHANGE_BY_LENGTH * math.log(cell / sample.correlation_lengths[0])
    by_half_width = CHANGE_BY_HALF_WIDTH * math.log(cell / scene.bodies.half_width)
    log_change = math.log(CHANGE_OF_PATCH) + by_film + by_length + by_half_width
    if log_ratio <= 0:
        return log_change
    return max(log_change, math.log(CHANGE_OF_FILM * (cell / scene.bodies.half_width) ** 2))


def _part_of_last_level(scene: Scene, *, sq: float, speed: float, cell: float, count: int, is_smooth: bool) -> float:
    """Return the part of points of ``count`` strips that solve the last level: all or none of soft bodies, by the
    length of the ``cell`` [m] of the level before (`error_of_soft_bodies`); ``is_smooth``: whether the heights are
    smooth over a cell."""
    line = scene.line_contact(abs(speed))
    if are_soft(line, sq):
        is_solved = SOFT_CELL_ERROR * (cell / line.half_width) ** 2 > scene.numerics.tolerance
        return 1.0 if is_solved else 0.0
    if not is_smooth:
        return LAST_LEVEL_IF_NOT_SMOOTH
    return LAST_LEVEL_OF_MORE_STRIPS if count > 1 else LAST_LEVEL_OF_ONE_STRIP


def _work_of_short_strip(
    scene: Scene, sample: Sample, *, sq: float, speed: float, count: int, ends: float, is_smooth: bool
) -> float:
    """Return the same as `_work_at_rest` of strips that are shorter than `LENGTH_OF_SHORT_STRIP`: all of one is solved
    on shorter cells."""
    (fx, fy) = sample_coarsening_of(scene, sample)
    (ux, uy) = sample.cells.coarsening
    cx = fx * ux
    cy = fy * uy
    (on_longer, _) = _solves_on(scene, sample, (2 * cx, 2 * cy), sq=sq, speed=speed)
    (first, again) = _solves_on(scene, sample, (cx, cy), sq=sq, speed=speed)
    shorter = (
        _solves_on(scene, sample, (max(1, cx // 2), max(1, cy // 2)), sq=sq, speed=speed)[0] if max(cx, cy) > 1 else 0.0
    )
    shortest = 0.0
    if cx >= 4 <= cy:
        shortest = _solves_on(scene, sample, (cx // 4, cy // 4), sq=sq, speed=speed)[0]
    part = 1.0
    if is_smooth and scene.line_contact(abs(speed)).moes_film < RUBBED_FILM_OF_SHORT_STRIP * sq:
        part = PIECES_OF_RUBBED
    least = count * (on_longer + first) + (OF_SLOPE + ends) * again + part * shorter
    return least * (1.0 + part * shortest / least) ** QUARTER_OF_SHORT_STRIP


def _solves_on(
    scene: Scene, sample: Sample, coarsening: tuple[int, int], *, sq: float, speed: float
) -> tuple[float, float]:
    """Return the counted work [s] of a strip of roughness of ``sq`` [m] at rest on cells of the length ``coarsening``,
    in native ones, and of one from a solution nearby."""
    (dx, dy) = sample.cells.native_spacing
    columns = sum(reach(scene.line_contact(abs(speed)), sq)) / (coarsening[0] * dx)
    cells = columns * sample.strip_length / (coarsening[1] * dy)
    steps = expected_steps(scene, sq, speed, columns)
    return steps.work(cells, steps.first), steps.work(cells, steps.again)


def _seconds_in_motion(
    scene: Scene, sample: Sample, surface: Surface, speed: float, measured: FirstSteps | None = None
) -> float:
    """Return the processor time [s] of a strip of moving roughness at ``speed`` [m/s]: expected, or as its first steps
    are ``measured``."""
    sample_coarsening = sample_coarsening_of(scene, sample)
    rest = COURSE_OF_TIME.rest if measured is None else measured.rest
    way = expected_way(scene, sample, sq=surface.sq, speed=speed)
    work = moving_point_work(
        scene,
        sample,
        surface,
        speed,
        sample_coarsening=sample_coarsening,
        course=replace(COURSE_OF_TIME, rest=rest, way=way),
        factor=None if measured is None else measured.factor,
    )
    if measured is not None:
        return measured.pace * work
    return _pace_in_motion(scene, sample, sq=surface.sq, speed=speed, sample_coarsening=sample_coarsening) * work


def expected_way(scene: Scene, sample: Sample, *, sq: float, speed: float) -> float:
    """Return the distance that the roughness of ``sq`` [m] travels at ``speed`` [m/s] in the moments that count, in
    half-widths of the film: at least `PILOT_WAY`, and at most a complete pass of the map."""
    needed = _needed_strips(scene, sample, sq=sq, speed=speed)
    part = min(1.0, PASSED_PART * math.sqrt(needed))
    map_length = sample.cells.columns * sample.cells.spacing[0]
    return max(PILOT_WAY, part * map_length / film_half_width(scene.line_contact(abs(speed))))


def measured_time(prepared: Prepared, speed: float, measured: FirstSteps) -> MeasuredTime:
    """Return what the ``measured`` first steps of a strip of moving roughness at ``speed`` [m/s] say of its processor
    time."""
    scene = prepared.scene
    sample = prepared.sample
    surface = prepared.surface
    expected = _seconds_in_motion(scene, sample, surface, speed)
    seconds = _seconds_in_motion(scene, sample, surface, speed, measured)
    is_ended = scene.numerics.model == AUTO
    return MeasuredTime(
        speed=speed,
        over_expected=seconds / expected,
        steps=measured.steps,
        seconds=measured.seconds,
        most_strip_seconds=seconds * MOST_WORK_OF_POINT / measured.forecast if is_ended else math.inf,
    )


def _is_too_costly(scene: Scene, sample: Sample, surface: Surface, speed: float) -> bool:
    """Return whether "auto" leaves moving roughness to the quick answer (`why_too_costly`)."""
    work = moving_point_work(scene, sample, surface, speed, sample_coarsening=sample_coarsening_of(scene, sample))
    return work > MOST_WORK_OF_POINT


def _may_be_halved(scene: Scene, sample: Sample, surface: Surface, speed: float) -> bool:
    """Return whether strips of moving roughness may be solved again at ``speed`` [m/s] on cells half as long along y:
    where the error by the cells is expected to be above ``numerics.model_tolerance``."""
    (along, across) = sample_coarsening_of(scene, sample)
    (least, most) = MIXED_FILMS
    if across % 2 or not least <= scene.line_contact(abs(speed)).moes_film / surface.sq <= most:
        return False
    (dx, dy) = sample.cells.spacing
    cells = CellsInMotion.on_cells(
        (along * dx, across * dy),
        lengths=sample.lengths_by_slopes,
        unlike=unlikeness(sample),
        half_width=film_half_width(scene.line_contact(abs(speed))),
        film_ratio=4.0**EXPECTED_STEEPNESS,
        follows_lubricant=True,
        is_smooth=is_smooth_over_cells(surface.heights),
    )
    return cells.shorter_ones_pay(scene.numerics.model_tolerance)


def work_of_fine_fields(scene: Scene, sample: Sample, sq: float, speed: float, solved: tuple[int, int]) -> float:
    """Return the processor time [s] of fields at ``speed`` [m/s] on cells fine enough to look at (`fine_fields_of`),
    which are solved from the dry contact, or of a patch from cells of length ``solved``, in native ones, where these
    are too long; ``sq`` [m]: of the surface."""
    (dx, dy) = sample.cells.native_spacing
    around = sum(reach(scene.line_contact(abs(speed)), sq))
    if sample.refines_in_place:
        (fx, fy) = patch_coarsening_to_look_at(scene, sample, solved)
        if (fx, fy) == solved:
            return 0.0
        on_patch = expected_steps(scene, sq, speed, around / (fx * dx))
        return AT_REST * on_patch.work(around / (fx * dx) * sample.strip_length / (fy * dy), on_patch.first)
    (fx, fy) = sample.cells.coarsening_to_look_at(scene.bodies.half_width)
    length = sample.length_of_piece(pictured_length(scene, sample))
    cells = around / (fx * dx) * length / (fy * dy)
    steps = expected_steps(scene, sq, speed, around / (fx * dx))
    return AT_REST * (1 + ON_LONGER_CELLS) * steps.work(cells, steps.first)


def pictured_length(scene: Scene, sample: Sample) -> float:
    """Return the length of the piece of the surface whose fields are drawn, in correlation lengths."""
    return max(LEAST_PICTURED_LENGTH, PICTURED_LENGTH * scene.bodies.half_width / sample.correlation_lengths[1])


def work_on_long_cells(
    scene: Scene,
    sample: Sample,
    surface: Surface,
    speed: float,
    *,
    sample_coarsening: tuple[float, float],
    count: float,
) -> float:
    """Return the processor time [s] at ``speed`` [m/s] of ``count`` strips on cells ``sample_coarsening`` times as long
    as those of ``sample``, to which the ``surface`` belongs, and of the ends of input ranges."""
    sq = surface.sq
    if has_moving_roughness(scene):
        course = COURSE_ON_LONG_CELLS
        work = moving_point_work(
            scene,
            sample,
            surface,
            speed,
            sample_coarsening=sample_coarsening,
            course=course,
            factor=None,
        )
        return count * _pace_in_motion(scene, sample, sq=sq, speed=speed, sample_coarsening=sample_coarsening) * work
    (fx, fy) = sample_coarsening
    (dx, dy) = sample.cells.spacing
    length = sum(reach(scene.line_contact(abs(speed)), sq))
    cells = length / (fx * dx) * sample.strip_length / (fy * dy)
    ends = _solved_ends(scene, surface, speed)
    is_patch = sample.refines_in_place
    steps = expected_steps(scene, sq, speed, length / (fx * dx))
    strips = count * (1 + ON_LONGER_CELLS) * steps.work(cells, steps.first)
    again = (OF_SLOPE + ends) * steps.work(cells, steps.again)
    return AT_REST_ON_LONG_CELLS * (strips + again) + (SECONDS_OF_PATCH if is_patch else 0.0)


def moving_point_work(
    scene: Scene,
    sample: Sample,
    surface: Surface,
    speed: float,
    *,
    sample_coarsening: tuple[float, float],
    course: ExpectedCourse = EXPECTED_COURSE,
    factor: float | None = 1.0,
) -> float:
    """Estimate the counted work [s] of a point at ``speed`` [m/s] on one strip of moving roughness, ends of input
    ranges included.

    The cells are ``sample_coarsening`` times as long as those of ``sample``, to which the ``surface`` belongs.
    ``factor``: work of a step in time over that of a contact of which nothing else is known, as for the choice of
    "auto"; None: what is expected of this contact (`StepFacts`).
    """
    cell = sample_coarsening[0] * sample.cells.spacing[0]
    sq = surface.sq
    line = scene.line_contact(abs(speed))
    cells = _cells_in_motion(scene, sample, sq=sq, speed=speed, sample_coarsening=sample_coarsening)
    fastest = abs(speed) * max(abs(ratio) for _, ratio in moving_bodies(scene))
    solved_ends = _solved_ends(scene, surface, speed)
    if not sample.represents_more:  # all of the map passes
        course = replace(course, way=math.inf)
    if factor is None:
        factor = StepFacts.of(scene, sq=sq, speed=speed, lengths=sample.correlation_lengths, cell=cell).factor
    return moving_work(
        line,
        sq,
        cell=cell,
        fastest=fastest,
        length=sample.cells.columns * sample.cells.spacing[0],
        cells=cells,
        continuations=solved_ends,
        course=course,
        factor=factor,
    )


def _cells_in_motion(
    scene: Scene, sample: Sample, *, sq: float, speed: float, sample_coarsening: tuple[float, float]
) -> float:
    """Return the number of cells of a strip whose roughness of ``sq`` [m] moves at ``speed`` [m/s], of a length
    ``sample_coarsening`` in those of ``sample``."""
    (fx, fy) = sample_coarsening
    (dx, dy) = sample.cells.spacing
    line = scene.line_contact(abs(speed))
    effort = effort_for(line, sq, fx * dx)
    ends = reach(line, sq, inlet=effort.inlet, outlet=effort.outlet)
    return sum(ends) / (fx * dx) * sample.strip_length / (fy * dy)


def _pace_in_motion(
    scene: Scene, sample: Sample, *, sq: float, speed: float, sample_coarsening: tuple[float, float]
) -> float:
    """Return the expected processor time of such a strip over its counted work (`SMALL_ARRAYS`); arguments as of
    `_cells_in_motion`."""
    cells = _cells_in_motion(scene, sample, sq=sq, speed=speed, sample_coarsening=sample_coarsening)
    return IN_MOTION * (1.0 + SMALL_ARRAYS / cells)


def _solved_ends(scene: Scene, surface: Surface, speed: float) -> float:
    """Return how many ends of input ranges are expected to be solved: of the hardness those that asperities reach, and
    where roughness moves, of the shear of the oil those that change the flow. The others follow from the solved
    point."""
    is_moving = has_moving_roughness(scene)
    number = 0.0
    for name, *_ in scene.ranges:
        if name == HARDNESS_KEY:
            number += solved_ends_of_hardness(scene, surface, speed)
        elif name in OF_SHEAR and is_moving:
            number += solved_ends_of_shear(scene, surface.sq, speed, name)
        elif name not in (BOUNDARY_FRICTION_KEY, *LENGTH_KEYS):  # these are solved by the quick model
            number += 2.0
    return number


def _cells_of_strip(scene: Scene, sample: Sample, *, sq: float, speed: float) -> float:
    """Return the number of cells of a strip whose roughness of ``sq`` [m] rests at ``speed`` [m/s]."""
    (fx, fy) = sample_coarsening_of(scene, sample)
    (dx, dy) = sample.cells.spacing
    return sum(reach(scene.line_contact(abs(speed)), sq)) / (fx * dx) * sample.strip_length / (fy * dy)


def why_too_many_cells(prepared: Prepared, speed: float) -> str:
    """Return why a strip at ``speed`` [m/s] has too many cells to be solved; "" if it has not."""
    return why_too_many(_cells_of_strip(prepared.scene, prepared.sample, sq=prepared.surface.sq, speed=speed))


def why_too_costly(prepared: Prepared, speed: float, sample_coarsening: tuple[float, float]) -> str:
    """Return why "auto" leaves moving roughness to the quick model; "" if it does not."""
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
        f"{float(f'{work:.2g}'):g} s of counted work, more than {MOST_WORK_OF_POINT:g} s; set numerics.model = "
        "'deterministic' to solve it"
    )
