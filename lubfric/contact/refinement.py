"""What a dry contact solve returns, and the rounds that find it: a search in single precision on the cells that may
touch, then a check in double precision everywhere.

Only the check ends the loop: `evaluate` looks at the complete patch in double precision, whatever the search found.
There is no proof that conjugate directions converge when they are kept while the set changes. So rounds that gain
nothing end the solve as stagnated.
"""

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np

from .._base import Shown, count_work
from ..errors import CONVERGED, ITERATION_LIMIT, STAGNATED, Report, worst
from .candidate_cells import CandidateCells
from .operator import HalfSpace
from .problem import ContactProblem, TrialContact, dot, rescaled, zero_level
from .search import FIRST_PACE, CandidateSearch

# Gap over the deepest overlap [-] below which a cell may come into contact. Halved and doubled by `python -m
# verification.campaigns.benchmarks.contact_constants`.
CANDIDATE_GAP = 2.0
# Share of the tolerance [-] that the search aims at. Halved and doubled by `python -m
# verification.campaigns.benchmarks.contact_constants`.
MARGIN = 0.8
# Fall of the residual within a round [-], as far as single precision goes. Halved and doubled by `python -m
# verification.campaigns.benchmarks.contact_constants`.
FALL = 8e-6
# Deflection of a yielded cell over the roughness [-] below which the search is exact. Halved and doubled by `python -m
# verification.campaigns.benchmarks.contact_constants`.
RIGID_DEFLECTION = 1e-2
# Rounds without halving the residual after which the solve has stagnated. Halved and doubled by `python -m
# verification.campaigns.benchmarks.contact_constants`.
WASTED = 4
# Counted work [s of a usual core] of an evaluation, over its cells: 2 to 3e-8 was measured on strips of 1e4 to 1.6e6
# cells.
EVALUATION = 2.3e-8


@dataclass(frozen=True, repr=False, kw_only=True)
class ContactResult(Shown):
    """Fields and means of one dry contact. Arrays are (nx, ny); means are over the complete array.

    Attributes
    ----------
    pressure : 0 <= p <= hardness [Pa]
    displacement : u = K p [m], up to the constant of the half-space operator
    gap : gap0 - approach + displacement [m]; >= 0, except where the pressure is at the hardness and the bodies overlap
    approach : rigid motion towards each other [m]
    mean_pressure : load per area [Pa]
    mean_gap : volume between the bodies per area [m]; overlapping cells count as zero
    contact_area_fraction : share of the cells with p > 0 [-]
    plastic_area_fraction : share of the cells with p = hardness [-]
    length : L [m], in which the report measures the gap (infinite without load)
    report : how the solve ended
    operator : `HalfSpace.identity` of the operator by which the displacement follows from the pressure

    Notes
    -----
    The residuals of the report are computed from the returned pressure alone, in double precision, after the iteration
    has ended. L is ``length``, by `length_scale`:

    - complementarity: ``Σ p m / (L Σ p)``, with the misfit m = |gap|, or max(gap, 0) where p = H
    - penetration: ``max(-gap)/L`` over cells with p < H
    - load: ``|mean p - mean_pressure|/mean_pressure``, or volume: ``|mean max(gap, 0) - mean_gap|/min(L, mean_gap)``
    """

    pressure: np.ndarray
    gap: np.ndarray
    displacement: np.ndarray
    approach: float
    mean_pressure: float
    mean_gap: float
    contact_area_fraction: float
    plastic_area_fraction: float
    length: float
    report: Report
    operator: tuple[Hashable, ...]

    def _facts(self) -> dict[str, str]:
        nx, ny = self.pressure.shape
        return {
            "": f"{nx} x {ny} cells",
            "mean pressure": f"{self.mean_pressure:.4g} Pa",
            "mean gap": f"{self.mean_gap:.4g} m",
            "contact area": f"{100 * self.contact_area_fraction:.3g} %",
            "status": self.report.status,
        }


@dataclass(frozen=True, kw_only=True)
class SearchResult:
    """The end of the rounds (``state``): how they ended, their cost, and the pace with which a next search should
    begin."""

    state: TrialContact
    status: str
    iterations: int
    convolutions: float
    history: Sequence[float] = ()
    pace: float = FIRST_PACE
    solver: str = "preconditioned conjugate gradient, candidates in single precision"
    notes: Sequence[str] = ()


