"""The curve between its points: known curves come back, the knee is found, few solves, resume, what is refused."""

import itertools
import warnings
from dataclasses import replace

import numpy as np
import pytest
from small_study import SCENE

import lubfric
from lubfric.studies import Interpolant, Samples, knee_of, span
from lubfric.studies.choose import between, next_speed

FIRST = np.geomspace(1e-4, 1.0, 5)


class Made:
    """A curve in closed form: contact share (1 - (U/U0)^a)^(3/2), a film whose traction coefficient is constant in
    contact and a power of U beyond, summits of 3 Sq."""

    def __init__(self, lift_off, exponent, friction=0.1):
        self.lift_off = lift_off
        self.exponent = exponent
        self.friction = friction

    def share(self, speed):
        return np.maximum(1 - (speed / self.lift_off) ** self.exponent, 0.0) ** 1.5

    def at(self, speed):
        traction = 0.012 * (1 + (speed / self.lift_off) ** 3) ** 0.15
        return self.friction * self.share(speed), traction * (1 - self.share(speed))

    def samples(self, speeds):
        speeds = np.sort(speeds)
        film = 3.0 * (speeds / self.lift_off) ** 0.65
        share = self.share(speeds)
        clearance = np.where(share > 0, np.nan, film - 3.0)
        boundary, of_film = self.at(speeds)
        return Samples(
            speed=speeds,
            share=share,
            boundary=boundary,
            film=of_film,
            thickness=film,
            clearance=clearance,
            steepness=self.steepness(speeds),
            numerical=np.zeros(speeds.size),
        )

    def through(self, speeds):
        """The interpolated curve through points at ``speeds``."""
        samples = self.samples(speeds)
        return Interpolant(samples, knee_of(samples))

    def steepness(self, speeds):
        """d ln((1 - share)/share)/d ln U = -d ln(share)/d ln U/(1 - share); NaN without contact."""
        share = self.share(speeds)
        power = (speeds / self.lift_off) ** self.exponent
        with np.errstate(divide="ignore", invalid="ignore"):
            steep = 1.5 * self.exponent * power / ((1 - power) * (1 - share))
        return np.where((share > 0) & (share < 1), steep, np.nan)


# Each exponent and each lift-off speed with each tolerance; the other combinations are slow.
PAIRED = {
    (0.01, 0.8, 0.4),
    (0.01, 1.0, 0.003),
    (0.01, 1.2, 0.05),
    (0.05, 0.8, 0.05),
    (0.05, 1.0, 0.4),
    (0.05, 1.2, 0.003),
}


@pytest.mark.parametrize(
    "tolerance, exponent, lift_off",
    [
        pytest.param(*values, marks=[pytest.mark.slow] * (values not in PAIRED))
        for values in itertools.product((0.01, 0.05), (0.8, 1.0, 1.2), (0.003, 0.05, 0.4))
    ],
)
def test_a_known_curve_is_found_within_the_tolerance_from_few_points(lift_off, exponent, tolerance):
    curve = Made(lift_off, exponent)
    speeds = [1e-4, *(lift_off * np.array([0.1, 0.45, 1.6])), 1.0]
    while len(speeds) < 25:
        interpolant = curve.through(np.array(speeds))
        speed = next_speed(interpolant, tolerance)
        error = between(interpolant)
        if speed is None:
            break
        assert 1e-4 < speed < 1.0 and min(abs(np.log(speed / np.array(speeds)))) > 0.01
        speeds.append(speed)
    result = curve.through(np.array(speeds))
    at = np.geomspace(1e-4, 1.0, 2000)
    true = sum(curve.at(at))
    assert np.abs(result.at(at) / true - 1).max() <= tolerance
    assert result.lift_off == pytest.approx(lift_off, rel=0.01) and error <= tolerance
    assert result.lift_off_range[0] <= lift_off <= result.lift_off_range[1]
    assert len(speeds) <= (14 if tolerance == 0.01 else 11)


@pytest.mark.parametrize("ratio", [1.3, 1.9, 2.2, 10.0])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_lift_off_is_stated_where_the_solved_speeds_around_it_are_near(ratio, sense):
    """A decade apart they enclose it, and say nothing of where it lies between them."""
    curve = Made(0.05, 0.8)
    low = 0.05 / ratio**0.7
    samples = curve.samples(np.array([1e-3, 3e-3, low, ratio * low, 3.0]))
    result = Interpolant(samples, knee_of(samples), sense=sense)
    if ratio > 2:
        assert np.isnan(result.lifted) and result.lift_off_range == pytest.approx((low, ratio * low))
    else:
        assert result.lifted == pytest.approx(sense * 0.05, rel=0.05)
        assert low < result.lift_off_range[0] <= 0.05 <= result.lift_off_range[1] < ratio * low


def test_far_points_of_a_film_that_almost_vanishes_give_f_between_theirs():
    """The film's traction falls by 40 decades from one point to the next, and rises again."""
    samples = Samples(
        speed=np.array([1e-3, 1.0, 1.001, 1e3]),
        share=np.array([0.9, 0.6, 0.5, 0.4]),
        boundary=np.array([0.09, 0.06, 0.05, 0.04]),
        film=np.array([1e-3, 1e-3, 1e-43, 1e-3]),
        thickness=np.ones(4),
        clearance=np.full(4, np.nan),
        steepness=np.full(4, np.nan),
        numerical=np.zeros(4),
    )
    result = Interpolant(samples, None)
    at = np.geomspace(1e-3, 1e3, 50)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        error = result.error(at)
    f = result.at(at)
    assert np.isfinite(error).all() and f.min() >= 0.04 and f.max() <= 0.1


