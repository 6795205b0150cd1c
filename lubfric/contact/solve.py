"""Dry contact of a rough half-space, with its load or its mean gap prescribed: `solve_contact`."""

import math
from dataclasses import replace

import numpy as np

from .._base import FloatArray, increasing_root, validate, with_default_errors
from ..errors import CONVERGED, ITERATION_LIMIT, InputError, returned
from .operator import HalfSpace
from .problem import ContactProblem, ContactStart, TrialContact, contact_problem, rescaled, shifted, starting_point
from .refinement import ContactResult, SearchResult, contact_result, evaluate, refine, trial_contact
from .search import FIRST_PACE

# Load over that of a start [-] beyond which new asperity contacts matter more than the old ones. A choice: it decides
# the start alone.
MOST_LOAD_OVER_START = 2.0
# Change of the load over that of a start [-] up to which pressure and displacement are scaled, which takes no
# convolution. Halved and doubled by `python -m verification.campaigns.benchmarks.contact_constants`.
LARGEST_SCALING = 0.2
# Mean pressure over E' height/spacing [-] that flattens any surface: 1.1 would do for a periodic ripple. A choice: it
# bounds a search.
FLATTENED = 10.0


@with_default_errors
def solve_contact(
    gap0: FloatArray,
    spacing: float | tuple[float, float],
    e_prime: float,
    *,
    mean_pressure: float | None = None,
    mean_gap: float | None = None,
    hardness: float | None = None,
    boundary: tuple[str, str] = ("periodic", "periodic"),
    tolerance: float = 1e-6,
    start: FloatArray | ContactResult | ContactStart | None = None,
    operator: HalfSpace | None = None,
    max_iterations: int = 2000,
    raise_on_failure: bool = True,
) -> ContactResult:
    """Return the pressure and gap of two rough bodies pressed together, without friction or adhesion.

    The conditions are ``p >= 0``, ``gap = gap0 - approach + K p >= 0``, ``p gap = 0``. With a hardness H also
    ``p <= H``, and cells at p = H may overlap (A. Akchurin et al., Tribol. Lett. 59:19 (2015), Eqs. 1-3,
    doi:10.1007/s11249-015-0536-z). The solve has converged when the largest residual of the report is <= tolerance
    (`ContactResult` has the formulas).

    Parameters
    ----------
    gap0 : (nx, ny) undeformed gap of the pair [m], up to a constant; x is axis 0
    spacing : cell size [m], one number or (dx, dy)
    e_prime : E' [Pa], 2/E' = sum (1 - nu²)/E
    mean_pressure : load per area of the complete array [Pa], or
    mean_gap : volume between the bodies per area of the complete array [m]; overlapping cells count as zero
    hardness : limit of the pressure [Pa]; None: elastic
    boundary : "periodic" or "free" for each axis, see `lubfric.contact.half_space`
    tolerance : largest residual accepted
    start : an earlier `ContactResult`, or a pressure field [Pa], to start from
    operator : a `HalfSpace` built before for this grid, to share between solves
    max_iterations, raise_on_failure : number of iterations after which the solve ends; False returns the unconverged
        result

    Returns a `ContactResult`.

    Raises
    ------
    InputError : a value out of range, before any work
    ConvergenceError : the tolerance was not met; carries report and result
    """
    problem = contact_problem(gap0, spacing, e_prime, hardness, boundary, tolerance, operator, max_iterations)
    mean_pressure, mean_gap = _checked_control(problem, mean_pressure, mean_gap)
    begun = starting_point(problem, start)
    touching_gap = float(problem.gap0.mean())
    if mean_pressure == 0 or (mean_gap is not None and mean_gap >= touching_gap):
        search = _separated(problem, touching_gap if mean_gap is None else mean_gap)
    elif mean_pressure is not None:
        search = _solved(problem, begun, mean_pressure, mean_pressure=mean_pressure)
    else:
        assert mean_gap is not None  # one of both is given
        search = _gap_controlled(problem, mean_gap, begun)
    result = contact_result(problem, search, _control(search.state, mean_pressure, mean_gap), ITERATION_LIMIT)
    return returned(result, raise_on_failure=raise_on_failure)


