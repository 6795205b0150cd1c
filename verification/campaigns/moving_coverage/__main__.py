"""``python -m verification.campaigns.moving_coverage [--seeds N] [--random A B]``: extend the tables of answers and references."""

from pathlib import Path

from .. import extending

# isort: split
from .contacts import contacts
from .table import FOLDER, covered, extend, jobs_left


def main() -> None:
    """Run the command."""
    p = extending.parser("verification.campaigns.moving_coverage", __doc__)
    p.add_argument("--seeds", type=int, default=10, help="surfaces of each contact (default: %(default)s)")
    p.add_argument("--folder", type=Path, default=FOLDER, help="of both tables (default: %(default)s)")
    p.add_argument("--contacts", nargs="+", default=[], help="of those with names (default: all)")
    p.add_argument(
        "--random", type=int, nargs=2, default=[0, 0], help="first random contact, and the one after the last"
    )
    p.add_argument("--references", type=int, default=3, help="strips of each reference (default: %(default)s)")
    p.add_argument("--narrow", type=int, default=3, help="strips on shorter cells of each (default: %(default)s)")
    extending.add_processes(p)
    options = p.parse_args()
    names = options.contacts or [contact.name for contact in contacts()]
    names += [f"random {number}" for number in range(*options.random)]
    jobs = jobs_left(options.seeds, options.folder, names, references=options.references, narrow=options.narrow)
    extending.show(extend(jobs, options.seconds, options.folder, options.workers))
    extending.show(covered(options.folder))


if __name__ == "__main__":
    main()
