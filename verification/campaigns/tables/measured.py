"""What each table says. Each function returns `Cells`, and `TABLES` names the functions."""

import time
from collections.abc import Callable, Sequence

import numpy as np

import lubfric
from lubfric.oil import FLOW_LAWS, LIMIT_LAWS
from lubfric.quantities import KEYS

from ...fem.parts import case_of_scene
from ...types import Keywords

Cells = tuple[Sequence[str], Sequence[Sequence[str]]]  # titles of the columns, rows of text


def stribeck() -> Cells:
    """The built-in scene at seven speeds."""
    curve = lubfric.stribeck(lubfric.load_scene("paper"), [1e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 1.0])
    rows = [
        [f"{u:g}", f"{f:.4f}", f"{contact:.3f}", f"{film:.3f}", f"{1e9 * gap:.0f}"]
        for u, f, contact, film, gap in zip(
            curve.speed, curve.coefficient, curve.contact_load, curve.film_load, curve.mean_gap
        )
    ]
    return ["U (m/s)", "f", "F_C (N)", "F_H (N)", "mean gap (nm)"], rows


def roughness() -> Cells:
    """f of the built-in scene on other surfaces."""
    surfaces: dict[str, Keywords] = {
        "built-in scene": {},
        "Sq 200 nm": {"sq": 200e-9},
        "Sq 50 nm": {"sq": 50e-9},
        "correlation length 16 µm": {"correlation_length": 16e-6},
        "correlation length 4 µm": {"correlation_length": 4e-6},
        "lay along the motion, 16 x 4 µm": {"correlation_length": (16e-6, 4e-6)},
        "lay across the motion, 4 x 16 µm": {"correlation_length": (4e-6, 16e-6)},
    }
    scene = lubfric.load_scene("paper")
    speeds = (0.003, 0.03, 0.1)
    rows = [
        [name, *(f"{f:.3f}" for f in lubfric.stribeck(scene.with_(surface=keys), speeds).coefficient)]
        for name, keys in surfaces.items()
    ]
    return ["roughness", *(f"f at {speed:g} m/s" for speed in speeds)], rows


def times() -> Cells:
    """CPU seconds of usual jobs, the smallest of three where these take less than a second."""
    paper = lubfric.load_scene("paper")
    shared = paper.with_(numerics={"model": "paper"})
    speeds = np.geomspace(1e-4, 1.0, 20)
    jobs: dict[str, Callable[[], object]] = {
        "one film": lambda: lubfric.solve_ehl(**case_of_scene(paper, paper.bodies.load, 0.01)),
        "the paper's scene, one speed": lambda: lubfric.friction(paper, 0.01),
        "one speed by Eq. (8)": lambda: lubfric.friction(shared, 0.01),
        "20 speeds by Eq. (8)": lambda: lubfric.stribeck(shared, speeds),
    }
    return ["job", "CPU time"], [[name, f"{_seconds(job):.3g} s"] for name, job in jobs.items()]


def _seconds(job: Callable[[], object]) -> float:
    values: list[float] = []
    while len(values) < 3 and sum(values) < 1:
        begun = time.process_time()
        job()
        values.append(time.process_time() - begun)
    return min(values)


def shear_laws() -> Cells:
    """The keys of the shear laws."""
    keys = [key for law in (*FLOW_LAWS, *LIMIT_LAWS) for key in (law.key, *law.others)]
    rows = [(key, KEYS[f"lubricant.{key}"]) for key in keys]
    return ["key, unit", "meaning"], [
        [f"`{key}`, {quantity.unit}".removesuffix(", -"), quantity.note] for key, quantity in rows
    ]


TABLES: dict[str, Callable[[], Cells]]
TABLES = {"stribeck": stribeck, "roughness": roughness, "times": times, "shear-laws": shear_laws}
