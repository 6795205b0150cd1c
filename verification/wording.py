"""Numbers, times and tolerances as text, the same on the terminal and on the page."""

import math
from collections.abc import Iterable, Sequence

from .check import ABSOLUTE, AT_LEAST, AT_MOST, GRADES, RELATIVE, REPORTED, Check

MANY = 100

ALLOWED = {
    RELATIVE: "{expected} ± {relative}",
    ABSOLUTE: "{expected} ± {tolerance}",
    AT_MOST: "≤ {expected} + {tolerance}",
    AT_LEAST: "≥ {expected} − {tolerance}",
}


def mark(check: Check) -> str:
    """The verdict in four letters: what decides nothing, or has nothing to be, is neither right nor wrong."""
    if check.failed:
        return "FAIL"
    return "ok  " if check.decisive and check.kind != REPORTED else "-   "


def listed(checks: tuple[Check, ...]) -> tuple[Check, ...]:
    """Return the checks that a person reads: all of a few; of very many those that failed (report.json has them all)."""
    return checks if len(checks) <= MANY else tuple(c for c in checks if c.failed)


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
    """A relative tolerance: in per cent, or in powers of ten where that would be mostly zeros."""
    return f"{100 * value:.2g} %" if value >= 1e-5 or value == 0 else f"{value:.1e} relative"


def number(value: float) -> str:
    """A number for a person: six digits; "none" for one that is not finite."""
    if isinstance(value, float):
        return f"{value:.6g}" if math.isfinite(value) else "none"
    return str(value)


def seconds(value: float | None) -> str:
    """A time for a person."""
    return "" if value is None else f"{value:.2f} s" if value < 100 else f"{value / 60:.1f} min"


def markdown(columns: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table in Markdown, without a line's end after the last row."""
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join("| " + " | ".join(str(cell).replace("|", r"\|") for cell in line) + " |" for line in lines)
