"""Numbers, times and tolerances as text, the same on the terminal and on the page."""

import math
from collections.abc import Iterable, Sequence

from .check import ABSOLUTE, AT_LEAST, AT_MOST, GRADES, RELATIVE, REPORTED, Check

MANY = 100  # checks: of more, only those that fail or are listed are printed

ALLOWED = {
    RELATIVE: "{expected} ± {relative}",
    ABSOLUTE: "{expected} ± {tolerance}",
    AT_MOST: "≤ {expected} + {tolerance}",
    AT_LEAST: "≥ {expected} − {tolerance}",
}


def mark(check: Check) -> str:
    """Return the verdict in four letters: what decides nothing, or has nothing to be, is neither right nor wrong."""
    if check.failed:
        return "FAIL"
    if check.deviates_as_listed:
        return "list"
    return "ok  " if check.decisive and check.kind != REPORTED else "-   "


def listed(checks: tuple[Check, ...]) -> tuple[Check, ...]:
    """Return the checks that a person reads: all of a few; of very many those that failed or deviate (report.json has
    them all)."""
    return checks if len(checks) <= MANY else tuple(c for c in checks if c.failed or c.listed)


def remark(check: Check) -> str:
    """Return what a person has to know of a check that fails, or that has a listed deviation; else an empty text."""
    listed = check.listed
    if listed is None:
        return f"source: {check.source}{'; ' + check.note if check.note else ''}" if check.failed else ""
    band = f"{number(listed.low)} to {number(listed.high)}"
    if check.no_longer_deviates:
        return f"agrees now; the list has a deviation of {band} ({listed.cause}): remove it from the list"
    words = f"{listed.reason} (cause: {listed.cause}; listed for values of {band})"
    return words if check.deviates_as_listed else f"outside the band of its listed deviation: {words}"


def allowed(check: Check) -> str:
    """Return the allowed range of the measured value as text."""
    if check.kind == REPORTED:
        return "reported"
    tolerance = f"{check.tolerance:.2g}"
    if check.kind == AT_MOST and check.expected == 0:
        return f"≤ {tolerance}"
    if check.kind in (AT_MOST, AT_LEAST) and check.tolerance == 0:
        return ("≤ " if check.kind == AT_MOST else "≥ ") + number(check.expected)
    return ALLOWED[check.kind].format(
        expected=number(check.expected), tolerance=tolerance, relative=fraction(check.tolerance)
    )


def by_grade(checks: Iterable[Check]) -> str:
    """Return how many of the decisive checks of each grade passed: "A 3 of 4, C 2 of 2"."""
    decisive = [c for c in checks if c.decisive]
    counts = {g: [c.passed for c in decisive if c.grade == g] for g in GRADES}
    return ", ".join(f"{grade} {sum(passed)} of {len(passed)}" for grade, passed in counts.items() if passed)


def fraction(value: float) -> str:
    """Return a relative tolerance: in per cent, or in powers of ten where that would be mostly zeros."""
    return f"{100 * value:.2g} %" if value >= 1e-5 or value == 0 else f"{value:.1e} relative"


def number(value: float) -> str:
    """Return a number for a person: six digits; "none" for one that is not finite."""
    if isinstance(value, float):
        return f"{value:.6g}" if math.isfinite(value) else "none"
    return str(value)


def seconds(value: float | None) -> str:
    """Return a time for a person."""
    if value is None:
        return ""
    return f"{value:.2f} s" if value < 100 else f"{value / 60:.1f} min"


def markdown(columns: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Return a table in Markdown, without a line's end after the last row."""
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join("| " + " | ".join(str(cell).replace("|", r"\|") for cell in line) + " |" for line in lines)
