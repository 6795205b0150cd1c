"""Work on any executor, and the processes of a command. What a lost worker had is done again."""

from __future__ import annotations

import multiprocessing
import os
import signal
import socket
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor
from contextlib import contextmanager, suppress
from itertools import islice
from queue import Empty, SimpleQueue
from typing import Any
from urllib.parse import urlsplit

from ..errors import InputError
from . import validate
from .processor_time import ProcessorTime, receive_time, reported_time

# Time between two looks at whether the command still lives [s]. A choice: a smaller value costs time, a larger one
# leaves processes for longer.
WATCH = 0.2

# Most processes of a command. A choice: more than a machine has cores.
MOST_WORKERS = 1024

# Time that an interrupted process is waited for [s]. A choice: a smaller value ends it in the middle of a write.
LAST_WAIT = 2.0

# Time that a scheduler has to answer [s]. A choice: a smaller value gives up slow networks.
CONNECT = 10.0

# Time after which the client of a scheduler that answers is given up [s]. A choice: a smaller value gives up slow
# clusters.
LONGEST_START = 60.0

# Protocols of a scheduler over a connection of TCP; and those in which the client speaks first.
SCHEMES = ("tcp", "tls", "ws", "wss")
CLIENT_FIRST = ("tls:", "ws:", "wss:")

# Jobs that an executor holds at a time: more than any cluster has workers, and few enough to hold in memory. A choice:
# a smaller value leaves workers idle, a larger one takes memory.
IN_FLIGHT = 4096

# Times that an executor may lose a job before it is done here. A choice: more repeats jobs that end their process.
ATTEMPTS = 3

ENDING = (signal.SIGINT, signal.SIGTERM)
MASKS = hasattr(signal, "pthread_sigmask")


def checked_executor(executor: Any) -> Any:
    """Return ``executor``: None, a `concurrent.futures.Executor`, or that of a ``dask.distributed.Client``. Raises
    `InputError` for anything else."""
    if hasattr(executor, "get_executor"):
        return executor.get_executor()
    if executor is not None and not hasattr(executor, "submit"):
        allowed = "None, a concurrent.futures.Executor or a dask.distributed.Client"
        raise InputError(f"executor = {validate.shown(executor)}; allowed: {allowed}")
    return executor


@contextmanager
def cluster(address: str) -> Iterator[Any]:
    """Yield an executor of the Dask cluster whose scheduler listens at ``address``, such as "tcp://host:8786". Raises
    `InputError` where none does."""
    distributed = validate.installed("distributed", "cluster")
    (host, port) = _checked_address(address)
    try:
        with socket.create_connection((host, port), timeout=CONNECT) as connection:
            if not address.startswith(CLIENT_FIRST) and not connection.recv(1):  # a scheduler speaks first
                raise OSError("the connection was closed without an answer")
    except TimeoutError:
        raise _no_scheduler(address, f"no answer came in {CONNECT:g} s") from None
    except OSError as error:
        raise _no_scheduler(address, str(error)) from None
    client = _client(distributed, address)
    try:
        yield client.get_executor()
    finally:
        client.close(timeout=CONNECT)


def _checked_address(address: str) -> tuple[str, int]:
    """Return host and port of an ``address`` such as "tcp://host:8786", or "host:8786". Raises `InputError`."""
    try:
        parts = urlsplit(address if "://" in address else f"tcp://{address}")
        host = parts.hostname
        port = parts.port
    except ValueError:  # a port that is no number, or a bracket without its end
        raise _no_scheduler(address, "host or port cannot be read") from None
    if parts.scheme not in SCHEMES or not host or not port:
        raise _no_scheduler(address, f"it is not one of {', '.join(f'{scheme}://host:port' for scheme in SCHEMES)}")
    return host, port


def _client(distributed: Any, address: str) -> Any:
    """Return a Dask client. Its thread was once not started, and waited for without end: so it is made in another one,
    and waited for `LONGEST_START`."""
    ended: SimpleQueue[Any] = SimpleQueue()

    def make() -> None:
        try:  # leaves the configuration of Dask
            ended.put(distributed.Client(address, timeout=CONNECT, set_as_default=False))
        except Exception as error:  # of many kinds; an AssertionError where the machine is very busy
            ended.put(error)

    if begin_beside(make) is None:
        raise _no_scheduler(address, "this machine has no thread left for a client")
    try:
        made = ended.get(timeout=LONGEST_START)
    except Empty:
        raise _no_scheduler(address, f"its client did not start in {LONGEST_START:g} s") from None
    if isinstance(made, Exception):
        raise _no_scheduler(address, str(made))
    return made


