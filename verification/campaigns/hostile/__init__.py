"""Bad input from a seeded generator: scenes, files and calls that must each be refused with a message.

`scenes`, `files`, `calls`, `layouts` and `commands` make the cases; those written by hand are in `bad.toml`.
`case.judge` runs a case and returns how it ended. No case may end in an exception that is not lubfric's own, return a
number, take longer than 8 s, or take more than 2 GB.
"""

from __future__ import annotations

import importlib
import tempfile
import tomllib
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from ...check import AT_MOST, Check, Item, Table
from ...kept import Run

if TYPE_CHECKING:
    from .case import HostileCase

SEED = 1  # of the generator of cases
HAND = tomllib.loads(Path(__file__).with_name("bad.toml").read_text(encoding="utf-8"))
COUNTS = {"scenes": 1500, "files": 500, "calls": 900, "layouts": 1500, "commands": 300}  # at least so many of a group


def cases(group: str, seed: int, share: float = 1.0) -> Iterator[HostileCase]:
    """About ``share`` of the cases of a group of ``seed``, chosen at random."""
    import numpy as np

    number = list(COUNTS).index(group)
    chosen = np.random.default_rng([seed, number, 1])
    module = importlib.import_module(f"verification.campaigns.hostile.{group}")
    for case in module.cases(np.random.default_rng([seed, number]), COUNTS[group]):
        if chosen.random() < share:
            yield case


def outcomes(group_and_share: tuple[str, float]) -> list[tuple[str, str]]:
    """Return (verdict, words) of each case of a group, run in a folder of its own."""
    from .case import judge

    values = []
    for case in cases(group_and_share[0], SEED, group_and_share[1]):
        with tempfile.TemporaryDirectory() as folder:
            values.append(judge(case, Path(folder)))
    return values


def bad_inputs(level: str, run: Run = Run()) -> Iterator[Item]:
    """Bad scenes, files and calls. `lubfric.LubfricError` refuses each with a message, within 8 s and 2 GB."""
    from .case import BAD, GOOD

    share = 0.1 if level == "quick" else 1.0
    rows = []
    for (group, _), result in run.solved({group: (group, share) for group in COUNTS}, outcomes):
        counted = Counter(verdict for verdict, _ in result)
        for verdict in BAD:
            first = next((words for ended, words in result if ended == verdict), "")
            name = f"{group}: {verdict}"
            yield Check(
                name,
                counted[verdict],
                expected=0,
                tolerance=0,
                source="bad by construction",
                kind=AT_MOST,
                note=first[:200],
            )
        rows.append((group, *(counted[verdict] for verdict in (*GOOD, *BAD))))
    yield Table("bad-inputs", "Bad inputs by how they ended", ("input", *GOOD, *BAD), rows)
