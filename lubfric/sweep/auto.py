"""A Stribeck curve at speeds that it chooses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..curve.choose import next_speed
from ..errors import InputError
from ..prepared import Prepared
from ..report import ITERATION_LIMIT, Report
from ..store import fingerprint
from ..studies.adaptive import FEWEST, samples_of, tolerance_between
from ..studies.journal import Journal
from ..studies.trail import Trail
from ..studies.walk import Walk
from .result import StribeckResult, collected


def auto_curve(prepared: Prepared, fields, store, on_point) -> StribeckResult:
    """A curve at speeds that it chooses. Arguments as in `lubfric.stribeck`. If speeds failed, the result says so."""
    if fields is True:
        raise InputError("fields = True with speeds = 'auto'; give the speeds in m/s whose fields are kept")
    wanted = tuple(float(abs(u)) for u in np.atleast_1d(np.asarray(fields or [], float)))
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
