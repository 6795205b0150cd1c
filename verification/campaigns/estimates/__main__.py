"""``python -m verification.campaigns.estimates COUNT [--budget S] [--kinds KIND ...]``: extend the table of runs, and
show how far the estimates are from them."""

from .. import extending

# isort: split
from .jobs import KINDS
from .table import TABLE, extend, summary


def main() -> None:
    """Run the command."""
    p = extending.parser("verification.campaigns.estimates", __doc__, TABLE)
    p.add_argument("count", type=int, help="number of runs that the table shall have")
    p.add_argument("--first", type=int, default=0, help="number of the first run (default: %(default)s)")
    p.add_argument("--kinds", nargs="+", default=list(KINDS), choices=KINDS, help="default: all")
    options = p.parse_args()
    for row in extend(options.count, options.budget, options.kinds, options.table, options.first):
        taken = row["failure"] or f"{row['seconds']:.3g} s"
        print(f"{row['seed']} {row['kind']}: estimated {row.get('estimate', float('nan')):.3g} s, {taken}", flush=True)
    print(summary(options.table))


if __name__ == "__main__":
    main()
