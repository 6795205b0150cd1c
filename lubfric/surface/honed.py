"""Plateau-honed surfaces, made by two processes: grooves of a coarse stone that cross, and a fine stone that cuts their
tops to plateaus.

The height at a point is the lower of both processes, as in a plateau that was honed in two steps. The model is
attributed to M. C. Malburg, J. Raja, D. J. Whitehouse, CIRP Annals 42 (1993) 637-639; their text was not available
here. Then core, peaks and dales are scaled each by a factor of its own, so that Sk, Spk and Svk are met in every map.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from .._base import validate
from ..errors import InputError
from .bearing import bearing

# Values of a usual cylinder liner after plateau honing, not of one measured part: each is a choice, which Sk, Spk and
# Svk given by the user correct. The sizes are limits by choice: smaller maps and larger cells miss them.
GROOVES = 0.2  # share of the area on which grooves are below the plateau: Smr2 near 80 %, as cylinder liners have it
DEEPER = 5.0  # standard deviation of the grooves over that of the plateau, before both are scaled
GROOVE_LENGTH_RATIO = 15.0  # correlation length along a groove over that across it
SHORTEST_MAP = 4.0  # correlation lengths across a groove that the map has at least along each axis
LEAST_CELLS_OF_GROOVE = 2.0  # cells in a correlation length across a groove
SCALING_ROUNDS = 8  # rounds of scaling, each of which starts from the parameters of the last
PARAMETER_ERROR = 2e-3  # relative error of Sk, Spk and Svk
SAMPLES = 200_000  # heights from which the Sq of such a surface is found: within 0.5 %


@dataclass(frozen=True, kw_only=True)
class Honing:
    """What a plateau-honed surface has in addition to the correlation length of its plateaus.

    Attributes
    ----------
    sk, spk, svk : core height, reduced peak height and reduced dale height [m] (`lubfric.surface.bearing`)
    angle : between the two directions of the grooves [°], halved by the y axis, across the motion
    groove_width : correlation length across a groove [m], at 1/e
    """

    sk: float
    spk: float
    svk: float
    angle: float = 50.0
    groove_width: float = 20e-6

    def __post_init__(self) -> None:
        for name in ("sk", "spk", "svk"):
            object.__setattr__(self, name, validate.positive(name, getattr(self, name), "m", maximum=1e-3))
        object.__setattr__(self, "angle", validate.number("honing_angle", self.angle, "°", minimum=0.0, maximum=180.0))
        width = validate.positive("groove_width", self.groove_width, "m", maximum=1.0)
        object.__setattr__(self, "groove_width", width)


def honed_heights(
    honing: Honing, shape: tuple[int, int], spacing: tuple[float, float]
) -> Callable[[np.ndarray, np.random.Generator], np.ndarray]:
    """Return the function that makes heights [m] (nx, ny), periodic, of a plateau (nx, ny) of any scale and a
    generator.

    Raises `InputError` for grooves that the cells do not resolve, or a map too short for them.
    """
    for axis, n, step in zip("xy", shape, spacing):
        message = f" = {honing.groove_width:g} m"
        if honing.groove_width < LEAST_CELLS_OF_GROOVE * step:
            raise InputError(
                message, "groove_width", f"at least {LEAST_CELLS_OF_GROOVE:g} cells of {step:g} m along {axis}"
            )
        if n * step < SHORTEST_MAP * honing.groove_width:
            allowed = f"at most {1 / SHORTEST_MAP:g} of the map, {n * step:g} m along {axis}"
            raise InputError(message, "groove_width", allowed)
    longest = min(GROOVE_LENGTH_RATIO * honing.groove_width, 0.5 * min(n * step for n, step in zip(shape, spacing)))
    half = np.radians(0.5 * honing.angle)
    filters = [_oriented(shape, spacing, sign * half, longest, honing.groove_width) for sign in (-1.0, 1.0)]

    def made(plateau: np.ndarray, random: np.random.Generator) -> np.ndarray:
        from scipy import fft

        noises = [fft.rfft2(random.standard_normal(shape)) for _ in filters]
        families = [fft.irfft2(noise * weight, shape) for noise, weight in zip(noises, filters)]
        return _stratified(honing, plateau / plateau.std(), [family / family.std() for family in families])

    return made


def _oriented(
    shape: tuple[int, int], spacing: tuple[float, float], turn: float, along: float, across: float
) -> np.ndarray:
    """Return the amplitudes (nx, ny//2 + 1) of a field with a Gaussian autocorrelation, long in the direction at
    ``turn`` [rad] from the y axis."""
    from scipy import fft

    kx = 2 * np.pi * fft.fftfreq(shape[0], spacing[0])[:, None]
    ky = 2 * np.pi * fft.rfftfreq(shape[1], spacing[1])[None, :]
    with_groove = kx * np.sin(turn) + ky * np.cos(turn)
    over_groove = kx * np.cos(turn) - ky * np.sin(turn)
    amplitude = np.exp(-((with_groove * along) ** 2 + (over_groove * across) ** 2) / 8)
    amplitude[0, 0] = 0.0
    return amplitude


def _stratified(honing: Honing, plateau: np.ndarray, families: list[np.ndarray]) -> np.ndarray:
    """Return heights [m] with the Sk, Spk and Svk of ``honing``, from fields of standard deviation 1."""
    grooves = DEEPER * np.minimum.reduce(families)
    level = np.quantile(plateau - grooves, 1.0 - GROOVES)
    heights = np.minimum(plateau, grooves + level) * honing.sk
    for _ in range(SCALING_ROUNDS):
        curve = bearing(heights)
        reached = np.array([curve.sk / honing.sk, curve.spk / honing.spk, curve.svk / honing.svk])
        if np.abs(reached - 1).max() < PARAMETER_ERROR:
            return heights
        if not (reached > 0).all():
            break
        core = np.clip(heights, curve.lower, curve.upper)
        peaks = np.maximum(heights - curve.upper, 0.0) / reached[1]
        dales = np.minimum(heights - curve.lower, 0.0) / reached[2]
        heights = core / reached[0] + peaks + dales
        heights = heights - heights.mean()
    raise InputError(
        f" = {honing.sk:g}, {honing.spk:g} and {honing.svk:g} m cannot be reached together on this map, which has "
        f"{curve.sk:.3g}, {curve.spk:.3g} and {curve.svk:.3g} m",
        "sk, spk and svk",
        recommendation="give a larger map, or a Spk and a Svk nearer to Sk",
    )


@lru_cache(maxsize=64)
def honed_sq(sk: float, spk: float, svk: float) -> float:
    """Return the root mean square height [m] of a plateau-honed surface with these Sk, Spk and Svk [m], within 0.5
    %."""
    random = np.random.default_rng(0)
    plateau, *families = random.standard_normal((3, SAMPLES))
    return float(_stratified(Honing(sk=sk, spk=spk, svk=svk), plateau, families).std())
