"""Every reported number of random scenes beside that of everything modelled: within the error it states?"""

from __future__ import annotations

import math
import time
from pathlib import Path

import numpy as np

import lubfric
from lubfric.errors import LubfricError
from lubfric.sampling import FIELDS

from .. import kept
from ..levels.scenes import points, scene

REFERENCE = 1e-4  # tolerance on f
SEED = 11
FLOOR = 1e-3  # of a quantity: what the reference itself may be off by


def run(count: int, seed: int, out: Path) -> list[dict]:
    """A row for each of ``count`` scenes, kept in ``out`` as they come.

    A row is {name: (value, stated relative error, value of the reference)}.
    """
    file = out / f"quantities-{seed}.jsonl"
    rows = kept.begin(file)
    known = {row["index"] for row in rows}
    for index, values in enumerate(points(count, seed)):
        if index in known:
            continue
        rows.append(row_of(index, values))
        kept.append(file, rows[-1])
    return [row for row in rows if row["index"] < count]


def row_of(index: int, values: dict) -> dict:
    """One scene at the default tolerance and at its reference, both on the same map."""
    begun = time.process_time()
    prepared = lubfric.prepare(scene(values, index))
    try:
        found = lubfric.friction(prepared)
        full = lubfric.friction(prepared, tolerance=REFERENCE, model="full")
    except LubfricError as error:
        return {"index": index, "error": f"{type(error).__name__}: {error}"[:300]}
    beside = {
        name: (getattr(found, name), getattr(found.errors, name), getattr(full, name), found.errors.reasons.get(name))
        for name in FIELDS
    }
    told = found.decision.text if found.decision else ""
    return {"index": index, "seconds": time.process_time() - begun, "told": told, "beside": beside}


def within(row: dict) -> dict[str, bool | None]:
    """For each quantity, whether it is within its stated error (or `FLOOR`); None where no error is stated."""
    result: dict[str, bool | None] = {}
    for name, (value, error, reference, reason) in row.get("beside", {}).items():
        if error is None or not math.isfinite(error):
            result[name] = None if reason else False
        elif value == reference:
            result[name] = True
        else:
            size = max(abs(reference), 1e-300)
            result[name] = bool(abs(value - reference) <= max(error, FLOOR) * max(size, abs(value)))
    return result


def counted(rows) -> list[tuple[str, int, float, float]]:
    """(quantity, scenes that state an error, share of them within it, median stated error)."""
    found = []
    for name in FIELDS:
        told = [row for row in rows if within(row).get(name) is not None]
        if not told:
            continue
        held = sum(bool(within(row)[name]) for row in told) / len(told)
        found.append((name, len(told), held, float(np.median([row["beside"][name][1] for row in told]))))
    return found
