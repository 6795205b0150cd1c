"""Errors of every model against one gap with one pressure, gathered over surfaces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .measure import METHODS, REFERENCE, Point

FASTEST = 'Eq. (8) over "hertz"'


@dataclass(frozen=True)
class Deviation:
    """The deviation of one method at one load, fluid, autocorrelation and speed, over the surfaces.

    It has mean and rms of f/f_ref - 1 and of the contact share, the mean ratio of the gaps, and the median of the
    seconds; the reference's mean share and film ratio, and the method's own; the mean error of the model that it
    tells; the numbers of surfaces and of failures.
    """

    load: float
    fluid: str
    acf: str
    speed: float
    method: str
    mean: float
    rms: float
    share_mean: float
    share_rms: float
    gap: float
    seconds: float
    share: float
    film_ratio: float
    own_film_ratio: float
    told: float
    surfaces: int
    failures: int


def deviations(found: list[Point]) -> list[Deviation]:
    """One entry for each method, load, fluid, autocorrelation and speed."""
    reference = {(p.setting, p.speed): p for p in found if p.method == REFERENCE}
    groups: dict[tuple, list[tuple[Point, Point]]] = {}
    for p in found:
        s = p.setting
        groups.setdefault((s.load, s.fluid, s.acf, p.speed, p.method), []).append((p, reference[s, p.speed]))
    return [_deviation(key, pairs) for key, pairs in groups.items()]


def _deviation(key, pairs) -> Deviation:
    good = [(p, r) for p, r in pairs if np.isfinite(p.coefficient) and np.isfinite(r.coefficient)]
    e = np.array([p.coefficient / r.coefficient - 1 for p, r in good] or [np.nan])
    share = np.array([p.contact_share - r.contact_share for p, r in good] or [np.nan])
    gap = np.array([p.mean_gap / r.mean_gap for p, r in good] or [np.nan])
    load, fluid, acf, speed, method = key
    return Deviation(
        load,
        fluid,
        acf,
        speed,
        method,
        float(e.mean()),
        float(np.sqrt(np.mean(e**2))),
        float(share.mean()),
        float(np.sqrt(np.mean(share**2))),
        float(gap.mean()),
        float(np.median([p.seconds for p, _ in pairs])),
        float(np.mean([r.contact_share for _, r in good] or [np.nan])),
        float(np.mean([r.film_ratio for _, r in good] or [np.nan])),
        float(np.mean([p.film_ratio for p, _ in good] or [np.nan])),
        float(np.mean([p.told for p, _ in good] or [np.nan])),
        len(good),
        len(pairs) - len(good),
    )


def rows(found: list[Deviation]) -> tuple[tuple, ...]:
    """Rows of the table: load, speed and share of the spots, then mean and rms [%] of every method."""
    return tuple(
        (
            f"{d.load:g}",
            d.fluid,
            d.acf,
            f"{d.speed:g}",
            f"{d.share:.3f}",
            f"{d.film_ratio:.2f}",
            d.method,
            f"{100 * d.mean:+.1f}",
            f"{100 * d.rms:.1f}",
            f"{d.share_mean:+.3f}",
            f"{d.gap:.2f}",
            f"{d.seconds:.2g}",
            d.failures,
        )
        for d in found
    )


def table(found: list[Deviation]) -> tuple[list[str], list[list[str]]]:
    """Columns and rows of docs/model-error.md: a row for each load, autocorrelation and speed, with mean / rms [%] of f
    by every method."""
    methods = [m for m in METHODS if m != REFERENCE and any(d.method == m for d in found)]
    rows = []
    for key in dict.fromkeys((d.load, d.acf, d.speed) for d in found):
        here = {d.method: d for d in found if (d.load, d.acf, d.speed) == key}
        reference = here[REFERENCE]
        name = f"{key[0]:g}" + ("" if key[1] == "gaussian" else f", {key[1]}")
        cells = [name, f"{key[2]:g}", f"{reference.share:.2f}", str(reference.surfaces)]
        cells += [f"{100 * here[m].mean:+.1f} / {100 * here[m].rms:.1f}" if m in here else "" for m in methods]
        rows.append(cells)
    return ["load (N)", "U (m/s)", "share of spots", "surfaces", *methods], rows


def cost(found: list[Point]) -> tuple[list[str], list[list[str]]]:
    """Columns and rows of docs/model-error.md: the mean processor time of a point by every model, over that of Eq. (8),
    and points that were not solved."""
    by_method: dict[str, list[Point]] = {p.method: [] for p in found}
    for p in found:
        by_method[p.method].append(p)
    base = np.mean([p.seconds for p in by_method[FASTEST]])
    rows = []
    for method, points in by_method.items():
        mean, failed = float(np.mean([p.seconds for p in points])), sum(not np.isfinite(p.coefficient) for p in points)
        rows.append([method, str(len(points)), f"{1e3 * mean:.0f} ms", f"{mean / base:.1f}", str(failed)])
    return ["model", "points", "mean processor time", f"over {FASTEST}", "not solved"], rows
