"""The folder of ``lubfric run``: one writer at a time, only complete files, result.json last. What an unfinished run
has saved is kept apart."""

from __future__ import annotations

import io
import json
import shutil
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path

from .._base import FolderLock, clear_parts, plain, saying, whole_file, write_whole
from ..errors import InputError

RESULT, UNFINISHED, CHECKPOINT = "result.json", "unfinished", "checkpoint"
# of sweeps and of runs in time; the result, which says that a folder is complete, first to go and last to come
OUTPUTS = (
    RESULT,
    *(f"{table}.{kind}" for table in ("stribeck", "traction", "history") for kind in ("csv", "png")),
    *("contact.png", "animation.gif", "fields.npz", "report.html"),
)


def drawn(plot: Callable, *arguments) -> bytes:
    """The figure of ``plot(file, *arguments)``."""
    buffer = io.BytesIO()
    plot(buffer, *arguments)
    return buffer.getvalue()


def run_name(folder: Path) -> str:
    """Name of the scene of a run; that of its folder if the record of the run is missing or damaged."""
    try:
        return str(json.loads((folder / RESULT).read_text(encoding="utf-8"))["scene"]["name"])
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return folder.resolve().name


class RunFolder:
    """``path`` and the names of the files ``written`` to it. Made by `run_folder`."""

    def __init__(self, path: Path, name: str):
        self.path = path
        self.unfinished = path / UNFINISHED / name[:16]
        self.written: list[str] = []

    def clear(self) -> None:
        """Remove the results of an earlier run. Call it when those of this run are ready to be written."""
        with saying(f"results of an earlier run in {self.path} were not removed"):
            for path in (*(self.path / name for name in OUTPUTS), *self.path.glob("contact_*.vtk")):
                path.unlink(missing_ok=True)

    def write(self, name: str, content: bytes) -> None:
        """Write a file of the run, completely or not at all."""
        write_whole(self.path / name, content)
        self.written.append(name)

    def draw(self, name: str, plot: Callable, *arguments) -> None:
        """Write the figure that ``plot(file, *arguments)`` draws."""
        self.write(name, drawn(plot, *arguments))

    def make(self, name: str, save: Callable, *arguments) -> None:
        """Write a file by ``save(path, *arguments)``, if it can only be written by name."""
        with whole_file(self.path / name) as part:
            save(part, *arguments)
        self.written.append(name)

    def finish(self, record: dict) -> None:
        """Write ``record`` as result.json, which names the files that belong to it. Then the run is complete, and what
        was saved for a resume is removed."""
        whole = plain({"files": sorted([*self.written, RESULT])} | record)
        self.write(RESULT, json.dumps(whole, indent=1, allow_nan=False).encode())
        shutil.rmtree(self.unfinished, ignore_errors=True)
        with saying(f"{self.unfinished.parent} was not removed"):
            if self.unfinished.parent.is_dir() and not any(self.unfinished.parent.iterdir()):
                self.unfinished.parent.rmdir()


@contextmanager
def run_folder(path, fingerprint: str):
    """Open ``path`` for the run with that ``fingerprint``, as a `RunFolder`.

    ``.unfinished`` has what an interrupted run of the same fingerprint saved. What other runs saved is left alone.
    Raises `InputError` if ``path`` is a file, or a folder to which another process writes, and `OutputError` if it
    cannot be used.
    """
    path = Path(path)
    if path.exists() and not path.is_dir():
        raise InputError(f"--out {path} is a file; give a folder, existing or not")
    with FolderLock(path):
        clear_parts(path)
        yield RunFolder(path, fingerprint)
