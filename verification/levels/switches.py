"""f through every switch between levels and grids: fine steps of speed along three scenes, beside the full model."""

from __future__ import annotations

import numpy as np

import lubfric
from lubfric.model import prepare

TOLERANCE = 1e-2
LUBRICANTS = {
    "paper": {},
    "thin, alpha 5 /GPa": {"viscosity": 0.02, "pressure_viscosity_coefficient": 5e-9},
    "constant viscosity": {"viscosity": 0.1, "viscosity_law": "constant"},
}


def scan(points: int = 240) -> list[dict]:
    """Rows (scene, speed, f, full, error, level) of ``points`` speeds shared by the lubricants, cold starts."""
    rows = []
    for name, lubricant in LUBRICANTS.items():
        model = prepare(lubfric.load_scene("paper").with_(lubricant=lubricant, numerics={"tolerance": TOLERANCE}))
        for speed in np.geomspace(1e-3, 10.0, points // len(LUBRICANTS)):
            auto = lubfric.friction(model, float(speed))
            full = lubfric.friction(model, float(speed), tolerance=5e-4, model="full")
            d = auto.decision
            rows.append(
                {
                    "scene": name,
                    "speed": float(speed),
                    "f": auto.coefficient,
                    "full": full.coefficient,
                    "error": abs(auto.coefficient / full.coefficient - 1),
                    "level": f"{d.film}, {d.contact}" + (f", 1/{d.coarsening[1]}" if d.shape else ""),
                }
            )
    return rows


def jumps(rows: list[dict]) -> list[float]:
    """Relative jump of f - f_full over each change of level between neighbouring speeds."""
    return [
        abs((b["f"] / b["full"]) / (a["f"] / a["full"]) - 1)
        for a, b in zip(rows, rows[1:])
        if a["scene"] == b["scene"] and a["level"] != b["level"]
    ]
