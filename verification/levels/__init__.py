"""``python -m verification levels``: is the coefficient within the tolerance, and what does that save?"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path


def main(argv: list[str]) -> int:
    """Solve the scenes beside their references, say how many are within the tolerance, draw the charts.

    Exit code 0: at least 99 % within each tolerance, none beyond three times it, and every switch continuous.
    """
    from . import charts, measure, switches
    from .scenes import SEED

    parser = argparse.ArgumentParser("python -m verification levels", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="16 scenes instead of 200")
    parser.add_argument("--out", type=Path, default=Path("out/levels"), help="folder of results (default: %(default)s)")
    parser.add_argument(
        "--seed", type=int, default=SEED, help="of the scenes (default: %(default)s; others are other scenes)"
    )
    options = parser.parse_args(argv)
    count = 16 if options.quick else 200
    rows = measure.run(count, options.out / f"scenes-{options.seed}.jsonl", seed=options.seed, tell=_tell)
    passed = [_verdict(rows, tolerance) for tolerance in measure.TOLERANCES]
    print(measure.savings(rows))
    for index in range(0, count, max(count // 10, 4)):
        coarse, fine = measure.finer_reference(index, measure.points(count, options.seed)[index])
        print(f"reference {index}: f = {coarse:.6f}, on cells half as long {fine:.6f} ({coarse / fine - 1:+.1e})")
    scan = switches.scan(points=60 if options.quick else 240)
    print(f"switches: largest |f - f_full|/f_full along {len(scan)} speeds {max(r['error'] for r in scan):.1e}")
    charts.error_against_saving(rows, options.out / "levels-saving.png")
    charts.continuity(scan, options.out / "levels-switches.png")
    return 0 if all(passed) and max(r["error"] for r in scan) <= switches.TOLERANCE else 1


def _verdict(rows, tolerance: float) -> bool:
    from . import measure

    errors = measure.errors(rows, tolerance)
    within = sum(e <= tolerance for e in errors) / len(errors)
    lost = len(rows) - len(errors)
    print(
        f"tolerance {100 * tolerance:g} %: {100 * within:.1f} % of {len(errors)} scenes within, largest "
        f"{100 * max(errors):.2g} %{f', {lost} not solved' if lost else ''}"
    )
    return within >= 0.99 and max(errors) <= 3 * tolerance and lost == 0


def _tell(row: dict) -> None:
    print(f"scene {row['index']}: {row['0.01'].get('text', row['0.01'].get('error'))}", file=sys.stderr, flush=True)
