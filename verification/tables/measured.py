"""What each table measures. Each function returns `Cells`, and `TABLES` names the functions."""

import time
from collections.abc import Callable, Sequence

import numpy as np
from scipy import fft

import lubfric
from lubfric.contact import half_space

from ..parts import case_of_scene

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
    surfaces: dict[str, dict] = {
        "as it is": {},
        "Sq 200 nm": {"sq": 200e-9},
        "Sq 50 nm": {"sq": 50e-9},
        "16 µm": {"correlation_length": 16e-6},
        "4 µm": {"correlation_length": 4e-6},
        "lay along the motion, 16 x 4 µm": {"correlation_length": (16e-6, 4e-6)},
        "lay across the motion, 4 x 16 µm": {"correlation_length": (4e-6, 16e-6)},
    }
    scene, speeds = lubfric.load_scene("paper"), (0.003, 0.03, 0.1)
    rows = [
        [name, *(f"{f:.3f}" for f in lubfric.stribeck(scene.with_(surface=keys), speeds).coefficient)]
        for name, keys in surfaces.items()
    ]
    return ["instead", *(f"f at {speed:g} m/s" for speed in speeds)], rows


def times() -> Cells:
    """CPU seconds of usual jobs, the smallest of three."""
    paper = lubfric.load_scene("paper")
    speeds = np.geomspace(1e-4, 1.0, 20)
    one_patch = paper.with_(numerics={"sampling": "patch"})
    jobs: dict[str, Callable[[], object]] = {
        "one film": lambda: lubfric.solve_ehl(**case_of_scene(paper, paper.bodies.load, 0.01)),
        "the paper's scene, one speed": lambda: lubfric.friction(paper, 0.01),
        "the paper's scene, 20 speeds": lambda: lubfric.stribeck(paper, speeds),
        "the same on the paper's one patch": lambda: lubfric.stribeck(one_patch, speeds),
    }
    return ["job", "CPU time"], [[name, f"{_seconds(job):.3g} s"] for name, job in jobs.items()]


def contact_transforms() -> Cells:
    """What a rough contact of 816 x 816 cells costs, in bare pairs of single-precision transforms; CPU seconds."""
    keys = {"sq": 240e-9, "correlation_length": 34e-6, "acf": "exponential", "seed": 1}
    heights = lubfric.generate_surface((816, 816), 2e-6, **keys).heights
    operator = half_space(heights.shape, 2e-6, 231e9)
    field = heights.astype(np.float32)
    rows = []
    for pressure in (50e6, 200e6, 1e9):

        def solve(pressure=pressure) -> lubfric.ContactResult:
            options = {"mean_pressure": pressure, "tolerance": 1e-5, "operator": operator}
            return lubfric.solve_contact(heights.max() - heights, 2e-6, 231e9, **options)

        used, whole = solve().report.evaluations, _seconds(solve)
        pairs = used * _seconds(lambda: [fft.irfft2(fft.rfft2(field), s=field.shape) for _ in range(10)]) / 10
        times = [f"{whole:.2f} s", f"{used:.0f}", f"{pairs:.2f} s", f"{whole / pairs:.1f}"]
        rows.append([f"{pressure / 1e6:g} MPa", *times])
    return ["mean pressure", "whole solve", "convolutions", "that many bare float32 pairs", "multiple"], rows


def _seconds(job: Callable[[], object]) -> float:
    found = []
    for _ in range(3):
        begun = time.process_time()
        job()
        found.append(time.process_time() - begun)
    return min(found)


TABLES: dict[str, Callable[[], Cells]] = {
    "stribeck": stribeck,
    "roughness": roughness,
    "times": times,
    "contact-transforms": contact_transforms,
}
