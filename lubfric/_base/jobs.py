"""Independent parts of one computation, done here or by processes, with the same results to the bit."""

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future
from contextlib import contextmanager
from contextvars import ContextVar
from functools import partial
from typing import Any, TypeVar

T = TypeVar("T")

_executor: ContextVar[tuple[int, Executor | None]] = ContextVar("process and executor of the parts", default=(0, None))


@contextmanager
def parts_on(executor: Executor | None) -> Iterator[None]:
    """Let `map_parts` use ``executor`` inside the block (None: this process does all).

    A process of the executor does its own parts one after the other: parts of parts are not spread again.
    """
    token = _executor.set((os.getpid(), executor))
    try:
        yield
    finally:
        _executor.reset(token)


def current_executor() -> Executor | None:
    """Return the executor of the block (`parts_on`), if any. A forked process has none."""
    process, executor = _executor.get()
    return executor if process == os.getpid() else None


def map_parts(function: Callable[..., T], parts: Iterable[Any], *arguments: Any) -> list[T]:
    """Return ``function(*arguments, part)`` of all ``parts``, in their order.

    Function, arguments and results must pickle where an executor does it. An exception is that of the first part, in
    their order, that raises one. What a lost process had is done here.
    """
    executor = current_executor()
    jobs = [partial(function, *arguments, part) for part in parts]
    if executor is None or len(jobs) < 2:
        return [job() for job in jobs]
    futures: list[Future[T] | None] = []
    for job in jobs:
        try:
            futures.append(executor.submit(job))
        except BrokenExecutor:
            futures.append(None)
    results = []
    try:
        for job, future in zip(jobs, futures):
            try:
                results.append(job() if future is None else future.result())
            except BrokenExecutor:
                results.append(job())
    finally:
        for future in futures:
            if future is not None:
                future.cancel()
    return results
