"""``python -m verification.campaigns.calibration rest|rolling COUNT [--budget S]``: extend a table of solved cases.
``... numbers [--workers N] [--seconds S] [--out FOLDER]``: solve the cases that are missing on long cells by today's
model. ``... fit``: write calibration.toml of lubfric anew. ``... pairs COUNT``: extend the table of pairs of similar
contacts; ``... lengths COUNT``: the table of contacts with other correlation lengths."""

import math
import time
from collections.abc import Sequence
from pathlib import Path

from .. import extending

# isort: split
from . import fit, lengths, pairs
from .table import TABLES, extend, to_repeat


def main() -> None:
    """Run the command."""
    p = extending.parser("verification.campaigns.calibration", __doc__)
    p.add_argument("motion", choices=("rest", "rolling", "numbers", "fit", "pairs", "lengths"))
    p.add_argument("count", type=int, nargs="?", default=0, help="number of cases that the table shall have")
    p.add_argument("--repeat", type=int, default=0, help="solve the known cases on the map of this repeat (1, 2, ...)")
    p.add_argument("--first", type=int, default=0, help="number of the first case (default: %(default)s)")
    p.add_argument("--workers", type=int, default=1, help="processes that solve cases on long cells")
    p.add_argument("--seconds", type=float, default=math.inf, help="after which no case on long cells is begun")
    p.add_argument("--out", type=Path, default=TABLES, help="folder of the tables of numbers on long cells")
    options = p.parse_args()
    if options.motion == "fit":
        fit.write()
        return
    if options.motion == "numbers":
        ends = time.monotonic() + options.seconds
        for motion in reversed(fit.MOTIONS):  # those that take longer first
            file = fit.numbers_file(motion, options.out)
            fit.solve_numbers(file, motion, workers=options.workers, seconds=ends - time.monotonic())
        return
    if options.motion == "pairs":
        for motion in fit.MOTIONS:
            for row in pairs.extend(motion, options.count, options.budget):
                end = row["failure"] or f"{row['quick_error']:.3f} {row['quick_other_error']:.3f}"
                print(
                    f"{motion} {row['number']} {row['key']} {row['factor']} {row['seconds']:.1f} s: {end}", flush=True
                )
        return
    if options.motion == "lengths":
        for motion in fit.MOTIONS:
            for row in lengths.extend(motion, options.count, options.budget):
                print(f"{motion} {row['seed']} {row['factor']} {row['seconds']:.1f} s: {row['f']:.4f}", flush=True)
        return
    seeds: Sequence[int] = range(options.first, options.count)
    if options.repeat:
        seeds = to_repeat(options.motion)
    for row in extend(options.motion, seeds, options.budget, repeat=options.repeat):
        end = row["failure"] or f"{row['ls_f']:.4f} {row['det_f']:.4f}"
        print(f"{row['motion']} {row['seed']} {row['fluid']} {row['lay']} {row['seconds']:.1f} s: {end}", flush=True)


if __name__ == "__main__":
    main()
