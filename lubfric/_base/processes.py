"""Work on any executor, and the processes of a command. What a lost worker had is done again."""

import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor
from contextlib import contextmanager
from queue import SimpleQueue

from ..errors import InputError
from . import validate

WATCH = 0.2  # s between two looks at whether the command still lives
MOST_WORKERS = 1024
LAST = 2.0  # s that an interrupted process is waited for
ENDING = (signal.SIGINT, signal.SIGTERM)
MASKS = hasattr(signal, "pthread_sigmask")


def checked_executor(executor):
    """``executor``, None or a `concurrent.futures.Executor`; raises `InputError` for anything else."""
    if executor is not None and not hasattr(executor, "submit"):
        raise InputError(f"executor = {validate.shown(executor)}; allowed: None or a concurrent.futures.Executor")
    return executor


def spread(executor, jobs: Sequence[Callable[[], Iterator]]) -> Iterator:
    """Yield what the ``jobs`` yield. Done here, the values come at once; from an executor, those of a job come when it
    has ended.

    ``executor``: None (here, one after the other) or a `concurrent.futures.Executor`. A job must pickle (a
    `functools.partial` of what can be imported), and must catch what it may rightly raise. Any other exception is an
    error of the program: jobs not yet begun are cancelled, and it is raised. A *worker* may be lost: killed, or its
    machine gone. Then its jobs, and those of a pool that broke with it, are done here.
    """
    if executor is None:
        for job in jobs:
            yield from job()
        return
    ended: SimpleQueue = SimpleQueue()  # `concurrent.futures.wait` would leave locks behind when it is interrupted
    waiting = {}
    lost = []
    for job in jobs:
        try:
            waiting[executor.submit(_attempt, job)] = job
        except BrokenExecutor:  # by a worker that was lost before
            lost.append(job)
    for future in waiting:
        future.add_done_callback(ended.put)
    try:
        while waiting:
            future = ended.get()
            job = waiting.pop(future)
            try:
                done, value = future.result()
            except Exception:  # `_attempt` raises nothing: this is the executor's own
                lost.append(job)
                continue
            if not done:
                raise value
            yield from value
    finally:
        for future in waiting:
            future.cancel()
    for job in lost:
        yield from job()


def _attempt(job):
    """(True, the values) or (False, the exception): tells errors of a job from those of the executor."""
    try:
        return True, list(job())
    except Exception as error:
        return False, error


def processors() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def checked_workers(workers: int, executor) -> int:
    """Return the number of processes; raises `InputError` for a wrong one, and for one beside an ``executor``."""
    workers = validate.integer("workers", workers, minimum=1, maximum=MOST_WORKERS)
    if workers > 1 and executor is not None:
        raise InputError(" and an executor are given", "workers", "one of both")
    return workers


@contextmanager
def pool(workers: int):
    """An executor of ``workers`` processes, which start at once. They end with this process, however it ends. None for
    one worker: then this process does the work itself."""
    if workers == 1:
        yield None
        return
    executor = ProcessPoolExecutor(workers, initializer=_follow, initargs=(os.getpid(),))
    try:
        with _held():
            for _ in range(workers):
                executor.submit(os.getpid)
        yield executor
    except BaseException:  # its own thread is waited for, but not for ever: an interrupt may have left a lock it needs
        ending = threading.Thread(target=executor.shutdown, kwargs={"cancel_futures": True}, daemon=True)
        ending.start()
        for process in multiprocessing.active_children():
            process.terminate()
        ending.join(LAST)
        for process in multiprocessing.active_children():
            process.join(LAST)
        raise
    executor.shutdown()


@contextmanager
def _held():
    """Signals wait while processes start: one that came before `_follow` would end in a traceback, or be lost."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ENDING) if MASKS else ()
    try:
        yield
    finally:
        if MASKS:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _follow(parent: int) -> None:
    """Runs in a worker: leave Ctrl-C to the command, and end when the command is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if MASKS:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, ENDING)

    def watch():
        while os.getppid() == parent:
            time.sleep(WATCH)
        os._exit(1)

    if os.getppid() == parent:  # not where workers are started by a server of their own
        threading.Thread(target=watch, daemon=True).start()
