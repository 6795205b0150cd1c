"""What the commands share: messages, interrupts, and the folder that they write, in which only files of ours are ever
replaced. A broken stream or an interrupt never costs what was computed."""

from __future__ import annotations

import json
import os
import platform
import re
import shlex
import signal
import sys
import tempfile
import textwrap
import threading
import time
import tomllib
from argparse import Namespace
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import asdict, dataclass, fields
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple, get_type_hints

import numpy as np

from .._base import (
    FolderLock,
    OwnFiles,
    __version__,
    clear_checked,
    clear_parts,
    figures,
    files,
    plain,
    read_json,
    validate,
)
from .._base.processes import begin_beside
from .._base.processor_time import processor_time
from ..errors import InputError, OutputError
from ..models import prepare
from ..models.shared import Prepared, Violation, refused, violations_by_unusual_inputs
from ..quantities import KEYS, Quantity, described
from ..scene import OPTIONS_KEY, Scene
from ..studies import Law, Store, fingerprint_without_files, fits
from ..surface import rms_slope
from ..time import without_work_limit
from .describe import SceneEstimate, estimate_scene
from .pictures import plot_surface
from .progress import clear_active, state_part
from .report import report_page
from .run_files import (
    BIBTEX_FILE,
    OUTPUTS,
    PICTURE_FORMATS,
    PICTURES_SO_FAR,
    RESOLVED_SCENE,
    RESULT,
    SO_FAR,
)

# Exit codes, the second argument of a KeyboardInterrupt: by definition of shells 128 and the number of the signal.
INTERRUPTED = 130
TERMINATED = 143
_CONTROL = re.compile("[\x00-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069]")

# Blanks at which no line is broken: before a percent sign, and beside an equals sign; and what stands for them meanwhile.
BOUND = re.compile(r" (?=%)| (?== )|(?<= =) ")
KEPT_BLANK = "\N{NO-BREAK SPACE}"

# Choices, for lines that can be read.
SAY_EVERY = 1.0  # s between two lines of progress
PROGRESS_SECONDS = 60.0  # s between two lines on how far a point is, where no terminal shows it on one line
CONSOLE_WIDTH = 100  # characters of a line of what no terminal shows, as a file or a pipe
LEAST_CONSOLE_WIDTH = 40  # characters of a line on a narrower terminal
HANGING_INDENT = 4  # blanks before the continuation of a line, more than before the line


def wrapped(text: str, stream: Any) -> str:
    """Return ``text`` with its lines broken between words to the width of ``stream``: $COLUMNS, or that of the
    terminal, or `CONSOLE_WIDTH` where it is none. Continued lines are indented further."""
    width = max(LEAST_CONSOLE_WIDTH, _width_of(stream))
    lines = []
    for line in text.split("\n"):
        indent = " " * (len(line) - len(line.lstrip()) + HANGING_INDENT)
        fitting = [line]
        if len(line) > width:
            fitting = textwrap.wrap(
                BOUND.sub(KEPT_BLANK, line),
                width,
                subsequent_indent=indent,
                break_long_words=False,
                break_on_hyphens=False,
            )
        lines += [each.replace(KEPT_BLANK, " ") for each in fitting]
    return "\n".join(lines)


def _width_of(stream: Any) -> int:
    """Return the number of characters of a line of ``stream``."""
    words = os.environ.get("COLUMNS", "")
    if words.isdecimal() and int(words) > 0:
        return int(words)
    with suppress(OSError, ValueError, AttributeError):  # no terminal, a closed file, no stream at all
        return os.get_terminal_size(stream.fileno()).columns or CONSOLE_WIDTH
    return CONSOLE_WIDTH


def say(text: str) -> None:
    """Write one line to stderr, `wrapped`; silence once nobody reads it."""
    clear_active()
    put(sys.stderr, wrapped(text, sys.stderr) + "\n")


def put(stream: Any, text: str) -> None:
    """Write to ``stream`` what a terminal can show. A stream that is closed or broken is replaced by one that goes
    nowhere."""
    try:
        stream.write(printable(text, getattr(stream, "encoding", None)))
        stream.flush()
    except (OSError, ValueError, AttributeError):  # a closed pipe, a closed file, no stream at all
        with suppress(OSError, ValueError, AttributeError):
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, stream.fileno())
            os.close(nowhere)


