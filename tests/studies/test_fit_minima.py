"""Fits find the lowest minimum of several, leave starts without a gradient, and say where they do not describe the
data."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.optimize import curve_fit
from scipy.stats import linregress

import lubfric
from lubfric.studies import ResidualTests, chance_of, residual_tests, search_minima

STRESS = "lubricant.eyring_stress"
LIMIT = "lubricant.limiting_stress_coefficient"
BOUNDS = {STRESS: (1e6, 2e7), LIMIT: (0.02, 0.1)}
SLIPS = np.geomspace(2e-3, 0.3, 12)


def traction_scene(stress, limit):
    """A smooth contact of 1 GPa with an oil that is limited by an Eyring stress and by a limiting stress."""
    return lubfric.load_scene("paper").with_(
        bodies={"radius": 0.01, "width": 0.01, "e_prime": 2.3e11, "load": 2 * np.pi * 0.01 * 1e18 / 2.3e11 * 0.01},
        lubricant={"viscosity": 0.05, "pressure_viscosity_coefficient": 2e-8, "eyring_stress": stress}
        | {"limiting_stress_coefficient": limit, "limiting_stress_offset": 1e6},
        motion={"entrainment_speed": 2.0},
        surface={"sq": 0.0, "correlation_length": 3e-5},
        contact={"shape": (64, 64), "spacing": 1e-5},
    )


@cache
def true_coefficient(stress, limit):
    return lubfric.traction(traction_scene(stress, limit), SLIPS, tolerance=2e-3).coefficient


def measured_traction(stress, limit, seed, noise=0.02):
    f = true_coefficient(stress, limit) * (1 + noise * np.random.default_rng(seed).standard_normal(SLIPS.size))
    return lubfric.Measured(SLIPS, f, over="slide_roll_ratio")


@pytest.mark.slow
@pytest.mark.parametrize("stress, limit, start", [(6e6, 0.035, (4e6, 0.06)), (8e6, 0.03, (2e6, 0.095))])
def test_a_start_in_a_wrong_minimum_or_without_a_gradient_is_left(stress, limit, start):
    """Where the limiting stress is nowhere reached, f does not change with it, and a search from there stays."""
    measured = measured_traction(stress, limit, 3)
    begin = dict(zip(BOUNDS, start))
    result = lubfric.fit(traction_scene(5e6, 0.05), measured, BOUNDS, start=begin, starts=4)
    for key, truth, width in ((STRESS, stress, 0.2), (LIMIT, limit, 0.15)):
        low, high = result.intervals[key]
        assert low < truth < high and (high - low) / truth < width
    assert result.describes_data and not result.undetermined and "does not describe" not in result.explain()
    assert "the residuals look like random scatter, which the intervals assume" in result.explain()


def test_a_model_that_cannot_follow_the_data_is_said_to():
    """An oil without a limiting stress, for data that have one: the curve bends where no Eyring stress makes it."""
    measured = measured_traction(6e6, 0.035, 4, noise=0.005)
    result = lubfric.fit(traction_scene(5e6, 0.5), measured, {STRESS: (1e6, 2e7)}, starts=0)
    assert not result.describes_data and result.tests.systematic
    first = result.explain().splitlines()[1]
    assert "WARNING: the fit does not describe the data: the residuals are systematic" in first
    assert "does not describe the data" in repr(result)


class NarrowWell:
    """Residuals of two parameters with a minimum of 0 near one corner of the bounds, and none but a slight slope away
    from it in most of the rest."""

    def __init__(self):
        self.units = []

    def residuals(self, unit):
        self.units.append(unit)
        x, y = unit - np.array([0.84, 0.77])
        return np.array([0.3 * np.tanh(5 * x), 0.3 * np.tanh(5 * y), 0.05 * (unit[0] - 0.84)])


def test_the_search_finds_a_minimum_far_from_a_start_without_a_gradient():
    wells = NarrowWell()
    start = np.array([0.05, 0.05])
    (lowest, *others) = search_minima(wells, start, 16)
    np.testing.assert_allclose(lowest.unit, [0.84, 0.77], atol=0.03)
    assert len(wells.units) <= 26 and all(other.misfit <= 1.5 * lowest.misfit for other in others)
    (only,) = search_minima(NarrowWell(), start, 0)
    np.testing.assert_array_equal(only.unit, start)


@pytest.mark.parametrize("starts, words", [(3, "0, or a power of two"), (-1, "starts")])
def test_the_number_of_starts_is_checked(starts, words):
    measured = lubfric.Measured(SLIPS, np.full(SLIPS.size, 0.03), over="slide_roll_ratio")
    with pytest.raises(lubfric.InputError, match=words):
        lubfric.fit(traction_scene(5e6, 0.05), measured, BOUNDS, starts=starts)


def test_random_residuals_are_doubted_as_often_as_stated():
    """Lines through noise of five points and of twelve: 1 % are refused and 5 % doubted, although a line takes noise
    out."""
    rng = np.random.default_rng(5)
    for count in (5, 12):
        x = np.linspace(0.0, 1.0, count)
        line = np.stack([np.ones(count), x], axis=1)
        axes = np.linalg.qr(line)[0]
        further = np.linalg.qr(np.stack([np.ones(count), x, x**2, x**3], axis=1)[:, : min(count - 1, 4)])[0][:, 2:]
        found = [chance_of(rng.standard_normal(count), axes, further)[2] for _ in range(100)]
        assert np.mean(np.array(found) < 0.05) == pytest.approx(0.05, abs=0.05)
        assert np.mean(np.array(found) < 0.5) == pytest.approx(0.5, abs=0.13)


def test_one_clear_sign_is_not_hidden_by_the_other():
    """By Bonferroni's bound the probability of the least of three signs is at most three times the least; noise of
    which the further axes explain next to nothing, and slow waves, have one sign alone."""
    rng = np.random.default_rng(8)
    x = np.linspace(0.0, 1.0, 12)
    axes = np.full((12, 1), 12**-0.5)
    further = ((x - x.mean()) / np.linalg.norm(x - x.mean()))[:, None]
    for slow in (0.0, 1.0, 2.0):
        residuals = rng.standard_normal(12) + slow * np.cos(2 * np.pi * x)
        residuals -= further @ (further.T @ residuals)
        order, shape, chance = chance_of(residuals, axes, further)
        assert shape > 0.99
        assert chance <= 3 * order + 5e-4


def test_the_probability_of_an_offset_is_that_of_the_test_of_two_models():
    """Two models in one another, as a t test of the further parameter has it."""
    x = np.arange(8.0)
    y = np.array([0.3, -0.1, 0.4, 0.2, 0.9, 0.5, 0.8, 1.4])
    ones, line = np.ones((8, 1)), np.stack([np.ones(8), x], axis=1)
    axes = ones / np.sqrt(8)
    further = ((x - x.mean()) / np.linalg.norm(x - x.mean()))[:, None]
    _, shape, _ = chance_of(y, axes, further)
    assert shape == pytest.approx(linregress(x, y).pvalue, rel=1e-6)
    tests = residual_tests(x, -(line @ [0.02, 0.003]) - 1e-4 * y, line[:, 1:], np.zeros(8), stated=False)
    assert tests.offset == pytest.approx(0.02, rel=0.01) and tests.explained > 0.99
    assert "an offset of the measured f, of the order of 0.02" in tests.text


@pytest.mark.parametrize("offset, factor, named", [(0.02, 1.0, "an offset"), (0.0, 1.25, "a factor")])
def test_an_offset_and_a_factor_are_told_apart(offset, factor, named):
    """Of a fitted curve that varies tenfold, with a parameter that can follow neither."""
    fitted = np.geomspace(0.01, 0.1, 12)
    parameter = np.tile([1e-3, -1e-3], 6)[:, None]
    measured = factor * fitted + offset + 1e-5 * np.random.default_rng(1).standard_normal(12)
    tests = residual_tests(np.arange(12.0), fitted - measured, parameter, np.zeros(12), stated=False, fitted=fitted)
    assert f"{named} of the measured f" in tests.text and ", or a" not in tests.text.split("; ")[1]
    assert (tests.offset if offset else tests.factor) == pytest.approx(offset or factor, rel=1e-3)


def test_residuals_of_a_system_and_large_ones_are_told():
    rng = np.random.default_rng(5)
    x = np.linspace(0.0, 1.0, 12)
    slope = x[:, None]

    def tests(residuals) -> ResidualTests:
        return residual_tests(x, residuals, slope, np.zeros(12), stated=True)

    wave = 0.7 * np.sin(2 * np.pi * x) + 0.1 * rng.standard_normal(12)
    assert tests(wave).systematic and not tests(wave).too_large and not tests(wave).describes
    large = tests(3.0 * rng.standard_normal(12))
    assert large.too_large and large.times_stated == pytest.approx(3.0, rel=0.5)
    within = residual_tests(x, wave, slope, np.full(12, 1.0), stated=False)
    assert within.small and within.describes and "numerical error" in within.note
    doubted = replace(tests(rng.standard_normal(12)), chance=0.03)
    assert doubted.doubtful and doubted.describes and "may not describe the data" in doubted.note


@pytest.mark.parametrize("expected", [0.0, 0.01, 0.5])
def test_residuals_within_the_model_form_error_do_not_blame_the_data(expected):
    """Only the seed of the surface differed from the truth, and the advice was to check the data."""
    x = np.linspace(0.0, 1.0, 12)
    residuals = 0.03 * np.sin(2 * np.pi * x)
    tests = replace(
        residual_tests(x, residuals, x[:, None], np.zeros(12), stated=False), relative=0.03, expected=expected
    )
    assert not tests.describes and tests.is_within_model == (expected > 0.03)
    assert ("check the data" in tests.text) != ("error of the model may cause them" in tests.text)
    assert tests.is_within_model == ("error of the model may cause them" in tests.text)


@pytest.mark.parametrize("offset", [0.0, 0.006])
def test_an_offset_of_a_rig_is_found_in_eleven_points(offset):
    """Eyring curves of two parameters: an offset of 100 % of the least f bends the fit, to within 9 % of the points."""
    slips = np.array([5e-4, 1.05e-3, 2.19e-3, 4.57e-3, 9.56e-3, 0.02, 0.04, 0.08, 0.15, 0.3, 0.5])

    def curve(slip, stress, slope):
        return stress * np.arcsinh(slip / slope)

    noise = 1 + 0.01 * np.random.default_rng(3).standard_normal(11)
    measured = curve(slips, 0.006, 5e-4) * noise + offset
    found, _ = curve_fit(curve, slips, measured, p0=(0.006, 5e-4), sigma=measured)
    f = curve(slips, *found)
    steps = [(curve(slips, *(found * change)) - f) / 0.001 for change in ([1.001, 1], [1, 1.001])]
    jacobian = np.stack(steps, axis=1) / f[:, None]
    tests = residual_tests(slips, 1 - measured / f, jacobian, np.zeros(11), stated=False, fitted=f, scale=f)
    assert tests.describes == (offset == 0.0) and not tests.too_far
    assert ("an offset of the measured f, of the order of 0.0" in tests.text) == (offset > 0.0)


def test_far_residuals_of_data_without_deviations_are_said_to_be():
    """Eleven points of a wave: not all of them far off, but some of them off by half of f."""
    slips = np.array([0.005, 0.01, 0.02, 0.03, 0.05, 0.08, 0.12, 0.2, 0.3, 0.4, 0.5])
    measured = lubfric.Measured(slips, 0.02 + 0.03 * np.sin(12 * slips) + 0.08 * slips, over="slide_roll_ratio")
    result = lubfric.fit(traction_scene(5e6, 0.5), measured, {STRESS: (1e6, 2e7)}, starts=0)
    relative = np.sqrt(np.mean((result.predicted / measured.coefficient - 1) ** 2))
    assert result.tests.relative == pytest.approx(relative) and relative > 0.15
    assert not result.describes_data and f"{100 * relative:.2g} % of f" in result.tests.text


@pytest.mark.parametrize("relative, expected, far", [(0.08, 0.0, False), (0.2, 0.0, True), (0.2, 0.25, False)])
def test_the_model_form_error_excuses_residuals_as_large(relative, expected, far):
    x = np.linspace(0, 1, 8)
    residuals = relative * np.array([1, -1, 1, 1, -1, -1, 1, -1])
    known = {"relative": relative, "expected": expected}
    assert residual_tests(x, residuals, np.ones((8, 1)), np.zeros(8), stated=False, **known).too_far is far
    assert not residual_tests(x, residuals, np.ones((8, 1)), np.zeros(8), stated=True, **known).too_far


class Valleys:
    """Residuals of one parameter, least at 0.2; ``second``: a second minimum at 0.8, else a flat valley."""

    def __init__(self, second):
        self.second = second

    def residuals(self, unit):
        x = unit[0]
        return np.array([1.0, 0.4 * np.abs(np.sin((x - 0.2) * np.pi / 0.6)) if self.second else 0.3 * (x - 0.2)])


@pytest.mark.parametrize("second", [True, False])
def test_minima_are_apart_where_larger_residuals_part_them(second):
    lowest, *others = search_minima(Valleys(second), np.array([0.5]), 8)
    assert lowest.unit[0] == pytest.approx(0.2, abs=0.06) or second
    assert any(abs(other.unit[0] - lowest.unit[0]) > 0.5 and other.is_separate for other in others) == second
    assert others and (second or not any(other.is_separate for other in others))
