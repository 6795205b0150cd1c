"""Pieces of work on any executor. Pieces of a lost worker are done again; errors of the program are raised."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, Future
from queue import Empty, SimpleQueue

from .._base import shown
from ..errors import InputError

LOOK = 0.1  # s between two looks at what is under way, at least
SHARE = 0.1  # of the time spent on looking, at most


def spread(
    executor, work: Callable, pieces: list, again: Callable | None = None, look: Callable | None = None
) -> Iterator:
    """Yield what ``work(piece)`` yields, for every piece. Done here, the values come at once; from an executor, those
    of a piece come when it has ended.

    ``executor``: None (here, one after the other) or a `concurrent.futures.Executor`. ``work`` must be importable, and
    must catch what a piece may rightly raise. Any other exception is an error of the program: pieces not yet begun are
    cancelled, and it is raised.

    A *worker* may be lost: killed, or its machine gone. Then its pieces, and those of a pool that broke with it, are
    done here. ``again(piece)`` gives what is left of a piece (None: all of it). ``look()`` is called from time to time
    while pieces are being done on an executor.
    """
    if executor is None:
        for piece in pieces:
            yield from work(piece)
        return
    waiting, lost, broken = {}, [], False
    for piece in pieces:
        try:
            waiting[executor.submit(_attempt, work, piece)] = piece
        except BrokenExecutor:  # by a worker that was lost before
            lost.append(piece)
    try:
        for future in _ended(list(waiting), look):
            piece = waiting.pop(future)
            try:
                done, value = future.result()
            except Exception as error:  # `_attempt` raises nothing: this is the executor's own
                broken = broken or isinstance(error, BrokenExecutor)
                lost.append(piece)
                continue
            if not done:
                raise value
            yield from value
    finally:
        for future in waiting:
            future.cancel()
    if broken:
        executor.shutdown(wait=True)  # its other workers are gone before their pieces are looked at
    for piece in lost:
        yield from work(piece if again is None else again(piece))


def checked_executor(executor):
    """``executor``, None or a `concurrent.futures.Executor`; raises `InputError` for anything else."""
    if executor is not None and not hasattr(executor, "submit"):
        raise InputError(f"executor = {shown(executor)}; allowed: None or a concurrent.futures.Executor")
    return executor


def _ended(futures: Iterable[Future], look: Callable | None) -> Iterator[Future]:
    """The futures as they end; ``look()`` in between. (`concurrent.futures.wait` holds the locks of all of them at a
    time: an interrupt there leaves them locked, and the executor cannot end.)"""
    ended: SimpleQueue[Future] = SimpleQueue()
    left = 0
    for future in futures:
        future.add_done_callback(ended.put)
        left += 1
    pause = LOOK
    while left:
        try:
            yield ended.get(timeout=None if look is None else pause)
            left -= 1
        except Empty:
            pass
        if look is not None and left and ended.empty():
            begun = time.perf_counter()
            look()
            pause = max(LOOK, (time.perf_counter() - begun) / SHARE)


def _attempt(work, piece):
    """(True, the values) or (False, the exception): tells errors of the work from those of the executor."""
    try:
        return True, list(work(piece))
    except Exception as error:
        return False, error
