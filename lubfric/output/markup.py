"""Pieces of a report in HTML: paragraphs, lists, figures, and tables with their headings and cells."""

import base64
import math
from collections.abc import Iterable, Sequence
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


def paragraphs(sentences: Iterable[str]) -> str:
    """Return the first sentence as the answer, the others as a paragraph."""
    first, *others = [escape(text) for text in sentences] or [""]
    more = f"<p>{' '.join(others)}</p>" if others else ""
    return f'<p class="answer">{first}</p>{more}' if first else ""


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


def table(heads: Sequence[str], rows: Sequence[str], *, in_sentences: bool = False) -> str:
    """Return a table that scrolls by itself where it is wider than the page. On a narrow screen each row of more than
    `NARROW_COLUMNS`, or of sentences, becomes a list in which every cell has its heading before it, so that nothing is
    cut."""
    kind = ' class="wide"' if len(heads) > NARROW_COLUMNS or in_sentences else ""
    kind = ' class="wide many"' if len(heads) > MANY_COLUMNS else kind
    kinds = _kinds_of_heads(heads, rows)
    head = "".join(f"<th{of_head}>{escape(text)}</th>" for text, of_head in zip(heads, kinds))
    head = f"<thead><tr>{head}</tr></thead>" if any(heads) else ""
    body = "".join(f"<tr>{_labelled(heads, row)}</tr>" for row in rows)
    return f'<div class="scroll"><table{kind}>{head}<tbody>{body}</tbody></table></div>'


def _kinds_of_heads(heads: Sequence[str], rows: Sequence[str]) -> list[str]:
    """Return the class of each heading as an attribute: that of a number, at the right, where its cells are numbers."""
    longest = max(rows, key=lambda row: row.count("<td"), default="")  # the row of a failed point joins cells
    number = ' class="number"'
    kinds = [number if cell.startswith(number) else "" for cell in longest.split("<td")[1:]]
    return kinds + [""] * (len(heads) - len(kinds))


def _labelled(heads: Sequence[str], row: str) -> str:
    """Return a ``row`` of cells, each with its heading as an attribute."""
    first, *cells = row.split("<td")
    labels = [escape(head) for head in heads] + [""] * len(cells)
    return first + "".join(f'<td data-label="{label}"{cell}' for label, cell in zip(labels, cells))


def number_cells(texts: Iterable[str]) -> str:
    """Return the cells of a row of numbers, which are ``texts``."""
    return "".join(f'<td class="number">{escape(text)}</td>' for text in texts)


def column_heading(name: str, unit: str) -> str:
    """Return the heading of the column ``name``: its label, its symbol and the ``unit``, as far as it has them."""
    column = COLUMNS[name]
    return " ".join(filter(None, (column.label, column.symbol, f"[{printed(unit)}]" if printed(unit) else "")))


def number_or_dash(value: float) -> str:
    """Return a number to three digits; "-" where it is not known."""
    return plain_number(value) if math.isfinite(value) else "-"
