"""Frictionless contact with a rigid counterface by a primal-dual active set, on any finite-element compliance.

The unknowns are the nodal forces f and the approach delta. With u = C f and g = gap0 - delta + u, each node is one of
three: off (f = 0, g >= 0), touching (g = 0, 0 <= f <= limit) or saturated (f = limit, g <= 0).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ...types import BoolArray, FloatArray, Law
from .report import CONVERGED, DIVERGED, ITERATION_LIMIT, STAGNATED, SolveReport, require

SOLVER = "primal-dual active set"
FREE_SHARE = 0.2  # of the load off the saturated nodes that one step leaves at least on the others
INNER = 0.01  # tolerance of the inner conjugate gradients over the tolerance asked
INNER_LIMIT = 2000  # steps of the inner conjugate gradients, at most
ROUNDING = 1e-12  # of the load; what saturated nodes may carry beyond it
PATIENCE = 8  # steps without fewer nodes in the wrong place, before they are moved one at a time


@dataclass(frozen=True, kw_only=True)
class Contact:
    """Nodal fields (n,) of a contact, in the order of ``gap0``.

    pressure : nodal force over nodal weight, Pa
    gap : m; negative only where pressure is at its limit
    displacement : downwards, m
    approach : m
    touching, saturated : where the pressure is above zero, and at its limit
    report : `SolveReport`
    """

    pressure: np.ndarray
    gap: np.ndarray
    displacement: np.ndarray
    approach: float
    touching: np.ndarray
    saturated: np.ndarray
    report: SolveReport


@dataclass(frozen=True, kw_only=True)
class ContactProblem:
    """Checked input of `solve_contact`. ``limit`` is the limit of the nodal forces (inf without a cap)."""

    displacement: Callable[[np.ndarray], np.ndarray]
    weights: np.ndarray
    gap0: np.ndarray
    load: float
    limit: np.ndarray
    tolerance: float


def solve_contact(
    displacement: Law,
    weights: FloatArray,
    gap0: FloatArray,
    load: float,
    *,
    limit: float | None = None,
    tolerance: float = 1e-8,
    max_iterations: int = 300,
) -> Contact:
    """Return pressure of a rigid counterface on an elastic surface under a given load, optionally capped.

    Each step solves the equations of the touching nodes exactly (conjugate gradients on the forces of the given total)
    and then moves nodes: touching nodes that pull go off, those above the limit saturate, nodes off that penetrate
    touch, saturated nodes that gap touch (M. Hintermueller, K. Ito & K. Kunisch, SIAM J. Optim. 13 (2002) 865-888,
    doi:10.1137/S1052623401383558). With a cap it starts from the elastic contact; one step saturates no more nodes,
    beyond one, than leaves a fifth of the unsaturated load on the others, and the nearest nodes off join until the
    touching ones could carry what is left. Where moving all at once goes round in circles, they move one at a time
    until fewer are in the wrong place (J. J. Judice & F. M. Pires, Comput. Oper. Res. 21 (1994) 587-596).

    Parameters
    ----------
    displacement : downward displacement (n,) in m of nodal forces (n,): symmetric, positive definite
    weights : (n,) > 0, nodal force of a unit pressure (m for a line, m^2 for a surface)
    gap0 : (n,) undeformed gap in m, up to a constant
    load : N per metre of depth for a line, N for a surface
    limit : largest pressure in Pa; None: elastic

    ``report.residuals``, measured on the returned pressure with displacements computed afresh; L is the range
    of the displacement over the surface:

    - penetration ``max(-g)/L`` off the saturated nodes
    - complementarity ``sum f m/(L sum f)``, m = \\|g\\|, or max(g, 0) where saturated
    - load ``|sum f - load|/load``

    Raises
    ------
    InputError : before any work, also for a load no smaller than the limit can carry
    SolveError : a residual above ``tolerance``
    """
    problem = checked(displacement, weights, gap0, load, limit, tolerance)
    force = np.full(problem.gap0.size, load / problem.gap0.size)
    everywhere = np.ones(force.size, dtype=bool)
    elastic = replace(problem, limit=np.full(force.size, np.inf))
    force, steps = active_set(elastic, force, everywhere, ~everywhere, max_iterations)
    if limit is not None and np.any(force > problem.limit):
        saturated = limited(problem, force, ~everywhere)
        gap = problem.gap0 + displacement(force)
        touching = enough(problem, gap, (force > 0) & ~saturated, saturated)
        force, more = active_set(problem, force, touching, saturated, max_iterations)
        steps = (steps[0] + more[0], [*steps[1], *more[1]], more[2])
    solution = finish(problem, force, steps)
    return solution.report.checked(solution)


def checked(
    displacement: Law,
    weights: FloatArray,
    gap0: FloatArray,
    load: float,
    limit: float | None,
    tolerance: float,
) -> ContactProblem:
    """Return the problem, or `InputError`."""
    weights = np.array(weights, dtype=float)
    gap0 = np.array(gap0, dtype=float)
    fits = gap0.ndim == 1 and gap0.size > 0 and bool(np.all(np.isfinite(gap0)))
    require(fits, f"gap0 has shape {gap0.shape} or is not finite", "one finite length in m per node")
    fits = weights.shape == gap0.shape and bool(np.all(weights > 0))
    require(fits, f"weights have shape {weights.shape}", f"one value > 0 for each of {gap0.size} nodes")
    require(0 < tolerance < 1, f"tolerance = {tolerance}", "(0, 1)")
    most = np.inf if limit is None else limit
    carried = f"> 0, < what limit = {most:g} Pa carries on {weights.sum():g} m or m^2"
    require(most > 0 and 0 < load < most * weights.sum(), f"load = {load:g} N or N/m", carried)
    return ContactProblem(
        displacement=displacement,
        weights=weights,
        gap0=gap0,
        load=float(load),
        limit=most * weights,
        tolerance=tolerance,
    )


def active_set(
    problem: ContactProblem, force: FloatArray, touching: BoolArray, saturated: BoolArray, max_iterations: int
) -> tuple[FloatArray, tuple[int, list[float], str]]:
    """Return (force, (iterations, history, status)). Forces may pull or exceed the limit slightly."""
    history = []
    fewest = force.size + 1
    patience = PATIENCE
    for iteration in range(1, max_iterations + 1):
        force, gap = equilibrium(problem, force, touching, saturated)
        scale = max(np.ptp(gap - problem.gap0), np.finfo(float).tiny)
        pull = np.maximum(-force, 0).max() / force.max()
        above = np.maximum(force / problem.limit - 1, 0).max()
        inside = np.maximum(-gap[~saturated], 0).max(initial=0) / scale
        lifted = np.maximum(gap[saturated], 0).max(initial=0) / scale
        history.append(float(max(pull, above, inside, lifted)))
        if history[-1] <= problem.tolerance:
            return force, (iteration, history, CONVERGED)
        if not np.all(np.isfinite([*force, *gap])):
            return force, (iteration, history, DIVERGED)
        small = 0.1 * problem.tolerance * scale
        off = ~touching & ~saturated
        more = limited(problem, force, saturated & (gap <= small))
        wanted = (touching & (force > 0) | off & (gap < -small) | saturated & (gap > small)) & ~more
        moved = (wanted != touching) | (more != saturated)
        count = int(np.count_nonzero(moved))
        if not count:
            return force, (iteration, history, STAGNATED)
        fewest, patience = (count, PATIENCE) if count < fewest else (fewest, patience - 1)
        if patience < 0:
            moved &= np.arange(moved.size) == np.flatnonzero(moved)[-1]
        touching = np.where(moved, wanted, touching)
        saturated = np.where(moved, more, saturated)
        touching = enough(problem, gap, touching, saturated)
    return force, (max_iterations, history, ITERATION_LIMIT)


def limited(problem: ContactProblem, force: FloatArray, saturated: BoolArray) -> BoolArray:
    """Return ``saturated``, and the nodes above the limit, hardest pressed first, while others have load enough
    left."""
    over = np.flatnonzero((force > problem.limit) & ~saturated)
    over = over[np.argsort(-force[over] / problem.limit[over])]
    spare = problem.load - problem.limit[saturated].sum()
    carried = np.cumsum(problem.limit[over])
    taken = (carried <= (1 - FREE_SHARE) * spare) | (
        (np.arange(over.size) == 0) & (carried <= spare + ROUNDING * problem.load)
    )
    out = saturated.copy()
    out[over[taken]] = True
    return out


def enough(problem: ContactProblem, gap: FloatArray, touching: BoolArray, saturated: BoolArray) -> BoolArray:
    """Return ``touching``, and nodes that are off, nearest first, until these can carry what the saturated ones do
    not."""
    spare = problem.load - problem.limit[saturated].sum() - problem.limit[touching].sum()
    if spare <= 0 and touching.any():
        return touching
    near = np.flatnonzero(~touching & ~saturated)
    near = near[np.argsort(gap[near])]
    count = 1 + np.searchsorted(np.cumsum(problem.limit[near]), spare)
    out = touching.copy()
    out[near[:count]] = True
    return out


def equilibrium(
    problem: ContactProblem, force: FloatArray, touching: BoolArray, saturated: BoolArray
) -> tuple[FloatArray, FloatArray]:
    """Return forces with gap zero at the touching nodes, and the gap everywhere.

    The unknown is y = f/sqrt(w), so that nodes of unequal weight are alike. Steps stay orthogonal to sqrt(w), which
    keeps the load. The part of the misfit along sqrt(w) is the approach.
    """
    root = np.sqrt(problem.weights) * touching
    root2 = root @ root
    force = np.where(saturated, problem.limit, force * touching)
    force += root**2 * (problem.load - force.sum()) / root2
    misfit = problem.gap0 + problem.displacement(force)
    residual = shift(root * misfit, root, root2)
    direction = -residual
    rho = residual @ residual
    used = 1
    goal = INNER * problem.tolerance
    while used < INNER_LIMIT and np.isfinite(rho):
        approach = (root**2 @ misfit) / root2
        gap = misfit - approach
        if np.abs(gap[touching]).max() <= goal * np.ptp(misfit - problem.gap0):
            break
        if used % 50 == 0:
            direction = -residual
        push = root * direction
        move = problem.displacement(push)
        step = rho / (push @ move)
        force = force + step * push
        misfit = misfit + step * move
        used += 1
        residual = shift(root * misfit, root, root2)
        rho, before = residual @ residual, rho
        direction = rho / before * direction - residual
    return force, misfit - (root**2 @ misfit) / root2


def shift(vector: FloatArray, root: FloatArray, root2: float) -> FloatArray:
    """Return the part of ``vector`` orthogonal to ``root``."""
    return vector - root * ((root @ vector) / root2)


def finish(problem: ContactProblem, force: FloatArray, steps: tuple[int, list[float], str]) -> Contact:
    """Return fields and residuals from the forces alone."""
    iterations, history, status = steps
    force = np.clip(force, 0, problem.limit)
    displacement = problem.displacement(force)
    saturated = force >= problem.limit
    resting = (force > 0) & ~saturated
    misfit = problem.gap0 + displacement
    weight = problem.weights * resting
    lowest = misfit[saturated].max(initial=-np.inf)  # approach at which all saturated nodes touch
    approach = float(weight @ misfit / weight.sum() if resting.any() else lowest)
    gap = misfit - approach
    scale = np.ptp(displacement)
    off = np.where(saturated, np.maximum(gap, 0), np.abs(gap))
    residuals = {
        "penetration": float(np.maximum(-gap[~saturated], 0).max(initial=0) / scale),
        "complementarity": float(force @ off / (scale * force.sum())),
        "load": float(abs(force.sum() / problem.load - 1)),
    }
    report = SolveReport(
        solver=SOLVER,
        status=status,
        iterations=iterations,
        tolerance=problem.tolerance,
        residuals=residuals,
        history=tuple(history),
    )
    if report.residual <= problem.tolerance:
        status = CONVERGED
    elif status == CONVERGED:
        status = STAGNATED
    report = replace(report, status=status)
    return Contact(
        pressure=force / problem.weights,
        gap=gap,
        displacement=displacement,
        approach=approach,
        touching=force > 0,
        saturated=saturated,
        report=report,
    )
