"""`study`: carry out a plan on any executor, and keep it point by point."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from .._base import write_whole
from ..errors import InputError
from ..scene import Scene
from .executor import checked_executor, spread
from .plan import StudyPlan, plan_study
from .points import Piece, solved
from .result import PLAN, StudyResult, plan_as_dict
from .rows import Rows, row_of, stored_rows
from .store import Store, opened

TOGETHER = 8  # speeds of a curve that a process of an executor receives at once, with one preparation of the scene


def study(
    scene: Scene | StudyPlan, vary=None, speeds=None, *, executor=None, store=None, on_progress=None
) -> StudyResult:
    """Friction of a scene at every combination of given values, and at every entrainment speed.

    Every point is solved from its scene alone, to the same bits on every executor. A point that fails is a row with
    its error as its status; the others are solved.

    Parameters
    ----------
    scene : from `lubfric.load_scene`; or a plan from `lubfric.plan_study`, whose ``explain()`` says points and cost
    vary : {"section.key": [values]}, any key of a scene; {("section.key", "other.key"): [(value, value), ...]} for keys
        that change together (`lubfric.sample` makes random and Sobol samples of them); {"surface": [{...}, {...}]} for
        whole sections, such as several height maps
    speeds : entrainment speeds [m/s]; None: those of the scene; "auto": each curve chooses its own, as in
        `lubfric.stribeck`, and the result has a dimension "point" instead of "speed"
    executor : None, or any `concurrent.futures.Executor` (process pool, ``dask.distributed.Client.get_executor()``,
        ``mpi4py.futures.MPIPoolExecutor``)
    store : folder that receives every finished point at once. The same study, or a longer one, goes on from there and
        computes nothing twice. On a cluster all processes must see it
    on_progress : called as on_progress(done, total) when points (with "auto": curves) have ended

    Returns
    -------
    StudyResult

    Raises
    ------
    InputError : before any work

    Faults of the program are raised as they are.
    """
    plan = scene if isinstance(scene, StudyPlan) else plan_study(scene, vary, speeds)
    if plan is scene and (vary is not None or speeds is not None):
        raise InputError("vary and speeds belong to the plan; give a scene with them, or a plan alone")
    executor = checked_executor(executor)
    with opened(store) as kept:
        described = plan_as_dict(plan)
        if kept.root is not None:
            write_whole(Path(kept.root) / PLAN, json.dumps(described, indent=1).encode())
        rows = _carried_out(plan, executor, kept, on_progress)
    return StudyResult.of_rows(described, rows)


def _carried_out(plan: StudyPlan, executor, store: Store, on_progress: Callable | None) -> Rows:
    rows = stored_rows(store, plan.keys, plan.speeds)
    scenes = dict(zip(plan.keys, plan.scenes))  # equal scenes once
    total = len(scenes) * max(len(plan.speeds), 1)

    def tell() -> None:
        if on_progress:
            on_progress(sum(map(len, rows.points.values())) if plan.speeds else len(rows.ended), total)

    tell()
    pieces = []
    for key, scene in scenes.items():
        left = tuple(u for u in plan.speeds if u not in rows.points[key])
        size = TOGETHER if executor is not None else max(len(left), 1)
        pieces += [Piece(scene, key, left[i : i + size], folder=store.root) for i in range(0, len(left), size)]
        if not plan.speeds and key not in rows.ended:
            rows.points[key].clear()  # they come again, from the store, in the order in which they were chosen
            pieces.append(Piece(scene, key, (), folder=store.root))
    for key, speed, outcome in spread(executor, solved, pieces):
        if outcome is None:
            rows.ended.add(key)
        else:
            rows.points[key][speed] = row_of(speed, outcome)
        if plan.speeds or outcome is None:
            tell()
    return rows
