"""The friction coefficient of one operating point: scene -> film -> contact -> balance -> friction."""

import math
import time
from dataclasses import replace
from typing import cast

import numpy as np

from .._base import limited_work, releasing_memory, unlimited_work, validate, with_default_errors
from .._base.jobs import current_executor, parts_on
from .._base.processes import MOST_WORKERS, pool
from ..errors import ConvergenceError, InputError
from ..models import DeterministicModel, Model, PaperModel
from ..models.load_sharing import LoadSharingModel, LoadSharingSolution, PaperSolution, least_half_width
from ..models.shared import Prepared, at_speed, at_tolerance, refused, unmodelled_effects
from ..scene import BY_LOAD_SHARING, FASTEST, Scene, gap_not_resolved, warn_unusual_values
from .answer import result_of
from .full_load import full_load_numbers
from .methods import with_methods
from .outlook import forecast
from .power import with_power_loss
from .result import FrictionResult
from .sampled import sampled

LOAD_SHARING = LoadSharingModel()
MODELS = (PaperModel(), DeterministicModel())  # the cheapest first

# Times the estimate of a point: the counted work that it may take where numerics.max_work does not say.
TIMES_ESTIMATE = 10.0

# Least counted work [s] that a point may take where numerics.max_work does not say.
LEAST_WORK = 120.0


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
    """Friction coefficient of a scene at one entrainment speed.

    Film and rough contact share the load. Two balances hold together: F_T = F_C + F_H, and the lubricant volume of Eq.
    (8) (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z). Without entrainment the contact carries the whole load.
    When the film clears the summits, no contact is solved. The solve stops when ``|gap - film|/(gap + film)``, of means
    over A, is <= its tolerance (`Numerics.tolerance_of`) divided by the share of the film in f. Where the error of that
    model may be more than ``numerics.model_tolerance``, strips of the surface by the deterministic model correct it
    or answer in its place (docs/uncertainty.md).

    Parameters
    ----------
    scene : from `lubfric.load_scene`, or from `lubfric.prepare` for many speeds
    speed : entrainment speed U [m/s]; None: the scene's own
    tolerance : relative, on f; None: ``numerics.tolerance``. Nothing is modelled that it does not need (docs/levels.md)
    model : "load-sharing", with a calibrated error; "paper", Eqs. (8) and (9); "deterministic"; or "auto": the cheapest
        that is good enough; None: the scene's. Or a `lubfric.models.Model` of your own
    fields : True: a single patch is solved on its own cells, so that ``result.fields`` are on them (on strips: on theirs);
        "fine": a part of the surface is solved once more, on some 40 cells across the Hertz strip, for ``result.fields``
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
    chosen = model if isinstance(model, Model) else None
    prepared = at_tolerance(scene, tolerance, None if isinstance(model, Model) else model)
    speed = prepared.scene.motion.entrainment_speed if speed is None else speed
    speed = validate.number("speed", speed, "m/s", minimum=-FASTEST, maximum=FASTEST)
    prepared = at_speed(prepared, speed)
    fine = isinstance(fields, str) and fields == "fine"
    if not fine:
        validate.instance("fields", fields, (bool, np.bool_), "True, False or 'fine'")
    workers = validate.integer("workers", workers, minimum=1, maximum=MOST_WORKERS)
    numerics = prepared.scene.numerics
    limit = most_work(prepared, speed)
    with warn_unusual_values(prepared.scene), pool(workers) as executor, parts_on(executor or current_executor()):
        with limited_work(limit):
            result = _solved(prepared, speed, chosen, native=bool(fields), fine=fine, begun=begun)
        result = with_methods(prepared, result)
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


def _solved(
    prepared: Prepared, speed: float, model: Model | None, *, native: bool, fine: bool, begun: float
) -> FrictionResult:
    """Return the result of the cheapest model that is good enough.

    Load sharing gives it without entrainment, where its own error is within ``numerics.model_tolerance``, and where the
    deterministic model has no answer; that model gives it otherwise. ``model``: takes their place.
    """
    if model is not None:
        return result_of(
            prepared, sampled(prepared, speed, model, native=native).answer(), model.name, begun, fine=fine
        )
    scene = prepared.scene
    requested = scene.numerics.model
    paper, deterministic = MODELS
    unable = deterministic.unable(prepared, speed)
    is_calibrated = not unable and not gap_not_resolved(scene, prepared.given)
    if requested in BY_LOAD_SHARING or unable:
        cheap = LOAD_SHARING if requested == LOAD_SHARING.name and is_calibrated else paper
        answer = sampled(prepared, speed, cheap, native=native).answer()
        return result_of(prepared, answer, cheap.name, begun, fine=fine)
    if requested == deterministic.name and prepared.sample.is_single_patch:  # a cheaper model has no control for it
        answer = sampled(prepared, speed, deterministic).answer()
        return result_of(prepared, answer, deterministic.name, begun, fine=fine)
    cheaper = cast(PaperSolution, sampled(prepared, speed, paper, native=native))
    if requested == "auto":
        why = cheaper.sufficient()
        if why or any(entry.severe for entry in cheaper.warnings()):
            return result_of(prepared, cheaper.answer(), paper.name, begun, fine=fine, why=why)
        if why := deterministic.declines(prepared, speed, cheaper):
            return _by_load_sharing(prepared, cheaper, is_calibrated, begun, fine=fine, why=why)
        if scene.numerics.model_tolerance >= least_half_width():
            calibrated = LoadSharingSolution(cheaper.balanced)
            if calibrated.applies and calibrated.friction.error <= scene.numerics.model_tolerance:
                why = "its error is within numerics.model_tolerance"
                return result_of(prepared, calibrated.answer(), LOAD_SHARING.name, begun, fine=fine, why=why)
    try:
        answer = sampled(prepared, speed, deterministic, control=cheaper.control()).answer()
    except ConvergenceError as error:
        if requested == deterministic.name:
            raise
        why = f"the {deterministic.name} model was not solved ({error})"
        with unlimited_work():
            return _by_load_sharing(prepared, cheaper, is_calibrated, begun, fine=fine, why=why)
    compared = None if prepared.sample.is_single_patch else (paper.name, cheaper.answer())
    return result_of(prepared, answer, deterministic.name, begun, fine=fine, cheaper=compared)


def _by_load_sharing(
    prepared: Prepared, solution: PaperSolution, is_calibrated: bool, begun: float, *, fine: bool, why: str
) -> FrictionResult:
    """Return the result of load sharing in the place of the deterministic model, for the reason ``why``."""
    if is_calibrated:
        answer = LoadSharingSolution(solution.balanced).answer()
        return result_of(prepared, answer, LOAD_SHARING.name, begun, fine=fine, why=why)
    return result_of(prepared, solution.answer(), PaperModel().name, begun, fine=fine, why=why)


def most_work(prepared: Prepared, speed: float) -> float:
    """Return the counted work [s] that a point may take: ``numerics.max_work``, or `TIMES_ESTIMATE` the estimate."""
    scene = prepared.scene
    if scene.numerics.max_work is not None:
        return scene.numerics.max_work
    return max(LEAST_WORK, TIMES_ESTIMATE * forecast(scene, prepared.sample, prepared.surface, speed).seconds)
