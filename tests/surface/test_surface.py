"""Generated and prepared height maps: exact statistics, known fields, metamorphic relations, bad input."""

import math
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lubfric import InputError, Surface, generate_surface
from lubfric.surface import autocorrelation, correlation_length

ROUGH = {"sq": 240e-9, "correlation_length": 16e-6}


def generated(shape=(256, 256), spacing=2e-6, seed=0, **changes):
    return generate_surface(shape, spacing, **(ROUGH | changes), seed=seed)


def waves(shape=(64, 48), spacing=(1e-6, 2e-6), amplitude=1e-7, modes=(3, 2)):
    x, y = (np.arange(n) / n for n in shape)
    z = amplitude * np.cos(2 * np.pi * (modes[0] * x[:, None] + modes[1] * y[None, :]))
    return Surface(z, spacing, periodic_axes=(True, True))


# --- generation -------------------------------------------------------------------------------


@pytest.mark.parametrize("acf", ["exponential", "gaussian"])
def test_generation_meets_sq_exactly_and_repeats(acf):
    surface = generated(acf=acf, seed=3)
    assert surface.sq == pytest.approx(240e-9, rel=1e-12)
    assert abs(surface.heights.mean()) < 1e-20
    assert np.array_equal(surface.heights, generated(acf=acf, seed=3).heights)
    assert not np.allclose(surface.heights, generated(acf=acf, seed=4).heights)
    assert surface.periodic_axes == (True, True) and surface.seed == 3
    assert sum("correlation length" in note for note in surface.notes) == 2


FORMS = {"exponential": lambda r: np.exp(-r), "gaussian": lambda r: np.exp(-(r**2))}


