"""A Stribeck curve at speeds that it chooses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .._base import validate
from ..errors import ITERATION_LIMIT, InputError, Report
from ..scene import FASTEST
from ..sharing import Prepared
from .adaptive import FEWEST, samples_of, tolerance_between
from .choose import next_speed
from .fingerprint import fingerprint
from .journal import Journal
from .sweep_result import StribeckResult, collected
from .trail import Trail
from .walk import Walk


def fields_at(fields) -> np.ndarray:
    """The speeds [m/s] whose film and contact are to be kept: one, several, or none (None, False, an empty list)."""
    empty = isinstance(fields, (list, tuple)) and not fields or isinstance(fields, np.ndarray) and not fields.size
    if fields is None or fields is False or empty:
        return np.empty(0)
    return validate.numbers("fields", fields, "m/s", FASTEST)


def auto_curve(prepared: Prepared, fields, store, on_point) -> StribeckResult:
    """A curve at speeds that it chooses. Arguments as in `lubfric.stribeck`. If speeds failed, the result says so."""
    if fields is True:
        raise InputError("fields = True with speeds = 'auto'; give the speeds in m/s whose fields are kept")
    wanted = tuple(abs(u) for u in fields_at(fields).tolist())
    walk = Walk(prepared.scene, fingerprint(prepared, wanted), (), frozenset(wanted))
    found: dict[float, object] = {}
    with Journal(store) as journal:
        for _, speed, outcome in Trail(prepared, walk, journal, journal.records()).points():
            found[speed] = outcome
            if on_point:
                on_point(len(found), len(found), speed, outcome)
        journal.end(walk.keys)
    speeds = np.array(sorted(found))
    outcomes = dict(enumerate(found[u] for u in speeds))
    errors = {i: o for i, o in outcomes.items() if isinstance(o, Exception)}
    result = collected(speeds, [None if i in errors else o for i, o in outcomes.items()], errors)
    if len(speeds) - len(errors) >= FEWEST:
        result = replace(result, report=_with_interpolation(result, tolerance_between(prepared)))
    return result


def _with_interpolation(result: StribeckResult, tolerance: float) -> Report:
    """The report of a curve that chose its speeds: its residual is the estimated error between the points."""
    error = next_speed(samples_of([p for p in result.points if p is not None]), tolerance)[1]
    status = result.report.status if error <= tolerance else ITERATION_LIMIT
    residuals = {"interpolation": error, "points": result.report.residual}
    advice = result.report.advice if result.errors else "solve more speeds of your own, or loosen numerics.tolerance"
    return replace(
        result.report, status=status, residual=error, tolerance=tolerance, residuals=residuals, advice=advice
    )
