"""What a point by load sharing will take, from closed forms: whether asperities touch, how many strips are solved, and
how long that takes. Nothing is solved.

Constants that name no other source are measured on the points of ``python -m verification.campaigns.estimates``.
"""

import math

import numpy as np

from ...film import LineContact, flooded_inlet, smallest_film
from ...oil import shear_stress
from ...samples import PIECE_LENGTH, Cells, Sample
from ...scene import BOUNDARY_FRICTION_KEY, LENGTH_KEYS, Scene, has_moving_roughness
from ...surface import GROOVE_LENGTH_RATIO, Surface
from ..shared import GAP_IN_CONTACT, SAMPLE_GROWTH, STRIPS_SAFETY, inlet_at, is_smooth_over_cells
from ..work_estimate import ALL_TOUCH, FEW_TOUCH, NONE_TOUCHES, SharedWork, WorkEstimate
from .balanced_sample import nearest_reference
from .cell_effect import MOST_PIECE_CELLS
from .error_of_eq8 import load_sharing_error

# Processor time [s] of a film without heat in the balance of a point: 2.4 to 4.5 ms in 55 points of 11 random scenes of
# `python -m verification.campaigns.estimates`.
BALANCED_FILM = 3e-3

# Processor time [s] of each cell of the strips in one solve of their contact. It was .5 to 1.5e-7 there.
CELL_SECONDS = 1.0e-7

# Where most of a wide Hertz strip touches, a contact takes more iterations. The time of a cell grows by this factor
# times the flattening of the bodies in Sq and the part of the gap that no film fills [-]. It was 7e-7 s at 36 Sq, and
# 2e-7 s at 6 Sq.
TIMES_BY_FLATTENING = 0.17

# `TIMES_BY_FLATTENING` where the heights are not smooth over a cell [-]. Fitted with `ROUGH_CELLS_OF_LENGTH` to 77
# points on exponential surfaces: 74 % within a factor of 3, and nearly all if it were known how often their cells are
# halved.
TIMES_BY_FLATTENING_IF_ROUGH = 0.39

# Processor time [s] of a cell of a piece on shorter cells, which starts from fewer known ones: .8 to 2.2e-7 there.
PIECE_SECONDS = 1.5e-7

# Processor time [s] of a cell of the map of a piece on native cells, which is generated: .7 to 1.8e-7 there.
GENERATED_SECONDS = 1.1e-7

# Number of films and contacts that the load balance of a point solves, with those of its response, where it starts
# from a reference point. It was 3 to 9 there.
SOLVES = 6

# The same number for the balance on more strips, which starts from that on fewer. It was 8 to 10 there, but half of the
# points that are expected to need more strips do not.
SOLVES_ON_MORE = 5

# Films and contacts of the balance of the reference point, which no other is near: 6 to 9 there.
SOLVES_OF_REFERENCE = 7

# Films and contacts of the balance at an end of the range of an input, which starts from that at the input itself [-].
# Measured in the paper's contact: 1 to 2.
SOLVES_AT_END = 2

# Sizes of cells on which a piece is solved, at least. It follows from `cell_effect`: one change of f needs two.
FEWEST_CELLS = 2

# Part of the points that solve pieces at their own load, because the reference point is too far away [-]. It was 25 of
# 55 there.
OWN_PIECES = 0.5

# Processor time [s] of the contact on a map that is solved whole, however small.
PATCH_SECONDS = 0.03

# Processor time [s] of each cell of such a map.
MAP_SECONDS = 4e-8

# Processor time [s] of all other work of a point on strips: .009 to .03 s there.
POINT_SECONDS = 0.012

# Processor time [s] of the films of a point without heat.
FILM_SECONDS = 0.015

# Factor on this time with heat [-].
HEAT_TIME_RATIO = 5.0

# Cells in a correlation length along x, at most, until which cells are halved in the mean where the heights are not
# smooth over a cell and the film carries a part of the load (`SHARED_IF_ROUGH`). Fitted to the halvings of 53 of these
# points, by their likelihood.
ROUGH_CELLS_OF_LENGTH = 18.0

