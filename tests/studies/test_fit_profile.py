"""Parameters that f does not change with at a fit are followed to their bounds: limits of the interval on one side, and
smaller residuals beyond an edge of f."""

import numpy as np
import pytest

import lubfric
from lubfric.errors import Report
from lubfric.studies import (
    Between,
    Candidate,
    FitResult,
    are_parted,
    confirmed_ends,
    flat_parameters,
    follow,
    loose_parameters,
    with_minimum,
)
from lubfric.studies.fit_profile import Profile

# Slip of the points: f rises with its logarithm, up to a limit.
LOGARITHM = np.linspace(0.0, 1.0, 12)

# Student's t at 97.5 % with 10 degrees of freedom.
STUDENT = 2.2281


class Limited:
    """Curves f = min(a (1 + slip), b), a and b between 0 and 1, with the residuals relative to ``measured``."""

    def __init__(self, measured, unsolved_below=-1.0):
        self.measured = measured
        self.unsolved_below = unsolved_below
        self.count = 0

    def coefficient(self, unit):
        if unit[1] < self.unsolved_below:
            raise lubfric.ConvergenceError("no film", None, None)
        self.count += 1
        return np.minimum(unit[0] * (1 + LOGARITHM), unit[1])

    def residuals(self, unit):
        return (self.coefficient(unit) - self.measured) / self.measured


def followed(curves, a, b, scatter):
    """Return the profile of the limit from a fit at (a, b), where no point reaches it."""
    unit = np.array([a, b])
    jacobian = np.stack([(1 + LOGARITHM) / curves.measured, np.zeros(12)], axis=1)
    assert flat_parameters(jacobian, scatter**2, STUDENT) == [1]
    return follow(curves, unit, jacobian, place=1, variance=scatter**2, student=STUDENT)


class Saturating:
    """Residuals a + (s(b) - s(0.4)) (w + 1) - 0.3 of a and b between 0 and 1, with w of length 1 and mean 0. Refitting
    a takes off the mean: the profile of the sum of squares over b is (s(b) - s(0.4))² + const."""

    FIT = np.array([0.3, 0.4])

    def __init__(self, rate):
        self.rate = rate
        self.count = 0

    def s(self, b):
        return (1.0 - np.exp(-self.rate * b)) / self.rate if self.rate else b

    def b(self, s):
        return -np.log(1.0 - self.rate * s) / self.rate if self.rate else s

    def residuals(self, unit):
        self.count += 1
        w = np.linspace(-1.0, 1.0, 12) / np.linalg.norm(np.linspace(-1.0, 1.0, 12))
        noise = 1e-3 * np.abs(w) - 1e-3 * np.abs(w).mean()
        return unit[0] - 0.3 + (self.s(unit[1]) - self.s(0.4)) * (w + 1.0) + noise

    def interval(self, limit, place=1):
        """The interval of b (or a), and the number of curves that it took, where s may move by ``limit``."""
        variance = (limit / STUDENT) ** 2
        moves = np.eye(2) * 1e-6
        columns = [(self.residuals(self.FIT + move) - self.residuals(self.FIT)) / 1e-6 for move in moves]
        jacobian = np.stack(columns, axis=1)
        covariance = variance * np.linalg.inv(jacobian.T @ jacobian)
        assert place in loose_parameters(covariance, STUDENT) and not flat_parameters(jacobian, variance, STUDENT)
        self.count = 0
        profile = confirmed_ends(self, self.FIT, jacobian, covariance, place=place, variance=variance, student=STUDENT)
        assert profile.better is None and not profile.is_flat
        return (profile.low, profile.high), self.count


def test_the_interval_of_a_linear_parameter_is_that_of_its_slope_and_takes_two_curves():
    ends, curves = Saturating(0.0).interval(0.2)
    assert ends == pytest.approx((0.2, 0.6), abs=1e-4)
    assert curves == 3  # with the one at the fit, which is known


@pytest.mark.parametrize(("rate", "limit"), [(2.0, 0.1), (-2.0, 0.2), (4.0, 0.035)])
def test_the_ends_of_a_saturating_parameter_are_those_of_its_profile(rate, limit):
    curves = Saturating(rate)
    exact = [curves.b(curves.s(0.4) + side * limit) for side in (-1, 1)]
    ends, count = curves.interval(limit)
    assert 0.0 < exact[0] and exact[1] < 1.0
    assert ends == pytest.approx(exact, abs=0.02) and count <= 8


