"""Everything done to a map on cells that are longer along one axis: against formulas in metres, along each axis, and
against the map turned by a right angle."""

import math

import numpy as np
import pytest

from lubfric import Surface, generate_surface
from lubfric.surface import autocorrelation, correlation_length, rms_slope

DX = 1e-6
DY = 2.5e-6
SHAPE = (120, 96)
PLACES = [(np.arange(n) + 0.5) * step for n, step in zip(SHAPE, (DX, DY))]
X, Y = np.meshgrid(*PLACES, indexing="ij")
CLOSED = (True, True)


def wave(axis, periods, height=1e-7):
    length = (SHAPE[0] * DX, SHAPE[1] * DY)[axis] / periods
    return height * np.cos(2 * np.pi * (X, Y)[axis] / length), length


def turned(surface):
    """The same sample, its x laid along y: by NumPy alone."""
    mask = None if surface.mask is None else surface.mask.T
    return Surface(surface.heights.T, surface.spacing[::-1], mask=mask, periodic_axes=surface.periodic_axes[::-1])


@pytest.mark.parametrize("axis, periods", [(0, 2), (0, 6), (1, 3), (1, 8)])
@pytest.mark.parametrize("closed", [True, False])
def test_a_filter_passes_what_the_standard_says_along_each_axis(axis, periods, closed):
    """ISO 16610-61: exp(-pi (a L/wavelength)²), a² = ln 2/pi."""
    z, length = wave(axis, periods)
    index = 30e-6
    passed = math.exp(-math.log(2) * (index / length) ** 2)
    kept = Surface(z, (DX, DY), periodic_axes=(closed, closed)).filtered(s=index).heights
    inside = np.s_[:] if closed else np.s_[45:-45, 20:-20]
    np.testing.assert_allclose(kept[inside], passed * z[inside], atol=1e-5 * 1e-7)


def test_a_form_has_its_slopes_and_curvatures_in_metres():
    z = 2e-3 * X - 5e-3 * Y + X**2 / (2 * 3e-3) - Y**2 / (2 * 8e-3)
    surface = Surface(z, (DX, DY))
    assert np.abs(surface.level("quadratic").heights).max() < 1e-12 * np.abs(z).max()
    words = surface.level("quadratic").notes[0]
    assert f"{1 / 3e-3:.3e}" in words and f"{-1 / 8e-3:.3e}" in words
    slopes = 2e-3 + X.mean() / 3e-3, -5e-3 - Y.mean() / 8e-3
    assert all(f"{slope:.3e}" in surface.level().notes[0] for slope in slopes)


def test_gaps_are_filled_by_a_harmonic_field_in_metres():
    """x² - y² is harmonic, and the five points have it exactly, on cells of any length."""
    z = (X - 5e-5) ** 2 - (Y - 1e-4) ** 2 + 3e-6 * X / 1e-4
    mask = np.ones(SHAPE, bool)
    mask[30:50, 20:60] = False
    surface = Surface(np.where(mask, z, np.nan), (DX, DY), mask=mask)
    np.testing.assert_allclose(surface.fill().heights, z, atol=1e-10 * np.abs(z).max())


def test_slopes_and_lengths_belong_to_their_axis():
    z = wave(0, 3)[0] + wave(1, 2, 2e-7)[0]
    surface = Surface(z, (DX, DY), periodic_axes=CLOSED)
    k = 2 * np.pi * np.array([3 / (SHAPE[0] * DX), 2 / (SHAPE[1] * DY)])
    heights = np.array([1e-7, 2e-7]) / math.sqrt(2)
    steps = np.array([DX, DY])
    expected = heights * 2 / steps * np.sin(k * steps / 2)  # between neighbours
    assert rms_slope(surface)[:2] == pytest.approx(expected, rel=1e-9)
    for axis in (0, 1):
        alone = Surface(wave(axis, 3)[0], (DX, DY), periodic_axes=CLOSED)
        lags, result = autocorrelation(alone, axis)
        np.testing.assert_allclose(result, np.cos(2 * np.pi * 3 * lags / (SHAPE[axis] * steps[axis])), atol=1e-9)


@pytest.mark.parametrize("axis", [0, 1])
def test_a_generated_map_is_as_correlated_along_each_axis_as_requested(axis):
    lengths = (8e-6, 20e-6) if axis else (20e-6, 12e-6)
    shape = (512, 256)
    made = [
        generate_surface(shape, (DX, DY), sq=1e-7, correlation_length=lengths, acf="gaussian", seed=s) for s in (1, 2)
    ]
    for along in (0, 1):
        result = np.mean([correlation_length(one, along) for one in made])
        assert result == pytest.approx(lengths[along], rel=0.12)


def test_other_cells_keep_the_wave_where_it_is():
    for axis in (0, 1):
        z, length = wave(axis, 2)
        for closed in (True, False):
            new = Surface(z, (DX, DY), periodic_axes=(closed, closed)).resampled(spacing=(2e-6, 1.25e-6))
            places = (np.arange(new.shape[axis]) + 0.5) * new.spacing[axis]
            line = 1e-7 * np.cos(2 * np.pi * places / length)
            line = line * (1 if closed else np.sinc(new.spacing[axis] / length) / np.sinc((DX, DY)[axis] / length))
            result = new.heights.mean(axis=1 - axis)
            np.testing.assert_allclose(result[2:-2], line[2:-2], atol=5e-5 * 1e-7)


def rough(closed=(False, False)):
    rng = np.random.default_rng(4)
    z = 1e-7 * rng.standard_normal((60, 48)) + 1e-6 * np.arange(60)[:, None] / 60
    z[20, 30] = 9e-6
    mask = rng.random(z.shape) > 0.05
    mask[20, 30] = True
    return Surface(np.where(mask, z, np.nan), (DX, DY), mask=mask, periodic_axes=closed)


DONE = {
    "level": lambda s: s.level(),
    "quadratic": lambda s: s.level("quadratic"),
    "fill": lambda s: s.level().fill(),
    "filter": lambda s: s.level().filtered(s=14e-6, l=40e-6),
    "outliers": lambda s: s.level().without_outliers(),
    "mirror": lambda s: s.level().fill().periodic(),
    "patch": lambda s: s.level().fill().patch((20, 16) if s.spacing[0] == DX else (16, 20)),
}


@pytest.mark.parametrize("name", DONE)
@pytest.mark.parametrize("closed", [(False, False), (True, False)])
def test_a_turned_sample_is_treated_as_it_lies(name, closed):
    surface = rough(closed)
    one = DONE[name](surface)
    other = DONE[name](turned(surface))
    assert other.spacing == one.spacing[::-1] and other.periodic_axes == one.periodic_axes[::-1]
    np.testing.assert_allclose(other.heights.T, one.heights, rtol=1e-7, atol=1e-17)


def test_transposing_turns_cells_mask_and_ends():
    surface = rough((True, False))
    other = surface.transposed()
    by_hand = turned(surface)
    assert (other.spacing, other.periodic_axes) == ((DY, DX), (False, True))
    np.testing.assert_array_equal(other.heights, by_hand.heights)
    np.testing.assert_array_equal(other.mask, by_hand.mask)
