"""``lubfric study``: carry out a study file into a folder."""

from __future__ import annotations

import sys
import time
from pathlib import Path

from .._base import validate
from ..errors import ITERATION_LIMIT, ConvergenceError, Report
from ..studies import MOST_WORKERS, check_tools, in_words, load_study, open_study, pool, study
from .console import Pace, keeping, put, say, say_written


def run_study(arguments) -> None:
    """Plan, solve and write study.csv (and study.nc, study.parquet)."""
    workers = validate.integer("--workers", arguments.workers, minimum=1, maximum=MOST_WORKERS)
    plan = load_study(arguments.study)
    if arguments.explain:
        put(sys.stdout, plan.explain(arguments.out) + "\n")
        return
    check_tools(arguments.netcdf, arguments.parquet)
    say(plan.explain(arguments.out))
    begun = time.perf_counter()
    with keeping(lambda: _kept(arguments.out)), pool(workers) as executor:
        result = study(plan, executor=executor, store=arguments.out, on_progress=_progress(begun))
    tables = {"study.csv": result.to_csv}
    if arguments.netcdf:
        tables["study.nc"] = result.to_netcdf
    if arguments.parquet:
        tables["study.parquet"] = result.to_parquet
    for name, write in tables.items():
        write(arguments.out / name)
    if result.cautioned:
        say(f"{result.cautioned} of {result.solved} points have cautions: column validity of study.csv")
    say_written(tables, arguments.out, begun)
    if result.failed:
        report = Report("study", ITERATION_LIMIT, result.solved - result.failed, float("inf"), 0.0)
        said = f"{result.failed} of {result.solved} points failed; first: {result.failures[0]}"
        raise ConvergenceError(said, report, result)


def _kept(folder) -> str:
    if not (Path(folder) / "study.json").is_file():
        return "interrupted before the first point"
    found = open_study(folder)
    left = f"{found.missing} {'curves' if found.chosen else 'points'} are left"
    return f"interrupted; {found.solved} points are kept in {folder}, {left}: the same command goes on from there"


def _progress(begun: float):
    pace, first = Pace(), -1

    def on_progress(done: int, total: int) -> None:
        nonlocal first
        first = done if first < 0 else first  # what the store held already took no time
        if pace.due(done == total):
            passed = time.perf_counter() - begun
            left = f", about {in_words(passed * (total - done) / (done - first))} left" if first < done < total else ""
            say(f"[{done:>{len(str(total))}}/{total}] {passed:.0f} s{left}")

    return on_progress
