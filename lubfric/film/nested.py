"""Solutions on nested grids, from a warm or a cold start, each to the requested tolerance."""

import math
from dataclasses import dataclass, field, replace

import numpy as np

from .._base import validate
from ..errors import CONVERGED
from .assemble import grid_error
from .formulas import flooded_inlet
from .grid import make_grid, node_positions
from .problem import FilmProblem
from .reynolds import FilmSolution, newton
from .start import FilmState, cold_start, refined_start, rupture_guess, solution_state, warm_start

# Cells of the coarsest grid of a cold start. A choice: a smaller value costs failed starts, a larger one costs time.
# Half and twice this value change f by less than .1 %, its interval by up to 290 % and the work by up to 8 %
# (constants.csv).
COARSEST_CELLS = 48
# Grids from which a cold start is tried, each with twice the cells. A choice: a larger value costs time before a film
# fails.
STARTS = 5
# Cells of the finest grid. A choice, for time and memory: the work grows with the cube of the cells.
FINEST_CELLS = 3072
# Moes' M [-] beyond which COARSEST_CELLS cells do not resolve the inlet. A choice: a smaller value costs cells, a
# larger one costs cold starts that fail.
WIDE_LOAD_NUMBER = 2000.0
# Tolerance [-] from which two grids are enough for a cold start. A choice: a third grid shows the order of the error,
# and costs more than both. Half and twice this value change f by less than .1 %, its interval by up to 74 % and the
# work by up to 1 % (constants.csv).
TWO_GRIDS_TOLERANCE = 5e-3
# Inlet over that of a flooded film [-] from which a meniscus starts inwards. A choice: a larger value costs further
# solves, a smaller one may fail. Half and twice this value change f by less than .01 % and the work by less than 1 %
# (constants.csv).
WIDE_INLET = 3.0
# Distance of the meniscus after a step over that before [-]. A choice: a smaller value costs fewer solves, and may
# fail.
MENISCUS_APPROACH = 0.5
# Critical stress over the oil's own [-], from a Newtonian flow to the oil's law. A choice: fewer save solves, and may
# fail.
STIFFER = (625.0, 125.0, 25.0, 5.0, 1.0)
# Moes' L [-] up to which Newton's method starts safely. A choice: a larger value saves solves of hard films, and may
# fail.
EASY_MATERIAL_NUMBER = 4.0
# Growth of L between two solutions [-]. A choice: a larger value saves solves of hard films, and may fail.
GROWTH_OF_MATERIAL_NUMBER = 1.4


@dataclass(frozen=True, kw_only=True)
class NestedSolutions:
    """The solutions of a problem on nested grids.

    Attributes
    ----------
    problem : what is solved
    on_grids : its solutions on ever finer grids
    before : the solutions that led there
    notes : remarks on the way there, for the report
    """

    problem: FilmProblem
    on_grids: list[FilmSolution]
    before: list[FilmSolution] = field(default_factory=list)
    notes: tuple[str, ...] = ()

    @property
    def finest(self) -> FilmSolution:
        """The solution on the finest grid."""
        return self.on_grids[-1]


@dataclass(frozen=True)
class Effort:
    """The requested accuracy and the allowed effort: relative ``tolerance`` of the films (1e-5 to 0.1), cells before
    rupture that are used even if the films need fewer, and Newton steps per grid."""

    tolerance: float = 3e-3
    least_cells: int = 0
    max_iterations: int = 60

    def __post_init__(self) -> None:
        validate.number("tolerance", self.tolerance, "", minimum=1e-5, maximum=0.1)
        validate.integer("least_cells", self.least_cells, minimum=0)
        validate.integer("max_iterations", self.max_iterations, minimum=1)


def solved(problem: FilmProblem, effort: Effort, state: FilmState | None) -> NestedSolutions:
    """Return ``problem`` from the warm start ``state``; where there is none, or it fails, from a cold start."""
    notes: tuple[str, ...] = ()
    if state is not None:
        on_grids = warm(problem, effort, state)
        if is_sound(on_grids):
            return NestedSolutions(problem=problem, on_grids=on_grids)
        notes = ("the warm start failed; solved again from a cold start",)
    solutions = _cold(problem, effort)
    return replace(solutions, notes=notes + solutions.notes)


def warm(problem: FilmProblem, effort: Effort, state: FilmState) -> list[FilmSolution]:
    """Solve on two grids, the finer of which is at least as fine as the error of ``state`` demands."""
    n = coarsest(problem)
    needed = max(effort.least_cells, state.pressure.size * min(4.0, math.sqrt(state.grid_error / effort.tolerance)))
    while 2 * n < min(needed, FINEST_CELLS):
        n *= 2
    return _ascend(problem, effort, state, n, 2)


