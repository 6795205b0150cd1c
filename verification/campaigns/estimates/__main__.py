"""``python -m verification.campaigns.estimates COUNT [--budget S] [--workers N] [--docs docs]``: extend the table of runs,
and show how far the estimates are from them."""

from .. import extending

# isort: split
from pathlib import Path

from ...wording import markdown
from ..tables.pages import put
from .jobs import KINDS
from .table import TABLE, estimate_again, extend, outside, table

MODULE = "verification.campaigns.estimates"


def main() -> None:
    """Run the command."""
    p = extending.parser(MODULE, __doc__, TABLE, budget="time [s] after which no run begins")
    p.add_argument("count", type=int, help="number of runs that the table shall have")
    p.add_argument("--first", type=int, default=0, help="number of the first run (default: %(default)s)")
    p.add_argument("--kinds", nargs="+", default=list(KINDS), choices=KINDS, help="default: all")
    p.add_argument("--workers", type=int, default=1, help="processes that share the runs (default: %(default)s)")
    p.add_argument("--again", action="store_true", help="estimate the runs of the table again; none of them is done")
    p.add_argument(
        "--docs", type=Path, metavar="DIR", help="write the table into the pages of this folder that name it"
    )
    options = p.parse_args()
    if options.again:
        estimate_again(options.table)
    kinds = options.kinds
    for row in extend(options.count, options.budget, kinds, options.table, options.first, workers=options.workers):
        taken = row["failure"] or f"{row['seconds']:.3g} s"
        print(f"{row['seed']} {row['kind']}: estimated {row.get('estimate', float('nan')):.3g} s, {taken}", flush=True)
    result = table(options.table)
    print(markdown(result.columns, result.rows), *outside(options.table), sep="\n")
    if options.docs:
        put(options.docs, result, f"python -m {MODULE} {options.count} --docs docs")


if __name__ == "__main__":
    main()
