"""The largest f that the limits of the shear stress allow."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

import lubfric
from lubfric.estimate import interval, uncertainty_of
from lubfric.models.load_sharing import PaperModel, largest_film_load_ratio
from lubfric.models.shared import beside_asperities, largest_of_oil, largest_sliding_friction, peak_hertz_pressure

PAPER = lubfric.load_scene("paper")


def oil(**keys):
    return PAPER.with_(lubricant=keys).lubricant


@given(st.floats(0.02, 0.2), st.floats(1e7, 2e9), st.floats(1e-4, 10.0))
def test_a_newtonian_oil_carries_f_b_or_the_most_that_oils_carry(friction, peak, sliding):
    assert largest_of_oil(oil(), friction, peak, sliding, 1e-8) == max(friction, 0.10)
    stated = oil(limiting_stress_coefficient="f_b")
    assert largest_of_oil(stated, friction, peak, sliding, 1e-8) == friction


@given(st.floats(0.02, 0.2), st.floats(0.03, 0.12), st.floats(1e8, 2e9))
def test_an_oil_with_a_limit_carries_the_larger_of_both_at_its_limit(friction, limit, peak):
    """Sheared so fast that all but the lowest pressures are at the limit."""
    most = largest_of_oil(oil(limiting_stress_coefficient=limit, limiting_stress_offset=0.0), friction, peak, 1e3, 1e-8)
    assert most == pytest.approx(max(friction, limit), rel=2e-3)


@pytest.mark.parametrize("stress", [5e6, 2e7, 1e8])
def test_an_eyring_film_by_quadrature(stress):
    """Over the Hertz pressure, by scipy; above the mean pressure the ratio of an Eyring stress to the pressure has its
    largest value somewhere, here on 1e5 pressures."""
    lubricant = oil(eyring_stress=stress, viscosity_law="barus", viscosity=0.02, pressure_viscosity_coefficient=1e-8)
    (friction, peak, sliding, film) = (0.1, 6e8, 0.05, 1e-8)

    def of_oil(p):
        return stress * np.arcsinh(0.02 * np.exp(1e-8 * p) * sliding / film / stress)

    def both(x):
        p = peak * math.sqrt(1 - x * x)
        return max(of_oil(p), friction * p)

    mean = quad(both, -1, 1, limit=400)[0] / (peak * math.pi / 2)
    higher = np.geomspace(math.pi / 4 * peak, 3e9, 100_000)
    ratio = float(np.max(of_oil(higher) / higher))
    most = largest_of_oil(lubricant, friction, peak, sliding, film)
    assert most == pytest.approx(max(mean, ratio), rel=5e-3)


def test_ranges_count_with_their_largest_end_and_pure_rolling_has_no_bound():
    scene = PAPER.with_(bodies={"boundary_friction_coefficient": [0.11, 0.08, 0.14]})
    assert largest_sliding_friction(scene, 0.01) == 0.14
    assert largest_sliding_friction(scene.with_(motion={"slide_roll_ratio": 0.0}), 0.01) == math.inf
    limited = scene.with_(lubricant={"limiting_stress_coefficient": [0.12, 0.10, 0.16]})
    expected = largest_of_oil(oil(limiting_stress_coefficient=0.16), 0.14, peak_hertz_pressure(scene), 0.02, 1e-8)
    assert largest_sliding_friction(limited, 0.01) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("model", ["paper", "quick"])
def test_no_interval_reaches_beyond_f_b_where_asperities_carry_nearly_all(model):
    """The film hardly moves: f is f_b, and its upper end the upper end of f_b's range, with the sentence that says
    why."""
    scene = PAPER.with_(
        bodies={"boundary_friction_coefficient": [0.11, 0.08, 0.14]},
        numerics={"model": model, "sampling_tolerance": 0.2, "tolerance": 0.1},
        lubricant={"limiting_stress_coefficient": "f_b"},
    )
    result = lubfric.friction(scene, 0.002)
    assert 0.9 < result.coefficient / 0.11 <= 1.0001
    rolling = 16 * abs(result.rolling_force) / scene.bodies.load
    assert result.uncertainty.interval[1] <= 0.14 + rolling
    assert result.uncertainty.interval[0] < 0.085
    reaches = (
        result.coefficient * (1 + math.hypot(result.uncertainty.model, result.uncertainty.inputs)) > 0.14 + rolling
    )
    assert ("limits of the shear stress" in result.uncertainty.text) == reaches


@pytest.mark.parametrize(("limit", "numerical"), [(None, 5.0), (None, 0.01), (0.5, 5.0)])
def test_an_interval_above_f_b_says_that_the_oil_has_no_limit(limit, numerical):
    """A numerical error of f makes it reach there or not; with a limit of .5 it reaches there as well."""
    scene = PAPER.with_(lubricant={"eyring_stress": 5e7, "limiting_stress_coefficient": limit})
    prepared = lubfric.prepare(scene)
    solved = PaperModel().solve(prepared, prepared.sample, 1, 0.1).answer()
    known = uncertainty_of(prepared, replace(solved, errors=replace(solved.errors, numerical=numerical)))
    is_above = known.interval[1] > scene.bodies.boundary_friction_coefficient
    assert is_above == (numerical == 5.0)
    assert ("above the boundary friction" in known.text) == (is_above and limit is None)


@pytest.mark.parametrize(("numerical", "is_cut"), [(0.01, False), (50.0, True)])
def test_an_interval_says_where_it_is_cut(numerical, is_cut):
    """At the stress that the oil and f_b allow, and at the f whose sliding part is 0."""
    prepared = lubfric.prepare(PAPER)
    solved = PaperModel().solve(prepared, prepared.sample, 1, 0.03).answer()
    answer = replace(solved, errors=replace(solved.errors, numerical=numerical))
    errors = {"sampling_error": answer.errors.sampling_error, "model_error": answer.errors.model_error}
    low, high = interval(answer.numbers["coefficient"], numerical=numerical, **errors)
    known = uncertainty_of(prepared, answer)
    assert (known.interval[0] > low) == ("begins at the smallest f that resists the sliding" in known.text) == is_cut
    assert (known.interval[1] < high) == ("limits of the shear stress" in known.text) == is_cut
    f = answer.numbers["coefficient"]
    assert known.numerical == pytest.approx(max(known.interval[1] / f - 1, 1.0), rel=0.05) if is_cut else numerical
    if is_cut:
        (parts,) = re.findall(r"shear stress, ([0-9.e-]+) by sliding and ([0-9.e-]+) by rolling", known.text)
        assert sum(map(float, parts)) == pytest.approx(known.interval[1], rel=0.01)


@pytest.mark.parametrize(("friction", "f_b"), [(0.08, 0.08), ([0.08, 0.07, 0.1], 0.1)])
@pytest.mark.parametrize("speed", [0.002, 0.03])
def test_at_a_steady_point_only_the_load_of_the_film_may_rub_more_than_f_b(friction, f_b, speed):
    """An oil with a limit of 0.2 p: the asperities' part of the load has f_b, at the upper end of its range; the film
    takes the rest, and what the model-form error 0.7 sqrt(s (1 - s)) of their part adds to it."""
    scene = PAPER.with_(
        bodies={"boundary_friction_coefficient": friction},
        lubricant={"limiting_stress_coefficient": 0.2, "limiting_stress_offset": 1e4},
    )
    prepared = lubfric.prepare(scene)
    solved = PaperModel().solve(prepared, prepared.sample, 1, speed).answer()
    answer = replace(solved, errors=replace(solved.errors, numerical=50.0, model_error=(0.5, 50.0)))
    share = solved.numbers["contact_load"] / scene.bodies.load
    most = largest_sliding_friction(scene, speed)
    assert 0.2 <= most < 0.21
    ratio = min(solved.numbers["film_to_roughness_ratio"], 1.0)
    film = min(1 - share + max(0.7 * math.sqrt(share * (1 - share)), 0.1 * ratio), 1.0)
    rolling = abs(max(answer.rolling_ratios) * solved.numbers["rolling_force"] / scene.bodies.load)
    expected = f_b + (most - f_b) * film + rolling
    high = uncertainty_of(prepared, answer).interval[1]
    assert high == pytest.approx(expected, rel=1e-6)
    assert (film < 0.3) == (speed == 0.002)


@pytest.mark.parametrize(("share", "ratio", "film"), [(1.0, math.inf, 0.0), (0.0, 3.0, 1.0), (1.0, 0.5, 0.05)])
def test_without_a_film_f_is_at_most_f_b_and_without_asperities_that_of_the_film(share, ratio, film):
    assert largest_film_load_ratio(ratio, share) == pytest.approx(film)
    assert beside_asperities(0.2, 0.1, film) == pytest.approx(0.1 + 0.1 * film)
    assert beside_asperities(0.1, 0.1, film) == 0.1
    assert beside_asperities(math.inf, 0.1, film) == math.inf
