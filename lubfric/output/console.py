"""The messages of a command, and its end. A broken stream or an interrupt never costs what was computed."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from contextlib import contextmanager

INTERRUPTED, TERMINATED = 130, 143  # exit codes, as shells count them
SAY_EVERY = 1.0  # s between two lines of progress


class Interrupted(KeyboardInterrupt):
    """Ctrl-C or SIGTERM, with one line that says what is kept."""

    code = INTERRUPTED


class Terminated(Interrupted):
    """SIGTERM."""

    code = TERMINATED


def say(text: str) -> None:
    """One line on stderr; silence once nobody reads it."""
    put(sys.stderr, text + "\n")


def put(stream, text: str) -> None:
    """Write to ``stream``; a stream that is closed or broken is replaced by one that goes nowhere."""
    try:
        stream.write(text)
        stream.flush()
    except (OSError, ValueError, AttributeError):  # a closed pipe, a closed file, no stream at all
        _silence(stream)


def _silence(stream) -> None:
    try:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)
    except (OSError, ValueError, AttributeError):
        pass


class Pace:
    """Says when progress is to be reported: a second after the last time, and at the end."""

    def __init__(self) -> None:
        self._told = time.perf_counter()

    def due(self, end: bool) -> bool:
        """Whether to report it now."""
        now = time.perf_counter()
        if not end and now - self._told < SAY_EVERY:
            return False
        self._told = now
        return True


def say_written(names, folder, begun: float) -> None:
    """Say which files are in ``folder`` now, and how long it took since ``begun`` (`time.perf_counter`)."""
    say(f"wrote {', '.join(sorted(names))} to {folder} in {time.perf_counter() - begun:.1f} s")


@contextmanager
def interruptible():
    """SIGTERM ends what is inside as Ctrl-C does, so that locks are dropped and files closed."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def terminate(*_):
        raise Terminated("terminated")

    before = signal.signal(signal.SIGTERM, terminate)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


@contextmanager
def keeping(what):
    """On an interrupt, say what is kept: the words come from ``what()``."""
    try:
        yield
    except Interrupted as error:
        raise type(error)(what()) from None
    except KeyboardInterrupt:
        raise Interrupted(what()) from None
