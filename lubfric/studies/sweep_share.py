"""The speeds of one curve, solved here or on an executor, continued from an interrupted run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from .._base import validate
from ..sharing import Prepared
from .journal import Journal, Point
from .spread import spread
from .trail import first_point, points_of
from .walk import Batch, Walk


def solve_walks(prepared: Prepared, walks: list[tuple[Walk, np.ndarray]], executor, store, keep: Callable) -> None:
    """Solve the first walk, which has one point, and then the others, which start from it. Every point that ends is
    given to ``keep(index, outcome)``, once.

    ``walks``: pairs of a `Walk` and the indices of its speeds. With a ``store``, the points found there come first.
    Points that a process of the ``executor`` puts there are reported while it goes on.
    """
    folder = None if store is None else str(validate.folder("store", store))
    journal = Journal(folder)
    indices = {key: int(index) for walk, run in walks for key, index in zip(walk.keys, run)}
    wanted = walks[0][0].wanted

    def tell(point: Point) -> None:
        if point.key in indices:
            keep(indices.pop(point.key), point.outcome)

    def look() -> dict[str, dict]:
        """Report what the store has. Returns the records of all that was reported."""
        known = journal.records()
        for key in list(indices):
            if point := journal.point(key, known, wanted):
                tell(point)
        return {key: record for key, record in known.items() if key not in indices}

    def again(batch: Batch) -> Batch:
        return replace(batch, known=look())

    known = look()
    first, *others = (Batch(prepared.scene, (walk,), prepared, folder, known) for walk, _ in walks)
    if indices:
        ((point, before),) = spread(executor, first_point, [first], again)
        tell(point)
        others = [replace(batch, before=before) for batch in others if not batch.walks[0].ended(known)]
        for point in spread(executor, points_of, others, again, look):
            tell(point)
        for batch in others:
            journal.finish(batch.name)
    journal.end(first.walks[0].keys)
