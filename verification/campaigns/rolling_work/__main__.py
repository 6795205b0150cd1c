"""``python -m verification.campaigns.rolling_work COUNT [--workers N] [--seconds S]``: extend the table, and print the
fit."""

from argparse import ArgumentParser
from pathlib import Path

from .. import extending

# isort: split
from .table import CELLS, TABLE, extend, fitted, parts_within

MODULE = "verification.campaigns.rolling_work"


def main() -> None:
    """Run the command."""
    p = ArgumentParser(f"python -m {MODULE}", description=__doc__)
    p.add_argument("count", type=int, help="number of contacts that the table shall have")
    p.add_argument("--cells", nargs="+", default=list(CELLS), choices=CELLS, help="default: all")
    p.add_argument("--table", type=Path, default=TABLE, help="file of the table (default: %(default)s)")
    extending.add_processes(p)
    options = p.parse_args()
    extending.show(extend(options.count, options.seconds, options.workers, options.table, options.cells))
    print("coefficients of lubfric/models/deterministic/expected_steps_in_time.py:", fitted(options.table))
    extending.show(f"within {factor:g}: {100 * part:.0f} %" for factor, part in parts_within(options.table).items())


if __name__ == "__main__":
    main()
