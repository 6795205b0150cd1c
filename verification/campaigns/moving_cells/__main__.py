"""``python -m verification.campaigns.moving_cells [--halvings N] [--seeds N] [--random A B]``: extend the table."""

from .. import extending

# isort: split
from .table import TABLE, errors, extend, jobs_left


def main() -> None:
    """Run the command."""
    p = extending.parser("verification.campaigns.moving_cells", __doc__, TABLE)
    p.add_argument("--halvings", type=int, default=2, help="of the cells along x, at most (default: %(default)s)")
    p.add_argument("--seeds", type=int, default=1, help="surfaces of each contact (default: %(default)s)")
    p.add_argument(
        "--random", type=int, nargs=2, default=[0, 0], help="first random contact, and the one after the last"
    )
    extending.add_processes(p)
    options = p.parse_args()
    jobs = jobs_left(options.halvings, options.seeds, range(*options.random), options.table)
    extending.show(extend(jobs, options.seconds, options.table, options.workers))
    extending.show(errors(options.table))


if __name__ == "__main__":
    main()
