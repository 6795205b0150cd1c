"""Pressure to deflection by FFT, each axis periodic or free.

Along a free axis x with a periodic y a wave k along y decays like exp(-k x). So for all but the longest waves, a
padded length far below twice the rows is enough for no image to reach them. Blocks of waves, of similar reach, are
transformed one after the other.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace
from functools import cached_property, partial, wraps
from typing import Any

import numpy as np
from scipy import fft

from .._base import FieldsOnly, FloatArray, FrozenArrays, validate
from ..errors import InputError
from .kernels import line_coefficients, love_coefficients, semiperiodic_coefficients

# What an axis may be.
AXIS_KINDS = ("periodic", "free")
# Waves of a block of padded columns, which stays in the cache. A choice, for speed alone.
PADDED = 32768
# Coefficient of a distant cell over that of the cell itself [-] that is left out, by precision. Chosen for the rounding
# error of each.
NEGLIGIBLE_COEFFICIENT = {np.dtype(np.float32): 1e-8, np.dtype(np.float64): 1e-16}


def _once(method: Callable[..., Any]) -> Callable[..., Any]:
    """Keep what a method of an operator makes, by its arguments: it depends on nothing else."""

    @wraps(method)
    def kept(self: Any, *arguments: int | tuple[int, int]) -> Any:
        made = self.__dict__.setdefault("_made", {})
        key = (method.__name__, *arguments)
        if key not in made:
            made[key] = method(self, *arguments)
        return made[key]

    return kept


@dataclass(frozen=True, kw_only=True)
class HalfSpace(FrozenArrays, FieldsOnly):
    """Linear map from cell pressures [Pa] to deflections [m] of the cell centres, made by `half_space`.

    Attributes
    ----------
    shape, spacing : (nx, ny) cells; (dx, dy) [m]
    e_prime : E' [Pa]
    boundary : "periodic" or "free" for each axis
    padded : (mx, my), the size of the transform
    symbol : the eigenvalues [m/Pa], real and even along both axes, so that only the non-negative frequencies
        (mx//2 + 1, my//2 + 1) are kept
    workers : threads per transform (None: one)
    layer : compliance [m/Pa] of a layer on the half-space, each cell of which yields to its own pressure alone
    """

    shape: tuple[int, int]
    spacing: tuple[float, float]
    e_prime: float
    boundary: tuple[str, str]
    padded: tuple[int, int]
    symbol: np.ndarray
    workers: int | None = None
    layer: float = 0.0

    @property
    def identity(self) -> tuple[Hashable, ...]:
        """Return all that the deflection depends on: equal only for operators that give the same one. Those of
        coarsened grids have another zero level than one that was made for their cells, and so another first
        eigenvalue."""
        first = float(self.symbol[0, 0])
        precision = self.symbol.dtype.str
        return self.shape, self.spacing, self.e_prime, self.boundary, self.padded, self.layer, precision, first

    def with_layer(self, compliance: float) -> HalfSpace:
        """Return the operator with a layer that sinks by ``compliance`` [m/Pa] times the pressure at each cell."""
        more = validate.nonnegative("compliance", compliance, "m/Pa")
        return replace(self, symbol=self.symbol + self.symbol.dtype.type(more), layer=self.layer + more)

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        """Return the deflection [m] (nx, ny) under ``pressure`` [Pa] (nx, ny), in the precision of ``symbol``.

        Raises `InputError` for another shape.
        """
        if np.shape(pressure) != self.shape:
            raise InputError(f"pressure has shape {np.shape(pressure)}; allowed: {self.shape} as the operator")
        return filtered(np.asarray(pressure, dtype=self.symbol.dtype), self.symbol, self.padded, self.workers)

    @_once
    def window(self, count: int) -> Callable[[np.ndarray], np.ndarray]:
        """Return the operator on fields (count, ny) of neighbouring rows of a free axis x with a periodic y: an exact
        part of this one, with the same zero level. Made once for every count."""
        kernel = self._kernel[:count]
        dtype = self.symbol.dtype
        ny = self.shape[1]
        workers = self.workers
        blocks = []
        reaches = _reaches(kernel, NEGLIGIBLE_COEFFICIENT[dtype])
        begin = 0
        while begin < reaches.size:
            reach = int(reaches[begin])
            length = fft.next_fast_len(min(count + reach, 2 * count - 1))
            columns = slice(begin, begin + max(1, PADDED // length))
            lags = min(reach, count - 1, (length - 1) // 2) + 1
            blocks.append((columns, length, even_transform(kernel[:lags, columns], length).astype(dtype)))
            begin = columns.stop

        def apply(pressure: np.ndarray) -> np.ndarray:
            spectrum = fft.rfft(pressure, axis=1, workers=workers)
            for columns, length, symbol in blocks:
                spectrum[:, columns] = _multiplied(spectrum[:, columns], symbol, length, workers)[:count]
            return fft.irfft(spectrum, n=ny, axis=1, workers=workers, overwrite_x=True)

        return apply

    @cached_property
    def self_deflection(self) -> float:
        """Deflection [m/Pa] of a cell in the middle of the first axis by its own pressure."""
        unit = np.zeros(self.shape)
        middle = self.shape[0] // 2
        unit[middle, 0] = 1.0
        return float(self.apply(unit)[middle, 0])

    @cached_property
    def _kernel(self) -> np.ndarray:
        """Coefficients along the free axis x of every wave along y [m/Pa], lags (nx) first."""
        return fft.irfft(self.symbol, n=self.padded[0], axis=0)[: self.shape[0]]

    @cached_property
    def single(self) -> HalfSpace:
        """Return the same operator in single precision, made once: its transforms cost about half."""
        fast = replace(self, symbol=self.symbol.astype(np.float32))
        if self.boundary == ("free", "periodic"):
            fast.__dict__["_kernel"] = self._kernel
        return fast

    @_once
    def coarsened(self, factors: tuple[int, int]) -> HalfSpace:
        """Return the operator on cells ``factors`` (fx, fy) times as long, in the same gauge, made once.

        From the low frequencies: exact if periodic, and close to it if free. With one free axis the kernel is made
        anew, because its waves end. ``padded`` must be even multiples of the factors.
        """
        fx, fy = factors
        shape = (self.shape[0] // fx, self.shape[1] // fy)
        padded = (self.padded[0] // fx, self.padded[1] // fy)
        spacing = (self.spacing[0] * fx, self.spacing[1] * fy)
        if self.boundary == ("free", "periodic"):
            kernel = semiperiodic_coefficients(shape, spacing, self.e_prime)
            own_coefficient = line_coefficients(1, self.spacing[0], self.e_prime, shape[0] * spacing[0])[0]
            kernel[:, 0] += (self._kernel[0, 0] - self.layer - own_coefficient) * fx  # gauge
            symbol = even_transform(kernel, padded[0]) + self.layer
        else:
            symbol = np.ascontiguousarray(self.symbol[: padded[0] // 2 + 1, : padded[1] // 2 + 1])
        return replace(self, shape=shape, padded=padded, spacing=spacing, symbol=symbol)


def half_space(
    shape: tuple[int, int],
    spacing: float | tuple[float, float],
    e_prime: float | None,
    boundary: str | tuple[str, str] = ("periodic", "periodic"),
    workers: int | None = None,
) -> HalfSpace:
    """Return the deflection operator of a grid of ``shape`` (nx, ny) cells of ``spacing`` [m] (one number or (dx, dy)).

    e_prime [Pa]: ``2/E' = sum (1 - nu^2)/E``. Each axis of ``boundary`` is "periodic" or "free":

    - periodic both: ``û = 4 p̂/(E' |k|)``, mean of u zero;
    - one free: Fourier along the periodic axis, cell integrals of K0 along the free one; u under a
      line load is zero at the distance of the box length along the free axis;
    - free both: Love's coefficients of uniform cells, u zero far away (S. Liu, Q. Wang, G. Liu, Wear
      243 (2000) 101-111, doi:10.1016/S0043-1648(00)00427-0).

    Free axes are padded with zeros: no images. Positive definite (semi-definite when periodic in
    both, the mean being lost), and reciprocal (Maxwell-Betti: q·Kp = p·Kq). Raises `InputError`.
    """
    shape = validate.pair("shape", shape, partial(validate.integer, minimum=1), "a whole number")
    spacing = validate.spacing("spacing", spacing)
    e_prime = validate.positive("e_prime", e_prime, "Pa")
    boundary = validate.pair("boundary", boundary, partial(validate.choice, options=AXIS_KINDS), "'periodic' or 'free'")
    if workers is not None:
        workers = validate.integer("workers", workers, minimum=1)
    padded = (_padded_length(shape[0], boundary[0]), _padded_length(shape[1], boundary[1]))
    symbol = _symbol(shape, spacing, e_prime, boundary, padded)
    return HalfSpace(
        shape=shape, spacing=spacing, e_prime=e_prime, boundary=boundary, padded=padded, symbol=symbol, workers=workers
    )


def _padded_length(n: int, kind: str) -> int:
    """Return the number of points of a padded axis: ``n`` if it is periodic, else at least 2 n - 1, a multiple of 4 (so
    that grids can be halved) with small prime factors."""
    return n if kind == "periodic" else 4 * fft.next_fast_len(-(-(2 * n - 1) // 4), real=True)


def _symbol(
    shape: tuple[int, int],
    spacing: tuple[float, float],
    e_prime: float,
    boundary: tuple[str, str],
    padded: tuple[int, int],
) -> np.ndarray:
    """Return the factors from the transform of a pressure on a grid to that of its deflection [m/Pa], by the
    ``boundary`` along each axis."""
    if boundary == ("periodic", "periodic"):
        k = wavenumber(shape, spacing)
        k[0, 0] = np.inf
        return 4 / (e_prime * k)
    if boundary == ("free", "periodic"):
        return even_transform(semiperiodic_coefficients(shape, spacing, e_prime), padded[0])
    if boundary == ("periodic", "free"):
        flipped = semiperiodic_coefficients(shape[::-1], spacing[::-1], e_prime)
        return np.ascontiguousarray(even_transform(flipped, padded[1]).T)
    partial = even_transform(love_coefficients(shape, spacing, e_prime), padded[0])
    return even_transform(partial, padded[1], axis=1)


def wavenumber(shape: tuple[int, ...], spacing: tuple[float, ...]) -> np.ndarray:
    """Return |k| [rad/m] at the non-negative frequencies (nx//2 + 1, ny//2 + 1)."""
    kx, ky = (2 * np.pi * fft.rfftfreq(n, d) for n, d in zip(shape, spacing))
    return np.hypot(kx[:, None], ky)


def even_transform(coefficients: np.ndarray, length: int, axis: int = 0) -> np.ndarray:
    """Return the real spectrum, non-negative frequencies, of coefficients mirrored about zero in a period of
    ``length``."""
    c = np.moveaxis(coefficients, axis, 0)
    even = np.zeros((length, *c.shape[1:]))
    even[: len(c)] = c
    even[length - len(c) + 1 :] = c[:0:-1]
    return np.ascontiguousarray(np.moveaxis(fft.rfft(even, axis=0).real, 0, axis))


def filtered(field: np.ndarray, symbol: np.ndarray, padded: tuple[int, ...], workers: int | None) -> np.ndarray:
    """Return ``field`` padded with zeros, multiplied by an even ``symbol`` in Fourier space, and cut back.

    Where axis 0 is padded, some columns after the other are. So the padded field is never held whole, and a block of
    columns stays in the cache.
    """
    (nx, ny) = field.shape
    (mx, my) = padded
    spectrum = fft.rfft(field, n=my, axis=1, workers=workers)
    if mx == nx:
        spectrum = _multiplied(spectrum, symbol, mx, workers)
    else:
        width = max(1, PADDED // mx)
        for first in range(0, spectrum.shape[1], width):
            part = np.s_[:, first : first + width]
            spectrum[part] = _multiplied(spectrum[part], symbol[part], mx, workers)[:nx]
    spectrum = fft.irfft(spectrum, n=my, axis=1, workers=workers, overwrite_x=True)
    return spectrum if my == ny else spectrum[:, :ny].copy()  # a part would hold on to the whole


def _multiplied(columns: np.ndarray, symbol: np.ndarray, length: int, workers: int | None) -> np.ndarray:
    """Return the columns padded to ``length`` and multiplied by ``symbol`` in Fourier space; they may be written
    over."""
    waves = fft.fft(columns, n=length, axis=0, workers=workers, overwrite_x=True)
    half = length // 2 + 1
    waves[:half] *= symbol
    waves[half:] *= symbol[(length - 1) // 2 : 0 : -1]
    return fft.ifft(waves, axis=0, workers=workers, overwrite_x=True)


def _reaches(kernel: FloatArray, negligible: float) -> np.ndarray:
    """Return the number of rows beyond which a wave and all shorter ones do not deflect; it never rises from wave to
    wave."""
    notable = np.abs(kernel) > negligible * np.abs(kernel[0])
    last = notable.shape[0] - 1 - np.argmax(notable[::-1], axis=0)
    return np.maximum.accumulate(last[::-1])[::-1]