def _control(state: TrialContact, mean_pressure: float | None, mean_gap: float | None) -> dict[str, float]:
    """Return the residual of what was prescribed."""
    if mean_gap is None:
        return {"load": float(abs(state.pressure.mean() - mean_pressure) / (mean_pressure or 1.0))}
    return {"volume": abs(state.mean_gap - mean_gap) / min(state.scale, mean_gap)}


def _checked_control(
    problem: ContactProblem, mean_pressure: float | None, mean_gap: float | None
) -> tuple[float | None, float | None]:
    """Return the load and mean gap, of which exactly one has to be given, in a range that has a solution."""
    if (mean_pressure is None) == (mean_gap is None):
        given = "both are given" if mean_gap is not None else "neither is given"
        raise InputError(f"mean_pressure [Pa] and mean_gap [m]: {given}; give exactly one of them")
    if mean_gap is not None:
        return None, validate.positive("mean_gap", mean_gap, "m")
    mean_pressure = validate.nonnegative("mean_pressure", mean_pressure, "Pa")
    if mean_pressure > problem.hardness:
        raise InputError(
            f"mean_pressure = {mean_pressure:g} Pa cannot be carried; allowed: at most the hardness "
            f"{problem.hardness:g} Pa, at which the whole area yields"
        )
    return mean_pressure, None


def _solved(
    problem: ContactProblem,
    start: ContactStart | None,
    uniform: float,
    *,
    mean_pressure: float | None = None,
    approach: float | None = None,
) -> SearchResult:
    """Solve for a mean pressure [Pa] or an approach [m] from ``start``, made to carry the load. Without one, from
    coarser grids, the coarsest of which starts from a ``uniform`` pressure [Pa]."""
    load = None if mean_pressure is None else mean_pressure * problem.gap0.size
    if start is None:
        pressure, pace, spent = _coarse_start(problem, uniform, mean_pressure, approach)
        state = _evaluated(problem, pressure, approach)
        return refine(problem, state, load=load, approach=approach, pace=pace, spent=spent + 1.0)
    factor = _scaling(problem, start, load)
    if start.displacement is not None and factor is not None:
        state = trial_contact(problem, factor * start.pressure, factor * start.displacement, approach)
        return refine(problem, state, load=load, approach=approach)
    pressure = start.pressure if load is None else _loaded(start.pressure, load, problem.hardness)
    return refine(problem, _evaluated(problem, pressure, approach), load=load, approach=approach, spent=1.0)


def _evaluated(problem: ContactProblem, pressure: FloatArray, approach: float | None) -> TrialContact:
    """Return the state of ``pressure`` [Pa] in single precision, by a convolution."""
    return evaluate(problem, problem.operator.single, pressure, approach)


def _scaling(problem: ContactProblem, start: ContactStart, load: float | None) -> float | None:
    """Return the factor on the pressure of ``start``, and on its displacement, which is proportional to it, at which it
    carries ``load`` [Pa cells]. None where the load differs by more than `LARGEST_SCALING`, or where a cell has yielded
    or would, as its pressure stays."""
    factor = 1.0 if load is None else load / float(start.pressure.sum())
    highest = max(1.0, factor) * float(start.pressure.max())
    can_be_scaled = factor == 1.0 or (abs(factor - 1.0) <= LARGEST_SCALING and highest < problem.hardness)
    return factor if can_be_scaled else None


def _loaded(pressure: FloatArray, load: float, hardness: float) -> np.ndarray:
    """Return ``pressure`` [Pa], made to carry ``load`` [Pa cells]."""
    moved = shifted if load <= MOST_LOAD_OVER_START * pressure.sum() else rescaled
    return moved(pressure, load, hardness)


