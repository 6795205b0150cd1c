"""The processor time of a command with the processes that work for it. Each one reports its own with what it returns,
so that it is known while they live, wherever they run and however they were started."""

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass


@dataclass
class ProcessorTime:
    """What a process spent on a job, as it reports it.

    Attributes
    ----------
    process : its number
    seconds : its processor time [s]
    """

    process: int
    seconds: float = 0.0


# Processor time [s] that each process has reported, by its number: a forked one begins anew.
_reported: dict[int, float] = {}
# Processor time [s] that other processes reported to each process, by the number of the latter.
_received: dict[int, float] = {}


@contextmanager
def reported_time() -> Iterator[ProcessorTime]:
    """Yield what has the processor time of this process since its last report, or since the block began, when it has
    ended: jobs on several threads of one process report each second once."""
    process = os.getpid()
    _reported.setdefault(process, time.process_time())
    report = ProcessorTime(process)
    try:
        yield report
    finally:
        now = time.process_time()
        report.seconds = now - _reported[process]
        _reported[process] = now


def receive_time(report: ProcessorTime) -> None:
    """Count the ``report`` of another process; this one has its own clock."""
    process = os.getpid()
    if report.process != process:
        _received[process] = _received.get(process, 0.0) + report.seconds


def processor_time() -> float:
    """Return the processor time [s] of this process and that which others reported to it."""
    return time.process_time() + _received.get(os.getpid(), 0.0)