def answer(text: str) -> None:
    """Write the answer of a command to stdout, `wrapped`. Raise `OutputError` where it cannot be written, as on a full
    disk; a pipe that nobody reads any more is no error."""
    try:
        sys.stdout.write(printable(wrapped(text, sys.stdout), getattr(sys.stdout, "encoding", None)))
        sys.stdout.flush()
    except BrokenPipeError:
        put(sys.stdout, "")
    except (OSError, ValueError, AttributeError) as error:
        put(sys.stdout, "")
        raise OutputError(f"standard output was not written ({getattr(error, 'strerror', None) or error})") from None


def printable(text: str, encoding: str | None) -> str:
    """Return ``text`` with control characters, signs that change the direction of writing, and what ``encoding`` does
    not have as escapes: the name of a scene moves no cursor and hides no line."""
    shown = "".join(c if c in "\n\t" or not _CONTROL.match(c) else c.encode("unicode_escape").decode() for c in text)
    code = encoding or "utf-8"
    return shown.encode(code, "backslashreplace").decode(code)


def paced() -> Callable[..., bool]:
    """Return what says whether progress is to be reported now: a second after the last time, and at the ``end``."""
    last_report = time.perf_counter()

    def due(*, end: bool) -> bool:
        nonlocal last_report
        now = time.perf_counter()
        if not end and now - last_report < SAY_EVERY:
            return False
        last_report = now
        return True

    return due


def moment_reports(interval: float = PROGRESS_SECONDS) -> Callable[[str, int, int], None]:
    """Return what reports how far a point is: on the line of progress of the command, else in a line every ``interval``
    [s] at most."""
    last = time.monotonic()

    def report(what: str, done: int, total: int) -> None:
        nonlocal last
        now = time.monotonic()
        words = f"now {what}: step {done} of {total}"
        if not state_part(words) and now - last >= interval:
            last = now
            say(f"      {words}")

    return report


