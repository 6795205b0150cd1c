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
    """Friction coefficient of ``scene`` at an entrainment speed [m/s] (default: the scene's own).

    The film and the rough contact share the load so that F_T = F_C + F_H and the lubricant volume
    of Eq. (8) hold together (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z). Without
    entrainment the contact carries everything; when the film clears the summits no contact is solved.

    ``tolerance``: on the coefficient, relative, instead of ``numerics.tolerance``. No more is modelled than it needs
    (docs/levels.md, ``result.decision``); ``model="full"``: everything, on the scene's own grid; ``"deterministic"``:
    no load is shared, one pressure carries it (docs/deterministic.md).
    ``start``: the result of a neighbouring speed of the same map, for a warm start.
    ``fields``: film and contact in ``result.balance`` are wanted on the scene's own contact grid, where one patch is
    solved; on a long line they are those of the line, on its cells.
    Stops when |mean gap - mean film|/(mean gap + mean film) over A <= numerics.tolerances.balance, divided by the share
    of the film in f. Raises `InputError` before any work, `ConvergenceError` with report and result when a part does
    not converge, `ValidityError` with the result where an assumption fails so badly that f means nothing and
    ``numerics.accept`` is false (``raise_on_failure=False`` returns either result, but a failed film or contact always
    raises).
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