# Flattening of the bodies in Sq at which there are as many; and the fall of their binary logarithm with the square of
# how far its natural logarithm is from that [-]: neither light nor wide contacts need so many. Fitted.
ROUGH_FLATTENING = 2.4
ROUGH_BY_FLATTENING = 0.16

# Standard deviation of the number of halvings (fitted), and their largest number (observed) [-].
HALVINGS_SPREAD = 0.98
MOST_HALVINGS = 3

# Cells are halved where the film of the whole load fills a part of the gap between these two [-]: at half of the points
# there, and at none outside.
SHARED_IF_ROUGH = (0.1, 0.93)

# Factor on the time where the heights are smooth over a cell, and cells are longer than those of the map: shorter ones
# may follow. Four random runs were estimated to .56 to 1.4 of what they took without it, and to .64 to 1.7 with it.
REFINED = 1.3

# Part of the gap that the film of the whole load fills, between which that happens. A choice: it moves estimates alone.
SHARED = (0.08, 0.6)

# Scatter of f over that by the closed form, where asperities carry a part of the load. Fitted to flooded contacts
# there.
SCATTER = 1.8

# Part of the area [-] that is more than two standard deviations above the mean in Gaussian heights: by definition.
ABOVE_TWO_SQ = 0.02275

# Scatter of f on plateau-honed surfaces over that by the area of their grooves, in addition [-]. Fitted to 16 random
# contacts at lambda ratios of .08 to 3.9: 12 are estimated within a factor of 3 of the strips that they take, and 4 to
# more; without it 10, and 6 to up to a tenth.
SCATTER_OF_GROOVES = 0.7

# Film [Sq] at which that has fallen to 1/e, because the film carries the load everywhere. Fitted as `SCATTER`.
SEPARATED = 2.5

# `SEPARATED` between bodies that flatten by less than Sq, whose highest summits touch below a thicker film: the
# deterministic model solves 16, 24, 1 strips at 3.3, 3.7, 4.5, load sharing in curves of those campaigns 9 to 64 at 4.5
# and 1 at 5.5.
SEPARATED_IF_ROUND = 4.0

# Part of the film of the whole load by which it is wider, about. A choice, for an estimate.
RISE = 0.4

# Friction where the film carries most of the load, over f_b, about. A choice, for an estimate.
FILM_FRICTION = 0.25

# Film [Sq] that meets very few asperities. A choice, above the 4.5 of `HIGHEST_SUMMITS`.
CLEAR_OF_ASPERITIES = 5.5

# Films [Sq] between which all of a piece is solved on native cells, for summits that longer ones cut off. A choice,
# around the 4.5 of `HIGHEST_SUMMITS`.
LAST_SUMMITS = (4.0, 5.5)

# Factor between the expected film and any film: outside of it contact or separation is certain. A choice: it moves
# estimates alone.
CERTAIN_FACTOR = 2.0

# Solved central film over the film by the closed form: .67 to .92 in 24 contacts of smooth surfaces, L of 5 to 24 and M
# of .002 to 56. It moves estimates alone.
SOLVED_FILM = 0.83


