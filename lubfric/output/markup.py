"""Pieces of a report in HTML: paragraphs, lists, figures, and tables with their headings and cells."""

import base64
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape

from ..quantities import COLUMNS
from ..units import plain_number, printed

# Heading of the column of the intervals of f.
INTERVAL_OF_F = "95 % interval of f"
# Heading of the column of the asperity load ratio.
ASPERITY_LOAD_RATIO = "asperity load ratio F_C/F_T"
# Columns of a table that a narrow screen shows as they are. A choice, by looking at the report.
NARROW_COLUMNS = 3
# Columns of a table from which on its numbers may wrap, so that it fits a page. A choice, by looking at the report.
MANY_COLUMNS = 8
# Class of a cell that has a number.
NUMBER = "number"
# Class of a cell that has the key of an input, or where a value is from.
KEY = "key"


@dataclass(frozen=True, kw_only=True)
class Cell:
    """A cell of a table.

    text : what it shows, not escaped
    kind : its class, `NUMBER` or `KEY`; "" if it has none
    below : text in the style of a key on a line of its own, which may be broken at its dots and underscores
    columns : how many columns it spans
    style : its CSS; "" if it has none
    """

    text: str
    kind: str = ""
    below: str = ""
    columns: int = 1
    style: str = ""


def paragraphs(sentences: Iterable[str]) -> str:
    """Return the first sentence as the answer, the others as a list."""
    first, *others = sentences or [""]
    return f'<p class="answer">{escape(first)}</p>{bullets(others)}' if first else ""


def bullets(lines: Sequence[str], otherwise: str = "", kind: str = "") -> str:
    """Return ``lines`` as a list of the class ``kind``; where there are none, ``otherwise`` as a paragraph."""
    if not lines:
        return f"<p>{escape(otherwise)}</p>" if otherwise else ""
    return f'<ul class="{kind}">{"".join(f"<li>{escape(line)}</li>" for line in lines)}</ul>'


def folded_notes(notes: str, count: int) -> str:
    """Return a list of ``count`` ``notes``, folded; "" where there are none."""
    return f"<details><summary>Notes ({count})</summary>{notes}</details>" if count else ""


def picture(content: bytes, caption: str) -> str:
    """Return a figure with the PNG ``content`` and its ``caption``."""
    data = base64.b64encode(content).decode()
    text = escape(caption)
    return f'<figure><img alt="{text}" src="data:image/png;base64,{data}"><figcaption>{text}</figcaption></figure>'


def table(heads: Sequence[str], rows: Sequence[Sequence[Cell]], *, in_sentences: bool = False) -> str:
    """Return a table of ``rows`` that scrolls by itself where it is wider than the page.

    On a narrow screen each row of more than `NARROW_COLUMNS`, or of sentences, becomes a list in which every cell has
    its heading before it, so that nothing is cut.
    """
    kind = ' class="wide"' if len(heads) > NARROW_COLUMNS or in_sentences else ""
    kind = ' class="wide many"' if len(heads) > MANY_COLUMNS else kind
    kinds = _kinds_of_heads(heads, rows)
    head = "".join(f"<th{of_head}>{escape(text)}</th>" for text, of_head in zip(heads, kinds))
    head = f"<thead><tr>{head}</tr></thead>" if any(heads) else ""
    body = "".join(f"<tr>{_cells_in_html(heads, row)}</tr>" for row in rows)
    return f'<div class="scroll"><table{kind}>{head}<tbody>{body}</tbody></table></div>'


def _kinds_of_heads(heads: Sequence[str], rows: Sequence[Sequence[Cell]]) -> list[str]:
    """Return the class of each heading as an attribute: that of a number, at the right, where its cells are numbers."""
    longest = max(rows, key=len, default=())  # the row of a failed point joins cells
    kinds = [f' class="{NUMBER}"' if cell.kind == NUMBER else "" for cell in longest]
    return kinds + [""] * (len(heads) - len(kinds))


def _cells_in_html(heads: Sequence[str], row: Sequence[Cell]) -> str:
    """Return a ``row`` of cells, each with its heading as an attribute."""
    labels = [*heads, *[""] * len(row)]
    return "".join(_cell_in_html(cell, label) for cell, label in zip(row, labels))


def _cell_in_html(cell: Cell, label: str) -> str:
    """Return a ``cell`` below the heading ``label``."""
    attributes = f' data-label="{escape(label)}"'
    if cell.columns > 1:
        attributes += f' colspan="{cell.columns}"'
    if cell.kind:
        attributes += f' class="{cell.kind}"'
    if cell.style:
        attributes += f' style="{cell.style}"'
    below = ""
    if cell.below:
        breakable = escape(cell.below).replace(".", ".<wbr>").replace("_", "_<wbr>")
        below = f'<br><span class="{KEY}">{breakable}</span>'
    return f"<td{attributes}>{escape(cell.text)}{below}</td>"


def plain_cells(texts: Iterable[str]) -> list[Cell]:
    """Return the cells of a row of ``texts``."""
    return [Cell(text=text) for text in texts]


def number_cells(texts: Iterable[str]) -> list[Cell]:
    """Return the cells of a row of numbers, which are ``texts``."""
    return [Cell(text=text, kind=NUMBER) for text in texts]


def row_with_key(label: str, value: str, key: str) -> list[Cell]:
    """Return a row of a quantity's ``label``, its ``value``, and its ``key`` or where the value is from."""
    return [Cell(text=label), Cell(text=value), Cell(text=key, kind=KEY)]


def column_heading(name: str, unit: str) -> str:
    """Return the heading of the column ``name``: its label, its symbol and the ``unit``, as far as it has them."""
    column = COLUMNS[name]
    return " ".join(filter(None, (column.label, column.symbol, f"[{printed(unit)}]" if printed(unit) else "")))


def number_or_dash(value: float, digits: int = 3) -> str:
    """Return a number to so many ``digits``; "-" where it is not known."""
    return plain_number(value, digits=digits) if math.isfinite(value) else "-"
