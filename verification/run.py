"""Run studies one after another, or over several processes. A study that raises is a failed check, and stops no
other."""

import importlib
import inspect
import multiprocessing
import os
import threading
import time
import traceback
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from multiprocessing.connection import wait
from typing import Any

from .catalogue import Study
from .check import AT_MOST, Check, Field, Figure, Item, Table

EXTRAS = {"skfem": "scikit-fem", "meshio": "meshio", "pyamg": "pyamg"}
Progress = Callable[[Check], None]
INSTALL = 'pip install "lubfric[verification]"'


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """The outcome of one study.

    study, level : what was run
    description : docstring of the study
    checks, tables, figures, fields : all that was handed over, also before a failure
    seconds : wall time of the study with its imports
    error : one line for a study that raised, else ""
    trace : the complete traceback, else ""
    """

    study: Study
    level: str
    description: str = ""
    checks: tuple[Check, ...] = ()
    tables: tuple[Table, ...] = ()
    figures: tuple[Figure, ...] = ()
    fields: tuple[Field, ...] = ()
    seconds: float = 0.0
    error: str = ""
    trace: str = ""

    @property
    def passed(self) -> bool:
        """True when it ran to its end and no check that decides failed."""
        return not self.error and bool(self.checks) and not any(c.failed for c in self.checks)


def collected(items: Iterable[Item], *, timed: bool, results: dict[type, list[Any]], progress: Progress) -> None:
    """Put every item of a study with its kind in ``results``; a check has the time since the item before it."""
    last = time.perf_counter()
    for item in items:
        now = time.perf_counter()
        kind = type(item)
        if kind not in results:
            raise TypeError(f"a study hands over Check, Table, Figure or Field, not {kind.__name__}")
        # two of one name would hide each other, or their files; checks may also differ by where they were measured
        placed = isinstance(item, Check) and item.at
        if not placed and any(other.name == item.name for other in results[kind]):
            raise ValueError(f"two {kind.__name__.lower()}s are named {item.name!r}")
        if isinstance(item, Check):
            item = replace(item, seconds=now - last) if timed and item.seconds is None else item
            progress(item)
        results[kind].append(item)
        last = now


def quiet(check: Check) -> None:
    """Progress that nobody watches."""


def run(
    studies: tuple[Study, ...],
    level: str,
    progress: Progress = quiet,
    announce: Callable[[Study], None] = lambda study: None,
    workers: int = 1,
) -> Iterator[Outcome]:
    """Yield the `Outcome` of each study in order, run in this process or over several ``workers``. ``announce`` is
    called before each, ``progress`` on each check, where it runs."""
    with mapped(min(workers, len(studies))) as each:
        yield from each(partial(run_one, level=level, progress=progress, announce=announce), studies)


# `Any` in `mapped`: what the function returns that is mapped. In `collected`: each list has items of the type of its
# key.
@contextmanager
def mapped(workers: int) -> Iterator[Callable[..., Iterator[Any]]]:
    """``map`` in this process, or over fresh processes that end with it."""
    if workers <= 1:
        yield map
        return
    with ProcessPoolExecutor(workers, multiprocessing.get_context("spawn"), end_with_parent) as pool:
        try:
            yield pool.map
        finally:
            pool.shutdown(cancel_futures=True)


def run_one(
    study: Study, level: str, progress: Progress = quiet, announce: Callable[[Study], None] = lambda study: None
) -> Outcome:
    """Import and run one study. Only an interrupt from the keyboard goes past here."""
    announce(study)
    results: dict[type, list[Any]] = {kind: [] for kind in (Check, Table, Figure, Field)}
    start = time.perf_counter()
    description = ""
    error = ""
    trace = ""
    try:
        function = load(study)
        description = inspect.getdoc(function) or ""
        produced = function(level, **study.options)
        collected(produced, timed=inspect.isgenerator(produced), results=results, progress=progress)
        results[Check] = [c if c.grade else replace(c, grade=study.grade) for c in results[Check]]
        if not results[Check]:
            raise RuntimeError("the study ended without a single check")
    except (Exception, SystemExit) as exc:  # noqa: BLE001  a study may fail in any way; all are reported
        error = explain(exc)
        trace = traceback.format_exc()
        progress(raised(study, error))
        results[Check].append(raised(study, error))
    checks, tables, figures, fields = (tuple(items) for items in results.values())
    seconds = time.perf_counter() - start
    return Outcome(
        study=study,
        level=level,
        description=description,
        checks=checks,
        tables=tables,
        figures=figures,
        fields=fields,
        seconds=seconds,
        error=error,
        trace=trace,
    )


def load(study: Study) -> Callable[..., Iterable[Item]]:
    """Return the function behind ``study.target``."""
    module, _, function = study.target.partition(":")
    study_function: Callable[..., Iterable[Item]] = getattr(importlib.import_module(module), function)
    return study_function


def explain(exc: BaseException) -> str:
    """Return the last line of the traceback; for a missing extra also how to install it."""
    missing = (exc.name or "").partition(".")[0] if isinstance(exc, ModuleNotFoundError) else ""
    if missing in EXTRAS:
        package = EXTRAS[missing]
        return f"{package} is not installed: {INSTALL}"
    return " ".join("".join(traceback.format_exception_only(exc)).split())


def raised(study: Study, error: str) -> Check:
    """Return the failed check of a study that did not reach its end."""
    return Check(
        f"{study.name} runs to its end",
        float("nan"),
        expected=0.0,
        tolerance=0.0,
        source="the study itself",
        kind=AT_MOST,
        note=error,
        grade="B",
    )


def end_with_parent() -> None:
    """To be called first in a worker (``initializer`` of a pool): it ends with the process that started it, at any
    point of its work. A pool that ends stops its workers, but a pool that is killed does not."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_watch, args=(parent.sentinel,), daemon=True).start()


def _watch(sentinel: int) -> None:
    wait([sentinel])
    os._exit(1)