def _no_scheduler(address: str, why: str) -> InputError:
    message = f" = {validate.shown(address)}: no Dask scheduler answers ({validate.shown(why)})"
    recommendation = "start one with 'dask scheduler', and give its address, tcp://host:8786"
    return InputError(message, "--cluster", recommendation=recommendation)


def spread(executor: Any, jobs: Iterable[Callable[[], Iterator[Any]]]) -> Iterator[Any]:
    """Yield what the ``jobs`` yield. Done here, the values come at once; from an executor, those of a job come when it
    has ended.

    ``executor``: None (here, one after the other) or a `concurrent.futures.Executor`, which holds `IN_FLIGHT` jobs at
    most at a time. A job must pickle (a `functools.partial` of what can be imported), and must catch what it may
    rightly raise. Any other exception is an error of the program: jobs not yet begun are cancelled, and it is raised. A
    *worker* or a scheduler may be lost: killed, or its machine gone. Then its jobs go to the executor again, and are
    done here if it takes them no more or loses them `ATTEMPTS` times.
    """
    if executor is None:
        for job in jobs:
            yield from job()
        return
    left = iter(jobs)
    ended: SimpleQueue[Any] = SimpleQueue()  # `concurrent.futures.wait` would leave locks behind when it is interrupted
    waiting: dict[Any, tuple[Callable[..., Any], int]] = {}
    here: list[Callable[[], Iterator[Any]]] = []

    def submit(job: Callable[[], Iterator[Any]], attempt: int) -> None:
        try:
            future = executor.submit(_attempt, job)
        except (BrokenExecutor, RuntimeError, OSError):  # by a worker that was lost before, or an executor that is shut
            here.append(job)
            return
        waiting[future] = (job, attempt)
        future.add_done_callback(ended.put)

    try:
        for job in islice(left, IN_FLIGHT):
            submit(job, 1)
        while waiting or here:
            if not waiting:
                yield from here.pop()()
            else:
                future = ended.get()
                job, attempt = waiting.pop(future)
                try:
                    done, value, spent = future.result()
                except Exception:  # `_attempt` raises nothing: this is the executor's own
                    if attempt < ATTEMPTS:
                        submit(job, attempt + 1)
                    else:
                        here.append(job)
                    continue
                receive_time(spent)
                if not done:
                    raise value
                yield from value
            for job in islice(left, 1):
                submit(job, 1)
    finally:
        for future in waiting:
            future.cancel()


def _attempt(job: Callable[[], Iterable[Any]]) -> tuple[bool, Any, ProcessorTime]:
    """Return (True, the values) or (False, the exception), and the processor time: distinguishes errors of a job from
    those of the executor."""
    with reported_time() as spent:
        try:
            done = True
            outcome: Any = list(job())
        except Exception as error:
            done = False
            outcome = error
    return done, outcome, spent


def begin_beside(work: Callable[[], None]) -> threading.Thread | None:
    """Begin ``work`` that can be done without, in a thread. Return the thread, or None where the system has none left.

    What goes wrong in it, such as memory that is not enough, ends it without a word.
    """

    def quietly() -> None:
        with suppress(Exception):
            work()

    thread = threading.Thread(target=quietly, daemon=True)
    try:
        thread.start()
    except RuntimeError:
        return None
    return thread


def processors() -> int:
    """Return how many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def checked_workers(workers: int, executor: Any) -> int:
    """Return the number of processes; raises `InputError` for a wrong one, and for one together with an
    ``executor``."""
    workers = validate.integer("workers", workers, minimum=1, maximum=MOST_WORKERS)
    if workers > 1 and executor is not None:
        raise InputError(" and an executor are given", "workers", "one of the two")
    return workers


@contextmanager
def pool(workers: int) -> Iterator[ProcessPoolExecutor | None]:
    """Yield an executor of ``workers`` processes, which start at once. They end with this process, however it ends.
    None for one worker: then this process does the work itself."""
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
        ending.join(LAST_WAIT)
        for process in multiprocessing.active_children():
            process.join(LAST_WAIT)
        raise
    executor.shutdown()


@contextmanager
def _held() -> Iterator[None]:
    """Let signals wait while processes start: one that came before `_follow` would end in a traceback, or be lost."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ENDING) if MASKS else ()
    try:
        yield
    finally:
        if MASKS:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _follow(parent: int) -> None:
    """Run in a worker: leave Ctrl-C to the command, and end when the command is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if MASKS:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, ENDING)

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(WATCH)
        os._exit(1)

    if os.getppid() == parent:  # not where workers are started by a server of their own
        begin_beside(watch)
