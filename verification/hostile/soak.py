"""Thousands of friction calls over random scenes, each answer closed again by an independent judge.

They come in chunks of scenes that depend on nothing but their number. A chunk that is done is a file in the folder
given, and a run that was stopped goes on behind the last of them.
"""

from __future__ import annotations

import json
import math
import os
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np

import lubfric

from ..parent import end_with_parent
from .case import resident_memory
from .soak_judge import verdict
from .soak_scenes import random_scene

CHUNK = 50  # scenes
MOST_GROWTH = 256.0  # MiB from the first quarter of a process's chunks to its last: what the allocator keeps
WORDS = 60  # of why a scene was refused


@dataclass
class Chunk:
    """What became of a chunk of calls.

    It has the numbers of calls, the scenes that were answered wrongly, the worst error over what is allowed, why scenes
    were refused, which features they had, and the resident memory [MiB] of ``process`` at its end.
    """

    number: int
    answered: int = 0
    refused: int = 0
    judged: int = 0
    raw: int = 0
    wrong: list[str] = field(default_factory=list)
    worst: float = 0.0
    worst_case: str = ""
    memory: float = 0.0
    process: int = 0
    reasons: dict[str, int] = field(default_factory=dict)
    features: dict[str, int] = field(default_factory=dict)


def soak(count: int, seed: int, folder: Path | None = None, workers: int = 1) -> list[Chunk]:
    """``count`` scenes of ``seed`` in chunks; finished ones are kept in ``folder`` (None: nowhere)."""
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
    jobs = [(k, min(CHUNK, count - CHUNK * k), seed, folder) for k in range(-(-count // CHUNK))]
    if workers == 1:
        return [chunk(*job) for job in jobs]
    with ProcessPoolExecutor(workers, initializer=end_with_parent) as pool:
        return list(pool.map(chunk, *zip(*jobs)))


def chunk(number: int, count: int, seed: int, folder: Path | None) -> Chunk:
    """Scenes from number ``number`` x `CHUNK` on, read from ``folder`` where they were done before."""
    path = None if folder is None else folder / f"seed-{seed}-chunk-{number:04d}.json"
    if path is not None and path.exists():
        return Chunk(**json.loads(path.read_text(encoding="utf-8")))
    found = Chunk(number, process=os.getpid())
    for index in range(number * CHUNK, number * CHUNK + count):
        _one(found, (seed, index))
    found.memory = resident_memory() / 2**20
    if path is not None:
        part = path.with_suffix(".part")
        part.write_text(json.dumps(asdict(found)), encoding="utf-8")
        part.replace(path)
    return found


def _one(found: Chunk, seeds: tuple[int, int]) -> None:
    scene = random_scene(np.random.default_rng(seeds), any_material=seeds[1] % 2 == 1)
    try:
        prepared = lubfric.prepare(scene)
        result = lubfric.friction(prepared)
    except lubfric.LubfricError as error:
        found.refused += 1
        _count(found.reasons, f"{type(error).__name__}: {str(error).split('=')[0].split(':')[0][:WORDS]}")
        return
    except Exception as error:  # what must never happen
        found.raw += 1
        found.wrong.append(f"{seeds}: {type(error).__name__}: {error}"[:300])
        return
    found.answered += 1
    for feature in _features(prepared, result):
        _count(found.features, feature)
    try:
        ratios = verdict(prepared, result)
    except lubfric.LubfricError as error:  # of the judge's own film or contact: it does not know
        _count(found.reasons, f"not judged: {type(error).__name__}: {error}"[:WORDS])
        return
    found.judged += "friction" in ratios
    worst = max(ratios, key=lambda name: ratios[name])
    said = f"{seeds}: {worst} {ratios[worst]:.3g} of what is allowed, f = {result.coefficient:.4g}"
    if not ratios[worst] <= 1 or not math.isfinite(result.coefficient):
        found.wrong.append(said)
    if not ratios[worst] <= found.worst:
        found.worst, found.worst_case = ratios[worst], said


def _count(counts: dict[str, int], word: str) -> None:
    counts[word] = counts.get(word, 0) + 1


def _features(prepared, result) -> Iterator[str]:
    """Names of what a soak should have had some of, as far as this scene has it."""
    scene, share = prepared.scene, result.contact_load / prepared.scene.bodies.load
    yield scene.contact.geometry
    yield "line" if prepared.lines is not None else "patch"
    yield "asperities" if scene.contact.model != "half-space" else "height map"
    yield "separated" if share == 0 else "contact below 1 %" if share < 0.01 else "contact above 1 %"
    yield from (["plastic limit"] if scene.bodies.hardness else [])
    yield from (["cells yielded"] if result.plastic_area_fraction > 0 else [])
    yield from (["two rough bodies"] if scene.counterface else [])
    yield from (["oil by grade"] if scene.lubricant.oil else [])
    yield from (["heat of the inlet"] if result.inlet_film_factor < 1 else [])
    yield from (["heat of film and surfaces"] if result.film_temperature_rise > 0 else [])
    yield from (["deflected by the whole load"] if result.decision.deflected_by == "scaled" else [])
    yield from (["pure rolling"] if scene.motion.slide_roll_ratio == 0 else [])
    yield from (["more than one line"] if result.line is not None and result.line.used else [])
    yield from (["finer pieces of the line"] if result.line is not None and result.line.grid else [])


def growth(chunks: list[Chunk]) -> float:
    """Largest rise of the memory of a process [MiB], from the mean of its second quarter to that of its last."""
    rises = [0.0]
    for process in {c.process for c in chunks}:
        sizes = [c.memory for c in chunks if c.process == process]
        if len(sizes) >= 4:
            quarter = len(sizes) // 4
            rises.append(float(np.mean(sizes[-quarter:]) - np.mean(sizes[quarter : 2 * quarter])))
    return max(rises)


def total(chunks: list[Chunk], name: str) -> Counter:
    """Counts by word of all chunks."""
    counted: Counter = Counter()
    for one in chunks:
        counted.update(getattr(one, name))
    return counted
