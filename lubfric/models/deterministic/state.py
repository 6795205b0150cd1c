"""The unknowns of an iteration, and the equation that each cell obeys."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import minimum_filter1d

from ..._base import BoolArray, FloatArray
from .flow import MassBalance, mass_balance
from .problem import Problem

# Kind of a cell: the film fills the gap. A name by choice.
FLUID = 0

# Kind of a cell: the film is ruptured, its pressure is 0. A name by choice.
RUPTURED = 1

# Kind of a cell: the bodies touch, the gap is the floor. A name by choice.
TOUCHING = 2

# Part of the second difference of the last three masses that makes a step of BDF2 one of BDF3 [-]: (11 m - 18 m1 + 9 m2
# - 2 m3)/6 is the change of m + (m - m1)/2 + (m - 2 m1 + m2)/3 from step to step. By definition of BDF3.
CURVATURE = 1.0 / 3.0

# Part of the mass of a cell by which it is extrapolated at most [-], as by the limiter of the Couette flow
# (`flow.couette_flow`). Half: by definition of minmod there.
MOST_EXTRAPOLATED = 0.5

# Ratio of the suction of a fluid cell to the strongest suction of its eight neighbours [-], below which the cell does
# not rupture: the rupture of a cell relieves its neighbours, and a cell that ruptured needlessly refills late. A roller
# of 1 GPa takes 2.9 Newton steps in a step in time with 0, and 2.6 with 0.5; 0.2, 0.7, 0.9, 1 over fewer steps 3.1,
# 2.4, 2.9, 4.4. At rest at 0.03 m/s a grid of 251 x 240 cells takes 72 with 0, and 28 with 0.5.
STRONG_SUCTION = 0.5

# This ratio where the neighbour is upstream, in a steady film [-]: a cell that ruptures there reduces the inflow of the
# cells behind it, so their suction grows. With 0.5 a rupture moves downstream by one cell in a step. Six speeds of the
# roller and 13 of the scene "paper" take a counted work of 47.5 and 23.1 s with 0.5, 41.3 and 19.6 with 0.25, 41.3 and
# 18.1 with 0.1, 42.4 and 18.0 with 0. 38 random runs at rest take 6 % less with 0.1, at most 16 % more; of 14 random
# strips one takes twice as much. Steps in time of the roller take 54.4, 55.1, 57.5, 55.9 s, so they keep 0.5.
STRONG_SUCTION_UPSTREAM = 0.1

# Suction of a touching cell over U FLOOR/dx, below which the cell remains in contact [-]. A choice: with 0, rounding
# opens a contact.
PULL = 0.01


@dataclass(frozen=True, kw_only=True)
class TimeHistory:
    """What an implicit step in time takes over from the moments before it. (An implicit Euler step has ``extrapolated``
    alone, one of second order (BDF2) ``last`` too, one of third order (BDF3) all.)

    Attributes
    ----------
    extrapolated : the mass that the moments before leave to the step [m] (nx, ny): of an Euler step that of the last
        moment, else `extrapolated_mass`
    step : its length [s]
    last : mass of the last moment [m]
    part : part of its change by which a mass is extrapolated [-]
    earlier : mass of the moment before the last [m]
    follows_lubricant : whether these masses are those of the cells upstream, because in a step the lubricant moves by
        one cell; then nothing more flows with U
    """

    extrapolated: np.ndarray
    step: float
    last: np.ndarray | None = None
    part: float = 0.5
    earlier: np.ndarray | None = None
    follows_lubricant: bool = False


@dataclass(frozen=True, kw_only=True)
class State:
    """The unknowns of a point on its grid (nx, ny).

    The unknown of a ruptured cell is its fill, with p = 0; all other cells are full. That of a yielded cell is its
    dent, with p = P_u. In the rest it is the pressure, with w = 0.

    Attributes
    ----------
    pressure : p [Pa]
    fill : filled part of the gap [-]
    dent : w [m]
    kind : `FLUID`, `RUPTURED` or `TOUCHING`
    yielded : whether the pressure is P_u
    approach : h0 [m], a number
    """

    pressure: np.ndarray
    fill: np.ndarray
    dent: np.ndarray
    kind: np.ndarray
    yielded: np.ndarray
    approach: float


@dataclass(frozen=True, kw_only=True)
class Iterate:
    """A state with what follows from it.

    Attributes
    ----------
    problem, state : what is solved, and the unknowns
    gap : h [m] (nx, ny)
    mass_balance : of its cells
    history : of an implicit step in time; None: it is steady
    residual : outflow minus inflow plus, in time, what the cell stores (`stored`) [m/s]
    """

    problem: Problem
    state: State
    gap: np.ndarray
    mass_balance: MassBalance
    history: TimeHistory | None
    residual: np.ndarray

    @property
    def mass(self) -> np.ndarray:
        """rho h [m] of the lubricant in the gap."""
        return self.state.fill * self.mass_balance.fluid.density * self.mass_balance.flow_gap

    @property
    def mean_flow(self) -> float:
        """Mean size of the flow into the grid [m²/s], or `Problem.least_flow` if that is more."""
        return max(float(np.mean(np.abs(self.mass_balance.inlet.flow))), self.problem.least_flow)

    @property
    def load_error(self) -> float:
        """∫ p dx, with the load carried upstream of the grid, minus the load [N/m]."""
        carried = self.state.pressure.sum() * self.problem.spacing[0] / self.gap.shape[1]
        return float(carried + self.mass_balance.inlet.load.mean() - self.problem.load)


def stored(mass: np.ndarray, history: TimeHistory) -> tuple[np.ndarray, np.ndarray]:
    """Return what cells of this ``mass`` rho h [m] have stored in a step [m/s], and its derivative [1/s]."""
    step = history.step
    last = history.last
    part = history.part
    if last is None:
        return (mass - history.extrapolated) / step, np.full_like(mass, 1 / step)
    now = extrapolated_mass(mass, last, part, history.earlier)
    change = now - mass
    slope = part + (0.0 if history.earlier is None else CURVATURE)
    highest = max(MOST_EXTRAPOLATED, part)
    free = (change > -MOST_EXTRAPOLATED * mass) & (change < highest * mass)
    limited = np.where(change > 0, highest, -MOST_EXTRAPOLATED)
    return (now - history.extrapolated) / step, (1.0 + np.where(free, slope, limited)) / step


def extrapolated_mass(
    mass: np.ndarray, before: np.ndarray, part: float = 0.5, earlier: np.ndarray | None = None
) -> np.ndarray:
    """Return ``mass`` [m] of cells extrapolated by a ``part`` of its change since the moment ``before`` (a half where
    steps are equal), by `MOST_EXTRAPOLATED` of itself, or that part, at most. With the moment ``earlier`` than that,
    `CURVATURE` of the second difference is added: the differences of such masses from step to step are those of BDF3.

    So the Couette flow is limited in space. Without the limit a cell whose gap a summit fills would give off more than
    it has.
    """
    change = part * (mass - before)
    if earlier is not None:
        change = change + CURVATURE * (mass - 2.0 * before + earlier)
    return mass + np.clip(change, -MOST_EXTRAPOLATED * mass, max(MOST_EXTRAPOLATED, part) * mass)


def gap_of(problem: Problem, state: State) -> np.ndarray:
    """Return the gap h [m] (nx, ny) of ``state``; below zero where the bodies overlap."""
    return problem.rigid_gap + problem.operator.apply(state.pressure) + state.dent + state.approach


def evaluated(problem: Problem, state: State, history: TimeHistory | None = None) -> Iterate:
    """Return gap and mass balance of ``state``, steady or (with a ``history``) of an implicit step in time."""
    gap = gap_of(problem, state)
    follows = history is not None and history.follows_lubricant
    flows = mass_balance(problem, state.pressure, gap, state.fill, follows_lubricant=follows)
    at = Iterate(problem=problem, state=state, gap=gap, mass_balance=flows, history=history, residual=flows.residual)
    return at if history is None else replace(at, residual=flows.residual + stored(at.mass, history)[0])


def admissible(problem: Problem, state: State, *, in_time: bool = False) -> State:
    """Return ``state`` without suction, overfilled cells, pressures above P_u and negative dents: each such cell obeys
    the equation of its other kind. ``in_time``: whether it is that of a step in time.

    - A fluid cell under suction ruptures if no neighbour is under much stronger suction. So does a touching cell under
      suction. A ruptured cell that is full carries pressure again.
    - A cell with a pressure above P_u yields. One whose dent would vanish stops yielding.
    """
    kind = state.kind.copy()
    fluid, ruptured, touching = (kind == k for k in (FLUID, RUPTURED, TOUCHING))
    p = _without_weak_suction(state.pressure, fluid, STRONG_SUCTION if in_time else STRONG_SUCTION_UPSTREAM)
    kind[ruptured & (state.fill > 1)] = FLUID
    kind[fluid & (p < 0)] = RUPTURED
    kind[touching & (p <= 0)] = RUPTURED
    above_limit = (p > problem.hardness) & ~state.yielded
    yielded = (state.yielded & (state.dent >= 0) | above_limit) & (kind != RUPTURED)
    spared = np.where(above_limit, (p - problem.hardness) * problem.self_deflection, 0.0) if above_limit.any() else 0.0
    return replace(
        state,
        pressure=np.where(kind == RUPTURED, 0.0, np.where(yielded, problem.hardness, p)),
        fill=np.where(kind == RUPTURED, np.clip(state.fill, 0.0, 1.0), 1.0),
        dent=np.where(yielded, state.dent + spared, 0.0),
        kind=kind,
        yielded=yielded,
    )


def update_active_sets(at: Iterate) -> Iterate:
    """Return ``at``, whose state is `admissible`, with cells that touch or open as its gap and residual require.

    - A cell whose gap is below the floor touches, unless it has just ruptured: its gap rises by the suction that it has
      lost.
    - A touching cell with a surplus of inflow opens (`_opened`).
    """
    kind = at.state.kind.copy()
    touching = kind == TOUCHING
    just_ruptured = (kind == RUPTURED) & (at.state.fill == 1.0)  # any other ruptured cell is not full
    kind[~touching & ~just_ruptured & (at.gap < at.problem.floor)] = TOUCHING
    kind[_opened(touching, -at.residual, _pull(at.problem))] = FLUID
    return replace(at, state=replace(at.state, kind=kind))


def _without_weak_suction(pressure: FloatArray, fluid: BoolArray, upstream: float) -> np.ndarray:
    """Return ``pressure`` with 0 in ``fluid`` cells whose suction is weaker than the part `STRONG_SUCTION` of the
    strongest of their neighbours, or the part ``upstream`` of one upstream."""
    if not np.any(fluid & (pressure < 0)):
        return pressure
    in_fluid = np.where(fluid, pressure, 0.0)
    strongest_beside = minimum_filter1d(in_fluid, size=3, axis=1, mode="wrap")
    strongest = STRONG_SUCTION * strongest_beside
    strongest[:-1] = np.minimum(strongest[:-1], STRONG_SUCTION * strongest_beside[1:])
    strongest[1:] = np.minimum(strongest[1:], upstream * strongest_beside[:-1])
    return np.where(fluid & (pressure < 0) & (pressure > strongest), 0.0, pressure)


def _opened(touching: np.ndarray, surplus: np.ndarray, pull: float | np.ndarray) -> np.ndarray:
    """Return the touching cells that open: those with a ``surplus`` of inflow [m/s] above ``pull``, and those behind
    them that it reaches. It is handed on along x, and what a cell gives off is taken from it.

    Along a furrow that the film wets, cells would otherwise open one by one. A cell that is opened although it gives
    off more than it is handed would sink below the floor, and all that were opened with it would touch again, for ever.
    """
    if not touching.any():
        return touching
    handed = np.where(touching, surplus, 0.0)
    for before, own, touches in zip(handed[:-1], handed[1:], touching[1:]):
        own += np.where(touches & (before > pull), before, 0.0)
    return touching & (handed > pull)


def _pull(problem: Problem) -> float:
    return PULL * problem.speed * problem.floor / problem.spacing[0]


def residuals(at: Iterate) -> dict[str, float]:
    """Return how far a state is from a solution; all dimensionless.

    - mass: Σ |r| over fluid and ruptured cells, relative to the flow that enters;
    - load: relative;
    - gap: the largest |h - floor| over touching cells, and floor - h over the others, over the mean gap;
    - suction: Σ (-r - `PULL` U floor/dx) over touching cells, where positive, relative to the flow that enters;
    - fill: the largest amount by which the fill of a ruptured cell is below 0 or above 1;
    - pressure: the largest of -p and p - P_u over the largest pressure.
    """
    problem = at.problem
    state = at.state
    r = at.residual
    flow = at.mean_flow * r.shape[1] / problem.spacing[0]
    touching = state.kind == TOUCHING
    off_floor = np.abs(at.gap[touching] - problem.floor).max(initial=0.0)
    pierced = (problem.floor - at.gap[~touching]).max(initial=0.0)
    top = float(state.pressure.max())
    return {
        "mass": float(np.abs(r[~touching]).sum()) / flow,
        "load": abs(at.load_error) / problem.load,
        "gap": float(max(off_floor, pierced) / max(np.maximum(at.gap, 0).mean(), problem.floor)),
        "suction": float(np.maximum(-r[touching] - _pull(problem), 0.0).sum()) / flow,
        "fill": float(max(-state.fill.min(), state.fill.max() - 1, 0.0)),
        "pressure": max(-float(state.pressure.min()), top - problem.hardness, 0.0) / max(top, 1.0),
    }
