"""Files that appear whole or not at all, files that show when they were damaged, one writer a folder, and the files of
a folder that lubfric wrote: only these are ever replaced or removed."""

from __future__ import annotations

import hashlib
import json
import os
import stat
import uuid
import weakref
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

from ..errors import InputError, OutputError

try:
    import fcntl
except ImportError:  # Windows has no fcntl: there the locking of msvcrt serves
    import msvcrt

    fcntl = None  # type: ignore[assignment]

# Begins a checked file; the SHA-256 of its content and a line feed follow.
MARK = b"lubfric 1 "
# Bytes before the content of a checked file: the mark, 64 hexadecimal digits, the line feed. By definition of the file.
HEAD = len(MARK) + 65
# The file in a folder that its writer holds locked.
LOCK = ".lubfric.lock"
# The file in a folder that names the files which lubfric wrote there, with their checksums.
MARKER = ".lubfric"
# Begins the name of a file that is being written.
PART_PREFIX = ".part-"
# The locks that this process holds; a forked child must not hold them too.
_HELD: weakref.WeakSet[FolderLock] = weakref.WeakSet()


def write_whole(path: str | Path, *content: bytes, sync: bool = True) -> None:
    """Replace ``path`` by ``content``, bytes in one or several pieces. Whoever reads the file, even after a kill, sees
    either the old one or the new one, complete.

    ``sync=False`` leaves it to the operating system when the disk gets it, for what may be lost with the power. Raises
    as `whole_file`.
    """
    with whole_file(path, sync=sync) as part, part.open("wb") as file:
        for piece in content:
            file.write(piece)


@contextmanager
def whole_file(path: str | Path, *, sync: bool = True) -> Iterator[Path]:
    """Yield the path of a temporary file in the folder of ``path``. When the block ends well, it is forced to the disk
    and renamed to ``path``.

    It has the same suffix. Missing folders are made. When the disk is full or the folder is not writable, `OutputError`
    is raised and the old file stays as it was.
    """
    path = Path(path)
    with saying(f"{path} was not written"):
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_name(_part(uuid.uuid4().hex[:8], path.name))
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


def _part(drawn: str, name: str) -> str:
    """Return the name of a file that is being written. A checksum in it shows that it is no file of the user."""
    return f"{PART_PREFIX}{drawn}-{hashlib.sha256((drawn + name).encode()).hexdigest()[:8]}-{name}"


def write_checked(path: Path, *content: bytes, sync: bool = True) -> None:
    """Write as `write_whole` does, with a checksum in front for `read_checked`."""
    checksum = hashlib.sha256()
    for piece in content:
        checksum.update(piece)
    write_whole(path, MARK + checksum.hexdigest().encode() + b"\n", *content, sync=sync)


def read_checked(path: Path) -> bytes | None:
    """Return what `write_checked` wrote, or None if the file has been cut off or overwritten since."""
    with saying(f"{path} was not read"):
        data = Path(path).read_bytes()
    content = data[HEAD:]
    if data[:HEAD] != MARK + hashlib.sha256(content).hexdigest().encode() + b"\n":
        return None
    return content


@contextmanager
def saying(what: str) -> Iterator[None]:
    """Turn an operating system's error into one `OutputError` that begins with ``what``."""
    try:
        yield
    except OutputError:
        raise
    except OSError as error:
        raise OutputError(f"{what}: {error.strerror or error}") from error


def checksum_of_file(path: str | Path) -> str:
    """Return the SHA-256, hexadecimal, of the file at ``path``."""
    with saying(f"surface.file = {path} was not read"), open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def clear_parts(folder: Path) -> None:
    """Remove the half-written files of killed writers in ``folder``. Only the holder of its lock may do this."""
    for path in Path(folder).glob(f"{PART_PREFIX}*"):
        drawn, _, rest = path.name.removeprefix(PART_PREFIX).partition("-")
        if path.name == _part(drawn, rest.partition("-")[2]):
            path.unlink(missing_ok=True)


def is_checked(path: Path) -> bool:
    """Return whether `write_checked` wrote ``path`` and nobody changed it since. A link to such a file does not
    count."""
    return path.is_file() and not path.is_symlink() and read_checked(path) is not None


def clear_checked(folder: Path, *patterns: str) -> None:
    """Remove the files in ``folder`` that match one of ``patterns`` and that `write_checked` wrote; what killed writers
    left; and the folder, if it is empty then."""
    if folder.is_dir() and not folder.is_symlink():
        clear_parts(folder)
        for path in (path for pattern in patterns for path in folder.glob(pattern)):
            if is_checked(path):
                path.unlink()
        if not any(folder.iterdir()):
            folder.rmdir()