def estimated_work(scene: Scene, sample: Sample, surface: Surface, speed: float) -> WorkEstimate:
    """Return what a point at ``speed`` [m/s] will take; ``surface``: the `Sample.stated_map`."""
    film = scene.line_contact(speed).expected_film if speed else 0.0
    sq = surface.sq
    summit = float(surface.heights.max() - surface.heights.mean())
    asperities = _asperities(film, summit)
    seconds = FILM_SECONDS * _times_by_heat(scene)
    # where asperities carry load it does not suffice, however wide the tolerance (`PaperSolution.why_sufficient`)
    central_film = _expected_central_film(scene, speed)
    error_of_model = expected_model_error(scene, central_film, sq, speed) if central_film > summit else math.inf
    scatters = sample.represents_more or (sample.is_resolved and sq > 0)
    error = expected_sampling_error(scene, sample, surface, film, speed) if scatters else math.nan
    if not sample.represents_more:
        if asperities != NONE_TOUCHES:
            seconds += PATCH_SECONDS + MAP_SECONDS * surface.heights.size
        return WorkEstimate(
            strips=1,
            seconds=seconds,
            ends_seconds=_ends(scene) * seconds,
            expected_sampling_error=error,
            expected_model_error=error_of_model,
            asperities=asperities,
        )
    target = scene.numerics.sampling_tolerance
    count = math.ceil(sample.first_strips * max(1.0, STRIPS_SAFETY * (error / target) ** 2 if error > target else 1.0))
    count = min(count, sample.available_strips)
    shared: tuple[SharedWork, ...] = ()
    one_end = FILM_SECONDS * _times_by_heat(scene)
    if asperities != NONE_TOUCHES:
        (of_strips, one_end, shared) = _work_of_strips(scene, sample, surface, film, count)
        seconds += of_strips
    return WorkEstimate(
        strips=count,
        seconds=seconds,
        ends_seconds=_ends(scene) * one_end,
        shared=shared,
        length=sample.line_length(count),
        expected_sampling_error=error,
        expected_model_error=error_of_model,
        asperities=asperities,
    )


def _expected_central_film(scene: Scene, speed: float) -> float:
    """Return the expected central film [m] of the total load at ``speed`` [m/s], with the heat of the inlet; 0 at
    rest."""
    (inlet, is_used) = inlet_at(scene, speed)
    factor = inlet.factor if inlet is not None and is_used else 1.0
    return SOLVED_FILM * scene.line_contact(speed).expected_film_with(factor) if speed and factor > 0 else 0.0


def _asperities(film: float, summit: float) -> str:
    """Return whether asperities touch under an expected ``film`` [m] below a ``summit`` [m] above the mean height, as
    text."""
    if CERTAIN_FACTOR * film < summit:
        return ALL_TOUCH
    return NONE_TOUCHES if film > CERTAIN_FACTOR * summit else FEW_TOUCH


def _times_by_heat(scene: Scene) -> float:
    """Return the factor on the time of a film by its heat."""
    return HEAT_TIME_RATIO if scene.lubricant.heats and scene.numerics.heat != "off" else 1.0


def _ends(scene: Scene) -> int:
    """Return how many points the ends of the input ranges of ``scene`` take, which the answer solves on its first
    strips: f at each end, and at the inputs themselves to begin with and to compare with. The quick model solves those
    of correlation lengths."""
    ends = 2 * sum(name not in (BOUNDARY_FRICTION_KEY, *LENGTH_KEYS) for name, *_ in scene.ranges)
    return ends + 2 if ends else 0


def expected_sampling_error(scene: Scene, sample: Sample, surface: Surface, film: float, speed: float) -> float:
    """Return the expected relative standard error of f after the first strips of ``sample``, under the ``film`` [m] of
    the total load on the ``surface``; 0 where very few asperities touch, and without entrainment.

    The mean gap over a line of length L and half-width b scatters as a mean of L (2b + sqrt(pi) lx)/(pi lx ly)
    independent heights. The effect on f follows from the share of the load that the rigid film of the total load would
    carry if it were as thick as the gap. `SCATTER` and `SEPARATED` were found in flooded contacts, with the film that
    flows; a starved ring needed 61 strips where they give 2, and its smallest film gives 15. On plateau-honed surfaces
    the grooves scatter, and the heights of the plateaus touch (`upper_sq`).
    """
    sq = surface.sq
    separating_film = SEPARATED_IF_ROUND if flattening(scene, sq) < 1 else SEPARATED
    smallest = film
    if not scene.lubricant.floods:
        smallest = smallest_film(film, math.sqrt(2 * scene.bodies.radius * film), scene.bodies.half_width)
    if not (speed and smallest <= CLEAR_OF_ASPERITIES * sq):
        return 0.0
    (lx, ly) = sample.correlation_lengths
    first = sample.first_strips * sample.strip_length
    grooves = _area_of_groove(scene)
    touching_sq = upper_sq(surface) if grooves else sq
    gap = expected_gap(film, touching_sq)
    share = min(film / gap, 1.0)
    area = SCATTER_OF_GROOVES**2 * grooves or lx * ly
    scatter = sq * math.sqrt(math.pi * area / (first * (2 * scene.bodies.half_width + math.sqrt(math.pi) * lx)))
    scatter *= SCATTER * math.exp(-((smallest / (separating_film * touching_sq)) ** 3)) / gap
    return scatter * share / (1 - share + FILM_FRICTION)


