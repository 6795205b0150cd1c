"""The friction coefficient of one operating point: scene -> film -> contact -> balance -> friction."""

from __future__ import annotations

import math
import time

import numpy as np

from .._base import validate
from ..errors import InputError
from ..scene import FASTEST, Scene, told_doubts
from ..sharing import Prepared, at_tolerance, refused
from .answer import load_sharing_answer
from .answer_deterministic import deterministic_answer
from .methods import with_methods
from .result import FrictionResult


def friction(
    scene: Scene | Prepared,
    speed: float | None = None,
    *,
    start: object = None,
    tolerance: float | None = None,
    model: str | None = None,
    fields: bool = False,
    raise_on_failure: bool = True,
) -> FrictionResult:
    """Friction coefficient of a scene at one entrainment speed.

    Film and rough contact share the load. Two balances hold together: F_T = F_C + F_H, and the lubricant volume of Eq.
    (8) (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z). Without entrainment the contact carries the whole load.
    When the film clears the summits, no contact is solved. The solve stops when ``|gap - film|/(gap + film)``, of means
    over A, is <= ``numerics.tolerances.balance`` divided by the share of the film in f.

    Parameters
    ----------
    scene : from `lubfric.load_scene`, or from `lubfric.prepare` for many speeds
    speed : entrainment speed U [m/s]; None: the scene's own
    tolerance : relative, on f; None: ``numerics.tolerance``. Nothing is modelled that it does not need (docs/levels.md)
    model : "load-sharing", or "deterministic": one gap and one pressure; None: the scene's
    fields : True: ``result.balance`` has film and contact on the cells of the map (on strips: on theirs)
    raise_on_failure : False: return a result even if unbalanced or refused. A failed film or contact still raises

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
    if start is not None:
        raise InputError(
            "start is not taken any more: every point is solved from its scene and speed alone; leave it out"
        )
    validate.instance("fields", fields, (bool, np.bool_), "True or False")
    numerics = prepared.scene.numerics
    with told_doubts(prepared.scene):
        if numerics.model == "deterministic" and speed != 0:
            result = deterministic_answer(prepared, speed, begun)
        else:
            result = load_sharing_answer(prepared, speed, fields, begun)
    result = with_methods(prepared, result)
    if not math.isfinite(result.coefficient):
        raise InputError(
            f"f = {result.coefficient} at a speed of {speed:g} m/s: numbers overflow; give speeds, viscosities and "
            "stresses of a lubricated contact"
        )
    if raise_on_failure:
        result.report.raise_if_failed(result)
        refused(result.validity, numerics.accept, result)
    return result
