"""``python -m verification tables``: the tables of numbers in the documents, measured and written by this command.

A document says where a table stands by two comments, ``<!-- table: NAME -->`` and ``<!-- end of table -->``. What
stands between them is replaced by what is measured now, with the command, the date, the version and the machine
beneath.
"""

from __future__ import annotations

import argparse
import re
import sys
import time
from pathlib import Path

from . import measured, sampling, studies
from .measured import Table
from .source import source

TABLES = measured.TABLES | studies.TABLES | sampling.TABLES
BLOCK = re.compile(r"<!-- table: (?P<name>[a-z-]+) -->\n(?P<body>.*?)<!-- end of table -->", re.DOTALL)


def main(argv: list[str]) -> int:
    """Exit code 0: every table asked for was measured and written."""
    options = parser().parse_args(argv)
    if options.list:
        print("\n".join(options.only or TABLES))
        return 0
    wanted = set(options.only or TABLES)
    for page in sorted(options.docs.glob("*.md")):
        text = page.read_text(encoding="utf-8")
        names = [match["name"] for match in BLOCK.finditer(text) if match["name"] in wanted]
        for name in names:
            begun = time.perf_counter()
            text = replaced(text, name, body(name, TABLES[name]()))
            print(f"{page.name}: {name} ({time.perf_counter() - begun:.1f} s)", file=sys.stderr, flush=True)
            page.write_text(text, encoding="utf-8")
    return 0


def replaced(text: str, name: str, new: str) -> str:
    """``text`` with the table ``name`` replaced; the comments around it stay."""

    def put(match: re.Match) -> str:
        return f"<!-- table: {name} -->\n{new}<!-- end of table -->" if match["name"] == name else match[0]

    return BLOCK.sub(put, text)


def body(name: str, table: Table) -> str:
    """A table as Markdown, and the line beneath that says where it comes from."""
    rows = [table.columns, ["---"] * len(table.columns), *table.rows]
    lines = ["| " + " | ".join(cell.replace("|", r"\|") for cell in row) + " |" for row in rows]
    return "\n" + "\n".join(lines) + f"\n\n{source(f'tables --only {name}')}\n\n"


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = argparse.ArgumentParser("python -m verification tables", description=__doc__)
    p.add_argument("--only", nargs="+", choices=list(TABLES), metavar="TABLE", help=f"of {', '.join(TABLES)}")
    p.add_argument("--docs", type=Path, default=Path("docs"), metavar="DIR", help="folder of the documents")
    p.add_argument("--list", action="store_true", help="name the tables and stop")
    return p
