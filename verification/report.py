"""The report of a run: its verdict, its text on the terminal and its files. `page` makes the HTML."""

import csv
import importlib.metadata
import json
import math
import os
import platform
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from . import page
from .check import Check, Table
from .meshes import write_vtu
from .run import Outcome, explain, raised
from .types import PlainRow, PlainValue
from .wording import allowed, by_grade, listed, mark, number, remark, seconds

FORMAT = "lubfric-verification-1"
PACKAGES = ("numpy", "scipy", "scikit-fem", "meshio", "pyamg", "matplotlib")


@dataclass(frozen=True, kw_only=True)
class Report:
    """All results of a run.

    level, selected : the requested level, and the names of the studies
    outcomes : the studies finished so far
    complete : False while studies are still to come, or never came because the run was stopped
    started : local date and time
    seconds : wall time so far
    environment : versions and machine
    """

    level: str
    selected: tuple[str, ...]
    outcomes: tuple[Outcome, ...]
    complete: bool
    started: str
    seconds: float
    environment: dict[str, str] = field(default_factory=dict)

    @property
    def checks(self) -> tuple[Check, ...]:
        """All checks of all studies."""
        return tuple(c for o in self.outcomes for c in o.checks)

    @property
    def passed(self) -> bool:
        """True when every selected study ran to its end and passed."""
        return self.complete and bool(self.outcomes) and all(o.passed for o in self.outcomes)

    @property
    def verdict(self) -> str:
        """PASSED, FAILED or UNFINISHED, and the counts."""
        decisive = [c for c in self.checks if c.decisive]
        failed = sum(c.failed for c in decisive)
        deviating = sum(c.deviates_as_listed for c in decisive)
        word = "FAILED" if failed or self.complete else "UNFINISHED"
        if self.passed:
            word = "PASSED"
        text = f"{word}: {len(decisive) - failed - deviating} of {len(decisive)} checks passed"
        if deviating:
            text += f", {failed} failed, {deviating} listed deviation{'s' if deviating > 1 else ''}"
        if not self.complete:
            text += f"; only {len(self.outcomes)} of {len(self.selected)} studies finished"
        return f"{text}; by grade: {by_grade(self.checks)}" if decisive else text

    def as_dict(self) -> PlainRow:
        """Return plain types for report.json; a number that is not finite becomes null."""
        shown = ("passed", "complete", "verdict", "level", "selected", "started", "seconds", "environment")
        values = {"format": FORMAT} | {name: getattr(self, name) for name in shown}
        plain: PlainRow = finite(values | {"studies": [outcome_dict(o) for o in self.outcomes]})
        return plain


def outcome_dict(outcome: Outcome) -> PlainRow:
    """Return one study for report.json."""
    name = outcome.study.name
    return {
        "name": name,
        "title": outcome.study.title,
        "description": outcome.description,
        "passed": outcome.passed,
        "seconds": outcome.seconds,
        "error": outcome.error,
        "traceback": outcome.trace,
        "checks": [c.as_dict() for c in outcome.checks],
        "tables": [asdict(table) for table in outcome.tables],
        "figures": [{"file": file_of(name, f.name, f.format), "caption": f.caption} for f in outcome.figures],
        "fields": [{"file": file_of(name, f.name, "vtu"), "caption": f.caption} for f in outcome.fields],
    }


def finite(value: object) -> PlainValue:
    """Return ``value`` in plain types, with NaN and infinities as None: JSON has no word for them."""
    if isinstance(value, dict):
        return {str(k): finite(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(v) for v in value]
    value = value.item() if hasattr(value, "item") else value
    return None if isinstance(value, float) and not math.isfinite(value) else value


def environment() -> dict[str, str]:
    """Return versions of the packages and the machine, for a reader who wants to repeat the numbers."""
    results = {"python": platform.python_version()}
    for package in PACKAGES:
        try:
            results[package] = importlib.metadata.version(package)
        except importlib.metadata.PackageNotFoundError:
            results[package] = "not installed"
    return results | {"machine": f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores"}


def save_files(outcome: Outcome, out: Path) -> Outcome:
    """Write the figures, tables and fields of one study to ``out``.

    A file that cannot be written is one more failed check of the outcome that is returned.
    """
    try:
        for figure in outcome.figures:
            (out / file_of(outcome.study.name, figure.name, figure.format)).write_bytes(figure.data)
        for table in outcome.tables:
            write_table(out / file_of(outcome.study.name, table.name, "csv"), table)
        for item in outcome.fields:
            write_vtu(out / file_of(outcome.study.name, item.name, "vtu"), item)
    except (ImportError, OSError, ValueError, TypeError) as exc:
        reason = f"its files could not be written: {explain(exc)}"
        failure = replace(raised(outcome.study, reason), name=f"{outcome.study.name} writes its files")
        return replace(outcome, checks=(*outcome.checks, failure))
    return outcome


def file_of(study: str, name: str, ending: str) -> str:
    """Return the file of what a study calls ``name``. It is named after the study, unless it bears that name
    already."""
    return f"{name}.{ending}" if name.startswith(study) else f"{study}_{name}.{ending}"


def write_table(path: Path, table: Table) -> None:
    """Write a table as CSV."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(table.columns)
        writer.writerows([f"{v:.7g}" if isinstance(v, float) else v for v in row] for row in table.rows)


def save(report: Report, out: Path) -> Path:
    """Write report.json and report.html to ``out``; returns the path of the page."""
    text = json.dumps(report.as_dict(), indent=1, allow_nan=False)
    (out / "report.json").write_text(text + "\n", encoding="utf-8")
    (out / "report.html").write_text(page.render(report), encoding="utf-8")
    return out / "report.html"


def terminal_table(report: Report) -> str:
    """Return the checks as text, one line each, with the reason below those that failed or deviate. Of very many only
    these.

    Those that failed or deviate stand once more at the end, where a person looks first."""
    lines = []
    for outcome in report.outcomes:
        lines += [f"{outcome.study.name}: {outcome.study.title} ({seconds(outcome.seconds)})"]
        width = max((len(c.name) for c in listed(outcome.checks)), default=0)
        shown = listed(outcome.checks)
        if len(shown) < len(outcome.checks):
            lines += [f"  {len(outcome.checks)} checks, {sum(c.failed for c in outcome.checks)} failed"]
        for c in shown:
            unit = "" if c.unit == "1" else f" {c.unit}"
            lines += [
                f"  {mark(c)} {c.name:<{min(width, 60)}}  "
                f"{number(c.measured):>12}{unit}  ({allowed(c)})  {seconds(c.seconds)}".rstrip()
            ]
            lines += [f"       {remark(c)}"] if remark(c) else []
    return "\n".join([*lines, "", *remarkable(report), report.verdict])


def remarkable(report: Report) -> list[str]:
    """Return the lines that repeat the checks that failed or have a listed deviation, with the reasons."""
    groups = {
        "Failed": [c for c in report.checks if c.failed],
        "Listed deviations": [c for c in report.checks if c.deviates_as_listed],
        "Listed deviations that no longer exist": [c for c in report.checks if c.no_longer_deviates],
    }
    lines = []
    for title, checks in groups.items():
        if checks:
            lines += [f"{title}:"]
            lines += [f"  {c.name}: {number(c.measured)} ({allowed(c)}). {remark(c)}" for c in checks]
    return lines
