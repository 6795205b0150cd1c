"""``python -m verification mutations``: break `lubfric` in ten ways; the studies have to catch every one.

Each mutant (`mutants`) runs a few studies at the quick level in a process of its own. Caught means that a
check fails, or that a study is stopped by an error `lubfric` raises on purpose; any other exception is a
broken trial, not a catch. The unbroken library runs the same studies and has to pass them all.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import multiprocessing
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

from .check import Check
from .mutants import MUTANTS, applied
from .run import run_one
from .studies import STUDIES
from .wording import allowed, number

SUITE = ("contact_grid", "ehl_grid", "friction", "load_sharing")
NONE = "none"
ON_PURPOSE = "lubfric.errors."


@dataclass(frozen=True)
class Trial:
    """What the studies made of a mutant ("none": the library as it is).

    failures : (study, check, measured, allowed) of the checks that failed; checks : how many were looked at;
    crash : exception that `lubfric` did not raise on purpose, or ""; calls : how often the broken code ran;
    seconds : wall time.
    """

    name: str
    what: str
    failures: tuple[tuple[str, str, str, str], ...]
    checks: int
    crash: str
    calls: int
    seconds: float

    @property
    def passed(self) -> bool:
        """A mutant ran and was caught; the library as it is passed everything."""
        if self.name == NONE:
            return not self.failures and not self.crash
        return bool(self.failures) and not self.crash and self.calls > 0


def trial(name: str, thorough: bool = False, suite: tuple[str, ...] = SUITE) -> Trial:
    """Run the suite on one mutant, study by study until one fails (``thorough``: all of them)."""
    mutant = next((m for m in MUTANTS if m.name == name), None)
    start, failures, checks, crash = time.perf_counter(), [], 0, ""
    with applied(mutant) if mutant else contextlib.nullcontext([]) as calls:
        for study in (s for s in STUDIES if s.name in suite):
            outcome = run_one(study, "quick", lambda check: None)
            checks += len(outcome.checks)
            failures += [(study.name, *words(c)) for c in outcome.checks if not c.passed]
            if outcome.error and not outcome.error.startswith(ON_PURPOSE):
                crash = outcome.error
            if failures and mutant and not thorough:
                break
    what = mutant.what if mutant else "the library as it is"
    return Trial(name, what, tuple(failures), checks, crash, len(calls), time.perf_counter() - start)


def words(check: Check) -> tuple[str, str, str]:
    """Name, measured and allowed value of a check; for a study that was stopped, by what."""
    if check.name.endswith("runs to its end"):
        return check.name, check.note[:160], "no error"
    return check.name, f"{number(check.measured)} {check.unit.replace('1', '')}".strip(), allowed(check)


def trials(names: list[str], thorough: bool, workers: int):
    """Trials in the order they end, each in a fresh process."""
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, mp_context=context, max_tasks_per_child=1) as pool:
        waiting = [pool.submit(trial, name, thorough) for name in names]
        yield from (future.result() for future in waiting)


def main(argv: list[str]) -> int:
    """Exit code 0: every mutant was caught and the library as it is passed."""
    known = [NONE, *(m.name for m in MUTANTS)]
    p = argparse.ArgumentParser("python -m verification mutations", description=__doc__)
    p.add_argument("--only", nargs="+", choices=known, metavar="NAME", help=f"run only these: {', '.join(known)}")
    p.add_argument("--all-checks", action="store_true", help="go on after the first study that fails")
    p.add_argument("--workers", type=int, default=2, help="processes (default: %(default)s)")
    p.add_argument("--json", type=Path, metavar="FILE", help="write the table here, too")
    options = p.parse_args(argv)
    start, found = time.perf_counter(), []
    for t in trials(options.only or known, options.all_checks, options.workers):
        print(f"{'ok  ' if t.passed else 'FAIL'} {t.name} ({t.seconds:.1f} s)", file=sys.stderr, flush=True)
        found.append(t)
    print(table(found, time.perf_counter() - start))
    if options.json:
        options.json.write_text(json.dumps([asdict(t) | {"passed": t.passed} for t in found], indent=1) + "\n")
    return 0 if all(t.passed for t in found) else 1


def table(found: list[Trial], seconds: float) -> str:
    """Markdown: mutant, verdict, the first check that caught it and its numbers."""
    lines = [
        "| mutant | what is wrong | caught by | measured | allowed | failing checks |",
        "|---|---|---|---|---|---|",
    ]
    for t in found:
        study, check, measured, limit = t.failures[0] if t.failures else ("", "nothing", "", "")
        caught = f"{study}: {check}" if t.failures else check
        note = (
            ""
            if t.passed
            else " (CRASHED)"
            if t.crash
            else " (FAILED)"
            if t.name == NONE
            else " (NOT CAUGHT)"
            if t.calls
            else " (NEVER RAN)"
        )
        cells = (t.name + note, t.what, caught, measured, limit, f"{len(t.failures)} of {t.checks}")
        lines.append(f"| {' | '.join(cells)} |")
    caught = sum(t.passed for t in found if t.name != NONE)
    mutants = sum(t.name != NONE for t in found)
    lines += ["", f"{caught} of {mutants} mutants caught in {seconds:.0f} s"]
    lines += [
        "the library as it is FAILED" if not t.passed else f"the library as it is passes {t.checks} checks"
        for t in found
        if t.name == NONE
    ]
    return "\n".join(lines)
