"""The cases of a campaign, solved over processes, with a store of what is solved.

A campaign is a command with cases, a judge, a table and a picture. Its cases are named, and each is solved to a row of
plain values. The rows are lines of JSON in a file, and a case whose row is there is not solved again. The first line
says which code solved them: lubfric's version, and a hash of its source files. Rows of other code are refused, unless
`adopt` (``--go-on`` of every command) was asked to continue with them.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from typing import Any, TypeVar

from .parent import end_with_parent
from .report import finite

CODE = "code"  # the one key of a line that is no row
Case = TypeVar("Case")


class OtherCode(RuntimeError):
    """A file holds rows of other code than the one that would add to it."""


@dataclass(frozen=True)
class Run:
    """How a part of a campaign runs: the folder that keeps its rows (None: nowhere), the number of processes, and the
    name of its file."""

    folder: Path | None = None
    workers: int = 1
    name: str = "rows"

    def solved(
        self, cases: Mapping[str, Case], solve: Callable[[Case], Any], name: str = ""
    ) -> Iterator[tuple[Case, Any]]:
        """(case, ``solve(case)``) of every case in order, the row in plain types with NaN as None.

        ``solve`` is a function that another process can import. The rows are kept in a file of that ``name``.
        """
        file = None if self.folder is None else self.folder / f"{name or self.name}.jsonl"
        known = {} if file is None else begin(file)
        missing = [key for key in cases if key not in known]
        with _mapped(min(self.workers, len(missing))) as mapped:
            new = mapped(solve, [cases[key] for key in missing])
            for key, case in cases.items():
                if key not in known:
                    known[key] = finite(next(new))
                    if file is not None:
                        _append(file, [key, known[key]])
                yield case, known[key]


class _mapped:
    """``map`` in this process, or over fresh processes that end with it."""

    def __init__(self, workers: int):
        self.pool = ProcessPoolExecutor(workers, get_context("spawn"), end_with_parent) if workers > 1 else None

    def __enter__(self):
        return map if self.pool is None else self.pool.map

    def __exit__(self, *error):
        if self.pool is not None:
            self.pool.shutdown(cancel_futures=True)


def read(file: Path) -> dict[str, Any]:
    """The rows of ``file`` by case, of whatever code. A last line that was not written to its end is left out."""
    return dict(line for line in _lines(file) if not _is_code(line))


def begin(file: Path) -> dict[str, Any]:
    """The rows of ``file``, which is made if it is missing. Raises `OtherCode` if its last rows are of other code."""
    if stale(file):
        raise OtherCode(
            f"{file} holds rows of other code ({code_of(file)}; this is {code()}); allowed: another folder, or this "
            "file removed, or to go on with them all the same: --go-on"
        )
    if not file.is_file():
        file.parent.mkdir(parents=True, exist_ok=True)
        _append(file, {CODE: code()})
    _cut_unfinished(file)
    return read(file)


def code() -> str:
    """lubfric's version, and a hash of its source files."""
    import lubfric  # only now: the studies can be listed without it

    found, home = hashlib.sha256(), Path(lubfric.__path__[0])
    for path in sorted(home.rglob("*.py")):
        found.update(path.relative_to(home).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return f"lubfric {lubfric.__version__}, source {found.hexdigest()[:16]}"


def code_of(file: Path) -> str:
    """The code that solved the last rows of ``file``; "not known" where it does not say."""
    return next((line[CODE] for line in reversed(_lines(file)) if _is_code(line)), "not known")


def stale(file: Path) -> bool:
    """Whether ``file`` holds lines, the last of other code."""
    return bool(_lines(file)) and code_of(file) != code()


def adopt(file: Path) -> None:
    """Continue with the rows of ``file``, of whatever code: a line behind them says where those of this code begin."""
    if stale(file):
        _cut_unfinished(file)
        _append(file, {CODE: code()})


def _append(file: Path, line: Any) -> None:
    with file.open("a", encoding="utf-8") as stream:
        stream.write(json.dumps(line) + "\n")


def _cut_unfinished(file: Path) -> None:
    """Cut off a last line that was not written to its end."""
    with file.open("rb+") as stream:
        stream.truncate(stream.read().rfind(b"\n") + 1)


def _lines(file: Path) -> list[Any]:
    whole = file.read_text(encoding="utf-8").rpartition("\n")[0] if file.is_file() else ""
    return [json.loads(line) for line in whole.splitlines()]


def _is_code(line: Any) -> bool:
    return isinstance(line, dict) and list(line) == [CODE]
