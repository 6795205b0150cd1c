"""Rows of a long run, kept as a line of JSON each in one file. What is found there is not solved again."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any


def read(file: Path) -> list[Any]:
    """All rows of ``file``; none where there is no file."""
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()] if file.is_file() else []


def append(file: Path, row: Any) -> None:
    """Append one row, in a folder that is made where it is missing."""
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("a", encoding="utf-8") as stream:
        stream.write(json.dumps(row) + "\n")
