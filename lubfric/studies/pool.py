"""The worker processes of a command. They end with it, however it ends."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import time
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager

WATCH = 0.2  # s between two looks at whether the command still lives
MOST_WORKERS = 1024
LAST = 2.0  # s that an interrupted process is waited for


def processors() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def pool(workers: int):
    """An executor of ``workers`` processes, which start at once. None for one worker: then this process does the work
    itself."""
    if workers == 1:
        yield None
        return
    executor = ProcessPoolExecutor(workers, initializer=_follow, initargs=(os.getpid(),))
    try:
        for _ in range(workers):
            executor.submit(os.getpid)
        yield executor
    except BaseException:
        _end(executor)
        raise
    executor.shutdown()


def _end(executor: ProcessPoolExecutor) -> None:
    """End an interrupted ``executor`` with its processes. Its own thread is waited for, but not for ever: an interrupt
    may have left a lock that it needs."""
    ending = threading.Thread(target=executor.shutdown, kwargs={"cancel_futures": True}, daemon=True)
    ending.start()
    for process in multiprocessing.active_children():
        process.terminate()
    ending.join(LAST)
    for process in multiprocessing.active_children():
        process.join(LAST)


def _follow(parent: int) -> None:
    """Runs in a worker: leave Ctrl-C to the command, and end when the command is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)

    def watch():
        while os.getppid() == parent:
            time.sleep(WATCH)
        os._exit(1)

    if os.getppid() == parent:  # not where workers are started by a server of their own
        threading.Thread(target=watch, daemon=True).start()