@pytest.mark.parametrize("acf", FORMS)
def test_ensemble_autocorrelation_is_the_one_requested(acf):
    """The mean over 40 seeds against the zero-mean ACF; the standard error is near 0.01."""
    scale = 12e-6
    n = 256
    d = 2e-6
    maps = (generated(acf=acf, correlation_length=scale, seed=seed) for seed in range(40))
    mean = np.mean([autocorrelation(surface, 0)[1] for surface in maps], axis=0)
    lags = np.arange(n // 2 + 1) * d
    offset = (2 if acf == "exponential" else 1) * np.pi * scale**2 / (n * d) ** 2  # mean of the ACF
    assert np.abs(mean - (FORMS[acf](lags / scale) - offset) / (1 - offset))[:30].max() < 0.025


@pytest.mark.parametrize(
    "acf, level, factor",
    [
        ("exponential", 0.1, 2.302585),
        ("exponential", 0.2, 1.609438),
        ("gaussian", 0.1, 1.517427),
        ("gaussian", 0.2, 1.268636),
    ],
)
def test_decay_level_conventions(acf, level, factor):
    """One surface, three lengths: at 1/e, at 0.1 and at 0.2."""
    same = generated(acf=acf, correlation_length=16e-6 * factor, decay_level=level)
    assert np.allclose(same.heights, generated(acf=acf, correlation_length=16e-6).heights, atol=1e-12)


def test_heights_are_gaussian():
    surface = generated((512, 512), correlation_length=8e-6, seed=5)
    assert surface.ssk == pytest.approx(0, abs=0.1)
    assert surface.sku == pytest.approx(3, abs=0.1)
    assert surface.sa == pytest.approx(math.sqrt(2 / math.pi) * surface.sq, rel=0.01)


def test_cutoff_removes_short_waves_and_odd_shapes_work():
    surface = generated((255, 257), acf="gaussian", correlation_length=24e-6, cutoff=12e-6)
    spectrum = np.abs(np.fft.fft2(surface.heights))
    f = np.hypot(np.fft.fftfreq(255, 2e-6)[:, None], np.fft.fftfreq(257, 2e-6)[None, :])
    assert spectrum[f > 1 / 12e-6].max() < 1e-10 * spectrum.max()
    assert surface.sq == pytest.approx(240e-9, rel=1e-12)


@pytest.mark.parametrize(
    "changes, words",
    [({"correlation_length": 3e-6}, "cells"), ({"correlation_length": 200e-6}, "quarter")]
    + [({"correlation_length": 80e-6}, "longer map"), ({"acf": "gausian"}, "did you mean 'gaussian'")]
    + [({"cutoff": 1e-6}, "cutoff"), ({"cutoff": 100e-6}, "correlation_length")],
)
def test_generation_refuses(changes, words):
    with pytest.raises(InputError, match=words):
        generated(**changes)


@pytest.mark.parametrize("acf", ["exponential", "gaussian"])
@pytest.mark.parametrize("length", [60e-6, 200e-6])
def test_a_map_as_long_as_recommended_is_made(acf, length):
    """Both ways that the message names: the length, and the multiple of the length."""
    given = {"sq": 1e-7, "correlation_length": length, "acf": acf, "seed": 1}
    with pytest.raises(InputError, match=f"correlation_length along x.* {1e6 * length:g} µm") as refused:
        generate_surface((128, 128), 2e-6, **given)
    longest, times = re.search(
        r"at least (\S+) .m long along x .* surface.oversize = (\d+)", str(refused.value)
    ).groups()
    metres = float(longest) * (1e-3 if "mm long" in str(refused.value) else 1e-6)
    for cells in (math.ceil(metres / 2e-6), 128 * int(times)):
        assert generate_surface((cells, cells), 2e-6, **given).shape == (cells, cells)


def test_a_map_with_form_has_a_correlation_length_after_what_the_error_recommends():
    """Roughness of 10 nm on a cylinder along x, which is alike at all distances along x."""
    y = np.linspace(-1.0, 1.0, 64)[None, :]
    noise = generated(shape=(256, 64), spacing=1e-6, correlation_length=6e-6, sq=1e-8).heights
    surface = Surface(noise + 2e-7 * y**2, 1e-6)
    with pytest.raises(InputError, match=r"up to 128 µm; .*; remove its form, as surface.level\('quadratic'\)"):
        surface.correlation_length()
    assert surface.level("quadratic").correlation_length() == pytest.approx(6e-6, rel=0.3)


# --- the data type ----------------------------------------------------------------------------


# --- levelling, filling -----------------------------------------------------------------------


@settings(max_examples=30)
@given(st.tuples(*[st.floats(-1e-2, 1e-2) for _ in range(2)]), st.floats(-1e-3, 1e-3))
def test_level_removes_any_plane_and_is_idempotent(slopes, offset):
    x = np.arange(20) * 1e-6
    y = np.arange(15) * 3e-6
    rough = np.random.default_rng(0).standard_normal((20, 15)) * 1e-7
    mask = np.random.default_rng(1).random((20, 15)) > 0.2
    tilted = rough + slopes[0] * x[:, None] + slopes[1] * y[None, :] + offset
    one = Surface(np.where(mask, tilted, np.nan), (1e-6, 3e-6), mask=mask).level()
    assert np.allclose(one.measured, Surface(rough, (1e-6, 3e-6), mask=mask).level().measured, atol=1e-15)
    assert np.allclose(one.level().measured, one.measured, atol=1e-17)
    assert one.measured.mean() == pytest.approx(0, abs=1e-18)


def test_level_of_points_on_a_line_is_refused():
    mask = np.zeros((5, 5), bool)
    mask[2] = True
    with pytest.raises(InputError, match="line"):
        Surface(np.zeros((5, 5)), 1e-6, mask=mask).level()
    assert not Surface(np.arange(5.0)[:, None], 1e-6).level().heights.round(12).any()


def test_fill_never_overshoots_even_at_a_corner():
    rng = np.random.default_rng(4)
    z = rng.standard_normal((20, 20))
    mask = rng.random((20, 20)) > 0.4
    mask[:3, :3] = False
    filled = Surface(np.where(mask, z, np.nan), 1e-6, mask=mask).fill().heights
    assert z[mask].min() <= filled.min() and filled.max() <= z[mask].max()


def test_order_of_level_and_fill_matters_and_statistics_use_measured_points():
    """Zeros filled in before levelling raise Sq; the mask keeps them out of the statistics."""
    x = np.arange(40) * 1e-6
    z = 1e-8 * np.random.default_rng(0).standard_normal((40, 40)) + 0.05 * x[:, None]
    mask = np.random.default_rng(1).random(z.shape) > 0.05
    good = Surface(np.where(mask, z, np.nan), 1e-6, mask=mask).level().fill()
    bad = Surface(np.where(mask, z, 0.0), 1e-6).level()
    assert good.sq == pytest.approx(1e-8, rel=0.05) and bad.sq > 10 * good.sq


def test_too_much_missing_and_unfilled_maps_are_refused():
    mask = np.zeros((10, 10), bool)
    mask[:4] = True
    surface = Surface(np.where(mask, 1.0, np.nan), 1e-6, mask=mask)
    with pytest.raises(InputError, match="missing fraction"):
        surface.fill()
    for work in (lambda: surface.periodic(), lambda: surface.resampled(shape=(5, 5)), lambda: surface.patch((5, 5))):
        with pytest.raises(InputError, match="unmeasured"):
            work()


# --- scaling, turning, closing, resampling ----------------------------------------------------


def test_mirror_closes_a_map_without_a_step():
    tilted = Surface(np.add.outer(np.arange(30.0), 2 * np.arange(20.0)), 1.0)
    closed = tilted.periodic()
    assert closed.shape == (60, 40) and closed.periodic_axes == (True, True)
    assert closed.sq == pytest.approx(tilted.sq)
    assert np.abs(np.diff(np.vstack([closed.heights, closed.heights[:1]]), axis=0)).max() == 1
    only_y = tilted.periodic(axes=(False, True))
    assert only_y.shape == (30, 40) and only_y.periodic_axes == (False, True)
    assert closed.periodic() is closed


def test_resampling_a_band_limited_map_is_exact_there_and_back():
    coarse = waves()
    fine = coarse.resampled(shape=(160, 96))
    x = (np.arange(160) + 0.5) / 160 - 0.5 / 64
    y = (np.arange(96) + 0.5) / 96 - 0.5 / 48
    exact = 1e-7 * np.cos(2 * np.pi * (3 * x[:, None] + 2 * y[None, :]))
    assert np.allclose(fine.heights, exact, atol=1e-18)
    assert fine.size == pytest.approx(coarse.size) and fine.periodic_axes == (True, True)
    assert np.allclose(fine.resampled(shape=coarse.shape).heights, coarse.heights, atol=1e-18)
    assert coarse.resampled(shape=coarse.shape) is coarse


def test_resampling_an_open_map():
    """Cell averages: the mean is conserved, planes are exact, smooth maps converge at third order."""
    plane = Surface(np.add.outer(np.arange(30.0), 2 * np.arange(20.0)), 1.0)
    coarse = plane.resampled(shape=(12, 20))
    assert coarse.heights.mean() == pytest.approx(plane.heights.mean(), rel=1e-12)
    assert np.allclose(np.diff(coarse.heights, axis=0), 2.5)
    errors = []
    for n in (32, 64):
        for count in (4 * n, 3 * n // 4):
            old, new = (-np.diff(np.cos(7 * np.linspace(0, 1, m + 1))) * m / 7 for m in (n, count))
            changed = Surface(old[:, None] * np.ones(3), (1 / n, 1.0)).resampled(shape=(count, 3))
            assert changed.heights.mean() == pytest.approx(old.mean(), rel=1e-12)
            errors.append(np.abs(changed.heights[:, 0] - new)[count // 4 : 3 * count // 4].max())
    assert errors[0] / errors[2] > 7 and errors[1] / errors[3] > 7


def test_resampling_by_spacing_cuts_the_rest_and_knows_what_stays_periodic():
    whole = waves().resampled(spacing=(2e-6, 2e-6))
    rest = waves().resampled(spacing=(1.5e-6, 2e-6))
    assert whole.shape == (32, 48) and whole.periodic_axes == (True, True)
    assert rest.shape == (42, 48) and rest.periodic_axes == (False, True) and rest.spacing[0] == 1.5e-6
    for bad in ({"shape": (4, 4), "spacing": 1e-6}, {}, {"spacing": 1.0}):
        with pytest.raises(InputError):
            waves().resampled(**bad)


def test_patch_gives_the_grid_requested():
    tiled = waves().patch((128, 96))
    assert tiled.periodic_axes == (True, True) and np.array_equal(tiled.heights[:64, :48], waves().heights)
    assert waves().patch((100, 48)).periodic_axes == (False, True)
    open_map = waves().cropped((60, 40))
    cut = open_map.patch((40, 40), (1e-6, 1e-6))
    assert cut.shape == (40, 40) and cut.spacing == (1e-6, 1e-6) and cut.periodic_axes == (False, False)
    with pytest.raises(InputError, match="patch of 80 points"):
        open_map.patch((80, 40))


# --- statistics -------------------------------------------------------------------------------


def test_statistics_of_a_cosine():
    surface = waves()
    assert surface.sq == pytest.approx(1e-7 / math.sqrt(2))
    assert surface.ssk == pytest.approx(0, abs=1e-12) and surface.sku == pytest.approx(1.5)
    k = 2 * np.pi * 3 / 64e-6
    assert correlation_length(surface, 0, 0.5) == pytest.approx(math.acos(0.5) / k, rel=0.03)


def test_open_autocorrelation_counts_pairs_and_skips_unmeasured_points():
    rng = np.random.default_rng(3)
    z = rng.standard_normal((40, 9))
    mask = rng.random((40, 9)) > 0.3
    surface = Surface(np.where(mask, z, np.nan), 1e-6, mask=mask)
    _, acf = autocorrelation(surface, 0)
    z = z - z[mask].mean()
    for lag in (1, 5, 20):
        pairs = mask[:-lag] & mask[lag:]
        expected = np.mean((z[:-lag] * z[lag:])[pairs]) / np.mean(z[mask] ** 2)
        assert acf[lag] == pytest.approx(expected, abs=1e-12)


def test_statistics_refuse_what_they_cannot_give():
    flat = Surface(np.zeros((4, 4)), 1e-6)
    for work in (
        lambda: flat.ssk,
        lambda: correlation_length(flat),
        lambda: correlation_length(waves((64, 64), modes=(0, 1)), 0),
        lambda: correlation_length(waves(), 2),
    ):
        with pytest.raises(InputError):
            work()


def test_a_generated_map_has_lengths_of_a_map():
    with pytest.raises(InputError, match=r"spacing = 1 m; allowed: 1e-11 to 0.01 m .* 1e-6 is 1 µm"):
        generate_surface((100, 100), 1, sq=1e-7, correlation_length=8, seed=1)
    with pytest.raises(InputError, match="rms slope"):
        generate_surface((100, 100), 1e-6, sq=0.1, correlation_length=8e-6, seed=1)
