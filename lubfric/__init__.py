"""Friction of mixed-lubricated rough line contacts.

The public names load on first use (SPEC 1 of Scientific Python), so that ``import lubfric`` stays light. They are in
`__init__.pyi` alone, one import a line, from which type checkers and this module read them. (The package lazy_loader
does the same; it would be one more requirement, and load `ast`, which takes longer than all of this.)
"""

from importlib import import_module

_STUB = __loader__.get_data(f"{__file__.removesuffix('c')}i").decode()  # type: ignore[name-defined]  # by import itself
_LINES = [line.split() for line in _STUB.splitlines() if line.startswith("from .")]
_RENAMED = {"Validity": "Violation"}  # today's name by the old one
_HOME = {words[3]: words[1] for words in _LINES}  # "from .room import name as name"
__all__ = sorted(name for name, home in _HOME.items() if name != "__version__" and home != ".")


def __getattr__(name: str) -> object:
    if name in _RENAMED:
        raise AttributeError(f"lubfric.{name} is called lubfric.{_RENAMED[name]} now")
    if name not in _HOME:
        raise AttributeError(f"module 'lubfric' has no attribute {name!r}")
    home = _HOME[name].lstrip(".")
    value = getattr(import_module(f"lubfric.{home}"), name) if home else import_module(f"lubfric.{name}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOME})
