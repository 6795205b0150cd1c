"""The unknowns of an iteration, and the equation that each cell obeys."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from .flow import Balance, balance
from .problem import Problem

FLUID = 0
RUPTURED = 1
TOUCHING = 2
PULL = 0.01  # of U times the floor over dx: suction in a touching cell, below which it is left alone


class Past(NamedTuple):
    """Of an implicit step in time: the mass that was ``kept`` before it [m], its length [s]; and, if it is of second
    order (BDF2), the mass then [m], and the part of the change since then that is kept. ``carried``: both masses are
    those of the cell before, since in a step the lubricant moves by one; so nothing more flows with U."""

    kept: np.ndarray
    step: float
    then: tuple[np.ndarray, float] | None = None
    carried: bool = False


@dataclass(frozen=True)
class State:
    """The unknowns, arrays (nx, ny): pressure [Pa], fill (filled part of the gap, -), dent w [m], kind (`FLUID`,
    `RUPTURED` or `TOUCHING`), yielded (bool); and the approach h0 [m]. The unknown of a ruptured cell is its fill, with
    p = 0; all other cells are full. That of a yielded cell is its dent, with p = P_u; in the rest it is the pressure,
    with w = 0."""

    pressure: np.ndarray
    fill: np.ndarray
    dent: np.ndarray
    kind: np.ndarray
    yielded: np.ndarray
    approach: float


@dataclass(frozen=True)
class Iterate:
    """A state with its gap h [m] (nx, ny) and the mass balance of its cells. ``past``: of an implicit step in time.
    residual [m/s]: outflow minus inflow plus, in time, what the cell stores (`stored`)."""

    problem: Problem
    state: State
    gap: np.ndarray
    balance: Balance
    past: Past | None
    residual: np.ndarray

    @property
    def mass(self) -> np.ndarray:
        """rho h [m] of the lubricant in the gap."""
        return self.state.fill * self.balance.fluid.density * self.balance.film

    @property
    def mean_flow(self) -> float:
        """Mean size of the flow into the grid [m²/s], or `Problem.least_flow` if that is more."""
        return max(float(np.mean(np.abs(self.balance.inlet.flow))), self.problem.least_flow)

    @property
    def load_error(self) -> float:
        """∫ p dx, with the load carried upstream of the grid, minus the load [N/m]."""
        carried = self.state.pressure.sum() * self.problem.spacing[0] / self.gap.shape[1]
        return float(carried + self.balance.inlet.load.mean() - self.problem.load)


def stored(mass: np.ndarray, past: Past) -> tuple[np.ndarray, np.ndarray]:
    """What cells of this ``mass`` rho h [m] have stored in a step [m/s], and its derivative [1/s]."""
    before, step, then, _ = past
    if then is None:
        return (mass - before) / step, np.full_like(mass, 1 / step)
    now = kept(mass, *then)
    free = then[1] * (then[0] - mass) < 0.5 * mass
    return (now - before) / step, np.where(free, 1.0 + then[1], 0.5) / step


def kept(mass: np.ndarray, then: np.ndarray, part: float = 0.5) -> np.ndarray:
    """The mass [m] that is kept at a moment, of cells of this ``mass`` that had another ``then``, a step before: with
    a ``part`` of the change (a half where steps are equal), and half of their mass at least. (So is the Couette flow
    limited in space. Without, a cell that a summit closes would give off more than it has.)"""
    return np.maximum(mass + part * (mass - then), 0.5 * mass)


def evaluated(problem: Problem, state: State, past: Past | None = None) -> Iterate:
    """Gap and mass balance of ``state``; with ``past``, of an implicit step in time."""
    gap = problem.rigid_gap + problem.operator.apply(state.pressure) + state.dent + state.approach
    found = balance(problem, state.pressure, gap, state.fill, past is not None and past.carried)
    at = Iterate(problem, state, gap, found, past, found.residual)
    return at if past is None else replace(at, residual=found.residual + stored(at.mass, past)[0])


def settled(at: Iterate) -> Iterate:
    """``at``, with every cell given the equation that its state asks for."""
    new = evaluated(at.problem, _resorted(at), at.past)
    fluid = (new.state.kind == FLUID) & (at.state.kind == FLUID)  # cells that just opened begin at the floor
    closed = fluid & (new.gap < at.problem.floor)  # by a pressure that was cut to P_u
    kind = np.where(closed, TOUCHING, new.state.kind).astype(np.int8)
    return replace(new, state=replace(new.state, kind=kind))


def _resorted(at: Iterate) -> State:
    """Give every cell the equation that its pressure, gap and residual ask for.

    - A fluid cell under suction ruptures. A ruptured cell that is full carries pressure again.
    - A fluid cell closer than the floor touches. A touching cell under suction opens (`_opened`).
    - A cell with a pressure above P_u yields. One whose dent would vanish stops yielding.
    """
    problem = at.problem
    state = at.state
    p = state.pressure
    kind = state.kind.copy()
    fluid, ruptured, touching = (kind == k for k in (FLUID, RUPTURED, TOUCHING))
    kind[ruptured & (state.fill > 1)] = FLUID
    kind[fluid & (p < 0)] = RUPTURED
    kind[(fluid & (p >= 0) | ruptured) & (at.gap < problem.floor)] = TOUCHING
    kind[_opened(touching, -at.residual, _pull(problem))] = FLUID
    kind[touching & (p <= 0)] = RUPTURED
    beyond = (p > problem.hardness) & ~state.yielded
    yielded = (state.yielded & (state.dent >= 0) | beyond) & (kind != RUPTURED)
    spared = np.where(beyond, (p - problem.hardness) * problem.self_deflection, 0.0) if beyond.any() else 0.0
    return replace(
        state,
        pressure=np.where(kind == RUPTURED, 0.0, np.where(yielded, problem.hardness, p)),
        fill=np.where(kind == RUPTURED, np.clip(state.fill, 0.0, 1.0), 1.0),
        dent=np.where(yielded, state.dent + spared, 0.0),
        kind=kind,
        yielded=yielded,
    )


def _opened(touching, surplus, pull) -> np.ndarray:
    """The touching cells that open: those with a ``surplus`` of inflow [m/s] above ``pull``, and those behind them that
    it reaches. It is handed on along x, and what a cell gives off is taken from it.

    Along a furrow that the film wets, cells would otherwise open one by one. A cell that is opened although it gives
    off more than it is handed would sink below the floor, and close all that were opened with it, for ever.
    """
    handed = np.where(touching, surplus, 0.0)
    for before, own, touches in zip(handed[:-1], handed[1:], touching[1:]):
        own += np.where(touches & (before > pull), before, 0.0)
    return touching & (handed > pull)


def _pull(problem: Problem) -> float:
    return PULL * problem.speed * problem.floor / problem.spacing[0]


def residuals(at: Iterate) -> dict[str, float]:
    """How far a state is from a solution; all dimensionless.

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
    closed = np.abs(at.gap[touching] - problem.floor).max(initial=0.0)
    pierced = (problem.floor - at.gap[~touching]).max(initial=0.0)
    top = float(state.pressure.max())
    return {
        "mass": float(np.abs(r[~touching]).sum()) / flow,
        "load": abs(at.load_error) / problem.load,
        "gap": float(max(closed, pierced) / max(np.maximum(at.gap, 0).mean(), problem.floor)),
        "suction": float(np.maximum(-r[touching] - _pull(problem), 0.0).sum()) / flow,
        "fill": float(max(-state.fill.min(), state.fill.max() - 1, 0.0)),
        "pressure": max(-float(state.pressure.min()), top - problem.hardness, 0.0) / max(top, 1.0),
    }
