"""A line contact in time: its histories, its units, its grid and its first state."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..errors import CONVERGED
from ..film import Effort, LineContact, Problem, solve_line_contact
from ..oil import Lubricant
from ..scene import History
from .bdf import Memory
from .film_active_set import StepSolution, solve_step
from .film_grid import FixedGrid, make_fixed_grid, symmetric_nodes
from .film_squeeze import Conditions, Spring

FINER = (1.0, 1.5, 2.25, 3.4)  # factors of the number of nodes, tried until the steady start is accurate enough
RESOLUTION = 1.1  # nodes per unit of the grid's index at a tolerance of 3e-3
SLOWEST = 0.03  # of the largest speed: slower passages are not resolved finer, squeeze rules there
WET = 1e-3  # of the largest pressure: where the error of the film counts
FIRST_STEP = 1e-3  # of the time in which the surfaces pass the contact, after a start or a jump
LIGHTEST = 0.3  # share of the load that the film is taken to carry at least, when it shares it


@dataclass(frozen=True)
class ContactHistory:
    """A line contact in time: histories in SI units from t = 0 to ``duration`` [s].

    Attributes
    ----------
    load, radius : [N] on ``width`` [m], [m]
    speed : [m/s], of entrainment
    viscosity : [Pa s], ambient; the law of the pressure stays
    initial_film : [m] flying height of the undeformed parabola at t = 0; None: steady before t = 0
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

    def load_per_width(self, time: float) -> float:
        """Just before ``time`` [s], in N/m."""
        return self.load.before(time) / self.width

    def load_range(self) -> tuple[float, float]:
        """Smallest and largest load [N/m]."""
        low, high = self.load.range(self.duration)
        return low / self.width, high / self.width

    def steady(self, load: float | None = None) -> LineContact:
        """The steady contact just before t = 0 (with entrainment), or the same with another load [N/m]."""
        oil = replace(self.lubricant, viscosity=self.viscosity.before(0.0))
        return LineContact(
            load or self.load_per_width(0.0), self.radius.before(0.0), self.e_prime, self.speed.before(0.0), oil
        )


@dataclass(frozen=True)
class Setting:
    """The contact in the units of a reference ``problem``, on ``grid``."""

    contact: ContactHistory
    problem: Problem
    grid: FixedGrid

    @property
    def time_unit(self) -> float:
        """The unit of time [s]: the unit of x over the reference speed."""
        return self.problem.length_unit / self.problem.contact.entrainment_speed

    def conditions(self, time: float) -> Conditions:
        """Speed, load, curvature and viscosity just before ``time`` [s]."""
        c, p = self.contact, self.problem
        return Conditions(
            c.speed.before(time) / p.contact.entrainment_speed,
            c.load_per_width(time) / (p.contact.e_prime * p.film_unit),
            p.contact.radius / c.radius.before(time),
            c.viscosity.before(time) / p.contact.lubricant.viscosity,
        )

    def solve(self, time: float, memory: Memory, z: np.ndarray, spring: Spring | None = None) -> StepSolution:
        """The step that ends at ``time`` [s] (`lubfric.time.bdf.Solver`). ``spring``: a spring that carries the rest
        of the load."""
        memory = Memory(memory.rate * self.time_unit, memory.film)
        return solve_step(self.grid, self.problem, self.conditions(time), memory, z, spring=spring)

    def error_of(self, solution: StepSolution, difference: np.ndarray) -> float:
        """Root mean square of a difference of films over the pressurised film, relative to the film."""
        P = solution.terms.P
        weights = self.grid.weights * (P > WET * P.max())
        return math.sqrt(float(weights @ (difference / solution.film) ** 2 / max(weights.sum(), 1e-300)))

    def at_rest(self, z: np.ndarray) -> StepSolution:
        """The state at t = 0 with the unknowns ``z``: evaluated, not solved."""
        return solve_step(self.grid, self.problem, self.conditions(0.0), steady(self.grid), z, max_steps=0)

    @property
    def histories(self) -> tuple[History, ...]:
        """All histories that change in time."""
        return self.contact.speed, self.contact.load, self.contact.radius, self.contact.viscosity

    @property
    def first_step(self) -> float:
        """The length [s] of the step after a start or a jump."""
        contact = self.contact
        fastest = max(abs(u) for u in contact.speed.range(contact.duration))
        width = math.hypot(self.problem.half_width, 3.0) * self.problem.length_unit
        return FIRST_STEP * (min(width / fastest, contact.duration) if fastest else contact.duration)


def steady(grid: FixedGrid) -> Memory:
    """The memory with which a step gives a steady state."""
    return Memory(0.0, np.zeros(grid.n + 1))


