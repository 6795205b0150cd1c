"""Trials of one case, each on a surface of its own, and the friction of an endless line."""

from __future__ import annotations

import json
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

import lubfric

from .truth import truth

REPORTED = 1_000_000  # seeds of the truth begin so far behind those of the trials
BESIDE = ("contact_load", "film_load", "shear_force", "mean_gap", "central_film", "real_contact_area")


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
        "beside": {name: (getattr(found, name), getattr(found.errors, name)) for name in BESIDE},
        "seconds": time.process_time() - begun,
    }


def kept(case, seed: int, out: Path) -> Result | None:
    """What `run` left in ``out``; None where it has no truth or no trials."""
    file = _file(case, seed, out)
    rows = [json.loads(line) for line in file.read_text().splitlines()] if file.is_file() else []
    truths = [r for r in rows if r["kind"] == "truth"]
    trials = [r for r in rows if r["kind"] == "trial"]
    return Result(case, trials, truths[0]["f"], truths[0]["error"]) if truths and len(trials) > 1 else None


def _file(case, seed: int, out: Path) -> Path:
    return out / f"{''.join(c if c.isalnum() else '-' for c in case.name)}-{seed}.jsonl"


def run(case, trials: int, seed: int, out: Path, tell) -> Result:
    """Rows kept in ``out`` as they come (one line each): those found there are not solved again."""
    file = _file(case, seed, out)
    rows = [json.loads(line) for line in file.read_text().splitlines()] if file.is_file() else []
    known = {(r["kind"], r["seed"]) for r in rows}
    wanted = [("truth", seed + REPORTED), *(("trial", seed + i) for i in range(trials))]
    for kind, own in wanted:
        if (kind, own) in known:
            continue
        scene = case.scene(own)
        found = asdict(truth(scene, case.speed, own, case.asked)) if kind == "truth" else None
        rows.append({"kind": kind, "seed": own, **(found or solve(scene, case.speed, case.asked))})
        with file.open("a") as stream:
            stream.write(json.dumps(rows[-1]) + "\n")
    endless = next(r for r in rows if r["kind"] == "truth")
    own_seeds = {own for kind, own in wanted if kind == "trial"}
    chosen = [r for r in rows if r["kind"] == "trial" and r["seed"] in own_seeds]
    result = Result(case, chosen, endless["f"], endless["error"])
    tell(f"{case.name}: {100 * result.covered.mean():.1f} % of {len(chosen)} intervals cover {result.truth:.5g}")
    return result
