"""Tables of what `python -m verification sampling` kept in its folder, as far as it has come."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from .. import kept
from ..sampling import cases, measure, quantities, verdict
from .measured import Cells

FOLDER = Path("out/sampling")


def coverage() -> Cells:
    """Every case with trials and a truth."""
    found = [measure.found_before(case, cases.SEED, FOLDER) for case in cases.CASES]
    rows = [verdict.row(result) for result in found if result is not None]
    if not rows:
        raise RuntimeError(f"{FOLDER} is empty: run python -m verification sampling first")
    return verdict.COLUMNS, rows


def other_numbers() -> Cells:
    """Every quantity of random scenes within its stated error, or not."""
    file = FOLDER / f"quantities-{quantities.SEED}.jsonl"
    scenes = kept.read(file)
    rows = [
        [f"`{name}`", f"{told} of {len(scenes)}", f"{100 * held:.0f} %", f"{100 * median:.2g} %"]
        for name, told, held, median in quantities.counted(scenes)
    ]
    return ["quantity", "scenes that state an error", "within it", "median of it"], rows


TABLES: dict[str, Callable[[], Cells]] = {"sampling-coverage": coverage, "sampling-numbers": other_numbers}
