"""``python -m verification sampling``: does the interval cover the friction of an endless line, and what does it
cost?"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

OTHERS = 100  # trials of other surfaces and loads, at most


def main(argv: list[str]) -> int:
    """Solve every case many times with seeds of its own, count how often the interval covers, draw the charts.

    Exit code 0: coverage, reported error over scatter and bias of every case within its bounds
    (`verification.sampling.verdict`).
    """
    import lubfric

    from . import cases, charts, cost, lengths, measure, pieces, quantities, verdict

    parser = argparse.ArgumentParser("python -m verification sampling", description=__doc__)
    level = parser.add_mutually_exclusive_group()
    level.add_argument("--quick", action="store_true", help="four speeds of the built-in scene, 16 trials each")
    level.add_argument(
        "--full", action="store_true", help="200 trials, other autocorrelations and loads, a map in pieces"
    )
    parser.add_argument(
        "--out", type=Path, default=Path("out/sampling"), help="folder of results (default: %(default)s)"
    )
    parser.add_argument("--seed", type=int, default=cases.SEED, help="of the surfaces (default: %(default)s)")
    parser.add_argument("--map", type=Path, metavar="SCENE", help="only the measured map of this scene, in pieces")
    parser.add_argument("--cuts", type=int, nargs=2, default=(2, 2), metavar=("X", "Y"), help="of that map")
    options = parser.parse_args(argv)
    trials = 16 if options.quick else 200 if options.full else 60
    options.out.mkdir(parents=True, exist_ok=True)
    if options.map:
        scene = lubfric.load_scene(options.map)
        rows = pieces.measured(scene, scene.motion.entrainment_speed, tuple(options.cuts), options.out, _tell)
        line = verdict.of_pieces(rows)
        print(verdict.table([line]))
        return 0 if line.passed else 1
    chosen = cases.SPEEDS if options.quick else cases.CASES
    results = [
        measure.run(case, trials if case in cases.SPEEDS else min(trials, OTHERS), options.seed, options.out, _tell)
        for case in chosen
    ]
    truths = {result.case.speed: result.truth for result in results if result.case in cases.SPEEDS}
    lines = [verdict.of_case(result) for result in results]
    if not options.quick:
        maps = pieces.run(6 if options.full else 2, options.seed, options.out, _tell)
        lines.append(verdict.of_pieces(maps))
        scenes = quantities.run(100 if options.full else 24, quantities.SEED, options.out, _tell)
        lines.append(verdict.of_quantities(quantities.counted(scenes)))
        charts.bias(lengths.run(24 if options.full else 8, options.seed, truths, _tell), options.out)
        charts.cost(cost.run(8 if options.full else 3, options.seed, truths, _tell), options.out)
    table = verdict.table(lines)
    print(table)
    (options.out / "sampling.md").write_text(table + "\n")
    charts.coverage(results, options.out)
    return 0 if all(line.passed for line in lines) else 1


def _tell(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