@contextmanager
def interruptible() -> Iterator[None]:
    """Let SIGTERM end what is inside as Ctrl-C does, so that locks are dropped and files closed."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def terminate(*_: object) -> None:
        raise KeyboardInterrupt("terminated", TERMINATED)

    before = signal.signal(signal.SIGTERM, terminate)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


@contextmanager
def keeping(what: Callable[[], str]) -> Iterator[None]:
    """Say on an interrupt that ``what()`` is kept, and that the same command continues from there; "": nothing is."""
    try:
        yield
    except KeyboardInterrupt as error:
        kept = what()
        message = f"interrupted; {kept}: the same command continues from there"
        if not kept:
            message = (
                "interrupted; no result is complete so far, so none is kept: the same command starts from the beginning"
            )
        raise KeyboardInterrupt(message, *error.args[1:] or (INTERRUPTED,)) from None


UNFINISHED = "unfinished"
MOST_TOML = 2**20  # bytes: a larger file names no inputs; a choice: less misses long scenes, more reads in vain
# Options of commands that name files they read.
INPUTS = ("scene", "surface", "counterface", "study", "measured", "points")


@contextmanager
def run_begun(
    scene: Scene,
    arguments: Namespace,
    names: Iterable[str],
    kept: Callable[[], str] | None,
    *key: Any,
    kept_by: str = "",
    **places: Any,
) -> Iterator[tuple[RunFolder, Prepared, SceneEstimate]]:
    """Begin a run of ``scene``, which writes files with these ``names``: its `RunFolder`, known again by ``key``, the
    scene made ready, and what is estimated of it (`SceneEstimate`) at ``places``. On an interrupt ``kept()`` is said,
    if anything is. ``kept_by``: the kind of a run whose saved points any run of that kind and the same scene uses,
    whatever its ``key``; "": only the same run does.

    The folder is touched last, and what an earlier run left in it stays until `RunFolder.complete`.
    """
    begun = CommandStart.now()
    check_outputs(arguments, arguments.out, names, OUTPUTS)
    unusual = violations_by_unusual_inputs(scene)
    refused(unusual, accept=scene.numerics.accept)  # before the map is made, which the wrong unit may make large
    for violation in unusual:
        say(violation.text)
    say(f"{scene.name}: preparing the height map and the contact")
    prepared = prepare(scene)
    checksums = map_checksums(scene)  # now: the files may change while the run goes on
    estimate = estimate_scene(scene, prepared.sample, prepared.surface, **places, measures=True)
    for row in (
        *estimate.sections["surface"],
        *(f"estimate: {text}" for text in (estimate.cost, *estimate.refusals) if text),
    ):
        say(row)
    saying = keeping(kept) if kept else nullcontext()
    fingerprint = fingerprint_without_files(prepared, *key)
    states = fingerprint_without_files(prepared, kept_by) if kept_by else fingerprint
    if scene.transient is not None:  # a larger limit continues it
        states = fingerprint_without_files(without_work_limit(prepared), *key)
    with saying, run_folder(arguments.out, begun, fingerprint, states) as folder:
        folder.map_checksums = checksums
        begin_beside(figures.make_ready)  # while it is solved
        if folder.has_other_states and not folder.unfinished.is_dir():
            say(
                f"{folder.unfinished.parent} contains saved states of an interrupted run of another scene or version "
                "of lubfric; they are not used, and this run starts from its beginning"
            )
        yield folder, prepared, estimate


def _remove_pictures_so_far(folder: Path) -> None:
    """Remove the pictures that ``lubfric plot`` drew of the unfinished curve or study, and their ``folder`` where it
    has nothing else."""
    if folder.is_dir() and not folder.is_symlink():
        OwnFiles(folder).remove(f"{name}.{kind}" for name in PICTURES_SO_FAR for kind in PICTURE_FORMATS)


def read_record(folder: Path) -> dict[str, Any]:
    """Return what result.json of a run holds: at least the name of the scene. Raises `InputError` for anything else."""
    path = folder / RESULT
    again = "give a folder that 'lubfric run' wrote, or run it again"
    if not os.path.lexists(path):
        raise InputError(f"{folder} has no {RESULT}; {again}")
    record = read_json(path, again)
    for violation in _violations_of(record):
        violation.setdefault("recommendation", violation.pop("remedy", None))  # as records of version 0.2.0 have it
    hints = get_type_hints(Violation)
    # fields that records of version 0.2.0 have not
    newer = ("assumption", "is_note", "effect", "recommendation_seconds")
    kinds = {field.name: hints[field.name] for field in fields(Violation) if field.name not in newer}
    numbers = {name: kind | None if kind is float else kind for name, kind in kinds.items()}
    kind = {"scene": {"name": str}, "points": [{"validity": [numbers]}]}
    if not isinstance(record, dict) or not fits({"points": []} | record, kind):
        raise InputError(f"{path} is damaged, or no record of a run; {again}")
    return record


def _violations_of(record: Any) -> Iterator[dict[str, Any]]:
    """Yield the records of violations in a ``record`` of a run, whatever else it holds."""
    points = record.get("points") if isinstance(record, dict) else None
    for point in points if isinstance(points, list) else []:
        violations = point.get("validity") if isinstance(point, dict) else None
        for violation in violations if isinstance(violations, list) else []:
            if isinstance(violation, dict):
                yield violation


def files_read(paths: Iterable[Any]) -> list[Path]:
    """Return the files among ``paths`` (None and what is no file: omitted), and those that the TOML files among them
    name."""
    read: dict[Path, None] = {}
    waiting = [Path(path) for path in paths if path is not None]
    while waiting:
        path = waiting.pop()
        if path not in read and os.path.isfile(path):
            read[path] = None
            with suppress(ValueError, OSError, RecursionError):  # no TOML
                if path.stat().st_size < MOST_TOML:
                    waiting += [path.parent / word for word in _words(tomllib.loads(path.read_text("utf-8-sig")))]
    return list(read)


def _words(value: Any) -> list[str]:
    """Return all texts in the tables and lists of ``value``."""
    if isinstance(value, (dict, list)):
        return [word for part in (value.values() if isinstance(value, dict) else value) for word in _words(part)]
    return [value] if isinstance(value, str) else []


def check_outputs(arguments: Namespace, folder: Path, names: Iterable[str], patterns: Iterable[str] = ()) -> None:
    """Raise `InputError`, before any work, if ``folder`` cannot take the files ``names``: one of them is there and not
    ours, or one of these, or of ours that match ``patterns``, is an input of the command with these ``arguments``."""
    if folder.exists() and not folder.is_dir():
        raise InputError(f"--out {folder} is a file; give a folder, existing or not")
    own = OwnFiles(folder)
    inputs = files_read(getattr(arguments, name, None) for name in INPUTS)
    own.check({*names, *own.among(patterns)}, inputs)


def made(name: str, write: Callable[..., Any], *arguments: Any) -> bytes:
    """Return the content of the file that ``write(path, *arguments)`` makes; ``name``: of the file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        write(path, *arguments)
        return path.read_bytes()


def references(result: Any) -> bytes:
    """Return what a ``result`` cites as BibTeX."""
    return f"{result.cite('bibtex')}\n".encode()


def _as_json(record: dict[str, Any]) -> bytes:
    """Return ``record`` as JSON in plain types; null where a number is not finite."""
    return json.dumps(plain(record), indent=1, allow_nan=False).encode()


