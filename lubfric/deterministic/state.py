"""The unknowns of an iteration, and which equation each cell obeys."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .problem import Problem
from .reynolds import Balance, balance

FLUID, RUPTURED, TOUCHING = 0, 1, 2
PULL = 0.01  # of U times the floor over dx: suction in a touching cell, below which it is left alone


@dataclass(frozen=True)
class State:
    """pressure [Pa], dent w [m], kind (of `FLUID`, `RUPTURED`, `TOUCHING`), yielded (bool), arrays (nx, ny); approach
    h0 [m]. A yielded cell has p = P_u and its dent for unknown, any other w = 0 and its pressure."""

    pressure: np.ndarray
    dent: np.ndarray
    kind: np.ndarray
    yielded: np.ndarray
    approach: float


@dataclass(frozen=True)
class Look:
    """A state with what follows from it: gap h [m] (nx, ny) and the mass balance of its cells."""

    state: State
    gap: np.ndarray
    balance: Balance
    stored: np.ndarray | None = None  # m/s, of an implicit step in time

    @property
    def residual(self) -> np.ndarray:
        """Outflow less inflow and what is given up [m/s]."""
        return self.balance.residual if self.stored is None else self.balance.residual + self.stored


@dataclass(frozen=True)
class Past:
    """The mass rho h [m] of the cells a time ``step`` [s] ago."""

    mass: np.ndarray
    step: float


def look(problem: Problem, state: State, past: Past | None = None) -> Look:
    """Gap and mass balance of ``state``, of an implicit step in time where there is a ``past``."""
    gap = problem.rigid_gap + problem.operator.apply(state.pressure) + state.dent + state.approach
    found = balance(problem, state.pressure, gap)
    stored = None if past is None else (found.fluid.density * found.film - past.mass) / past.step
    return Look(state, gap, found, stored)


def resorted(problem: Problem, at: Look) -> State:
    """Every cell given the equation that its pressure, gap and residual ask for.

    Fluid that would pull ruptures, ruptured cells that fill up carry pressure again, a fluid cell closer than the floor
    touches, a touching cell that is pulled opens; a pressure above P_u yields, a dent that would vanish does not.
    """
    state, r = at.state, at.residual
    p, kind = state.pressure, state.kind.copy()
    fluid, ruptured, touching = (kind == k for k in (FLUID, RUPTURED, TOUCHING))
    kind[ruptured & (r < 0)] = FLUID
    kind[fluid & (p < 0)] = RUPTURED
    kind[fluid & (p >= 0) & (at.gap < problem.floor)] = TOUCHING
    kind[ruptured & (at.gap < problem.floor)] = TOUCHING
    kind[touching & (r < -PULL * problem.speed * problem.floor / problem.spacing[0])] = FLUID
    kind[touching & (p <= 0)] = RUPTURED
    yielded = state.yielded & (state.dent >= 0) | (p > problem.hardness) & ~state.yielded
    yielded &= kind != RUPTURED
    pressure = np.where(kind == RUPTURED, 0.0, np.where(yielded, problem.hardness, p))
    return replace(state, pressure=pressure, dent=np.where(yielded, state.dent, 0.0), kind=kind, yielded=yielded)


def load_error(problem: Problem, at: Look) -> float:
    """∫ p dx less the load [N/m], with what the film upstream of the grid carries."""
    carried = at.state.pressure.sum() * problem.spacing[0] / at.gap.shape[1]
    return float(carried + at.balance.inlet.load - problem.load)


def residuals(problem: Problem, at: Look) -> dict[str, float]:
    """How far a state is from a solution; all dimensionless.

    - mass: Σ |r| over fluid cells, relative to the flow that enters;
    - load: relative;
    - gap: the largest |h - floor| over touching cells, and floor - h over the others, over the mean gap;
    - suction: Σ -r over ruptured and touching cells, where r < 0, relative to the flow that enters;
    - pressure: the largest of -p and p - P_u over the largest pressure.
    """
    state, r = at.state, at.residual
    dx, _ = problem.spacing
    ny = r.shape[1]
    flow = float(np.mean(np.abs(at.balance.inlet.flow))) * ny / dx
    fluid, touching = state.kind == FLUID, state.kind == TOUCHING
    mean_gap = float(np.maximum(at.gap, 0).mean())
    closed = np.abs(at.gap[touching] - problem.floor).max(initial=0.0)
    pierced = (problem.floor - at.gap[~touching]).max(initial=0.0)
    top = max(float(state.pressure.max()), 1.0)
    outside = max(-float(state.pressure.min()), float(state.pressure.max()) - problem.hardness, 0.0)
    return {
        "mass": float(np.abs(r[fluid]).sum()) / flow,
        "load": abs(load_error(problem, at)) / problem.load,
        "gap": float(max(closed, pierced)) / mean_gap,
        "suction": float(np.maximum(-r[~fluid], 0.0).sum()) / flow,
        "pressure": outside / top,
    }
