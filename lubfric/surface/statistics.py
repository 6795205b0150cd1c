"""Height, slope and correlation statistics of a `Surface`.

Heights are taken about their mean, of the measured points only (names and signs of ISO 25178-2).
Slopes and correlation lengths of rough surfaces depend on the spacing of the points.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .._base import FloatArray, validate
from ..errors import InputError

Surface = Any  # `lubfric.Surface`, which is built of these functions

INVERSE_E = math.exp(-1)  # decay level of a correlation length, by definition of it (ISO 25178-2 has 0.2)
SMOOTHEST = 1e-7  # least rms slope of an instrument's map: a choice, for less is a slip of units
SMALLEST_SQ = 1e-11  # m: of a rough map: a choice, a tenth of an atom. Superpolished mirrors have 5e-11 m
SHORTEST_SPACING = 1e-11  # m: spacing of an instrument's map: a choice, a tenth of an atom
LONGEST_SPACING = 1e-2  # m: of such a map: a choice, for more is a slip of units
IMPOSSIBLE_SLOPE = 3.0  # largest rms slope of a map: a choice, for more is a slip of units
# Heights of a Gaussian surface over its Sq. Ra: exactly. Rz: an estimate, for a profile of L correlation lengths has
# 4.3 Sq in a sampling length of L = 25, 5.3 at 80 and 5.8 at 160 (Rice's rate of its summits, Gaussian ACF). The 5 of
# Rz is a choice between these.
PER_SQ = {"ra": math.sqrt(2 / math.pi), "rz": 5.0}
# Up to this Ra [m], sampling length [m] (ISO 4288).
SAMPLING_LENGTHS = ((2e-8, 8e-5), (1e-7, 2.5e-4), (2e-6, 8e-4), (1e-5, 2.5e-3))


# Fewest points on a sampling length that show its highest and lowest point: of white noise they find 3.7 Sq of the 5 Sq
# that 100 points find. A convention.
LEAST_RZ_POINTS = 20


def sa(surface: Surface) -> float:
    """Return the arithmetic mean height Sa [m]."""
    z = surface.measured
    return float(np.abs(z - z.mean()).mean())


def rz(surface: Surface) -> tuple[float, float]:
    """Return (Rz, sampling length) [m]: the mean height from the lowest to the highest point of a sampling length,
    along the axis on which it is larger, which runs across a lay. The length is that of ISO 4288 for the map's Ra, or
    all of a shorter map. An axis with fewer than `LEAST_RZ_POINTS` points on that length is not evaluated; Rz is NaN
    where neither is."""
    wanted = next((length for most, length in SAMPLING_LENGTHS if sa(surface) <= most), 8e-3)
    measured = np.isfinite(surface.heights) if surface.mask is None else surface.mask
    mean_heights = []
    z = np.where(measured, surface.heights, np.nan)
    for axis, step in enumerate(surface.spacing):
        lines = np.moveaxis(z, axis, 0)
        points = min(len(lines), round(wanted / step))
        if points < LEAST_RZ_POINTS:
            continue
        pieces = lines[: len(lines) // points * points].reshape(-1, points, lines.shape[1])
        heights = np.fmax.reduce(pieces, axis=1) - np.fmin.reduce(pieces, axis=1)
        mean_heights.append((float(np.nanmean(heights)) if np.isfinite(heights).any() else 0.0, points * step))
    return max(mean_heights, default=(math.nan, wanted))


def ssk(surface: Surface) -> float:
    """Return the skewness [-]: negative for a plateau with valleys."""
    return _moment(surface, 3)


def sku(surface: Surface) -> float:
    """Return the kurtosis [-]: 3 for a Gaussian distribution."""
    return _moment(surface, 4)


def largest_ratio(surface: Surface) -> float:
    """Return the largest distance from the mean, max |z|/Sq [-]: 4 to 5.5 for a Gaussian map of 1e4 to 1e7 points; 0
    for a flat one."""
    z = surface.measured - surface.measured.mean()
    rms = z.std()
    return float(np.abs(z).max() / rms) if rms > 0 else 0.0


def _moment(surface: Surface, power: int) -> float:
    z = surface.measured - surface.measured.mean()
    rms = z.std()
    if rms == 0:
        raise InputError("sq of the surface = 0 m: no skewness or kurtosis; allowed: above 0 m")
    return float(np.mean((z / rms) ** power))


def rms_slope(surface: Surface) -> tuple[float, float, float]:
    """Return the (x, y, total) root mean square slopes [-], between neighbouring measured points, one cell apart."""
    slopes = []
    for axis in range(2):
        z = np.moveaxis(surface.heights, axis, 0)
        mask = np.isfinite(z) if surface.mask is None else np.moveaxis(surface.mask, axis, 0)
        steps = len(z) if surface.periodic_axes[axis] else len(z) - 1
        step = (np.roll(z, -1, 0) - z)[:steps]
        both = (np.roll(mask, -1, 0) & mask)[:steps]
        slopes.append(float(np.sqrt(np.mean(step[both] ** 2)) / surface.spacing[axis]) if both.any() else 0.0)
    return slopes[0], slopes[1], math.hypot(*slopes)


def check_slopes(surface: Surface) -> None:
    """Raise `InputError` for slopes that no surface has."""
    slope = rms_slope(surface)[2] if min(surface.shape) > 1 else 0.0
    if slope > IMPOSSIBLE_SLOPE:
        of = f"of heights with Sq {surface.sq:.3g} m on a spacing of {surface.spacing[0]:.3g} m"
        raise InputError(
            f": rms slope = {slope:.3g} {of}",
            "surface",
            f"up to {IMPOSSIBLE_SLOPE:g}",
            "check the unit of the heights and of the spacing",
        )


# What to do about lengths that no surface has.
WHERE_UNIT_IS_WRONG = (
    "check the unit; where the file names none, give it: unit = 'um', or of points unit = ('mm', 'um') for x and y, "
    "and z"
)
WHERE_GIVEN_UNIT_IS_WRONG = (
    "check the unit of the heights (of points: unit = ('mm', 'um') for x and y, and z), and the spacing, which is in "
    "m: spacing = 1e-6 is 1 µm"
)


def check_spacing(spacing: tuple[float, float], *, advice: str = WHERE_GIVEN_UNIT_IS_WRONG) -> None:
    """Raise `InputError` for a ``spacing`` [m] that no map of a rough surface has; ``advice``: what to do."""
    dx, dy = spacing
    if not all(SHORTEST_SPACING <= step <= LONGEST_SPACING for step in spacing):
        message = f" = {dx:.3g} m" if dx == dy else f" = {dx:.3g} x {dy:.3g} m"
        raise InputError(message, "spacing", f"{SHORTEST_SPACING:g} to {LONGEST_SPACING:g} m in a map", advice)


def check_scale(surface: Surface, *, advice: str = WHERE_UNIT_IS_WRONG) -> None:
    """Raise `InputError` for a map whose lengths cannot be right: a unit was taken for another. ``advice``: what to
    do."""
    check_spacing(surface.spacing, advice=advice)
    if min(surface.shape) < 3 or np.count_nonzero(np.isfinite(surface.heights)) < 9:
        return
    rough = surface.level()
    slope = rms_slope(rough)[2]
    if rough.sq == 0:
        return
    if rough.sq < SMALLEST_SQ:
        raise InputError(f": Sq = {rough.sq:.3g} m", "surface", f"from {SMALLEST_SQ:g} m in a map", advice)
    of = f"of heights with Sq {rough.sq:.3g} m on a spacing of {surface.spacing[0]:.3g} m"
    if not SMOOTHEST <= slope <= IMPOSSIBLE_SLOPE:
        allowed = f"{SMOOTHEST:g} to {IMPOSSIBLE_SLOPE:g} in a map"
        raise InputError(f": rms slope = {slope:.3g} {of}", "surface", allowed, advice)


def autocorrelation(surface: Surface, axis: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Return (lag [m], correlation [-]) along ``axis`` up to half the map, 1 at lag 0.

    Circular along a periodic axis; otherwise every pair of measured points at that lag counts once
    (unbiased by the number of pairs). By FFT.
    """
    from scipy import fft

    validate.choice("axis", axis, (0, 1))
    n = surface.shape[axis]
    mask = surface.mask
    periodic = surface.periodic_axes[axis]
    z = surface.heights - surface.measured.mean()
    length = n if periodic else fft.next_fast_len(2 * n, real=True)

    def lagged_products(f: FloatArray) -> FloatArray:
        power = np.abs(fft.rfft(f, length, axis=axis)) ** 2
        return fft.irfft(power.sum(axis=1 - axis), length)[: n // 2 + 1]

    if mask is None or mask.all():
        pairs = np.full(n // 2 + 1, n) if periodic else n - np.arange(n // 2 + 1)
    else:
        z = np.where(mask, z, 0.0)
        pairs = np.maximum(np.rint(lagged_products(mask.astype(float))), 1.0)
    products = lagged_products(z)
    if products[0] <= 0:
        raise InputError("sq of the surface = 0 m: no autocorrelation; allowed: above 0 m")
    return np.arange(n // 2 + 1) * surface.spacing[axis], products / pairs / (products[0] / pairs[0])


# What makes a correlation length of a wavy map known.
SHORTER_WAVES = "remove its form, as surface.level('quadratic'), or its long waves, as surface.filtered(l=...)"


def correlation_length(surface: Surface, axis: int = 0, decay_level: float = INVERSE_E) -> float:
    """Return the first lag [m] at which the autocorrelation along ``axis`` falls to ``decay_level``.

    decay_level: 1/e by default; 0.1 (Whitehouse and Archard; Hu and Tønder) or 0.2 (Sal, ISO 25178-2)
    are in use too. Between two lags the logarithm of the correlation is linear. Raises `InputError`
    when it stays above the level up to half the map.
    """
    return first_crossing(*autocorrelation(surface, axis), decay_level)


def first_crossing(lags: np.ndarray, acf: np.ndarray, decay_level: float) -> float:
    """Return the first lag at which ``acf`` falls to ``decay_level``."""
    level = validate.number("decay_level", decay_level, "(-)", above=0.0, maximum=0.99)
    below = np.flatnonzero(acf <= level)
    if below.size == 0:
        message = f"the autocorrelation stays above decay_level = {level:g} up to {1e6 * lags[-1]:.4g} µm"
        raise InputError(
            message, allowed="a map at least twice as long as its correlation length", recommendation=SHORTER_WAVES
        )
    i = below[0]
    high = acf[i - 1]
    low = acf[i]
    share = math.log(high / level) / math.log(high / low) if low > 0 else (high - level) / (high - low)
    return float(lags[i - 1] + share * (lags[i] - lags[i - 1]))
