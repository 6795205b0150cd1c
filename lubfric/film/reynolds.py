"""Discrete equations of the line contact, residual and Jacobian, and Newton's method on one grid.

The unknowns ``z`` are the pressures at the n nodes before the rupture point, H00, the mass flux q and the rupture
point e (X = e + xi). The film H is carried in addition to them with its own equation, H = H00 + X²/2 + K P. One
undamped Newton step removes the ``defect`` of that equation. This helps because a film that is interpolated from a
coarser grid is a far better start than the film of an interpolated pressure. The equations, each divided by its own
scale, are:

- n faces: mass flux through the face = q (for a transient, q plus what was stored upstream). Poiseuille flow has the
  logarithmic mean of the fluidity 1/eta (exact for Barus). Couette flow has film and density interpolated third-order
  upwind. Such an interpolation sees a sawtooth in P, which a centred mean would not. A fluid that shear makes thinner
  has Φ times that Poiseuille flow (`thinning`).
- inlet: far upstream the film is Newtonian and parabolic, so P falls like |X|^-3 and P = |X|/3 dP/dX; or P = 0 where
  the lubricant begins (starved inlet).
- load, with the tail upstream of the inlet.
- rupture (Swift-Stieber): P = 0 is built in; dP/dX = 0 means rho H = q at the last node.

Where the lubricant begins at a given place, the grid is stretched as e moves, so that its first node stays there. Where
a given film arrives, q is known, and that place a = -X[0] is the unknown instead; again the grid is stretched.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from .._base import count_work
from ..errors import CONVERGED, DIVERGED, ITERATION_LIMIT
from .grid import Grid
from .problem import FilmProblem

# Largest change of ln(eta) in one step [-]. A choice: a larger value saves steps where all goes well, and may fail.
# Half and twice this value change f by less than .01 % and the work by less than 1 % (constants.csv).
VISCOSITY_STEP = 3.0
# Largest share of the film, or of the flux, that one step may remove [-]. A choice: a larger value saves steps where
# all goes well, and may fail.
MOST_FILM_STEP = 0.7
# Counted work [s of a usual core] of a Newton step, whatever its cells: 1.4 to 1.6e-4 was measured on 48 and 96 cells.
STEP_WORK = 1.4e-4
# Counted work [s of a usual core] of a Newton step over the square of its cells, whose matrix is dense: measured on 96
# and 192 cells.
MATRIX_WORK = 4e-9


def count_film_step(cells: int) -> None:
    """Count the work of a Newton step on so many ``cells`` (`lubfric._base.work`)."""
    count_work(STEP_WORK + MATRIX_WORK * cells**2)


@dataclass(frozen=True, kw_only=True)
class ReynoldsTerms:
    """The part of an evaluation of the residual that the Jacobian needs."""

    P: np.ndarray
    H: np.ndarray
    X: np.ndarray
    defect: np.ndarray  # H00 + X²/2 + K P - H
    by_rupture: np.ndarray  # d(H00 + X²/2)/de
    by_stretch: np.ndarray  # d(H00 + X²/2 + K P)/ds of the grid stretched by s
    q: float
    slope: np.ndarray  # d ln(eta)/dP at the nodes
    density: tuple[Any, ...]  # rho and d rho/dP at the nodes
    face_density: np.ndarray
    face_H: np.ndarray
    fluidity: tuple[Any, ...]  # logarithmic mean and its derivatives by ln(eta) left, right
    gradient: np.ndarray  # (dP/dX)/6
    thin: tuple[Any, ...]  # Φ, s dΦ/ds, b dΦ/db
    flux: np.ndarray  # mass flux towards +X, Couette minus Poiseuille


def log_mean_fluidity(log_eta: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the logarithmic mean of exp(-log_eta) over each cell and its derivatives by the left and right value."""
    d = np.diff(log_eta)
    left = np.exp(-log_eta[:-1])
    small = np.abs(d) < 1e-3
    e = np.where(small, 1.0, d)
    decay = np.exp(-e)
    mean = np.where(small, 1.0 - d / 2 + d * d / 6, (1.0 - decay) / e)
    by_d = np.where(small, -0.5 + d / 3 - d * d / 8, (decay * (1.0 + e) - 1.0) / (e * e))
    return left * mean, -left * (mean + by_d), left * by_d


