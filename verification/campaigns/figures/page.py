"""One figure as files, and the section of a page that shows them all."""

import re
import textwrap
from collections.abc import Iterable
from pathlib import Path

from matplotlib.figure import Figure as Canvas

from ... import plotting
from ...check import Figure
from ..tables.pages import source

SECTION = re.compile(r"(?<=<!-- figures -->\n).*(?=<!-- end of figures -->)", re.DOTALL)


def picture(name: str, title: str, agrees: str, differs: str, canvas: Canvas) -> Figure:
    """Return the drawn figure, small enough for the documents, with its section of the page as caption: what agrees
    with the paper, and what does not, and why."""
    section = (
        f"### {title}\n\n![{name}](images/{name}.png)\n\n"
        f"{wrapped(f'**Agrees.** {agrees}')}\n\n{wrapped(f'**Differs, and why.** {differs}')}\n"
    )
    return plotting.compact(plotting.finish(name, canvas, section, "png", dpi=90), 144)


def write(folder: Path, figures: Iterable[Figure]) -> None:
    """Write the section of figures in paper.md, and the pictures in images/, in the folder of the pages."""
    (folder / "images").mkdir(parents=True, exist_ok=True)
    sections = []
    for figure in figures:
        (folder / "images" / f"{figure.name}.png").write_bytes(figure.data)
        sections.append(figure.caption)
    last = source("python -m verification figures --docs docs")
    page = folder / "paper.md"
    text = SECTION.sub(lambda _: "\n" + "\n".join(sections) + f"\n{last}\n\n", page.read_text(encoding="utf-8"))
    page.write_text(text, encoding="utf-8")


def wrapped(text: str) -> str:
    """Return every paragraph and item of a list in lines of at most 118 characters."""
    lines = []
    for part in text.split("\n"):
        indent = "  " if part.startswith("- ") else ""
        lines += textwrap.wrap(part, 118, subsequent_indent=indent, break_on_hyphens=False) or [""]
    return "\n".join(lines)
