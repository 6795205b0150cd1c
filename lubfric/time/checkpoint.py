"""The state of a run on disk. It is written as a whole after every step, so that a kill loses nothing that was
computed.

The state is one file with a checksum and a fingerprint of the problem, which is replaced atomically. The outputs so far
are records (`lubfric.studies.Records`), and the state knows how many there were. A resumed run reads these, and refuses
damaged ones.
"""

from __future__ import annotations

from base64 import b64decode, b64encode
from pathlib import Path
from typing import Any

import numpy as np

from .._base import PART, read_checked, validate, write_checked
from ..errors import InputError
from ..studies import Records, decode, encode, fingerprint

STATE, OUTPUTS = "state.bin", "outputs"
Output = tuple[np.ndarray, np.ndarray]  # at an output time: a row of numbers, and one of fields


class Checkpoint:
    """A folder that holds the state of one run.

    ``description``: a list of everything that decides the result, for `lubfric.studies.fingerprint`: the prepared scene
    with its heights and spacing, the histories, the output times.
    """

    def __init__(self, folder, description):
        self.folder = validate.folder("checkpoint", folder)
        self.fingerprint = fingerprint(*description)
        self._records = Records(self.folder / OUTPUTS)
        self._count = 0

    def __enter__(self) -> Checkpoint:
        return self

    def __exit__(self, *_) -> None:
        self._records.close()

    def load(self) -> tuple[Any, list[Output]] | None:
        """The state and the outputs of an interrupted run of the same problem, or None if there is none.

        Raises `InputError` for the state of another problem, and for files that were cut off or overwritten.
        """
        path = self.folder / STATE
        if not path.is_file():
            return None
        content = read_checked(path)
        if content is None:
            raise _damaged(path)
        try:
            kept = decode(content)
        except ValueError:  # of another version
            kept = {"fingerprint": None}
        if kept["fingerprint"] != self.fingerprint:
            raise InputError(
                f"checkpoint in {self.folder} belongs to another run (scene, height map, times or version differ); "
                "run the same scene, or give an empty folder"
            )
        self._count = kept["outputs"]
        records = dict(self._records.read())
        keys = [self._key(number) for number in range(self._count)]
        if not all(key in records for key in keys):
            raise _damaged(self._records.folder)
        return kept["state"], [(_numbers(records[key]["row"]), _numbers(records[key]["field"])) for key in keys]

    def append(self, row: np.ndarray, field: np.ndarray) -> None:
        """Add one output."""
        self._records.add(self._key(self._count), {"row": _text(row), "field": _text(field)}, sync=True)
        self._count += 1

    def save(self, state) -> None:
        """Replace the state, which consists of dataclasses of this package, numbers and arrays."""
        kept = {"fingerprint": self.fingerprint, "outputs": self._count, "state": state}
        write_checked(self.folder / STATE, *encode(kept))

    def clear(self) -> None:
        """Remove the files of a finished run, and its folders if they are empty then."""
        for path in (self.folder / STATE, *self._records.folder.glob("*.jsonl"), *self.folder.glob(f"{PART}*")):
            path.unlink(missing_ok=True)
        for folder in (self._records.folder, self.folder):
            if folder.is_dir() and not any(folder.iterdir()):
                folder.rmdir()

    def _key(self, number: int) -> str:
        return f"{self.fingerprint} {number}"


def _damaged(path: Path) -> InputError:
    return InputError(f"checkpoint file {path} is damaged (cut or overwritten); give an empty folder to begin again")


def _text(values: np.ndarray) -> str:
    return b64encode(np.asarray(values, dtype=float).tobytes()).decode()


def _numbers(text: str) -> np.ndarray:
    return np.frombuffer(b64decode(text))
