"""Sk, Spk and Svk: closed forms, a second computation by histogram, and another package."""

import numpy as np
import pytest
from scipy import integrate, optimize, stats

from lubfric import Surface, generate_surface


def of(heights) -> Surface:
    return Surface(np.asarray(heights, dtype=float).reshape(1, -1), 1e-6)


def test_a_curve_of_three_straight_parts_has_the_parameters_it_is_made_of():
    """Peaks: a triangle of 90 nm over 10 %; core: 300 nm; dales: a triangle of 800 nm over 25 %."""
    count = 200_000
    ratio = (np.arange(count) + 0.5) / count
    core = -300e-9 * ratio
    heights = core + 0.0
    peaks = ratio < 0.1
    heights[peaks] = 90e-9 * (1 - ratio[peaks] / 0.1)
    dales = ratio > 0.75
    heights[dales] = -300e-9 - 800e-9 * (ratio[dales] - 0.75) / 0.25
    heights = np.random.default_rng(0).permutation(heights)
    curve = of(heights).bearing()
    assert curve.sk == pytest.approx(300e-9, rel=1e-3)
    assert curve.spk == pytest.approx(90e-9, rel=1e-3) and curve.smr1 == pytest.approx(0.1, abs=1e-4)
    assert curve.svk == pytest.approx(800e-9, rel=1e-3) and curve.smr2 == pytest.approx(0.75, abs=1e-4)


def test_a_gaussian_distribution():
    """The quantiles of the normal law, its line from 30 to 70 % by quadrature, and the partial expectations."""
    middle = integrate.quad(lambda r: (r - 0.5) * stats.norm.isf(r), 0.3, 0.7)[0]
    fall = -middle / integrate.quad(lambda r: (r - 0.5) ** 2, 0.3, 0.7)[0]
    level = 0.5 * fall
    tail = stats.norm.sf(level)
    area = stats.norm.pdf(level) - level * tail
    count = 400_001
    heights = stats.norm.isf((np.arange(count) + 0.5) / count) * 1e-7
    curve = of(heights).bearing()
    assert curve.sk == pytest.approx(fall * 1e-7, rel=2e-4)
    for height, share in ((curve.spk, curve.smr1), (curve.svk, 1 - curve.smr2)):
        assert share == pytest.approx(tail, rel=1e-3) and height == pytest.approx(2 * area / tail * 1e-7, rel=1e-3)


def by_histogram(heights, bins=20_000):
    """Sk, Spk, Svk from the counts of heights in bins, read by interpolation, and the line by a minimiser."""
    counts, edges = np.histogram(heights, bins)
    above = np.append(np.cumsum(counts[::-1])[::-1], 0) / heights.size
    ratio = np.linspace(0, 1, 4001)
    level = np.interp(ratio, above[::-1], edges[::-1])
    step = 1600
    begin = np.argmin(level[:-step] - level[step:])
    x = ratio[begin : begin + step + 1]
    y = level[begin : begin + step + 1]
    line = optimize.least_squares(lambda p: (p[0] + p[1] * x - y) / np.ptp(y), [y.mean(), 0.0], x_scale="jac").x
    upper, lower = line[0], line[0] + line[1]
    smr1 = np.interp(upper, edges, above)
    smr2 = np.interp(lower, edges, above)
    spk = 2 * integrate.trapezoid(np.maximum(level - upper, 0), ratio) / smr1
    svk = 2 * integrate.trapezoid(np.maximum(lower - level, 0), ratio) / (1 - smr2)
    return upper - lower, spk, svk


def plateaus(seed=3) -> Surface:
    rough = generate_surface((256, 256), 1e-6, sq=400e-9, correlation_length=8e-6, seed=seed)
    fine = generate_surface((256, 256), 1e-6, sq=40e-9, correlation_length=4e-6, seed=seed + 1)
    return Surface(np.minimum(rough.heights, 150e-9 + fine.heights), 1e-6)


@pytest.mark.parametrize(
    "surface", [plateaus(), generate_surface((200, 160), 1e-6, sq=1e-7, correlation_length=5e-6, seed=1)]
)
def test_a_second_computation_by_histogram(surface):
    result = surface.sk, surface.spk, surface.svk
    np.testing.assert_allclose(result, by_histogram(surface.heights.ravel()), rtol=0.02)


def test_another_package():
    surfalize = pytest.importorskip("surfalize")
    surface = plateaus(7)
    other = surfalize.Surface(surface.heights * 1e6, 1.0, 1.0)
    result = [value * 1e6 for value in (surface.sk, surface.spk, surface.svk)]
    np.testing.assert_allclose(result, [other.Sk(), other.Spk(), other.Svk()], rtol=0.03)


def test_turned_over_peaks_become_dales_and_lengths_scale():
    surface = plateaus()
    over = Surface(-3 * surface.heights, surface.spacing).bearing()
    assert over.sk == pytest.approx(3 * surface.sk, rel=1e-9)
    assert over.spk == pytest.approx(3 * surface.svk, rel=1e-3) and over.svk == pytest.approx(3 * surface.spk, rel=1e-3)
    assert surface.svk > 4 * surface.spk  # plateaus


def test_only_measured_points_count_and_a_flat_map_has_none():
    surface = plateaus()
    mask = np.ones(surface.shape, bool)
    mask[:, :40] = False
    spoilt = np.where(mask, surface.heights, 1e-3)
    left = Surface(surface.heights[:, 40:], surface.spacing).bearing()
    assert Surface(spoilt, surface.spacing, mask=mask).bearing() == left
    assert Surface(np.full((4, 4), 2e-9), 1e-6).sk == 0.0


def test_describe_states_them():
    surface = plateaus()
    assert f"Spk {surface.spk * 1e9:.4g}" in surface.describe()
