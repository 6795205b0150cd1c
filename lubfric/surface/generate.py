"""Gaussian random surfaces with a prescribed autocorrelation, by FFT filtering of white noise."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from .._base import FloatArray, validate, with_default_errors
from ..errors import InputError
from ..units import worded
from .height_map import Surface
from .honed import Honing, honed_heights
from .regrid import pair, points
from .statistics import INVERSE_E, check_slopes, check_spacing, correlation_length, first_crossing

ACFS = ("exponential", "gaussian")
LEAST_CELLS_OF_LENGTH = 2.0  # cells in one correlation length (1/e); a choice: fewer do not show the correlation

# Largest relative deviation of the expected correlation length of a finite, zero-mean map from the requested one [-]. A
# choice: a smaller value refuses small maps.
LENGTH_TOLERANCE = 0.10

# Correlation lengths in a periodic map from which the expected length is within `LENGTH_TOLERANCE`: 10.2 and 5.1 at
# 1/e on square maps, and some more.
LENGTHS_IN_MAP = {"exponential": 11.0, "gaussian": 5.5}

LARGEST_SEED = 2**128 - 1  # as many bits as the pool of numpy.random.SeedSequence; its definition
NEGLIGIBLE_EXPONENT = 37.0  # exp(-37) is below the rounding of double precision, by definition
SPECTRUM_ROUNDING = 1e-13  # of the largest power: what the transform leaves where the spectrum is zero; chosen by it


@with_default_errors
def generate_surface(
    shape: tuple[int, int],
    spacing: float | tuple[float, float],
    *,
    correlation_length: float | tuple[float, float],
    seed: int,
    sq: float | None = None,
    acf: str = "exponential",
    decay_level: float = INVERSE_E,
    cutoff: float | None = None,
    sk: float | None = None,
    spk: float | None = None,
    svk: float | None = None,
    honing_angle: float | None = None,
    groove_width: float | None = None,
) -> Surface:
    """Return a periodic random surface: a Gaussian one, white noise filtered with the root of the power spectrum, or a
    plateau-honed one.

    Source: Y. Z. Hu, K. Tønder, Int. J. Mach. Tools Manufact. 32 (1992) 83-90, doi:10.1016/0890-6955(92)90064-N. The
    spectrum is the discrete transform of the autocorrelation summed over its periodic images. It is positive, and exact
    at the lags of the grid.

    Parameters
    ----------
    shape, spacing : (nx, ny) points; (dx, dy) or one length [m]
    sq : root mean square height [m]. The mean is removed and the heights are rescaled, so that Sq is met *exactly* in
        every realisation. Without this rescaling, the relative scatter of Sq would be about one correlation length over
        the length of the map
    correlation_length : lag [m] at which the autocorrelation falls to ``decay_level``; one, or one along x and y
    acf : with r² = (x/bx)² + (y/by)²: "exponential", exp(-r), which has no second derivative, so that slopes,
        curvatures and summits depend on the grid; or "gaussian", exp(-r²)
    decay_level : 1/e by default; 0.1 and 0.2 (ISO 25178-2 Sal) are other conventions
    seed : integer; the same input gives the same surface
    cutoff : shortest wavelength kept [m], or None for all that the grid holds
    sk, spk, svk : core height, reduced peak height, reduced dale height [m], all three instead of ``sq``: a
        plateau-honed surface (`lubfric.surface.honed`), whose plateaus have the ``correlation_length``. They are met
        within 0.2 % in every realisation
    honing_angle : angle [°] between the two directions of the grooves (None: 50), which the y axis, across the motion,
        bisects
    groove_width : correlation length across a groove at 1/e [m] (None: the longer correlation length)

    Returns
    -------
    Surface : its ``notes`` state the length that the *expected* autocorrelation of such a map has (finite size, zero
        mean, cutoff), and the length found in this realisation

    Raises
    ------
    InputError : before generating, when the expected length is more than 10 % off the requested one (a map shorter than
        about 10 lengths for "exponential", 5 for "gaussian"), or when the grid has fewer than 2 cells per length at 1/e
    """
    seed = validate.integer("seed", seed, minimum=0, maximum=LARGEST_SEED)
    of: dict[str, Any] = {
        "sq": sq,
        "correlation_length": correlation_length,
        "acf": acf,
        "decay_level": decay_level,
        "cutoff": cutoff,
        "sk": sk,
        "spk": spk,
        "svk": svk,
        "honing_angle": honing_angle,
        "groove_width": groove_width,
    }
    surface = surface_generator(shape, spacing, **of)(seed)
    check_slopes(surface)
    first, *lengths = surface.notes
    length_notes = (f"{note}, found {_found_length(surface, axis, decay_level)}" for axis, note in enumerate(lengths))
    return replace(surface, notes=(first, *length_notes))


def surface_generator(
    shape: tuple[int, int],
    spacing: float | tuple[float, float],
    *,
    correlation_length: float | tuple[float, float],
    acf: str,
    decay_level: float,
    sq: float | None = None,
    cutoff: float | None = None,
    sk: float | None = None,
    spk: float | None = None,
    svk: float | None = None,
    honing_angle: float | None = None,
    groove_width: float | None = None,
) -> Callable[[int], Surface]:
    """Return the function that makes the `generate_surface` of a seed, without the correlation lengths found in it.
    What all seeds share is made once."""
    from scipy import fft

    shape = pair("shape", shape)
    spacing = validate.spacing("spacing", spacing)
    points("shape", shape)
    check_spacing(spacing)
    lengths = validate.spacing("correlation_length", correlation_length)
    honing = honing_of(sk, spk, svk, honing_angle, groove_width, lengths)
    if honing is None or sq == 0:
        sq = validate.nonnegative("sq", sq, "m", maximum=1.0)
        honing = None
    validate.choice("acf", acf, ACFS)
    level = validate.number("decay_level", decay_level, "(-)", above=0.0, maximum=0.99)
    decay = -math.log(level) if acf == "exponential" else math.sqrt(-math.log(level))
    scales = lengths[0] / decay, lengths[1] / decay  # where the ACF is 1/e
    for axis, n, d, scale in zip("xy", shape, spacing, scales):
        name = f"correlation_length along {axis}"
        message = f" is {worded(scale, 'm')} at 1/e"
        if scale < LEAST_CELLS_OF_LENGTH * d:
            raise InputError(
                f"{message}, {scale / d:.3g} cells",
                name,
                f"at least {LEAST_CELLS_OF_LENGTH:g} cells of {worded(d, 'm')}",
            )
        if n * d < 4 * scale:
            raise InputError(
                f"{message}, the map {worded(n * d, 'm')}",
                name,
                "at most a quarter of it",
                _longer_map(axis, n * d, LENGTHS_IN_MAP[acf] * scale),
            )
    spectrum = _spectrum(shape, spacing, scales, acf, cutoff)
    expected = _expected_lengths(spectrum, shape, spacing, lengths, level, LENGTHS_IN_MAP[acf])
    amplitude = np.sqrt(spectrum)
    source = f"generated, {acf} ACF"
    stated = [
        f"correlation length along {name} at level {level:.4g}: "
        f"requested {worded(length, 'm')}, expected {worded(float(there), 'm')}"
        for name, length, there in zip("xy", lengths, expected)
    ]

    if honing is not None:
        return _honed_generator(honing, shape, spacing, amplitude)

    def made(seed: int) -> Surface:
        heights = fft.irfft2(fft.rfft2(np.random.default_rng(seed).standard_normal(shape)) * amplitude, shape)
        heights = heights / heights.std() * sq
        note = f"Hu-Tønder, {acf} ACF; a map of seed {seed}, scaled to Sq {worded(sq, 'm')}"
        notes = (note, *stated) if sq else (note,)
        return Surface(heights, spacing, periodic_axes=(True, True), source=source, seed=seed, notes=notes)

    return made


def honing_of(
    sk: float | None,
    spk: float | None,
    svk: float | None,
    angle: float | None,
    groove_width: float | None,
    lengths: tuple[float, float],
) -> Honing | None:
    """Return the honing of these parameters, None where no Sk, Spk, Svk is given. Raise `InputError` where some are."""
    given = {name: value for name, value in (("sk", sk), ("spk", spk), ("svk", svk)) if value is not None}
    if not given:
        extra = {"honing_angle": angle, "groove_width": groove_width}
        for name, value in extra.items():
            if value is not None:
                raise InputError(
                    f" = {value!r} is of a plateau-honed surface", name, recommendation="give sk, spk and svk"
                )
        return None
    if len(given) < 3:
        raise InputError(
            " alone make no plateau-honed surface", " and ".join(given), recommendation="give sk, spk and svk"
        )
    return Honing(
        **given,
        angle=Honing.angle if angle is None else angle,
        groove_width=max(lengths) if groove_width is None else groove_width,
    )


def _honed_generator(
    honing: Honing, shape: tuple[int, int], spacing: tuple[float, float], amplitude: np.ndarray
) -> Callable[[int], Surface]:
    """Return the function that makes the plateau-honed surface of a seed; ``amplitude``: of the plateaus' spectrum."""
    from scipy import fft

    heights_of = honed_heights(honing, shape, spacing)
    height = "Sk {}, Spk {}, Svk {}".format(*(worded(value, "m") for value in (honing.sk, honing.spk, honing.svk)))
    note = f"plateau-honed by two processes, {height}, honing angle {honing.angle:g}°"

    def made(seed: int) -> Surface:
        random = np.random.default_rng(seed)
        plateau = fft.irfft2(fft.rfft2(random.standard_normal(shape)) * amplitude, shape)
        return Surface(
            heights_of(plateau, random),
            spacing,
            periodic_axes=(True, True),
            source="generated, plateau-honed",
            seed=seed,
            notes=(f"{note}, seed {seed}",),
        )

    return made


