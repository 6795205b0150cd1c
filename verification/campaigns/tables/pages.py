"""The marks around a table in a page, and how a new table is written between them.

The marks are two comments, ``<!-- table: NAME -->`` and ``<!-- end of table -->``. All text between them is replaced.
Tables come from `verification.campaigns.tables`, from campaigns (`CAMPAIGNS`) and from the scripts of
`verification.campaigns.benchmarks` (`BENCHMARKS`).
"""

import re
import time
from pathlib import Path

from ...check import Table
from ...wording import markdown

BLOCK = re.compile(r"<!-- table: (?P<name>[a-z-]+) -->\n(?P<body>.*?)<!-- end of table -->", re.DOTALL)
BENCHMARKS = {
    "chosen-speeds": "chosen_speeds",
    "contact-aspher": "contact_vs_aspher",
    "contact-constants": "contact_constants",
    "film-times": "ehl_times",
    "opened": "opened",
    "rolling-costs": "rolling_costs",
    "stores": "stores",
    "study-points": "study",
}
CAMPAIGNS = {  # command: its tables
    "calibration": ("calibration", "paper-limit"),
    "charts": ("contact-methods",),
    "estimates": ("estimates",),
    "model": (
        "answers",
        "answers-rollers",
        "answers-moving",
        "answers-seeds",
        "refinement",
        "boundary-film",
        "rolling",
        "running-in",
    ),
    "sampling": ("sampling-coverage", "sampling-numbers"),
    "stability": ("stability-film", "stability-contact", "stability-sharing", "stability-whole"),
}


def put(docs: Path, table: Table, command: str) -> None:
    """Write ``table``, and the ``command`` that measured it, into every page of the folder ``docs`` that names it."""
    for page in sorted(docs.glob("*.md")):
        text = page.read_text(encoding="utf-8")
        new = replaced(text, table.name, body(table, command))
        if new != text:
            page.write_text(new, encoding="utf-8")


def replaced(text: str, name: str, new: str) -> str:
    """``text`` with the table ``name`` replaced; the comments around it stay."""

    def one(match: re.Match[str]) -> str:
        return f"<!-- table: {name} -->\n{new}<!-- end of table -->" if match["name"] == name else match[0]

    return BLOCK.sub(one, text)


def body(table: Table, command: str) -> str:
    """A table as Markdown, and the line beneath that says where it comes from."""
    return f"\n{markdown(table.columns, table.rows)}\n\n{source(command)}\n\n"


def source(command: str) -> str:
    """Return one line in italics: the command, the day and the version. The machine is on the page on verification."""
    from lubfric import __version__

    typed = command.removesuffix(" --docs docs")
    return f"*`{typed}`, {time.strftime('%Y-%m-%d')}, lubfric {__version__}.*"
