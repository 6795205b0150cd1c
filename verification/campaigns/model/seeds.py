"""The default answer on the built-in scene at four speeds, each time on a new surface: how often its interval contains
f of an infinite line contact, its bias, and its cost compared with plain sampling.

Plain sampling is the mean of strips 90 correlation lengths long, each solved by itself by the deterministic model on
cells of a quarter of the correlation length: as many as needed for a mean that scatters no more than the answers do.
It is also the reference. Strips that balance the load one by one give an f that is too small by about 1.3 (sd/f)²; a
part of this is allowed as bias (`SECOND_ORDER`).
"""

import time
from collections.abc import Callable, Iterator

import numpy as np

import lubfric
from lubfric.models.deterministic import solve_strip

from ...check import ABSOLUTE, REPORTED, Check, Item, Table
from ...kept import Run
from ...types import PlainRow
from ..sampling.coverage import within

SPEEDS = (0.06, 0.03, 0.01, 0.003)  # m/s
TRIALS = {"quick": 2, "default": 24, "full": 200}
STRIPS = {"quick": 4, "default": 32, "full": 160}  # of plain sampling
FIRST = 640_000  # seed of the first surface of answers
PLAIN = 650_000  # seed of the first strip of plain sampling
SECOND_ORDER = 1.3  # of (scatter/f)²: part of it that is allowed as bias
BIAS = 0.02  # of f: bias that is allowed besides
COLUMNS: tuple[str, ...] = ("speed", "answers", "coverage", "interval", "stated / scatter", "bias")
COLUMNS += ("CPU time", "plain, to that scatter", "times cheaper")


def answer(speed_and_seed: tuple[float, int]) -> PlainRow:
    """Return f, half of its interval, and processor seconds."""
    speed, seed = speed_and_seed
    begun = time.process_time()
    point = lubfric.friction(lubfric.load_scene("paper").with_(surface={"seed": seed}), speed)
    low, high = point.uncertainty.interval
    return {"f": point.coefficient, "half": (high - low) / 2, "seconds": time.process_time() - begun}


def plain(speed_and_seed: tuple[float, int]) -> PlainRow:
    """Return f of one strip, and processor seconds."""
    speed, seed = speed_and_seed
    scene = lubfric.load_scene("paper").with_(surface={"seed": seed})
    strips = lubfric.prepare(scene).sample
    begun = time.process_time()
    f = solve_strip(scene, strips.strip(0), speed).result.coefficient
    return {"f": f, "seconds": time.process_time() - begun}


def seeds(level: str, run: Run = Run()) -> Iterator[Item]:
    """Coverage, bias and cost at every speed."""
    rows = []
    for speed in SPEEDS:
        f, half, seconds = _columns(run, answer, speed, range(FIRST, FIRST + TRIALS[level]), ("f", "half", "seconds"))
        one, each = _columns(run, plain, speed, range(PLAIN, PLAIN + STRIPS[level]), ("f", "seconds"))
        truth = one.mean()
        scatter = one.std(ddof=1) / one.mean()
        error = scatter / np.sqrt(one.size)
        bias = f.mean() / truth - 1
        covered = float((np.abs(f - truth) <= np.hypot(half, 2 * error * truth)).mean())
        name = f"{speed:g} m/s"
        stated = float(np.sqrt(np.mean((half / 1.96) ** 2)))
        needed = each.mean() * (one.std(ddof=1) / f.std(ddof=1)) ** 2
        yield within(
            f"{name}: coverage", covered, f.size, (0.9, 1.0), "strips one by one", decides=f.size > STRIPS["quick"]
        )
        open_ = np.hypot(error, f.std(ddof=1) / truth / np.sqrt(f.size))
        slack = BIAS + 2 * open_ + SECOND_ORDER * scatter**2
        cheaper = needed / seconds.mean()
        yield Check(
            f"{name}: bias of f", bias, expected=0.0, tolerance=slack, source="strips one by one", kind=ABSOLUTE
        )
        yield Check(
            f"{name}: times cheaper than plain sampling",
            cheaper,
            expected=1.0,
            tolerance=0.0,
            source="strips one by one",
            kind=REPORTED,
        )
        shares = f"{100 * covered:.0f} %", f"{100 * half.mean() / truth:.1f} %", f"{stated / f.std(ddof=1):.2f}"
        costs = f"{seconds.mean():.2g} s", f"{needed:.2g} s", f"{cheaper:.2g}"
        rows.append((name, str(f.size), *shares, f"{100 * bias:+.1f} ± {100 * open_:.1f} %", *costs))
    yield Table("answers-seeds", "The default answer on fresh surfaces", COLUMNS, rows)


def _columns(
    run: Run, solve: Callable[[tuple[float, int]], PlainRow], speed: float, numbers: range, names: tuple[str, ...]
) -> list[np.ndarray]:
    cases = {f"{speed:g} m/s, {seed}": (speed, seed) for seed in numbers}
    values = [row for _, row in run.solved(cases, solve, solve.__name__)]
    return [np.array([row[name] for row in values]) for name in names]
