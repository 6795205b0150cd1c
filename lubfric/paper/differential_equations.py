"""Reynolds' equation coupled to the equation of the second differences of the film: residual and derivatives.

The unknowns are the pressures P and films H at all N nodes of a `Mesh`:

- Before the rupture point, mass balances at each node: the flux through face i is that through face i - 1. Behind it P
  = 0, and the outflow of a node may only exceed its inflow. The fluxes are those of `lubfric.film.reynolds`.
- At the inlet P falls like |X|^-3 upstream of the first node (flooded), or P = 0 there.
- The second difference of the film holds at interior nodes. It leaves a constant and a slope open. These are given by
  the films at both ends: their difference follows from the full integral, their height from the load. The residual is
  the second difference of the film's defect against the full integral (by FFT), so that it keeps its digits.

The weights of the second difference on the pressures decay like 1/k² with the distance k in nodes. Those within the
bandwidth are implicit. The rest is exact by FFT; GMRES adds it to each Newton step, which costs O(N log N + N
bandwidth²), so that it does not lag behind.

The pressures are piecewise linear (hat functions of width ``step``). In the variables of `lubfric.film.problem` their
film is H00 + X²/2 + sum_k log_kernel[k] P[i-k], and its second difference is

    H[i-1] - 2 H[i] + H[i+1] = step² + sum_k weights[k] P[i-k],  weights[k] = -(4/pi) step δ⁴(k² ln|k|/2),

without any error of discretisation.

Sources: H. P. Evans, T. G. Hughes, Proc. IMechE C 214 (2000) 563-584; T. G. Hughes, C. D. Elcoate, H. P. Evans, Proc.
IMechE C 214 (2000) 585-598; C. D. Elcoate, H. P. Evans, T. G. Hughes, R. W. Snidle, Proc. IMechE J 215 (2001) 319-337.
"""

import math
from dataclasses import dataclass

import numpy as np

from ..film import FilmProblem, log_mean_fluidity, moes_film

# Largest distance [nodes] whose pressures are implicit: it changes only the time. A choice: a larger value takes longer
# in a step, a smaller one takes more steps.
BANDWIDTH = 8
# Distance [nodes] from which the second difference of the kernel is a series. A choice: the series is exact to rounding
# there.
SERIES_DISTANCE = 20


@dataclass(frozen=True, kw_only=True)
class Mesh:
    """A uniform grid with its kernels.

    Attributes
    ----------
    X : (N,) positions of the nodes
    log_kernel, weights : (N,) of the film and of its second difference, by distance in nodes
    bandwidth : largest distance in nodes that counts as near
    log_transform, far_transform : Fourier transforms of log_kernel, and of the weights beyond the bandwidth
    flooded : whether the pressure continues upstream of the first node
    """

    X: np.ndarray
    step: float
    log_kernel: np.ndarray
    weights: np.ndarray
    bandwidth: int
    log_transform: np.ndarray
    far_transform: np.ndarray
    flooded: bool

    @property
    def size(self) -> int:
        """Return the number of nodes."""
        return self.X.size


def make_mesh(first: float, last: float, nodes: int, *, flooded: bool) -> Mesh:
    """Return ``nodes`` positions from ``first`` to ``last`` with the kernels between them."""
    X, step = np.linspace(first, last, nodes, retstep=True)
    second = _second_difference(nodes + 1)
    log_kernel = -4.0 / math.pi * step * (second[:-1] + math.log(step) - 1.5)
    weights = -4.0 / math.pi * step * np.diff(np.append(second[1], second), 2)
    far = weights.copy()
    far[: BANDWIDTH + 1] = 0.0
    near = min(BANDWIDTH, nodes - 1)
    transformed = _transform(log_kernel)
    outer = _transform(far)
    return Mesh(
        X=X,
        step=step,
        log_kernel=log_kernel,
        weights=weights,
        bandwidth=near,
        log_transform=transformed,
        far_transform=outer,
        flooded=flooded,
    )


def convolve(transform: np.ndarray, P: np.ndarray) -> np.ndarray:
    """Return sum_j kernel[|i-j|] P[j] at all nodes."""
    from scipy.fft import irfft, rfft

    size = _padded(P.size)
    return irfft(transform * rfft(P, size), size)[: P.size]


def _second_difference(n: int) -> np.ndarray:
    """Return the second difference of g = k² ln|k|/2 at k = 0 .. n - 1.

    From k = NEAR on it is Taylor's series with g'' = ln k + 3/2, because the differences lose their digits there.
    """
    k = np.arange(-1.0, SERIES_DISTANCE + 1)
    g = 0.5 * k * k * np.log(np.maximum(np.abs(k), 1.0))
    x = 1.0 / np.arange(SERIES_DISTANCE, max(n, SERIES_DISTANCE + 1)) ** 2.0
    series = -0.5 * np.log(x) + 1.5 - x * (1 / 12 + x * (1 / 60 + x / 168))
    return np.append(np.diff(g, 2), series)[:n]


def _padded(n: int) -> int:
    from scipy.fft import next_fast_len

    return next_fast_len(2 * n, real=True)


