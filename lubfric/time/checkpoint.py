"""The state of a run on disk, written after every step, so that a kill loses nothing that was computed.

State and outputs are files with checksums, each replaced as a whole. The state carries a fingerprint of the problem and
the number of outputs so far, which are written before it.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .._base import clear_checked, read_checked, validate, write_checked
from ..errors import InputError
from ..sharing import Validity
from ..studies import classes_of, decode, encode, fingerprint
from .film_setting import FilmStep
from .march import Progress
from .sharing import Contact

STATE, OUTPUTS = "state.bin", "output_*.bin"
CLASSES = classes_of(Progress, FilmStep, Contact, Validity)  # that a state or an output may hold


class Checkpoint:
    """A folder that holds the state of one run.

    ``description``: everything that decides the result, for `lubfric.studies.fingerprint`: the prepared scene with its
    heights and spacing, the histories, the output times.
    """

    def __init__(self, folder, *description):
        self.folder = validate.folder("checkpoint", folder)
        self.fingerprint = fingerprint(*description)
        self._count = 0
        for path in (*self.folder.glob(STATE), *self.folder.glob(OUTPUTS)):
            _content(path)  # raises InputError for a file of somebody else, which would be replaced

    def load(self) -> tuple[Any, list[Any]] | None:
        """The state and the outputs of an interrupted run of the same problem, or None if there is none.

        Raises `InputError` for the state of another problem, and for files that were cut off or overwritten.
        """
        if not (self.folder / STATE).is_file():
            return None
        content = _content(self.folder / STATE)
        try:
            kept = decode(content, CLASSES)
        except ValueError:  # of another version
            kept = {"fingerprint": None}
        if kept["fingerprint"] != self.fingerprint:
            raise InputError(
                f"checkpoint in {self.folder} belongs to another run (scene, height map, times or version differ); "
                "run the same scene, or give an empty folder"
            )
        self._count = kept["outputs"]
        return kept["state"], [decode(_content(self._output(number)), CLASSES) for number in range(self._count)]

    def append(self, output) -> None:
        """Add one output: like the state, of dataclasses of this package, dicts, numbers and arrays."""
        write_checked(self._output(self._count), *encode(output))
        self._count += 1

    def save(self, state) -> None:
        """Replace the state."""
        kept = {"fingerprint": self.fingerprint, "outputs": self._count, "state": state}
        write_checked(self.folder / STATE, *encode(kept))

    def clear(self) -> None:
        """Remove the files of a finished run, and its folder if it is empty then."""
        clear_checked(self.folder, STATE, OUTPUTS)

    def _output(self, number: int) -> Path:
        return self.folder / OUTPUTS.replace("*", f"{number:07d}")


def _content(path: Path) -> bytes:
    content = read_checked(path) if path.is_file() and not path.is_symlink() else None
    if content is None:
        raise InputError(
            f"checkpoint file {path} is damaged (cut or overwritten), or not of lubfric; give an empty folder to begin "
            "again"
        )
    return content
