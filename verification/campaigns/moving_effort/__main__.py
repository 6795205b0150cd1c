"""``python -m verification.campaigns.moving_effort COUNT [--budget S]``: extend the table of solved cases."""

import argparse
import os
import sys

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# isort: split
from .table import VARIANTS, extend


def main() -> int:
    """Run the command and return its exit code."""
    p = argparse.ArgumentParser("python -m verification.campaigns.moving_effort", description=__doc__)
    p.add_argument("count", type=int, help="number of cases that the table shall have")
    p.add_argument("--budget", type=float, default=3600.0, help="processor time [s] (default: %(default)s)")
    p.add_argument("--variants", nargs="+", default=list(VARIANTS), choices=VARIANTS, help="default: all")
    options = p.parse_args()
    for row in extend(options.count, options.budget, options.variants):
        f = row["f"] if not row["failure"] else row["failure"]
        print(f"{row['seed']} {row['variant']}: {f}, {row['seconds']:.2f} s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