def length_scale(
    pressure: np.ndarray,
    displacement: np.ndarray,
    gap0: np.ndarray,
    operator: HalfSpace,
    roughness: float | None = None,
) -> float:
    """Return the length L [m] in which gap residuals are measured.

    ``max(min(Σ p u / Σ p, max(d, r)), min(d, r))`` with the ``roughness`` r (None: rms of gap0) and the deflection ``d
    = (4/pi) p_mean a/E'`` of the shortest ripple that the grid resolves (a: the finer spacing) under the mean
    pressure. The load-weighted elastic deflection Σ p u / Σ p is twice the elastic energy per load. It is the
    indentation of one touching cell, about the approach of a Hertz contact, and about the roughness height when most
    of it is flattened. Two bounds are needed. At most max(d, r): without periodicity the deflection includes the bulk,
    which deforms under the total load however smooth the surface. At least min(d, r): in full contact little
    deflection remains to compare with. L is proportional to the lengths, and does not change with E' and p together.
    It is never below 1e-9 d, where rounding begins (flat on flat). Infinite without load.
    """
    total = float(pressure.sum())
    if total <= 0:
        return math.inf
    ripple = 4 / math.pi * total / pressure.size * min(operator.spacing) / operator.e_prime
    smaller, larger = sorted((ripple, float(gap0.std()) if roughness is None else roughness))
    loaded = np.flatnonzero(pressure > 0)
    work = dot(pressure.ravel()[loaded], displacement.ravel()[loaded])
    return float(max(min(work / total, larger), smaller, 1e-9 * ripple))


def contact_residuals(pressure: np.ndarray, gap: np.ndarray, scale: float, hardness: float) -> dict[str, float]:
    """Return complementarity and penetration residuals, dimensionless; see `ContactResult` for formulas."""
    loaded = np.flatnonzero(pressure > 0)
    gap = gap.ravel()
    carried = pressure.ravel()[loaded]
    apart = np.abs(gap[loaded])
    yielded = carried >= hardness
    if yielded.any():
        apart[yielded] = np.maximum(gap[loaded[yielded]], 0.0)
        gap = gap.copy()
        gap[loaded[yielded]] = 0.0
    lowest = float(gap.min())
    if not loaded.size:
        return {"complementarity": 0.0, "penetration": math.inf if lowest < 0 else 0.0}
    return {"complementarity": dot(carried, apart) / (carried.sum() * scale), "penetration": max(0.0, -lowest) / scale}


def evaluate(
    problem: ContactProblem, operator: HalfSpace, pressure: np.ndarray, approach: float | None = None
) -> TrialContact:
    """Return the `TrialContact` of ``pressure`` by one application of ``operator``; ``approach`` [m]: the
    prescribed one."""
    count_work(EVALUATION * pressure.size)
    return trial_contact(problem, pressure, operator.apply(pressure), approach)


def trial_contact(
    problem: ContactProblem, pressure: np.ndarray, displacement: np.ndarray, approach: float | None = None
) -> TrialContact:
    """Return the `TrialContact` of ``pressure``, the ``displacement`` [m] of which is known."""
    gap = np.add(problem.gap0, displacement, out=np.empty_like(displacement), casting="same_kind")
    if approach is None:
        loaded = np.flatnonzero(pressure > 0)
        elastic = loaded[pressure.ravel()[loaded] < problem.hardness]
        hard = pressure >= problem.hardness
        approach = gap.ravel()[elastic].mean(dtype=float) if elastic.size else zero_level(gap, hard)
    gap -= approach
    scale = length_scale(pressure, displacement, problem.gap0, problem.operator, problem.roughness)
    residuals = contact_residuals(pressure, gap, scale, problem.hardness)
    return TrialContact(
        pressure=pressure, displacement=displacement, gap=gap, approach=approach, scale=scale, residuals=residuals
    )


