"""``python -m verification published``: `lubfric` compared with published numbers and laws.

These are the checks of grade A. The numbers are those of `verification.fem.references`, each with its source. A check
passes when both values differ by no more than their 95 % bounds, summed by squares. No input is tuned. A value that
differs by more is shown as a failure, with the cause where it is known, and the command ends with 1.
"""

from __future__ import annotations

from collections import Counter

from ... import check, frame
from ...catalogue import PUBLISHED
from ...check import CAUSES, Check
from ..references import SOURCES

WEAK = 0.25


def summary(report) -> str:
    """Return the number of checks whose bounds are so wide that agreement is weak evidence, and the failed checks with
    their cause."""
    weak = sum(c.tolerance > WEAK * abs(c.expected) for c in report.checks)
    names = [c for c in report.checks if c.failed]
    lines = [f"{weak} of {len(report.checks)} have bounds wider than {WEAK:.0%}: agreement is weak evidence."]
    if names:
        counts = Counter(c.cause or "unknown" for c in names)
        causes = ", ".join(f"{cause} {counts[cause]}" for cause in CAUSES if counts[cause])
        lines += [f"{len(names)} of {len(report.checks)} differ by more than both errors; cause: {causes}."]
    for c in names:
        values = f"lubfric {c.measured:.4g}, published {c.expected:.4g}"
        lines += [f"  [{c.cause or 'unknown'}] {c.name}: {values}; {c.note or 'no reason known'}"]
    return "\n".join(lines)


LEVELS = ("default", "full")
COMMAND = frame.Command(
    "published", __doc__, studies=PUBLISHED, out="out/published", levels=LEVELS, finished=lambda r, o: summary(r)
)


def against(
    key: str,
    name: str,
    ours: float,
    theirs: float,
    own_error: float,
    unit: str = "1",
    note: str = "",
    error: float | None = None,
    cause: str = "",
) -> Check:
    """Compare a value of lubfric with a number of the source ``key``. ``own_error`` and ``error`` (None: that of the
    source) are relative 95 % bounds. ``cause`` is the cause where the values differ by more
    (`verification.check.CAUSES`)."""
    source = SOURCES[key]
    errors = abs(own_error * ours), abs((source.error if error is None else error) * theirs)
    return check.beside(name, ours, theirs, errors, source.text, unit, note, cause)
