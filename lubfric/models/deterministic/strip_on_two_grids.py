"""One strip of the surface by the deterministic model, on two lengths of cells."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial
from typing import NewType

from ..._base import may_stay_unsolved
from ...quantities import NUMBERS
from ...samples import Sample, longest_cell_in_motion
from ...scene import Scene, has_moving_roughness
from ...surface import Surface
from ..shared import Prepared
from .moving_strip import SampleTarget, compared_moments, solve_moving_strip, strip_at_rest
from .result import DeterministicResult
from .rough_bodies import bodies_of, map_of_strip, summit_control
from .strip import UNKNOWN_SLOPE, StripSolution, solve_strip

# Cells in a correlation length, at least. A choice: fewer show no correlation. Half and twice this value change f by up
# to 1.3 %, its interval by up to 6.4 % and the work by up to 590 % (constants.csv).
PER_LENGTH = 2.0

# Cells in the Hertz half-width along x, at least. A choice: fewer show no contact. Half and twice this value change f
# by up to 1.8 %, its interval by up to 28 % and the work by up to 270 % (constants.csv).
PER_HALF_WIDTH = 1.0
# Cells along one axis over those along the other [-], each in what they have to resolve, up to which a patch is solved
# on shorter ones along it: beyond, the error of f, of second order, comes from the other axis. A choice: a larger value
# solves needless cells, a smaller one leaves an error that no change of f shows.
MUCH_SHORTER = 0.25

# Part of numerics.sampling_tolerance: standard error of f at which a strip of moving roughness ends. A choice: a
# smaller value takes longer, a larger one leaves less to other errors.
MOVING_SAMPLE = 0.6

# Cells in a correlation length along x, at least, where roughness moves (docs/tolerances.md).
PER_LENGTH_IN_MOTION = 4.0

# Lengths of cells along x and y: in cells of the sample, of the map of a strip, and of the scene.
SampleCoarsening = NewType("SampleCoarsening", tuple[int, int])
MapCoarsening = NewType("MapCoarsening", tuple[int, int])
NativeCoarsening = NewType("NativeCoarsening", tuple[int, int])


@dataclass(frozen=True, kw_only=True)
class StripOnTwoGrids:
    """One strip of the sample, on two lengths of cells.

    Attributes
    ----------
    resolved : on the cells of the answer
    longer : on longer cells (`longer_than`), from which it started; of moving roughness, followed there from rest over
        the first moments, or only at rest, where that had no solution
    is_mirrored : whether the second half along y is the mirror image of the first
    has_halved_cells : whether its cells along y are half as long as by `sample_coarsening_of`
    """

    resolved: StripSolution
    longer: StripSolution
    is_mirrored: bool = False
    has_halved_cells: bool = False

    @classmethod
    def on_one_grid(cls, strip: StripSolution) -> StripOnTwoGrids:
        """Return ``strip`` as a pair where it has no solution on longer cells: both are this one."""
        return cls(resolved=strip, longer=strip)

    @property
    def is_on_one_grid(self) -> bool:
        """Whether there is no solution on longer cells."""
        return self.longer is self.resolved

    @property
    def change_by_cells(self) -> float:
        """The change of f (`change_of_places`) from the longer cells to those of the strip."""
        return self.resolved.change_from(self.longer)


def sample_coarsening_of(scene: Scene, sample: Sample) -> SampleCoarsening:
    """Return the length of the cells of the deterministic model in those of the ``sample``, along x and y: 2, or 1
    where 2 would leave less than `PER_LENGTH` (or `PER_LENGTH_IN_MOTION`) in a correlation length or `PER_HALF_WIDTH`
    in half the Hertz strip, of moving roughness more than `longest_cell_in_motion`, or does not divide the rows of a
    strip. Where roughness moves, ``numerics.grid = "given"`` takes those of the scene."""
    if has_moving_roughness(scene) and scene.numerics.grid == "given":
        return SampleCoarsening((1, 1))
    (lx, ly) = sample.correlation_lengths
    (dx, dy) = sample.cells.spacing
    is_moving = has_moving_roughness(scene)
    longest = min(lx / (PER_LENGTH_IN_MOTION if is_moving else PER_LENGTH), scene.bodies.half_width / PER_HALF_WIDTH)
    if is_moving:
        longest = min(longest, longest_cell_in_motion(scene, sample.sq))
    is_doubled_along_x = longest >= 2 * dx * (1 - 1e-9)
    is_doubled_along_y = ly / PER_LENGTH >= 2 * dy * (1 - 1e-9) and sample.rows % 2 == 0
    return SampleCoarsening((2 if is_doubled_along_x else 1, 2 if is_doubled_along_y else 1))


def surface_and_map_coarsening(prepared: Prepared, index: int) -> tuple[Surface, MapCoarsening]:
    """Return the map of strip ``index``, and the length of the cells of the deterministic model in those of this map.
    The map of a patch at rest is all of it, on its own cells (`Sample.refinement`)."""
    sample = prepared.sample
    surface = map_of_strip(prepared, index)
    if has_moving_roughness(prepared.scene):  # the map is on the cells of the sample
        return surface, MapCoarsening(sample_coarsening_of(prepared.scene, sample))
    return surface, coarsening_at_rest(prepared.scene, sample)


def patch_coarsening_to_look_at(scene: Scene, sample: Sample, solved: tuple[int, int]) -> NativeCoarsening:
    """Return the length, in native cells, of cells that show a patch at rest: those of length ``solved`` that f is
    found on, or the longest shorter ones that show the Hertz strip (`Cells.longest_to_look_at`) and divide the rows of
    the map; else native ones."""
    (dx, dy) = sample.cells.native_spacing
    longest = sample.cells.longest_to_look_at(scene.bodies.half_width)
    rows = sample.rows * sample.cells.coarsening[1]
    along = min(solved[0], max(1, int(longest / dx)))
    most = min(solved[1], max(1, int(longest / dy)))
    return NativeCoarsening((along, max(divisor for divisor in range(1, most + 1) if rows % divisor == 0)))


def coarsening_at_rest(scene: Scene, sample: Sample) -> MapCoarsening:
    """Return the length of the cells of the deterministic model where roughness rests, in those of the map of a strip:
    of a patch, in native ones (`Sample.refinement`)."""
    (sx, sy) = sample_coarsening_of(scene, sample)
    (rx, ry) = sample.refinement
    return MapCoarsening((sx * rx, sy * ry))


def shortened(scene: Scene, sample: Sample, map_coarsening: MapCoarsening) -> MapCoarsening:
    """Return half the ``map_coarsening`` of the cells of a patch at rest, or as near to that as native cells allow; the
    same along an axis whose cells are `MUCH_SHORTER` than those along the other, unless ``numerics.grid`` requests
    native cells."""
    (fx, fy) = map_coarsening
    halves = MapCoarsening(halved(map_coarsening))
    if scene.numerics.grid == "given":
        return halves
    (lx, ly) = sample.correlation_lengths
    (dx, dy) = sample.cells.native_spacing
    along = fx * dx / min(lx / PER_LENGTH, scene.bodies.half_width / PER_HALF_WIDTH)
    across = fy * dy / (ly / PER_LENGTH)
    return MapCoarsening(
        (fx if along <= MUCH_SHORTER * across else halves[0], fy if across <= MUCH_SHORTER * along else halves[1])
    )


def halved(coarsening: tuple[int, int]) -> tuple[int, int]:
    """Return half the ``coarsening``, at least 1."""
    (along, across) = coarsening
    return max(1, along // 2), max(1, across // 2)


def longer_than(surface: Surface, map_coarsening: MapCoarsening, *, is_moving: bool = False) -> MapCoarsening:
    """Return twice ``map_coarsening``; the same along y where twice that does not divide the map ``surface``, and along
    x where roughness ``is_moving``."""
    along = map_coarsening[0] if is_moving else 2 * map_coarsening[0]
    across = map_coarsening[1] if surface.shape[1] % (2 * map_coarsening[1]) else 2 * map_coarsening[1]
    return MapCoarsening((along, across))


def solve_pair(
    prepared: Prepared,
    speed: float,
    index: int,
    *,
    slope: float = UNKNOWN_SLOPE,
    find_slope: bool = False,
    has_halved_cells: bool = False,
    most_work: float = math.inf,
) -> StripOnTwoGrids:
    """Solve strip ``index`` by the deterministic model at ``speed`` [m/s], not 0, first on longer cells.

    ``slope``: of friction over load [-], as another strip has it; ``find_slope``: it is found by a second solve in its
    place, where the roughness rests (where that moves, blocks of time and place show it). ``has_halved_cells``: as of
    `StripOnTwoGrids`, of moving roughness. ``most_work``: as of `solve_moving_strip`. Raises `ConvergenceError`.
    """
    scene = prepared.scene
    surface, map_coarsening = surface_and_map_coarsening(prepared, index)
    if has_halved_cells:
        map_coarsening = halved_along_y(map_coarsening)
    if has_moving_roughness(scene):
        longer, strip = _solve_moving_pair(prepared, speed, index, surface, map_coarsening, most_work)
    else:
        solve = partial(solve_strip, scene, surface, speed, memo=prepared.memo)
        longer = solve(map_coarsening=longer_than(surface, map_coarsening))
        strip = solve(map_coarsening=map_coarsening, start=longer, find_slope=find_slope)
    strip = replace(strip, slope=strip.slope if find_slope else slope, work=strip.work + longer.work)
    is_mirrored = prepared.sample.distinct_rows(surface.heights) < surface.shape[1]
    return StripOnTwoGrids(resolved=strip, longer=longer, is_mirrored=is_mirrored, has_halved_cells=has_halved_cells)


def _solve_moving_pair(
    prepared: Prepared,
    speed: float,
    index: int,
    surface: Surface,
    map_coarsening: MapCoarsening,
    most_work: float,
) -> tuple[StripSolution, StripSolution]:
    """Return strip ``index``, whose roughness moves over the map ``surface``, on longer cells and on cells of
    ``map_coarsening``. On longer cells it is followed over the first moments, where these are longer along y and that
    has a solution; else it is only at rest, and the change at rest is all that is known."""
    scene = prepared.scene
    longer_cells = longer_than(surface, map_coarsening, is_moving=True)
    bodies = bodies_of(prepared, index, speed)
    longer: StripSolution = strip_at_rest(scene, bodies, speed, map_coarsening=longer_cells)
    moving = solve_moving_strip(
        scene,
        bodies,
        speed,
        map_coarsening=map_coarsening,
        start=longer,
        target=sample_target(prepared, MOVING_SAMPLE * scene.numerics.sampling_tolerance),
        most_work=most_work,
    )
    if longer_cells[1] > map_coarsening[1]:
        with may_stay_unsolved():
            longer = solve_moving_strip(
                scene,
                bodies,
                speed,
                map_coarsening=longer_cells,
                start=longer,
                effort=moving.effort,
                most_steps=compared_moments(moving),
            )
    return longer, moving


def halved_along_y(map_coarsening: MapCoarsening) -> MapCoarsening:
    """Return ``map_coarsening``, which is even along y, for cells half as long there."""
    return MapCoarsening((map_coarsening[0], map_coarsening[1] // 2))


def on_halved_cells(prepared: Prepared, speed: float, pair: StripOnTwoGrids) -> StripOnTwoGrids:
    """Return the first strip, whose roughness moves, on cells half as long along y as those of ``pair``, with that as
    the one on longer cells. Raises `ConvergenceError`."""
    scene = prepared.scene
    longer = pair.resolved
    strip = solve_moving_strip(
        scene,
        bodies_of(prepared, 0, speed),
        speed,
        map_coarsening=halved_along_y(surface_and_map_coarsening(prepared, 0)[1]),
        start=longer,
        target=sample_target(prepared, MOVING_SAMPLE * scene.numerics.sampling_tolerance),
    )
    strip = replace(strip, slope=longer.slope, work=strip.work + longer.work)
    return replace(pair, resolved=strip, longer=longer, has_halved_cells=True)


def sample_target(prepared: Prepared, error: float) -> SampleTarget | None:
    """Return how long a strip of moving roughness is followed: until the relative standard ``error`` of f is reached;
    None: for a pass of its map, which is the only one."""
    control = summit_control(prepared)
    if control is None:
        return None
    return SampleTarget(
        relative_error=error, correlation_length=prepared.sample.correlation_lengths[1], control=control
    )


def numbers_of_strip(prepared: Prepared, result: DeterministicResult) -> dict[str, float]:
    """Return all numbers of a point but the time, by name; NaN where the model has no such number."""
    bodies = prepared.scene.bodies
    sq = prepared.surface.sq
    width = bodies.width
    contact_load = result.split.rubbing * width
    return dict.fromkeys(NUMBERS, math.nan) | {
        "speed": result.speed,
        "coefficient": result.coefficient,
        "contact_load": contact_load,
        "film_load": bodies.load - contact_load,
        "shear_force": (result.couette + result.rolling) * width,
        "couette_force": result.couette * width,
        "rolling_force": result.rolling * width,
        "rolling_resistance": result.rolling_resistance * width,
        "boundary_force": result.boundary * width,
        "boundary_film_load": result.split.thin * width,
        "saturated_film_load": result.split.saturated * width,
        "real_contact_area_fraction": result.rubbing_fraction,
        "real_contact_area": result.rubbing_length * width,
        "plastic_area_fraction": result.plastic_fraction,
        "min_film": result.min_gap,
        "central_film": result.central_gap,
        "mean_gap": result.mean_gap,
        "film_to_roughness_ratio": result.central_gap / sq if sq > 0 else math.inf,
        "load_residual": result.report.residuals["load"],
    }
