"""The progress of a long command: a line on stderr that is overwritten every second, with the time left. It appears on
a terminal alone; files and pipes get the finished lines of the command, and one on the time left where none came for
long."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from shutil import get_terminal_size
from typing import Any

from .._base.processes import begin_beside
from ..studies import in_words
from .time_left import TimeLeft

REFRESH = 1.0  # s between two drawings of the line; a choice: less flickers
SILENCE = 30.0  # s without a line from which on a file or a pipe gets one with the time left; a choice: less fills logs
CLEAR_LINE = "\r\033[K"  # to the begin of the line, and nothing on it

# A bar of tqdm without its own time left, which is that of whole points.
BAR_WITH_TIME_LEFT = "{l_bar}{bar}| {n_fmt}/{total_fmt} [{elapsed}{postfix}]"

_active: ProgressLine | None = None


class ProgressLine:
    """Use as ``with ProgressLine("points") as progress: progress.update(done, total)``.

    A ``unit`` that begins with "%" is of a total of 100. ``time_left``: of work whose parts are estimated; else the
    time left is that of what is done so far. The line is a bar of tqdm where that is installed (``pip install
    'lubfric[progress]'``), else plain text. ``remark``: returns what else is to be said, or ""; a terminal gets it on a
    line of its own, once until it is "" again.
    """

    def __init__(self, unit: str, time_left: TimeLeft | None = None, remark: Callable[[], str] = str):
        self.unit = unit
        self.time_left = time_left
        self.remark = remark
        self._is_remarked = False
        self._said = time.monotonic()
        self.done = 0.0
        self.total = 0.0
        self.part = ""  # how far the point is that is being solved, as text
        self._first: float | None = None
        self._begun = time.monotonic()
        self._bar: Any = None
        self.draws = False  # on a terminal
        self._ended = threading.Event()
        self._lock = threading.RLock()
        self._thread: threading.Thread | None = None

    def __enter__(self) -> ProgressLine:
        global _active
        if sys.stderr is not None and sys.stderr.isatty():
            with suppress(ImportError):
                form = {} if self.time_left is None else {"bar_format": BAR_WITH_TIME_LEFT}
                self._bar = import_module("tqdm").tqdm(
                    unit=f" {self.unit}", file=sys.stderr, leave=False, total=0, **form
                )
            self.draws = True
            self._thread = begin_beside(self._draw_often)
        elif self.time_left is not None:
            self._thread = begin_beside(self._say_where_silent)
        _active = self if self._thread is not None else None
        return self

    def __exit__(self, *_: object) -> None:
        global _active
        if self._thread is not None:
            self._ended.set()
            self._thread.join()
            self.clear()
            _active = None
            if self._bar is not None:
                self._bar.close()

    def update(self, done: float, total: float) -> None:
        """Report that ``done`` of ``total`` are ended. What is done at the first report took no time: it was stored."""
        with self._lock:
            self._first = max(done - 1.0, 0.0) if self._first is None and total > 1 else self._first or 0.0
            self.done = done
            self.total = total
            self.part = ""

    @property
    def text(self) -> str:
        """The line: what is done, the time passed, the time left and the part of the point, where they are known."""
        passed = time.monotonic() - self._begun
        is_part = self.unit.startswith("%")
        done = f"{self.done:.1f}" if is_part else f"{self.done:.4g} of {self.total:.4g}"
        head = f"{done} {self.unit}, " if self.total else ""
        text = f"{head}{in_words(passed)} passed"
        solved = self.done - (self._first or 0.0)
        if self.time_left is not None:
            text += self.time_left.in_words()
        elif self.total and solved > 0:
            text += f", about {in_words(passed * (self.total - self.done) / solved)} left"
        return "; ".join(filter(None, (text, self.part, self.remark())))

    def draw(self) -> None:
        """Draw the line as it is now."""
        with self._lock, suppress(OSError, ValueError):
            if self._bar is None:
                width = get_terminal_size().columns - 1  # a longer line would be more than one, which nothing clears
                sys.stderr.write(f"{CLEAR_LINE}{self.text[:width]}")
                sys.stderr.flush()
                return
            self._bar.total = self.total or None
            self._bar.n = self.done
            left = "" if self.time_left is None else self.time_left.in_words()
            words = (left.removeprefix(", "), self.part)
            self._bar.set_postfix_str("; ".join(filter(None, words)), refresh=False)
            self._bar.refresh()

    def clear(self) -> None:
        """Remove the line, so that another can be written in its place, which the next one on a file or a pipe waits
        for."""
        self._said = time.monotonic()
        if not self.draws:
            return
        with self._lock, suppress(OSError, ValueError):
            if self._bar is not None:
                self._bar.clear()
            sys.stderr.write(CLEAR_LINE)
            sys.stderr.flush()

    def _say_where_silent(self) -> None:
        while not self._ended.wait(REFRESH):
            now = time.monotonic()
            with self._lock, suppress(OSError, ValueError, AttributeError):
                if now - self._said >= SILENCE:
                    self._said = now
                    sys.stderr.write(f"{self.text}\n")
                    sys.stderr.flush()

    def _draw_often(self) -> None:
        while not self._ended.wait(REFRESH):
            self._say_remark()
            self.draw()

    def _say_remark(self) -> None:
        """Write the remark, unless it is there already."""
        remark = self.remark()
        if remark and not self._is_remarked:
            self.clear()
            with self._lock, suppress(OSError, ValueError, AttributeError):
                sys.stderr.write(f"{remark}\n")
        self._is_remarked = bool(remark)


def state_part(text: str) -> bool:
    """Put ``text``, how far a point is, on the line of the command that is running; return whether there is one."""
    if _active is not None:
        _active.part = text
    return _active is not None


def clear_active() -> None:
    """Remove the line of the command that is running, if there is one; the next second draws it again."""
    if _active is not None:
        _active.clear()
