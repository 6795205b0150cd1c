"""The numbers of one-way load sharing as a `FrictionResult`."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..deterministic.refine import estimate
from ..film.shear import ShearForce
from ..one_way.point import OneWay
from ..one_way.refine import one_way_point
from ..prepared import Prepared
from ..result import FrictionResult
from ..sampling.uncertainty import field_errors_of, not_sampled
from ..validity.model_form import one_way_error
from ..validity.solution import of_motion, of_shear
from .resolved import Resolved, resolved_result

NOT_KNOWN = "not estimated for the one-way closure: one patch, as it is"


def one_way_answer(prepared: Prepared, speed: float, start: FrictionResult | None, begun: float) -> FrictionResult:
    """Solve ``prepared`` at ``speed`` [m/s], which is not 0. ``start``: the result of a neighbouring speed;
    ``begun``: when, by `time.perf_counter`."""
    scene = prepared.scene
    found = one_way_point(scene, prepared.surface, speed, () if start is None else start.one_way)
    one, error = found[-1], estimate([one.coefficient for one in found])
    uncertainty = replace(
        not_sampled(error, scene, prepared.surface.size[1], NOT_KNOWN),
        model_form=one_way_error(one.contact_load / (one.contact_load + one.film_load)),
    )
    result = resolved_result(prepared, speed, _numbers(prepared, speed, one, error), begun)
    return replace(result, one_way=found, uncertainty=uncertainty, errors=field_errors_of({}, NOT_KNOWN))


def _numbers(prepared: Prepared, speed: float, one: OneWay, error: float | None) -> Resolved:
    """The numbers of ``one``. ``error``: the estimated relative error of f by the grid."""
    bodies = prepared.scene.bodies
    strip, central = np.abs(one.x) <= bodies.half_width, float(np.interp(0.0, one.x, one.gap.mean(axis=1)))
    hardness = math.inf if bodies.hardness is None else bodies.hardness
    force = abs(one.coefficient) * (one.contact_load + one.film_load)
    estimated = "" if error is None else f", estimated error {100 * error:.2g} % of f"
    return Resolved(
        film="one-way",
        contact="semi-periodic",
        film_words=f"in the contact's own gap, of constant density, on {one.gap.shape[0]} x {one.gap.shape[1]} cells"
        + estimated,
        notes=one.report.notes,
        coefficient=one.coefficient,
        contact_load=one.contact_load,
        film_load=one.film_load,
        boundary=one.boundary,
        couette=one.couette,
        rolling=one.rolling,
        contact_fraction=float(one.closed[strip].mean()),
        contact_area=float(one.closed.mean(axis=1).sum()) * (one.x[1] - one.x[0]) * prepared.surface.size[1],
        plastic_fraction=float((one.contact_pressure[strip] >= hardness).mean()),
        min_gap=float(one.gap[~one.closed].min()),
        central_gap=central,
        mean_gap=float(one.gap[strip].mean()),
        load_residual=(one.contact_load + one.film_load) * bodies.width / bodies.load - 1,
        report=one.report,
        entries=(
            *prepared.known,
            *of_motion(prepared.scene, speed, central),
            *of_shear(prepared.scene, ShearForce(one.couette, one.rolling), one.film_load, force),
        ),
    )