def sync_folder(folder: Path) -> None:
    """Force the names in a folder to the disk, where the system can (not on Windows)."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


class FolderLock:
    """``with FolderLock(folder):`` makes the folder and locks it. Refuses with `InputError` while another process
    holds the lock, and where a file of the user has its name.

    The lock is held by the open file. So a killed process leaves no lock behind; only its file stays.
    """

    def __init__(self, folder: str | Path):
        self.path = Path(folder) / LOCK
        self._file: Any = None

    def __enter__(self) -> FolderLock:
        while self._file is None:
            with saying(f"the folder {self.path.parent} cannot be used, give another one"):
                self.path.parent.mkdir(parents=True, exist_ok=True)
                if self.path.is_symlink():
                    raise InputError(f"{self.path} is a link; remove it, or give another folder")
                handle = os.open(self.path, os.O_RDWR | os.O_APPEND | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o666)
                self._file = open(handle, "a+", encoding="ascii", errors="replace")
            self._take()
            if not self._is_still_there():  # that of a run which ended, and removed it, meanwhile
                self.drop()
        if not stat.S_ISREG(os.fstat(self._file.fileno()).st_mode) or self._holder() is None:
            self.drop()
            raise InputError(f"{self.path} is not a lock file of lubfric; move it away, or give another folder")
        with saying(f"{self.path} was not written"):
            self._file.truncate(0)
            self._file.write(f"lubfric {os.getpid()}")
            self._file.flush()
        _HELD.add(self)
        return self

    def __exit__(self, *_: object) -> None:
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
            holder = self._holder() or "unknown"
            self.drop()
            raise InputError(
                f"{self.path.parent} is being written by another run (process {holder}); "
                "give another folder, or wait until it ends"
            ) from None

    def _holder(self) -> str | None:
        """Return the process that is written in the file; None where it holds something else."""
        self._file.seek(0)
        words = self._file.read(80).split()
        if not words:
            return ""
        return words[1] if len(words) == 2 and words[0] == "lubfric" else None

    def _is_still_there(self) -> bool:
        try:
            return os.path.samestat(os.fstat(self._file.fileno()), self.path.stat())
        except FileNotFoundError:
            return False


def _drop_in_child() -> None:
    for lock in list(_HELD):
        lock.drop()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_drop_in_child)


class OwnFiles:
    """The files of ``folder`` that lubfric wrote, and the rule by which a command spares all others:

    1. The marker ``.lubfric`` of a folder names each file that a command wrote there, with the checksum of its
        content.
    2. A command replaces and removes only files that the marker names and that still have this content: no other file,
        none that was changed since, no link.
    3. Where one of its results would take the name of another file, or of one of its inputs, a command is refused
        before any work.
    4. The new results are complete on the disk, and the marker names old and new ones, before the first old one goes:
        what a kill or a full disk leaves is still ours, and ``result.json`` exists only together with all files that
        it names.
    5. One command at a time writes to a folder (`FolderLock`).
    """

    def __init__(self, folder: str | Path):
        self.folder = Path(folder)
        self._checksums: dict[str, list[str]] = {}  # of the contents that are ours, by the name of the file
        marker = self.folder / MARKER
        if os.path.lexists(marker):
            try:
                named: Any = json.loads(read_checked(marker) or b"") if is_checked(marker) else None
                self._checksums = {str(name): list(sums) for name, sums in named.items() if Path(name).name == name}
            except (ValueError, TypeError, AttributeError, RecursionError):
                message = f"{marker} is damaged, or no marker of lubfric"
                raise InputError(f"{message}; remove it, or give another folder") from None

    def among(self, patterns: Iterable[str]) -> list[str]:
        """Return the names of our files that match one of ``patterns`` (as of a shell)."""
        patterns = list(patterns)
        return [name for name in self._checksums if any(fnmatch(name, p) for p in patterns) and self._owns(name)]

    def _owns(self, name: str) -> bool:
        path = self.folder / name
        if path.is_symlink() or not path.is_file():
            return False
        return _checksum(path.read_bytes()) in self._checksums.get(name, ())

    def check(self, names: Iterable[str], inputs: Iterable[str | Path] = ()) -> None:
        """Raise `InputError` if one of the files ``names`` is there and not ours, or is one of the ``inputs``."""
        inputs = list(inputs)
        for path in (self.folder / name for name in names):
            if any(path.exists() and os.path.samefile(path, read) for read in inputs):
                raise InputError(f"{path} is read by this command and would be replaced; give another folder")
            if os.path.lexists(path) and not self._owns(path.name):
                message = f"{path} was not written by lubfric, or was changed since; this command would replace it"
                raise InputError(f"{message}; move it away, or give another folder")

    def replace(self, contents: dict[str, bytes], patterns: Iterable[str] = ()) -> None:
        """Put ``contents`` by name in the folder, in their order, and remove our other files that match ``patterns``.

        The last of ``contents`` says that the others are complete: it is removed first, and appears last. Only the
        holder of the folder's lock may do this. Raises `OutputError`.
        """
        self.check(contents)
        stale = self.among(patterns)
        new = {name: [_checksum(content)] for name, content in contents.items()}
        last = list(contents)[-1]
        with ExitStack() as written:  # its files appear in the opposite order
            for name in reversed(contents):
                written.enter_context(whole_file(self.folder / name)).write_bytes(contents[name])
            self._mark(self._checksums | {name: self._checksums.get(name, []) + new[name] for name in new})
            for name in sorted(stale, key=lambda name: name != last):
                if name == last or name not in new:
                    (self.folder / name).unlink()
        self._mark({name: sums for name, sums in self._checksums.items() if name not in stale} | new)

    def remove(self, patterns: Iterable[str]) -> None:
        """Remove our files that match ``patterns``; and the folder, where it has nothing else. Raises `OutputError`."""
        stale = self.among(patterns)
        for name in stale:
            (self.folder / name).unlink()
        self._mark({name: sums for name, sums in self._checksums.items() if name not in stale})
        if [path.name for path in self.folder.iterdir()] == [MARKER]:
            (self.folder / MARKER).unlink()
            self.folder.rmdir()

    def _mark(self, checksums: dict[str, list[str]]) -> None:
        write_checked(self.folder / MARKER, json.dumps(checksums, indent=0).encode())
        self._checksums = checksums


def _checksum(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
