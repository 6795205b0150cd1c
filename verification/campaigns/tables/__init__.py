"""``python -m verification tables``: the tables of numbers in the documents, measured and written by this command.

Two comments in a document mark the place of a table (`pages`). The text between them is replaced by the new
measurement, with the command, the date, the version and the machine below it. The tables of longer campaigns
(`pages.CAMPAIGNS`) are written by those, with ``--docs docs``.
"""

import inspect
from argparse import ArgumentParser
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

from ... import frame
from ...check import AT_LEAST, Check, Item, Table
from ...kept import Run
from . import measured, studies
from .measured import Cells

TABLES: dict[str, Callable[[], Cells]] = measured.TABLES | studies.TABLES


def caption(name: str) -> str:
    """Return what a table shows: the title of its study, or the first line on its function."""
    table = TABLES[name]
    if isinstance(table, partial):
        return studies.title_of(table)
    first_line = (inspect.getdoc(table) or name).split("\n")[0].removeprefix("Return ").rstrip(".")
    return first_line[:1].upper() + first_line[1:] if not first_line.startswith("f ") else first_line


def written(level: str, name: str, run: Run = Run()) -> Iterator[Item]:
    """One table, measured now."""
    columns, rows = TABLES[name]()
    yield Table(name, caption(name), columns, rows)
    yield Check(f"{name}: rows", len(rows), expected=1, tolerance=0.0, source="a table says something", kind=AT_LEAST)


def _options(parser: ArgumentParser) -> None:
    parser.set_defaults(docs=Path("docs"))


PARTS = [(name, "tables:written", caption(name), {"name": name}) for name in TABLES]
COMMAND = frame.campaign("tables", __doc__, PARTS, ("default",), _options)
