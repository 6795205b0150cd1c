"""Fourier transforms of patches: waves, even symbols, and the deflection under a loaded strip of a patch.

A strip is some neighbouring rows of a free axis x beside a periodic y. There a wave k along y decays like exp(-k x).
So for all but the longest waves, a padded length far below twice the patch is enough for no image to reach the patch.
Waves of similar reach are transformed together.
"""

from __future__ import annotations

import numpy as np
from scipy import fft

PADDED = 131072  # waves of a block of padded columns
NEGLIGIBLE = {np.dtype(np.float32): 1e-8, np.dtype(np.float64): 1e-16}  # of the coefficient under the cell itself
WORTH = 2e4  # values that a transform of their own is worth
ROUND = 8  # rows: strips of nearly the same width share their transforms


def wavenumber(shape, spacing) -> np.ndarray:
    """|k| [rad/m] at the non-negative frequencies (nx//2 + 1, ny//2 + 1)."""
    kx, ky = (2 * np.pi * fft.rfftfreq(n, d) for n, d in zip(shape, spacing))
    return np.hypot(kx[:, None], ky)


def even_transform(coefficients: np.ndarray, length: int, axis: int = 0) -> np.ndarray:
    """Real spectrum, non-negative frequencies, of coefficients mirrored about zero in a period of ``length``."""
    c = np.moveaxis(coefficients, axis, 0)
    even = np.zeros((length, *c.shape[1:]))
    even[: len(c)] = c
    even[length - len(c) + 1 :] = c[:0:-1]
    return np.ascontiguousarray(np.moveaxis(fft.rfft(even, axis=0).real, 0, axis))


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


class Strip:
    """The deflection of ``rows`` of a patch of ``ny`` columns under pressure on ``count`` neighbouring rows, at most
    ``farthest`` rows apart, in the precision ``dtype``.

    ``kernel`` [m/Pa]: lags along the free axis, waves along the periodic one. Each of the ``groups`` has the columns of
    the spectrum, the number of rows that its waves reach at most, the number of rows to transform, and the symbol.
    """

    def __init__(self, kernel, ny: int, count: int, rows: int, farthest: int, dtype, workers=None):
        self.shape, self.rows, self.workers, self.groups = (count, ny), rows, workers, []
        reaches, begin = _reaches(kernel, NEGLIGIBLE[np.dtype(dtype)], farthest), 0
        sides = 1 if rows == count else 2
        while begin < reaches.size:
            reach = int(reaches[begin])
            short = np.flatnonzero(reaches[begin:] <= reach // 2)
            few = not short.size or min(short[0], reaches.size - begin - short[0]) * count < WORTH
            end = reaches.size if few else begin + int(short[0])
            length = fft.next_fast_len(min(count + sides * reach, 2 * farthest + 1))
            lags = min(reach, farthest, (length - 1) // 2) + 1
            symbol = even_transform(kernel[:lags, begin:end], length).astype(dtype)
            self.groups.append((slice(begin, end), reach, length, symbol))
            begin = end

    def apply(self, pressure: np.ndarray, first: int = 0) -> np.ndarray:
        """Deflection [m] (rows, ny) under ``pressure`` [Pa] on the rows from ``first`` on."""
        count, ny = self.shape
        spectrum = fft.rfft(pressure, axis=1, workers=self.workers)
        total = np.zeros((self.rows, spectrum.shape[1]), spectrum.dtype)
        for columns, reach, length, symbol in self.groups:
            part = _multiplied(spectrum[:, columns], symbol, length, self.workers)
            before, after = min(first, reach), min(self.rows, first + count + reach) - first
            total[first : first + after, columns] = part[:after]
            if before:
                total[first - before : first, columns] = part[-before:]
        return fft.irfft(total, n=ny, axis=1, workers=self.workers, overwrite_x=True)


def _reaches(kernel, negligible: float, farthest: int) -> np.ndarray:
    """Number of rows beyond which a wave and all shorter ones do not deflect; it never rises from wave to wave."""
    felt = np.abs(kernel[: farthest + 1]) > negligible * np.abs(kernel[0])
    last = felt.shape[0] - 1 - np.argmax(felt[::-1], axis=0)
    return np.maximum.accumulate(last[::-1])[::-1]


def rounded(count: int, most: int) -> int:
    """``count`` rows rounded up."""
    return min(ROUND * -(-count // ROUND), most)
