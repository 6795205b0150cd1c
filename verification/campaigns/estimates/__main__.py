"""``python -m verification.campaigns.estimates COUNT [--budget S] [--kinds KIND ...]``: extend the table of runs, and
show how far the estimates are from them."""

import argparse
import os
import sys
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# isort: split
from .jobs import KINDS
from .table import TABLE, extend, summary


def main() -> int:
    """Run the command and return its exit code."""
    p = argparse.ArgumentParser("python -m verification.campaigns.estimates", description=__doc__)
    p.add_argument("count", type=int, help="number of runs that the table shall have")
    p.add_argument("--first", type=int, default=0, help="number of the first run (default: %(default)s)")
    p.add_argument("--budget", type=float, default=3600.0, help="processor time [s] (default: %(default)s)")
    p.add_argument("--kinds", nargs="+", default=list(KINDS), choices=KINDS, help="default: all")
    p.add_argument("--table", type=Path, default=TABLE, help="file of the table (default: %(default)s)")
    options = p.parse_args()
    for row in extend(options.count, options.budget, options.kinds, options.table, options.first):
        taken = row["failure"] or f"{row['seconds']:.3g} s"
        print(f"{row['seed']} {row['kind']}: estimated {row.get('estimate', float('nan')):.3g} s, {taken}", flush=True)
    print(summary(options.table))
    return 0


if __name__ == "__main__":
    sys.exit(main())
