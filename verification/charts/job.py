"""The chart of the whole job: error of the friction coefficient against time per point of a Stribeck curve."""

from functools import partial

import numpy as np

import lubfric

from .measure import interleaved, point

SPEEDS = np.geomspace(1e-4, 1.0, 9)
FINEST, DEFAULT = 400, 0.01


def cases(quick: bool) -> dict[str, bool]:
    """The whole chart is one case."""
    return {"job": quick}


def measured(quick: bool) -> list[dict]:
    """Tolerances on one grid against a tight one."""
    n, speeds = (48, SPEEDS[::4]) if quick else (200, SPEEDS)
    found = []
    exact = coefficients(n, 1e-3 if quick else 3e-4, speeds)
    tolerances = (0.1, 0.01) if quick else (0.1, 0.03, 0.01, 0.005, 0.002)
    calls = {t: partial(coefficients, n, t, speeds) for t in tolerances}
    for t, (f, seconds) in interleaved(calls, 1 if quick else 3).items():
        at = {"size": n * n, "default": t == DEFAULT}
        found.append(per_speed("whole job, tolerance", f"tolerance {t:g}", f, exact, seconds, **at))
    return found


def coefficients(n: int, tolerance: float, speeds) -> np.ndarray:
    """f of the paper's scene on n x n cells of a patch of 90 µm, with one surface sampled on every grid."""
    rough = {"sq": 100e-9, "correlation_length": 8e-6, "acf": "gaussian", "seed": 1}
    full = lubfric.generate_surface((FINEST, FINEST), 90e-6 / FINEST, **rough).heights
    heights = np.ascontiguousarray(full[:: FINEST // n, :: FINEST // n][:n, :n])
    contact = {"shape": (n, n), "spacing": 90e-6 / n}
    scene = lubfric.load_scene("paper").with_(
        numerics={"tolerance": tolerance, "model": "load-sharing"}, contact=contact
    )
    model = lubfric.prepare(scene, lubfric.Surface(heights, (90e-6 / n, 90e-6 / n)))
    return lubfric.stribeck(model, speeds, raise_on_failure=False).coefficient


def per_speed(panel: str, setting: str, f, exact, seconds, **at) -> dict:
    """The largest relative deviation over the speeds, and the seconds for each speed, preparation included."""
    off = float(np.nanmax(np.abs(f / exact - 1)))
    return point(panel, "default", setting, off, [s / f.size for s in seconds], **at)
