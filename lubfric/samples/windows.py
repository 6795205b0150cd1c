"""How windows of a map are laid out, and joined to one line."""

import numpy as np

# Correlation lengths along y over which one strip passes into the next: a Gaussian correlation is 0.02 there. A choice:
# shorter steps show, longer ones smooth more. Half and twice this value change f by up to 1.6 %, its interval by up to
# 1.6 % and the work by up to 16 % (constants.csv).
BLEND = 2.0


def joined_maps(maps: list[np.ndarray], blend: int) -> np.ndarray:
    """Return ``maps`` of heights (nx, ny) joined one after the other along y, and the last to the first.

    The last ``blend`` cells of each are laid over the first of the next. Their weights are cos and sin, whose squares
    add to 1, about the mean of all.
    """
    mean = float(np.mean([heights.mean() for heights in maps]))
    angle = 0.5 * np.pi * (np.arange(blend) + 0.5) / blend
    out = []
    for before, heights in zip([maps[-1], *maps[:-1]], maps):
        part = heights[:, : heights.shape[1] - blend].copy()
        part[:, :blend] = (
            mean + np.sin(angle) * (heights[:, :blend] - mean) + np.cos(angle) * (before[:, -blend:] - mean)
        )
        out.append(part)
    return np.concatenate(out, axis=1)


def spread_order(count: int) -> list[int]:
    """Return the numbers 0 .. count - 1 in an order that begins in the middle, each number as far from those before as
    possible."""
    left = set(range(count))
    order: list[int] = []
    while left:
        middle = 0.5 * (count - 1)
        best = max(left, key=lambda i: (min((abs(i - j) for j in order), default=0), -abs(i - middle), -i))
        order.append(best)
        left.remove(best)
    return order


def starts_of(count: int, window: int, step: int, overhang: int) -> list[int]:
    """Return the first columns of windows that lie ``step`` apart on a map of ``count`` columns. ``overhang``: how many
    of them reach over either end."""
    room = count + 2 * overhang - window
    most = room // step
    return [(room - most * step) // 2 - overhang + step * k for k in range(most + 1)]


def blend_of(correlation: float, step: float) -> int:
    """Return the number of cells of ``step`` [m] over which one strip passes into the next."""
    return max(1, round(BLEND * correlation / step))


def is_mirror_image(heights: np.ndarray) -> bool:
    """Return whether the second half along y is the mirror image of the first."""
    return heights.shape[1] > 1 and bool(np.array_equal(heights, heights[:, ::-1]))
