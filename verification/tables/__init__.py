"""``python -m verification tables``: the tables of numbers in the documents, measured and written by this command.

A document says where a table stands by two comments, ``<!-- table: NAME -->`` and ``<!-- end of table -->``. What
stands between them is replaced by what is measured now, with the command, the date, the version and the machine
beneath; each table is written as soon as it is measured.
"""

from __future__ import annotations

import inspect
import re
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

from ..check import AT_LEAST, Check, Item, Table
from ..frame import Command
from ..frame import main as run
from ..studies import Study
from ..wording import markdown
from . import measured, sampling, studies
from .measured import Cells
from .source import source

TABLES: dict[str, Callable[[], Cells]] = measured.TABLES | studies.TABLES | sampling.TABLES
LEVELS = ("default",)
BLOCK = re.compile(r"<!-- table: (?P<name>[a-z-]+) -->\n(?P<body>.*?)<!-- end of table -->", re.DOTALL)


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
    for page in sorted(docs.glob("*.md")):
        text = page.read_text(encoding="utf-8")
        new = replaced(text, name, body(table))
        if new != text:
            page.write_text(new, encoding="utf-8")
    yield Check(f"{name}: rows", len(table.rows), 1, 0.0, "a table says something", AT_LEAST)


def replaced(text: str, name: str, new: str) -> str:
    """``text`` with the table ``name`` replaced; the comments around it stay."""

    def put(match: re.Match) -> str:
        return f"<!-- table: {name} -->\n{new}<!-- end of table -->" if match["name"] == name else match[0]

    return BLOCK.sub(put, text)


def body(table: Table) -> str:
    """A table as Markdown, and the line beneath that says where it comes from."""
    return f"\n{markdown(table.columns, table.rows)}\n\n{source(f'tables --only {table.name}')}\n\n"


def _options(parser: ArgumentParser) -> None:
    words = "folder of the documents (default: %(default)s)"
    parser.add_argument("--docs", type=Path, default=Path("docs"), metavar="DIR", help=words)


def _prepared(study: Study, options: Namespace) -> Study:
    return replace(study, options=study.options | {"docs": options.docs})
