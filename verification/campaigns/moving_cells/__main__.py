"""``python -m verification.campaigns.moving_cells [--halvings N] [--seeds N] [--budget S]``: extend the table."""

import argparse
import os
import sys
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# isort: split
from .table import TABLE, errors, extend


def main() -> int:
    """Run the command and return its exit code."""
    p = argparse.ArgumentParser("python -m verification.campaigns.moving_cells", description=__doc__)
    p.add_argument("--halvings", type=int, default=2, help="of the cells along x, at most (default: %(default)s)")
    p.add_argument("--seeds", type=int, default=1, help="surfaces of each contact (default: %(default)s)")
    p.add_argument("--budget", type=float, default=3600.0, help="processor time [s] (default: %(default)s)")
    p.add_argument("--table", type=Path, default=TABLE, help="default: beside this module")
    options = p.parse_args()
    for row in extend(options.halvings, options.seeds, options.budget, options.table):
        print(row, flush=True)
    for row in errors(options.table):
        print(row)
    return 0


if __name__ == "__main__":
    sys.exit(main())
