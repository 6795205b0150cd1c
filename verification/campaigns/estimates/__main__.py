"""``python -m verification.campaigns.estimates COUNT [--workers N] [--seconds S] [--docs docs]``: extend the table of
runs, and show how far the estimates are from them."""

from .. import extending

# isort: split
from argparse import ArgumentParser
from pathlib import Path

from ...wording import markdown
from ..tables.pages import put
from .jobs import KINDS, MEASURED_KINDS, PATCH_KINDS
from .table import TABLE, estimate_again, extend, outside, table

MODULE = "verification.campaigns.estimates"


def main() -> None:
    """Run the command."""
    p = ArgumentParser(f"python -m {MODULE}", description=__doc__)
    p.add_argument("count", type=int, help="number of runs that the table shall have")
    p.add_argument("--first", type=int, default=0, help="number of the first run (default: %(default)s)")
    kinds = [*KINDS, *PATCH_KINDS, *MEASURED_KINDS]
    p.add_argument("--kinds", nargs="+", default=kinds, choices=kinds, help="default: all")
    p.add_argument("--table", type=Path, default=TABLE, help="file of the table (default: %(default)s)")
    extending.add_processes(p)
    p.add_argument("--again", action="store_true", help="estimate the runs of the table again; none of them is done")
    p.add_argument(
        "--docs", type=Path, metavar="DIR", help="write the table into the pages of this folder that name it"
    )
    options = p.parse_args()
    if options.again:
        estimate_again(options.table)
    for row in extend(options.count, options.seconds, options.workers, options.kinds, options.table, options.first):
        taken = row["failure"] or f"{row['seconds']:.3g} s"
        print(f"{row['seed']} {row['kind']}: estimated {row.get('estimate', float('nan')):.3g} s, {taken}", flush=True)
    result = table(options.table)
    print(markdown(result.columns, result.rows), *outside(options.table), sep="\n")
    if options.docs:
        put(options.docs, table(options.table, brief=True), f"python -m {MODULE} {options.count}")


if __name__ == "__main__":
    main()
