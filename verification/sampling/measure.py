"""Trials of one case, each on a surface of its own, and the friction of an endless line."""

from __future__ import annotations

import time
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

import lubfric

from .. import kept
from .cases import Case
from .truth import truth

REPORTED = 1_000_000  # seeds of the truth begin so far behind those of the trials
BESIDE = ("contact_load", "film_load", "shear_force", "mean_gap", "central_film", "real_contact_area")


@dataclass(frozen=True)
class Result:
    """The rows of the trials of a case, and the truth with its relative standard error."""

    case: Case
    rows: list[dict]
    truth: float
    error: float

    def column(self, name: str) -> np.ndarray:
        """One number of all trials."""
        return np.array([row[name] for row in self.rows])

    @property
    def covered(self) -> np.ndarray:
        """For each trial, whether its interval holds the truth."""
        return (self.column("low") <= self.truth) & (self.truth <= self.column("high"))

    @property
    def ratio(self) -> float:
        """Root mean square of the reported standard error over the observed standard deviation."""
        f = self.column("f")
        return float(np.sqrt(np.mean((self.column("sampling") * f) ** 2)) / f.std(ddof=1))

    @property
    def bias(self) -> float:
        """Deviation of the mean of the trials from the truth, relative to it."""
        return float(self.column("f").mean() / self.truth - 1)


def solve(scene, speed: float, asked: float) -> dict:
    """One point, with its processor seconds."""
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


def found_before(case: Case, seed: int, out: Path) -> Result | None:
    """What `run` left in ``out``, or None where it has no truth or no trials."""
    rows = kept.read(_file(case, seed, out))
    truths = [r for r in rows if r["kind"] == "truth"]
    trials = [r for r in rows if r["kind"] == "trial"]
    return Result(case, trials, truths[0]["f"], truths[0]["error"]) if truths and len(trials) > 1 else None


def _file(case: Case, seed: int, out: Path) -> Path:
    return out / f"{''.join(c if c.isalnum() else '-' for c in case.name)}-{seed}.jsonl"


def endless(case: Case, seed: int, out: Path) -> dict:
    """The row of the truth of a case, kept in ``out``: f of an endless line, and its relative standard error."""
    return _rows(case, [("truth", seed + REPORTED)], _file(case, seed, out))[0]


def run(case: Case, trials: int, seed: int, out: Path) -> Result:
    """Trials with seeds from ``seed`` on, and the truth. Rows are kept in ``out`` as they come and not solved again."""
    wanted = [("truth", seed + REPORTED), *(("trial", seed + k) for k in range(trials))]
    truth, *rows = _rows(case, wanted, _file(case, seed, out))
    return Result(case, rows, truth["f"], truth["error"])


def _rows(case: Case, wanted: list[tuple[str, int]], file: Path) -> list[dict]:
    """The truth or the trials, each on surfaces of a seed of its own. Those missing in ``file`` are solved."""
    found = {(row["kind"], row["seed"]): row for row in kept.begin(file)}
    for kind, own in wanted:
        if (kind, own) not in found:
            new = _truth(case, own) if kind == "truth" else solve(case.scene(own), case.speed, case.asked)
            found[kind, own] = {"kind": kind, "seed": own, **new}
            kept.append(file, found[kind, own])
    return [found[key] for key in wanted]


def _truth(case: Case, seed: int) -> dict:
    return asdict(truth(case.scene(seed), case.speed, seed, case.asked))
