"""``python -m verification tables``: the tables of numbers in the documents, measured and written by this command.

A document says where a table stands by two comments, ``<!-- table: NAME -->`` and ``<!-- end of table -->``. What
stands between them is replaced by what is measured now, with the command, the date, the version and the machine
beneath. Each table is written as soon as it is measured.
"""

from __future__ import annotations

import inspect
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

from ..check import AT_LEAST, Check, Item, Table
from ..frame import Command
from ..frame import main as run
from ..studies import Study
from . import folders, measured, studies
from .measured import Cells
from .pages import put

TABLES: dict[str, Callable[[], Cells]] = measured.TABLES | studies.TABLES | folders.TABLES
LEVELS = ("default",)


def main(argv: list[str]) -> int:
    """The command."""
    target = "verification.tables:written"
    listed = tuple(Study(name, target, caption(name), LEVELS, {"name": name}) for name in TABLES)
    command = Command("tables", __doc__, listed, "out/tables", LEVELS, 0, _options, _prepared)
    return run(command, argv)


def caption(name: str) -> str:
    """The first sentence on a table, by its function."""
    return (inspect.getdoc(TABLES[name]) or name).split("\n")[0]


def written(level: str, name: str, docs: Path) -> Iterator[Item]:
    """One table, measured and put where the pages of the folder ``docs`` name it."""
    table = Table(name, caption(name), *TABLES[name]())
    yield table
    put(docs, table, f"python -m verification tables --only {name}")
    yield Check(f"{name}: rows", len(table.rows), 1, 0.0, "a table says something", AT_LEAST)


def _options(parser: ArgumentParser) -> None:
    words = "folder of the documents (default: %(default)s)"
    parser.add_argument("--docs", type=Path, default=Path("docs"), metavar="DIR", help=words)


def _prepared(study: Study, options: Namespace) -> Study:
    return replace(study, options=study.options | {"docs": options.docs})