def _coarse_start(
    problem: ContactProblem, uniform: float, mean_pressure: float | None, approach: float | None
) -> tuple[np.ndarray, float, float]:
    """Return a loose solution on cells twice as long, which is made in the same way: its pressure, its pace, and the
    number of convolutions in units of this grid. A grid that cannot be halved starts from the ``uniform`` pressure."""
    coarse = problem.coarsened()
    if coarse is None:
        return np.full(problem.gap0.shape, uniform), FIRST_PACE, 0.0
    search = _solved(coarse, None, uniform, mean_pressure=mean_pressure, approach=approach)
    fx, fy = (n // m for n, m in zip(problem.gap0.shape, coarse.gap0.shape))
    pressure = search.state.pressure.repeat(fx, axis=0).repeat(fy, axis=1)
    return pressure, search.pace, search.convolutions * coarse.gap0.size / problem.gap0.size


def _gap_controlled(problem: ContactProblem, mean_gap: float, start: ContactStart | None) -> SearchResult:
    """Solve the contact whose mean gap is ``mean_gap`` [m].

    In an elastic periodic contact the mean deflection is zero. So the approach is known, and one solve is enough.
    Otherwise, or if that solve fails, the load is searched. The first pressure is E' times rms height over the longer
    side, which flattens a wave of that length and height.
    """
    operator = problem.operator
    longest = max(n * d for n, d in zip(operator.shape, operator.spacing))
    guess = min(operator.e_prime * problem.roughness / longest, 0.5 * problem.hardness)
    if problem.roughness > 0:  # the smaller the gap, the more exactly its zeros have to be met
        finer = problem.tolerance * min(1.0, 0.3 * mean_gap / problem.roughness)
        problem = replace(problem, tolerance=max(finer, 1e-13))
    if operator.boundary != ("periodic", "periodic") or math.isfinite(problem.hardness):
        return _load_searched(problem, mean_gap, guess, start)
    search = _solved(problem, start, guess, approach=float(problem.gap0.mean()) - mean_gap)
    if search.status == CONVERGED:
        return search
    note = f"at the known approach: {search.status} after {search.iterations} iterations; load searched instead"
    again = _load_searched(problem, mean_gap, guess, _start_from(search) if search.state.pressure.any() else start)
    return replace(again, notes=(note,), convolutions=again.convolutions + search.convolutions)


def _start_from(search: SearchResult) -> ContactStart:
    """Return the start from the end of another search on the same problem."""
    return ContactStart(pressure=search.state.pressure, displacement=search.state.displacement)


def _load_searched(problem: ContactProblem, mean_gap: float, guess: float, start: ContactStart | None) -> SearchResult:
    """Find the load with that mean gap, by one bracketed root in the logarithm of the pressure.

    The mean gap falls with the load, so there is one root. Each solve starts from the last. No load exceeds the one
    that flattens the whole height as if it were the shortest ripple that the grid resolves.
    """
    exact = replace(problem, tolerance=0.2 * problem.tolerance)
    spent = 0.0
    iterations = 0

    def surplus(log_pressure: float, last: SearchResult | None) -> tuple[float, SearchResult]:
        nonlocal spent, iterations
        mean = math.exp(log_pressure)
        search = _solved(exact, _start_from(last) if last else start, mean, mean_pressure=mean)
        spent += search.convolutions
        iterations += search.iterations
        return (mean_gap - search.state.mean_gap) / min(mean_gap, search.state.scale), search

    if start is not None:
        guess = float(start.pressure.mean())
    flattening = FLATTENED * problem.operator.e_prime * float(np.ptp(problem.gap0)) / min(problem.operator.spacing)
    bounds = (-300.0, math.log(min(problem.hardness, flattening)))
    root = increasing_root(surplus, math.log(guess), step=0.7, bounds=bounds, tolerance=0.5 * problem.tolerance)
    search = root.payload
    return replace(
        search,
        iterations=iterations,
        convolutions=spent,
        history=root.history,
        status=root.status if search.status == CONVERGED else search.status,
        solver="bracketed load, preconditioned conjugate gradient",
    )


def _separated(problem: ContactProblem, mean_gap: float) -> SearchResult:
    """Return the bodies that carry no load."""
    zero = np.zeros_like(problem.gap0)
    state = trial_contact(problem, zero, zero.copy(), float(problem.gap0.mean()) - mean_gap)
    return SearchResult(
        state=state,
        status=CONVERGED,
        iterations=0,
        convolutions=0.0,
        solver="none",
        notes=("the bodies carry no load",),
    )
