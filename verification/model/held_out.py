"""The stated error of the model, tested on surfaces, lengths, loads and autocorrelations from which it was not read
off.

``uncertainty.model_form`` follows from a study of surfaces of 8 µm and 100 nm, seeds 1 to 20, under 5.5, 27.5 and 110
N. Here are others, one by one: how many points lie within the error that their own result states, and within twice
that. If errors were Gaussian, a stated rms error would hold for two points of three, and twice it for nineteen of
twenty.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..check import AT_LEAST, Check, Item, Table
from .measure import REFERENCE, Point, Setting, all_points

TELLING = ('Eq. (8) over "hertz"', "one-way")
SPEEDS = (0.1, 0.06, 0.03, 0.01, 0.003)
SLOW = (0.01, 0.003, 0.001)  # where heavy contacts carry nearly all
COUNT = {"quick": 1, "default": 2, "full": 6}
COLUMNS = (
    "surfaces",
    "model",
    "points",
    "within the stated error",
    "within twice it",
    "rms of f over the stated error",
)
ONE, TWO = 0.6, 0.9  # shares that are asked of all together


def kinds(level: str) -> dict[str, list[Setting]]:
    """Groups of settings by what is new in them."""
    cells = {"quick": 32, "default": 64, "full": 96}[level]
    seeds = range(101, 101 + COUNT[level])

    def those(acf="gaussian", load=5.5, fluid="Newtonian", length=8e-6, sq=100e-9, speeds=SPEEDS):
        return [Setting(seed, acf, load, fluid, speeds, cells, length, sq) for seed in seeds]

    return {
        "other seeds": those(),
        "5 µm": those(length=5e-6),
        "12 µm": those(length=12e-6),
        "60 nm": those(sq=60e-9),
        "exponential, 5 µm": those(acf="exponential", length=5e-6),
        "13.75 N, limiting stress": those(load=13.75, fluid="limiting stress"),
        "55 N, limiting stress": those(load=55.0, fluid="limiting stress"),
        "27.5 N, slow": those(load=27.5, fluid="limiting stress", speeds=SLOW),
        "110 N, slow": those(load=110.0, fluid="limiting stress", speeds=SLOW),
    }


def held_out(level: str, file: Path | None = None) -> Iterator[Item]:
    """How often the told error holds there; what is kept in ``file`` is not solved again."""
    rows, gathered = table(level, file)
    yield Table("held-out", "The told error on surfaces it was not read off", COLUMNS, rows)
    for method, ratios in gathered.items():
        for times, share in ((1, ONE), (2, TWO)):
            held = float(np.mean(ratios <= times)) if ratios.size else 0.0
            name = f"{method}: share of {ratios.size} held-out points within {times} x model_form"
            yield Check(name, held, share if level != "quick" else 0.0, 0.0, "deterministic film", AT_LEAST)


def table(level: str, file: Path | None = None) -> tuple[tuple[tuple, ...], dict[str, np.ndarray]]:
    """Rows for every group and model, and |error| over told error of all points, by model."""
    rows: list[tuple] = []
    gathered: dict[str, list[np.ndarray]] = {method: [] for method in TELLING}
    for name, settings in kinds(level).items():
        found = all_points(settings, file, (REFERENCE, *TELLING))
        for method in TELLING:
            ratios = told_ratios(found, method)
            gathered[method].append(ratios)
            shares = [f"{100 * np.mean(ratios <= times):.0f} %" for times in (1, 2)]
            rows.append((name, method, ratios.size, *shares, f"{np.sqrt(np.mean(ratios**2)):.2f}"))
    return tuple(rows), {method: np.concatenate(parts) for method, parts in gathered.items()}


def told_ratios(found: list[Point], method: str) -> np.ndarray:
    """|f/f_ref - 1| over what the result says, of the points that both solved."""
    reference = {(p.setting, p.speed): p.coefficient for p in found if p.method == REFERENCE}
    ratios = [
        abs(p.coefficient / reference[p.setting, p.speed] - 1) / max(p.told, 1e-3) for p in found if p.method == method
    ]
    return np.array([r for r in ratios if np.isfinite(r)])
