"""``python -m verification.campaigns.moving_coverage [--answers N] [--random A B]``: extend the tables of answers and
references."""

from pathlib import Path

from .. import extending

# isort: split
from .contacts import RANDOM, contacts
from .table import FOLDER, covered, extend, jobs_left

# Rows of a contact with a name, and of a random one: answers, strips of the reference, and narrow strips on shorter
# cells.
COUNTS = {"answers": (10, 3), "strips": (3, 3), "narrow": (3, 3)}


def main() -> None:
    """Run the command."""
    p = extending.parser("verification.campaigns.moving_coverage", __doc__)
    p.add_argument("--folder", type=Path, default=FOLDER, help="of both tables (default: %(default)s)")
    p.add_argument(
        "--contacts", nargs="*", default=[contact.name for contact in contacts()], help="names (default: all)"
    )
    p.add_argument(
        "--random", type=int, nargs=2, default=[0, 0], help="first random contact, and the one after the last"
    )
    for name, (count, of_random) in COUNTS.items():
        p.add_argument(f"--{name}", type=int, default=count, help=f"of each contact with a name (default: {count})")
        p.add_argument(
            f"--random-{name}", type=int, default=of_random, help=f"of each random one (default: {of_random})"
        )
    extending.add_processes(p)
    options = p.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    numbers = [f"{RANDOM}{number}" for number in range(*options.random)]
    jobs = jobs_left(options.folder, numbers, **{name: getattr(options, f"random_{name}") for name in COUNTS})
    jobs += jobs_left(options.folder, options.contacts, **{name: getattr(options, name) for name in COUNTS})
    jobs.sort(key=lambda job: job.seed)
    extending.show(extend(jobs, options.seconds, options.folder, options.workers))
    extending.show(covered(options.folder))


if __name__ == "__main__":
    main()
