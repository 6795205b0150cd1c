"""An append-only set of records: one line each, with its checksum, in a file of its own for every writer."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import socket
import time
import uuid
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

from .._base import saying, sync_folder

CHECK = 16  # hexadecimal digits of the SHA-256 in front of a line
SYNC = 1.0  # s between two forcings to the disk


class Records:
    """Records by key in ``folder``: any number of processes may add, each to its own file, while others read.

    A line is ``<checksum> {"key": ..., "value": ...}`` in strict JSON. Lines are only ever added. When `add` returns,
    the operating system has the line, and keeps it whatever happens to this process.

    Lines are forced to the disk by `close`, and by the first line that is added a second or more after the last
    forcing. A loss of power can take the lines since then. A line that was cut off or overwritten fails its checksum
    and counts as absent.
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        self._file = None
        self._synced = 0.0

    def add(self, key: str, value, sync: bool = False) -> None:
        """Add one record; ``value`` in plain JSON types. ``sync``: force it to the disk at once. Raises `OutputError`
        when it cannot be kept."""
        text = json.dumps({"key": key, "value": value}, allow_nan=False).encode()
        line = _checksum(text) + b" " + text + b"\n"
        with saying(f"a record in {self.folder} was not written"):
            if self._file is None:
                self._file = self._new_file()
            whole = self._file.tell()
            try:
                if self._file.write(line) < len(line):
                    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
                if sync or time.monotonic() - self._synced > SYNC:
                    self._sync(self._file)
            except OSError:
                with suppress(OSError):
                    self._file.truncate(whole)
                raise

    def read(self) -> Iterator[tuple[str, dict]]:
        """Every undamaged record as (key, value), each key once: the first found."""
        seen = set()
        for path in sorted(self.folder.glob("*.jsonl")):
            with saying(f"{path} was not read"), path.open("rb") as file:
                for line in file:
                    record = _parsed(line)
                    if record is not None and record["key"] not in seen:
                        seen.add(record["key"])
                        yield record["key"], record["value"]

    def close(self) -> None:
        """Close the file of this writer; the next `add` begins another."""
        if self._file is not None:
            with saying(f"records in {self.folder} were not forced to the disk"):
                self._sync(self._file)
                self._file.close()
            self._file = None

    def _sync(self, file) -> None:
        os.fsync(file.fileno())
        self._synced = time.monotonic()

    def __enter__(self) -> Records:
        return self

    def __exit__(self, *_) -> None:
        self.close()

    def _new_file(self):
        self.folder.mkdir(parents=True, exist_ok=True)
        name = f"{socket.gethostname()}-{os.getpid()}-{uuid.uuid4().hex[:8]}.jsonl"
        file = (self.folder / name).open("xb", buffering=0)
        sync_folder(self.folder)
        return file


def growth(folder) -> Callable[[], int]:
    """A function that counts the lines added to the records in ``folder`` since this call. It reads only new bytes, and
    does not look at what the lines say."""
    ends = {path: path.stat().st_size for path in Path(folder).glob("*.jsonl")}
    count = 0

    def added() -> int:
        nonlocal count
        for path in Path(folder).glob("*.jsonl"):
            with path.open("rb") as file:
                file.seek(ends.get(path, 0))
                new = file.read()
            ends[path] = ends.get(path, 0) + len(new)
            count += new.count(b"\n")
        return count

    return added


def _checksum(text: bytes) -> bytes:
    return hashlib.sha256(text).hexdigest()[:CHECK].encode()


def _parsed(line: bytes):
    text = line[CHECK + 1 : -1]
    if line[-1:] != b"\n" or line[: CHECK + 1] != _checksum(text) + b" ":
        return None
    return json.loads(text)
