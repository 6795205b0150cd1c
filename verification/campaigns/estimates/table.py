"""The table of runs: what each was estimated to take, the counted work, and the processor time that it took."""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

import lubfric
from lubfric._base import limited_work

from ...types import PlainRow
from .. import table_file
from .jobs import KINDS, MOST_WORK, drawn, seconds

TABLE = Path(__file__).parent / "table.csv"
# Digits of a number in the table.
DIGITS = 4
COLUMNS = ("seed", "kind", "lambda_ratio", "pressure", "sq", "estimate", "work", "seconds", "failure")


def timed(seed: int) -> PlainRow:
    """Return the row of run number ``seed``."""
    job = drawn(seed)
    scene = job.scene
    line = scene.line_contact(scene.motion.entrainment_speed)
    sq = scene.surface.sq or math.nan
    row: PlainRow = {
        "seed": seed,
        "kind": job.kind,
        "lambda_ratio": line.moes_film / sq,
        "pressure": 4 / math.pi * (scene.bodies.mean_hertz_pressure or math.nan),
        "sq": sq,
        "failure": "",
    }
    try:
        row["estimate"] = job.estimate()
    except lubfric.LubfricError as error:
        return row | {"failure": f"estimate: {error}"[:120]}
    begun = seconds()
    with limited_work(math.inf) as meter:
        try:
            job.run()
        except lubfric.LubfricError as error:
            row["failure"] = f"{type(error).__name__}: {error}".replace("\n", " ")[:120]
    if meter.spent > MOST_WORK and not row["failure"]:
        row["failure"] = "max_work"  # a point by a cheaper model
    return row | {"work": meter.spent, "seconds": seconds() - begun}


def rows(file: Path = TABLE) -> list[dict[str, str]]:
    """Return the rows of the table as text."""
    return table_file.rows(file)


def extend(
    count: int, budget: float, kinds: Sequence[str] = KINDS, file: Path = TABLE, first: int = 0
) -> Iterator[PlainRow]:
    """Do the runs of these ``kinds`` from number ``first`` to below ``count`` that the table has not, as long as the
    processor time is below ``budget`` [s], and append each as it ends."""
    known = {int(row["seed"]) for row in rows(file)}
    for seed in range(first, count):
        if seed in known or KINDS[seed % len(KINDS)] not in kinds:
            continue
        if seconds() > budget:
            return
        row = timed(seed)
        table_file.append(file, COLUMNS, row, DIGITS)
        yield row


def ratios(file: Path = TABLE) -> dict[str, np.ndarray]:
    """Return estimated over taken processor time of the runs that ended by themselves, by kind."""
    by_kind: dict[str, list[float]] = {}
    for row in rows(file):
        if row["seconds"] and row["estimate"] and "max_work" not in row["failure"]:
            by_kind.setdefault(row["kind"], []).append(float(row["estimate"]) / float(row["seconds"]))
    return {kind: np.array(values) for kind, values in by_kind.items()}


def summary(file: Path = TABLE) -> str:
    """Return, by kind: runs, share within factors of 2 and 3, median and extremes of the ratio, as a Markdown table."""
    lines = [
        "| kind | runs | within 2 | within 3 | median | least | largest |",
        "|---|---|---|---|---|---|---|",
    ]
    for kind, values in ratios(file).items():
        apart = np.abs(np.log(values))
        within = [f"{100 * np.mean(apart <= math.log(factor)):.0f} %" for factor in (2, 3)]
        numbers = [f"{value:.2g}" for value in (np.median(values), values.min(), values.max())]
        lines.append(f"| {' | '.join([kind, str(values.size), *within, *numbers])} |")
    return "\n".join(lines)
