"""Pressure to deflection by FFT, each axis periodic or free."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, wraps

import numpy as np
from scipy import fft

from .._base import FieldsOnly, FrozenArrays, validate
from ..errors import InputError
from .kernels import line_coefficients, love_coefficients, semiperiodic_coefficients
from .transforms import Strip, even_transform, filtered, wavenumber

KINDS = ("periodic", "free")


def _once(method):
    """Keep what a method of an operator makes, by its arguments: it depends on nothing else."""

    @wraps(method)
    def kept(self, *arguments):
        key = (method.__name__, *arguments)
        if key not in self._made:
            self._made[key] = method(self, *arguments)
        return self._made[key]

    return kept


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
        return filtered(np.asarray(pressure, dtype=self.symbol.dtype), self.symbol, self.padded, self.workers)

    @_once
    def window(self, count: int) -> Strip:
        """The operator on ``count`` neighbouring rows of a free axis x beside a periodic y: an exact part of this one,
        with the same zero level. Made once for every count."""
        return Strip(self._kernel[:count], self.shape[1], self.symbol.dtype, self.workers)

    @cached_property
    def _kernel(self) -> np.ndarray:
        """Coefficients along the free axis x of every wave along y [m/Pa], lags (nx) first."""
        return fft.irfft(self.symbol, n=self.padded[0], axis=0)[: self.shape[0]]

    @cached_property
    def _made(self) -> dict:
        """Operators derived from this one (`_once`)."""
        return {}

    @cached_property
    def single(self) -> HalfSpace:
        """The same operator in single precision, made once: its transforms cost about half."""
        fast = replace(self, symbol=self.symbol.astype(np.float32))
        if self.boundary == ("free", "periodic"):
            fast.__dict__["_kernel"] = self._kernel
        return fast

    @_once
    def coarsened(self, factors: tuple[int, int]) -> HalfSpace:
        """The operator on cells ``factors`` (fx, fy) times as long, in the same gauge, made once.

        From the low frequencies: exact if periodic, and close to it if free. With one free axis the kernel is made
        anew, because its waves end. ``padded`` must be even multiples of the factors.
        """
        fx, fy = factors
        shape, padded = (self.shape[0] // fx, self.shape[1] // fy), (self.padded[0] // fx, self.padded[1] // fy)
        spacing = (self.spacing[0] * fx, self.spacing[1] * fy)
        if self.boundary == ("free", "periodic"):
            kernel = semiperiodic_coefficients(shape, spacing, self.e_prime)
            own = line_coefficients(1, self.spacing[0], self.e_prime, shape[0] * spacing[0])[0]
            kernel[:, 0] += (self._kernel[0, 0] - own) * fx  # gauge
            symbol = even_transform(kernel, padded[0])
        else:
            symbol = np.ascontiguousarray(self.symbol[: padded[0] // 2 + 1, : padded[1] // 2 + 1])
        return replace(self, shape=shape, padded=padded, spacing=spacing, symbol=symbol)


def half_space(shape, spacing, e_prime, boundary=("periodic", "periodic"), workers=None) -> HalfSpace:
    """Deflection operator of a grid of ``shape`` (nx, ny) cells of ``spacing`` [m] (one number or (dx, dy)).

    e_prime [Pa]: ``2/E' = sum (1 - nu^2)/E``. Each axis of ``boundary`` is "periodic" or "free":

    - periodic both: ``û = 4 p̂/(E' |k|)``, mean of u zero;
    - one free: Fourier along the periodic axis, cell integrals of K0 along the free one; u under a
      line load is zero at the distance of the box length along the free axis;
    - free both: Love's coefficients of uniform cells, u zero far away (S. Liu, Q. Wang, G. Liu, Wear
      243 (2000) 101-111, doi:10.1016/S0043-1648(00)00427-0).

    Free axes are padded with zeros: no images. Positive definite (semi-definite when periodic in
    both, the mean being lost), and reciprocal (Maxwell-Betti: q·Kp = p·Kq). Raises `InputError`.
    """
    shape = tuple(shape)
    if len(shape) != 2:
        raise InputError(f"shape = {shape} has {len(shape)} axes; allowed: (nx, ny)")
    shape = tuple(validate.integer(f"shape[{axis}]", n, minimum=1) for axis, n in enumerate(shape))
    spacing = validate.spacing("spacing", spacing)
    e_prime = validate.positive("e_prime", e_prime, "Pa")
    boundary = (boundary, boundary) if isinstance(boundary, str) else boundary
    if not isinstance(boundary, (tuple, list)) or len(boundary) != 2:
        raise InputError(f"boundary = {validate.shown(boundary)} must name two axes, each 'periodic' or 'free'")
    boundary = tuple(validate.choice(f"boundary[{axis}]", kind, KINDS) for axis, kind in enumerate(boundary))
    if workers is not None:
        workers = validate.integer("workers", workers, minimum=1)
    padded = (_padded_length(shape[0], boundary[0]), _padded_length(shape[1], boundary[1]))
    symbol = _symbol(shape, spacing, e_prime, boundary, padded)
    return HalfSpace(shape, spacing, e_prime, boundary, padded, symbol, workers)


def _padded_length(n: int, kind: str) -> int:
    """Of a free axis at least 2 n - 1, a multiple of 4 (so that grids can be halved) with small prime factors."""
    return n if kind == "periodic" else 4 * fft.next_fast_len(-(-(2 * n - 1) // 4), real=True)


def _symbol(shape, spacing, e_prime, boundary, padded) -> np.ndarray:
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
