"""Newton's method on the coupled equations.

The weights of near pressures are implicit, in one banded factorisation with a border for the two unknown films at the
ends. GMRES around it adds the weights of far pressures. So not only the answer but also the step is that of the full
integral. Without GMRES (KRYLOV_LIMIT = 0) the far deflection lags one step behind, as in the original method.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._base import FloatArray, IntArray
from ..errors import CONVERGED, DIVERGED, ITERATION_LIMIT, worst
from ..film import FilmProblem, step_length
from . import differential_equations as equations
from .differential_equations import DifferentialTerms, Mesh

# GMRES vectors in one Newton step, at most. A choice, for memory.
KRYLOV_LIMIT = 40
# Share of the far deflection [-] that a Newton step may leave to the next one. A choice: a larger value takes more
# Newton steps, a smaller one more of GMRES.
FORCING = 1e-2


@dataclass(frozen=True, kw_only=True)
class DifferentialSolution:
    """Pressures and films on ``mesh`` with their `DifferentialTerms`, residuals of `measure`, and the number of banded
    solves."""

    mesh: Mesh
    P: np.ndarray
    H: np.ndarray
    terms: DifferentialTerms
    status: str
    residuals: dict[str, Any]
    history: tuple[float, ...]
    solves: int


def near_solver(mesh: Mesh, problem: FilmProblem, t: DifferentialTerms) -> Callable[..., Any] | None:
    """Return the equations with near weights, factorised; None if the matrix is singular.

    The function returned takes the right sides: (N,) of the balances and of the second differences, (2,) of the
    conditions at the ends. It gives the changes (2N,) of P and H of a node side by side. The two films at the ends are
    a border of the banded matrix.
    """
    from scipy.linalg.lapack import dgbtrf, dgbtrs

    n = mesh.size
    m = mesh.bandwidth
    lower = max(3, 2 * m + 1)
    upper = max(3, 2 * m - 1)
    A = np.zeros((2 * lower + upper + 1, 2 * n), order="F")

    def put(rows: int | IntArray, columns: int | IntArray, values: float | FloatArray) -> None:
        A[lower + upper + rows - columns, columns] += values

    _put_reynolds(mesh, t, put)
    _put_film(mesh, put)
    lu, pivots, info = dgbtrf(A, lower, upper, overwrite_ab=1)
    if info != 0:
        return None
    border = np.zeros((2 * n, 2), order="F")
    border[1, 0] = 1.0
    border[-1, 1] = 1.0
    border, _ = dgbtrs(lu, lower, upper, border, pivots, overwrite_b=1)
    rows = np.stack([equations.tilt_row(mesh), equations.load_row(mesh, problem)])
    end_matrix = rows @ border[0::2] + [[1.0, -1.0], [0.0, 0.0]]

    def solve(balance: FloatArray, bend: FloatArray, ends: FloatArray) -> FloatArray:
        right = np.column_stack([balance, bend]).ravel()
        z, _ = dgbtrs(lu, lower, upper, right, pivots, overwrite_b=1)
        return z + border @ np.linalg.solve(end_matrix, ends - rows @ z[0::2])

    return solve


def _put_reynolds(mesh: Mesh, t: DifferentialTerms, put: Callable[..., Any]) -> None:
    put(0, 0, 1.0)
    put(0, 2, -equations.inlet_ratio(mesh))
    dry = np.arange(t.last + 1, mesh.size)
    put(2 * dry, 2 * dry, 1.0)
    i = np.arange(1, t.last + 1)
    for sign, face in ((1.0, i), (-1.0, i - 1)):
        put(2 * i, 2 * face, sign * t.by_P[0, face] / t.scale)
        put(2 * i, 2 * face + 2, sign * t.by_P[1, face] / t.scale)
        inner = face > 0
        far = np.where(inner, face - 1, 2)
        near = np.where(inner, face, 1)
        for column, weight in ((far, -0.125), (near, 0.75), (np.where(inner, face + 1, 0), 0.375)):
            put(2 * i, 2 * column + 1, sign * weight * t.by_H[face] / t.scale)


def _put_film(mesh: Mesh, put: Callable[..., Any]) -> None:
    n = mesh.size
    i = np.arange(1, n - 1)
    for shift, value in ((-1, 1.0), (0, -2.0), (1, 1.0)):
        put(2 * i + 1, 2 * (i + shift) + 1, value)
    for k in range(-mesh.bandwidth, mesh.bandwidth + 1):
        j = i[(i - k >= 0) & (i - k < n)]
        put(2 * j + 1, 2 * (j - k), -mesh.weights[abs(k)])
    put(1, 1, 1.0)
    put(2 * n - 1, 2 * n - 1, 1.0)


def newton_step(mesh: Mesh, t: DifferentialTerms, near: Callable[..., Any]) -> tuple[np.ndarray, int]:
    """Return the change (2N,) of P and H in turn, and the number of banded solves.

    With A the near equations, which ``near`` solves, the change z solves A z = b + f, where f = far(z) is the effect of
    far pressures on the second differences. So z = A⁻¹b + A⁻¹f and f - far(A⁻¹f) = far(A⁻¹b). GMRES solves the latter
    for f.
    """
    from scipy.sparse.linalg import LinearOperator, gmres

    def far(z: FloatArray) -> FloatArray:
        f = equations.convolve(mesh.far_transform, z[0::2])
        f[[0, -1]] = 0.0
        return f

    bend = np.zeros(mesh.size)
    still = np.zeros(mesh.size)
    bend[1:-1] = np.diff(t.defect, 2)
    z = near(-t.balance, -bend, -t.ends)
    if mesh.bandwidth >= mesh.size - 1:
        return z, 1
    answers = [z]

    def left(f: FloatArray) -> FloatArray:
        answers.append(near(still, f, np.zeros(2)))
        return f - far(answers[-1])

    operator = LinearOperator((mesh.size, mesh.size), left, dtype=float)
    f, _ = gmres(operator, far(z), rtol=FORCING, restart=KRYLOV_LIMIT, maxiter=1)
    return z + near(still, f, np.zeros(2)), len(answers) + 1


@np.errstate(over="ignore", divide="ignore", invalid="ignore")  # history tests for it
def newton(
    mesh: Mesh, problem: FilmProblem, P: np.ndarray, H: np.ndarray, tolerance: float, max_steps: int
) -> DifferentialSolution:
    """Solve from P >= 0 and H > 0 until the residuals of `measure` are <= ``tolerance`` and the film ruptures inside
    the grid."""
    history = []
    solves = 0
    status = ITERATION_LIMIT
    for step in range(max_steps + 1):
        t = equations.evaluate(mesh, problem, P, H)
        residuals = equations.measure(t, P, H)
        history.append(worst(residuals))
        ruptured = t.last < mesh.size - 2 and P[t.last] > 0.0 and not np.any(P[t.last + 1 :])
        if history[-1] <= tolerance and ruptured:
            status = CONVERGED
        if status == CONVERGED or history[-1] == np.inf or step == max_steps:
            break
        near = near_solver(mesh, problem, t)
        if near is None:
            break
        z, count = newton_step(mesh, t, near)
        solves += count
        length = step_length(z[0::2] * t.slope, float(np.max(-z[1::2] / H)))
        P = P + length * z[0::2]
        H = H + length * z[1::2]
        P[t.last + 1 :] = 0.0  # and no tension behind the peak
        peak = int(np.argmax(P))
        P[peak:] = np.maximum(P[peak:], 0.0)
    if status != CONVERGED and step < max_steps:
        status = DIVERGED
    return DifferentialSolution(
        mesh=mesh, P=P, H=H, terms=t, status=status, residuals=residuals, history=tuple(history), solves=solves
    )
