"""Parts of the contact search: the stencil for |k|, gathered cells and what they leave out, exact steps, memory."""

import tracemalloc

import numpy as np
import pytest

from lubfric import solve_contact
from lubfric.contact import half_space, rounds, search, solve
from lubfric.contact.cells import Cells, stencil
from lubfric.contact.problem import shifted

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


def smooth(n, correlation, seed=0):
    """Gaussian, with a correlation length in cells."""
    return gap_of(n, lambda k: np.exp(-((2 * np.pi * np.where(k < 1, k, 0) * correlation) ** 2) / 8), seed)


def applied(shape, boundary, cells, values, factor=3.0):
    operator = half_space(shape, (0.5, 0.8), E_PRIME, boundary)
    return stencil(Cells(operator.apply, cells, slice(None), shape), operator.spacing, boundary, factor)(values)


@pytest.mark.parametrize(
    "shape, waves", [((12, 10), (2, 3)), ((64, 80), (1, 0)), ((64, 80), (3, 2)), ((128, 64), (0, 2))]
)
def test_a_wave_is_multiplied_by_k(shape, waves):
    """Closed form: its own part in what is found is |k| of the wave, for long waves as for short ones."""
    x, y = (2 * np.pi * m * np.arange(n) / n for m, n in zip(waves, shape))
    wave = np.cos(x[:, None] + y).astype(np.float32).ravel()
    k = 2 * np.pi * np.hypot(waves[0] / shape[0] / 0.5, waves[1] / shape[1] / 0.8)
    assert np.dot(wave, applied(shape, PERIODIC, None, wave)) == pytest.approx(3.0 * k * np.dot(wave, wave), rel=0.15)


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("shape", [(12, 10), (66, 71), (1, 30)])
def test_the_stencil_is_symmetric_positive_and_the_same_on_some_cells_as_on_all(shape, boundary):
    rng, size = np.random.default_rng(2), shape[0] * shape[1]
    for cells in (None, np.flatnonzero(rng.random(size) < 0.5), np.flatnonzero(rng.random(size) < 0.05)):
        a, b = rng.standard_normal((2, size if cells is None else cells.size)).astype(np.float32)
        found = applied(shape, boundary, cells, a)
        tiny = 3e-3 * max(size, 1) ** 0.5
        assert np.dot(b, found) == pytest.approx(np.dot(a, applied(shape, boundary, cells, b)), rel=1e-3, abs=tiny)
        for values in (a, np.ones_like(a)):
            assert np.dot(values, applied(shape, boundary, cells, values)) > -1e-3 * size
        if cells is not None:
            dense = np.zeros(size, np.float32)
            dense[cells] = a
            assert found == pytest.approx(applied(shape, boundary, None, dense)[cells], abs=3e-3)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_cells_left_out_are_found_by_the_look_at_the_whole_patch(boundary, monkeypatch):
    """Too small a reach leaves out cells that come into touch: more rounds, the same answer."""
    gap0 = rough(64)
    options = dict(mean_pressure=3e8, boundary=boundary, tolerance=1e-7)
    whole = solve_contact(gap0, DX, E_PRIME, **options)
    monkeypatch.setattr(rounds, "REACH", 0.0)
    blind = solve_contact(gap0, DX, E_PRIME, start=np.where(whole.gap[::-1] == 0, 1.0, 0.0), **options)
    assert blind.pressure == pytest.approx(whole.pressure, abs=1e-4 * whole.pressure.max())


@pytest.mark.parametrize(
    "control", [{"mean_pressure": 5e8}, {"mean_pressure": 5e8, "hardness": 3e9}, {"mean_gap": 2e-7}]
)
def test_exact_steps_give_the_same(control, monkeypatch):
    """Two independent searches: one convolution an iteration, and exact steps with everything convolved."""
    gap0 = rough(48, seed=3)
    fast = solve_contact(gap0, DX, E_PRIME, tolerance=1e-7, **control)
    monkeypatch.setattr(rounds, "Search", lambda *given: search.Search(*given[:-1], True))
    exact = solve_contact(gap0, DX, E_PRIME, tolerance=1e-7, **control)
    assert exact.pressure == pytest.approx(fast.pressure, abs=2e-4 * fast.pressure.max())
    assert exact.report.evaluations > fast.report.evaluations


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


@pytest.mark.parametrize("hardness", [np.inf, 4.0])
@pytest.mark.parametrize("load", [0.5, 20.0, 30.0])
def test_a_start_is_shifted_on_its_elastic_cells(load, hardness):
    """Cells without pressure and yielded ones keep theirs where the others can carry the load; these differ by one
    number, but for those that are let go."""
    pressure = np.array([[0.0, 1.0, 2.0, 3.0], [3.5, 4.0, 0.0, 4.0]])
    moved = shifted(pressure, load, hardness)
    assert moved.sum() == pytest.approx(load)
    assert moved.min() >= 0 and moved.max() <= hardness
    if hardness == np.inf:
        assert not moved[pressure == 0].any()
        assert np.ptp((moved - pressure)[moved > 0]) == pytest.approx(0, abs=1e-12)


def test_far_from_its_mean_gap_a_contact_is_solved_loosely(monkeypatch):
    gap0 = rough(128) + (np.arange(128)[:, None] - 64) ** 2 * DX**2 / 0.04

    def found():
        return solve_contact(gap0, DX, E_PRIME, mean_gap=2e-7, boundary=("free", "periodic"))

    loose = found()
    monkeypatch.setattr(solve, "LOOSE", 0.0)
    tight = found()
    assert loose.report.evaluations < 0.8 * tight.report.evaluations
    assert loose.mean_gap == pytest.approx(2e-7, rel=1e-6)
    assert loose.pressure == pytest.approx(tight.pressure, abs=1e-4 * tight.pressure.max())
