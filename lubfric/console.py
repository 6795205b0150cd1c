"""What a command says, and how it ends. A broken stream or an interrupt never costs what was computed."""

from __future__ import annotations

import os
import signal
import sys
import threading
from contextlib import contextmanager

INTERRUPTED, TERMINATED = 130, 143  # exit codes, as shells count them


class Interrupted(KeyboardInterrupt):
    """Ctrl-C or SIGTERM, with one line that says what is kept."""

    code = INTERRUPTED


class Terminated(Interrupted):
    """SIGTERM."""

    code = TERMINATED


def say(text: str) -> None:
    """One line on stderr; when nobody reads it any more, silence from then on."""
    put(sys.stderr, text + "\n")


def put(stream, text: str) -> None:
    """Write to ``stream``; a stream that is closed or broken is turned to nowhere."""
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
