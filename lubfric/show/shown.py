"""How a result prints: one line, and a table where the reader is a notebook."""

from __future__ import annotations

from html import escape


class Shown:
    """Prints as one line of its ``_facts``, a dict of words by name; as a table in notebooks."""

    def _facts(self) -> dict[str, str]:
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {', '.join(f'{k} {v}' if k else v for k, v in self._facts().items())}>"

    def _repr_html_(self) -> str:
        return table(self._facts(), type(self).__name__)


def table(facts: dict[str, str], title: str) -> str:
    """A two-column HTML table."""
    rows = "".join(f"<tr><th>{escape(k)}</th><td>{escape(v)}</td></tr>" for k, v in facts.items())
    return f"<table><caption>{escape(title)}</caption><tbody>{rows}</tbody></table>"
