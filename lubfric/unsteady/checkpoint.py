"""The state of a run on disk. It is written whole after every step, so that a kill loses nothing that was computed.

The state is one file (`lubfric.store.codec`) with a checksum and a fingerprint of the problem. It is replaced
atomically. Rows and fields of the outputs so far are appended to two binary files beside it. The state knows how long
these were and the hash of their bytes. A resume cuts off what a kill left behind that, and refuses what was damaged.
"""

from __future__ import annotations

import hashlib
import os
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InputError
from ..store import decode, encode, fingerprint, read_checked, write_checked
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
        self._begin_outputs()

    def _begin_outputs(self) -> None:
        self._outputs = 0
        self._bytes = {ROWS: 0, FIELDS: 0}
        self._hashes = {ROWS: hashlib.sha256(), FIELDS: hashlib.sha256()}

    def load(self) -> tuple[Any, np.ndarray, np.ndarray] | None:
        """(state, rows, fields) of an interrupted run of the same problem, or None where there is none.

        Raises `InputError` for the state of another problem, and for files that were cut or overwritten.
        """
        path = self.folder / STATE
        if not path.is_file():
            for name in (ROWS, FIELDS):
                with saying(f"{self.folder / name} of an earlier run was not removed"):
                    (self.folder / name).unlink(missing_ok=True)
            self._begin_outputs()
            return None
        content = read_checked(path)
        if content is None:
            raise self._damaged(path)
        try:
            kept = decode(content)
        except ValueError:  # of another version
            kept = {"fingerprint": None}
        if kept["fingerprint"] != self.fingerprint:
            raise InputError(
                f"checkpoint in {self.folder} belongs to another run (scene, height map, times or version differ); "
                "run the same scene, or give an empty folder"
            )
        self._outputs, self._bytes = kept["outputs"], kept["bytes"]
        rows, fields = (self._cut(name, kept["sha256"][name]) for name in (ROWS, FIELDS))
        return kept["state"], rows, fields

    def _cut(self, name: str, expected: str) -> np.ndarray:
        path = self.folder / name
        with saying(f"{path} was not read"):
            content = path.read_bytes()[: self._bytes[name]] if path.is_file() else b""
        self._hashes[name] = hashlib.sha256(content)
        if self._hashes[name].hexdigest() != expected:
            raise self._damaged(path)
        if content:
            os.truncate(path, len(content))
        return np.frombuffer(content).reshape(self._outputs, -1) if self._outputs else np.zeros((0, 0))

    def _damaged(self, path: Path) -> InputError:
        return InputError(
            f"checkpoint file {path} is damaged (cut or overwritten); give an empty folder to begin again"
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
                self._bytes[name] += len(content)
        self._outputs += 1

    def save(self, state) -> None:
        """Replace the state: dataclasses of this package, numbers and arrays."""
        hashes = {name: found.hexdigest() for name, found in self._hashes.items()}
        kept = {"fingerprint": self.fingerprint, "outputs": self._outputs, "bytes": self._bytes, "sha256": hashes}
        write_checked(self.folder / STATE, *encode(kept | {"state": state}))

    def clear(self) -> None:
        """Remove the files of a finished run, and the folder when nothing else is in it."""
        for path in (*(self.folder / name for name in (STATE, ROWS, FIELDS)), *self.folder.glob(f"{PART}*")):
            path.unlink(missing_ok=True)
        if self.folder.is_dir() and not any(self.folder.iterdir()):
            self.folder.rmdir()