def make_setting(
    contact: ContactHistory,
    tolerance: float,
    *,
    shared: bool = False,
    reach: float = 0.0,
    film_range: tuple[float, float] = (math.inf, 0.0),
    finer: float = 1.0,
) -> Setting:
    """Units and grid that suit the whole range of the histories.

    ``shared``: the film carries only part of the load. The grid extends to ``reach`` [m] at least. ``film_range`` [m]:
    films to resolve in addition to those of Moes' formula. ``finer``: factor on the number of nodes.
    """
    problem, films = _reference(contact, film_range)
    load = contact.load_range()
    radius = contact.radius.range(contact.duration)
    share = LIGHTEST if shared else 1.0

    def edge(w: float, r: float) -> float:
        return math.sqrt(8.0 * w * r / (math.pi * contact.e_prime)) / problem.length_unit

    edges = edge(share * load[0], radius[0]), edge(load[1], radius[1])
    x = symmetric_nodes(finer * RESOLUTION * math.sqrt(3e-3 / tolerance), edges, films, reach / problem.length_unit)
    return Setting(contact, problem, make_fixed_grid(x))


def _reference(contact: ContactHistory, film_range) -> tuple[Problem, tuple[float, float]]:
    c, T = contact, contact.duration
    load, radius, eta = c.load_range(), c.radius.range(T), c.viscosity.range(T)
    fastest = max(abs(u) for u in c.speed.range(T))
    lubricant = replace(c.lubricant, viscosity=c.viscosity.at(0.0))
    films = [f for f in (*film_range, c.initial_film or 0.0) if 0.0 < f < math.inf]
    reference = LineContact(load[1], c.radius.at(0.0), c.e_prime, fastest or 1.0, lubricant)
    if fastest:
        low, high = c.speed.range(T)
        slowest = 0.0 if low < 0.0 < high else min(abs(low), abs(high))
        films += [
            _moes(reference, load[0], radius[1], eta[1], fastest),
            _moes(reference, load[1], radius[0], eta[0], max(slowest, SLOWEST * fastest)),
        ]
    else:
        scale = math.sqrt(c.radius.at(0.0) * films[0])
        speed = scale**4 * c.e_prime / (2.0 * lubricant.viscosity * c.radius.at(0.0) ** 3)
        reference = replace(reference, entrainment_speed=speed)
        time = math.sqrt(films[0]) * load[1] * T / (6.0 * math.sqrt(2.0) * math.pi * eta[0] * radius[0] ** 1.5)
        films.append(films[0] / (1.0 + min(time, 10.0)) ** 2)
    return Problem(reference), (min(films) / reference.film_unit, max(films) / reference.film_unit)


def _moes(reference: LineContact, load: float, radius: float, viscosity: float, speed: float) -> float:
    oil = replace(reference.lubricant, viscosity=viscosity)
    return LineContact(load, radius, reference.e_prime, speed, oil).moes_film


def parabola(setting: Setting, film: float) -> np.ndarray:
    """Unknowns of the undeformed gap without pressure, with the smallest film [m]."""
    return np.append(np.zeros(setting.grid.n + 1), film / setting.problem.film_unit)


def steady_start(setting: Setting, load: float | None = None) -> StepSolution:
    """The steady state of the conditions just before t = 0, with ``load`` [N/m] instead of the history's if it is
    given."""
    c, p, grid = setting.contact, setting.problem, setting.grid
    now = setting.conditions(0.0)
    found = solve_line_contact(c.steady(load), Effort(tolerance=0.01))
    x, P = found.x / p.length_unit, found.pressure / p.pressure_unit
    side = math.copysign(1.0, found.entrainment_speed)
    guess = np.interp(grid.x, x, P, left=0.0, right=0.0)
    inlet = x[0] if side > 0 else x[-1]
    beyond = grid.x * side < inlet * side
    guess[beyond] = (P[0] if side > 0 else P[-1]) * (inlet / grid.x[beyond]) ** 3
    centre = grid.n // 2
    z = np.append(guess, found.central_film / p.film_unit - grid.kernel[centre] @ guess)
    now = now if load is None else replace(now, load=load / (p.contact.e_prime * p.film_unit))
    return solve_step(grid, p, now, steady(grid), z, max_steps=40)


def discretisation(setting: Setting, solution: StepSolution) -> float:
    """Relative error of minimum and central film of a steady solution, from the grid of every other node."""
    coarse = replace(setting, grid=make_fixed_grid(setting.grid.x[::2]))
    z = np.append(solution.z[:-1:2], solution.z[-1])
    z[-1] += solution.terms.H[setting.grid.n // 2] - (coarse.grid.kernel[coarse.grid.n // 2] @ z[:-1] + z[-1])
    other = solve_step(
        coarse.grid,
        coarse.problem,
        replace(setting.conditions(0.0), load=solution.terms.carried),
        steady(coarse.grid),
        z,
        max_steps=40,
    )
    if other.status != CONVERGED:
        return math.inf
    fine = solution.terms.H
    changes = (
        other.terms.H[coarse.grid.n // 2] / fine[setting.grid.n // 2] - 1.0,
        other.terms.H.min() / fine.min() - 1.0,
    )
    return float(max(abs(c) for c in changes)) / 3.0
