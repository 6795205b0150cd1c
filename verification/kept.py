"""Rows of a long run, kept as a line of JSON each in one file. What is found there is not solved again."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

from .report import finite


def read(file: Path) -> list[Any]:
    """All rows of ``file``; none where there is no file. A last line that was not written to its end is left out."""
    if not file.is_file():
        return []
    whole = file.read_text(encoding="utf-8").rpartition("\n")[0]
    return [json.loads(line) for line in whole.splitlines()]


def append(file: Path, row: Any) -> None:
    """Put one row behind the others, in a folder that is made where it is missing; a last line that was not written to
    its end is cut off first."""
    file.parent.mkdir(parents=True, exist_ok=True)
    line = json.dumps(row)
    with file.open("ab+") as stream:
        stream.seek(0)
        stream.truncate(stream.read().rfind(b"\n") + 1)
        stream.write(line.encode() + b"\n")


def each(file: Path | None, keys: Iterable[str], solve: Callable[[str], Any]) -> Iterator[Any]:
    """``solve(key)`` in plain types (NaN as None) for every key in turn, kept as soon as it is there; for a key found
    in ``file`` what was kept. Without a file nothing is kept."""
    known = dict(read(file)) if file is not None else {}
    for key in keys:
        if key not in known:
            known[key] = finite(solve(key))
            if file is not None:
                append(file, [key, known[key]])
        yield known[key]
