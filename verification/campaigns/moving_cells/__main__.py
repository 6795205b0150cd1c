"""``python -m verification.campaigns.moving_cells [--halvings N] [--seeds N] [--budget S]``: extend the table."""

from .. import extending

# isort: split
from .table import TABLE, errors, extend


def main() -> None:
    """Run the command."""
    p = extending.parser("verification.campaigns.moving_cells", __doc__, TABLE)
    p.add_argument("--halvings", type=int, default=2, help="of the cells along x, at most (default: %(default)s)")
    p.add_argument("--seeds", type=int, default=1, help="surfaces of each contact (default: %(default)s)")
    options = p.parse_args()
    extending.show(extend(options.halvings, options.seeds, options.budget, options.table))
    extending.show(errors(options.table))


if __name__ == "__main__":
    main()
