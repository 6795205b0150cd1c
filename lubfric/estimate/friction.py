"""The friction coefficient of one operating point: scene -> sample -> model -> estimate -> result."""

import time

import numpy as np

from .._base import limited_work, releasing_memory, validate, with_default_errors, work_left
from .._base.jobs import current_executor, parts_on
from .._base.processes import MOST_WORKERS, pool
from ..models import Model, prepared_with, with_boundary_friction_at
from ..models.shared import Prepared, refused
from ..scene import FASTEST, Scene, hint_unusual_values
from .build_result import result_of
from .choice import choose, work_for_an_answer
from .result import FrictionResult
from .work_of_point import estimated_work_of_point

# Times the estimate of a point: the counted work that it may take where numerics.max_work does not say. A convention,
# not measured: estimates are right within a factor of about 3.
TIMES_ESTIMATE = 10.0

# Least counted work [s] that a point may take where numerics.max_work does not say. A choice: the estimate of a short
# point may be far off.
LEAST_LIMIT = 120.0


@releasing_memory
@with_default_errors
def friction(
    scene: Scene | Prepared,
    speed: float | None = None,
    *,
    tolerance: float | None = None,
    model: str | Model | None = None,
    fields: bool | str = False,
    raise_on_failure: bool = True,
    workers: int = 1,
) -> FrictionResult:
    """Return the friction coefficient of a scene at one entrainment speed, with its uncertainty.

    Strips of the rough surface represent the infinite line contact. More strips are solved until the sampling error is
    within its tolerance. In the load-sharing model (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z) film and rough
    contact share the load by Eq. (8). The deterministic model solves the film between the rough surfaces, on short
    cells, or on long cells with a calibrated error. By default the cheapest model answers whose model-form error is
    within ``numerics.model_tolerance`` (docs/models.md). Without entrainment the contact carries the total load. Where
    the film is thicker than the highest asperities, no contact is solved.

    Parameters
    ----------
    scene : from `lubfric.load_scene`, or from `lubfric.prepare` for many speeds
    speed : entrainment speed U [m/s]; None: the scene's own
    tolerance : relative, of f; None: ``numerics.tolerance``. Grids and cells follow from it (docs/tolerances.md)
    model : "paper", Eqs. (8) and (9); "quick", the deterministic model on long cells with a calibrated error;
        "deterministic"; or "auto": the cheapest that is good enough; None: the scene's. Or a `lubfric.models.Model` of
        your own
    fields : cells of ``result.fields``. False: those that the tolerance requires; True: native cells, if one patch is
        solved by load sharing, else as False; "fine": a part of the surface is solved again, with some 40 cells across
        the Hertz strip, or with native ones where these are longer; moving roughness has the cells of its solve
    raise_on_failure : False: return a result even if unbalanced or refused. A failed film or contact still raises
    workers : processes that solve strips of the surface and ends of input ranges in parallel, where there are several.
        The numbers do not depend on it. A script that requests more than one needs ``if __name__ == "__main__":``

    Returns a `FrictionResult`.

    Raises
    ------
    InputError : before the solve; after it only where numbers overflow, so that f is not finite
    ConvergenceError : a part did not converge; carries report and result
    ValidityError : f has no meaning, because an assumption fails, and ``numerics.accept`` is false; carries the result
    """
    begun = time.perf_counter()
    prepared = prepared_with(scene, tolerance, None if isinstance(model, Model) else model)
    speed = prepared.scene.motion.entrainment_speed if speed is None else speed
    speed = validate.number("speed", speed, "m/s", minimum=-FASTEST, maximum=FASTEST)
    prepared = with_boundary_friction_at(prepared, speed)
    with_fine_fields = isinstance(fields, str) and fields == "fine"
    if not with_fine_fields:
        validate.instance("fields", fields, (bool, np.bool_), "True, False or 'fine'")
    workers = validate.integer("workers", workers, minimum=1, maximum=MOST_WORKERS)
    numerics = prepared.scene.numerics
    limit = most_work(prepared, speed)
    with hint_unusual_values(prepared.scene), pool(workers) as executor, parts_on(executor or current_executor()):
        with limited_work(limit):
            requested = model if isinstance(model, Model) else numerics.model
            choice = choose(prepared, speed, requested, for_fields=bool(fields))
            with limited_work(work_for_an_answer() if choice.gave_up else work_left()):
                result = result_of(prepared, speed, choice, begun, with_fine_fields=with_fine_fields)
    if raise_on_failure:
        result.report.raise_if_failed(result)
        refused(result.validity, accept=numerics.accept, result=result)
    return result


def most_work(prepared: Prepared, speed: float) -> float:
    """Return the counted work [s] that a point may take: ``numerics.max_work``, or `most_work_of_estimate`."""
    scene = prepared.scene
    if scene.numerics.max_work is not None:
        return scene.numerics.max_work
    return most_work_of_estimate(estimated_work_of_point(scene, prepared.sample, prepared.surface, speed).seconds)


def most_work_of_estimate(seconds: float) -> float:
    """Return the counted work [s] that a solve of estimated ``seconds`` may take without ``numerics.max_work``:
    `TIMES_ESTIMATE` the estimate, at least `LEAST_LIMIT`."""
    return max(LEAST_LIMIT, TIMES_ESTIMATE * seconds)
