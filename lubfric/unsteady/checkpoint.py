"""A run's state on disk: written whole after every step, so that a kill loses nothing that was computed.

One ``.npz`` file of plain arrays (no pickle), replaced atomically, with a fingerprint of the problem; rows
and fields of the outputs so far are appended to two binary files beside it, which a resume cuts to the
count that the state knows of.
"""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path

import numpy as np

from ..errors import InputError

STATE, ROWS, FIELDS = "state.npz", "rows.bin", "fields.bin"


class Checkpoint:
    """A folder that holds the state of one run. ``fingerprint``: of everything that decides the result."""

    def __init__(self, folder, description):
        self.folder = Path(folder)
        text = json.dumps(description, sort_keys=True, default=str)
        self.fingerprint = hashlib.sha256(text.encode()).hexdigest()

    def load(self) -> tuple[dict, np.ndarray, np.ndarray] | None:
        """(state, rows, fields) of an interrupted run of the same problem, or None where there is none."""
        path = self.folder / STATE
        if not path.is_file():
            for name in (ROWS, FIELDS):
                (self.folder / name).unlink(missing_ok=True)
            return None
        with np.load(path, allow_pickle=False) as file:
            state = dict(file)
        if str(state["fingerprint"]) != self.fingerprint:
            raise InputError(
                f"checkpoint in {self.folder} belongs to another run (scene, times or version differ); "
                "allowed: the same scene, or an empty folder"
            )
        count = int(state["outputs"])
        return (
            state,
            self._cut(ROWS, count, int(state["row_size"])),
            self._cut(FIELDS, count, int(state["field_size"])),
        )

    def _cut(self, name: str, count: int, size: int) -> np.ndarray:
        path = self.folder / name
        values = np.fromfile(path, dtype=float, count=count * size)
        if values.size != count * size:
            raise InputError(
                f"checkpoint file {path} is shorter than its state; allowed: an undamaged folder, or an "
                "empty one to begin again"
            )
        with path.open("r+b") as file:
            file.truncate(values.nbytes)
        return values.reshape(count, size)

    def append(self, row: np.ndarray, field: np.ndarray) -> None:
        """Add one output."""
        self.folder.mkdir(parents=True, exist_ok=True)
        for name, values in ((ROWS, row), (FIELDS, field)):
            with (self.folder / name).open("ab") as file:
                np.asarray(values, dtype=float).tofile(file)

    def save(self, state: dict) -> None:
        """Replace the state."""
        self.folder.mkdir(parents=True, exist_ok=True)
        new = self.folder / (STATE + ".new")
        with new.open("wb") as file:
            np.savez(file, fingerprint=self.fingerprint, **state)
        os.replace(new, self.folder / STATE)

    def clear(self) -> None:
        """Remove the files of a finished run, and the folder when nothing else is in it."""
        for name in (STATE, STATE + ".new", ROWS, FIELDS):
            (self.folder / name).unlink(missing_ok=True)
        if self.folder.is_dir() and not any(self.folder.iterdir()):
            self.folder.rmdir()
