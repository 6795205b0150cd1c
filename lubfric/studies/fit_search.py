"""Where the minima of a fit lie: a search over the complete bounds by curves of the coarse model.

The first curves are those at the start and at the points of a Sobol sequence. Their residuals are interpolated by
radial basis functions over the parameters. The minima of the interpolated sum of squares are solved for, each new curve
improves the interpolation, and the search ends when its minima are curves that are known. Along f_b, in which f is
linear at a balance, further curves take no solve: there the search sees several for each solved one. (Surrogate
optimisation: R. G. Regis and C. A. Shoemaker, INFORMS J. Comput. 19 (2007) 497-509, doi:10.1287/ijoc.1060.0182. Here
the residuals are interpolated instead of their sum of squares, which keeps the Gauss-Newton structure.)
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..errors import LubfricError
from .fit_curves import FitCurves

# Points of the Sobol sequence for each parameter, before rounding up to a power of two; and at most. A choice: more
# finds narrower minima, and takes longer.
SOBOL_PER_PARAMETER = 6
MOST_SOBOL = 64

# Curves at minima of the interpolation: for each parameter, beside two. A choice: a bound of the work.
REFINEMENTS_PER_PARAMETER = 3

# Curves at minima of the interpolation that are expected for each parameter: one and two parameters took one and two
# in the fits of `python -m verification.campaigns.estimates`.
USUAL_REFINEMENTS = 1

# Positions along f_b, as shares of the bounds, of the curves that follow from a solved one. A choice: they cost no
# solve, and three would hold all residuals where f_b is on a linear scale.
ALONG_LINEAR = (0.02, 0.26, 0.5, 0.74, 0.98)

# Starts of the minimisation of the interpolation, in a power of two: it costs no solve. A choice: fewer may miss a
# minimum.
SURROGATE_STARTS = 16

# Distance of two positions, as a share of the bounds, below which they are one minimum. A choice: a smaller value
# reports a flat minimum twice, a larger one misses near ones.
SAME_MINIMUM = 0.1

# Distance of two positions, as a share of the bounds, below which a curve adds nothing to the interpolation. A choice:
# a smaller value takes curves that tell nothing new.
KNOWN_DISTANCE = 0.01

# Expected decrease of the sum of squares below that of a curve in the same minimum, as a share of it, from which a
# further curve is solved there. A convention: less refines minima that the fit refines anyway, and follows valleys that
# the data do not close.
LEAST_EXPECTED_DECREASE = 0.01

# Positions between two curves at which the interpolation is compared with them; and how much larger than at the higher
# curve the residuals have to be there to part two minima. Conventions.
BETWEEN = np.linspace(0.05, 0.95, 19)
LEAST_BARRIER = 1.02

# A start at a bound is moved inside by this share of the bounds, for the differences. A choice: half of
# `PARAMETER_STEP`.
INSIDE = 0.02

# Root mean square residual over the least one up to which another minimum is reported. A choice: a larger value reports
# minima that the data exclude.
COMPARABLE = 1.5


@dataclass(frozen=True)
class Candidate:
    """A position between the bounds, (p,), and the root mean square residual of the coarse curve there; whether larger
    residuals part it from the lowest one."""

    unit: np.ndarray
    misfit: float
    is_separate: bool = False


def sobol_count(parameters: int) -> int:
    """Return the number of points of the Sobol sequence for so many ``parameters``."""
    return min(2 ** math.ceil(math.log2(SOBOL_PER_PARAMETER * parameters)), MOST_SOBOL)


def estimated_curves(changed: int, starts: int) -> int:
    """Return about how many coarse curves `search_minima` solves, from so many ``starts`` of a Sobol sequence;
    ``changed``: number of parameters whose change takes a solve."""
    return 1 + starts + USUAL_REFINEMENTS * changed if starts else 0


def search_minima(
    curves: FitCurves, start: np.ndarray, starts: int, *, linear_place: int | None = None
) -> list[Candidate]:
    """Return the minima of the residuals of the coarse ``curves``, the lowest first, each more than `SAME_MINIMUM`
    from the others.

    A curve with a point that cannot be solved is omitted. Raises `ConvergenceError` if there is no other.

    Parameters
    ----------
    starts : number of points of the Sobol sequence (0: only ``start`` is returned)
    linear_place : of the parameter among the positions whose change takes no solve (`FitCurves.linear_place`); None:
        none
    """
    from scipy.stats import qmc

    if not starts:
        return [Candidate(start, math.nan)]
    changed = [place for place in range(start.size) if place != linear_place]
    first = np.tile(start, (1 + starts, 1))
    first[1:, changed] = qmc.Sobol(len(changed), seed=0).random(starts)
    units: list[np.ndarray] = []
    residuals: list[np.ndarray] = []
    failure: LubfricError | None = None

    def add(unit: np.ndarray) -> None:
        nonlocal failure
        unit = np.clip(unit, INSIDE, 1.0 - INSIDE)
        try:
            residuals.append(curves.residuals(unit))
            units.append(unit)
        except LubfricError as error:
            failure = error

    def add_along(unit: np.ndarray) -> None:
        """Add the curve at ``unit``, and those that follow from it without a solve."""
        before = len(units)
        add(unit)
        if linear_place is None or len(units) == before:
            return
        known = units[before]
        lowest = curves.lowest_over_boundary_friction(known)[linear_place]
        for share in {*ALONG_LINEAR, float(lowest)} - {float(known[linear_place])}:
            moved = known.copy()
            moved[linear_place] = share
            add(moved)

    for unit in first:
        add_along(unit)
    if failure is not None and not units:
        raise failure
    tried = list(units)
    for _ in range(2 + REFINEMENTS_PER_PARAMETER * start.size):
        if len(np.unique(np.array(units)[:, changed], axis=0)) <= len(changed) + 1:
            break
        new = _next_position(np.array(units), np.array(residuals), np.array(tried))
        if new is None:
            break
        tried.append(new)
        add_along(new)
    misfits = [float(np.sqrt(np.mean(row**2))) for row in residuals]
    lowest, *others = distinct([Candidate(unit, misfit) for unit, misfit in zip(units, misfits)])
    parted = [
        replace(each, is_separate=are_parted(curves, lowest, each, units=units, residuals=residuals)) for each in others
    ]
    return [lowest, *parted]


def with_minimum(curves: FitCurves, minima: Sequence[Candidate], unit: np.ndarray) -> list[Candidate]:
    """Return ``minima`` of the coarse ``curves`` with a lower one at ``unit`` that their search missed, as the first.
    It was reached from the former first one: what larger residuals part from that, they part from the new one."""
    try:
        misfit = float(np.sqrt(np.mean(curves.residuals(unit) ** 2)))
    except LubfricError:
        return list(minima)
    lowest = Candidate(unit, misfit)
    return [lowest, *(each for each in minima if each.misfit <= COMPARABLE * misfit and not _is_near(each, lowest))]


def are_parted(
    curves: FitCurves,
    lowest: Candidate,
    other: Candidate,
    *,
    units: Sequence[np.ndarray],
    residuals: Sequence[np.ndarray],
) -> bool:
    """Return whether the residuals are larger somewhere on the line between two candidates than at the higher one: else
    both lie in one valley. Where the interpolated ones are, a curve decides: beside an edge of f they have humps."""
    from scipy.interpolate import RBFInterpolator

    if len(units) <= lowest.unit.size + 1:
        return True  # too few curves to interpolate
    surrogate = RBFInterpolator(np.array(units), np.array(residuals), kernel="cubic", degree=1)
    line = lowest.unit + BETWEEN[:, None] * (other.unit - lowest.unit)
    between = np.sqrt(np.mean(surrogate(line) ** 2, axis=1))
    if between.max() <= LEAST_BARRIER * other.misfit:
        return False
    share = float(BETWEEN[int(np.argmax(between))])
    try:
        barrier = curves.residuals(lowest.unit + share * (other.unit - lowest.unit))
    except LubfricError:
        return True  # a model that does not answer there parts them
    return bool(np.sqrt(np.mean(barrier**2)) > LEAST_BARRIER * other.misfit)


def _is_near(one: Candidate, other: Candidate) -> bool:
    """Return whether two candidates are one minimum."""
    return bool(np.abs(one.unit - other.unit).max() < SAME_MINIMUM)


def distinct(candidates: list[Candidate]) -> list[Candidate]:
    """Return the ``candidates`` that lie lower than all others within `SAME_MINIMUM`, the lowest first, as far as they
    compare with the least."""
    kept: list[Candidate] = []
    for candidate in sorted(candidates, key=lambda one: one.misfit):
        near = any(_is_near(candidate, other) for other in kept)
        if not near and (not kept or candidate.misfit <= COMPARABLE * kept[0].misfit):
            kept.append(candidate)
    return kept


def _next_position(units: np.ndarray, residuals: np.ndarray, tried: np.ndarray) -> np.ndarray | None:
    """Return the lowest minimum of the interpolated sum of squares that is no curve yet; None if there is none.

    ``units`` (m, p) and ``residuals`` (m, n): of the curves; ``tried`` (k, p): all positions that were requested of the
    model.
    """
    from scipy.interpolate import RBFInterpolator
    from scipy.optimize import least_squares
    from scipy.stats import qmc

    surrogate = RBFInterpolator(units, residuals, kernel="cubic", degree=1)
    spread = qmc.Sobol(units.shape[1], seed=1).random(SURROGATE_STARTS)
    order = np.argsort(np.mean(residuals**2, axis=1))
    minima = []
    for begin in (*units[order[:4]], *np.clip(spread, INSIDE, 1.0 - INSIDE)):
        end = least_squares(
            lambda unit: surrogate(unit[None, :])[0],
            np.clip(begin, INSIDE + 1e-6, 1.0 - INSIDE - 1e-6),
            bounds=(INSIDE, 1.0 - INSIDE),
            xtol=1e-4,
            ftol=1e-4,
            max_nfev=40,
        )
        minima.append((end.cost, end.x))
    costs = np.sum(residuals**2, axis=1) / 2
    for cost, unit in sorted(minima, key=lambda pair: pair[0]):
        if cost > COMPARABLE**2 * costs.min():
            return None
        is_as_low = costs * (1.0 - LEAST_EXPECTED_DECREASE) <= cost
        is_near = np.abs(units - unit).max(axis=1) < SAME_MINIMUM
        if np.abs(tried - unit).max(axis=1).min() > KNOWN_DISTANCE and not np.any(is_as_low & is_near):
            return unit
    return None