def _cold(problem: FilmProblem, effort: Effort) -> NestedSolutions:
    """Return ``problem`` from a cold start on grids from the coarsest up; if that fails, from a finer grid."""
    spent: list[FilmSolution] = []
    notes: tuple[str, ...] = ()
    usual = coarsest(problem)
    for n in sorted((COARSEST_CELLS * 2**k for k in range(STARTS)), key=lambda n: n != usual):
        if spent:
            notes += (f"the cold start failed; tried again from {n} cells",)
        state, first = first_state(problem, n, effort.max_iterations)
        on_grids = _ascend(problem, effort, state, n, 2 if effort.tolerance >= TWO_GRIDS_TOLERANCE else 3)
        if is_sound(on_grids):
            return NestedSolutions(problem=problem, on_grids=on_grids, before=spent + first, notes=notes)
        spent += first + on_grids
        if on_grids[0].status == CONVERGED and on_grids[-1].grid.n >= COARSEST_CELLS * 2 ** (STARTS - 1):
            break  # it is not the start that fails
    return NestedSolutions(problem=problem, on_grids=on_grids, before=spent[: -len(on_grids)], notes=notes)


def coarsest(problem: FilmProblem) -> int:
    """Return the cells of the coarsest grid: more if the inlet is far narrower than the contact."""
    return COARSEST_CELLS * 2 ** min(max(0, math.ceil(math.log(problem.M / WIDE_LOAD_NUMBER, 4))), STARTS - 1)


def _ascend(problem: FilmProblem, effort: Effort, state: FilmState, n: int, fewest: int) -> list[FilmSolution]:
    """Return the solutions on grids of n, 2n, ... cells, at least ``fewest`` of them, until they meet the tolerance."""
    rupture = rupture_guess(problem)
    on_grids: list[FilmSolution] = []
    while True:
        if on_grids and problem.fed is not None:
            problem = replace(problem, inlet=-on_grids[-1].terms.X[0])
        grid = make_grid(problem_nodes(problem, n, rupture))
        z, H = refined_start(on_grids[-1]) if on_grids else warm_start(grid, problem, state)
        on_grids.append(newton(grid, problem, z, H, 1e-3 * effort.tolerance, effort.max_iterations))
        if not is_sound(on_grids) or n >= FINEST_CELLS:
            return on_grids
        if len(on_grids) >= fewest and n >= effort.least_cells and grid_error(on_grids) <= effort.tolerance:
            return on_grids
        rupture = on_grids[-1].z[-1]
        n *= 2


def first_state(problem: FilmProblem, n: int, max_steps: int) -> tuple[FilmState, list[FilmSolution]]:
    """Return the first state, and the chain of rough solutions on n cells that leads there, each started from the one
    before.

    alpha rises from the value at which L is `EASY_MATERIAL_NUMBER`, then shear begins to thin the oil, and the inlet
    moves inwards.
    """
    shares = [min(1.0, EASY_MATERIAL_NUMBER / max(problem.L, EASY_MATERIAL_NUMBER))]
    while shares[-1] < 1.0:
        shares.append(min(1.0, GROWTH_OF_MATERIAL_NUMBER * shares[-1]))
    inlets = _inwards(problem)
    widest = replace(problem, inlet=inlets[0])
    stages = [widest.softened(share) for share in shares]
    if problem.thins_by is not None:
        stages = [replace(s, times=math.inf) for s in stages] + [replace(widest, times=times) for times in STIFFER]
    stages += [replace(problem, inlet=inlet) for inlet in inlets[1:]]
    states: list[FilmState] = []
    solutions: list[FilmSolution] = []
    for stage in stages:
        grid = make_grid(problem_nodes(stage, n, rupture_guess(stage)))
        z, H = warm_start(grid, stage, states[-1]) if states else cold_start(grid, stage)
        solutions.append(newton(grid, stage, z, H, 0.03, max_steps))
        states.append(solution_state(stage, solutions[-1], 0.0))
        if not np.isfinite(solutions[-1].error):
            break
    return states[-1], solutions


def _inwards(problem: FilmProblem) -> list[float | None]:
    """Return where the lubricant of ``problem`` begins, and before that places further upstream from which to come
    nearer."""
    if problem.inlet is None:
        return [None]
    b = problem.half_width
    distances = [problem.inlet - b]
    widest = WIDE_INLET * flooded_inlet(problem.rise, b)
    while distances[0] < MENISCUS_APPROACH * widest:
        distances.insert(0, distances[0] / MENISCUS_APPROACH)
    return [b + distance for distance in distances]


def problem_nodes(problem: FilmProblem, n: int, rupture: float) -> np.ndarray:
    """Return the nodes (n + 1) relative to the rupture point, which is expected at ``rupture``."""
    distance = None if problem.inlet is None else problem.inlet + rupture
    return node_positions(problem.half_width, problem.film_guess, n, distance)


def is_sound(on_grids: list[FilmSolution]) -> bool:
    """Return whether a solution has converged, and is not a root with tension in the film or with the inlet on the
    wrong side."""
    if not on_grids or on_grids[-1].status != CONVERGED:
        return False
    P = on_grids[-1].terms.P
    X = on_grids[-1].terms.X
    return bool(X[0] < 0.0 and X[-1] < -X[0] and P.min() >= -1e-3 * P.max())
