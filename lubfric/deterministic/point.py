"""The deterministic film of a scene at one speed: on finer and finer grids, each started from the last, with an
estimate of the error that is left."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..scene import Scene, check_resolved_gap
from ..surface import Surface
from .problem import BOUNDARY_FILM, Problem, lay_out
from .result import DeterministicResult
from .solve import dry_contact, solve_point
from .state import FLUID, RUPTURED, State

LEAST, MOST = 32, 512  # cells across, of the coarsest and of the finest grid
KEPT = 0.9  # of Sq, on the coarsest grid
RATIO = (0.25, 0.75)  # between which the change from grid to grid is taken to fall
UNKNOWN_RATIO = 0.5  # from two grids: between first and second order
SHARP = 0.02  # share of the load on spots from which on the dry contact is interpolated with the state


@dataclass(frozen=True)
class Refined:
    """The solution on every grid, the coarsest first; ``error``: estimated relative error of the coefficient on the
    last grid (None with one grid)."""

    results: tuple[DeterministicResult, ...]
    error: float | None

    @property
    def result(self) -> DeterministicResult:
        """The result on the finest grid."""
        return self.results[-1]


def deterministic_point(scene: Scene, surface: Surface, speed: float) -> Refined:
    """The deterministic film of ``surface`` at ``speed`` [m/s], not 0, on grids that are fine enough for
    ``numerics.tolerance``. For a negative speed the map is turned.

    Raises `InputError` (`lubfric.scene.resolved_gap`) and `ConvergenceError`.
    """
    check_resolved_gap(scene)

    def lay(shape):
        return problem_of(scene, surface if shape == surface.shape else surface.resampled(shape=shape), speed)

    tolerance = 0.0 if scene.numerics.grid == "given" else scene.numerics.tolerance
    return solve_refined(lay, grids(scene, surface), tolerance=tolerance)


def problem_of(scene: Scene, surface: Surface, speed: float, factors: tuple[int, int] = (1, 1)) -> Problem:
    """``surface`` under the bodies of ``scene`` at ``speed`` [m/s], not 0, on its own cells or on cells ``factors``
    times as long (`lay_out`). For a negative speed the map is turned."""
    return lay_out(
        replace(surface, heights=surface.heights[::-1], mask=None) if speed < 0 else surface,
        scene.line_contact(abs(speed)),
        sliding=2 * abs(speed),
        boundary_friction=scene.bodies.boundary_friction_coefficient,
        hardness=scene.bodies.hardness,
        boundary_film=BOUNDARY_FILM if scene.bodies.boundary_film is None else scene.bodies.boundary_film,
        factors=factors,
    )


def grids(scene: Scene, surface: Surface) -> tuple[tuple[int, int], ...]:
    """Shapes of the map on the grids to try, coarsest first. They are the map's own shape, halved as long as it keeps
    90 % of Sq and 32 cells across, and doubled up to 512 cells across. With ``numerics.grid = "given"``: half of its
    own, and its own."""
    nx, ny = surface.shape
    if scene.numerics.grid == "given":
        return ((max(nx // 2, 1), max(ny // 2, 1)), (nx, ny))
    shapes = [(nx, ny)]
    while shapes[0][1] >= 2 * LEAST:
        if len(shapes) > 1 and surface.resampled(shape=_half(shapes[0])).sq < KEPT * surface.sq:
            break
        shapes.insert(0, _half(shapes[0]))
    while 2 * shapes[-1][1] <= MOST:
        shapes.append((2 * shapes[-1][0], 2 * shapes[-1][1]))
    return tuple(shapes)


def _half(shape) -> tuple[int, int]:
    return shape[0] // 2, shape[1] // 2


def solve_refined(
    lay: Callable[[tuple[int, int]], Problem], grids: tuple[tuple[int, int], ...], *, tolerance: float, least: int = 2
) -> Refined:
    """Solve ``lay(shape)``, the map on each of ``grids``, coarsest first, until the estimate is <= ``tolerance``; on at
    least ``least`` of them.

    The estimate is the geometric series of the changes c0, c1 of f on the last grids, c1 q/(1 - q) with q = c1/c0 kept
    within 1/4 and 3/4 (1/2 from two grids), over f. A grid starts from the next coarser one, and if that fails from the
    dry contact. Raises `ConvergenceError`.
    """
    results: list[DeterministicResult] = []
    error: float | None = None
    coarser: Problem | None = None
    for shape in grids:
        problem = lay(shape)
        start = None if coarser is None else refined_start(coarser, problem, results[-1])
        results.append(solve_point(problem, start=start))
        coarser = problem
        error = estimate([r.coefficient for r in results])
        if len(results) >= least and error is not None and error <= tolerance:
            break
    return Refined(tuple(results), error)


def refined_start(coarse: Problem, problem: Problem, result: DeterministicResult) -> State:
    """The state of ``result``, a solution of ``coarse``, on the smaller cells of ``problem``, linear between cells.

    Where asperities carry much of the load, their spots are too sharp to be interpolated to smaller cells. Then the
    difference from the dry contact is interpolated instead, and added to the dry contact of the finer grid. Beyond the
    old grid p = 0, with fluid upstream and rupture downstream. h0 is corrected, because the half-space has
    its zero, u = 0, at the length of the grid from a line load. The cells may also be those of ``coarse`` on a longer
    or shorter grid.
    """
    old, (nx, ny), (nx_old, ny_old) = result.state, problem.heights.shape, coarse.heights.shape
    along = (problem.x - coarse.x[0]) / coarse.spacing[0]
    across = (np.arange(ny) + 0.5) * (ny_old / ny) - 0.5
    nearest = old.kind[np.clip(np.rint(along).astype(int), 0, nx_old - 1)][:, np.rint(across).astype(int) % ny_old]
    kind = np.where((along < -0.5)[:, None], FLUID, np.where((along > nx_old - 0.5)[:, None], RUPTURED, nearest))
    ruptured = kind == RUPTURED
    fill = np.where(ruptured, _interpolated(old.fill, np.clip(along, 0, nx_old - 1), across), 1.0)

    def finer(pressure):
        return np.where(ruptured, 0.0, _interpolated(pressure, along, across))

    pressure = finer(old.pressure)
    if result.split.spots < SHARP * result.load or problem.spacing == coarse.spacing:
        longer = nx * problem.spacing[0] / (nx_old * coarse.spacing[0])
        shift = 4 * (result.load - result.inlet_load) / (math.pi * problem.e_prime) * math.log(longer)
        yielded = (pressure >= problem.hardness) & ~ruptured
        dent = np.where(yielded, _interpolated(old.dent, along, across), 0.0)
        return State(pressure, fill, dent, kind.astype(np.int8), yielded, old.approach - shift)
    bare, new = dry_contact(coarse), dry_contact(problem)
    pressure = np.maximum(new.pressure + pressure - finer(bare.pressure), 0.0)
    kind = np.where((pressure <= 0) & ruptured, RUPTURED, FLUID).astype(np.int8)
    yielded = pressure >= problem.hardness
    dent = np.where(yielded, np.maximum(-new.gap, 0.0), 0.0)
    approach = old.approach + bare.approach - new.approach
    return State(np.minimum(pressure, problem.hardness), fill, dent, kind, yielded, approach)


def _interpolated(field, along, across) -> np.ndarray:
    """Linear interpolation at the cells ``along`` x (zero outside) and ``across`` y (periodic), counted in cells."""
    i, j = np.floor(along).astype(int), np.floor(across).astype(int)
    s, t = (along - i)[:, None], across - j
    padded = np.zeros((field.shape[0] + 2, field.shape[1]))
    padded[1:-1] = field
    i = np.clip(i + 1, 0, field.shape[0])
    j0, j1 = j % field.shape[1], (j + 1) % field.shape[1]
    before = (1 - t) * padded[i][:, j0] + t * padded[i][:, j1]
    behind = (1 - t) * padded[i + 1][:, j0] + t * padded[i + 1][:, j1]
    return (1 - s) * before + s * behind


def estimate(values) -> float | None:
    """Relative error of the last of ``values``, found on grids each twice as fine as the one before; None for one
    value."""
    if len(values) < 2:
        return None
    change = abs(values[-1] - values[-2])
    before = abs(values[-2] - values[-3]) if len(values) > 2 else 0.0
    ratio = UNKNOWN_RATIO if before == 0 else min(max(change / before, RATIO[0]), RATIO[1])
    return change * ratio / (1 - ratio) / abs(values[-1]) if change else 0.0
