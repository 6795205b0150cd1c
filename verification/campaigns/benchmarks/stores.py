"""The store of points, a file each, against SQLite and zarr: time, size, files, four writers at once, kills.

    python -m verification.campaigns.benchmarks.stores [--points 10000] [--only NAME ...] [--folder FOLDER] [--docs
    docs]

Each store gets the same encoded point under other keys, by one process and then by WORKERS processes, and gives all of
them back. Then writers are killed, and what they had reported as written is looked for. Stores that are not installed
are left out.
"""

import argparse
import multiprocessing
import os
import resource
import shutil
import signal
import sqlite3
import tempfile
import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import partial
from importlib import import_module, util
from pathlib import Path
from typing import Any

import lubfric
from lubfric.studies.codec import encode
from lubfric.studies.store import Store, digest

from . import page

# Wait of a writer for the lock of SQLite [s].
PATIENCE = 60.0
# Writers that are killed, one after the other, and the time that each has [s].
KILLS = 5
LIFE = 0.4
# Points of the array of zarr, at most.
MOST = 1_000_000


class PointStore(ABC):
    """A store of encoded points by number, in a folder."""

    def __init__(self, folder: Path):
        self.folder = folder

    @abstractmethod
    def add(self, number: int, record: bytes) -> None:
        """Keep ``record``."""

    @abstractmethod
    def read(self, numbers: Iterable[int]) -> Iterable[bytes | None]:
        """Yield a mark for each of the ``numbers`` whose record is there and sound, None for others."""

    @abstractmethod
    def listed(self) -> int:
        """Return how many records there are, without reading them."""


class Files(PointStore):
    """lubfric's: a file for each point, complete or absent, with a checksum."""

    def __init__(self, folder: Path):
        super().__init__(folder)
        self.store = Store(folder)
        self.value = _point()

    def add(self, number: int, record: bytes) -> None:
        self.store.add(digest(number), self.value)

    def read(self, numbers: Iterable[int]) -> Iterable[bytes | None]:
        for number in numbers:
            yield self.store.get(digest(number)) and b"there"

    def listed(self) -> int:
        return sum(entry.name.endswith(".bin") for entry in os.scandir(self.folder / "points"))


class Database(PointStore):
    """SQLite with a write-ahead log, a transaction for each point."""

    def __init__(self, folder: Path):
        super().__init__(folder)
        folder.mkdir(exist_ok=True)
        self.database = sqlite3.connect(folder / "points.db", timeout=PATIENCE, isolation_level=None)
        self.database.execute("pragma journal_mode=wal")
        self.database.execute("pragma synchronous=normal")
        self.database.execute("create table if not exists points (key text primary key, record blob)")

    def add(self, number: int, record: bytes) -> None:
        encoded = b"".join(encode(_point()))
        self.database.execute("insert or replace into points values (?, ?)", (digest(number), encoded))

    def read(self, numbers: Iterable[int]) -> Iterable[bytes | None]:
        store = Store(None)
        decode = import_module("lubfric.studies.codec").decode
        for number in numbers:
            row = self.database.execute("select record from points where key = ?", (digest(number),)).fetchone()
            yield row and decode(row[0], store.classes, Any) and b"there"

    def listed(self) -> int:
        return int(self.database.execute("select count(*) from points").fetchone()[0])


class Chunks(PointStore):
    """zarr with a chunk, which is a file, for each point: two writers of one chunk would overwrite each other."""

    def __init__(self, folder: Path):
        super().__init__(folder)
        zarr = import_module("zarr")
        size = len(b"".join(encode(_point())))
        if not folder.exists():
            zarr.create_array(store=str(folder), shape=(MOST, size), chunks=(1, size), dtype="u1", compressors=None)
        self.array = zarr.open_array(str(folder), mode="r+")

    def add(self, number: int, record: bytes) -> None:
        encoded = b"".join(encode(_point()))
        self.array[number] = memoryview(encoded)

    def read(self, numbers: Iterable[int]) -> Iterable[bytes | None]:
        store = Store(None)
        decode = import_module("lubfric.studies.codec").decode
        for number in numbers:
            record = self.array[number].tobytes()
            yield decode(record, store.classes, Any) and b"there" if any(record[:8]) else None

    def listed(self) -> int:
        return sum(len(files) for _, _, files in os.walk(self.folder)) - 1


