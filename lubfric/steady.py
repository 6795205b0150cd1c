"""The friction coefficient of one operating point: scene -> film -> contact -> balance -> friction."""

from __future__ import annotations

import math
import time

from . import validate
from .answer.deterministic import deterministic_answer
from .answer.load_sharing import load_sharing_answer
from .answer.one_way import one_way_answer
from .errors import InputError
from .plausible import told_doubts
from .prepared import Prepared, at_tolerance
from .result import FrictionResult
from .scene import FASTEST, Scene
from .validity.entry import refused


def friction(
    scene: Scene | Prepared,
    speed: float | None = None,
    *,
    start: FrictionResult | None = None,
    tolerance: float | None = None,
    model: str | None = None,
    fields: bool = False,
    raise_on_failure: bool = True,
) -> FrictionResult:
    """Friction coefficient of a scene at one entrainment speed.

    Film and rough contact share the load. Two balances hold together: F_T = F_C + F_H, and the lubricant volume of
    Eq. (8) (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z). Without entrainment the contact carries everything.
    When the film clears the summits, no contact is solved.

    Parameters
    ----------
    scene : from `lubfric.load_scene`, or from `lubfric.prepare` for many speeds
    speed : entrainment speed U [m/s]; None: the scene's own
    start : the result of a neighbouring speed of the same map, for a warm start
    tolerance : relative, on the coefficient; None: ``numerics.tolerance``. No more is modelled than it needs
        (docs/levels.md, ``result.decision``)
    model : "full": everything, on the scene's own grid; "deterministic": no load is shared, there is one gap and one
        pressure (docs/deterministic.md); None: ``numerics.model``
    fields : True: film and contact in ``result.balance`` are wanted on the scene's own contact grid, where one patch is
        solved. On a long line they are those of the line, on its cells
    raise_on_failure : False returns the result also where the balance did not close or the result is refused. A film or
        contact that failed always raises

    Returns
    -------
    FrictionResult

    Raises
    ------
    InputError : before any work
    ConvergenceError : a part did not converge; carries report and result
    ValidityError : an assumption fails so badly that f means nothing, and ``numerics.accept`` is false; carries the
        result

    Notes
    -----
    The balance stops when ``|mean gap - mean film|/(mean gap + mean film) <= numerics.tolerances.balance``, divided by
    the share of the film in f. The means are over the area A.
    """
    begun = time.perf_counter()
    prepared = at_tolerance(scene, tolerance, model)
    if speed is None:
        speed = prepared.scene.motion.entrainment_speed
    speed = validate.number("speed", speed, "m/s", minimum=-FASTEST, maximum=FASTEST)
    if start is not None:
        validate.instance("start", start, FrictionResult, "what lubfric.friction returned, or None")
    numerics = prepared.scene.numerics
    with told_doubts(prepared.scene):
        if numerics.model == "deterministic" and speed != 0:
            result = deterministic_answer(prepared, speed, start, begun)
        elif numerics.closure == "one-way" and speed != 0:
            result = one_way_answer(prepared, speed, start, begun)
        else:
            result = load_sharing_answer(prepared, speed, start, fields, begun)
    if not math.isfinite(result.coefficient):
        raise InputError(
            f"f = {result.coefficient} at a speed of {speed:g} m/s: numbers overflow; allowed: speeds, "
            "viscosities and stresses "
            "of a lubricated contact"
        )
    if raise_on_failure:
        result.report.raise_if_failed(result)
        refused(result.validity, numerics.accept, result)
    return result
