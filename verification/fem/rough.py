"""Contact of a rough strip on the finite-element compliance of `harmonic`, by a primal-dual active set.

    u = C p,   g = g0 - delta + u,   0 <= p <= H,
    g = 0 where 0 < p < H,   g >= 0 where p = 0,   g <= 0 where p = H

The load is given. In each step the cells of the set are in contact, and the others are not, or have yielded. One dense
linear system gives their pressures and delta. The signs of pressures and gaps give the next set (Hintermueller, Ito &
Kunisch 2002, doi:10.1137/S1052623401383558). At the solution the set repeats itself, and the solution is then exact up
to rounding.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .harmonic import Compliance
from .report import CONVERGED, ITERATION_LIMIT, InputError, SolveReport

FIRST = 0.15  # share of the cells, those of least gap, in the first set


@dataclass(frozen=True)
class Pressed:
    """Pressure (Pa) and gap (m), both (nx, ny), the approach (m), and a report."""

    pressure: np.ndarray
    gap: np.ndarray
    approach: float
    yielded: np.ndarray
    report: SolveReport


def press(
    compliance: Compliance,
    gap0: np.ndarray,
    load_per_width: float,
    *,
    hardness: float = math.inf,
    start: Pressed | None = None,
    tolerance: float = 1e-9,
    max_iterations: int = 100,
    raise_on_failure: bool = True,
) -> Pressed:
    """Press the strip with ``load_per_width`` (N/m) against an undeformed gap (m) that is known up to a constant.

    ``start`` is an earlier result, of which the set is used. The residuals are tension and penetration (largest -p and
    -g, in largest p and in the approach span of g0) and load (relative). Raises `SolveError` when the largest is above
    ``tolerance``.
    """
    (nx, ny), (dx, _) = compliance.strip.shape, compliance.strip.spacing
    if gap0.shape != (nx, ny) or not 0 < load_per_width < hardness * nx * dx:
        raise InputError(
            f"gap0 has shape {gap0.shape}, load_per_width = {load_per_width} N/m; allowed: {(nx, ny)}, "
            f"0 to {hardness * nx * dx:g}"
        )
    total, coefficients = load_per_width * ny / dx, compliance.coefficients
    touching, yielded = first_set(gap0, start)
    history, status = [], ITERATION_LIMIT
    while True:
        pressure, approach = solve(coefficients, gap0, touching, yielded, hardness, total)
        gap = gap0 - approach + compliance.apply(pressure)
        residuals = measure(gap0, pressure, gap, yielded, hardness, total)
        history.append(max(residuals.values()))
        if history[-1] <= tolerance:
            status = CONVERGED
        if status == CONVERGED or len(history) > max_iterations:
            break
        touching, yielded = next_set(pressure, gap, touching, yielded, hardness)
    solver = "contact on finite elements, active set"
    report = SolveReport(solver, status, len(history), tolerance, residuals, tuple(history))
    result = Pressed(np.clip(pressure, 0, hardness), gap, approach, yielded, report)
    if raise_on_failure:
        report.raise_if_failed(result)
    return result


def first_set(gap0: np.ndarray, start: Pressed | None) -> tuple[np.ndarray, np.ndarray]:
    """Cells in elastic contact and cells that have yielded."""
    if start is not None:
        return (start.pressure > 0) & ~start.yielded, start.yielded
    return gap0 <= np.quantile(gap0, FIRST), np.zeros(gap0.shape, bool)


def next_set(pressure, gap, touching, yielded, hardness) -> tuple[np.ndarray, np.ndarray]:
    """The next set: cells under tension open, overlapping ones touch, those above the hardness yield, and yielded ones
    that have opened recover."""
    free = ~touching & ~yielded
    overloaded = touching & (pressure > hardness)
    recovered = yielded & (gap > 0)
    return (
        (touching & (pressure > 0) & ~overloaded) | (free & (gap < 0)) | recovered,
        (yielded & ~recovered) | overloaded,
    )


def solve(coefficients, gap0, touching, yielded, hardness, total) -> tuple[np.ndarray, float]:
    """Pressures that close the gap of the set under the load, and the approach."""
    ny = gap0.shape[1]
    i, j = np.nonzero(touching)
    matrix = np.empty((i.size + 1, i.size + 1))
    matrix[:-1, :-1] = coefficients[(j[:, None] - j) % ny, i[:, None], i]
    scale = matrix[0, 0]
    matrix[-1, :-1] = matrix[:-1, -1] = scale
    matrix[-1, -1] = 0.0
    right = np.append(-gap0[i, j], scale * (total - yielded.sum() * hardness if yielded.any() else total))
    si, sj = np.nonzero(yielded)
    if si.size:
        right[:-1] -= hardness * coefficients[(j[:, None] - sj) % ny, i[:, None], si].sum(axis=1)
    found = np.linalg.solve(matrix, right)
    pressure = np.zeros(gap0.shape)
    pressure[i, j] = found[:-1]
    if si.size:
        pressure[si, sj] = hardness
    return pressure, float(-scale * found[-1])


def measure(gap0, pressure, gap, yielded, hardness, total) -> dict[str, float]:
    """See `press`."""
    largest, span = np.abs(pressure).max(), np.ptp(gap0)
    return {
        "tension": float(max(-pressure.min(), 0) / largest),
        "overload": float(max(pressure.max() / hardness - 1, 0)),
        "penetration": float(max(-gap[~yielded].min(initial=0.0), 0) / span),
        "opening of yielded cells": float(max(gap[yielded].max(initial=0.0), 0) / span),
        "load": float(abs(pressure.sum() / total - 1)),
    }
