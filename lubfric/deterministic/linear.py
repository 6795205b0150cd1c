"""One linear system of Newton's method: GMRES with the dense K by FFT, preconditioned by a sparse LU with its diagonal.

Unknown in every cell that carries pressure is p (or, where it has yielded, the dent), and h0. Through h every cell
depends on every pressure; ``R_p + R_h diag(K)`` is sparse and enough of that.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix, diags
from scipy.sparse.linalg import splu

from .problem import Problem
from .reynolds import derivatives
from .state import RUPTURED, TOUCHING, Look, Past, load_error

ACCURACY = 1e-3  # of the residual of the linear system
KRYLOV, CYCLES = 40, 3


@dataclass(frozen=True)
class Step:
    """Changes of pressure [Pa], dent [m], h0 [m] and gap [m] that solve the linear system; ``iterations`` of GMRES, and
    the relative residual that was left."""

    pressure: np.ndarray
    dent: np.ndarray
    approach: float
    gap: np.ndarray
    iterations: int
    residual: float


class System:
    """The linear system at a state; rows are made dimensionless by U and a film, columns by a pressure."""

    def __init__(self, problem: Problem, at: Look, past: Past | None = None):
        self.problem, self.at = problem, at
        state = at.state
        self.shape = state.pressure.shape
        self.active = np.flatnonzero(state.kind.ravel() != RUPTURED)
        self.film = max(float(np.median(at.gap)), 10 * problem.floor) * 0 + self._film_scale()
        self.row = 1.0 / (problem.speed * self.film / problem.spacing[0])
        self.stress = problem.load / (problem.spacing[0] * 64)
        kind = state.kind.ravel()[self.active]
        self.touching = kind == TOUCHING
        self.dented = state.yielded.ravel()[self.active]
        self.by_p, self.by_h = self._rows(past)
        self.scale = np.where(self.dented, self.film, self.stress)
        self._weights()
        self._factorise()

    def _film_scale(self) -> float:
        flow = float(np.mean(np.abs(self.at.balance.inlet.flow)))
        return max(flow / self.problem.speed, self.problem.floor)

    def _rows(self, past):
        """d(equation)/dp and d(equation)/dh of the active rows over all cells."""
        problem, at = self.problem, self.at
        by_p, by_h = derivatives(problem, at.balance, at.state.pressure)
        if past is not None:
            fluid = at.balance.fluid
            by_h = by_h + diags((fluid.density * at.balance.open_).ravel() / past.step)
            by_p = by_p + diags((fluid.density_slope * at.balance.film).ravel() / past.step)
        fluid_rows = diags(np.where(self.touching, 0.0, self.row))
        n = at.gap.size
        count = self.active.size
        touch = np.flatnonzero(self.touching)
        identity = csr_matrix((np.full(touch.size, 1 / self.film), (touch, self.active[touch])), shape=(count, n))
        return (fluid_rows @ by_p[self.active]).tocsr(), (fluid_rows @ by_h[self.active] + identity).tocsr()

    def _weights(self):
        """The load row: by p and by h of all cells, relative to the load."""
        problem, inlet = self.problem, self.at.balance.inlet
        nx, ny = self.shape
        by_p = np.full(self.shape, problem.spacing[0] / ny)
        by_p[0] += inlet.load_by_pressure
        by_h = inlet.load_by_film / problem.load
        self.load_by_p, self.load_by_h = by_p / problem.load, by_h

    def _factorise(self):
        diagonal = np.where(self.dented, 1.0, self.problem.self_deflection)
        columns = self.by_h[:, self.active] @ diags(diagonal * self.scale)
        elastic = np.where(self.dented, 0.0, self.scale)
        matrix = (columns + self.by_p[:, self.active] @ diags(elastic)).tocsc()
        self.lu = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        self.column = self.by_h @ np.full(self.at.gap.size, self.film)  # by h0
        self.corner = float(self.load_by_h.sum()) * self.film
        self.load_row = self.load_by_p.ravel()[self.active] * elastic
        self.solved_column = self.lu.solve(self.column)
        self.schur = self.corner - float(self.load_row @ self.solved_column)

    def fields(self, unknowns):
        """Changes (pressure, dent, h0) of scaled unknowns (n + 1,)."""
        values = unknowns[:-1] * self.scale
        pressure, dent = np.zeros(self.at.gap.size), np.zeros(self.at.gap.size)
        pressure[self.active] = np.where(self.dented, 0.0, values)
        dent[self.active] = np.where(self.dented, values, 0.0)
        return pressure.reshape(self.shape), dent.reshape(self.shape), float(unknowns[-1] * self.film)

    def apply(self, unknowns):
        """The Jacobian times scaled unknowns."""
        pressure, dent, approach = self.fields(unknowns)
        gap = self.problem.operator.apply(pressure) + dent + approach
        rows = self.by_p @ pressure.ravel() + self.by_h @ gap.ravel()
        load = float((self.load_by_p * pressure).sum() + self.load_by_h @ gap[0])
        return np.append(rows, load)

    def precondition(self, rows):
        """The inverse of the sparse part, bordered by h0 and the load."""
        inner = self.lu.solve(rows[:-1])
        approach = (rows[-1] - float(self.load_row @ inner)) / self.schur
        return np.append(inner - approach * self.solved_column, approach)

    def right_side(self) -> np.ndarray:
        """Minus the equations at the state: mass of fluid cells, gap of touching ones, load."""
        problem, at = self.problem, self.at
        mass = at.residual.ravel()[self.active] * self.row
        gap = (at.gap.ravel()[self.active] - problem.floor) / self.film
        return -np.append(np.where(self.touching, gap, mass), load_error(problem, at) / problem.load)

    def solve(self) -> Step:
        """The Newton step."""
        unknowns, iterations, left = gmres(self.apply, self.precondition, self.right_side())
        pressure, dent, approach = self.fields(unknowns)
        gap = self.problem.operator.apply(pressure) + dent + approach
        return Step(pressure, dent, approach, gap, iterations, left)


def gmres(apply, precondition, right, accuracy=ACCURACY) -> tuple[np.ndarray, int, float]:
    """Solve ``apply(x) = right`` by restarted, right-preconditioned GMRES until |residual| <= accuracy |right|.

    Y. Saad, M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856-869, doi:10.1137/0907058. Returns x, the
    iterations, and the relative residual reached.
    """
    size = np.linalg.norm(right)
    x, count = np.zeros_like(right), 0
    if size == 0:
        return x, 0, 0.0
    rest = right.copy()
    for _ in range(CYCLES):
        beta = np.linalg.norm(rest)
        basis = [rest / beta]
        hessenberg = np.zeros((KRYLOV + 1, KRYLOV))
        for k in range(KRYLOV):
            image = apply(precondition(basis[k]))
            for j, vector in enumerate(basis):
                hessenberg[j, k] = vector @ image
                image -= hessenberg[j, k] * vector
            hessenberg[k + 1, k] = np.linalg.norm(image)
            count += 1
            target = np.zeros(k + 2)
            target[0] = beta
            y, *_ = np.linalg.lstsq(hessenberg[: k + 2, : k + 1], target, rcond=None)
            left = np.linalg.norm(hessenberg[: k + 2, : k + 1] @ y - target)
            if left <= 0.5 * accuracy * size or hessenberg[k + 1, k] <= 1e-14 * beta:
                break
            basis.append(image / hessenberg[k + 1, k])
        x = x + precondition(sum(c * v for c, v in zip(y, basis)))
        rest = right - apply(x)
        if np.linalg.norm(rest) <= accuracy * size:
            break
    return x, count, float(np.linalg.norm(rest) / size)
