"""``python -m verification.campaigns.calibration rest|rolling COUNT [--budget S]``: extend a table of solved cases.
``... fit [--solve all|missing]``: write calibration.toml of lubfric anew; with ``--solve`` the numbers on long cells too."""

from collections.abc import Sequence

from .. import extending

# isort: split
from . import fit
from .table import extend, to_repeat


def main() -> None:
    """Run the command."""
    p = extending.parser("verification.campaigns.calibration", __doc__)
    p.add_argument("motion", choices=("rest", "rolling", "fit"))
    p.add_argument("count", type=int, nargs="?", default=0, help="number of cases that the table shall have")
    p.add_argument("--repeat", type=int, default=0, help="solve the known cases on the map of this repeat (1, 2, ...)")
    p.add_argument("--first", type=int, default=0, help="number of the first case (default: %(default)s)")
    p.add_argument(
        "--solve", choices=("all", "missing"), help="solve cases on long cells by today's model before the fit"
    )
    options = p.parse_args()
    if options.motion == "fit":
        for motion in fit.MOTIONS if options.solve else ():
            fit.solve_numbers(motion, again=options.solve == "all")
        fit.write()
        return
    seeds: Sequence[int] = range(options.first, options.count)
    if options.repeat:
        seeds = to_repeat(options.motion)
    for row in extend(options.motion, seeds, options.budget, repeat=options.repeat):
        end = row["failure"] or f"{row['ls_f']:.4f} {row['det_f']:.4f}"
        print(f"{row['motion']} {row['seed']} {row['fluid']} {row['lay']} {row['seconds']:.1f} s: {end}", flush=True)


if __name__ == "__main__":
    main()
