"""``python -m verification sampling``: does the interval cover the friction of an endless line, and what does it cost?

Every case is solved many times, with seeds of its own. The exit code is 1 when coverage, reported error over scatter,
or bias of a case is out of its bounds (`verification.sampling.verdict`). What is solved is kept in the folder and not
solved again.
"""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import lubfric

from ..check import Item, Table
from ..frame import Command
from ..frame import main as run
from ..studies import Study
from .cases import CASES, SEED, SPEEDS

LEVELS, LONG = ("default", "quick", "full"), ("default", "full")
STUDIES = (
    Study("coverage", "verification.sampling:coverage", "Intervals beside the friction of an endless line", LEVELS),
    Study("pieces", "verification.sampling:map_in_pieces", "Intervals of pieces beside their whole map", LONG),
    Study("quantities", "verification.sampling:other_numbers", "Every other number beside its stated error", LONG),
    Study("bias", "verification.sampling:bias", "Bias and scatter of one patch against its length", LONG),
    Study("cost", "verification.sampling:time_and_error", "Processor time against the error of f", LONG),
)
TRIALS = {"quick": 16, "default": 60, "full": 400}
OTHERS = 200  # trials of other surfaces and loads, at most
MAPS = {"default": 2, "full": 6}
SCENES = {"default": 24, "full": 100}
PATCHES = {"default": 8, "full": 24}
SURFACES = {"default": 3, "full": 8}


def main(argv: list[str]) -> int:
    """The command."""
    return run(Command("sampling", __doc__, STUDIES, "out/sampling", LEVELS, 0, _options, _prepared), argv)


def coverage(level: str, out: Path, seed: int) -> Iterator[Item]:
    """How often the 95 % interval holds the friction of an endless line, over trials on surfaces of their own."""
    from . import charts, measure, verdict

    results = []
    for case in SPEEDS if level == "quick" else CASES:
        trials = TRIALS[level] if case in SPEEDS else min(TRIALS[level], OTHERS)
        results.append(measure.run(case, trials, seed, out))
        yield from verdict.checks(results[-1])
    rows = [verdict.row(result) for result in results]
    yield Table("coverage", "Trials of every case beside its endless line", verdict.COLUMNS, rows)
    yield charts.coverage(results)


def map_in_pieces(level: str, out: Path, seed: int, scene=None, cuts=(2, 2)) -> Iterator[Item]:
    """How often the interval of a piece holds the friction of the map that it was cut from.

    The maps are generated ones, or the measured map of ``scene``.
    """
    from . import pieces, verdict

    yield verdict.of_pieces(pieces.measured(scene, cuts, out) if scene else pieces.run(MAPS[level], seed, out))


def other_numbers(level: str, out: Path, seed: int) -> Iterator[Item]:
    """Every reported number of random scenes beside everything modelled at 0.01 %: is it within its stated error?"""
    from . import quantities, verdict

    yield from verdict.of_quantities(quantities.counted(quantities.run(SCENES[level], quantities.SEED, out)))


def bias(level: str, out: Path, seed: int) -> Iterator[Item]:
    """What one patch leaves unsaid: bias and scatter of its f against its length."""
    from . import charts, lengths

    found = lengths.run(PATCHES[level], seed, _truths(out, seed))
    yield from lengths.checks(found)
    yield charts.bias(found)


def time_and_error(level: str, out: Path, seed: int) -> Iterator[Item]:
    """Processor seconds for every standard error asked, and the error of f that was really made."""
    from . import charts, cost

    found = cost.run(SURFACES[level], seed, _truths(out, seed))
    yield from cost.checks(found)
    yield charts.cost(found)


def _truths(out: Path, seed: int) -> dict[float, float]:
    """f of an endless line at every speed of the built-in scene. It is solved where ``out`` does not have it."""
    from . import measure

    return {case.speed: measure.endless(case, seed, out)["f"] for case in SPEEDS}


def _options(parser: ArgumentParser) -> None:
    parser.add_argument("--seed", type=int, default=SEED, help="of the surfaces (default: %(default)s)")
    parser.add_argument(
        "--map", metavar="SCENE", help="cut the measured map of this scene in pieces, in place of others"
    )
    parser.add_argument("--cuts", type=int, nargs=2, default=(2, 2), metavar=("X", "Y"), help="of that map")


def _prepared(study: Study, options: Namespace) -> Study:
    own: dict[str, Any] = {"out": options.out, "seed": options.seed}
    if study.name == "pieces" and options.map:
        own |= {"scene": lubfric.load_scene(options.map), "cuts": tuple(options.cuts)}
    return replace(study, options=own)
