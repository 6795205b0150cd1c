"""The cases of a campaign, solved over processes, with a store of what is solved.

A campaign is a command with cases, checks, a table and a picture. Its cases have names, and the solution of each is a
row of plain values. The rows are lines of JSON in a file, and a case whose row exists is not solved again. The file is
in a folder with the name of the code that solved it, so that rows of other code are never mixed with new ones.
"""

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TypeVar

from .report import finite
from .run import mapped
from .types import PlainRow, PlainValue

Case = TypeVar("Case")


@dataclass(frozen=True)
class Run:
    """How a part of a campaign runs: folder of its rows (None: not stored), processes, name of its file."""

    folder: Path | None = None
    workers: int = 1
    name: str = "rows"

    def solved(
        self, cases: Mapping[str, Case], solve: Callable[[Case], PlainValue], name: str = ""
    ) -> Iterator[tuple[Case, PlainValue]]:
        """(case, ``solve(case)``) of every case in order, the row in plain types with NaN as None.

        ``solve`` is a function that another process can import. Each row is stored in a file of that ``name`` as soon
        as it is solved.
        """
        file = None if self.folder is None else self.folder / code() / f"{name or self.name}.jsonl"
        known = {} if file is None else rows_of(file)
        missing = [key for key in cases if key not in known]
        with mapped(min(self.workers, len(missing))) as each:
            new = each(partial(row_of, solve, file), missing, [cases[key] for key in missing])
            for key, case in cases.items():
                if key not in known:
                    known[key] = next(new)
                yield case, known[key]


def row_of(solve: Callable[[Case], PlainValue], file: Path | None, key: str, case: Case) -> PlainValue:
    """Return ``solve(case)`` in plain types, a line of ``file`` now. It is written at once, so that others may write
    too."""
    row = finite(solve(case))
    if file is not None:
        with file.open("ab", buffering=0) as stream:
            stream.write(json.dumps([key, row]).encode() + b"\n")
    return row


def code() -> str:
    """Return lubfric's version, and a hash of its source files."""
    import lubfric  # only now: the studies can be listed without it

    digest = hashlib.sha256()
    home = Path(lubfric.__path__[0])
    for path in sorted(home.rglob("*.py")):
        digest.update(path.relative_to(home).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return f"lubfric-{lubfric.__version__}-{digest.hexdigest()[:16]}"


def rows_of(file: Path) -> PlainRow:
    """Return the rows of ``file`` by case. It is made if it is missing; an unfinished last line is cut off."""
    file.parent.mkdir(parents=True, exist_ok=True)
    content = file.read_bytes() if file.is_file() else b""
    content = content[: content.rfind(b"\n") + 1]
    file.write_bytes(content)
    return dict(json.loads(line) for line in content.splitlines())