def upper_sq(surface: Surface) -> float:
    """Return the Sq [m] of Gaussian heights whose summits are as high above the mean height as those of ``surface``."""
    heights = surface.heights
    return float(np.quantile(heights, 1.0 - ABOVE_TWO_SQ) - heights.mean()) / 2.0


def _area_of_groove(scene: Scene) -> float:
    """Return the product [m²] of the correlation lengths along and across the grooves of the bodies of ``scene``, the
    largest; 0 where none is generated as plateau-honed."""
    honed = [body for body in (scene.surface, scene.counterface) if body is not None and body.sk is not None]
    widths = [body.groove_width or np.max(body.correlation_length or 0.0) for body in honed]
    return float(GROOVE_LENGTH_RATIO * max(widths, default=0.0) ** 2)


def _work_of_strips(
    scene: Scene, sample: Sample, surface: Surface, film: float, count: int
) -> tuple[float, float, tuple[SharedWork, ...]]:
    """Return the processor time [s] of the balance on ``count`` strips of ``sample`` under an expected ``film`` [m],
    that of one end of an input range, and the parts of the former that other points are spared: pieces, and the
    reference point."""
    sq = surface.sq
    (lx, ly) = sample.correlation_lengths
    cells = sample.cells
    (fx, fy) = cells.coarsening
    shared: tuple[SharedWork, ...] = ()
    one_film = BALANCED_FILM * _times_by_heat(scene)
    is_smooth = is_smooth_over_cells(surface.heights)
    rate = TIMES_BY_FLATTENING if is_smooth else TIMES_BY_FLATTENING_IF_ROUGH
    times = 1 + rate * (1 - min(film / expected_gap(film, sq), 1.0)) * flattening(scene, sq)
    on_shorter = _times_by_shorter_cells(
        sample, film / expected_gap(film, sq), flattened=flattening(scene, sq), is_smooth=is_smooth
    )
    strip = times * CELL_SECONDS * cells.columns * sample.strip_length / cells.spacing[1]
    solved = sample.first_strips
    one_end = SOLVES_AT_END * (one_film + strip * solved)
    work = SOLVES * (one_film + strip * solved)
    (first_growth, later_growth) = SAMPLE_GROWTH
    while solved < count:
        most = later_growth if solved > sample.first_strips else first_growth
        solved = min(count, math.ceil(most * solved))
        work += SOLVES_ON_MORE * (one_film + strip * solved)
    work *= on_shorter
    pieces_seconds = 0.0
    native_seconds = 0.0
    if not cells.is_native:
        native = cells.columns * fx * cells.rows(PIECE_LENGTH * ly) * fy
        pieces_seconds = on_shorter * times * PIECE_SECONDS * cells_of_pieces(cells, native)
        native_seconds = PIECE_SECONDS * native
        made = GENERATED_SECONDS * native
        shared = (SharedWork(what=f"pieces on {cells.coarsening}", seconds=made, is_of_surface_alone=True),)
    if LAST_SUMMITS[0] * sq < film < LAST_SUMMITS[1] * sq:  # whether cells cut off a summit that would touch
        work += native_seconds
    reference = nearest_reference(film / sq)
    if reference is not None and scene.lubricant.inlet_film is None:
        there = on_shorter * SOLVES_OF_REFERENCE * (one_film + strip * sample.first_strips) + pieces_seconds
        name = f"reference point at {reference} Sq on {cells.coarsening}"
        shared = (*shared, SharedWork(what=name, seconds=there, is_of_surface_alone=False))
        pieces_seconds *= OWN_PIECES
    return POINT_SECONDS + work + pieces_seconds + sum(part.seconds for part in shared), one_end, shared