def elastic_film(grid: Grid, z: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return H00 + X²/2 + K P at the nodes, and its derivatives by e and by the stretch of the grid."""
    X = grid.xi + z[-1]
    deflection = grid.kernel[:, :-1] @ z[:-3]
    by_stretch = deflection - 4.0 / np.pi * (grid.weights[:-1] @ z[:-3]) + X * grid.xi
    return deflection + (z[-3] + 0.5 * X * X), X, by_stretch


def residual(grid: Grid, problem: FilmProblem, z: np.ndarray, H: np.ndarray) -> tuple[np.ndarray, ReynoldsTerms]:
    """Return the residual (n + 3) at the film H and the `ReynoldsTerms` that the Jacobian needs."""
    n = grid.n
    P = np.append(z[:n], 0.0)
    q, e = z[n + 1 :]
    X = grid.xi + e
    log_eta, slope = problem.log_viscosity(P)
    rho, rho_slope = problem.density(P)
    face_rho = grid.face_film @ rho
    face_H = grid.face_film @ H
    fluidity = log_mean_fluidity(log_eta)
    gradient = np.diff(P) / (6.0 * grid.cells)
    thin = problem.thinned(fluidity[0], face_H, 6.0 * gradient)
    flux = face_rho * face_H * (1.0 - face_H**2 * fluidity[0] * gradient * thin[0])
    R = np.empty(n + 3)
    R[:n] = 1.0 - flux / q
    a = -X[0]
    if problem.inlet is None:
        R[n] = (P[0] - 2.0 * a * (H[0] - q) / H[0] ** 3) * a / problem.M
        R[n + 1] = (grid.weights @ P + 0.5 * a * P[0]) / problem.M - 1.0
    else:
        R[n] = P[0] * a / problem.M
        R[n + 1] = grid.weights @ P / problem.M - 1.0
    R[n + 2] = rho[-1] * H[-1] / q - 1.0
    film, by_rupture, by_stretch = elastic_film(grid, z)
    return R, ReynoldsTerms(
        P=P,
        H=H,
        X=X,
        defect=film - H,
        by_rupture=by_rupture,
        by_stretch=by_stretch,
        q=q,
        slope=slope,
        density=(rho, rho_slope),
        face_density=face_rho,
        face_H=face_H,
        fluidity=fluidity,
        gradient=gradient,
        thin=thin,
        flux=flux,
    )


def linearise(grid: Grid, problem: FilmProblem, terms: ReynoldsTerms) -> tuple[np.ndarray, np.ndarray]:
    """Return the Jacobian (n + 3, n + 3) with the film eliminated, and the change of the residual (n + 3) when the
    film's defect is removed. Fortran order lets LAPACK factorise in place."""
    n = grid.n
    J = np.empty((n + 3, n + 3), order="F")
    shift = np.zeros(n + 3)
    by_H = _face_rows(grid, terms, J)
    shift[:n] = by_H * (grid.face_film @ terms.defect)
    at_inlet, at_rupture = _closing_rows(grid, problem, terms, J)
    shift[n] = at_inlet * terms.defect[0]
    shift[n + 2] = at_rupture * terms.defect[-1]
    if problem.inlet is not None:
        _stretch_columns(grid, problem, terms, J, by_H, at_rupture)
    return J, shift


def _stretch_columns(
    grid: Grid, problem: FilmProblem, t: ReynoldsTerms, J: np.ndarray, by_H: np.ndarray, at_rupture: float
) -> None:
    """Add what the stretch s of the grid changes, of which e + a is the length: to the column of e, and in place of
    that of q if q is known."""
    n = grid.n
    by_s = np.zeros(grid.n + 3)
    flow = t.face_density * t.face_H**3 * t.fluidity[0] * t.gradient * (t.thin[0] + t.thin[2])
    by_s[:n] = by_H * (grid.face_film @ t.by_stretch) - flow / t.q
    by_s[n + 1] = grid.weights @ t.P / problem.M
    by_s[n + 2] = at_rupture * t.by_stretch[-1]
    by_s /= -grid.xi[0]
    J[:, n + 2] += by_s
    if problem.fed is not None:
        J[:, n + 1] = by_s


def _face_rows(grid: Grid, t: ReynoldsTerms, J: np.ndarray) -> np.ndarray:
    """Fill the rows of Reynolds' equation on the faces into ``J``; return their derivative by the film."""
    n = grid.n
    q = t.q
    mean, by_left, by_right = t.fluidity
    thin, by_stress, by_gradient = t.thin
    cube = t.face_density * t.face_H**3
    by_H = t.face_density * ((3.0 * thin - by_stress + by_gradient) * t.face_H**2 * mean * t.gradient - 1.0) / q
    np.multiply(by_H[:, None], grid.face_kernel[:, :n], out=J[:n, :n])
    by_P = cube * mean / (6.0 * grid.cells) * (thin + by_gradient)
    by_log = cube * t.gradient * (thin - by_stress)
    left = by_log * by_left * t.slope[:-1] - by_P
    right = by_log * by_right * t.slope[1:] + by_P
    i = np.arange(n)
    J[i, i] += left / q
    J[i[:-1], i[1:]] += right[:-1] / q
    rho_slope = t.density[1][:n]
    if rho_slope.any():
        by_rho = t.face_H * (t.face_H**2 * mean * t.gradient * thin - 1.0) / q
        J[:n, :n] += by_rho[:, None] * grid.face_film[:, :n] * rho_slope
    J[:n, n] = by_H
    J[:n, n + 1] = t.flux / q**2
    J[:n, n + 2] = by_H * (grid.face_film @ t.by_rupture)
    return by_H


def _closing_rows(grid: Grid, problem: FilmProblem, t: ReynoldsTerms, J: np.ndarray) -> tuple[float, float]:
    """Fill the rows of the inlet, of the load and of the rupture into ``J``; return the derivatives of the first and of
    the last one by the film."""
    n = grid.n
    q = t.q
    M = problem.M
    a = -t.X[0]
    J[n] = 0.0
    by_h = 0.0
    J[n + 1, :n] = grid.weights[:n] / M
    J[n + 1, n:] = 0.0
    if problem.inlet is None:
        h = t.H[0]
        by_h = -2.0 * a * (3.0 * q - 2.0 * h) / h**4 * a / M
        J[n, :n] = by_h * grid.kernel[0, :n]
        J[n, 0] += a / M
        J[n, n] = by_h
        J[n, n + 1] = 2.0 * a / h**3 * a / M
        J[n, n + 2] = by_h * t.by_rupture[0] + (4.0 * a * (h - q) / h**3 - t.P[0]) / M
        J[n + 1, 0] += 0.5 * a / M
        J[n + 1, n + 2] = -0.5 * t.P[0] / M
    else:
        J[n, 0] = a / M
        J[n, n + 2] = -t.P[0] / M
    rho = t.density[0][-1]
    J[n + 2, :n] = grid.kernel[-1, :n] * rho / q
    J[n + 2, n:] = rho / q, -rho * t.H[-1] / q**2, rho * t.by_rupture[-1] / q
    return by_h, rho / q


@dataclass(frozen=True, kw_only=True)
class FilmSolution:
    """Unknowns ``z`` on ``grid`` with their `ReynoldsTerms`; ``error``: largest residual or film defect."""

    grid: Grid
    z: np.ndarray
    terms: ReynoldsTerms
    status: str
    error: float
    history: tuple[float, ...]


def step_length(log_viscosity_change: np.ndarray, film_loss: float) -> float:
    """Return the part of a step to take, 0 to 1. It follows from two effects of the full step: the change of ln(eta)
    at the nodes, and ``film_loss``, the largest fraction of the film (or flux) that it removes."""
    change = float(np.max(np.abs(log_viscosity_change)))
    length = 1.0 if change <= VISCOSITY_STEP else VISCOSITY_STEP / change
    return length if film_loss * length <= MOST_FILM_STEP else MOST_FILM_STEP / film_loss


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def newton(
    grid: Grid, problem: FilmProblem, z: np.ndarray, H: np.ndarray, tolerance: float, max_steps: int
) -> FilmSolution:
    """Solve the equations from unknowns z and film H > 0 to max(|residual|, |defect|/H) <= ``tolerance``.

    A step that overflows ends the iteration as "diverged".
    """
    from scipy.linalg.lapack import dgesv

    history = []
    inlet = problem.inlet
    fed = problem.fed
    if inlet is not None:
        grid = grid.stretched((inlet + z[-1]) / -grid.xi[0])
    if fed is not None:
        z = np.append(z[:-2], (fed, z[-1]))
    status = ITERATION_LIMIT
    for step in range(max_steps + 1):
        count_film_step(grid.n)
        R, terms = residual(grid, problem, z, H)
        error = max(float(np.max(np.abs(R))), float(np.max(np.abs(terms.defect) / H)))
        history.append(error)
        if error <= tolerance:
            status = CONVERGED
        if status == CONVERGED or not np.isfinite(error) or step == max_steps:
            break
        J, shift = linearise(grid, problem, terms)
        _, _, delta, info = dgesv(J, -(R + shift), overwrite_a=1, overwrite_b=1)
        if info != 0:
            break
        dH = terms.defect + grid.kernel[:, :-1] @ delta[:-3] + (delta[-3] + terms.by_rupture * delta[-1])
        lost = -delta[-2] / (terms.q if fed is None else -terms.X[0] - problem.half_width)
        stretch = 0.0
        if inlet is not None:
            stretch = (delta[-1] + (0.0 if fed is None else delta[-2])) / -grid.xi[0]
            dH += terms.by_stretch * stretch
            lost = max(lost, abs(stretch))
        loss = max(float(np.max(-dH / terms.H)), lost)
        length = step_length(delta[:-3] * terms.slope[:-1], loss)
        if stretch:
            grid = grid.stretched(1.0 + length * stretch)
        if fed is not None:
            delta[-2] = 0.0
        z = z + length * delta
        H = H + length * dH
    if status != CONVERGED and step < max_steps:
        status = DIVERGED
    return FilmSolution(grid=grid, z=z, terms=terms, status=status, error=error, history=tuple(history))
