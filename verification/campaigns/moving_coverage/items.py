"""The tables as items of ``python -m verification model``: how often moving answers hold the friction of the endless line."""

import math
from collections.abc import Iterator
from pathlib import Path

from ...check import ABSOLUTE, REPORTED, Check, Item, Table
from ...kept import Run
from .table import FOLDER, covered

# Share of the answers that hold it: the expected one, and how far it may be off. A few answers a contact say no more.
INSIDE = (0.95, 0.08)

SOURCE = "whole passes of other strips, on cells half as long, extrapolated"
COLUMNS = ("", "answers", "inside", "error", "half of the interval", "reference, error")


def coverage(level: str, run: Run = Run(), *, folder: Path = FOLDER) -> Iterator[Item]:
    """Yield table and checks of the answers that ``python -m verification.campaigns.moving_coverage`` has solved. Nothing
    is solved here, at any ``level``, and ``run`` keeps nothing."""
    del level, run
    contacts = list(covered(folder))
    rows = []
    for contact in contacts:
        error = math.hypot(contact["mean_deviation"], contact["scatter"] if contact["answers"] > 1 else 0.0)
        shares = (error, contact["half_width"], contact["reference_error"])
        counts = (str(contact["answers"]), str(contact["inside_with_reference"]))
        rows.append([contact["contact"], *counts, *(f"{100 * share:.2g} %" for share in shares)])
    yield Table("answers-moving", "The deterministic answer where the roughness moves", COLUMNS, rows)
    count = sum(contact["answers"] for contact in contacts)
    inside = sum(contact["inside_with_reference"] for contact in contacts)
    yield Check(
        f"share of {count} moving answers with f of the endless line",
        inside / count if count else math.nan,
        expected=INSIDE[0],
        tolerance=INSIDE[1],
        source=SOURCE,
        kind=ABSOLUTE,
    )
    yield Check("contacts with a reference", len(contacts), expected=0, tolerance=0.0, source=SOURCE, kind=REPORTED)
