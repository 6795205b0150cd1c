"""A line contact in time: its histories, its units and grid, Newton's method for one step, and its steady start."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from .._base import BoolArray
from ..errors import CONVERGED, DIVERGED, ITERATION_LIMIT
from ..film import Effort, FilmProblem, LineContact, count_film_step, hertz, solve_line_contact, step_length
from ..oil import Lubricant
from ..scene import History
from .film_equations import Spring, StepEquations, StepTerms
from .film_grid import FixedGrid, make_fixed_grid, symmetric_nodes
from .march import Memory, Step

# Choices between work and error. Half and twice this value change f by up to .2 % and the work by up to 23 %
# (constants.csv).
NODE_FACTORS = (1.0, 1.5, 2.25, 3.4)  # factors of the number of nodes, tried until the steady start is accurate enough
NODE_DENSITY = 1.1  # nodes per unit of the grid's index at a tolerance of 3e-3
SLOWEST_RESOLVED = (
    0.03  # part of the largest speed below which the grid is not refined further: squeeze dominates there
)
WET_PRESSURE = 1e-3  # part of the largest pressure above which the error of the film counts
FIRST_TIME_PART = 1e-3  # first step after a start or a jump, over the time in which the surfaces pass the contact
TIME_SHARE = 0.01  # default largest local error of a step, over the film tolerance
LEAST_FILM_LOAD = 0.3  # least share of the load on the film that is assumed where film and contact share the load
# Mass missing in a control volume over the flow that the motion drags through it [-] above which Newton's method takes
# one more step: some hundred volumes then miss less than the limit of the balance of a run
# (`lubfric.time.result.MASS`). A choice: a smaller value takes more steps.
MISSING_FLOW = 1e-6
# Successive steps of Newton's method in which an end of the film fills one node each [-], from which on it fills more
# in each: two, four, eight. Where the entrainment reverses, the film grows by 20 to 50 nodes in a step in time; a cam
# ended at its reversal, because Newton's method filled one of them in a step. Nodes that are filled in excess get a
# negative pressure, and the next step empties them. A choice: fewer fill nodes in excess more often.
STEPS_OF_CREEPING = 4
# Such steps in addition to all others, at most [-]. A choice: more take longer before a step in time is shortened.
MOST_CREEPING_STEPS = 60
SMALLEST_STAGE = (
    0.01  # smallest part of ln of a change of the load that is tried; a choice: less takes longer before it fails
)


@dataclass(frozen=True, kw_only=True)
class LineHistory:
    """A line contact in time: histories in SI units from t = 0 to ``duration`` [s].

    Attributes
    ----------
    load, radius : [N] on ``width`` [m], [m]
    speed : [m/s], of entrainment
    viscosity : [Pa s], ambient; the law of the pressure stays
    initial_film : [m] flying height of the undeformed parabola at t = 0; None: steady before t = 0
    sliding : of a time, u2 - u1 [m/s] just before it, with which shear thins the flow; None: Newtonian flow
    """

    load: History
    radius: History
    e_prime: float
    speed: History
    viscosity: History
    lubricant: Lubricant
    duration: float
    initial_film: float | None = None
    width: float = 1.0
    sliding: Callable[[float], float] | None = None


@dataclass(frozen=True)
class Setting:
    """The contact in the units of a reference ``problem``, on ``grid``."""

    line_history: LineHistory
    problem: FilmProblem
    grid: FixedGrid

    @property
    def inlet(self) -> float | None:
        """Distance upstream at which the lubricant begins, in units of x; None: it floods the inlet."""
        length = self.line_history.lubricant.inlet_length
        return None if length is None else length / self.problem.length_unit

    @property
    def load_unit(self) -> float:
        """The unit of the load [N]."""
        return self.problem.line.e_prime * self.problem.film_unit * self.line_history.width

    def equations(self, time: float, memory: Memory | None = None, spring: Spring | None = None) -> StepEquations:
        """Return the equations of the step that ends at ``time`` [s], with a ``memory`` in SI units (None: of a steady
        state), at the speed, load, curvature and viscosity just before that time."""
        c = self.line_history
        reference = self.problem.line
        time_unit = self.problem.length_unit / reference.entrainment_speed
        memory = memory or Memory(0.0, np.zeros(self.grid.n + 1))
        sheared = replace(self.problem, line=replace(reference, sliding=c.sliding and c.sliding(time)))
        return StepEquations(
            grid=self.grid,
            problem=sheared,
            memory=Memory(memory.rate * time_unit, memory.film),
            speed=c.speed.before(time) / reference.entrainment_speed,
            load=c.load.before(time) / self.load_unit,
            curvature=reference.radius / c.radius.before(time),
            viscosity=c.viscosity.before(time) / reference.lubricant.viscosity,
            spring=spring,
            inlet=self.inlet,
        )

    def solve(self, time: float, memory: Memory | None, z: np.ndarray, spring: Spring | None = None) -> Step:
        """Solve the step that ends at ``time`` [s] (a solver of `lubfric.time.march`). ``spring``: carries the rest of
        the load."""
        return solve_step(self.equations(time, memory, spring), z)

    def error_of(self, solution: Step, difference: np.ndarray) -> float:
        """Return the root mean square of a difference of films over the pressurised film, relative to the film."""
        P = solution.terms.P
        weights = self.grid.weights * (P > WET_PRESSURE * P.max())
        return math.sqrt(float(weights @ (difference / solution.film) ** 2 / max(weights.sum(), 1e-300)))

    def undeformed(self, film: float) -> Step:
        """Return the state at t = 0 without pressure: a parabola with the smallest film [m]."""
        z = np.append(np.zeros(self.grid.n + 1), film / self.problem.film_unit)
        return solve_step(self.equations(0.0), z, max_steps=0)

    @property
    def first_step(self) -> float:
        """The length [s] of the step after a start or a jump."""
        contact = self.line_history
        fastest = max(abs(u) for u in contact.speed.range(contact.duration))
        width = math.hypot(self.problem.half_width, 3.0) * self.problem.length_unit
        return FIRST_TIME_PART * (min(width / fastest, contact.duration) if fastest else contact.duration)


def make_setting(
    line_history: LineHistory, tolerance: float, *, sq: float = 0.0, reach: float = 0.0, finer: float = 1.0
) -> Setting:
    """Return the units and grid that suit the complete range of the histories.

    ``sq`` [m]: roughness of surfaces that carry part of the load (0: smooth); films of that size are resolved too. The
    grid extends to ``reach`` [m] at least. ``finer``: factor on the number of nodes.
    """
    problem, films = _reference(line_history, sq)
    share = LEAST_FILM_LOAD if sq > 0.0 else 1.0
    load, radius = (history.range(line_history.duration) for history in (line_history.load, line_history.radius))

    def edge(load: float, radius: float) -> float:
        return hertz.line_half_width(load / line_history.width, radius, line_history.e_prime) / problem.length_unit

    edges = edge(share * load[0], radius[0]), edge(load[1], radius[1])
    x = symmetric_nodes(finer * NODE_DENSITY * math.sqrt(3e-3 / tolerance), edges, films, reach / problem.length_unit)
    length = line_history.lubricant.inlet_length
    if length is not None and length < x[-1] * problem.length_unit:
        every_other = x[len(x) // 2 % 2 :: 2]  # nodes of the coarser grid of `discretisation` too
        inlet = length / problem.length_unit
        nearest = every_other[np.argmin(np.abs(every_other - inlet))]
        x = x * (inlet / nearest)
    return Setting(line_history, problem, make_fixed_grid(x))


def _reference(line_history: LineHistory, sq: float) -> tuple[FilmProblem, tuple[float, float]]:
    """Return the problem that gives the units, and the smallest and the largest film in them."""
    c = line_history
    T = line_history.duration
    radius = c.radius.range(T)
    eta = c.viscosity.range(T)
    (low, high) = c.speed.range(T)
    load = [end / c.width for end in c.load.range(T)]
    fastest = max(abs(low), abs(high))
    lubricant = replace(c.lubricant, viscosity=c.viscosity.at(0.0))
    films = [f for f in (sq, 2.0 * sq, c.initial_film or 0.0) if f > 0.0]
    reference = LineContact(
        load_per_width=load[1],
        radius=c.radius.at(0.0),
        e_prime=c.e_prime,
        entrainment_speed=fastest or 1.0,
        lubricant=lubricant,
    )

    def moes(load: float, radius: float, viscosity: float, speed: float) -> float:
        oil = replace(lubricant, viscosity=viscosity)
        return LineContact(
            load_per_width=load, radius=radius, e_prime=c.e_prime, entrainment_speed=speed, lubricant=oil
        ).moes_film

    if fastest:
        slowest = max(0.0 if low < 0.0 < high else min(abs(low), abs(high)), SLOWEST_RESOLVED * fastest)
        films += [moes(load[0], radius[1], eta[1], fastest), moes(load[1], radius[0], eta[0], slowest)]
    else:
        scale = math.sqrt(c.radius.at(0.0) * films[0])
        speed = scale**4 * c.e_prime / (2.0 * lubricant.viscosity * c.radius.at(0.0) ** 3)
        reference = replace(reference, entrainment_speed=speed)
        time = math.sqrt(films[0]) * load[1] * T / (6.0 * math.sqrt(2.0) * math.pi * eta[0] * radius[0] ** 1.5)
        films.append(films[0] / (1.0 + min(time, 10.0)) ** 2)
    return FilmProblem(reference), (min(films) / reference.film_unit, max(films) / reference.film_unit)


def steady_start(setting: Setting, load: float | None = None) -> tuple[Step, float]:
    """Solve the steady state of the conditions just before t = 0, with ``load`` [N] instead of the history's if it is
    given; and its `discretisation` error, infinite where it did not converge."""
    c = setting.line_history
    p = setting.problem
    grid = setting.grid
    equations = setting.equations(0.0)
    load = load or c.load.before(0.0)
    oil = replace(c.lubricant, viscosity=c.viscosity.before(0.0))
    sliding = c.sliding and c.sliding(0.0)
    line = LineContact(
        load_per_width=load / c.width,
        radius=c.radius.before(0.0),
        e_prime=c.e_prime,
        entrainment_speed=c.speed.before(0.0),
        lubricant=oil,
        sliding=sliding,
    )
    steady = solve_line_contact(line, Effort(tolerance=0.01))
    x = steady.x / p.length_unit
    P = steady.pressure / p.pressure_unit
    forwards = steady.entrainment_speed > 0
    guess = np.interp(grid.x, x, P, left=0.0, right=0.0)
    inlet, pressure = (x[0], P[0]) if forwards else (x[-1], P[-1])
    upstream = grid.x < inlet if forwards else grid.x > inlet
    guess[upstream] = pressure * (inlet / grid.x[upstream]) ** 3
    centre = grid.n // 2
    z = np.append(guess, steady.central_film / p.film_unit - grid.kernel[centre] @ guess)
    start = solve_step(replace(equations, load=load / setting.load_unit), z, max_steps=40)
    return start, discretisation(setting, start) if start.status == CONVERGED else math.inf


def discretisation(setting: Setting, solution: Step) -> float:
    """Return the relative error of minimum and central film of a steady solution, from the grid of every other node."""
    coarse = replace(setting, grid=make_fixed_grid(setting.grid.x[::2]))
    equations = replace(coarse.equations(0.0), load=solution.terms.carried)
    fine = solution.terms.H
    centre = setting.grid.n // 2
    middle = coarse.grid.n // 2
    z = np.append(solution.z[:-1:2], solution.z[-1])
    z[-1] += fine[centre] - (coarse.grid.kernel[middle] @ z[:-1] + z[-1])
    other = solve_step(equations, z, max_steps=40)
    if other.status != CONVERGED:
        return math.inf
    H = other.terms.H
    return float(max(abs(H[middle] / fine[centre] - 1.0), abs(H.min() / fine.min() - 1.0))) / 3.0


def solve_step(equations: StepEquations, z: np.ndarray, *, tolerance: float = 1e-7, max_steps: int = 25) -> Step:
    """Solve the complementarity equations from z until ``equations.residual`` <= tolerance.

    A node counts as cavitated when the pressure that its own equation requires, P - r/(dr/dP), is negative. This
    primal-dual active set is a semismooth Newton method. A node upstream of the lubricant has no pressure at all:
    rounding that left some there would count it as filled. If it fails, the load is changed in stages from the load of
    z to the requested one. (With a spring that is not needed.)
    """
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        solution = _iterated(equations, z, tolerance, max_steps)
        first = float(equations.grid.weights @ z[:-1])
        if solution.status == CONVERGED or equations.spring is not None or not first > 0.0:
            return solution
        done = 0.0
        stage = 0.25
        while done < 1.0 and stage >= SMALLEST_STAGE:
            goal = min(1.0, done + stage)
            staged = replace(equations, load=first * (equations.load / first) ** goal)
            solution = _iterated(staged, z, tolerance, max_steps)
            if solution.status == CONVERGED:
                done = goal
                stage = 1.5 * stage
                z = solution.z
            else:
                stage *= 0.4
    return solution


def _iterated(equations: StepEquations, z: np.ndarray, tolerance: float, max_steps: int) -> Step:
    """Take Newton's steps from z until ``equations.residual`` <= tolerance; one more where what a short step misses is
    little of what the film contains, but much of what flows. Ends of the film that creep go ahead
    (`STEPS_OF_CREEPING`)."""
    is_last = False
    ends = CreepingEnds()
    left = max_steps  # without those in which an end creeps
    for step in range(max_steps + MOST_CREEPING_STEPS + 1):
        count_film_step(equations.grid.n)
        t = equations.evaluate(z)
        residual = equations.residual(t)
        status = ITERATION_LIMIT
        if residual <= tolerance:
            status = CONVERGED
        elif not np.isfinite(residual):
            status = DIVERGED
        if status == CONVERGED and not is_last and equations.missing_flow(t) > MISSING_FLOW and left > 0:
            is_last = True
            status = ITERATION_LIMIT
        if status != ITERATION_LIMIT or left == 0 or step == max_steps + MOST_CREEPING_STEPS:
            break
        J = equations.jacobian(t)
        cavitated = equations.dry | (t.P - t.r / np.diagonal(J)[:-1] < 0.0)
        cavitated = ends.sent_ahead(cavitated, equations.dry, int(t.P.argmax()))
        left -= 0 if any(ends.steps) else 1
        delta = _newton(J, t, cavitated)
        if delta is None:
            status = DIVERGED
            break
        loss = float(np.max(-(equations.grid.kernel @ delta[:-1] + delta[-1]) / t.H))
        z = z + step_length(delta[:-1] * t.log_slope, loss) * delta
        z[:-1][cavitated & (z[:-1] < 1e-14 * t.P.max())] = 0.0
    return Step(status=status, film=t.rho[0] * t.H, z=z, terms=t)


@dataclass
class CreepingEnds:
    """The two ends of a film, each of which may fill one node after the other in successive steps of Newton's method.

    ``before``: the cavitated nodes of the last step (None: there was none); ``steps``: how many of them each end has
    crept.
    """

    before: BoolArray | None = None
    steps: tuple[int, int] = (0, 0)

    def sent_ahead(self, cavitated: BoolArray, dry: BoolArray, middle: int) -> BoolArray:
        """Return the nodes that count as ``cavitated`` in the next step: an end that creeps has more of them filled
        (`STEPS_OF_CREEPING`), unless they are ``dry``. ``middle``: a node between both ends."""
        result = cavitated.copy()
        if self.before is not None:
            filled = self.before & ~cavitated
            emptied = cavitated & ~self.before
            creeps = (
                np.count_nonzero(filled[side]) == 1 and not emptied[side].any()
                for side in (slice(0, middle), slice(middle, None))
            )
            (left, right) = (steps + 1 if creeping else 0 for steps, creeping in zip(self.steps, creeps))
            self.steps = (left, right)
            wet = np.flatnonzero(~cavitated)
            if left >= STEPS_OF_CREEPING:
                result[max(0, wet[0] - _nodes_ahead(left)) : wet[0]] = False
            if right >= STEPS_OF_CREEPING:
                result[wet[-1] + 1 : wet[-1] + 1 + _nodes_ahead(right)] = False
            result |= dry
        self.before = result
        return result


def _nodes_ahead(steps: int) -> int:
    """Return how many more nodes an end fills that has crept for so many ``steps``."""
    return int(2 ** (steps - STEPS_OF_CREEPING + 1))


def _newton(J: np.ndarray, t: StepTerms, cavitated: np.ndarray) -> np.ndarray | None:
    """Take Newton's step with P = 0 at the cavitated nodes; None: the matrix is singular."""
    from scipy.linalg.lapack import dgesv

    delta = np.zeros(t.P.size + 1)
    delta[:-1][cavitated] = -t.P[cavitated]
    free = np.append(np.flatnonzero(~cavitated), t.P.size)
    right = -np.append(t.r, t.balance)[free]
    moved = cavitated & (t.P != 0.0)
    if moved.any():
        right -= J[np.ix_(free, np.flatnonzero(moved))] @ delta[:-1][moved]
    _, _, solution, info = dgesv(np.asfortranarray(J[np.ix_(free, free)]), right, overwrite_a=1, overwrite_b=1)
    if info != 0:
        return None
    delta[free] = solution
    return delta
