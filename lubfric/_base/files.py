"""Files that appear whole or not at all, files that tell when they were damaged, and one writer a folder."""

from __future__ import annotations

import hashlib
import os
import uuid
import weakref
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from ..errors import InputError, OutputError

try:
    import fcntl
except ImportError:  # Windows has no fcntl: there the locking of msvcrt serves
    import msvcrt

    fcntl = None  # type: ignore[assignment]

MARK = b"lubfric 1 "  # of a checked file, before the SHA-256 of the rest and a line feed
HEAD = len(MARK) + 65
LOCK = ".lock"  # the file in a folder that its writer holds locked
PART = ".part-"  # begins the name of a file that is being written
_HELD: weakref.WeakSet = weakref.WeakSet()  # by this process; a forked child must not hold them too


def write_whole(path, *content, sync: bool = True) -> None:
    """Replace ``path`` by ``content``, bytes in one or several pieces. Whoever reads the file, even after a kill, sees
    either the old one or the new one, complete.

    ``sync=False`` leaves it to the operating system when the disk gets it, for what may be lost with the power. Raises
    as `whole_file`.
    """
    with whole_file(path, sync=sync) as part, part.open("wb") as file:
        for piece in content:
            file.write(piece)


@contextmanager
def whole_file(path, *, sync: bool = True):
    """The path of a temporary file in the folder of ``path``. When the block ends well, it is forced to the disk and
    renamed to ``path``.

    It has the same suffix. Missing folders are made. When the disk is full or the folder is not writable, `OutputError`
    is raised and the old file stays as it was.
    """
    path = Path(path)
    with saying(f"{path} was not written"):
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_name(f"{PART}{uuid.uuid4().hex[:8]}-{path.name}")
        try:
            yield part
            if sync:
                with part.open("rb+") as file:
                    os.fsync(file.fileno())
            os.replace(part, path)
        except BaseException:
            with suppress(OSError):
                part.unlink()
            raise
        if sync:
            sync_folder(path.parent)


def write_checked(path, *content, sync: bool = True) -> None:
    """`write_whole`, with a checksum in front for `read_checked`."""
    found = hashlib.sha256()
    for piece in content:
        found.update(piece)
    write_whole(path, MARK + found.hexdigest().encode() + b"\n", *content, sync=sync)


def read_checked(path) -> bytes | None:
    """What `write_checked` wrote, or None if the file has been cut off or overwritten since."""
    with saying(f"{path} was not read"):
        data = Path(path).read_bytes()
    content = data[HEAD:]
    if data[:HEAD] != MARK + hashlib.sha256(content).hexdigest().encode() + b"\n":
        return None
    return content


@contextmanager
def saying(what: str):
    """Turn an operating system's error into one `OutputError` that begins with ``what``."""
    try:
        yield
    except OutputError:
        raise
    except OSError as error:
        raise OutputError(f"{what}: {error.strerror or error}") from error


def clear_parts(folder) -> None:
    """Remove the half-written files of killed writers in ``folder``. Only the holder of its lock may do this."""
    for path in Path(folder).glob(f"{PART}*"):
        path.unlink(missing_ok=True)


def sync_folder(folder: Path) -> None:
    """Force the names in a folder to the disk, where the system can (not on Windows)."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


class FolderLock:
    """``with FolderLock(folder):`` makes the folder and locks it. Refuses with `InputError` while another process holds
    the lock.

    The lock is held by the open file. So a killed process leaves no lock behind; only its file stays.
    """

    def __init__(self, folder):
        self.path = Path(folder) / LOCK
        self._file: Any = None

    def __enter__(self) -> FolderLock:
        while self._file is None:
            with saying(f"{self.path.parent} cannot be used"):
                self.path.parent.mkdir(parents=True, exist_ok=True)
                self._file = self.path.open("a+")
            self._take()
            if not self._still_there():  # that of a run which ended, and removed it, meanwhile
                self.drop()
        with saying(f"{self.path} was not written"):
            self._file.seek(0)
            self._file.truncate()
            self._file.write(str(os.getpid()))
            self._file.flush()
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

    def _take(self) -> None:
        try:
            if fcntl is not None:
                fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            else:
                self._file.seek(2**20)  # beyond what is written, so that others can read who holds it
                msvcrt.locking(self._file.fileno(), msvcrt.LK_NBLCK, 1)
        except OSError:
            self._file.seek(0)
            holder = self._file.read().strip() or "unknown"
            self.drop()
            raise InputError(
                f"{self.path.parent} is being written by another run (process {holder}); "
                "give another folder, or wait until it ends"
            ) from None

    def _still_there(self) -> bool:
        try:
            return os.path.samestat(os.fstat(self._file.fileno()), self.path.stat())
        except FileNotFoundError:
            return False


def _drop_in_child() -> None:
    for lock in list(_HELD):
        lock.drop()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_drop_in_child)
