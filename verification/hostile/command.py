"""All bad inputs of a seed, judged one after the other."""

from __future__ import annotations

import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from . import calls, commands, files, scenes
from .case import GOOD, Case, Outcome, judge

GROUPS = {"scene": scenes, "file": files, "call": calls, "command": commands}
COUNTS = {"scene": 1500, "file": 500, "call": 900, "command": 300}


def cases(seed: int, share: float = 1.0, groups: Sequence[str] = tuple(GROUPS)) -> Iterator[Case]:
    """About ``share`` of all cases of ``seed`` in ``groups``, chosen at random."""
    for number, (group, module) in enumerate(GROUPS.items()):
        if group not in groups:
            continue
        rng = np.random.default_rng([seed, number])
        chosen = np.random.default_rng([seed, number, 1])
        for case in module.cases(rng, COUNTS[group]):
            if chosen.random() < share:
                yield case


def outcomes(seed: int, share: float = 1.0, groups: Sequence[str] = tuple(GROUPS)) -> Iterator[Outcome]:
    """The outcome of each case, run in a folder of its own."""
    for case in cases(seed, share, groups):
        with tempfile.TemporaryDirectory() as folder:
            yield judge(case, Path(folder))


def table(found: list[Outcome]) -> str:
    """How many of each group ended how, and every one that ended badly."""
    counted = Counter((o.case.group, o.verdict) for o in found)
    lines = [f"{group:<10}{verdict:<20}{number:>6}" for (group, verdict), number in sorted(counted.items())]
    slowest = max(found, key=lambda o: o.seconds)
    lines.append(f"{len(found)} bad inputs; slowest {slowest.seconds:.2f} s: {slowest.case.name}")
    return "\n".join([*lines, *(str(o) for o in found if o.verdict not in GOOD)])
