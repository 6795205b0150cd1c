"""How the scripts of this folder put their tables into the pages of the documents."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from pathlib import Path

from ...check import Table
from ..tables.pages import BENCHMARKS, put


def add_option(parser: ArgumentParser) -> None:
    """``--docs DIR``: the folder of the pages."""
    words = "write the table into the pages of this folder that name it"
    parser.add_argument("--docs", type=Path, metavar="DIR", help=words)


def write(
    name: str, columns: Sequence[str], rows: Sequence[Sequence[str]], command_line: tuple[ArgumentParser, Namespace]
) -> None:
    """Write the table ``name`` into the folder of ``--docs``, if it was given; ``asked``: the parser and its result."""
    parser, options = command_line
    if options.docs:
        put(options.docs, Table(name, name, columns, rows), command(name, parser, options))


def command(name: str, parser: ArgumentParser, options: Namespace) -> str:
    """Return the command as it was typed, without files and folders but those of the documents. An argument without a
    dash is named."""
    words = ["python", "-m", f"verification.campaigns.benchmarks.{BENCHMARKS[name]}"]
    named = [action.dest for action in parser._get_positional_actions()]
    words += [key.upper() for key in named if getattr(options, key) != parser.get_default(key)]
    for key, value in vars(options).items():
        given = value if isinstance(value, list) else [value]
        if key in named or value == parser.get_default(key) or any(isinstance(v, Path) for v in given):
            continue
        words += [f"--{key}", *(f"{v:g}" if isinstance(v, float) else str(v) for v in given)]
    return " ".join([*words, "--docs docs"])
