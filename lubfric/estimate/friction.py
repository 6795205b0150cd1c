"""The friction coefficient of one operating point: scene -> film -> contact -> balance -> friction."""

import math
import time
from dataclasses import replace

import numpy as np

from .._base import limited_work, unlimited_work, validate, with_default_errors
from .._base.jobs import current_executor, parts_on
from .._base.processes import MOST_WORKERS, pool
from ..errors import ConvergenceError, InputError
from ..models.deterministic import cells_of, too_costly, too_hot
from ..models.load_sharing import (
    SampleSolution,
    sampled,
)
from ..models.shared import (
    Prepared,
    at_speed,
    at_tolerance,
    refused,
    unmodelled_effects,
)
from ..scene import FASTEST, Scene, gap_not_resolved, told_doubts
from .answer import limits_passed, load_sharing_answer
from .answer_deterministic import strips_answer
from .errors_of import model_error
from .full_load import full_load_numbers
from .methods import with_methods
from .outlook import forecast
from .power import with_power_loss
from .result import FrictionResult

# Times the estimate of a point: the counted work that it may take where numerics.max_work does not say.
TIMES_ESTIMATE = 10.0

# Least counted work [s] that a point may take where numerics.max_work does not say.
LEAST_WORK = 30.0


@with_default_errors
def friction(
    scene: Scene | Prepared,
    speed: float | None = None,
    *,
    tolerance: float | None = None,
    model: str | None = None,
    fields: bool = False,
    raise_on_failure: bool = True,
    workers: int = 1,
) -> FrictionResult:
    """Friction coefficient of a scene at one entrainment speed.

    Film and rough contact share the load. Two balances hold together: F_T = F_C + F_H, and the lubricant volume of Eq.
    (8) (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z). Without entrainment the contact carries the whole load.
    When the film clears the summits, no contact is solved. The solve stops when ``|gap - film|/(gap + film)``, of means
    over A, is <= its tolerance (`Numerics.tolerance_of`) divided by the share of the film in f. Where the error of that
    model may be more than ``numerics.model_tolerance``, strips of the surface with one gap and one pressure correct it
    or answer in its place (docs/uncertainty.md).

    Parameters
    ----------
    scene : from `lubfric.load_scene`, or from `lubfric.prepare` for many speeds
    speed : entrainment speed U [m/s]; None: the scene's own
    tolerance : relative, on f; None: ``numerics.tolerance``. Nothing is modelled that it does not need (docs/levels.md)
    model : "load-sharing"; "deterministic": one gap and one pressure; "auto"; None: the scene's
    fields : True: ``result.balance`` has film and contact on the cells of the map (on strips: on theirs)
    raise_on_failure : False: return a result even if unbalanced or refused. A failed film or contact still raises
    workers : processes that solve strips of the surface and ends of input ranges side by side, where there are several.
        The numbers do not depend on it. A script that asks for more than one needs ``if __name__ == "__main__":``

    Returns a `FrictionResult`.

    Raises
    ------
    InputError : before any work
    ConvergenceError : a part did not converge; carries report and result
    ValidityError : f means nothing, because an assumption fails, and ``numerics.accept`` is false; carries the result
    """
    begun = time.perf_counter()
    prepared = at_tolerance(scene, tolerance, model)
    speed = prepared.scene.motion.entrainment_speed if speed is None else speed
    speed = validate.number("speed", speed, "m/s", minimum=-FASTEST, maximum=FASTEST)
    prepared = at_speed(prepared, speed)
    validate.instance("fields", fields, (bool, np.bool_), "True or False")
    workers = validate.integer("workers", workers, minimum=1, maximum=MOST_WORKERS)
    numerics = prepared.scene.numerics
    limit = most_work(prepared, speed)
    with told_doubts(prepared.scene), pool(workers) as executor, parts_on(executor or current_executor()):
        with limited_work(limit):
            answer = _answer(prepared, speed, fields, begun)
        result = with_methods(prepared, answer)
    if not math.isfinite(result.coefficient):
        raise InputError(
            f"f = {result.coefficient} at a speed of {speed:g} m/s: numbers overflow; give speeds, viscosities and "
            "stresses of a lubricated contact"
        )
    known = result.boundary_force / prepared.scene.bodies.load, result.coefficient
    result = with_power_loss(prepared.scene, result)
    film = full_load_numbers(prepared.scene, speed, prepared.surface.sq, result.inlet_film_factor)
    result = replace(result, full_load_film=film["full_load_film"], lambda_ratio=film["lambda_ratio"])
    result = replace(result, unmodelled_effects=unmodelled_effects(prepared.scene, prepared.surface.sq, speed, known))
    if raise_on_failure:
        result.report.raise_if_failed(result)
        refused(result.validity, numerics.accept, result)
    return result


def _answer(prepared: Prepared, speed: float, fields: bool, begun: float) -> FrictionResult:
    """By the cheapest model that is good enough: Eq. (8), without entrainment, where its own error is within
    ``numerics.model_tolerance``, and where the deterministic model has no answer; that model otherwise."""
    scene = prepared.scene
    sample = prepared.sample
    asked = scene.numerics.model
    if asked == "load-sharing" or speed == 0 or not sample.is_resolved or prepared.surface.sq == 0:
        return load_sharing_answer(sampled(prepared, speed, own_cells=fields), prepared, speed, begun)
    if asked == "deterministic" and sample.is_single_patch:
        return strips_answer(prepared, speed, None, begun)
    found = sampled(prepared, speed, own_cells=fields)
    if asked == "auto":
        why = _enough(prepared, found) or too_costly(prepared, speed, cells_of(scene, sample))
        if why or any(entry.severe for entry in limits_passed(found, prepared, speed)):
            return load_sharing_answer(found, prepared, speed, begun, why)
    try:
        return strips_answer(prepared, speed, found, begun)
    except ConvergenceError as error:
        if asked == "deterministic":
            raise
        with unlimited_work():
            return load_sharing_answer(
                found, prepared, speed, begun, f"the deterministic model was not solved ({error})"
            )


def most_work(prepared: Prepared, speed: float) -> float:
    """Return the counted work [s] that a point may take: ``numerics.max_work``, or `TIMES_ESTIMATE` the estimate."""
    scene = prepared.scene
    if scene.numerics.max_work is not None:
        return scene.numerics.max_work
    return max(LEAST_WORK, TIMES_ESTIMATE * forecast(scene, prepared.sample, prepared.surface, speed).seconds)


def _enough(prepared: Prepared, found: SampleSolution) -> str:
    """Why Eq. (8) alone answers, in words; "" if it does not."""
    scene = prepared.scene
    balance = found.balance
    why = gap_not_resolved(scene, prepared.given)
    if why:
        return f"Eq. (8) alone: {why}"
    if why := too_hot(balance.forces.heat):
        return f"Eq. (8) alone: {why}"
    if found.response is None and max(model_error(scene, found)[0]) <= scene.numerics.model_tolerance:
        return "Eq. (8) alone: the film is so thick that the roughness hardly matters"
    return ""
