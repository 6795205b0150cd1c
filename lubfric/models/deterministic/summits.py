"""The attenuated summits of moving roughness: the control variate of the deterministic model where roughness moves.

The boundary friction of a place of the contact at a moment depends on the summits that pass it then. The contact
flattens long waves (C. J. Hooke, Proc. IMechE J 220 (2006) 901-913, doi:10.1243/13506501JET146), so only what is left
of them counts here: a wave of wavenumber k keeps k²/(k² + κ²) of its height, with κ = 2π/b. The control is the mean
excess of these heights over one Sq of theirs, over the Hertz strip with the weight of its pressure. It takes no solve.
Its mean on the infinite surface is that over many strips.

Between four strips of a needle roller (lambda ratio 0.5) f scatters by 3.9 %, and by 0.4 % with this control
(docs/design-notes.md has others).
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...surface import Surface
from .moving import RoughBody, travelling
from .problem import Problem

# Wavelength that keeps half of its height, in half-widths of the Hertz strip [-]. A choice: longer waves are flattened,
# shorter ones pass under pressure (docs/design-notes.md has other controls).
HALVED_WAVE = 1.0

# Height above which summits count, in Sq of the attenuated heights [-]. A choice (docs/design-notes.md has other
# controls).
THRESHOLD = 1.0

# Strips below which its mean on the endless surface is not known well enough to be a control. A choice: its mean has
# 1/sqrt(8) of their scatter.
FEWEST_STRIPS = 8


@dataclass(frozen=True, kw_only=True)
class SummitControl:
    """The mean excess of attenuated heights over a ``threshold`` [m], on the infinite surface.

    ``wave`` [m]: wavelength that keeps half of its height. ``mean`` [m]: of the excess; ``scatter`` [m]: standard
    deviation of its mean over a strip; ``count``: number of strips that it was averaged over.
    """

    wave: float
    threshold: float
    mean: float
    scatter: float
    count: int

    @property
    def is_known(self) -> bool:
        """Whether there are strips enough to know the mean."""
        return self.count >= FEWEST_STRIPS and self.threshold > 0

    @property
    def error(self) -> float:
        """The standard error [m] of ``mean``."""
        return self.scatter / math.sqrt(self.count)


def control_of(maps: Sequence[Surface], half_width: float) -> SummitControl:
    """Return the control of a surface of which ``maps`` are strips, in a Hertz strip of this ``half_width`` [m]."""
    wave = HALVED_WAVE * half_width
    strips = [attenuated(surface, wave).heights for surface in maps]
    threshold = THRESHOLD * math.sqrt(float(np.mean([heights.var() for heights in strips])))
    means = [float(np.maximum(heights - threshold, 0.0).mean()) for heights in strips]
    return SummitControl(
        wave=wave,
        threshold=threshold,
        mean=float(np.mean(means)),
        scatter=float(np.std(means, ddof=1)) if len(means) > 1 else math.inf,
        count=len(means),
    )


def attenuated(surface: Surface, wave: float) -> Surface:
    """Return ``surface`` about its mean with its waves attenuated: one of the wavelength ``wave`` [m] keeps half of its
    height.

    Along an axis on which it is not periodic, it is continued by its mirror image.
    """
    heights = surface.heights - surface.heights.mean()
    (nx, ny) = heights.shape
    for axis in (0, 1):
        if not surface.periodic_axes[axis]:
            heights = np.concatenate([heights, np.flip(heights, axis)], axis)
    (dx, dy) = surface.spacing
    along = np.fft.fftfreq(heights.shape[0], dx)[:, None]
    across = np.fft.rfftfreq(heights.shape[1], dy)[None, :]
    square = (along**2 + across**2) * wave**2
    kept = np.fft.irfft2(np.fft.rfft2(heights) * square / (square + 1.0), heights.shape)
    return replace(surface, heights=kept[:nx, :ny], mask=None)


def summits_over_time(
    problem: Problem, bodies: Sequence[RoughBody], control: SummitControl
) -> Callable[[float], np.ndarray]:
    """Return the function of a time [s] that gives the control [m] at each place along y of ``problem`` (ny,) then,
    while ``bodies`` move."""
    half_width = max(problem.line.half_width, 0.5001 * problem.spacing[0])
    inside = np.abs(problem.x) < half_width
    pressure = np.sqrt(1.0 - (problem.x[inside] / half_width) ** 2)
    weights = (pressure / pressure.sum())[:, None]
    parts = [body._replace(surface=attenuated(body.surface, control.wave)) for body in bodies]
    heights_at = travelling(problem, parts)

    def at(time: float) -> np.ndarray:
        return (weights * np.maximum(heights_at(time).heights[inside] - control.threshold, 0.0)).sum(axis=0)

    return at
