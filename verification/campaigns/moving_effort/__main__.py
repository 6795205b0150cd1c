"""``python -m verification.campaigns.moving_effort COUNT [--budget S]``: extend the table of solved cases."""

from pathlib import Path

from .. import extending

# isort: split
from .table import TABLE, VARIANTS, extend


def main() -> None:
    """Run the command."""
    p = extending.parser("verification.campaigns.moving_effort", __doc__)
    p.add_argument("count", type=int, help="number of cases that the table shall have")
    p.add_argument("--variants", nargs="+", default=list(VARIANTS), choices=VARIANTS, help="default: all")
    p.add_argument("--table", type=Path, default=TABLE, help="default: beside this module")
    options = p.parse_args()
    rows = extend(options.count, options.budget, options.variants, options.table)
    extending.show(
        f"{row['seed']} {row['variant']}: {row['failure'] or row['f']}, {row['seconds']:.2f} s" for row in rows
    )


if __name__ == "__main__":
    main()
