"""Files that appear whole or not at all, and files that tell when they were damaged."""

from __future__ import annotations

import hashlib
import os
import uuid
from contextlib import contextmanager, suppress
from pathlib import Path

from ..errors import OutputError

MARK = b"lubfric 1 "  # of a checked file, before the SHA-256 of the rest and a line feed
HEAD = len(MARK) + 65
PART = ".part-"  # begins the name of a file that is being written


def write_whole(path, *content, sync: bool = True) -> None:
    """Replace ``path`` by ``content``, bytes in one or several pieces: a reader, or whoever finds the folder after a
    kill, sees the old file or the new.

    ``sync=False`` leaves the forcing to the disk to the system, for what a loss of power may take. Raises as
    `whole_file`.
    """
    with whole_file(path, sync=sync) as part:
        with part.open("wb", buffering=0) as file:
            for piece in content:
                _write_all(file, piece)


def _write_all(file, piece) -> None:
    """All of ``piece``, of which the system may take less than it is given at once."""
    rest = memoryview(piece)
    while len(rest):
        rest = rest[file.write(rest) :]


@contextmanager
def whole_file(path, *, sync: bool = True):
    """The path of a temporary file in the folder of ``path``, forced to the disk and renamed to it when the block ends
    well.

    It has the same suffix. Missing folders are made. Raises `OutputError`, the old file untouched, when the disk is
    full or the folder is not writable.
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
    """`write_whole`, with a checksum in front that `read_checked` asks for."""
    found = hashlib.sha256()
    for piece in content:
        found.update(piece)
    write_whole(path, MARK + found.hexdigest().encode() + b"\n", *content, sync=sync)


def read_checked(path) -> bytes | None:
    """What `write_checked` wrote, or None where the file was cut or overwritten since."""
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
    """Remove what killed writers left half written in ``folder``; only for who holds its lock."""
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
