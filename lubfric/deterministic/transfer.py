"""A solved state as a start on another grid, of another length or with cells of another size.

Where asperities carry much of the load, their spots are too sharp to be interpolated to smaller cells. Then the
difference from the dry contact is interpolated instead, and added to the dry contact of the finer grid.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from .problem import Problem
from .result import DeterministicResult
from .start import dry_contact
from .state import FLUID, RUPTURED, State

SHARP = 0.3  # share of the load on spots from which on the dry contact is interpolated with the state


def state_on(problem: Problem, result: DeterministicResult) -> State:
    """The state of ``result`` on the grid of ``problem``, of the same width along y; linear between cells.

    Beyond the old grid p = 0, with fluid upstream and rupture downstream. h0 is corrected, because the half-space has
    its zero, u = 0, at the length of the grid from a line load.
    """
    old, shape = result.state, problem.heights.shape
    length_old, length = (n * dx for n, dx in ((result.x.size, result.spacing[0]), (shape[0], problem.spacing[0])))
    line_load = result.load - result.inlet_load
    approach = old.approach - 4 * line_load / (math.pi * problem.e_prime) * math.log(length / length_old)
    if old.pressure.shape == shape and np.allclose(result.x, problem.x, atol=1e-3 * problem.spacing[0]):
        return old
    along = (problem.x - result.x[0]) / result.spacing[0]
    across = (np.arange(shape[1]) + 0.5) * (old.pressure.shape[1] / shape[1]) - 0.5
    pressure = _interpolated(old.pressure, along, across)
    nearest = old.kind[np.clip(np.rint(along).astype(int), 0, old.kind.shape[0] - 1)]
    kind = nearest[:, np.rint(across).astype(int) % old.kind.shape[1]]
    kind = np.where((along < -0.5)[:, None], FLUID, np.where((along > result.x.size - 0.5)[:, None], RUPTURED, kind))
    kind = kind.astype(np.int8)
    pressure = np.where(kind == RUPTURED, 0.0, pressure)
    fill = np.where(kind == RUPTURED, _interpolated(old.fill, np.clip(along, 0, result.x.size - 1), across), 1.0)
    yielded = (pressure >= problem.hardness) & (kind != RUPTURED)
    dent = np.where(yielded, _interpolated(old.dent, along, across), 0.0)
    return State(pressure, fill, dent, kind, yielded, approach)


def refined_start(coarse: Problem, problem: Problem, result: DeterministicResult) -> State:
    """The state of ``result``, a solution of the problem ``coarse``, on the smaller cells of ``problem``."""
    state = state_on(problem, result)
    if result.split.spots < SHARP * result.load:
        return state
    old, new = dry_contact(coarse), dry_contact(problem)
    bare = replace(result.state, pressure=old.pressure)
    pressure = np.maximum(new.pressure + state.pressure - state_on(problem, replace(result, state=bare)).pressure, 0.0)
    kind = np.where((pressure <= 0) & (state.kind == RUPTURED), RUPTURED, FLUID).astype(np.int8)
    approach = result.approach + old.approach - new.approach
    yielded = pressure >= problem.hardness
    dent = np.where(yielded, np.maximum(-new.gap, 0.0), 0.0)
    return State(np.minimum(pressure, problem.hardness), state.fill, dent, kind, yielded, approach)


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
