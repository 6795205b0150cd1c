"""What a fit tells of its certainty: no narrower than Student's and Fisher's tables say, nor than the deviations and
the numerical error of f allow."""

import math

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.errors import CONVERGED, Report
from lubfric.studies import FitResult
from lubfric.studies.fit_input import parameters_of

KEY = "bodies.boundary_friction_coefficient"
OTHER = "lubricant.viscosity"
SCENE = paper_scene(surface={"sq": 0.0})
T_975 = {3: 3.1824, 5: 2.5706, 10: 2.2281}


def result(freedom, spread=0.01):
    """A fit of two parameters with standard deviations of ``spread`` and 3 ``spread`` of their bounds."""
    n = freedom + 2
    measured = lubfric.Measured(np.linspace(1, 2, n), np.full(n, 0.1))
    return FitResult(
        base=SCENE,
        measured=measured,
        parameters=parameters_of(SCENE, {KEY: (0.0, 0.2), OTHER: (0.1, 0.5)}),
        unit=np.array([0.5, 0.5]),
        unit_covariance=np.diag([spread**2, 9 * spread**2]),
        predicted=np.full(n, 0.1),
        slopes=np.tile([0.02, 0.0], (n, 1)),
        report=Report("fit", CONVERGED, iterations=1, residual=0.0, tolerance=1.0),
    )


@pytest.mark.parametrize("freedom", T_975)
def test_intervals_are_those_of_the_tables(freedom):
    solution = result(freedom)
    low, high = solution.intervals[KEY]
    assert (low, high) == pytest.approx((0.1 - T_975[freedom] * 0.002, 0.1 + T_975[freedom] * 0.002), rel=1e-4)
    low, high = solution.intervals[OTHER]
    assert (high - low) / 2 == pytest.approx(T_975[freedom] * 0.03 * 0.4, rel=1e-4)
    below, above = solution.band
    np.testing.assert_allclose((above - below) / 2, T_975[freedom] * 0.02 * 0.01, rtol=1e-4)


def test_what_the_data_do_not_determine_is_as_wide_as_its_bounds():
    wide = result(5, spread=0.07)  # 2.57 x 0.07 is less than half of the bounds, 2.57 x 0.21 more
    assert wide.undetermined == (OTHER,)


SPEEDS = np.array([1.0, 1.5, 2.0, 3.0])  # a full film: f goes with the viscosity


@pytest.fixture(scope="module")
def curve():
    return lubfric.stribeck(SCENE, SPEEDS).coefficient


def test_a_deviation_is_a_weight_and_a_width(curve):
    """Three points near the truth; one far off that says how far it may be. Without the word it pulls."""
    off = curve * np.array([1.0, 1.0, 1.0, 1.3])
    stated = curve * np.array([0.01, 0.01, 0.01, 0.5])
    bounds = {OTHER: (0.2, 0.6)}
    reported = lubfric.fit(SCENE, lubfric.Measured(SPEEDS, off, deviation=stated), bounds, starts=0)
    blind = lubfric.fit(SCENE, lubfric.Measured(SPEEDS, off), bounds, starts=0)
    assert abs(reported.values[OTHER] / 0.36 - 1) < 0.01 < abs(blind.values[OTHER] / 0.36 - 1)
    # df/f = q d eta/eta: three points of 1 %, 0.58 % together, and at least that over q < 1 in the viscosity
    width = reported.deviations[OTHER] / reported.values[OTHER]
    assert 0.0058 < width < 0.015
    wider = lubfric.fit(SCENE, lubfric.Measured(SPEEDS, off, deviation=3 * stated), bounds, starts=0)
    assert wider.deviations[OTHER] == pytest.approx(3 * reported.deviations[OTHER], rel=0.1)


def test_data_without_scatter_are_not_surer_than_the_solver(curve):
    """The interval is no narrower than the numerical error of f, though the points lie on the curve."""
    result = lubfric.fit(SCENE, lubfric.Measured(SPEEDS, curve), {OTHER: (0.2, 0.6)}, starts=0)
    point = lubfric.friction(SCENE.with_(numerics={"tolerance": 0.01}), 2.0)
    low, high = result.intervals[OTHER]
    assert low < 0.36 < high
    assert result.deviations[OTHER] / 0.36 > 0.3 * point.uncertainty.numerical / math.sqrt(SPEEDS.size) > 0
