"""``python -m verification published``: `lubfric` compared with published numbers and laws.

These are the checks of grade A. The numbers are those of `verification.fem.references`, each with its source. A check
passes when both values differ by no more than their 95 % bounds, summed by squares. No input is tuned. A value that
differs by more is listed where its check is, with the cause, the reason, and the band in which the value of `lubfric`
stays (`verification.check.ListedDeviation`). A value that differs and is not listed, or leaves its band, fails.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ... import check, frame
from ...catalogue import PUBLISHED
from ...check import CAUSES, Check, ListedDeviation
from ..references import SOURCES

if TYPE_CHECKING:
    from ...report import Report

WEAK = 0.25  # sum of both bounds over the value from which on agreement is weak evidence


def summary(report: Report) -> str:
    """Return the number of checks whose bounds are so wide that agreement is weak evidence, and the number of listed
    deviations by cause."""
    weak = sum(c.tolerance > WEAK * abs(c.expected) for c in report.checks)
    lines = [f"{weak} of {len(report.checks)} have bounds wider than {WEAK:.0%}: agreement is weak evidence."]
    deviating = [c.listed.cause for c in report.checks if c.listed and c.deviates_as_listed]
    if deviating:
        causes = ", ".join(f"{cause} {deviating.count(cause)}" for cause in CAUSES if cause in deviating)
        lines += [f"{len(deviating)} of {len(report.checks)} differ by more than both errors; cause: {causes}."]
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
    listed: ListedDeviation | None = None,
) -> Check:
    """Compare a value of lubfric with a number of the source ``key``. ``own_error`` and ``error`` (None: that of the
    source) are relative 95 % bounds. ``listed`` is the known deviation, where the values differ by more."""
    source = SOURCES[key]
    errors = abs(own_error * ours), abs((source.error if error is None else error) * theirs)
    return check.beside(name, ours, theirs, errors, source.text, unit, note, listed)
