"""Stribeck curves: friction over speed. Each speed starts from its neighbour, and a failing point costs no other."""

from __future__ import annotations

import numpy as np

from .._base import validate
from ..errors import InputError
from ..sampling import FrictionResult
from ..scene import FASTEST, Scene
from ..sharing import Prepared, at_tolerance, scene_of
from .adaptive import AUTO
from .fingerprint import fingerprint
from .span import film_ratio
from .spread import checked_executor
from .sweep_auto import auto_curve, fields_at
from .sweep_points import judged
from .sweep_result import StribeckResult, collected
from .sweep_share import solve_walks
from .walk import MOST, Walk

MIXED = 1.3  # Moes' film of the whole load over Sq of the speed that comes first


def stribeck(
    scene: Scene | Prepared,
    speeds=None,
    executor=None,
    *,
    tolerance: float | None = None,
    model: str | None = None,
    fields=False,
    store=None,
    on_point=None,
    raise_on_failure: bool = True,
) -> StribeckResult:
    """The Stribeck curve of a scene: friction over the entrainment speed.

    One speed of mixed lubrication comes first, then the slower and the faster ones, each started from its neighbour.
    An ``executor`` solves both sides at once, to the same bits. A point that fails leaves NaN, and its exception in
    ``errors``. A fault of the program is raised as it is, with the points so far as its ``result``.

    Parameters
    ----------
    scene : from `lubfric.load_scene` or `lubfric.prepare`
    speeds : entrainment speeds [m/s], (n,); None: the scene's own; "auto": at most 25, so that ``curve.at(speed)`` is
        within the tolerance on f everywhere between, and ``curve.lift_off`` is enclosed. On a line of the surface that
        is the root sum of squares of the tolerance and the sampling tolerance
    executor : any `concurrent.futures.Executor`, for runs of neighbouring speeds
    tolerance, model, fields : as in `lubfric.friction`; or fields: the speeds [m/s] whose film and contact are kept
    store : a folder that receives every point as it ends. The same call goes on from there, to the same bits
    on_point : called as on_point(done, total, speed, outcome), with a result or an exception, as points end
    raise_on_failure : False returns a curve with failed points

    Returns a `StribeckResult`. Raises `InputError`, and, with the curve, `ConvergenceError` or `ValidityError`.
    """
    executor = checked_executor(executor)
    if isinstance(speeds, str) and speeds == AUTO:
        found = auto_curve(at_tolerance(scene, tolerance, model), fields, store, on_point)
        return judged(found, raise_on_failure)
    speeds = _given(speeds, scene_of(scene).motion)
    prepared = at_tolerance(scene, tolerance, model)
    kept = _kept(fields, speeds)
    points: list[FrictionResult | None] = [None] * speeds.size
    errors: dict[int, Exception] = {}

    def keep(index, outcome):
        if isinstance(outcome, Exception):
            errors[index] = outcome
        else:
            points[index] = outcome
        if on_point:
            on_point(len(errors) + sum(p is not None for p in points), speeds.size, float(speeds[index]), outcome)

    try:
        solve_walks(prepared, _walks(prepared, speeds, kept), executor, store, keep)
    except BaseException as fault:
        fault.result = collected(speeds, points, errors)  # type: ignore[attr-defined]  # beside what it holds
        raise
    return judged(collected(speeds, points, errors), raise_on_failure)


def _given(speeds, motion) -> np.ndarray:
    """The speeds [m/s] that were asked for, one or many, or those of the scene."""
    if speeds is None:
        speeds = motion.speeds or (motion.entrainment_speed,)
    return validate.numbers("speeds", speeds, "m/s", FASTEST)


def _kept(fields, speeds: np.ndarray) -> np.ndarray:
    """Those of the ``speeds`` whose film and contact are kept."""
    kept = speeds if fields is True else fields_at(fields)
    if not np.isin(kept, speeds).all():
        raise InputError(
            f"fields = {fields!r} m/s are not all among the speeds of the curve; give some of them, or fields = True"
        )
    return kept


def _walks(prepared: Prepared, speeds, kept) -> list[tuple[Walk, np.ndarray]]:
    """The walk of the one speed that comes first, then those that start from it, each with the indices of its speeds.

    They go from the first speed to either side, at most 25 speeds each.
    """
    order = np.argsort(-np.abs(speeds), kind="stable")
    middle = _middle(prepared.scene, prepared.surface.sq, np.abs(speeds[order]))
    wanted = frozenset(float(u) for u in kept)

    def walk(run: np.ndarray, name: str) -> Walk:
        return Walk(prepared.scene, name, tuple(float(u) for u in speeds[run]), wanted)

    run = order[middle : middle + 1]
    first = walk(run, fingerprint(prepared))
    sides = [side for side in (order[:middle][::-1], order[middle + 1 :]) if side.size]
    runs = [run for side in sides for run in np.array_split(side, -(-side.size // MOST))]
    return [(first, run), *((walk(run, first.keys[0]), run) for run in runs)]


def _middle(scene: Scene, sq: float, speeds: np.ndarray) -> int:
    """Number of the speed that is solved first, counted from the fastest down.

    It is where Moes' film under the whole load is about 1.3 Sq. There the contact carries half of the load, and the
    points on both sides cost the same. For a smooth surface, and for the models that resolve the gap, the fastest speed
    comes first, because it is the easiest.
    """
    numerics, moving = scene.numerics, np.flatnonzero(speeds)
    if sq <= 0 or numerics.model == "deterministic" or numerics.closure == "one-way" or not moving.size:
        return 0
    ratios = np.array([film_ratio(scene, sq, float(u)) for u in speeds[moving]])
    return int(np.abs(np.log(ratios / MIXED)).argmin())
