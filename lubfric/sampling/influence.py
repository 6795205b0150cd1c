"""The scatter of a long contact from place to place, read off one solution of it.

At a given film and approach, each place y along the line has its own mean gap G(y) of the strip, and its own line load
P(y). A place that carries more than its share leaves less load for the others, and their gap grows. So a place changes
the mean gap at the *given mean load* by its influence ``I(y) = G(y) - beta (P(y) - mean P)``, with ``beta = dG/dP`` at
a given film. Means of I over blocks longer than its correlation are nearly independent. Their scatter gives the
standard error of the mean gap.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

MOST_BLOCKS, ENOUGH_BLOCKS, LEAST_BLOCKS = 32, 8, 5
WIDE, BLOCK = 9.0, 5.0  # correlation lengths of the surface along y in a block: wanted, and at least
ENDS = 1 / math.sqrt(math.pi)  # correlation lengths of a block that are as its neighbours, for a Gaussian correlation
SPOT = 1.75  # correlation lengths along y in a block over which the participation is counted


@dataclass(frozen=True)
class BlockError:
    """Standard error of a mean over blocks, in the unit of the values, and its degrees of freedom."""

    error: float
    freedom: int


def strip_gap(contact, state) -> np.ndarray:
    """G(y) [m] (ny,): the gap at every place along the line, averaged over the strip A. ``state``: a `ContactState`
    with fields."""
    return contact.weight @ np.maximum(state.fields.gap, 0.0) / contact.weight.sum()


def line_load(contact, state) -> np.ndarray:
    """P(y) [N/m] (ny,): load per length at every place along the line."""
    return state.pressure.sum(axis=0) * contact.spacing[0]


def gap_influence(strip_gap, line_load, slope: float) -> np.ndarray:
    """I(y) [m] (ny,): strip_gap G(y) [m], line_load P(y) [N/m], slope dG/dP [m²/N] at a given film."""
    return strip_gap - slope * (line_load - line_load.mean())


def block_error(values, step: float, correlation_length: float, exact=None) -> BlockError:
    """Standard error of the mean of ``values`` (ny,), on cells of ``step`` [m], from block means.

    It is s/sqrt(n (1 - 0.56/b)) with n = 8 to 32 blocks, each at least b = 9 correlation lengths [m] long. If the line
    is too short for eight of these, 5 to 8 blocks of five lengths are taken. A remainder shorter than a block is left
    out. If the line is shorter still, the error is infinite, with no degree of freedom.

    Neighbouring blocks are alike near their common end, and so scatter less than independent ones. For values with the
    correlation exp(-(y/l)²), the variance of a mean over b l is smaller than that of an endless line by the fraction
    int |y| exp(-y²) dy / int exp(-y²) dy / b = 1/(sqrt(pi) b).

    ``exact`` (ny,): a quantity of every place whose mean over the line is known exactly. Scatter that the blocks share
    with it is no error: s is then that of the residuals of a straight line through the blocks.
    """
    count = min(MOST_BLOCKS, int(values.size * step / (WIDE * correlation_length)))
    count = max(count, min(ENOUGH_BLOCKS, int(values.size * step / (BLOCK * correlation_length))))
    count = min(count, values.size)
    if count < LEAST_BLOCKS:
        return BlockError(math.inf, 0)
    means = _means(values, count)
    freedom = count - 1
    if exact is not None:
        known = _means(exact, count)
        known -= known.mean()
        if (square := float(known @ known)) > 0:
            means, freedom = means - known * (float(known @ means) / square), count - 2
    square = float(np.sum((means - means.mean()) ** 2))
    length = values.size // count * step / correlation_length
    return BlockError(math.sqrt(square / (freedom * count * (1 - ENDS / length))), freedom)


def _means(values, count: int) -> np.ndarray:
    size = values.size // count
    return values[: size * count].reshape(count, size).mean(axis=1)


def spot_loads(line_load, step: float, correlation_length: float) -> np.ndarray:
    """Loads [N/m x cells] of short blocks, about one contact spot each."""
    size = max(1, round(SPOT * correlation_length / step))
    return line_load[: line_load.size // size * size].reshape(-1, size).sum(axis=1)


def participation(loads) -> float:
    """(sum P)²/sum P²: the number of equally loaded blocks that would carry the load as unevenly as these."""
    square = float(np.sum(np.square(loads)))
    return float(np.sum(loads)) ** 2 / square if square > 0 else 0.0


def add_errors(*parts: BlockError) -> BlockError:
    """Error of a sum of independent quantities."""
    return weighted_errors([(1.0, part) for part in parts])


def weighted_errors(parts) -> BlockError:
    """Error of a weighted sum of independent quantities, given as (weight, `BlockError`). The degrees of freedom are
    by Welch and Satterthwaite (F. E. Satterthwaite, Biometrics Bull. 2 (1946) 110-114, doi:10.2307/3002019)."""
    terms = [((weight * part.error) ** 2, part.freedom) for weight, part in parts]
    variance = sum(v for v, _ in terms)
    if variance == 0 or not math.isfinite(variance):
        return BlockError(math.sqrt(variance), sum(f for _, f in terms))
    return BlockError(math.sqrt(variance), int(variance**2 / sum(v**2 / max(f, 1) for v, f in terms)))
