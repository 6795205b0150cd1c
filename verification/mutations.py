"""``python -m verification mutations``: break `lubfric` in many ways. The studies and wiring checks have to catch each.

Each mutant (`mutants`) runs a few studies at the quick level, in a process of its own. It is caught when a check fails,
or when a study is stopped by an error that `lubfric` raises on purpose. Any other exception is a broken trial, and no
catch. The unbroken library runs the same studies and has to pass them all.
"""

from argparse import Namespace
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, nullcontext

from .check import AT_LEAST, AT_MOST, Check
from .frame import Command
from .frame import main as run
from .mutant import applied
from .mutants import MUTANTS
from .report import Report
from .run import Outcome, quiet, run_one
from .studies import STUDIES, Study
from .wording import allowed, markdown, number

NONE = "none"
ON_PURPOSE = "lubfric.errors."


def main(argv: list[str]) -> int:
    """The command."""
    levels = ("default",)
    return run(Command("mutations", __doc__, trials(), "out/mutations", levels, 2, finished=table), argv)


def trials() -> tuple[Study, ...]:
    """One trial of the library as it is, and one of each mutant."""
    titles = {NONE: "the library as it is"} | {m.name: m.what for m in MUTANTS}
    target = "verification.mutations:trial"
    return tuple(Study(name, target, title, ("default",), {"name": name}) for name, title in titles.items())


def trial(level: str, name: str, suite: tuple[str, ...] = ()) -> Iterator[Check]:
    """The studies on one mutant, one after the other until a check fails.

    The measured number is how many checks failed: none of the library as it is, one or more of a mutant.
    """
    mutant = next((m for m in MUTANTS if m.name == name), None)
    suite = suite or (mutant.suite if mutant else tuple(dict.fromkeys(s for m in MUTANTS for s in m.suite)))
    failed, looked_at, crash = [], 0, ""
    context: AbstractContextManager[list[str]] = applied(mutant) if mutant else nullcontext([])
    with context as calls:
        for study in (s for s in STUDIES if s.name in suite):
            outcome = run_one(study, "quick", quiet)
            looked_at += len(outcome.checks)
            failed += [(study.name, *words(c)) for c in outcome.checks if c.failed]
            if outcome.error and not outcome.error.startswith(ON_PURPOSE):
                crash = outcome.error
            if failed and mutant:
                break
    yield judged(name, mutant is not None, failed, looked_at, crash, len(calls))


def judged(name: str, mutant: bool, failed: list[tuple], looked_at: int, crash: str, calls: int) -> Check:
    """A mutant has to run, to fail a check and not to crash; the library as it is has to fail none."""
    refused = f"crashed: {crash}" if crash else "the broken code never ran" if mutant and not calls else ""
    study, check, measured, limit = failed[0] if failed else ("", "nothing", "", "")
    return Check(
        f"{name}: checks that fail",
        float("nan") if refused else len(failed),
        float(mutant),
        0.0,
        f"{looked_at} checks of the studies",
        AT_LEAST if mutant else AT_MOST,
        note=f"{study}: {check}: {measured}, allowed {limit}" if failed else check,
        refused=refused,
        at={"mutant": name, "looked_at": looked_at, "calls": calls, "failed": len(failed)},
    )


def words(check: Check) -> tuple[str, str, str]:
    """Name, measured and allowed value of a check. Of a study that was stopped: by what."""
    if check.name.endswith("runs to its end"):
        return check.name, check.note[:160], "no error"
    return check.name, f"{number(check.measured)} {check.unit.replace('1', '')}".strip(), allowed(check)


COLUMNS = ("mutant", "what is wrong", "caught by", "failing checks")


def rows(outcomes: Iterable[Outcome]) -> list[list[str]]:
    """The mutant, what is wrong, the first check that caught it with its numbers, and how many checks failed."""
    found = []
    for outcome in outcomes:
        for c in outcome.checks:
            verdict = "" if c.passed else f" (NOT CAUGHT{f': {c.refused}' if c.refused else ''})"
            share = f"{c.at.get('failed', '')} of {c.at.get('looked_at', '')}"
            found.append([f"`{outcome.study.name}`{verdict}", outcome.study.title, c.note, share])
    return found


def table(report: Report, options: Namespace) -> str:
    """The rows as Markdown, and the count."""
    mutants = [c for o in report.outcomes for c in o.checks if o.study.name != NONE]
    caught = f"{sum(c.passed for c in mutants)} of {len(mutants)} mutants caught"
    return f"{markdown(COLUMNS, rows(report.outcomes))}\n\n{caught}"
