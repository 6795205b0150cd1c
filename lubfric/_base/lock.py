"""One writer a folder: a lock that the system drops when its holder dies."""

from __future__ import annotations

import os
import weakref
from pathlib import Path

from ..errors import InputError
from .files import saying

try:
    import fcntl
except ImportError:  # Windows has no fcntl: there the locking of msvcrt serves
    import msvcrt

    fcntl = None  # type: ignore[assignment]

NAME = ".lock"
_HELD: weakref.WeakSet = weakref.WeakSet()  # by this process; a forked child must not hold them too


class FolderLock:
    """``with FolderLock(folder):`` makes the folder and locks it. Refuses with `InputError` while another process holds
    the lock.

    The lock is held by the open file. So a killed process leaves no lock behind; only its file stays.
    """

    def __init__(self, folder):
        self.path = Path(folder) / NAME
        self._file = None

    def __enter__(self) -> FolderLock:
        while True:
            with saying(f"{self.path.parent} cannot be used"):
                self.path.parent.mkdir(parents=True, exist_ok=True)
                file = self.path.open("a+")
            self._take(file)
            if _still_there(file, self.path):  # not that of a run which ended, and removed it, meanwhile
                break
            file.close()
        with saying(f"{self.path} was not written"):
            file.seek(0)
            file.truncate()
            file.write(str(os.getpid()))
            file.flush()
        self._file = file
        _HELD.add(self)
        return self

    def __exit__(self, *_) -> None:
        if fcntl is not None:
            self.path.unlink(missing_ok=True)
        self.drop()

    def drop(self) -> None:
        """Close the file: this process holds the lock no more."""
        _HELD.discard(self)
        if self._file is not None:
            self._file.close()
        self._file = None

    def _take(self, file) -> None:
        try:
            _lock(file)
        except OSError:
            file.seek(0)
            holder = file.read().strip() or "unknown"
            file.close()
            raise InputError(
                f"{self.path.parent} is being written by another run (process {holder}); "
                "give another folder, or wait until it ends"
            ) from None


def _lock(file) -> None:
    if fcntl is not None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    else:
        file.seek(2**20)  # beyond what is written, so that others can read who holds it
        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)


def _still_there(file, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(file.fileno()), path.stat())
    except FileNotFoundError:
        return False


def _drop_in_child() -> None:
    for lock in list(_HELD):
        lock.drop()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_drop_in_child)