@pytest.mark.parametrize("lift_off", [1e-6, 100.0])
def test_curves_without_a_knee(lift_off):
    curve = Made(lift_off, 0.8)
    speeds = list(FIRST)
    while (speed := next_speed(curve.through(np.array(speeds)), 0.01)) is not None:
        speeds.append(speed)
    result = curve.through(np.array(speeds))
    at = np.geomspace(1e-4, 1.0, 500)
    assert result.lift_off is None and len(speeds) <= 11
    np.testing.assert_allclose(result.at(at), sum(curve.at(at)), rtol=0.01)


@pytest.mark.parametrize("beyond", [0.99, 1.0, 1.001, 1.1])
def test_contact_at_speeds_beyond_the_knee_that_the_clearance_tells(beyond):
    """On lines of different lengths a longer one may still touch where a shorter one is clear."""
    curve = Made(0.05, 0.8)
    speeds = np.sort([*FIRST, 0.03, 0.045, 0.05 * beyond, 0.06, 0.08])
    samples = curve.samples(speeds)
    touching = speeds <= 0.05 * beyond
    share = np.where(touching, np.maximum(samples.share, 1e-5), 0.0)
    samples = replace(samples, share=share, boundary=0.1 * share)
    result = Interpolant(samples, knee_of(samples))
    at = np.geomspace(1e-4, 1.0, 2000)
    assert 0.05 * beyond < result.lift_off < 0.06
    np.testing.assert_allclose(result.at(at), sum(curve.at(at)), rtol=0.1)
    assert np.isfinite(result.error(at)).all()


@pytest.fixture(scope="module")
def auto():
    return lubfric.stribeck(SCENE, "auto", tolerance=0.01)


def test_an_adaptive_curve_is_that_of_many_solves(auto):
    assert auto.report.converged and auto.speed.size <= 16 and auto.report.residual <= 0.01
    assert auto.speed[0] == pytest.approx(SCENE.motion.speeds[0]) and auto.speed[-1] == pytest.approx(1.0)
    speeds = np.sort(np.append(np.geomspace(1.1e-4, 0.9, 8), auto.lift_off * np.array([0.9, 0.97, 1.02])))
    direct = lubfric.stribeck(SCENE, speeds, tolerance=2e-3)
    np.testing.assert_allclose(auto.at(speeds), direct.coefficient, rtol=0.01)
    minimum = auto.minimum
    assert auto.at(minimum.speed) == pytest.approx(minimum.coefficient)
    assert minimum.coefficient <= auto.coefficient.min() * 1.001
    (line,) = (line for line in auto.plot().lines if line.get_label() == "friction coefficient")
    np.testing.assert_allclose(line.get_ydata(), auto.at(line.get_xdata()))
    assert direct.contact_load[speeds < auto.lift_off][-1] > 0 == direct.contact_load[speeds > auto.lift_off][0]


@pytest.mark.parametrize("asked", [0.02, -0.02])
def test_fields_of_an_adaptive_curve(asked):
    curve = lubfric.stribeck(SCENE.with_(numerics={"tolerance": 0.1}), "auto", fields=[asked])
    (kept,) = [p for p in curve.points if p.balance is not None]
    assert kept.speed == 0.02 and kept.pressure.shape == (48, 48)


def test_the_range_where_a_scene_has_no_speeds():
    scene = SCENE.with_(motion={"speeds": ()})
    low, high = span(scene, lubfric.prepare(scene).surface.sq)
    ends = lubfric.stribeck(scene, [low, high])
    assert ends.coefficient[0] == pytest.approx(0.09, rel=0.02)
    assert 5 < ends.film_to_roughness_ratio[1] < 12 and ends.contact_load[1] == 0
    with pytest.raises(lubfric.InputError, match="speed_range"):
        span(scene, 0.0)


def test_a_curve_is_that_of_its_own_direction(auto):
    """The patch slides otherwise back than forth."""
    there, back = (lubfric.friction(SCENE, sense * 0.035).coefficient for sense in (1, -1))
    assert abs(back / there - 1) > 0.005
    with pytest.raises(lubfric.InputError, match="allowed: 0.0001 to 1 m/s"):
        auto.at(-0.035)
    reverse = lubfric.stribeck(SCENE, [-0.03, -0.035, -0.04])
    assert reverse.at(-0.035) == pytest.approx(back, rel=0.003)
    with pytest.raises(lubfric.InputError, match="allowed: -0.04 to -0.03 m/s"):
        reverse.at(0.035)
    with pytest.raises(lubfric.InputError, match="both ways"):
        lubfric.stribeck(SCENE, [-0.03, 0.035, 0.04]).at(0.035)
    study = lubfric.study(SCENE, {"bodies.load": [5.5]}, [-0.03, -0.035, -0.04])
    assert np.isnan(study.at(0.035)[0]) and study.at(-0.035)[0] == pytest.approx(back, rel=0.003)
    assert np.isnan(lubfric.study(SCENE, {"bodies.load": [5.5]}, [-0.03, 0.035, 0.04]).at(0.035)[0])


def test_what_an_interpolation_refuses(auto):
    for speed in (1e-5, 2.0, [0.1, 3.0]):
        with pytest.raises(lubfric.InputError, match="where the curve is known"):
            auto.at(speed)
    with pytest.raises(lubfric.InputError, match="2 speeds are solved"):
        lubfric.stribeck(SCENE, [0.1, 0.2]).at(0.15)
    with pytest.raises(lubfric.InputError, match="fields"):
        lubfric.stribeck(SCENE, "auto", fields=True)
    assert np.shape(auto.at(0.1)) == () and auto.at([0.1, 0.2]).shape == (2,)
