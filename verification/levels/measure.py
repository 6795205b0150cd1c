"""Every scene at every tolerance beside its reference: what was asked, found, and what it cost."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

import lubfric
from lubfric.errors import LubfricError
from lubfric.sharing import prepare

from .. import kept, parts
from ..check import Check
from ..report import finite
from .scenes import SEED, cells, points, scene

TOLERANCES = (5e-2, 1e-2, 2e-3)
REFERENCE = 2e-4
SOURCE = f"everything modelled, at {REFERENCE:g}"


def solve(model, tolerance: float, kind: str) -> dict:
    """One solve of a prepared scene, in processor seconds."""
    begun = time.process_time()
    try:
        found = lubfric.friction(model, tolerance=tolerance, model=kind)
    except LubfricError as error:
        return {"error": f"{type(error).__name__}: {error}", "seconds": time.process_time() - begun}
    d = parts.decision(found)
    return {
        "f": found.coefficient,
        "film_share": found.film_load / model.scene.bodies.load,
        "seconds": time.process_time() - begun,
        "film": d.film,
        "contact": d.contact,
        "text": d.text,
    }


def row(index: int, values: dict) -> list[Check]:
    """One scene at every tolerance, each f beside that of the reference."""
    begun = time.process_time()
    problem = scene(values, index)
    model = prepare(problem)
    made = time.process_time() - begun
    found = {tolerance: solve(model, tolerance, "auto") for tolerance in TOLERANCES}
    full, reference = solve(model, 1e-2, "full"), solve(model, REFERENCE, "full")
    shared = {
        "index": index,
        "cells": cells(problem),
        "prepare": made,
        "seconds_full": full["seconds"],
        "seconds_reference": reference["seconds"],
    }
    return [compared(index, tolerance, one, reference, shared) for tolerance, one in found.items()]


def compared(index: int, tolerance: float, found: dict, reference: dict, shared: dict) -> Check:
    """f at one tolerance. Three times that is allowed, because the share of scenes within it is judged apart."""
    failed = found.get("error") or ("error" in reference and f"reference: {reference['error']}") or ""
    return Check(
        f"scene {index} at {100 * tolerance:g} %",
        math.nan if failed else found["f"],
        1.0 if failed else reference["f"],
        3 * tolerance,
        SOURCE,
        note=found.get("text", ""),
        seconds=found["seconds"],
        refused=failed,
        at=shared | {"asked": tolerance} | {name: found.get(name) for name in ("film", "contact", "film_share")},
    )


def file_of(folder, seed: int) -> Path:
    """Where the scenes drawn from ``seed`` are kept."""
    return Path(folder) / f"scenes-{seed}.jsonl"


def run(count: int, file: Path, *, part: tuple[int, int] = (0, 1), seed: int = SEED) -> list[Check]:
    """Checks of the scenes drawn from ``seed``. They are kept in ``file`` as they come, a line for each scene, and
    those found there are not solved again.

    ``part`` (k, n) takes every n-th scene from k, so that n processes share the work, with a file each.
    """
    row(0, points(1)[0])  # imports are no part of any time
    found = [Check.from_dict(c) for line in kept.begin(file) for c in line]
    known = {c.at["index"] for c in found}
    for index, values in enumerate(points(count, seed)):
        if index % part[1] != part[0] or index in known:
            continue
        new = row(index, values)
        kept.append(file, finite([c.as_dict() for c in new]))
        found += new
    return sorted(found, key=lambda c: (c.number("index"), -c.number("asked")))


def savings(found: list[Check]) -> dict[str, float]:
    """Median ratios of times of the scenes at one tolerance."""
    good = [c for c in found if not c.refused]

    def median(against: str, preparation: str = "") -> float:
        extra = [c.number(preparation) if preparation else 0.0 for c in good]
        return float(np.median([(c.number(against) + e) / (c.duration + e) for c, e in zip(good, extra)]))

    return {
        "reference": median("seconds_reference"),
        "reference with the surface made": median("seconds_reference", "prepare"),
        "everything at 1 %": median("seconds_full"),
    }


def finer_reference(index: int, values: dict) -> tuple[float, float]:
    """f_full, and f of the same surface on cells half as long (its Fourier series) with a film ten times as tight."""
    problem = scene(values, index)
    model = prepare(problem)
    coarse = lubfric.friction(model, tolerance=REFERENCE, model="full").coefficient
    fine = model.surface.resampled(shape=tuple(2 * n for n in model.surface.shape))
    tight = problem.with_(
        numerics={"film_tolerance": 3e-5, "tolerance": 2e-4}, contact={"shape": fine.shape, "spacing": fine.spacing}
    )
    return coarse, lubfric.friction(prepare(tight, replace(fine)), model="full").coefficient
