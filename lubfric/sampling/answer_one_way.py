"""The numbers of one-way load sharing as a `FrictionResult`."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ..deterministic import estimate
from ..film import ShearForce
from ..oil import density_ratio
from ..one_way import OneWay, one_way_point
from ..scene import Scene
from ..sharing import Decision, Prepared, Validity, of_error, of_motion, of_shear
from .answer_resolved import resolved_result
from .model_form import one_way_error
from .result import FrictionResult
from .uncertainty import field_errors_of, not_sampled

NOT_KNOWN = "not estimated for the one-way closure: one patch, as it is"


def one_way_answer(prepared: Prepared, speed: float, start: FrictionResult | None, begun: float) -> FrictionResult:
    """Solve ``prepared`` at ``speed`` [m/s], which is not 0. ``start``: the result of a neighbouring speed; ``begun``:
    the starting time, by `time.perf_counter`."""
    scene = prepared.scene
    found = one_way_point(scene, prepared.surface, speed, () if start is None else start.one_way)
    one, error = found[-1], estimate([one.coefficient for one in found])
    uncertainty = replace(
        not_sampled(error, scene, prepared.surface.size[1], NOT_KNOWN),
        model_form=one_way_error(one.contact_load / (one.contact_load + one.film_load), one.left_out),
    )
    decision = Decision(
        "one-way", "semi-periodic", scene.numerics.tolerance, film_words=_words(one, error), notes=one.report.notes
    )
    per_width, numbers = _per_width(one), _numbers(prepared, one)
    entries = (
        *prepared.known,
        *_density_left_out(scene, one),
        *of_motion(scene, speed, numbers["central_film"]),
        *of_shear(
            scene,
            ShearForce(one.couette, one.rolling),
            one.film_load,
            abs(one.coefficient) * (one.contact_load + one.film_load),
        ),
        *of_error(error, scene.numerics.tolerance, "a finer contact.spacing, a larger tolerance"),
    )
    result = resolved_result(prepared, speed, begun, decision, one.report, entries, per_width, numbers)
    return replace(result, one_way=found, uncertainty=uncertainty, errors=field_errors_of({}, NOT_KNOWN))


def _density_left_out(scene: Scene, one: OneWay) -> Iterator[Validity]:
    """A caution if the film, whose density counts as constant, would be compressed by more than the tolerance."""
    change = float(density_ratio(scene.lubricant, one.film_pressure.max())[0]) - 1
    if change > scene.numerics.tolerance:
        yield Validity(
            "compression of the film where its pressure is largest",
            change,
            scene.numerics.tolerance,
            "",
            f"lubricant.density_law = {scene.lubricant.density_law!r} is left out: in truth the film there is thinner",
            "numerics.model = 'deterministic', or closure = 'load', has the density",
        )


def _words(one: OneWay, error: float | None) -> str:
    """The film in one phrase; ``error``: the estimated relative error of f by the grid."""
    estimated = "" if error is None else f", estimated error {100 * error:.2g} % of f"
    return f"in the contact's own gap, of constant density, on {one.gap.shape[0]} x {one.gap.shape[1]} cells{estimated}"


def _per_width(one: OneWay) -> dict[str, float]:
    return {
        "contact_load": one.contact_load,
        "film_load": one.film_load,
        "boundary_force": one.boundary,
        "couette_force": one.couette,
        "rolling_force": one.rolling,
    }


def _numbers(prepared: Prepared, one: OneWay) -> dict[str, float]:
    bodies, length = prepared.scene.bodies, prepared.surface.size[1]
    strip = np.abs(one.x) <= bodies.half_width
    hardness = math.inf if bodies.hardness is None else bodies.hardness
    area = float(one.closed.mean(axis=1).sum()) * (one.x[1] - one.x[0]) * length
    return {
        "coefficient": one.coefficient,
        "real_contact_area_fraction": float(one.closed[strip].mean()),
        "real_contact_area": area * bodies.width / length,
        "plastic_area_fraction": float((one.contact_pressure[strip] >= hardness).mean()),
        "min_film": float(one.gap[~one.closed].min()),
        "central_film": float(np.interp(0.0, one.x, one.gap.mean(axis=1))),
        "mean_gap": float(one.gap[strip].mean()),
        "load_residual": (one.contact_load + one.film_load) * bodies.width / bodies.load - 1,
    }
