"""``python -m verification levels``: is the coefficient within the tolerance, and what does that save?

The exit code is 1 when less than 99 % of the scenes are within a tolerance, when one is beyond three times it, or when
a switch between levels shows.
"""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ..check import AT_LEAST, AT_MOST, TOLD, Check, Item
from ..frame import Command
from ..frame import main as run
from ..studies import Study
from .scenes import SEED

LEVELS = ("full", "quick")
COUNT = {"full": 200, "quick": 16}
SPEEDS = {"full": 240, "quick": 60}
STUDIES = (
    Study(
        "saving", "verification.levels:scenes_beside_full", "Scenes at every tolerance beside the full model", LEVELS
    ),
    Study(
        "switches",
        "verification.levels:speeds_through_switches",
        "f through every switch between levels and grids",
        LEVELS,
    ),
)


def main(argv: list[str]) -> int:
    """The command."""
    return run(Command("levels", __doc__, STUDIES, "out/levels", LEVELS, 0, _options, _prepared), argv)


def scenes_beside_full(level: str, out: str, seed: int) -> Iterator[Item]:
    """Scenes over the whole range that a user may ask for, each at three tolerances beside everything modelled tightly.

    What is solved is kept in the folder, a line for each scene, and not solved again.
    """
    from . import charts, measure

    count = COUNT[level]
    file = measure.file_of(out, seed)
    found = measure.run(count, file, seed=seed)
    yield from found
    for tolerance in measure.TOLERANCES:
        mine = [c for c in found if c.number("asked") == tolerance]
        within = float(np.mean([c.deviation <= tolerance for c in mine]))
        yield Check(f"share of scenes within {100 * tolerance:g} %", within, 0.99, 0.0, measure.SOURCE, AT_LEAST)
        for name, value in measure.savings(mine).items():
            yield Check(f"median time, {name}, over that at {100 * tolerance:g} %", value, 0.0, 0.0, "the clock", TOLD)
    for index in range(0, count, max(count // 10, 4)):
        coarse, fine = measure.finer_reference(index, measure.points(count, seed)[index])
        words = f"reference of scene {index} against cells half as long: relative error"
        yield Check(words, abs(coarse / fine - 1), 0.0, 0.0, "the same surface on finer cells", TOLD)
    yield charts.error_against_saving(found)


def speeds_through_switches(level: str) -> Iterator[Item]:
    """Fine steps of speed along three scenes, each beside the full model. No switch between levels may show."""
    from . import charts
    from .switches import TOLERANCE, scan

    found = scan(points=SPEEDS[level])
    yield from found
    worst = max(c.deviation for c in found)
    yield Check("largest |f - f_full|/f_full along the speeds", worst, TOLERANCE, 0.0, "the full model", AT_MOST)
    yield charts.continuity(found)


def _options(parser: ArgumentParser) -> None:
    words = "of the scenes (default: %(default)s; others are other scenes)"
    parser.add_argument("--seed", type=int, default=SEED, help=words)


def _prepared(study: Study, options: Namespace) -> Study:
    if study.name != "saving":
        return study
    return replace(study, options={"out": str(options.out), "seed": options.seed})