def test_a_parameter_in_which_f_is_linear_has_the_ends_of_its_profile_beside_one_that_saturates():
    """12 (a - 0.3 + s)² + s² is least at s = -12 (a - 0.3)/13, where it is 12/13 (a - 0.3)²; b moves to there."""
    (ends, count) = Saturating(2.0).interval(0.1, place=0)
    reach = 0.1 * np.sqrt(13 / 12)
    assert ends == pytest.approx((0.3 - reach, 0.3 + reach), abs=5e-3) and count <= 8


def test_a_parameter_that_saturates_within_its_limit_has_no_upper_end():
    """The slope at the fit ends the interval at 0.64; at the bound the root of the sum is 0.96 of its limit."""
    curves = Saturating(4.0)
    limit = (curves.s(1.0) - curves.s(0.4)) / 0.96
    assert 0.4 + limit * np.exp(4.0 * 0.4) < 0.7
    (low, high), count = curves.interval(limit)
    assert high == 1.0 and low == pytest.approx(curves.b(curves.s(0.4) - limit), abs=0.02) and count <= 8


def test_an_edge_beyond_which_the_residuals_are_smaller_is_found():
    """The limit of the data lowers the last points by 4 %; from above it the fit sees a flat parameter."""
    curves = Limited(np.minimum(0.25 * (1 + LOGARITHM), 0.48) * (1 + 0.005 * np.cos(40 * LOGARITHM)))
    a = 0.248
    profile = followed(curves, a, 0.85, 0.01)
    assert profile.better is not None and curves.count < 24
    sums = [np.sum(curves.residuals(unit) ** 2) for unit in (profile.better, np.array([a, 0.85]))]
    assert sums[0] < 0.6 * sums[1] and 0.45 < profile.better[1] < 0.5


@pytest.mark.parametrize("scatter", [0.01, 0.03])
def test_the_interval_of_a_limit_that_is_not_reached_has_one_end(scatter):
    """The end is that of the exact profile: the least sum over a at each b, on a dense grid."""
    curves = Limited(0.25 * (1 + LOGARITHM) * (1 - 0.01 * np.cos(40 * LOGARITHM)))
    weights = (1 + LOGARITHM) / curves.measured
    a = float(np.sum(weights) / np.sum(weights**2))
    profile = followed(curves, a, 0.85, scatter)
    assert profile.better is None and profile.high == 1.0 and profile.change == 0.0
    least = np.sum(curves.residuals(np.array([a, 0.85])) ** 2)
    trials = np.linspace(0.9, 1.3, 401)[:, None, None] * a
    ends = np.linspace(0.3, 0.55, 251)
    f = np.minimum(trials * (1 + LOGARITHM), ends[:, None])
    sums = np.sum((f / curves.measured - 1.0) ** 2, axis=2).min(axis=0)
    exact = ends[np.flatnonzero(sums <= least + STUDENT**2 * scatter**2)[0]]
    assert profile.low == pytest.approx(exact, abs=0.01)


def test_what_changes_f_less_than_its_scatter_is_not_determined():
    curves = Limited(np.full(12, 0.1) * (1 + LOGARITHM) * (1 + 0.3 * np.cos(40 * LOGARITHM)))
    profile = followed(curves, 0.1, 0.6, 3.0)
    assert (profile.low, profile.high, profile.better) == (0.0, 1.0, None)
    assert profile.change == 1.0  # a limit of 0 leaves no f


def test_a_bound_that_cannot_be_solved_is_not_taken_for_a_limit():
    curves = Limited(0.25 * (1 + LOGARITHM), unsolved_below=0.7)
    profile = followed(curves, 0.25, 0.85, 0.01)
    assert profile.low == 0.0 and np.isnan(profile.change) and profile.better is None


def test_a_minimum_on_the_same_flat_is_not_another_one():
    """The interpolation of a curve with an edge has humps where the curve has none."""
    curves = Limited(np.minimum(0.25 * (1 + LOGARITHM), 0.48) * (1 + 0.04 * np.cos(40 * LOGARITHM)))
    places = [np.array([a, b]) for a in (0.05, 0.25, 0.5, 0.75, 0.95) for b in (0.05, 0.3, 0.47, 0.7, 0.95)]
    residuals = [curves.residuals(unit) for unit in places]
    flat = [Candidate(np.array([0.25, b]), 0.035) for b in (0.6, 0.95)]
    assert not are_parted(curves, flat[0], flat[1], units=places, residuals=residuals)
    parted = Candidate(np.array([0.1, 0.9]), 0.036, is_separate=True)
    lowest, *others = with_minimum(curves, [*flat, parted], np.array([0.25, 0.48]))
    assert (
        lowest.unit[1] == 0.48
        and lowest.misfit < 0.035
        and [each.is_separate for each in others] == [False, False, True]
    )


