"""Fourier transforms of patches: waves, even symbols, and the deflection under a loaded strip of a patch.

A strip is some neighbouring rows of a free axis x beside a periodic y. There a wave k along y decays like exp(-k x).
So for all but the longest waves, a padded length far below twice the patch is enough for no image to reach the patch.
Blocks of waves, of similar reach, are transformed one after the other.
"""

from __future__ import annotations

import numpy as np
from scipy import fft

PADDED = 32768  # waves of a block of padded columns: it stays in the cache
NEGLIGIBLE = {np.dtype(np.float32): 1e-8, np.dtype(np.float64): 1e-16}  # of the coefficient under the cell itself


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
    """The deflection of neighbouring rows of a patch of ``ny`` columns under pressure on them, in the precision
    ``dtype``.

    ``kernel`` [m/Pa]: one lag for each row, waves along the periodic axis. Each of the ``blocks`` has the columns of
    the spectrum, the number of rows to transform, and the symbol.
    """

    def __init__(self, kernel, ny: int, dtype, workers=None):
        count, waves = kernel.shape
        self.shape, self.workers, self.blocks = (count, ny), workers, []
        reaches, begin = _reaches(kernel, NEGLIGIBLE[np.dtype(dtype)]), 0
        while begin < waves:
            reach = int(reaches[begin])
            length = fft.next_fast_len(min(count + reach, 2 * count - 1))
            columns = slice(begin, begin + max(1, PADDED // length))
            lags = min(reach, count - 1, (length - 1) // 2) + 1
            self.blocks.append((columns, length, even_transform(kernel[:lags, columns], length).astype(dtype)))
            begin = columns.stop

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        """Deflection [m] (count, ny) under ``pressure`` [Pa] (count, ny)."""
        count, ny = self.shape
        spectrum = fft.rfft(pressure, axis=1, workers=self.workers)
        for columns, length, symbol in self.blocks:
            spectrum[:, columns] = _multiplied(spectrum[:, columns], symbol, length, self.workers)[:count]
        return fft.irfft(spectrum, n=ny, axis=1, workers=self.workers, overwrite_x=True)


def _reaches(kernel, negligible: float) -> np.ndarray:
    """Number of rows beyond which a wave and all shorter ones do not deflect; it never rises from wave to wave."""
    felt = np.abs(kernel) > negligible * np.abs(kernel[0])
    last = felt.shape[0] - 1 - np.argmax(felt[::-1], axis=0)
    return np.maximum.accumulate(last[::-1])[::-1]
