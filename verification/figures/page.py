"""One figure as files, and the page that shows them all."""

import textwrap
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import plotting
from ..check import Check, Figure
from ..tables.pages import source

DOCUMENT = """# The figures of the paper, computed here

`python -m verification figures` computes Figs. 2 to 10 of Akchurin et al., Tribol. Lett. 59:19 (2015),
[doi:10.1007/s11249-015-0536-z](https://doi.org/10.1007/s11249-015-0536-z), each as data (CSV), picture and
verdict. `--only fig6` makes one of them, `--quick` takes small grids. The same command writes this page
(`--docs docs`). Figs. 1 and 7 are left out: a sketch, and the measured surface, which is not published.

"""


@dataclass(frozen=True)
class PaperFigure:
    """What a figure hands over.

    name, title : stem of its files, and its heading
    agrees, differs : what agrees with the paper; what does not, and why
    canvas : the drawn figure
    tables : {stem: (headings with units, rows)}, each written as a CSV file
    checks : what has to hold whatever the paper shows
    """

    name: str
    title: str
    agrees: str
    differs: str
    canvas: Any
    tables: dict[str, tuple[tuple[str, ...], list[tuple]]]
    checks: tuple[Check, ...]


def picture(figure: PaperFigure) -> Figure:
    """The picture, small enough for the documents, with its section of the page as caption."""
    data = ", ".join(f"`{stem}.csv`" for stem in figure.tables)
    section = (
        f"## {figure.title}\n\n![{figure.title}](images/{figure.name}.png)\n\n"
        f"{wrapped(f'**Agrees.** {figure.agrees}')}\n\n"
        f"{wrapped(f'**Differs, and why.** {figure.differs}')}\n\nData: {data}.\n"
    )
    return plotting.compact(plotting.finish(figure.name, figure.canvas, section, "png", dpi=90), 144)


def write(folder: Path, figures: Iterable[Figure]) -> None:
    """Write figures.md, with the pictures in images/, into the documents of the project."""
    (folder / "images").mkdir(parents=True, exist_ok=True)
    sections = []
    for figure in figures:
        (folder / "images" / f"{figure.name}.png").write_bytes(figure.data)
        sections.append(figure.caption)
    last = source("python -m verification figures --docs docs")
    (folder / "figures.md").write_text(DOCUMENT + "\n".join(sections) + f"\n{last}\n", encoding="utf-8")


def wrapped(text: str) -> str:
    """Every paragraph and item of a list in lines of at most 118 characters."""
    lines = []
    for part in text.split("\n"):
        rest = "  " if part.startswith("- ") else ""
        lines += textwrap.wrap(part, 118, subsequent_indent=rest, break_on_hyphens=False) or [""]
    return "\n".join(lines)
