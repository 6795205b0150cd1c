"""Errors of every model against one gap with one pressure, gathered over surfaces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .measure import REFERENCE, Point


@dataclass(frozen=True)
class Deviation:
    """Of one method at one load, fluid, autocorrelation and speed, over the surfaces: mean and rms of f/f_ref - 1 and
    of the contact share, mean ratio of the gaps, median seconds; the reference's share and film ratio (means); how
    many surfaces, how many failures."""

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
    return Deviation(
        *key,
        float(e.mean()),
        float(np.sqrt(np.mean(e**2))),
        float(share.mean()),
        float(np.sqrt(np.mean(share**2))),
        float(gap.mean()),
        float(np.median([p.seconds for p, _ in pairs])),
        float(np.mean([r.contact_share for _, r in good] or [np.nan])),
        float(np.mean([r.film_ratio for _, r in good] or [np.nan])),
        len(good),
        len(pairs) - len(good),
    )


def rows(found: list[Deviation]) -> tuple[tuple, ...]:
    """Of the table: load, speed, share of the spots, then mean and rms [%] of every method."""
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
