"""The papers behind a result: those of the methods that it used."""

from __future__ import annotations

from collections.abc import Iterable

from .._base import packaged


def cited(methods: Iterable[str]) -> str:
    """The papers of ``methods`` (keys of papers.toml), one a line, the model's first."""
    used = set(methods)
    return "\n".join(paper for name, paper in packaged(__package__, "papers.toml").items() if name in used)


def together(points) -> str:
    """The papers of several results, each once, one a line."""
    return cited(name for point in points for name in point.methods)