def test_a_parameter_that_the_data_do_not_determine_does_not_look_determined_in_its_file(tmp_path):
    """Of two parameters f does not change with the second."""
    x = np.array([0.01, 0.02, 0.04, 0.08])
    result = FitResult(
        base=lubfric.load_scene("paper"),
        measured=lubfric.Measured(x, np.full(4, 0.1)),
        parameters={
            "bodies.boundary_friction_coefficient": Between(low=0.05, high=0.15, scale="linear"),
            "surface.sq": Between(low=1e-8, high=1e-6, scale="log"),
        },
        unit=np.array([0.5, 0.5]),
        unit_covariance=np.diag([1e-6, 1e3]),
        predicted=np.full(4, 0.1),
        slopes=np.stack([np.full(4, 0.1), np.zeros(4)], axis=1),
        report=Report("fit", "converged", iterations=1, residual=0.0, tolerance=1.0),
    )
    assert result.undetermined == ("surface.sq",)
    (tmp_path / "fitted.toml").write_text(result.to_toml(), encoding="utf-8")
    head = result.to_toml().partition("\n\n")[0].splitlines()
    (friction, roughness) = head[1:]
    assert "boundary_friction_coefficient: fitted, 0.1, 95 % interval 0.099" in friction and "NOT" not in friction
    assert "surface.sq: NOT DETERMINED by the data. Any value from 10 nm to 1 µm fits" in roughness
    assert lubfric.load_scene(tmp_path / "fitted.toml") == result.scene


def test_a_parameter_with_one_limit_is_not_determined_on_the_other_side():
    """f does not change with the limit at the fit: every value above 0.3 of its bounds fits. f_b ends at its upper
    bound."""
    x = np.array([0.01, 0.02, 0.04, 0.08])
    limit = "lubricant.limiting_stress_coefficient"
    friction = "bodies.boundary_friction_coefficient"
    scene = lubfric.load_scene("paper").with_(lubricant={"limiting_stress_coefficient": 0.06})
    result = FitResult(
        base=scene,
        measured=lubfric.Measured(x, np.full(4, 0.1)),
        parameters={
            friction: Between(low=0.05, high=0.15, scale="linear"),
            limit: Between(low=0.02, high=0.12, scale="linear"),
        },
        unit=np.array([0.99, 0.7]),
        unit_covariance=np.diag([1e-5, 1e3]),
        predicted=np.full(4, 0.1),
        slopes=np.stack([np.full(4, 0.1), np.zeros(4)], axis=1),
        report=Report("fit", "converged", iterations=1, residual=0.0, tolerance=1.0),
        profiles={limit: Profile(low=0.3, high=1.0, change=0.0)},
    )
    assert result.undetermined == () and result.undetermined_sides == {friction: ("above",), limit: ("above",)}
    (of_friction, of_limit) = result.to_toml().partition("\n\n")[0].splitlines()[1:]
    text = "f does not change with it at 0.09, and every value from 0.05 to its bound 0.12 fits as well"
    assert text in of_limit and text in result.explain() and "0.15 is its bound" in of_friction
    lines = [line for line in result.explain().splitlines() if " = " in line]
    assert all(line.endswith("(not determined above)") for line in lines) and len(lines) == 2


def test_a_wide_interval_without_an_upper_end_is_reported_as_at_least():
    """f changes with the Eyring stress at the fit, and saturates in it."""
    stress = "lubricant.eyring_stress"
    friction = "bodies.boundary_friction_coefficient"
    x = np.array([0.01, 0.02, 0.04, 0.08])
    result = FitResult(
        base=lubfric.load_scene("paper").with_(lubricant={"eyring_stress": 2e6}),
        measured=lubfric.Measured(x, np.full(4, 0.1)),
        parameters={
            friction: Between(low=0.05, high=0.15, scale="linear"),
            stress: Between(low=1e6, high=1e8, scale="log"),
        },
        unit=np.array([0.5, 0.3]),
        unit_covariance=np.diag([1e-5, 1e-3]),
        predicted=np.full(4, 0.1),
        slopes=np.array([[0.1, 0.01], [0.1, 0.02], [0.1, 0.03], [0.1, 0.0]]),
        report=Report("fit", "converged", iterations=1, residual=0.0, tolerance=1.0),
        profiles={stress: Profile(low=0.25, high=1.0, change=np.nan, is_flat=False)},
    )
    assert result.undetermined_sides == {stress: ("above",)} and result.intervals[stress][1] == pytest.approx(1e8)
    assert result.effects[stress] == pytest.approx(0.3)
    assert "it is at least 3.162 MPa" in result.to_toml() and "(not determined above)" in result.explain()
