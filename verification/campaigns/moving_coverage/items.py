"""The tables as items of ``python -m verification model``: how often moving answers hold the friction of the endless
line."""

import math
from collections.abc import Iterator
from pathlib import Path

from ...check import ABSOLUTE, REPORTED, Check, Item, Table
from ...kept import Run
from .table import FOLDER, covered, judged_answers, summary

# Share of the answers that hold it: the expected one, and how far it may be off: two standard deviations of 120
# answers.
INSIDE = (0.95, 0.04)

SOURCE = "whole passes of other strips, on cells half as long, extrapolated"
COLUMNS = ("", "answers", "inside", "rms error", "half-width", "by cells", "error of reference", "counted work (s)")


def coverage(level: str, run: Run = Run(), *, folder: Path = FOLDER) -> Iterator[Item]:
    """Yield table and checks of the answers that ``python -m verification.campaigns.moving_coverage`` has solved.
    Nothing is solved here, at any ``level``, and ``run`` keeps nothing."""
    del level, run
    answers = list(judged_answers(folder))
    groups = [*covered(folder)] + ([{"contact": "all"} | summary(answers)] if answers else [])
    rows = [
        [
            group["contact"],
            str(group["answers"]),
            str(group["inside"]),
            *(f"{100 * group[name]:.2g} %" for name in ("error", "half_width", "cells", "reference_error")),
            f"{group['work']:.0f}",
        ]
        for group in groups
    ]
    yield Table("answers-moving", "The deterministic answer where the roughness moves", COLUMNS, rows)
    yield Check(
        f"share of {len(answers)} moving answers with f of the endless line",
        sum(answer.is_inside for answer in answers) / len(answers) if answers else math.nan,
        expected=INSIDE[0],
        tolerance=INSIDE[1],
        source=SOURCE,
        kind=ABSOLUTE,
    )
    yield Check(
        "contacts with a reference",
        len({answer.contact.name for answer in answers}),
        expected=0,
        tolerance=0.0,
        source=SOURCE,
        kind=REPORTED,
    )
