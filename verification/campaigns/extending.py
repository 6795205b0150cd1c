"""What the commands of the campaigns share whose table a run extends, one solved case after another.

Linear algebra takes one thread, which this module sets: import it before whatever loads NumPy.
"""

import argparse
import os
from collections.abc import Iterable
from pathlib import Path

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

# Processor time [s] of a run, unless the command states it: an hour.
BUDGET = 3600.0


def parser(package: str, description: str | None, table: Path | None = None) -> argparse.ArgumentParser:
    """Return the parser of ``python -m package`` with the option ``--budget`` and, where the campaign has one ``table``
    that the user may place elsewhere, ``--table``."""
    result = argparse.ArgumentParser(f"python -m {package}", description=description)
    result.add_argument(
        "--budget", type=float, default=BUDGET, metavar="S", help="processor time [s] (default: %(default)s)"
    )
    if table is not None:
        result.add_argument("--table", type=Path, default=table, help="file of the table (default: %(default)s)")
    return result


def show(rows: Iterable[object]) -> None:
    """Print each row when it is solved."""
    for row in rows:
        print(row, flush=True)
