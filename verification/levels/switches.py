"""f through every switch between levels and grids: fine steps of speed along three scenes, beside the full model."""

from __future__ import annotations

from typing import Any

import numpy as np

import lubfric
from lubfric.sharing import prepare

from .. import parts
from ..check import Check

TOLERANCE = 1e-2
LUBRICANTS: dict[str, dict[str, Any]] = {
    "paper": {},
    "thin, alpha 5 /GPa": {"viscosity": 0.02, "pressure_viscosity_coefficient": 5e-9},
    "constant viscosity": {"viscosity": 0.1, "viscosity_law": "constant"},
}


def scan(points: int = 240) -> list[Check]:
    """f beside that of the full model at ``points`` speeds shared by the lubricants, cold starts."""
    rows = []
    for name, lubricant in LUBRICANTS.items():
        model = prepare(
            lubfric.load_scene("paper").with_(
                lubricant=lubricant, numerics={"tolerance": TOLERANCE, "sampling": "patch"}
            )
        )
        for speed in np.geomspace(1e-3, 10.0, points // len(LUBRICANTS)):
            auto = lubfric.friction(model, float(speed))
            full = lubfric.friction(model, float(speed), tolerance=5e-4, model="full")
            d = parts.decision(auto)
            shape = f", 1/{d.coarsening[1]}" if d.shape else ""
            at: dict[str, str | float] = {
                "scene": name,
                "speed": float(speed),
                "level": f"{d.film}, {d.contact}{shape}",
            }
            words = f"{name} at {speed:.4g} m/s"
            rows.append(Check(words, auto.coefficient, full.coefficient, TOLERANCE, "the full model", at=at))
    return rows


def jumps(rows: list[Check]) -> list[float]:
    """Relative jump of f - f_full over each change of level between neighbouring speeds."""
    return [
        abs((b.measured / b.expected) / (a.measured / a.expected) - 1)
        for a, b in zip(rows, rows[1:])
        if a.word("scene") == b.word("scene") and a.word("level") != b.word("level")
    ]
