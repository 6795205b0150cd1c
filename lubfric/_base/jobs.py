"""Independent parts of one computation, done here or by processes, with the same results to the bit."""

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future
from contextlib import contextmanager
from contextvars import ContextVar
from functools import partial
from typing import Any, TypeVar

from .processor_time import ProcessorTime, receive_time, reported_time
from .work import count_work, limited_work, unlimited_work, work_left

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

    Work is counted as of parts that are done one after the other (`lubfric._base.work`), so that a limit ends the same
    part. Function, arguments and results must pickle where an executor does it. An exception is that of the first part,
    in their order, that raises one. What a lost process had is done here.
    """
    executor = current_executor()
    jobs = [partial(function, *arguments, part) for part in parts]
    if executor is None or len(jobs) < 2:
        return [job() for job in jobs]
    futures: list[Future[tuple[T | Exception, float, ProcessorTime]] | None] = []
    left = work_left()
    for job in jobs:
        try:
            futures.append(executor.submit(_counted, job, left))
        except BrokenExecutor:
            futures.append(None)
    results = []
    try:
        for job, future in zip(jobs, futures):
            try:
                outcome = _counted(job, left) if future is None else future.result()
            except BrokenExecutor:
                outcome = _counted(job, left)
            (result, work, spent) = outcome
            receive_time(spent)
            count_work(work)
            if isinstance(result, Exception):
                raise result
            results.append(result)
    finally:
        for future in futures:
            if future is not None:
                future.cancel()
    return results


def _counted(job: Callable[[], T], limit: float) -> tuple[T | Exception, float, ProcessorTime]:
    """Return the result of a part, or what it raised; its counted work [s], which ends at ``limit``; its processor
    time."""
    result: T | Exception
    with unlimited_work(), limited_work(limit) as meter, reported_time() as spent:
        try:
            result = job()
        except Exception as error:  # raised by the caller, in the order of the parts
            result = error
    return result, meter.spent, spent
