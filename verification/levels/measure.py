"""Every scene at every tolerance beside its reference: what was asked, found, and what it cost."""

from __future__ import annotations

import json
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

import lubfric
from lubfric.errors import LubfricError
from lubfric.model import prepare

from .scenes import SEED, cells, points, scene

TOLERANCES = (5e-2, 1e-2, 2e-3)
REFERENCE = 2e-4


def solve(model, tolerance: float, kind: str) -> dict:
    """One solve of a prepared scene, in processor seconds."""
    begun = time.process_time()
    try:
        found = lubfric.friction(model, tolerance=tolerance, model=kind)
    except LubfricError as error:
        return {"error": f"{type(error).__name__}: {error}", "seconds": time.process_time() - begun}
    d = found.decision
    return {
        "f": found.coefficient,
        "film_share": found.film_load / model.scene.bodies.load,
        "seconds": time.process_time() - begun,
        "film": d.film,
        "contact": d.contact,
        "coarsening": list(d.coarsening),
        "text": d.text,
    }


def row(index: int, values: dict) -> dict:
    """All solves of one scene."""
    begun = time.process_time()
    problem = scene(values, index)
    model = prepare(problem)
    found = {"index": index, "values": values, "cells": cells(problem), "prepare": time.process_time() - begun}
    found |= {f"{tolerance:g}": solve(model, tolerance, "auto") for tolerance in TOLERANCES}
    return found | {"full": solve(model, 1e-2, "full"), "reference": solve(model, REFERENCE, "full")}


def run(count: int, file: Path, *, part: tuple[int, int] = (0, 1), seed: int = SEED, tell=None) -> list[dict]:
    """Rows of the scenes drawn from ``seed``, kept in ``file`` as they come (one line each): those found there are not solved again.

    ``part`` (k, n): every n-th scene from k, so that n processes share the work, a file each.
    """
    row(0, points(1)[0])  # imports are no part of any time
    rows = [json.loads(line) for line in file.read_text().splitlines()] if file.is_file() else []
    known = {r["index"] for r in rows}
    file.parent.mkdir(parents=True, exist_ok=True)
    for index, values in enumerate(points(count, seed)):
        if index % part[1] != part[0] or index in known:
            continue
        rows.append(row(index, values))
        with file.open("a") as out:
            out.write(json.dumps(rows[-1]) + "\n")
        if tell:
            tell(rows[-1])
    return sorted(rows, key=lambda r: r["index"])


def errors(rows: list[dict], tolerance: float) -> list[float]:
    """|f - f_full|/f_full of the rows that have both, in order."""
    return [
        abs(r[f"{tolerance:g}"]["f"] / r["reference"]["f"] - 1)
        for r in rows
        if "f" in r[f"{tolerance:g}"] and "f" in r["reference"]
    ]


def median_saving(rows: list[dict], tolerance: float, against: str, *, preparation: bool) -> float:
    """Median ratio of times."""
    extra = (lambda r: r["prepare"]) if preparation else (lambda r: 0.0)
    return float(
        np.median([(r[against]["seconds"] + extra(r)) / (r[f"{tolerance:g}"]["seconds"] + extra(r)) for r in rows])
    )


def savings(rows: list[dict]) -> str:
    """Median ratios of times, in words."""
    lines = []
    for tolerance in TOLERANCES:
        point, whole, same = (
            median_saving(rows, tolerance, against, preparation=prepared)
            for against, prepared in (("reference", False), ("reference", True), ("full", False))
        )
        lines.append(
            f"tolerance {100 * tolerance:g} %: median time {point:.3g} times less than the reference ({whole:.3g} "
            f"with the surface made), {same:.3g} times less than everything at 1 %"
        )
    return "\n".join(lines)


def finer_reference(index: int, values: dict) -> tuple[float, float]:
    """f_full, and f of the same surface on cells half as long (its Fourier series) with a film ten times as tight."""
    problem = scene(values, index)
    model = prepare(problem)
    coarse = lubfric.friction(model, tolerance=REFERENCE, model="full").coefficient
    fine = model.surface.resampled(shape=tuple(2 * n for n in model.surface.shape))
    tight = problem.with_(
        numerics={"ehl_tolerance": 3e-5, "tolerance": 2e-4}, contact={"shape": fine.shape, "spacing": fine.spacing}
    )
    return coarse, lubfric.friction(prepare(tight, replace(fine)), model="full").coefficient
