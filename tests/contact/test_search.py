"""Parts of the contact search: the stencil for |k|, gathered cells and what they leave out, exact steps, memory."""

import tracemalloc

import numpy as np
import pytest

from lubfric import solve_contact
from lubfric.contact import half_space

E_PRIME, DX = 231e9, 2e-6
PERIODIC = ("periodic", "periodic")
BOUNDARIES = [PERIODIC, ("free", "periodic"), ("free", "free")]


def gap_of(n, filtered, seed):
    """Gap [m] above its lowest point, periodic, with the given spectrum of the frequency k [1/cell]."""
    k = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n))
    k[0, 0] = np.inf
    z = np.fft.irfft2(filtered(k) * np.fft.rfft2(np.random.default_rng(seed).standard_normal((n, n))), s=(n, n))
    return 240e-9 * (z - z.min()) / z.std()


def rough(n, seed=0):
    """Self-affine."""
    return gap_of(n, lambda k: np.maximum(k, 8 / n) ** -1.5, seed)


@pytest.mark.parametrize("hardness", [None, 4e9])
@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_memory_is_at_most_twelve_fields(boundary, hardness):
    """Peak of a solve beyond what the caller holds, in fields of double precision, from few contacts to full ones."""
    gap0 = 0.1 * rough(256, seed=5)
    operator = half_space(gap0.shape, DX, E_PRIME, boundary)
    options = dict(operator=operator, boundary=boundary, hardness=hardness)
    solve_contact(gap0, DX, E_PRIME, mean_pressure=1e6, **options)  # what is made once
    for share, pressure in ((0.05, 2e7), (0.75, 5e8), (0.99, 1.7e9)):
        tracemalloc.start()
        result = solve_contact(gap0, DX, E_PRIME, mean_pressure=pressure, **options)
        peak = tracemalloc.get_traced_memory()[1] / gap0.nbytes
        tracemalloc.stop()
        assert result.contact_area_fraction == pytest.approx(share, rel=0.3)
        assert peak <= 12
