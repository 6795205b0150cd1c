"""ISO 16610-61 Gaussian filters against their transmission, and what they must leave alone."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lubfric import InputError, Surface, generate_surface


def wave(periods, shape=(240, 60), step=1e-6, axis=0):
    n = shape[axis]
    line = np.cos(2 * np.pi * periods * (np.arange(n) + 0.5) / n)
    return np.broadcast_to(line[:, None] if axis == 0 else line[None, :], shape) * 1e-7


def transmitted(before, after):
    return float(np.vdot(after, before) / np.vdot(before, before))


def test_a_circular_wave_is_damped_as_a_straight_one():
    """The areal filter is isotropic: only the length of the wave vector counts."""
    x = np.arange(200)
    z = 1e-7 * np.cos(2 * np.pi * (3 * x[:, None] + 4 * x[None, :]) / 200)
    surface = Surface(z, 1e-6, periodic_axes=(True, True))
    straight = Surface(wave(5, (200, 200)), 1e-6, periodic_axes=(True, True))
    kept = [transmitted(s.heights, s.filtered(s=50e-6).heights) for s in (surface, straight)]
    assert kept[0] == pytest.approx(kept[1], rel=1e-7)


@settings(max_examples=20)
@given(st.floats(6e-6, 39e-6), st.floats(0.0, 0.3), st.integers(0, 99))
def test_a_constant_passes_whatever_is_missing(index, holes, seed):
    rng = np.random.default_rng(seed)
    mask = rng.random((50, 40)) >= holes
    heights = np.where(mask, 3e-6, np.nan)
    result = Surface(heights, 1e-6, mask=mask).filtered(s=index)
    np.testing.assert_allclose(result.heights[mask], 3e-6, rtol=1e-12)
    assert result.missing_fraction == pytest.approx(1 - mask.mean())


def test_unmeasured_points_have_no_say():
    surface = generate_surface((128, 128), 1e-6, sq=1e-7, correlation_length=8e-6, acf="gaussian", seed=3)
    mask = np.ones(surface.shape, bool)
    mask[40:44, 50:53] = False
    junk = [np.where(mask, surface.heights, value) for value in (np.nan, 1.0)]
    result = [Surface(z, 1e-6, mask=mask).filtered(s=10e-6, l=60e-6).heights[mask] for z in junk]
    np.testing.assert_array_equal(result[0], result[1])


def test_band_between_both_indices_is_left():
    shape = (240, 240)
    z = wave(2, shape) + wave(6, shape) + wave(40, shape)
    result = Surface(z, 1e-6, periodic_axes=(True, True)).filtered(s=12e-6, l=60e-6)
    shares = [transmitted(wave(p, shape), result.heights) for p in (2, 6, 40)]
    assert shares[0] < 0.2 and shares[1] > 0.65 and shares[2] < 0.1
    assert sum("filter" in note for note in result.notes) == 2


@pytest.mark.parametrize(
    "indices, words",
    [({"s": 4e-6}, "s_filter"), ({"l": 1.0}, "l_filter"), ({"s": 20e-6, "l": 20e-6}, "below l_filter")]
    + [({"s": True}, "s_filter"), ({"l": float("nan")}, "l_filter")],
)
def test_indices_out_of_range(indices, words):
    with pytest.raises(InputError, match=words):
        Surface(wave(2), 1e-6).filtered(**indices)
