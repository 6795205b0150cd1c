"""The table of a campaign that goes on where it stopped: rows are read as text, and appended one by one."""

import csv
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..types import PlainRow


def rows(file: Path) -> list[dict[str, str]]:
    """Return the rows of the table in ``file`` as text; none where there is no file yet."""
    if not file.is_file():
        return []
    with file.open(newline="") as stream:
        return list(csv.DictReader(stream))


def append(file: Path, columns: Sequence[str], row: PlainRow, digits: int) -> None:
    """Append the ``columns`` of ``row`` to the table in ``file``, which begins with their names; a number that is no
    integer has so many ``digits``, None is an empty cell."""
    is_new = not file.is_file()
    with file.open("a", newline="") as stream:
        writer = csv.DictWriter(stream, list(columns))
        if is_new:
            writer.writeheader()
        writer.writerow({name: _as_text(row.get(name), digits) for name in columns})


def _as_text(value: object, digits: int) -> object:
    return f"{value:.{digits}g}" if isinstance(value, (float, np.floating)) else value
