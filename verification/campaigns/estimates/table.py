"""The table of runs: what each was estimated to take, the counted work, and the processor time that it took.

The processor seconds of a run are those on the stated core (`pace.paced`). Runs done on other machines are scaled by
runs that took the same counted work on both. The runs below number 38 by the quick and the deterministic model and with
moving roughness: divided by 1.87, the median ratio of 15 runs. The twelve from number 41 on, after number 349: after
`paced` by 1.69, that of 13 runs, 1.25 to 2.35; the machine was shared, and Python slows more there than the transform
that `paced` times. Those after number 110: as `paced` gives them; 11 earlier runs, repeated there, took 1.03 times as
long, 0.9 to 1.45; that machine was shared, too. So was that of the last 33 runs below number 10000, and of those on
patches above it, with two threads on one core. The rolling points were done again there, or for the first time from
number 512 on, and so were the fits, and the patches at rest by the deterministic model. All estimates but those that
are measured are of the present code (`--again`).
"""

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import lubfric
from lubfric._base import limited_work

from ...check import Table
from ...pace import paced
from ...types import PlainRow
from .. import table_file
from ..extending import solved_in_processes
from .jobs import KINDS, MEASURED_KINDS, MOST_WORK, drawn, kind_of, seconds

TABLE = Path(__file__).parent / "table.csv"
# Digits of a number in the table.
DIGITS = 4

# Factor within which an estimate is good.
FACTOR = 3.0
# Kinds, by their first word, that a page shows together.
GROUPS = {
    "patch": "patches",
    "rest": "points",
    "rolling": "points",
    "curve": "curves",
    "traction": "curves",
    "study": "curves",
    "fit": "fits",
    "time": "time",
    "run-in": "wear",
    "wear": "wear",
    "command": "command",
}
COLUMNS = ("seed", "draw", "kind", "lambda_ratio", "pressure", "sq", "estimate", "work", "seconds", "failure")


def timed(seed: int) -> PlainRow:
    """Return the row of run number ``seed``."""
    job = drawn(seed)
    scene = job.scene
    line = scene.line_contact(scene.motion.entrainment_speed)
    sq = scene.surface.sq or math.nan
    row: PlainRow = {
        "seed": seed,
        "draw": job.draw,
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

    def run() -> float:
        with limited_work(math.inf) as meter:
            try:
                job.run()
            except lubfric.LubfricError as error:
                row["failure"] = f"{type(error).__name__}: {error}".replace("\n", " ")[:120]
        return meter.spent

    if job.kind in MEASURED_KINDS:  # whose estimate has the pace of this core in it
        begun = seconds()
        work = run()
        taken = seconds() - begun
    else:
        (work, taken) = paced(run, clock=seconds)
    if work > MOST_WORK and not row["failure"] and job.kind not in MEASURED_KINDS:
        row["failure"] = "max_work"  # a point by a cheaper model
    return row | {"work": work, "seconds": taken}


def rows(file: Path = TABLE) -> list[dict[str, str]]:
    """Return the rows of the table as text."""
    return table_file.rows(file)


@dataclass(frozen=True)
class RowOfRun:
    """The row of run number ``seed``."""

    seed: int

    def row(self) -> PlainRow:
        """Return the row: the run is done."""
        return timed(self.seed)


def extend(
    count: int, seconds: float, workers: int, kinds: Sequence[str] = KINDS, file: Path = TABLE, first: int = 0
) -> Iterator[PlainRow]:
    """Do the runs of these ``kinds`` from number ``first`` to below ``count`` that the table has not, in so many
    processes (``workers``), and append each as it ends; those that take longer than ``seconds`` of elapsed time in all
    are left out."""
    known = {int(row["seed"]) for row in rows(file)}
    left = [RowOfRun(n) for n in range(first, count) if n not in known and kind_of(n) in kinds]
    for row in solved_in_processes(left, seconds, workers):
        table_file.append(file, COLUMNS, row, DIGITS)
        yield row


def estimate_again(file: Path = TABLE) -> None:
    """Estimate the runs of the table again, and write it anew: none is done. The estimates of `MEASURED_KINDS` stay:
    like the time that these runs took, they are of the core at that moment."""
    old = rows(file)
    for row in old:
        if row["kind"] in MEASURED_KINDS:
            continue
        with suppress(lubfric.LubfricError):
            row["estimate"] = f"{drawn(int(row['seed']), int(row['draw'])).estimate():.{DIGITS}g}"
    file.unlink(missing_ok=True)
    for row in old:
        table_file.append(file, COLUMNS, dict(row), DIGITS)


def rows_with_ratio(file: Path = TABLE) -> Iterator[tuple[dict[str, str], float]]:
    """Yield the rows of runs that say how good an estimate is, and their estimated over taken processor time: all but
    those that ``numerics.max_work`` ended before they took three times their estimate."""
    for row in rows(file):
        if row["seconds"] and row["estimate"]:
            ratio = float(row["estimate"]) / float(row["seconds"])
            if "max_work" not in row["failure"] or ratio < 1 / FACTOR:
                yield row, ratio


def ratios(file: Path = TABLE) -> dict[str, np.ndarray]:
    """Return estimated over taken processor time of these runs, by kind."""
    by_kind: dict[str, list[float]] = {}
    for row, ratio in rows_with_ratio(file):
        by_kind.setdefault(row["kind"], []).append(ratio)
    return {kind: np.array(values) for kind, values in by_kind.items()}


def table(file: Path = TABLE, *, brief: bool = False) -> Table:
    """Return, of all runs and by kind: runs, parts within factors of 2 and 3, median and extremes of the ratio;
    ``brief``: the part within 3 alone, by `GROUPS`."""
    of_kind: dict[str, np.ndarray] = {}
    for kind, values in ratios(file).items():
        name = GROUPS[kind.split()[0]] if brief else kind
        of_kind[name] = np.concatenate([of_kind.get(name, np.empty(0)), values])
    both = {"all": np.concatenate(list(of_kind.values())), **of_kind} if of_kind else {}
    lines = []
    for kind, values in both.items():
        apart = np.abs(np.log(values))
        within = [f"{100 * np.mean(apart <= math.log(factor)):.0f} %" for factor in ((3,) if brief else (2, 3))]
        numbers = [] if brief else [f"{value:.2g}" for value in (np.median(values), values.min(), values.max())]
        lines.append([kind, str(values.size), *within, *numbers])
    columns = ["kind", "runs", "within 3"]
    if not brief:
        columns = ["kind", "runs", "within 2", "within 3", "median", "least", "largest"]
    return Table("estimates", "estimated over taken time", columns, lines)


def outside(file: Path = TABLE) -> list[str]:
    """Return the runs whose estimate is further than a factor of 3 from the time they took, as text."""
    return [
        f"{row['seed']} {row['kind']}: {ratio:.2g} of {float(row['seconds']):.2g} s"
        for row, ratio in rows_with_ratio(file)
        if not 1 / FACTOR <= ratio <= FACTOR
    ]
