"""The state of a run on disk. It is written as a whole after every step, so that a kill loses nothing that was
computed.

State and outputs are files with checksums, each replaced as a whole. The state carries a fingerprint of the problem and
the number of outputs so far. A resumed run refuses damaged files.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from .._base import PART, read_checked, validate, write_checked
from ..errors import InputError
from ..studies import classes_of, decode, encode, fingerprint
from .bdf import Progress
from .sharing import Contact

STATE, OUTPUTS = "state.bin", "outputs"
CLASSES = classes_of(Progress, Contact)  # that a state may hold
Output = tuple[np.ndarray, np.ndarray]  # at an output time: a row of numbers, and one of fields


class Checkpoint:
    """A folder that holds the state of one run.

    ``description``: a list of everything that decides the result, for `lubfric.studies.fingerprint`: the prepared scene
    with its heights and spacing, the histories, the output times.
    """

    def __init__(self, folder, description):
        self.folder = validate.folder("checkpoint", folder)
        self.fingerprint = fingerprint(*description)
        self._count = 0

    def __enter__(self) -> Checkpoint:
        return self

    def __exit__(self, *_) -> None:
        """Nothing is left open."""

    def load(self) -> tuple[Any, list[Output]] | None:
        """The state and the outputs of an interrupted run of the same problem, or None if there is none.

        Raises `InputError` for the state of another problem, and for files that were cut off or overwritten.
        """
        path = self.folder / STATE
        if not path.is_file():
            return None
        try:
            kept = _read(path)
        except InputError:
            raise
        except ValueError:  # of another version
            kept = {"fingerprint": None}
        if kept["fingerprint"] != self.fingerprint:
            raise InputError(
                f"checkpoint in {self.folder} belongs to another run (scene, height map, times or version differ); "
                "run the same scene, or give an empty folder"
            )
        self._count = kept["outputs"]
        return kept["state"], [_read(self._output(number)) for number in range(self._count)]

    def append(self, row: np.ndarray, field: np.ndarray) -> None:
        """Add one output."""
        write_checked(self._output(self._count), *encode((row, field)))
        self._count += 1

    def save(self, state) -> None:
        """Replace the state, which consists of dataclasses of this package, numbers and arrays."""
        kept = {"fingerprint": self.fingerprint, "outputs": self._count, "state": state}
        write_checked(self.folder / STATE, *encode(kept))

    def clear(self) -> None:
        """Remove the files of a finished run, and its folders if they are empty then."""
        for path in (self.folder / STATE, *self.folder.glob(f"{OUTPUTS}/*"), *self.folder.glob(f"{PART}*")):
            path.unlink(missing_ok=True)
        for folder in (self.folder / OUTPUTS, self.folder):
            if folder.is_dir() and not any(folder.iterdir()):
                folder.rmdir()

    def _output(self, number: int) -> Path:
        return self.folder / OUTPUTS / f"{number}.bin"


def _read(path: Path):
    content = read_checked(path) if path.is_file() else None
    if content is None:
        raise InputError(f"checkpoint file {path} is damaged (cut or overwritten); give an empty folder to begin again")
    return decode(content, CLASSES)