@dataclass(frozen=True, kw_only=True)
class RepeatedRun:
    """How a run is repeated.

    Attributes
    ----------
    scene : that resolved.toml holds
    options : of the command, which no key of a scene holds
    """

    scene: Scene
    options: tuple[str, ...] = ()

    @property
    def command(self) -> str:
        """The command that repeats the run in its folder."""
        return shlex.join(("lubfric", "run", RESOLVED_SCENE, *self.options))

    def file(self, folder: Path) -> str:
        """Return the text of resolved.toml in ``folder``: the scene, and the options, which 'lubfric run' takes from
        there."""
        head = f"{OPTIONS_KEY} = {json.dumps(self.options)}\n" if self.options else ""
        return head + self.scene.to_toml(folder)


def map_checksums(scene: Scene) -> dict[str, str]:
    """Return the SHA-256 of each height map of ``scene`` by its path."""
    sections = (scene.surface, scene.counterface)
    paths = [part.file for part in sections if part is not None and part.file is not None]
    return {str(path): files.checksum_of_file(path) for path in paths}


class CommandStart(NamedTuple):
    """When a command began [s], by `time.perf_counter`, the processor time that had passed then, and the processor time
    of the earlier calls that it continues."""

    moment: float
    processor: float
    earlier: float = 0.0

    @classmethod
    def now(cls) -> CommandStart:
        """Return that a command begins now."""
        return cls(time.perf_counter(), processor_time())

    @property
    def seconds(self) -> float:
        """The elapsed time [s] since then."""
        return time.perf_counter() - self.moment

    @property
    def processor_seconds(self) -> float:
        """The processor time [s] since then, with that of the worker processes and of the earlier calls."""
        return self.earlier + processor_time() - self.processor

    def in_words(self) -> str:
        """Return the elapsed and the processor time since then, as text: the latter is what a command estimates."""
        of_earlier = f", {self.earlier:.1f} s of it before this call" if self.earlier else ""
        spent = f"{self.processor_seconds:.1f} s of processor time, all processes together"
        return f"{self.seconds:.1f} s of wall-clock time ({spent}{of_earlier})"


