"""One figure as files, and the page that shows them all."""

from __future__ import annotations

import csv
import html
from dataclasses import dataclass, field
from pathlib import Path

DOCUMENT = """# The figures of the paper, computed here

`python -m verification figures` computes Figs. 2 to 10 of Akchurin et al., Tribol. Lett. 59:19 (2015),
[doi:10.1007/s11249-015-0536-z](https://doi.org/10.1007/s11249-015-0536-z), each as data (CSV), picture and
verdict; `--only fig6` one of them, `--quick` on small grids. This page is written by the same command
(`--docs docs`). Figs. 1 and 7 are a sketch and the measured surface, which is not published.

"""


@dataclass(frozen=True)
class PaperFigure:
    """What a figure hands over.

    name: stem of its files; title; agrees, differs: what does and what does not agree with the paper, and
    why; picture: bytes of a PNG; tables: {stem: (headings with units, rows)}, each written as a CSV file.
    """

    name: str
    title: str
    agrees: str
    differs: str
    picture: bytes
    tables: dict[str, tuple[tuple[str, ...], list[tuple]]] = field(default_factory=dict)


def write_figure(folder: Path, figure: PaperFigure) -> None:
    """``<name>.png`` and one CSV file a table."""
    (folder / f"{figure.name}.png").write_bytes(figure.picture)
    for stem, (headings, rows) in figure.tables.items():
        with (folder / f"{stem}.csv").open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(headings)
            writer.writerows([f"{v:.7g}" if isinstance(v, float) else v for v in row] for row in rows)


def write_index(folder: Path, figures: list[tuple[PaperFigure, float]], quick: bool) -> None:
    """index.md and index.html with every figure so far."""
    note = "Quick run: small grids and few cases, not for reading numbers off.\n\n" if quick else ""
    parts = [f"# The figures of the paper, computed here\n\n{note}"]
    parts += [markdown(figure, seconds) for figure, seconds in figures]
    (folder / "index.md").write_text("\n".join(parts))
    (folder / "index.html").write_text(_page(figures, note))


def write_document(folder: Path, figures: list[tuple[PaperFigure, float]]) -> None:
    """figures.md with its pictures in images/, for the documents of the project."""
    images = folder / "images"
    images.mkdir(parents=True, exist_ok=True)
    for figure, _ in figures:
        (images / f"{figure.name}.png").write_bytes(figure.picture)
    (folder / "figures.md").write_text(DOCUMENT + "\n".join(markdown(f, s, "images/") for f, s in figures))


def markdown(figure: PaperFigure, seconds: float, images: str = "") -> str:
    """The section of one figure; ``images``: folder of the picture."""
    data = ", ".join(f"`{stem}.csv`" for stem in figure.tables)
    return (
        f"## {figure.title}\n\n![{figure.title}]({images}{figure.name}.png)\n\n**Agrees.** "
        f"{figure.agrees}\n\n"
        f"**Differs, and why.** {figure.differs}\n\nData: {data}. {seconds:.0f} s.\n"
    )


def _page(figures, note) -> str:
    body = "".join(
        f"<h2>{html.escape(f.title)}</h2><img src='{f.name}.png' alt='{html.escape(f.title)}'>"
        f"<p><b>Agrees.</b> {html.escape(f.agrees)}</p><p><b>Differs, and why.</b> "
        f"{html.escape(f.differs)}</p>"
        f"<p>Data: {', '.join(f'<a href={s}.csv>{s}.csv</a>' for s in f.tables)}. {seconds:.0f} s.</p>"
        for f, seconds in figures
    )
    style = "body{font:16px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em}img{max-width:100%}"
    return (
        f"<!doctype html><html lang='en'><meta charset='utf-8'><title>Figures of the paper</title>"
        f"<style>{style}</style><h1>The figures of the paper, computed "
        f"here</h1><p>{html.escape(note)}</p>{body}"
        "</html>\n"
    )
