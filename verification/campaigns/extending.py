"""What the commands of the campaigns share whose table a run extends, one solved case after another.

Linear algebra takes one thread, which this module sets: import it before whatever loads NumPy.
"""

import argparse
import os
import time
from collections.abc import Iterable, Iterator, Sequence
from multiprocessing import TimeoutError, get_context
from pathlib import Path
from typing import Protocol

from ..types import PlainRow

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


def add_processes(result: argparse.ArgumentParser) -> None:
    """Add to a parser the options of a campaign whose rows are solved in several processes."""
    result.add_argument("--workers", type=int, default=1, help="number of processes (default: %(default)s)")
    result.add_argument(
        "--seconds", type=float, default=BUDGET, help="elapsed time after which it ends [s] (default: %(default)s)"
    )


def show(rows: Iterable[object]) -> None:
    """Print each row when it is solved."""
    for row in rows:
        print(row, flush=True)


class Job(Protocol):
    """What one row of a table takes."""

    def row(self) -> PlainRow:
        """Return the row, solved."""


def row_of(job: Job) -> PlainRow:
    """Return the row of ``job``."""
    return job.row()


def solved_in_processes(jobs: Sequence[Job], seconds: float, workers: int) -> Iterator[PlainRow]:
    """Yield the rows of ``jobs``, solved in so many processes, as they come; after so many ``seconds`` of elapsed time
    those that are not ready are left out, and their processes end."""
    end = time.monotonic() + seconds
    with get_context("spawn").Pool(workers) as pool:
        rows = pool.imap_unordered(row_of, jobs)
        for _ in jobs:
            try:
                yield rows.next(max(0.0, end - time.monotonic()))
            except TimeoutError:
                return
