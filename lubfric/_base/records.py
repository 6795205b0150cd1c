"""How dataclasses of results and scenes behave: arrays stay read-only, derived values are not pickled, and they print
as one line, or as the call that makes them."""

import base64
import io
from collections.abc import Iterable
from dataclasses import MISSING, fields, is_dataclass
from html import escape
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn

import numpy as np

from ..errors import LubfricError
from .validate import nearest


class FrozenArrays:
    """Base of frozen dataclasses: every array field is read-only, after copying and unpickling too. The arrays have to
    be its own."""

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        FrozenArrays.__post_init__(self)

    def __post_init__(self) -> None:
        for value in self.__dict__.values():
            if isinstance(value, np.ndarray):
                value.flags.writeable = False


def share_read_only(value: Any) -> None:
    """Put read-only views in place of the arrays in a dataclass, and in those that it or a tuple, list or dict holds.

    What a solve hands out may also be kept for the next solve. A caller who writes into it, to change its unit for
    instance, would change every later answer.
    """
    if isinstance(value, dict):
        value = tuple(value.values())
    if isinstance(value, (tuple, list)):
        for part in value:
            share_read_only(part)
    elif is_dataclass(value) and not isinstance(value, type):
        for field in fields(value):
            part = getattr(value, field.name, None)
            if isinstance(part, np.ndarray):
                view = part.view()
                view.flags.writeable = False
                object.__setattr__(value, field.name, view)
            else:
                share_read_only(part)


class FieldsOnly:
    """Base of frozen dataclasses with cached properties: derived values are not pickled."""

    def __getstate__(self) -> dict[str, Any]:
        return {f.name: getattr(self, f.name) for f in fields(self)}  # type: ignore[arg-type]


class Renamed:
    """Base of results: an attribute that version 0.2.0 had under another name raises `AttributeError` with that of
    today."""

    _RENAMED: ClassVar[dict[str, str]] = {}  # today's name by that of version 0.2.0

    if not TYPE_CHECKING:  # to a type checker, an old name is one that the class does not have

        def __getattr__(self, name: str) -> Any:
            self._refuse(name)

    def _refuse(self, name: str, others: Iterable[str] = ()) -> NoReturn:
        """Raise `AttributeError` for ``name``, with its name of today, or with the most alike of ``others``."""
        kind = type(self)
        if name in kind._RENAMED:
            raise AttributeError(f"{kind.__name__}.{name} is called {kind._RENAMED[name]} now")
        raise AttributeError(f"{kind.__name__!r} object has no attribute {name!r}{nearest(name, others)}")


class Shown:
    """Prints as one line of its ``_facts``, a dict of words by name; without any, as the call that makes it, its
    defaults omitted."""

    def _facts(self) -> dict[str, str]:
        return {}

    def __repr__(self) -> str:
        if facts := self._facts():
            return f"<{type(self).__name__}: {', '.join(f'{k} {v}' if k else v for k, v in facts.items())}>"
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in changed(self).items())})"

    def _repr_html_(self) -> str:
        """Return what a notebook shows: a table of what it prints, and its picture where it has a method ``plot``."""
        facts = self._facts() or {name: repr(value) for name, value in changed(self).items()}
        cells = (f"<tr><th>{escape(name)}</th><td>{escape(text)}</td></tr>" for name, text in facts.items())
        table = f"<table><caption>{type(self).__name__}</caption>{''.join(cells)}</table>"
        return f"<div>{table}{_picture_of(self)}</div>"


def _picture_of(shown: Any) -> str:
    """Return the picture that ``shown.plot(axes)`` draws, as an image of HTML; "" where there is nothing to draw."""
    if not hasattr(type(shown), "plot"):
        return ""
    from .figures import new_figure

    figure = new_figure(figsize=(7, 4.5))
    try:
        shown.plot(figure.subplots())
    except LubfricError:  # no point of it has an answer
        return ""
    content = io.BytesIO()
    figure.savefig(content, format="png", dpi=100)
    data = base64.b64encode(content.getvalue()).decode()
    return f'<img alt="{type(shown).__name__}" src="data:image/png;base64,{data}">'


def changed(part: Any) -> dict[str, Any]:
    """Return the fields of a dataclass that differ from their defaults, by name."""
    values = {}
    for f in fields(part):
        value = getattr(part, f.name)
        default = f.default if f.default_factory is MISSING else f.default_factory()
        if default is MISSING or value != default:
            values[f.name] = value
    return values
