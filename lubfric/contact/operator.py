"""Pressure to deflection by FFT, each axis periodic or free."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy import fft

from .._base import FieldsOnly, FrozenArrays, validate
from ..errors import InputError
from .kernels import line_coefficients, love_coefficients, semiperiodic_coefficients
from .strip_kernel import Strip, rounded, strip

KINDS = ("periodic", "free")
NARROW = 0.7  # of the rows: loaded ones that are worth transforms of their own
PADDED = 131072  # waves of a block of padded columns


@dataclass(frozen=True)
class HalfSpace(FrozenArrays, FieldsOnly):
    """Linear map from cell pressures [Pa] to deflections [m] of the cell centres, made by `half_space`.

    ``symbol`` [m/Pa]: the eigenvalues, real and even along both axes, so only the non-negative
    frequencies (mx//2 + 1, my//2 + 1) of the transform of size ``padded`` = (mx, my) are kept.
    ``workers``: threads per transform (None: one).
    """

    shape: tuple[int, int]
    spacing: tuple[float, float]
    e_prime: float
    boundary: tuple[str, str]
    padded: tuple[int, int]
    symbol: np.ndarray
    workers: int | None = None

    def __post_init__(self):
        self.freeze()

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        """Deflection [m] (nx, ny) under ``pressure`` [Pa] (nx, ny), in the precision of ``symbol``.

        Raises `InputError` for another shape.
        """
        if np.shape(pressure) != self.shape:
            raise InputError(f"pressure has shape {np.shape(pressure)}; allowed: {self.shape} as the operator")
        pressure = np.asarray(pressure, dtype=self.symbol.dtype)
        if self.boundary == ("free", "periodic"):
            rows = np.flatnonzero(pressure.any(axis=1))
            if rows.size and rows[-1] - rows[0] < NARROW * self.shape[0]:
                return self._under_strip(pressure, int(rows[0]), int(rows[-1]) + 1)
        return filtered(pressure, self.symbol, self.padded, self.workers)

    def _under_strip(self, pressure, first: int, last: int) -> np.ndarray:
        """`apply` if only some rows are loaded."""
        nx = self.shape[0]
        count = rounded(last - first, nx)
        first = min(first, nx - count)
        farthest = rounded(max(nx - first, first + count), nx) - 1
        return self._strip(count, nx, farthest).apply(pressure[first : first + count], first)

    def window(self, count: int) -> Strip:
        """The operator on ``count`` neighbouring rows of a free axis x beside a periodic y: an exact part of this one,
        with the same zero level. Made once for every count."""
        return self._strip(count, count, count - 1)

    def _strip(self, count: int, rows: int, farthest: int) -> Strip:
        key = (count, rows, farthest)
        if key not in self._made:
            made = strip(self._kernel, self.shape[1], count, rows, farthest, self.symbol.dtype, self.workers)
            self._made[key] = made
        return self._made[key]

    @cached_property
    def _kernel(self) -> np.ndarray:
        """Coefficients along the free axis x of every wave along y [m/Pa], (nx, ny//2 + 1)."""
        return fft.irfft(self.symbol, n=self.padded[0], axis=0)[: self.shape[0]]

    @cached_property
    def _made(self) -> dict:
        """Operators derived from this one, each made once: they depend on nothing else."""
        return {}

    def astype(self, dtype) -> HalfSpace:
        """The same operator that transforms in ``dtype`` (float32 costs about half of float64)."""
        return replace(self, symbol=self.symbol.astype(dtype))

    @cached_property
    def single(self) -> HalfSpace:
        """The same operator in single precision, made once."""
        fast = self.astype(np.float32)
        if self.boundary == ("free", "periodic"):
            fast.__dict__["_kernel"] = self._kernel
        return fast

    def coarsened(self, factors) -> HalfSpace:
        """The operator on cells ``factors`` (fx, fy) times as long, in the same gauge, made once.

        ``padded`` must be even multiples of the factors.
        """
        key = tuple(int(f) for f in factors)
        if key not in self._made:
            self._made[key] = self._coarsened(key)
        return self._made[key]

    def _coarsened(self, factors) -> HalfSpace:
        """The operator on coarser cells from the low frequencies: exact if periodic, and close to it if free. With one
        free axis the kernel is made anew, because its waves end."""
        shape = tuple(n // f for n, f in zip(self.shape, factors))
        padded = tuple(m // f for m, f in zip(self.padded, factors))
        spacing = tuple(d * f for d, f in zip(self.spacing, factors))
        if self.boundary == ("free", "periodic"):
            kernel = semiperiodic_coefficients(shape, spacing, self.e_prime)
            own = line_coefficients(1, self.spacing[0], self.e_prime, shape[0] * spacing[0])[0]
            kernel[:, 0] += (self._kernel[0, 0] - own) * factors[0]  # gauge
            symbol = _even_transform(kernel, padded[0], axis=0)
        else:
            symbol = np.ascontiguousarray(self.symbol[: padded[0] // 2 + 1, : padded[1] // 2 + 1])
        return replace(self, shape=shape, padded=padded, spacing=spacing, symbol=symbol)

    def shortened(self, count: int) -> HalfSpace:
        """The same cells on the first ``count`` of a free axis x, made once.

        An exact part of this operator, in the same gauge.
        Raises `InputError` unless x is free and ``count`` at most as long as it is.
        """
        if self.boundary[0] != "free" or not 1 <= count <= self.shape[0]:
            raise InputError(
                f"count = {count} cells of a {self.boundary[0]} axis of {self.shape[0]}; allowed: 1 to "
                "all cells of a free axis"
            )
        key = ("shortened", int(count))
        if key not in self._made:
            self._made[key] = self._shortened(int(count))
        return self._made[key]

    def _shortened(self, count: int) -> HalfSpace:
        coefficients = fft.irfft(self.symbol, n=self.padded[0], axis=0)[:count]
        length = _padded_length(count)
        return replace(
            self,
            shape=(count, self.shape[1]),
            padded=(length, self.padded[1]),
            symbol=_even_transform(coefficients, length, axis=0),
        )


def filtered(field: np.ndarray, symbol: np.ndarray, padded: tuple[int, int], workers) -> np.ndarray:
    """``field`` padded with zeros, multiplied by an even ``symbol`` in Fourier space, and cut back.

    Where axis 0 is padded, some columns after the other are. So the padded field is never held whole, and a block of
    columns stays in the cache.
    """
    (nx, ny), (mx, my) = field.shape, padded
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


def _multiplied(columns: np.ndarray, symbol: np.ndarray, length: int, workers) -> np.ndarray:
    """Columns padded to ``length`` and multiplied by ``symbol`` in Fourier space; they may be written over."""
    waves, half = fft.fft(columns, n=length, axis=0, workers=workers, overwrite_x=True), length // 2 + 1
    waves[:half] *= symbol
    waves[half:] *= symbol[(length - 1) // 2 : 0 : -1]
    return fft.ifft(waves, axis=0, workers=workers, overwrite_x=True)


def half_space(shape, spacing, e_prime, boundary=("periodic", "periodic"), workers=None) -> HalfSpace:
    """Deflection operator of a grid of ``shape`` (nx, ny) cells of ``spacing`` [m] (one number or (dx, dy)).

    e_prime [Pa]: ``2/E' = sum (1 - nu^2)/E``. Each axis of ``boundary`` is "periodic" or "free":

    - periodic both: ``û = 4 p̂/(E' |k|)``, mean of u zero;
    - one free: Fourier along the periodic axis, cell integrals of K0 along the free one; u under a
      line load is zero at the distance of the box length along the free axis;
    - free both: Love's coefficients of uniform cells, u zero far away (S. Liu, Q. Wang, G. Liu, Wear
      243 (2000) 101-111, doi:10.1016/S0043-1648(00)00427-0).

    Free axes are padded with zeros: no images. Positive definite (semi-definite when periodic in
    both, the mean being lost), and reciprocal: see `reciprocity_error`. Raises `InputError`.
    """
    shape = _grid_shape(shape)
    spacing = validate.spacing("spacing", spacing)
    e_prime = validate.positive("e_prime", e_prime, "Pa")
    boundary = (boundary, boundary) if isinstance(boundary, str) else boundary
    if not isinstance(boundary, (tuple, list)) or len(boundary) != 2:
        raise InputError(f"boundary = {validate.shown(boundary)} must name two axes, each 'periodic' or 'free'")
    boundary = tuple(boundary)
    for axis, kind in enumerate(boundary):
        validate.choice(f"boundary[{axis}]", kind, KINDS)
    if workers is not None:
        workers = validate.integer("workers", workers, minimum=1)
    nx, ny = (n if kind == "periodic" else _padded_length(n) for n, kind in zip(shape, boundary))
    padded = nx, ny
    symbol = _symbol(shape, spacing, e_prime, boundary, padded)
    return HalfSpace(shape, spacing, e_prime, boundary, padded, symbol, workers)


def _padded_length(n: int) -> int:
    """At least 2 n - 1, a multiple of 4 (so that grids can be halved) with small prime factors."""
    return 4 * fft.next_fast_len(-(-(2 * n - 1) // 4), real=True)


def _grid_shape(shape) -> tuple[int, int]:
    pair = tuple(shape)
    if len(pair) != 2:
        raise InputError(f"shape = {pair} has {len(pair)} axes; allowed: (nx, ny)")
    nx, ny = (
        validate.integer(f"shape[{axis}]", int(n) if isinstance(n, np.integer) else n, minimum=1)
        for axis, n in enumerate(pair)
    )
    return nx, ny


def _symbol(shape, spacing, e_prime, boundary, padded) -> np.ndarray:
    if boundary == ("periodic", "periodic"):
        return periodic_symbol(shape, spacing, e_prime)
    if boundary == ("free", "periodic"):
        return _even_transform(semiperiodic_coefficients(shape, spacing, e_prime), padded[0], axis=0)
    if boundary == ("periodic", "free"):
        flipped = semiperiodic_coefficients(shape[::-1], spacing[::-1], e_prime)
        return np.ascontiguousarray(_even_transform(flipped, padded[1], axis=0).T)
    partial = _even_transform(love_coefficients(shape, spacing, e_prime), padded[0], axis=0)
    return _even_transform(partial, padded[1], axis=1)


def wavenumber(shape, spacing) -> np.ndarray:
    """|k| [rad/m] at the non-negative frequencies (nx//2 + 1, ny//2 + 1)."""
    kx = 2 * np.pi * fft.rfftfreq(shape[0], spacing[0])
    ky = 2 * np.pi * fft.rfftfreq(shape[1], spacing[1])
    return np.hypot(kx[:, None], ky)


def periodic_symbol(shape, spacing, e_prime) -> np.ndarray:
    """4/(E' |k|), and zero at k = 0."""
    k = wavenumber(shape, spacing)
    k[0, 0] = np.inf
    return 4 / (e_prime * k)


def _even_transform(coefficients: np.ndarray, length: int, axis: int) -> np.ndarray:
    """Real spectrum, non-negative frequencies, of coefficients mirrored about zero in a period of ``length``."""
    c = np.moveaxis(coefficients, axis, 0)
    even = np.zeros((length, *c.shape[1:]))
    even[: len(c)] = c
    even[length - len(c) + 1 :] = c[:0:-1]
    return np.ascontiguousarray(np.moveaxis(fft.rfft(even, axis=0).real, 0, axis))
