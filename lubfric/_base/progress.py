"""How far a long computation is: it reports its steps, and whoever waits may show them."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

Report = Callable[[str, int, int], None]

_report: ContextVar[Report | None] = ContextVar("what is called with the progress of a computation", default=None)


@contextmanager
def progress_to(report: Report) -> Iterator[None]:
    """Call ``report(what, done, total)`` after every step that computations inside the block report. The processes of
    an executor report nothing."""
    token = _report.set(report)
    try:
        yield
    finally:
        _report.reset(token)


def report_progress(what: str, done: int, total: int) -> None:
    """Say that ``done`` of ``total`` steps of the part ``what`` are done."""
    report = _report.get()
    if report is not None:
        report(what, done, total)
