"""Thousands of friction calls over random scenes; an independent check solves the balance of each answer again.

Scenes come in chunks that depend only on their number. A finished chunk is stored.
"""

import math
import os
from collections import Counter
from collections.abc import Iterator
from functools import partial

import numpy as np

import lubfric
from lubfric.models.shared import Prepared

from ...check import AT_MOST, Check, Item, Table
from ...kept import Run
from ...types import Keywords, PlainRow
from . import SEED
from .case import resident_memory
from .soak_judge import verdict
from .soak_scenes import random_scene

CHUNK = 50  # scenes
MOST_GROWTH = 256.0  # MiB from the first quarter of a process's chunks to its last: what the allocator keeps
ANSWERED = "answered"
REFUSED = "refused"
RAW = "raw error"


def soak(level: str, run: Run = Run()) -> Iterator[Item]:
    """Compute the friction of random scenes one after the other in one process.

    Each scene is answered, or refused with a message. An independent check with its own film solver, root finder and
    sums solves the balance of each answer again. The memory does not grow.
    """
    chunks = {f"scenes from {k}": range(k, k + CHUNK) for k in range(0, 100 if level == "quick" else 10_000, CHUNK)}
    yield from summarized([row for _, row in run.solved(chunks, partial(chunk, SEED))])


def summarized(chunks: list[PlainRow]) -> Iterator[Item]:
    """Checks and tables of the chunks."""
    scenes = [entry for row in chunks for entry in row["scenes"]]
    ended = Counter(entry["ended"] for entry in scenes)
    solved_again = [entry for entry in scenes if entry["ratio"] is not None]
    none: Keywords = {"ratio": math.inf, "words": "nothing was judged"}
    worst = max(solved_again, key=lambda entry: entry["ratio"], default=none)
    wrong = [entry["words"] for entry in solved_again if not entry["ratio"] <= 1]
    raw = [entry["words"] for entry in scenes if entry["ended"] == RAW]
    yield Check(
        "raw errors", len(raw), expected=0, tolerance=0, source="none is allowed", kind=AT_MOST, note="; ".join(raw[:3])
    )
    yield Check(
        "silently wrong",
        len(wrong),
        expected=0,
        tolerance=0,
        source="independent balance",
        kind=AT_MOST,
        note="; ".join(wrong[:3]),
    )
    yield Check(
        "worst error / allowed",
        worst["ratio"],
        expected=1,
        tolerance=0,
        source="independent balance",
        kind=AT_MOST,
        note=worst["words"],
    )
    yield Check(
        "growth of memory", growth(chunks), expected=MOST_GROWTH, tolerance=0, source="flat", kind=AT_MOST, unit="MiB"
    )
    words = (
        f"{len(scenes)} scenes: {ended[ANSWERED]} answered, {ended[REFUSED]} refused, {len(solved_again)} solved again"
    )
    why = Counter(entry["words"] for entry in scenes if entry["ended"] == REFUSED)
    yield Table("soak", words, ("why", "refused"), why.most_common(12))
    features = Counter(feature for entry in scenes for feature in entry["features"])
    yield Table("soak-features", "What the answered scenes had", ("feature", "scenes"), features.most_common())
    rows = [(row["first"], row["process"], round(row["memory"], 1)) for row in chunks[:: max(1, len(chunks) // 12)]]
    yield Table("soak-memory", "Resident memory of the process", ("scenes before", "process", "MiB"), rows)


def chunk(seed: int, numbers: range) -> PlainRow:
    """Return what became of the scenes of ``numbers``, and the resident memory [MiB] of the process at their end."""
    scenes = [scene_row(seed, number) for number in numbers]
    return {"first": numbers[0], "scenes": scenes, "process": os.getpid(), "memory": resident_memory() / 2**20}


def scene_row(seed: int, number: int) -> PlainRow:
    """Return how one call ended, its message, its largest error over the allowed one (None: not checked), its
    features."""
    row: PlainRow = {"ended": REFUSED, "words": "", "ratio": None, "features": []}
    scene = random_scene(np.random.default_rng((seed, number)), any_material=number % 2 == 1)
    try:
        prepared = lubfric.prepare(scene)
        result = lubfric.friction(prepared)
    except lubfric.LubfricError as error:
        return row | {"words": f"{type(error).__name__}: {str(error).split('=')[0].split(':')[0][:60]}"}
    except Exception as error:  # what must never happen
        return row | {"ended": RAW, "words": f"{(seed, number)}: {type(error).__name__}: {error}"[:300]}
    row |= {"ended": ANSWERED, "features": list(_features(prepared, result))}
    try:
        ratios = verdict(prepared, result)
    except lubfric.LubfricError as error:  # of the judge's own film or contact: it does not know
        return row | {"features": [*row["features"], f"not judged: {type(error).__name__}"]}
    worst = max(ratios, key=lambda name: ratios[name] if math.isfinite(ratios[name]) else math.inf)
    ratio = ratios[worst] if math.isfinite(ratios[worst] + result.coefficient) else 1e300
    words = f"{(seed, number)}: {worst} {ratio:.3g} of what is allowed, f = {result.coefficient:.4g}"
    return row | {"ratio": ratio, "words": words}


def _features(prepared: Prepared, result: lubfric.FrictionResult) -> Iterator[str]:
    """Names of what a soak should have had some of, as far as this scene has it."""
    scene = prepared.scene
    share = result.contact_load / prepared.scene.bodies.load
    yield scene.contact.geometry
    yield "asperities" if scene.contact.model != "half-space" else "height map"
    if share == 0:
        yield "separated"
    else:
        yield "contact below 1 %" if share < 0.01 else "contact above 1 %"
    features = {
        "strips": prepared.sample.represents_more,
        "plastic limit": scene.bodies.hardness,
        "cells yielded": result.plastic_area_fraction > 0,
        "two rough bodies": scene.counterface,
        "oil by grade": scene.lubricant.oil,
        "heat of the inlet": result.inlet_film_factor < 1,
        "heat of film and surfaces": result.film_temperature_rise > 0,
        "pure rolling": scene.motion.slide_roll_ratio == 0,
        "more strips than at first": result.decision.strips > prepared.sample.first_strips,
        "corrected for its cells": result.decision.coarsening != (1, 1) and share > 0,
    }
    yield from (name for name, holds in features.items() if holds)


def growth(chunks: list[PlainRow]) -> float:
    """Return largest rise of the memory of a process [MiB], from the mean of its second quarter to that of its last."""
    rises = [0.0]
    for process in {row["process"] for row in chunks}:
        sizes = [row["memory"] for row in chunks if row["process"] == process]
        if len(sizes) >= 4:
            quarter = len(sizes) // 4
            rises.append(float(np.mean(sizes[-quarter:]) - np.mean(sizes[quarter : 2 * quarter])))
    return max(rises)