STORES: dict[str, type[PointStore]] = {"files": Files, "SQLite": Database}
if util.find_spec("zarr"):
    STORES["zarr"] = Chunks
_POINT: list[Any] = []


def _point() -> Any:
    if not _POINT:
        scene = lubfric.load_scene("paper").with_(numerics={"sampling": "patch", "model": "paper"})
        _POINT.append(lubfric.friction(scene, 0.03).without_fields())
    return _POINT[0]


def write(kind: type[PointStore], folder: Path, numbers: range) -> None:
    """Write points of these ``numbers``."""
    store = kind(folder)
    for number in numbers:
        store.add(number, b"")


def write_and_report(kind: type[PointStore], folder: Path, first: int, pipe: Any) -> None:
    """Write points from number ``first`` on without end, and report each that is written."""
    store = kind(folder)
    number = first
    while True:
        store.add(number, b"")
        pipe.send(number)
        number += 1


def lost_by_kills(kind: type[PointStore], folder: Path) -> tuple[int, int]:
    """Return how many points killed writers had reported, and how many of them are not there."""
    reported: list[int] = []
    context = multiprocessing.get_context("fork")
    for turn in range(KILLS):
        (receiving, sending) = context.Pipe(duplex=False)
        process = context.Process(target=write_and_report, args=(kind, folder, turn * 10_000, sending))
        process.start()
        sending.close()
        end = time.monotonic() + LIFE
        while time.monotonic() < end:
            if receiving.poll(0.01):
                reported.append(receiving.recv())
        assert process.pid is not None
        os.kill(process.pid, signal.SIGKILL)
        process.join()
        with suppress(EOFError):
            while True:
                reported.append(receiving.recv())
    return len(reported), sum(record is None for record in kind(folder).read(reported))


def timed(call: Callable[[], object]) -> float:
    """Return the processor time [s] of a ``call``."""
    used = time.process_time()
    call()
    return time.process_time() - used


def row_of(name: str, root: Path, points: int, workers: int) -> list[str]:
    """Return the row of the store ``name``."""
    kind = STORES[name]
    folder = root / name
    writing = timed(partial(write, kind, folder, range(points)))
    store = kind(folder)
    listing = timed(store.listed)
    reading = timed(lambda: sum(record is not None for record in store.read(range(points))))
    files = [path for path in folder.rglob("*") if path.is_file()]
    size = sum(path.stat().st_blocks * 512 for path in files)
    share = points // workers
    jobs = [
        multiprocessing.get_context("fork").Process(
            target=write, args=(kind, root / f"{name}-shared", range(k * share, (k + 1) * share))
        )
        for k in range(workers)
    ]
    kind(root / f"{name}-shared")

    def together() -> None:
        for job in jobs:
            job.start()
        for job in jobs:
            job.join()

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    together()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    shared = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    read = sum(record is not None for record in kind(root / f"{name}-shared").read(range(share * workers)))
    (reported, lost) = lost_by_kills(kind, root / f"{name}-killed")
    return [
        name,
        f"{1e3 * writing / points:.2f}",
        f"{1e3 * reading / points:.2f}",
        f"{listing:.2f}",
        f"{size / points / 1e3:.1f}",
        f"{len(files)}",
        f"{1e3 * shared / points:.2f}",
        f"{share * workers - read}",
        f"{lost}",
    ]


COLUMNS = ("store", "ms to write", "to read", "s to list", "kB", "files", "ms, 4 writers", "lost", "by kills")


def main() -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=10_000)
    parser.add_argument("--workers", type=int, default=4)
    parser.add_argument("--only", nargs="+", default=list(STORES), choices=STORES, help="default: all")
    parser.add_argument("--folder", type=Path, help="where the stores are made: a network file system, for example")
    page.add_option(parser)
    arguments = parser.parse_args()
    root = Path(tempfile.mkdtemp(dir=arguments.folder))
    _point()
    rows = []
    try:
        for name in arguments.only:
            rows.append(row_of(name, root, arguments.points, arguments.workers))
            print(*rows[-1], sep=" | ", flush=True)
    finally:
        shutil.rmtree(root)
    places = [COLUMNS.index(name) for name in ("store", "ms to write", "to read", "kB", "files")]
    in_page = [[row[place] for place in places] for row in rows]
    page.write("stores", [COLUMNS[place] for place in places], in_page, (parser, arguments))


if __name__ == "__main__":
    main()