def _transform(kernel: np.ndarray) -> np.ndarray:
    from scipy.fft import rfft

    wrapped = np.zeros(_padded(kernel.size))
    wrapped[: kernel.size] = kernel
    wrapped[-kernel.size + 1 :] = kernel[:0:-1]
    return rfft(wrapped)


@dataclass(frozen=True, kw_only=True)
class DifferentialTerms:
    """One evaluation of the equations.

    Attributes
    ----------
    through : (N - 1,) mass flux at the faces
    last : the node before rupture
    q : the flux behind it
    balance : (N,) what leaves a node; P behind rupture
    defect : (N,) the film less the full integral, relative to the first node
    ends : the defects of the tilt between both ends and of the load
    scale : of the fluxes
    by_H, by_P : derivatives of a face's flux by its film, and by the pressures left and right of it
    slope : d ln(eta)/dP
    """

    through: np.ndarray
    last: int
    q: float
    balance: np.ndarray
    defect: np.ndarray
    ends: np.ndarray
    scale: float
    by_H: np.ndarray
    by_P: np.ndarray
    slope: np.ndarray


def evaluate(mesh: Mesh, problem: FilmProblem, P: np.ndarray, H: np.ndarray) -> DifferentialTerms:
    """Return the fluxes, balances and defects at pressures P and films H."""
    log_eta, slope = problem.log_viscosity(P)
    rho, rho_slope = problem.density(P)
    fluidity, by_left, by_right = log_mean_fluidity(log_eta)
    first = 0.375 * H[0] + 0.75 * H[1] - 0.125 * H[2]  # third-order upwind; the first face has nothing upstream
    face_rho = 0.5 * (rho[1:] + rho[:-1])
    h = np.append(first, 0.375 * H[2:] + 0.75 * H[1:-1] - 0.125 * H[:-2])
    gradient = np.diff(P) / (6.0 * mesh.step)
    flow = h - h**3 * fluidity * gradient
    cube = face_rho * h**3
    conductance = cube * fluidity / (6.0 * mesh.step)
    left = conductance - cube * gradient * by_left * slope[:-1] + 0.5 * flow * rho_slope[:-1]
    right = -conductance - cube * gradient * by_right * slope[1:] + 0.5 * flow * rho_slope[1:]
    through = face_rho * flow
    balance = np.zeros_like(P)
    balance[1:-1] = np.diff(through)
    last = _last_wet(P, balance)
    scale = moes_film(problem.M, problem.L)
    balance = np.where(np.arange(P.size) <= last, balance / scale, P)
    balance[0] = P[0] - inlet_ratio(mesh) * P[1]
    defect = H - 0.5 * mesh.X**2 - convolve(mesh.log_transform, P)
    ends = np.array([defect[0] - defect[-1], load_row(mesh, problem) @ P - 1.0])
    by_H = face_rho * (1.0 - 3.0 * h**2 * fluidity * gradient)
    by_P = np.stack([left, right])
    return DifferentialTerms(
        through=through,
        last=last,
        q=float(through[last]),
        balance=balance,
        defect=defect - defect[0],
        ends=ends,
        scale=scale,
        by_H=by_H,
        by_P=by_P,
        slope=slope,
    )


def load_row(mesh: Mesh, problem: FilmProblem) -> np.ndarray:
    """Return the row by which ∫ P dX/M = load_row @ P, with the tail |X|^-3 upstream of a flooded inlet."""
    row = np.full(mesh.size, mesh.step / problem.M)
    if mesh.flooded:
        row[0] = 0.5 * (mesh.step - mesh.X[0]) / problem.M
    return row


def tilt_row(mesh: Mesh) -> np.ndarray:
    """Return the row that gives the deflection at the last node minus that at the first."""
    return mesh.log_kernel[::-1] - mesh.log_kernel


def inlet_ratio(mesh: Mesh) -> float:
    """Return P at the first node as a share of P at the second."""
    return (mesh.X[1] / mesh.X[0]) ** 3 if mesh.flooded else 0.0


def _last_wet(P: np.ndarray, balance: np.ndarray) -> int:
    """Return the last node before rupture: pressures are positive up to it, and the balance of the next node would draw
    lubricant in."""
    peak = int(np.argmax(P))
    last = peak + int(np.argmax(P[peak:] <= 0.0)) - 1
    while last < P.size - 2 and balance[last + 1] < 0.0:
        last += 1
    return max(last, 1)


def measure(t: DifferentialTerms, P: np.ndarray, H: np.ndarray) -> dict[str, float]:
    """Return relative residuals of mass, film (against the full integral), load and complementarity."""
    behind = t.through[t.last + 1 :]
    return {
        "mass": float(np.max(np.abs(t.through[: t.last + 1] / t.q - 1.0))),
        "film": float(np.max(np.abs(t.defect) / H)),
        "load": abs(float(t.ends[1])),
        "complementarity": float(max(0.0, -P.min() / P.max(), 1.0 - behind.min(initial=t.q) / t.q)),
    }
