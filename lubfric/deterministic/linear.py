"""One linear system of Newton's method: GMRES applies the dense K by FFT; the preconditioner is a sparse LU with its
diagonal.

Every cell has one unknown: p, the dent if it has yielded, or the fill if it has ruptured; h0 is one more. Through h
every cell depends on every pressure. ``R_p + R_h diag(K)`` is sparse, and near enough to that for a preconditioner.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import diags
from scipy.sparse.linalg import splu

from .dissection import nested_dissection
from .problem import Problem
from .reynolds import derivatives
from .state import RUPTURED, TOUCHING, Look, Past, load_error

ACCURACY = 1e-3  # of the residual of the linear system
KRYLOV, CYCLES = 40, 3


@dataclass(frozen=True)
class Step:
    """Solution of the linear system: changes of pressure [Pa], fill [-], dent [m], h0 [m] and gap [m]; ``iterations``
    of GMRES, and the relative residual reached."""

    pressure: np.ndarray
    fill: np.ndarray
    dent: np.ndarray
    approach: float
    gap: np.ndarray
    iterations: int
    residual: float


class System:
    """The linear system at a state. Rows are scaled by U and a film, columns by a pressure, so that both have no
    dimension."""

    def __init__(self, problem: Problem, at: Look, past: Past | None = None):
        self.problem, self.at = problem, at
        state = at.state
        self.shape = state.pressure.shape
        self.film = max(float(np.mean(np.abs(at.balance.inlet.flow))) / problem.speed, problem.floor)
        self.row = 1.0 / (problem.speed * self.film / problem.spacing[0])
        self.touching = (state.kind == TOUCHING).ravel()
        ruptured, dented = (state.kind == RUPTURED).ravel(), state.yielded.ravel()
        stress = problem.load / (problem.spacing[0] * 64)
        self.to_pressure = np.where(ruptured | dented, 0.0, stress)
        self.to_dent = np.where(dented, self.film, 0.0)
        self.to_fill = np.where(ruptured, 1.0, 0.0)
        self.by_p, self.by_h, self.by_fill = self._rows(past)
        self._weights()
        self._factorise()

    def _rows(self, past):
        """d(equation)/dp, d/dh and d/dfill of every cell over all cells."""
        problem, at = self.problem, self.at
        open_ = at.state.kind != TOUCHING  # also where h is still the floor: it is about to rise
        by_p, by_h, by_fill = derivatives(problem, at.balance, at.state.pressure, open_)
        if past is not None:
            fluid, film, fill = at.balance.fluid, at.balance.film, at.state.fill
            by_p = by_p + diags((fill * fluid.density_slope * film).ravel() / past.step)
            by_h = by_h + diags((fill * fluid.density * open_).ravel() / past.step)
            by_fill = by_fill + diags((fluid.density * film).ravel() / past.step)
        flowing = diags(np.where(self.touching, 0.0, self.row))
        closed = diags(self.touching / self.film)
        return (flowing @ by_p).tocsr(), (flowing @ by_h + closed).tocsr(), (flowing @ by_fill).tocsr()

    def _weights(self):
        """The load row: by p and by h of all cells, relative to the load."""
        problem, inlet = self.problem, self.at.balance.inlet
        by_p = np.full(self.shape, problem.spacing[0] / self.shape[1])
        by_p[0] += inlet.load_by_pressure
        self.load_by_p, self.load_by_h = by_p / problem.load, inlet.load_by_film / problem.load

    def _factorise(self):
        lifted = self.to_pressure * self.problem.self_deflection + self.to_dent
        matrix = self.by_p @ diags(self.to_pressure) + self.by_h @ diags(lifted) + self.by_fill @ diags(self.to_fill)
        self.order = nested_dissection(*self.shape)
        matrix = matrix.tocsr()[self.order][:, self.order].tocsc()
        self.lu = splu(matrix, permc_spec="NATURAL", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        self.column = self.by_h @ np.full(self.at.gap.size, self.film)  # by h0
        self.corner = float(self.load_by_h.sum()) * self.film
        self.load_row = self.load_by_p.ravel() * self.to_pressure
        self.solved_column = self._inner(self.column)
        self.schur = self.corner - float(self.load_row @ self.solved_column)

    def _inner(self, rows):
        inner = np.empty_like(rows)
        inner[self.order] = self.lu.solve(rows[self.order])
        return inner

    def fields(self, unknowns):
        """Changes (pressure, fill, dent, h0) of scaled unknowns (n + 1,)."""
        parts = (unknowns[:-1] * scale for scale in (self.to_pressure, self.to_fill, self.to_dent))
        return *(part.reshape(self.shape) for part in parts), float(unknowns[-1] * self.film)

    def apply(self, unknowns):
        """The Jacobian times scaled unknowns."""
        pressure, fill, dent, approach = self.fields(unknowns)
        gap = self.problem.operator.apply(pressure) + dent + approach
        rows = self.by_p @ pressure.ravel() + self.by_h @ gap.ravel() + self.by_fill @ fill.ravel()
        load = float((self.load_by_p * pressure).sum() + self.load_by_h @ gap[0])
        return np.append(rows, load)

    def precondition(self, rows):
        """The inverse of the sparse part, bordered by h0 and the load."""
        inner = self._inner(rows[:-1])
        approach = (rows[-1] - float(self.load_row @ inner)) / self.schur
        return np.append(inner - approach * self.solved_column, approach)

    def right_side(self) -> np.ndarray:
        """Minus the equations at the state: mass of fluid cells, gap of touching ones, load."""
        problem, at = self.problem, self.at
        gap = (at.gap.ravel() - problem.floor) / self.film
        rows = np.where(self.touching, gap, at.residual.ravel() * self.row)
        return -np.append(rows, load_error(problem, at) / problem.load)

    def solve(self) -> Step:
        """The Newton step."""
        unknowns, iterations, left = gmres(self.apply, self.precondition, self.right_side())
        pressure, fill, dent, approach = self.fields(unknowns)
        gap = self.problem.operator.apply(pressure) + dent + approach
        return Step(pressure, fill, dent, approach, gap, iterations, left)


def gmres(apply, precondition, right, accuracy=ACCURACY, most=KRYLOV, cycles=CYCLES) -> tuple[np.ndarray, int, float]:
    """Solve ``apply(x) = right`` by right-preconditioned GMRES until |residual| <= accuracy |right|; restarted after
    ``most`` iterations, in all ``cycles`` times begun.

    Y. Saad, M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856-869, doi:10.1137/0907058. Returns x, the
    iterations, and the relative residual reached.
    """
    size = np.linalg.norm(right)
    x, count = np.zeros_like(right), 0
    if size == 0:
        return x, 0, 0.0
    rest = right.copy()
    for _ in range(cycles):
        beta = np.linalg.norm(rest)
        basis = [rest / beta]
        hessenberg = np.zeros((most + 1, most))
        for k in range(most):
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
