"""The friction of an endless line, by plain balances of long patches, with none of the library's own corrections.

The patches are 1,900 correlation lengths long, each with a balance of its own. At this length its bias is below 0.1 %.
Their cells are a quarter of the correlation length. What these cells change is found on shorter patches, on the scene's
own cells and on every so-manieth of them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

import lubfric
from lubfric.sharing import lines_of

LINES, FEWEST = 160, 16  # patches, at most and at least: few tell no error of their mean
LENGTHS = 1900  # of a patch, in correlation lengths along y
PIECES, PIECE = 8, 90  # patches on the scene's own cells, and their length
CLOSE = 0.1  # of the standard error asked: of the truth


@dataclass(frozen=True)
class Truth:
    """f of an endless line, its relative standard error, what the cells changed, and the length [m] that was solved."""

    f: float
    error: float
    cells: float
    length: float


def truth(scene, speed: float, seed: int, asked: float) -> Truth:
    """The mean of patches with seeds from ``seed`` on, until it is known to a fifth of ``asked``, or of thirty-two
    patches."""
    cells, along = lines_of(scene).cells, lines_of(scene).lengths[1]
    columns = 64 * round(LENGTHS * along / cells.coarse[1] / 64)
    change, own = _cells(scene, speed, seed + 500, cells, along)
    found: list[float] = []
    while len(found) < FEWEST or (len(found) < LINES and _error(found) > CLOSE * asked):
        surface = _surface(scene, (cells.count, columns), cells.coarse, seed + len(found))
        found.append(_friction(scene, surface, speed))
    length = len(found) * columns * cells.coarse[1]
    return Truth(float(np.mean(found)) * (1 + change), math.hypot(_error(found), own), change, length)


def _error(values) -> float:
    return float(np.std(values, ddof=1) / np.mean(values) / math.sqrt(len(values)))


def _cells(scene, speed: float, seed: int, cells, along: float) -> tuple[float, float]:
    """Relative change of f from the cells of the long patches to the scene's own, and its standard error."""
    fx, fy = cells.factors
    if (fx, fy) == (1, 1):
        return 0.0, 0.0
    changes = []
    for k in range(PIECES):
        rows = 16 * fy * round(PIECE * along / cells.coarse[1] / 16)
        fine = _surface(scene, (cells.count * fx, rows), cells.spacing, seed + k)
        kept = replace(fine, heights=fine.heights[fx // 2 :: fx, fy // 2 :: fy], spacing=cells.coarse)
        changes.append(_friction(scene, fine, speed) / _friction(scene, kept, speed) - 1)
    return float(np.mean(changes)), float(np.std(changes, ddof=1)) / math.sqrt(PIECES)


def _surface(scene, shape, spacing, seed: int):
    rough = scene.surface
    return lubfric.generate_surface(
        shape, spacing, sq=rough.sq, correlation_length=rough.correlation_length, acf=rough.acf, seed=seed
    )


def _friction(scene, surface, speed: float) -> float:
    patch = scene.with_(
        contact={"shape": surface.shape, "spacing": surface.spacing},
        numerics={"sampling": "patch", "grid": "given", "tolerance": 2e-3},
    )
    return lubfric.friction(lubfric.prepare(patch, surface), speed).coefficient
