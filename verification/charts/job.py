"""The chart of the whole job: error of the friction coefficient against time per point of a Stribeck curve."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from lubfric import load_scene, stribeck

from ..check import Check
from .data import Quartiles, interleaved, point

SPEEDS = np.geomspace(1e-4, 1.0, 9)
TIGHT = 1e-3
DEFAULT = 0.01


def points(level: str) -> Iterator[Check]:
    """Tolerances and closures on one grid, then grids at one tolerance."""
    quick = level == "quick"
    n = 48 if quick else 200
    speeds = SPEEDS[::4] if quick else SPEEDS
    variants = {"default (load-controlled)": {}, "paper's closure (separation)": {"closure": "separation"}}
    exact = coefficients(scene(n, tolerance=TIGHT / 3 if not quick else TIGHT), speeds)
    for name, numerics in variants.items():
        tolerances = (0.1, 0.01) if quick else (0.1, 0.03, 0.01, 0.005, 0.002)
        calls = {
            t: lambda t=t, numerics=numerics: coefficients(scene(n, tolerance=t, **numerics), speeds)
            for t in tolerances
        }
        for t, (f, seconds) in interleaved(calls, 1 if quick else 3).items():
            default = not numerics and t == DEFAULT
            yield per_speed(
                "whole job, tolerance", name, f"tolerance {t:g}", (f, exact), seconds, size=n * n, default=default
            )
    yield from grids(quick, speeds)


def scene(n: int, **numerics):
    """The paper's scene on n x n cells of a 90 um patch, with one surface sampled on every grid."""
    finest = 400
    base = load_scene("paper").with_(numerics=numerics)
    from lubfric import Surface, generate_surface

    full = generate_surface(
        (finest, finest), 90e-6 / finest, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=1
    )
    step = finest // n
    del Surface
    return base.with_(contact={"shape": (n, n), "spacing": 90e-6 / n}), np.ascontiguousarray(
        full.heights[::step, ::step][:n, :n]
    )


def coefficients(pair, speeds) -> np.ndarray:
    """Friction coefficients of one scene on its height map."""
    from lubfric import Surface
    from lubfric.sharing import prepare

    made, heights = pair
    model = prepare(made, Surface(heights, made.contact.spacing))
    return stribeck(model, speeds, raise_on_failure=False).coefficient


def per_speed(panel: str, method: str, setting: str, found: tuple, seconds: Quartiles, **at) -> Check:
    """The largest relative deviation over the speeds of ``found`` = (f, exact f), and the seconds for each speed,
    preparation included."""
    f, exact = found
    off = float(np.nanmax(np.abs(f / exact - 1)))
    return point(panel, method, setting, off, tuple(s / f.size for s in seconds), **at)


def _on_grid(n: int, speeds) -> np.ndarray:
    return coefficients(scene(n, tolerance=0.005), speeds)


def grids(quick: bool, speeds) -> Iterator[Check]:
    """One surface on coarser contact grids against the finest."""
    sizes = (40, 50, 100) if quick else (40, 50, 80, 100, 200, 400)
    solved = {n: interleaved({"": partial(_on_grid, n, speeds)}, 1)[""] for n in sizes}
    for n in sizes[:-1]:
        f, seconds = solved[n]
        at = {"apart": True, "size": n * n, "default": n == 200}
        yield per_speed("whole job, contact grid", "default", f"{n}²", (f, solved[sizes[-1]][0]), seconds, **at)
