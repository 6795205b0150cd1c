"""Long waves taken off the nine points: |k| itself, symmetric, and fewer convolutions on smooth surfaces."""

import numpy as np
import pytest

from lubfric import solve_contact
from lubfric.contact import long_waves
from lubfric.contact.stencil import Stencil

E_PRIME, DX = 231e9, 2e-6
PERIODIC = ("periodic", "periodic")


def smooth(n, correlation, seed=0):
    """Gaussian gap [m] above its lowest point, periodic; ``correlation``: length in cells."""
    k = 2 * np.pi * np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n))
    noise = np.fft.rfft2(np.random.default_rng(seed).standard_normal((n, n)))
    z = np.fft.irfft2(np.exp(-((k * correlation) ** 2) / 8) * noise, s=(n, n))
    return 240e-9 * (z - z.min()) / z.std()


@pytest.mark.parametrize("waves", [(1, 0), (0, 2), (3, 2)])
@pytest.mark.parametrize("shape", [(64, 80), (128, 64)])
def test_a_long_wave_is_multiplied_by_k(shape, waves):
    """Closed form: its own part in what is found is |k| of the wave, which nine points alone exceed."""
    spacing, factor = (0.5, 0.8), 3.0
    x, y = np.arange(shape[0])[:, None] / shape[0], np.arange(shape[1]) / shape[1]
    wave = np.cos(2 * np.pi * (waves[0] * x + waves[1] * y)).astype(np.float32)
    k = 2 * np.pi * np.hypot(waves[0] / shape[0] / spacing[0], waves[1] / shape[1] / spacing[1])
    operator = Stencil(shape, spacing, PERIODIC, None, factor)
    share = {}
    for name in ("less long waves", "nine points"):
        share[name] = np.dot(wave.ravel(), operator(wave.ravel())) / np.dot(wave.ravel(), wave.ravel())
        operator.long_waves = None
    assert share["less long waves"] == pytest.approx(factor * k, rel=0.1)
    assert share["nine points"] > 1.1 * factor * k


@pytest.mark.parametrize("boundary", [PERIODIC, ("free", "periodic"), ("free", "free")])
@pytest.mark.parametrize("shape", [(64, 80), (66, 71)])
def test_it_is_symmetric_and_positive_on_some_cells_and_on_all(shape, boundary):
    rng = np.random.default_rng(2)
    size = shape[0] * shape[1]
    for cells in (None, np.flatnonzero(rng.random(size) < 0.5), np.flatnonzero(rng.random(size) < 0.05)):
        operator = Stencil(shape, (0.5, 0.8), boundary, cells, 1.0)
        a, b = rng.standard_normal((2, size if cells is None else cells.size)).astype(np.float32)
        assert np.dot(a, operator(b)) == pytest.approx(np.dot(b, operator(a)), rel=1e-3, abs=1e-3 * size**0.5)
        for values in (a, np.abs(a), np.ones_like(a)):
            assert np.dot(values, operator(values)) > -1e-4 * size
        if cells is not None:
            dense = np.zeros(size, np.float32)
            dense[cells] = a
            expected = Stencil(shape, (0.5, 0.8), boundary, None, 1.0)(dense)[cells]
            assert operator(a) == pytest.approx(expected, abs=1e-3)


@pytest.mark.parametrize("load", [2e8, 1e9])
def test_a_smooth_surface_takes_fewer_convolutions(load, monkeypatch):
    """Against nine points, or the transform in full contact, alone; the same answer."""
    gap0 = smooth(256, 17)
    found = solve_contact(gap0, DX, E_PRIME, mean_pressure=load)
    monkeypatch.setattr(long_waves, "LEAST", 10**6)
    without = solve_contact(gap0, DX, E_PRIME, mean_pressure=load)
    assert found.report.evaluations < 0.85 * without.report.evaluations
    assert found.pressure == pytest.approx(without.pressure, abs=2e-4 * found.pressure.max())


@pytest.mark.parametrize("constant, values", [("FACTOR", (2, 8)), ("LEAST", (32, 128))])
def test_no_constant_decides(constant, values, monkeypatch):
    for correlation in (4, 17):
        gap0 = smooth(128, correlation, seed=3)
        usual = solve_contact(gap0, DX, E_PRIME, mean_pressure=4e8)
        for value in values:
            with monkeypatch.context() as patched:
                patched.setattr(long_waves, constant, value)
                other = solve_contact(gap0, DX, E_PRIME, mean_pressure=4e8)
            assert other.report.evaluations < 1.4 * usual.report.evaluations
            assert other.pressure == pytest.approx(usual.pressure, abs=2e-4 * usual.pressure.max())