class RunFolder:
    """What a command that has ``begun`` puts in the folder ``path``: ``contents`` by name. The
    last says that the others are complete.

    ``unfinished`` has what an interrupted run saved, of the same ``states``. What others saved is left alone.
    ``needed_by``: the runs of the same states that still need it, as text ("": none). ``continues``: whether it
    continues an interrupted run.
    ``map_checksums``: of the height maps that were read, by path.
    """

    def __init__(self, path: Path, begun: CommandStart, fingerprint: str, states: str):
        self.path = path
        self.begun = begun
        self.fingerprint = fingerprint
        self.unfinished = path / UNFINISHED / states[:16]
        self.needed_by = ""
        self.continues = False
        self.contents: dict[str, bytes] = {}
        self.failures: list[str] = []
        self.map_checksums: dict[str, str] = {}

    @property
    def has_other_states(self) -> bool:
        """Whether there is what interrupted runs of other inputs or other versions saved."""
        states = self.unfinished.parent
        return states.is_dir() and any(path != self.unfinished for path in states.iterdir())

    def draw(self, name: str, plot: Callable[..., Any], *arguments: Any) -> None:
        """Add the picture that ``plot(path, *arguments)`` saves. One that cannot be drawn is reported at the end."""
        with self.reporting(f"{name} was not drawn"):
            self.contents[name] = made(name, plot, *arguments)

    def add(self, name: str, content_of: Callable[..., bytes], *arguments: Any) -> None:
        """Add the file ``name``, what ``content_of(*arguments)`` returns. One that cannot be made is reported at the
        end."""
        with self.reporting(f"{name} was not written"):
            self.contents[name] = content_of(*arguments)

    @contextmanager
    def reporting(self, what: str) -> Iterator[None]:
        """Keep an exception of any kind inside for the end, as ``what`` happened: no file must cost the others, which
        hold the answer."""
        try:
            yield
        except Exception as problem:
            self.failures.append(f"{what} ({type(problem).__name__}: {validate.shown(str(problem))})")

    def _record(
        self,
        prepared: Prepared,
        result: Any,
        units: dict[str, Quantity],
        **numbers: object,
    ) -> dict[str, Any]:
        """Return the record of a run: date, resolved input, map, versions, timing, report, violated assumptions,
        ``numbers``; ``units`` of these, beside those of the input."""
        import scipy

        surface = prepared.surface
        versions = {"lubfric": __version__, "numpy": np.__version__}
        names = ("sq", "sa", *(("ssk", "sku") if surface.sq > 0 else ()), "missing_fraction")
        statistics = {name: getattr(surface, name) for name in names}
        statistics["rms_slope"] = dict(zip(("x", "y", "total"), rms_slope(surface)))
        map_ = {"shape": surface.shape, "spacing": surface.spacing, "statistics": statistics, "notes": surface.notes}
        return {
            "date": time.strftime("%Y-%m-%d %H:%M:%S UTC", time.gmtime()),
            "scene": asdict(prepared.scene),
            "units": {name: q.unit for name, q in (KEYS | units).items()},
            "long_names": {name: described(name, KEYS | units)["long_name"] for name in units},
            "surface": map_,
            "versions": versions | {"scipy": scipy.__version__, "python": platform.python_version()},
            "seed": prepared.scene.surface.seed if prepared.scene.surface.file is None else None,
            "seconds": self.begun.seconds,
            "processor_seconds": self.begun.processor_seconds,
            "earlier_processor_seconds": self.begun.earlier,
            "continued": self.continues,
            "hash": self.fingerprint,
            "report": result.report.as_dict(),
            "validity": result.validity,
            **numbers,
        }

    def complete(
        self,
        prepared: Prepared,
        estimate: SceneEstimate,
        given: dict[str, Any],
        result: Any,
        units: dict[str, Quantity],
        law: Law | str = "",
        lines: Iterable[str] = (),
        repeated: RepeatedRun | None = None,
        **numbers: object,
    ) -> None:
        """Add the scene with its defaults, the picture of the roughness and the page, and put all of a run instead of
        an earlier one; its record, which names the files, last as result.json. Then ``lines``, violated
        assumptions and files are said, and what was saved for a resume is removed. ``repeated``: how the run is
        repeated, where not by the scene alone."""
        again = repeated or RepeatedRun(scene=prepared.scene)
        with suppress(InputError):  # a path that is not Unicode has no place in a scene file
            self.add(RESOLVED_SCENE, lambda: again.file(self.path).encode())
        if prepared.surface.sq > 0:
            self.draw("surface.png", plot_surface, prepared)
        record: dict[str, Any] = {"scene": {"name": prepared.scene.name}, "points": [], **numbers}
        with self.reporting(f"{RESULT} has the numbers alone"):
            record = self._record(prepared, result, units, **numbers)
            record["command"] = again.command
            record["map_sha256"] = self.map_checksums
        page = partial(report_page, record=record, contents=self.contents, estimate=estimate, given=given, law=law)
        self.add("report.html", page, prepared, result)
        self.add(BIBTEX_FILE, lambda: references(result))
        record = {"files": sorted([*self.contents, RESULT])} | record
        with self.reporting(f"{RESULT} has the numbers alone"):
            self.contents[RESULT] = _as_json(record)  # last: it appears when all files that it names are there
        if RESULT not in self.contents:
            self.contents[RESULT] = json.dumps(record, indent=1, default=str).encode()
        self.put(OUTPUTS, (*lines, *record.get("validity", ())))
        if not self.failures:  # else what was saved is all that has everything
            if self.needed_by:
                say(f"{self.unfinished.parent} keeps {self.needed_by}")
            else:
                Store(self.unfinished).clear()
                clear_checked(self.unfinished.parent)
        if self.has_other_states:
            say(
                f"{self.unfinished.parent} keeps the points of an interrupted run of other inputs; the command of "
                "that run continues it"
            )

    def put(self, patterns: Iterable[str] = (), lines: Iterable[str] = ()) -> None:
        """Put ``contents`` in the folder, remove what else of ours matches ``patterns``, and say so."""
        OwnFiles(self.path).replace(self.contents, patterns)
        for text in lines:
            say(text)
        names = ", ".join(sorted(self.contents))
        say(f"wrote {names} to {self.path} in {self.begun.in_words()}")


@contextmanager
def run_folder(path: Path, begun: CommandStart, fingerprint: str = "", states: str = "") -> Iterator[RunFolder]:
    """Lock ``path`` for a command that has ``begun``, and the run with that ``fingerprint`` and ``states``: a
    `RunFolder`.

    Raises `InputError` if another process writes to it, and `OutputError` if it cannot be used, or if a picture was not
    drawn.
    """
    with FolderLock(path):
        clear_parts(path)
        folder = RunFolder(path, begun, fingerprint, states)
        yield folder
        if not (path / UNFINISHED).is_dir():
            _remove_pictures_so_far(path / SO_FAR)
    if folder.failures:
        raise OutputError(f"{'; '.join(folder.failures)}; all else is in {path}")
