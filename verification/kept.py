"""Rows of a long run, saved in one file, each as a line of JSON. Rows that are there already are not solved again.

The first line says which code solved the rows: lubfric's version, and a hash of its source files. Rows of other code
are refused, unless `adopt` (``--go-on`` of every command) was asked to continue with them. Then the file says where the
rows of the new code begin.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

from .report import finite

CODE = "code"  # the one key of a line that is no row


class OtherCode(RuntimeError):
    """A file holds rows of other code than the one that would add to it."""


def read(file: Path) -> list[Any]:
    """All rows of ``file``, of whatever code; none where there is no file. A last line that was not written to its end
    is left out."""
    return [line for line in _lines(file) if not _is_code(line)]


def begin(file: Path) -> list[Any]:
    """The rows of ``file``, to which `append` can add. The file is made if it is missing, and a last line that was not
    written to its end is cut off. Raises `OtherCode` if its last rows are of other code."""
    if stale(file):
        raise OtherCode(
            f"{file} holds rows of other code ({code_of(file)}; this is {code()}); allowed: another folder, or this "
            "file removed, or to go on with them all the same: --go-on"
        )
    if not file.is_file():
        file.parent.mkdir(parents=True, exist_ok=True)
        append(file, {CODE: code()})
    _cut_unfinished(file)
    return read(file)


def append(file: Path, row: Any) -> None:
    """Add one row to a file that `begin` has prepared."""
    with file.open("a", encoding="utf-8") as stream:
        stream.write(json.dumps(row) + "\n")


def each(file: Path | None, keys: Iterable[str], solve: Callable[[str], Any]) -> Iterator[Any]:
    """``solve(key)`` in plain types (NaN as None) for every key in turn, saved at once. For a key that ``file`` has
    already, the saved value. Without a file nothing is saved."""
    known = dict(begin(file)) if file is not None else {}
    for key in keys:
        if key not in known:
            known[key] = finite(solve(key))
            if file is not None:
                append(file, [key, known[key]])
        yield known[key]


def code() -> str:
    """lubfric's version, and a hash of its source files."""
    import lubfric  # only now: the studies can be listed without it

    found, home = hashlib.sha256(), Path(lubfric.__path__[0])
    for path in sorted(home.rglob("*.py")):
        found.update(path.relative_to(home).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return f"lubfric {lubfric.__version__}, source {found.hexdigest()[:16]}"


def code_of(file: Path) -> str:
    """The code that solved the last rows of ``file``; a file from before that was written says "not known"."""
    return next((line[CODE] for line in reversed(_lines(file)) if _is_code(line)), "not known")


def stale(file: Path) -> bool:
    """Whether ``file`` holds lines, the last of other code."""
    return bool(_lines(file)) and code_of(file) != code()


def adopt(file: Path) -> None:
    """Continue with the rows of ``file``, of whatever code: a line behind them says that the following rows are of this
    one."""
    if stale(file):
        _cut_unfinished(file)
        append(file, {CODE: code()})


def _cut_unfinished(file: Path) -> None:
    """Cut off a last line that was not written to its end."""
    with file.open("rb+") as stream:
        stream.truncate(stream.read().rfind(b"\n") + 1)


def _lines(file: Path) -> list[Any]:
    if not file.is_file():
        return []
    whole = file.read_text(encoding="utf-8").rpartition("\n")[0]
    return [json.loads(line) for line in whole.splitlines()]


def _is_code(line: Any) -> bool:
    return isinstance(line, dict) and list(line) == [CODE]
