"""Where the points of a traction curve do not show f between them: beside the knee from the linear part to that of the
Eyring or the limiting stress.

Over the slide-roll ratio f is concave before heat lets it fall. Between two points it lies above the line between them,
and below the lines through the points on either side. Where the middle of both is farther from the line drawn than the
interval of f, the interval says nothing of f there.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .._base import FloatArray

# Relative half-width of the interval of f where it is not known. A convention.
UNKNOWN_HALF_WIDTH = 0.05

# Positions between two points at which the lines are compared, as shares of their distance. A choice: it costs no
# solve.
PLACES = np.linspace(0.005, 0.995, 199)

# Slide-roll ratios that are recommended between 0 and the first point, over that of the point. A convention.
FROM_ZERO = (0.01, 0.03, 0.1, 0.3)

# Slide-roll ratios that are recommended between two points. A convention.
RATIOS_BETWEEN = 2


@dataclass(frozen=True, kw_only=True)
class Gap:
    """Two neighbouring points of a traction curve between which f is not known.

    Attributes
    ----------
    low, high : their slide-roll ratios [-], without sign
    at : where the lines differ most [-]
    change : by how much f may be above the line between the points there [-]
    """

    low: float
    high: float
    at: float
    change: float

    @property
    def text(self) -> str:
        """The gap in a sentence."""
        return (
            f"between the slide-roll ratios {self.low:.4g} and {self.high:.4g} the solved points do not determine f, "
            f"which may be up to {self.change:.1g} above the line between them. Solve more ratios between them, such "
            f"as {', '.join(f'{ratio:.3g}' for ratio in self.ratios)}"
        )

    @property
    def ratios(self) -> tuple[float, ...]:
        """Slide-roll ratios between the two points that show f there [-]: in equal factors; from 0 on from the first of
        `FROM_ZERO`."""
        if self.low == 0.0:
            return tuple(part * self.high for part in FROM_ZERO)
        step = (self.high / self.low) ** (1.0 / (RATIOS_BETWEEN + 1))
        return tuple(self.low * step**place for place in range(1, RATIOS_BETWEEN + 1))


def gaps_of(ratio: Sequence[float] | FloatArray, coefficient: FloatArray, half_width: FloatArray) -> list[Gap]:
    """Return the neighbouring points between which f is not known, by ascending ratio.

    ``ratio`` (n,) in any order, of one sign or 0, else none are returned: f then changes its sign. ``coefficient``
    (n,), NaN where it is not known; ``half_width`` (n,) of its intervals, NaN where these are not known.
    """
    slip = np.abs(np.asarray(ratio, float))
    if np.min(ratio, initial=0.0) < 0.0 < np.max(ratio, initial=0.0):
        return []
    known = np.isfinite(coefficient)
    order = np.flatnonzero(known)[np.argsort(slip[known])]
    s = slip[order]
    f = np.abs(coefficient[order])
    width = np.where(np.isfinite(half_width[order]), half_width[order], UNKNOWN_HALF_WIDTH * f)
    slopes = np.diff(f) / np.where(np.diff(s) > 0, np.diff(s), np.nan)
    gaps = []
    for i in range(s.size - 1):
        places = s[i] + PLACES * (s[i + 1] - s[i])
        after = slopes[i + 1] if i + 2 < s.size else 0.0
        above = f[i + 1] - after * (s[i + 1] - places)
        if i > 0:
            above = np.minimum(above, f[i] + slopes[i - 1] * (places - s[i]))
        share = PLACES if s[i] == 0.0 else np.log(places / s[i]) / np.log(s[i + 1] / s[i])
        drawn = f[i] + share * (f[i + 1] - f[i])
        excess = 0.5 * (above - drawn) - (width[i] + share * (width[i + 1] - width[i]))
        if np.isfinite(excess).all() and excess.max() > 0.0:
            worst = int(np.argmax(excess))
            change = float(above[worst] - drawn[worst])
            gaps.append(Gap(low=float(s[i]), high=float(s[i + 1]), at=float(places[worst]), change=change))
    return gaps
