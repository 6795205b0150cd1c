"""Parts of the contact search: nine points for |k|, gathered cells, and what they leave out."""

import numpy as np
import pytest

from lubfric import solve_contact
from lubfric.contact import descent, half_space, refine
from lubfric.contact.projection import shifted
from lubfric.contact.stencil import Stencil, nearest_coefficients

E_PRIME, DX = 231e9, 2e-6


def rough(n, seed=0, power=-3.0):
    """Self-affine gap [m] above its lowest point, periodic."""
    k = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n))
    k[0, 0] = np.inf
    noise = np.fft.rfft2(np.random.default_rng(seed).standard_normal((n, n)))
    z = np.fft.irfft2(np.maximum(k, 8 / n) ** (power / 2) * noise, s=(n, n))
    return 240e-9 * (z - z.min()) / z.std()


@pytest.mark.parametrize("boundary", [("periodic", "periodic"), ("free", "periodic"), ("free", "free")])
def test_nine_points_are_their_own_wave(boundary):
    """On a wave the stencil multiplies by its series; swept, gathered and over all cells it is the same."""
    shape, spacing = (12, 10), (0.5, 0.8)
    size = shape[0] * shape[1]
    values = np.random.default_rng(1).standard_normal(size).astype(np.float32)
    everywhere = Stencil(shape, spacing, boundary, None, 3.0)(values)
    swept = Stencil(shape, spacing, boundary, np.arange(size), 3.0)
    assert swept(values) == pytest.approx(everywhere, abs=1e-4)
    swept.sparse = True
    assert swept(values) == pytest.approx(everywhere, abs=1e-4)
    few = np.flatnonzero(values > 1.0)
    masked = np.where(values > 1.0, values, 0)
    expected = Stencil(shape, spacing, boundary, None, 3.0)(masked)[few]
    assert Stencil(shape, spacing, boundary, few, 3.0)(values[few]) == pytest.approx(expected, abs=1e-4)
    if boundary == ("periodic", "periodic"):
        x, y = 2 * np.pi * np.arange(12)[:, None] / 12, 2 * np.pi * np.arange(10) / 10
        wave = np.cos(2 * x + 3 * y).astype(np.float32)
        own, along_x, along_y, across = nearest_coefficients(shape, spacing)
        tx, ty = 2 * np.pi * 2 / 12, 2 * np.pi * 3 / 10
        series = own + 2 * along_x * np.cos(tx) + 2 * along_y * np.cos(ty) + 4 * across * np.cos(tx) * np.cos(ty)
        found = Stencil(shape, spacing, boundary, None, 3.0)(wave.ravel()).reshape(shape)
        assert found == pytest.approx(3 * series * wave, abs=2e-4)
        assert series == pytest.approx(np.hypot(tx / 0.5, ty / 0.8), rel=0.15)


@pytest.mark.parametrize("boundary", [("periodic", "periodic"), ("free", "periodic"), ("free", "free")])
def test_cells_left_out_are_found_by_the_look_at_the_whole_patch(boundary, monkeypatch):
    """Too small a reach leaves out cells that come into touch: more rounds, the same answer."""
    gap0 = rough(64)
    options = dict(mean_pressure=3e8, boundary=boundary, tolerance=1e-7)
    whole = solve_contact(gap0, DX, E_PRIME, **options)
    monkeypatch.setattr(refine, "REACH", 0.0)
    monkeypatch.setattr(descent, "REACH", 0.0)
    blind = solve_contact(gap0, DX, E_PRIME, start=np.where(whole.gap[::-1] == 0, 1.0, 0.0), **options)
    assert blind.pressure == pytest.approx(whole.pressure, abs=1e-4 * whole.pressure.max())


def test_careful_rounds_give_the_same(monkeypatch):
    """Two independent searches: one convolution an iteration, and exact steps with everything convolved."""
    gap0 = rough(48, seed=3)
    for control in ({"mean_pressure": 5e8}, {"mean_pressure": 5e8, "hardness": 3e9}, {"mean_gap": 2e-7}):
        fast = solve_contact(gap0, DX, E_PRIME, tolerance=1e-7, **control)
        with monkeypatch.context() as patched:
            patched.setattr(refine, "_rigid", lambda problem: True)
            careful = solve_contact(gap0, DX, E_PRIME, tolerance=1e-7, **control)
        assert careful.pressure == pytest.approx(fast.pressure, abs=2e-4 * fast.pressure.max())
        assert careful.report.evaluations > fast.report.evaluations


@pytest.mark.parametrize(
    "constant, values", [("FIRST_PACE", (0.1, 1.0)), ("LEARNING", (0.1, 0.6)), ("REACH", (0.5, 8.0))]
)
def test_no_constant_decides(constant, values, monkeypatch):
    """Each constant of the search moved far to both sides: the same answer in at most 1.7 times the convolutions."""
    for power in (-2.0, -3.0, -6.0):
        gap0 = rough(128, seed=4, power=power)
        usual = solve_contact(gap0, DX, E_PRIME, mean_pressure=4e8)
        for value in values:
            with monkeypatch.context() as patched:
                for module in (descent, refine):
                    if hasattr(module, constant):
                        patched.setattr(module, constant, value)
                other = solve_contact(gap0, DX, E_PRIME, mean_pressure=4e8)
            assert other.pressure == pytest.approx(usual.pressure, abs=1e-4 * usual.pressure.max())
            assert other.report.evaluations <= 1.7 * usual.report.evaluations


@pytest.mark.parametrize("hardness", [None, 4e9])
@pytest.mark.parametrize("boundary", [("periodic", "periodic"), ("free", "periodic"), ("free", "free")])
def test_memory_is_at_most_twelve_fields(boundary, hardness):
    """Peak of a solve beyond what the caller holds, in fields of double precision, from few contacts to full ones."""
    import tracemalloc

    gap0 = 0.1 * rough(256, seed=5)
    operator = half_space(gap0.shape, DX, E_PRIME, boundary)
    solve_contact(gap0, DX, E_PRIME, mean_pressure=1e6, operator=operator, boundary=boundary)  # made once
    for share, pressure in ((0.05, 2e7), (0.5, 2.5e8), (0.75, 5e8), (0.99, 1.7e9)):
        tracemalloc.start()
        result = solve_contact(
            gap0, DX, E_PRIME, mean_pressure=pressure, operator=operator, boundary=boundary, hardness=hardness
        )
        peak = tracemalloc.get_traced_memory()[1] / gap0.nbytes
        tracemalloc.stop()
        assert result.report.converged and result.contact_area_fraction == pytest.approx(share, rel=0.3)
        assert peak <= 12


@pytest.mark.parametrize("hardness", [np.inf, 4.0])
@pytest.mark.parametrize("load", [0.5, 20.0, 30.0])
def test_a_start_is_shifted_on_its_elastic_cells(load, hardness):
    """Cells without pressure and yielded ones keep theirs where the others can carry the load; these differ by one
    number, but for those that are let go."""
    pressure = np.array([[0.0, 1.0, 2.0, 3.0], [3.5, 4.0, 0.0, 4.0]])
    moved = shifted(pressure, load, hardness)
    assert moved.sum() == pytest.approx(load)
    assert moved.min() >= 0 and moved.max() <= hardness
    elastic = (pressure > 0) & (pressure < hardness)
    if hardness == np.inf:
        assert not moved[pressure == 0].any()
        change = (moved - pressure)[elastic & (moved > 0)]
        assert np.ptp(change) == pytest.approx(0, abs=1e-12)
