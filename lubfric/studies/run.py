"""`study`: carry out a plan on any executor, and keep it point by point."""

from __future__ import annotations

import json
import os
from contextlib import ExitStack
from dataclasses import dataclass, field

from ..errors import InputError, LubfricError
from ..prepared import prepare
from ..scene import Scene
from ..store import FolderLock, write_whole
from ..store.whole import clear_parts
from .adaptive import curve_key, run_adaptive, search_of
from .chain import Chain, run_chain
from .journal import PLACE, Journal, record_of
from .plan import Batch, Curve, StudyPlan, plan_study
from .result import PLAN, StudyResult, plan_as_dict
from .spread import checked_executor, spread
from .table_row import AT, COUNT, CURVE, SPEED, named, row_of


@dataclass(frozen=True)
class Piece:
    """A batch as it is handed out.

    ``folder``: of the store, or None; ``done``: how many points of each chain are finished, by its name, and 1 by the
    name of a curve that chose its speeds and is complete; ``partly``: whether the store holds points of such a curve
    that is not complete.
    """

    batch: Batch
    folder: str | None
    done: dict[str, int] = field(default_factory=dict)
    partly: bool = False

    @property
    def name(self) -> str:
        """Name of its mark in a journal."""
        return self.batch.curves[0].name

    def left(self, chain: Chain) -> bool:
        """Whether points of ``chain`` remain to be solved."""
        return self.done.get(chain.name, 0) < len(chain.keys)

    def open(self, curve: Curve) -> bool:
        """Whether points of ``curve`` remain to be solved."""
        return any(self.left(chain) for chain in curve.chains) if curve.chains else not self.done.get(curve.name)


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
        ``mpi4py.futures.MPIPoolExecutor``). The plan fixes the chains of warm starts, so all give the same bits
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
        raise InputError("vary and speeds belong to the plan; allowed: a scene with them, or a plan alone")
    executor = checked_executor(executor)
    with ExitStack() as stack:
        if store is not None:
            stack.enter_context(FolderLock(store))
            clear_parts(store)
            write_whole(os.path.join(store, PLAN), json.dumps(plan_as_dict(plan), indent=1).encode())
        return _carried_out(plan, executor, store, on_progress)


def _carried_out(plan: StudyPlan, executor, store, on_progress) -> StudyResult:
    folder = None if store is None else os.path.abspath(store)
    known = _rows(folder)
    pieces = [_piece(batch, folder, known) for batch in plan.batches]
    pieces = [piece for piece in pieces if any(piece.open(curve) for curve in piece.batch.curves)]
    keys = set(plan.keys().flat)
    done = len(keys & known.keys())

    def again(piece: Piece) -> Piece:
        known.update(_rows(folder))  # what the lost worker had finished
        return _piece(piece.batch, folder, known)

    if on_progress:
        on_progress(done, len(keys))
    for rows in spread(executor, run_piece, pieces, again):
        done += len(keys & (rows.keys() - known.keys()))
        known.update(rows)
        if on_progress:
            on_progress(done, len(keys))
    for piece in pieces:  # only now: an executor that loses the rows of a piece hands it out again
        Journal(folder).finish(piece.name)
    return StudyResult.of_rows(plan_as_dict(plan), known)


def _rows(folder) -> dict[str, dict]:
    return named({key: row_of(record) for key, record in Journal(folder).records().items()})


def _piece(batch: Batch, folder, known) -> Piece:
    done = {}
    for chain in _chains(batch):
        count = 0
        while count < len(chain.keys) and chain.keys[count] in known:
            count += 1
        done[chain.name] = count
    chosen = [curve for curve in batch.curves if not curve.chains]
    done |= {curve.name: 1 for curve in chosen if curve_key(curve.whole) in known}
    partly = any(f"{curve_key(curve.whole)} 0" in known for curve in chosen if curve.name not in done)
    return Piece(batch, folder, done, partly)


def _chains(batch: Batch):
    return [chain for curve in batch.curves for chain in curve.chains]


def run_piece(piece: Piece) -> dict[str, dict]:
    """Solve what is left of a piece. Returns its new rows by key; each point is in the store first, where there is
    one."""
    rows: dict[str, dict] = {}
    leader = None
    with Journal(piece.folder) as journal:
        if journal.begin(piece.name):  # by a worker that is gone: what it finished is taken over
            rows = _rows(piece.folder)
            piece = _piece(piece.batch, piece.folder, rows)
        for curve in piece.batch.curves:
            if not piece.open(curve):
                continue
            try:
                leader = leader or prepare(piece.batch.leader)
                prepared = leader if curve.scene == piece.batch.leader else prepare(curve.scene, like=leader)
                search = None if curve.chains else search_of(prepared, curve.whole)
            except LubfricError as error:
                rows |= _all_failed(curve, error, journal, piece)
                continue
            if search is not None:
                rows |= _chosen(prepared, search, journal, journal.records() if piece.partly else {})
            for chain in (chain for chain in curve.chains if piece.left(chain)):
                for index, outcome in run_chain(prepared, chain, journal, piece.done.get(chain.name, 0)):
                    rows[chain.keys[index]] = row_of(record_of(outcome))
    return rows


def _chosen(prepared, search, journal, known) -> dict[str, dict]:
    """The rows of a curve that chooses its speeds, and the row that says that it is complete. ``known``: its records
    so far."""
    rows, key = {}, curve_key(search.name)
    for at, (speed, outcome) in enumerate(run_adaptive(prepared, search, journal, known)):
        place = {CURVE: key, AT: at, SPEED: speed}
        rows[f"{key} {at}"] = row_of(record_of(outcome) | {PLACE: place})
    return rows | {key: _ended(key, len(rows), journal)}


def _ended(key: str, points: int, journal) -> dict:
    record = {PLACE: {CURVE: key, COUNT: points}}
    journal.add(key, record)
    return row_of(record)


def _all_failed(curve: Curve, error: LubfricError, journal, piece: Piece) -> dict[str, dict]:
    """The rows of a curve that cannot be begun. There is only one row where the curve would have chosen its speeds."""
    record = record_of(error)
    keys = [key for chain in curve.chains for key in chain.keys[piece.done.get(chain.name, 0) :]]
    if not curve.chains:
        end = curve_key(curve.whole)
        keys, record = [f"{end} 0"], record | {PLACE: {CURVE: end, AT: 0, SPEED: None}}
    for key in keys:
        journal.add(key, record)
    rows = dict.fromkeys(keys, row_of(record))
    return rows if curve.chains else rows | {end: _ended(end, 1, journal)}