def refine(
    problem: ContactProblem,
    state: TrialContact,
    *,
    load: float | None = None,
    approach: float | None = None,
    pace: float = FIRST_PACE,
    spent: float = 0.0,
) -> SearchResult:
    """Solve from ``state``, which carries a total ``load`` [Pa cells] or has an ``approach`` [m], and took ``spent``
    convolutions."""
    # A state in the precision of the operator has been looked at already: one that converged ends the solve.
    is_checked = state.displacement.dtype == problem.operator.symbol.dtype
    status = CONVERGED if is_checked and state.residual <= MARGIN * problem.tolerance else None
    best = np.inf
    wasted = 0
    iterations = 0
    convolutions = spent
    history: list[float] = []
    while status is None:
        goal = max(MARGIN * problem.tolerance, FALL * min(state.residual, 1.0))
        pressure = state.pressure
        if state.residual > goal and iterations < problem.max_iterations:
            search = _begun(problem, state, load, pace, exact=wasted > 0)
            del state  # the search holds what it needs
            search.run(goal, problem.max_iterations - iterations)
            iterations += search.iterations
            pace = pace if wasted else search.pace
            history += search.history[:-1]
            convolutions += search.convolutions
            new_pressure = search.new_pressure(pressure, problem.hardness)
            del search
            pressure = _carrying(new_pressure, pressure, load, problem.hardness)
            del new_pressure
        state = evaluate(problem, problem.operator, pressure, approach)
        convolutions += 1
        best, wasted = (state.residual, 0) if state.residual < 0.5 * best else (best, wasted + 1)
        if state.residual <= problem.tolerance:
            status = CONVERGED
        elif iterations >= problem.max_iterations:
            status = ITERATION_LIMIT
        elif wasted > WASTED:
            status = STAGNATED
    return SearchResult(
        state=state,
        status=status,
        iterations=iterations,
        convolutions=convolutions,
        history=(*history, state.residual),
        pace=pace,
    )


def contact_result(
    problem: ContactProblem, search: SearchResult, control: dict[str, float], failed: str
) -> ContactResult:
    """Return the result of a solve, judged by the residuals of its state and of its ``control``, that of what was
    prescribed. If it ended for another reason than a limit with one of them above the tolerance, its status is
    ``failed``."""
    state = search.state
    residuals = search.state.residuals | control
    pressure = state.pressure
    residual = worst(residuals)
    status = failed if search.status == CONVERGED else search.status
    if residual <= problem.tolerance:
        status = CONVERGED
    report = Report(
        search.solver,
        status,
        iterations=search.iterations,
        residual=residual,
        tolerance=problem.tolerance,
        residuals=residuals,
        history=tuple(search.history),
        evaluations=search.convolutions,
        notes=tuple(search.notes),
    )
    return ContactResult(
        pressure=pressure,
        gap=state.gap,
        displacement=state.displacement,
        approach=float(state.approach) + problem.offset,
        mean_pressure=float(pressure.mean()),
        mean_gap=state.mean_gap,
        contact_area_fraction=np.count_nonzero(pressure) / pressure.size,
        plastic_area_fraction=np.count_nonzero(pressure >= problem.hardness) / pressure.size,
        length=state.scale,
        report=report,
        operator=problem.operator.identity,
    )


def _begun(
    problem: ContactProblem, state: TrialContact, load: float | None, pace: float, *, exact: bool
) -> CandidateSearch:
    """Return a search from ``state`` on the cells that are loaded, or may come into touch."""
    operator = problem.operator.single
    if np.isfinite(state.scale):
        overlap = state.residuals["penetration"] * state.scale  # of cells that have not yielded
    else:
        overlap = max(0.0, -float(state.gap.min()))
    flags = state.gap < CANDIDATE_GAP * overlap
    flags |= state.pressure > 0
    rigid = problem.hardness * min(operator.spacing) / operator.e_prime < RIGID_DEFLECTION * problem.roughness
    return CandidateSearch(problem, CandidateCells.flagged(operator, flags), state, load, pace, exact=exact or rigid)


def _carrying(new_pressure: np.ndarray, old_pressure: np.ndarray, load: float | None, hardness: float) -> np.ndarray:
    """Return ``new_pressure`` [Pa], made to carry the load. If single precision has lost the load, the pressure with
    which the search had ``old_pressure``."""
    total = new_pressure.sum()
    if not np.isfinite(total) or load is not None and total <= 0:
        return old_pressure
    return new_pressure if load is None else rescaled(new_pressure, load, hardness)