def _spectrum(
    shape: tuple[int, int], spacing: tuple[float, float], scales: tuple[float, float], acf: str, cutoff: float | None
) -> np.ndarray:
    """Return the power spectrum (nx, ny//2 + 1) of the periodic, zero-mean ACF on the grid."""
    from scipy import fft

    power = 1.0 if acf == "exponential" else 2.0
    reach = NEGLIGIBLE_EXPONENT ** (1 / power)
    square = []
    for n, d, scale in zip(shape, spacing, scales):
        lag = np.arange(n // 2 + 1) * d
        images = math.ceil(reach * scale / (n * d))
        square.append([((lag + m * n * d) / scale) ** 2 for m in range(-images, images + 1)])
    images_of_acf = (np.exp(-((a[:, None] + b[None, :]) ** (power / 2))) for a in square[0] for b in square[1])
    quarter = np.asarray(sum(images_of_acf))
    rows, columns = (np.minimum(np.arange(n), n - np.arange(n)) for n in shape)
    spectrum = fft.rfft2(quarter[rows][:, columns]).real
    if spectrum.min() < -SPECTRUM_ROUNDING * spectrum.max():
        raise InputError(f"acf = {acf!r} has no positive spectrum on this grid; give other lengths or another spacing")
    spectrum[spectrum < SPECTRUM_ROUNDING * spectrum.max()] = 0.0
    spectrum[0, 0] = 0.0
    if cutoff is not None:
        longest = 0.5 * min(n * d for n, d in zip(shape, spacing))
        cutoff = validate.number("cutoff", cutoff, "m", minimum=2 * max(spacing), maximum=longest)
        kx = fft.fftfreq(shape[0], spacing[0])
        ky = fft.rfftfreq(shape[1], spacing[1])
        spectrum[np.hypot(kx[:, None], ky[None, :]) > 1 / cutoff] = 0.0
    return spectrum


def _expected_lengths(
    spectrum: FloatArray,
    shape: tuple[int, int],
    spacing: tuple[float, float],
    lengths: tuple[float, float],
    level: float,
    lengths_in_map: float,
) -> list[float]:
    """Return the correlation lengths [m] that maps of this ``spectrum`` have on average. Raises `InputError` where they
    are not near the requested ``lengths``, which those with ``lengths_in_map`` are."""
    from scipy import fft

    acf = fft.irfft2(spectrum, shape)
    expected = []
    for axis, line in enumerate((acf[:, 0], acf[0, :])):
        half = shape[axis] // 2 + 1
        length = first_crossing(np.arange(half) * spacing[axis], line[:half] / acf[0, 0], level)
        if abs(length / lengths[axis] - 1) > LENGTH_TOLERANCE:
            size = " x ".join(worded(n * d, "m") for n, d in zip(shape, spacing))
            message = (
                f" = {worded(lengths[axis], 'm')} is not possible: a periodic map of {size} with this cutoff has "
                f"{worded(float(length), 'm')}"
            )
            name = "xy"[axis]
            needed = lengths_in_map * lengths[axis]
            raise InputError(
                message,
                f"correlation_length along {name}",
                f"within {LENGTH_TOLERANCE:.0%}",
                _longer_map(name, shape[axis] * spacing[axis], needed),
            )
        expected.append(length)
    return expected


def _longer_map(axis: str, length: float, needed: float) -> str:
    """Return as text how a map of this ``length`` [m] along an ``axis`` becomes as long as ``needed`` [m]."""
    times = max(math.ceil(needed / length), 2)
    return (
        f"make the map at least {worded(needed, 'm')} long along {axis} (contact.shape times contact.spacing in a "
        f"scene), or set surface.oversize = {times}, which uses the middle of a longer map"
    )


def _found_length(surface: Surface, axis: int, level: float) -> str:
    try:
        return worded(correlation_length(surface, axis, level), "m")
    except InputError:
        return "longer than half the map"
