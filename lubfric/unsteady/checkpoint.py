"""The state of a run on disk. It is written whole after every step, so that a kill loses nothing that was computed.

The state is one file of plain arrays (no pickle) with a checksum and a fingerprint of the problem. It is replaced
atomically. Rows and fields of the outputs so far are appended to two binary files beside it. The state knows how long
these were and the hash of their bytes. A resume cuts off what a kill left behind that, and refuses what was damaged.
"""

from __future__ import annotations

import hashlib
import io
import os
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InputError
from ..store import fingerprint, read_checked, write_checked
from ..store.whole import PART, saying

STATE, ROWS, FIELDS = "state.bin", "rows.bin", "fields.bin"


class Checkpoint:
    """A folder that holds the state of one run.

    ``description``: a list of everything that decides the result, for `lubfric.store.fingerprint`: the prepared scene
    with its heights and spacing, the histories, the output times.
    """

    def __init__(self, folder, description):
        self.folder = Path(folder)
        self.fingerprint = fingerprint(*description)
        self._hashes = {ROWS: hashlib.sha256(), FIELDS: hashlib.sha256()}

    def load(self) -> tuple[dict, np.ndarray, np.ndarray] | None:
        """(state, rows, fields) of an interrupted run of the same problem, or None where there is none.

        Raises `InputError` for the state of another problem, and for files that were cut or overwritten.
        """
        path = self.folder / STATE
        if not path.is_file():
            for name in (ROWS, FIELDS):
                with saying(f"{self.folder / name} of an earlier run was not removed"):
                    (self.folder / name).unlink(missing_ok=True)
                self._hashes[name] = hashlib.sha256()
            return None
        content = read_checked(path)
        if content is None:
            raise self._damaged(path)
        with np.load(io.BytesIO(content), allow_pickle=False) as file:
            state = dict(file)
        if str(state["fingerprint"]) != self.fingerprint:
            raise InputError(
                f"checkpoint in {self.folder} belongs to another run (scene, height map, times or version differ); "
                "allowed: the same scene, or an empty folder"
            )
        count = int(state["outputs"])
        sizes = {ROWS: int(state["row_size"]), FIELDS: int(state["field_size"])}
        rows, fields = (self._cut(name, count, sizes[name], str(state[f"sha256_{name}"])) for name in (ROWS, FIELDS))
        return state, rows, fields

    def _cut(self, name: str, count: int, size: int, expected: str) -> np.ndarray:
        path = self.folder / name
        with saying(f"{path} was not read"):
            content = path.read_bytes()[: 8 * count * size] if path.is_file() else b""
        self._hashes[name] = hashlib.sha256(content)
        if self._hashes[name].hexdigest() != expected:
            raise self._damaged(path)
        if content:
            os.truncate(path, len(content))
        return np.frombuffer(content).reshape(count, size)

    def _damaged(self, path: Path) -> InputError:
        return InputError(
            f"checkpoint file {path} is damaged (cut or overwritten); allowed: an undamaged folder, or an empty one "
            "to begin again"
        )

    def append(self, row: np.ndarray, field: np.ndarray) -> None:
        """Add one output."""
        with saying(f"the checkpoint in {self.folder} was not written"):
            self.folder.mkdir(parents=True, exist_ok=True)
            for name, values in ((ROWS, row), (FIELDS, field)):
                content = np.asarray(values, dtype=float).tobytes()
                with (self.folder / name).open("ab") as file:
                    file.write(content)
                    file.flush()
                    os.fsync(file.fileno())
                self._hashes[name].update(content)

    def save(self, state: dict) -> None:
        """Replace the state."""
        hashes = {f"sha256_{name}": found.hexdigest() for name, found in self._hashes.items()}
        content = io.BytesIO()
        arrays: dict[str, Any] = {"fingerprint": self.fingerprint, **hashes, **state}
        np.savez(content, **arrays)
        write_checked(self.folder / STATE, content.getvalue())

    def clear(self) -> None:
        """Remove the files of a finished run, and the folder when nothing else is in it."""
        for path in (*(self.folder / name for name in (STATE, ROWS, FIELDS)), *self.folder.glob(f"{PART}*")):
            path.unlink(missing_ok=True)
        if self.folder.is_dir() and not any(self.folder.iterdir()):
            self.folder.rmdir()