def _times_by_shorter_cells(sample: Sample, share: float, *, flattened: float, is_smooth: bool) -> float:
    """Return the factor on the time of the strips because shorter cells may follow, where the expected film fills this
    ``share`` of the gap between bodies ``flattened`` by so many Sq; ``is_smooth``: whether the heights are smooth over
    a cell."""
    cells = sample.cells
    (least, most) = SHARED if is_smooth else SHARED_IF_ROUGH
    if cells.is_native or not least < share < most:
        return 1.0
    if is_smooth:
        return REFINED
    mean = math.log2(ROUGH_CELLS_OF_LENGTH * cells.spacing[0] / sample.correlation_lengths[0])
    mean -= ROUGH_BY_FLATTENING * math.log(flattened / ROUGH_FLATTENING) ** 2
    log_times = 0.0  # the mean over the number of halvings, each of which is solved on four times as many cells
    for halvings in range(1, min(MOST_HALVINGS, round(math.log2(max(cells.coarsening)))) + 1):
        part = 0.5 * math.erfc((halvings - mean) / (math.sqrt(2.0) * HALVINGS_SPREAD))
        log_times += part * math.log((4.0 ** (halvings + 1) - 1) / (4.0**halvings - 1))
    return math.exp(log_times)


def flattening(scene: Scene, sq: float) -> float:
    """Return by how much the bodies of ``scene`` flatten over their Hertz strip, over the ``sq`` [m] of their
    roughness."""
    return float(scene.bodies.half_width**2 / (2 * scene.bodies.radius * sq))


def expected_gap(film: float, sq: float) -> float:
    """Return the expected mean gap [m] of surfaces of ``sq`` [m] under the rigid ``film`` [m] of the total load."""
    return GAP_IN_CONTACT * sq + RISE * film


def cells_of_pieces(cells: Cells, native: float) -> float:
    """Return the number of cells of a piece on ``cells`` and on ever shorter ones, summed; ``native``: that on native
    cells."""
    counts = [native / (fx * fy) for fx, fy in cells.coarsenings()]
    return sum(count for place, count in enumerate(counts) if place < FEWEST_CELLS or count <= MOST_PIECE_CELLS)


def expected_model_error(scene: Scene, thickness: float, sq: float, speed: float) -> float:
    """Return the expected model-form error of f under a ``thickness`` [m] on roughness of ``sq`` [m], relative, if
    asperities carry nothing; 0 without roughness, NaN without entrainment."""
    if sq == 0:
        return 0.0
    if speed == 0:
        return math.nan
    rolling = (
        rolling_share(scene.line_contact(speed), scene.bodies.mean_hertz_pressure)
        if has_moving_roughness(scene)
        else 0.0
    )
    return load_sharing_error(thickness / sq, share=0.0, boundary=0.0, shear=1.0, rolling=rolling).away


def rolling_share(line: LineContact, pressure: float) -> float:
    """Return the expected share of rolling in the friction of the film of ``line`` under a mean ``pressure`` [Pa], to a
    factor of two: pressure builds up in the inlet, and the Hertz strip and the film about it are sheared."""
    oil = line.lubricant
    film = line.expected_film
    b = line.half_width
    sliding = abs(line.sliding or 0.0)
    length = math.sqrt(2 * line.radius * film)
    eta = oil.viscosity
    rolling = eta * abs(line.entrainment_speed) * flooded_inlet(length, b)
    sheared = film * float(shear_stress(oil, pressure, sliding / film)) * b + eta * sliding * length
    return rolling / (rolling + sheared)
