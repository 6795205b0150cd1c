"""Tables of results as comma-separated text: written with units in the heading, and read back."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np

from ..errors import InputError
from .validate import shown

IN_WORDS = ("validity", "uncertainty")  # columns


def table_bytes(columns: dict[str, np.ndarray | list[str]]) -> bytes:
    """``columns`` by heading as comma-separated text."""
    file = io.StringIO(newline="")
    writer = csv.writer(file)
    writer.writerow(columns)
    writer.writerows(zip(*(np.asarray(values, dtype=object).tolist() for values in columns.values())))
    return file.getvalue().encode()


class Columns(dict):
    """Columns of a table by name; a missing one is an `InputError`."""

    def __missing__(self, name: str):
        raise InputError(f"the table has no column {name!r}; give a table that 'lubfric run' wrote")


def read_table(path: Path) -> Columns:
    """The columns that `table_bytes` wrote, by name. Raises `InputError` for a damaged table or another one."""
    try:
        with Path(path).open(encoding="utf-8", newline="") as file:
            heading, *rows = list(csv.reader(file))
        columns = {name.split(" [")[0]: [row[i] for row in rows] for i, name in enumerate(heading)}
        return Columns({n: np.array(c, str if n in IN_WORDS else float) for n, c in columns.items()})
    except (ValueError, IndexError, csv.Error) as problem:
        raise InputError(
            f"{path} is no table of numbers, or torn ({shown(str(problem))}); give a table that 'lubfric run' wrote"
        ) from None
