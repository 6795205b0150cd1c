"""The frame that all reports share: head, name, status and answer, around the sections of one kind of report."""

from collections.abc import Mapping
from html import escape
from importlib.resources import files
from string import Template

# Parts that belong to the frame.
FRAME = ("name", "kind", "status", "answer")


def style_sheet() -> str:
    """Return the style sheet that all reports share."""
    return _packaged("report.css")


def framed(sections: str, heading: str, subtitle: str, parts: Mapping[str, str]) -> bytes:
    """Return a report that needs no other file.

    Parameters
    ----------
    sections : name of the packaged file that has its sections, after the answer
    heading : what the report is of, after the name of the scene
    subtitle : text below the heading
    parts : those of `FRAME`, and what the ``sections`` take; all of them are HTML
    """
    body = Template(_packaged(sections)).substitute(parts)
    frame = {name: parts[name] for name in FRAME}
    page = Template(_packaged("page.html")).substitute(
        frame, heading=escape(heading), subtitle=escape(subtitle), style=style_sheet(), body=body
    )
    return page.encode()


def _packaged(name: str) -> str:
    """Return the text of a file of this package."""
    return (files(__package__) / name).read_text(encoding="utf-8")
