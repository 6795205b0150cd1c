"""The separation at which asperities carry a load."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from .._base import Root, increasing_root, validate
from ..errors import CONVERGED, STAGNATED, ConvergenceError, InputError, Report
from .asperity import AsperityResult, find_asperities

SCAN = 1.25  # ratio between neighbouring approaches of the scan for a load
SCAN_RANGE = (1e-5, 1.0)  # of the height range: down to the deepest valley
SOLVER = "asperity separation"


def separation_for_load(
    heights,
    spacing,
    e_prime,
    *,
    mean_pressure,
    definition="summits",
    hardness=None,
    periodic=True,
    tolerance=1e-3,
    raise_on_failure=True,
) -> AsperityResult:
    """The separation at which independent asperities carry a given load.

    The flat comes down in steps. Each approach to the highest point is 25 % longer than the last, and none goes below
    the deepest valley. When the load is reached, the last step is searched (Chandrupatla), until
    ``|load - target|/target <= tolerance``. The load of summits is continuous and falls with the separation. That of
    patches jumps where cells join (a tolerance of 1e-3 suits some hundred contacts). It also has a largest value,
    because patches grow together.

    Parameters
    ----------
    heights, spacing, e_prime, definition, hardness, periodic : as in `asperity_contact`
    mean_pressure : load over the area of the map [Pa]
    tolerance, raise_on_failure : relative, on the load; False returns the closest result with its report

    Returns
    -------
    AsperityResult

    Raises
    ------
    InputError : a value out of range
    ConvergenceError : the model cannot carry the load, or jumps over it; carries report and the closest result
    """
    options = {"definition": definition, "hardness": hardness, "periodic": periodic}
    asperities = find_asperities(heights, spacing, e_prime, **options)
    target = validate.positive("mean_pressure", mean_pressure, "Pa")
    validate.number("tolerance", tolerance, "(-)", above=0.0, maximum=0.5)
    top, span = asperities.heights.max(), float(np.ptp(asperities.heights))
    if span == 0:
        raise InputError("heights are all equal: no asperities; give a rough surface in m")

    def excess(approach, _=None):
        result = asperities.at(float(top - approach))
        return result.mean_pressure / target - 1, result

    before, count = 0.0, 0
    best = excess(0.0)[1]
    for approach in span * np.geomspace(*SCAN_RANGE, _scan_count()):
        value, result = excess(approach)
        count += 1
        best = result if result.load > best.load else best
        if value >= 0:
            middle, bounds = 0.5 * (before + approach), (before, approach)
            step = 0.25 * (approach - before)
            root = increasing_root(excess, middle, step=step, bounds=bounds, tolerance=tolerance)
            return _found(root, count, tolerance, raise_on_failure)
        before = approach
    return _too_much(best, target, count, tolerance, raise_on_failure)


def _too_much(best: AsperityResult, target: float, count: int, tolerance, raise_on_failure) -> AsperityResult:
    """The message if the asperities carry ``best`` at most."""
    most = f"{best.mean_pressure:.4g} Pa"
    short = 1 - best.mean_pressure / target
    notes = (f"{best.definition} carry {most} at most",)
    report = Report(SOLVER, STAGNATED, count, short, tolerance, evaluations=count, notes=notes)
    result = replace(best, report=report)
    if raise_on_failure:
        message = (
            f"{best.definition} cannot carry a mean pressure of {target:.4g} Pa: at most {most}, at separation "
            f"{best.separation:.4g} m"
        )
        raise ConvergenceError(message, report, result)
    return result


def _scan_count() -> int:
    return 1 + math.ceil(math.log(SCAN_RANGE[1] / SCAN_RANGE[0]) / math.log(SCAN))


def _found(root: Root, count, tolerance, raise_on_failure) -> AsperityResult:
    status = CONVERGED if root.status == CONVERGED else STAGNATED
    report = Report(
        SOLVER,
        status,
        len(root.history),
        abs(root.value),
        tolerance,
        residuals={"load": abs(root.value)},
        history=root.history,
        evaluations=count + len(root.history),
    )
    result = replace(root.payload, report=report)
    if raise_on_failure:
        report.raise_if_failed(result)
    return result
