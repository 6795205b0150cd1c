"""``python -m verification.campaigns.moving_coverage [--seeds N] [--budget S]``: extend the tables of answers and references."""

from pathlib import Path

from .. import extending

# isort: split
from .table import FOLDER, covered, extend


def main() -> None:
    """Run the command."""
    p = extending.parser("verification.campaigns.moving_coverage", __doc__)
    p.add_argument("--seeds", type=int, default=10, help="surfaces of each contact (default: %(default)s)")
    p.add_argument("--folder", type=Path, default=FOLDER, help="of both tables (default: %(default)s)")
    p.add_argument("--contacts", nargs="+", default=[], help="names (default: all)")
    p.add_argument("--answers", action="store_true", help="no references")
    options = p.parse_args()
    rows = extend(options.seeds, options.budget, options.folder, options.contacts, references=not options.answers)
    extending.show(rows)
    extending.show(covered(options.folder))


if __name__ == "__main__":
    main()
