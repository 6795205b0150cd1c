"""Trials of one case, each on a surface of its own, and the friction of a line long enough to be the truth."""

from __future__ import annotations

import json
import math
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import lubfric

TIGHTER = 5.0  # times the standard error asked: of the truth
TRUTHS = 2
REPORTED = 1e6  # seeds of the truth begin so far behind those of the trials


@dataclass(frozen=True)
class Result:
    """Rows of the trials of a case, and the truth with its relative standard error."""

    case: object
    rows: list[dict]
    truth: float
    error: float

    def column(self, name: str) -> np.ndarray:
        """One number of all trials."""
        return np.array([row[name] for row in self.rows])

    @property
    def covered(self) -> np.ndarray:
        """Which intervals hold the truth."""
        return (self.column("low") <= self.truth) & (self.truth <= self.column("high"))

    @property
    def ratio(self) -> float:
        """Root mean square of the reported standard error over the observed standard deviation."""
        f = self.column("f")
        return float(np.sqrt(np.mean((self.column("sampling") * f) ** 2)) / f.std(ddof=1))

    @property
    def bias(self) -> float:
        """Of the mean of the trials, relative to the truth."""
        return float(self.column("f").mean() / self.truth - 1)


def solve(scene, speed: float, asked: float) -> dict:
    """One point, in processor seconds."""
    begun = time.process_time()
    found = lubfric.friction(scene.with_(numerics={"sampling_tolerance": asked}), speed)
    u = found.uncertainty
    return {
        "f": found.coefficient,
        "sampling": u.sampling,
        "numerical": u.numerical,
        "low": u.interval[0],
        "high": u.interval[1],
        "length": u.length,
        "participation": u.participation,
        "told": bool(u.notes),
        "seconds": time.process_time() - begun,
    }


def run(case, trials: int, seed: int, out: Path, tell) -> Result:
    """Rows kept in ``out`` as they come (one line each): those found there are not solved again."""
    file = out / f"{''.join(c if c.isalnum() else '-' for c in case.name)}-{seed}.jsonl"
    rows = [json.loads(line) for line in file.read_text().splitlines()] if file.is_file() else []
    wanted = [("truth", int(seed + REPORTED + i), case.asked / TIGHTER) for i in range(TRUTHS)]
    wanted += [("trial", seed + i, case.asked) for i in range(trials)]
    known = {(r["kind"], r["seed"]) for r in rows}
    for kind, own, asked in wanted:
        if (kind, own) in known:
            continue
        rows.append({"kind": kind, "seed": own, **solve(case.scene(own), case.speed, asked)})
        with file.open("a") as stream:
            stream.write(json.dumps(rows[-1]) + "\n")
    truths = [r for r in rows if r["kind"] == "truth"]
    weights = [r["length"] for r in truths]
    truth = float(np.average([r["f"] for r in truths], weights=weights))
    error = math.sqrt(sum((w * r["sampling"]) ** 2 for w, r in zip(weights, truths))) / sum(weights)
    result = Result(case, [r for r in rows if r["kind"] == "trial"], truth, error)
    tell(f"{case.name}: {100 * result.covered.mean():.1f} % of {len(result.rows)} intervals cover {truth:.5g}")
    return result
