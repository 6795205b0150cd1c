"""``python -m verification.campaigns.moving_coverage [--seeds N] [--budget S]``: extend the tables of answers and references."""

import argparse
import os
import sys
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# isort: split
from .table import EXTENDED, covered, extend


def main() -> int:
    """Run the command and return its exit code."""
    p = argparse.ArgumentParser("python -m verification.campaigns.moving_coverage", description=__doc__)
    p.add_argument("--seeds", type=int, default=10, help="surfaces of each contact (default: %(default)s)")
    p.add_argument("--budget", type=float, default=3600.0, help="processor time [s] (default: %(default)s)")
    p.add_argument("--folder", type=Path, default=EXTENDED, help="of both tables (default: %(default)s)")
    options = p.parse_args()
    for row in extend(options.seeds, options.budget, options.folder):
        print(row, flush=True)
    for row in covered(options.folder):
        print(row)
    return 0


if __name__ == "__main__":
    sys.exit(main())
