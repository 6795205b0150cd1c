"""`study`: carry out a plan on any executor, and save it point by point."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import replace

from .._base import FolderLock, clear_parts, validate, write_whole
from ..errors import InputError
from ..scene import Scene
from .journal import POINTS, Journal
from .plan import StudyPlan, plan_study
from .records import growth
from .result import PLAN, StudyResult, plan_as_dict
from .spread import checked_executor, spread
from .table_row import row_of
from .trail import points_of
from .walk import Batch


def study(
    scene: Scene | StudyPlan, vary=None, speeds=None, *, executor=None, store=None, on_progress=None
) -> StudyResult:
    """Friction of a scene at every combination of given values, and at every entrainment speed.

    A point that fails is a row with its error as its status; the others are solved.

    Parameters
    ----------
    scene : from `lubfric.load_scene`; or a plan from `lubfric.plan_study`, whose ``explain()`` says points, cost and
        disk
    vary : {"section.key": [values]}, any key of a scene; {("section.key", "other.key"): [(value, value), ...]} for keys
        that change together (`lubfric.sample` makes random and Sobol samples of them); {"surface": [{...}, {...}]} for
        whole sections, such as several height maps
    speeds : entrainment speeds [m/s]; None: those of the scene; "auto": each curve chooses its own, as in
        `lubfric.stribeck`, and the result has a dimension "point" instead of "speed"
    executor : None, or any `concurrent.futures.Executor` (process pool, ``dask.distributed.Client.get_executor()``,
        ``mpi4py.futures.MPIPoolExecutor``). The plan fixes what starts from what, so all give the same bits
    store : folder that receives every finished point at once. The same study goes on from there and computes nothing
        twice. On a cluster all processes must see it
    on_progress : called as on_progress(done, total) when points (with "auto": curves) have ended

    Returns
    -------
    StudyResult

    Raises
    ------
    InputError : before any work

    Faults of the program are raised as they are, at the end.
    """
    plan = scene if isinstance(scene, StudyPlan) else plan_study(scene, vary, speeds)
    if plan is scene and (vary is not None or speeds is not None):
        raise InputError("vary and speeds belong to the plan; give a scene with them, or a plan alone")
    executor = checked_executor(executor)
    with ExitStack() as stack:
        if store is not None:
            store = validate.folder("store", store)
            stack.enter_context(FolderLock(store))
            clear_parts(store)
            write_whole(os.path.join(store, PLAN), json.dumps(plan_as_dict(plan), indent=1).encode())
        return _carried_out(plan, executor, store, on_progress)


def _carried_out(plan: StudyPlan, executor, store, on_progress) -> StudyResult:
    folder = None if store is None else os.path.abspath(store)
    journal = Journal(folder)
    records = journal.records()
    rows = {key: row_of(record) for key, record in records.items()}
    keys = set(plan.keys().flat)
    left, total = keys - rows.keys(), len(keys)
    batches = [replace(batch, folder=folder).with_known(records) for batch in plan.batches]
    batches = [batch for batch in batches if not all(walk.ended(rows) for walk in batch.walks)]

    progress = Progress(on_progress, total)

    def tell(found: dict[str, dict]) -> None:
        rows.update(found)
        left.difference_update(found)
        progress.tell(total - len(left))

    def again(batch: Batch) -> Batch:
        found = journal.records()  # what the lost worker had finished is known
        tell({key: row_of(record) for key, record in found.items()})
        return batch.with_known(found)

    progress.tell(total - len(left))
    look: Callable | None = None
    if on_progress and folder is not None and plan.speeds:  # a batch of many points comes back only when it ends
        begun, added = total - len(left), growth(os.path.join(folder, POINTS))

        def look() -> None:
            progress.tell(min(begun + added(), total - 1))

    for key, row in spread(executor, rows_of, batches, again, look):
        tell({key: row})
    for batch in batches:  # only now: an executor that loses the rows of a batch hands it out again
        journal.finish(batch.name)
    return StudyResult.of_rows(plan_as_dict(plan), rows)


class Progress:
    """Calls ``on_progress`` (None: nobody listens) with the number of finished points whenever it has grown."""

    def __init__(self, on_progress, total: int):
        self._on_progress, self._total, self._told = on_progress, total, -1

    def tell(self, done: int) -> None:
        """``done`` points are finished, as far as the caller knows."""
        if self._on_progress and done > self._told:
            self._told = done
            self._on_progress(done, self._total)


def rows_of(batch: Batch) -> Iterator[tuple[str, dict]]:
    """Solve what is left of a batch. Yields (key, row) of its points."""
    for point in points_of(batch):
        yield point.key, row_of(point.record)
