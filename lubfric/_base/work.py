"""A limit of counted work: seconds of a usual core, from numbers of cells and steps alone, never from a clock.

A solver calls `count_work` at each step of its iteration. Where a caller has set a limit with `limited_work`, the step
that passes it raises `WorkLimitError`. So the same point ends at the same step on every machine.
"""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import TypeVar

from ..errors import ConvergenceError, WorkLimitError

T = TypeVar("T")


@dataclass
class WorkMeter:
    """The work [s] that was counted, and the most that is allowed."""

    limit: float
    spent: float = 0.0


_METER: ContextVar[WorkMeter | None] = ContextVar("work meter", default=None)

# The most work [s] that a strip may be forecast to take.
_MOST_FORECAST: ContextVar[float] = ContextVar("most forecast work", default=math.inf)


@contextmanager
def limited_work(limit: float) -> Iterator[WorkMeter]:
    """Limit the work [s] that is counted inside, in this thread. The limit replaces an outer one, whose meter adds this
    work afterwards and cannot stop it."""
    outer = _METER.get()
    meter = WorkMeter(limit=limit)
    token = _METER.set(meter)
    try:
        yield meter
    finally:
        _METER.reset(token)
        if outer is not None:
            outer.spent += meter.spent


@contextmanager
def limited_forecast(limit: float) -> Iterator[None]:
    """Limit the work [s] that the first strip of a point inside may be forecast to take: it ends with `TooCostlyError`
    as soon as its first steps forecast more."""
    token = _MOST_FORECAST.set(limit)
    try:
        yield
    finally:
        _MOST_FORECAST.reset(token)


def forecast_limit() -> float:
    """Return the work [s] that a strip may be forecast to take (`limited_forecast`); infinite without a limit."""
    return _MOST_FORECAST.get()


@contextmanager
def unlimited_work() -> Iterator[None]:
    """Set the limit aside: for what has to be done with the results that are there."""
    token = _METER.set(None)
    try:
        yield
    finally:
        _METER.reset(token)


@contextmanager
def may_stay_unsolved() -> Iterator[None]:
    """Leave a solve inside without a result where it does not converge. A limit of work that it passes ends the caller
    too."""
    try:
        yield
    except WorkLimitError:
        raise
    except ConvergenceError:
        pass


def work_left() -> float:
    """Return the work [s] that the limit of the caller leaves; infinite without one."""
    meter = _METER.get()
    return math.inf if meter is None else max(meter.limit - meter.spent, 0.0)


def count_work(seconds: float) -> None:
    """Add counted work [s]. Raise `WorkLimitError` where that passes the limit of the caller."""
    meter = _METER.get()
    if meter is None:
        return
    meter.spent += seconds
    if meter.spent > meter.limit:
        raise WorkLimitError(meter.limit)


def work_apart_from_limit(make: Callable[[], T]) -> tuple[T, float]:
    """Return what ``make`` gives, and the work [s] that it counts; the limit of the caller neither counts nor ends
    it."""
    with unlimited_work(), limited_work(math.inf) as meter:
        return make(), meter.spent


def with_its_work(make: Callable[[], T]) -> tuple[T, float]:
    """Return what ``make`` gives, and the work [s] that it counted, within the limit of the caller."""
    meter = _METER.get()
    if meter is None:
        with limited_work(math.inf) as meter:
            return make(), meter.spent
    before = meter.spent
    return make(), meter.spent - before
