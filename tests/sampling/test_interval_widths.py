"""Errors that are told must not get smaller unnoticed: contact that a line misses, the scatter of another line, the
share of load sharing itself, against formulas written out from their sources."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scene_text import paper_scene
from scipy import ndimage

import lubfric
from lubfric.estimate import PARTS, Uncertainty, beside_larger_part, interval
from lubfric.models.load_sharing import (
    least_error,
    load_of_tail,
    load_sharing_error,
    load_sharing_error_parts,
    moment_model_error,
    summit_radius,
    undetected_load,
)
from lubfric.models.shared import (
    Assumption,
    ModelErrorPart,
    Sides,
    StandardError,
    Violation,
    add_errors,
    added_changes,
    below_and_above,
)
from lubfric.output import budget_bars
from lubfric.output.run_curve import _doubts
from lubfric.quantities import OF_UNCERTAINTY
from lubfric.time import PARTS_NOT_IN_TIME, errors_in_time
from verification.campaigns.calibration.table import rows as calibration_rows

E_PRIME = 2.3e11
WIDTH = 6e-3
RX = 40e-6
RY = 90e-6
SQ = 1e-7
T_975 = {1: 12.7062, 2: 4.3027, 5: 2.5706, 10: 2.2281, 30: 2.0423}  # of any table of Student's t


@pytest.mark.parametrize("freedom", T_975)
def test_an_interval_is_as_wide_as_students_table_says(freedom):
    low, high = interval(
        0.05, numerical=0.0, sampling_error=StandardError(0.01, freedom), model_error=(math.nan, math.nan)
    )
    assert (high - low) / 2 == pytest.approx(T_975[freedom] * 5e-4, rel=1e-4)
    low, high = interval(0.05, numerical=0.03, sampling_error=StandardError(0.01, freedom), model_error=(0.0, 0.0))
    assert (high - low) / 2 == pytest.approx(0.05 * math.hypot(0.03, 0.01 * T_975[freedom]), rel=1e-4)


def summits(heights, spacing=(1e-6, 2.5e-6), each=8):
    """A map on which every block of ``each`` rows has a paraboloid of radii RX and RY of the given height."""
    x = (np.arange(9) - 4) * spacing[0]
    y = (np.arange(each) - each // 2) * spacing[1]
    cap = -(x[:, None] ** 2) / (2 * RX) - y[None, :] ** 2 / (2 * RY)
    return np.concatenate([cap + height for height in heights], axis=1), spacing


def test_a_summit_is_as_round_as_its_paraboloid_on_cells_of_any_length():
    for spacing in ((1e-6, 2.5e-6), (2e-6, 0.7e-6)):
        assert summit_radius(*summits([0.0, 1e-8], spacing)) == pytest.approx(math.sqrt(RX * RY), rel=1e-6)


@pytest.mark.parametrize("count", [6, 40])
def test_the_contact_that_a_line_misses(count):
    """Gumbel's distribution by its first two moments; Hertz for a sphere pressed in by an excess of the scale's mean
    (exponential: 1.329 scale^1.5). Few blocks: twice the scale."""
    tops = 3e-8 * np.random.default_rng(count).gumbel(size=count)
    heights, spacing = summits(tops)
    length = 8 * spacing[1] / 1.75  # so that a block of 1.75 correlation lengths is one summit
    film = np.full(heights.shape[0], 1.5e-7)
    result = undetected_load(heights, spacing, thickness=film, e_prime=E_PRIME, width=WIDTH, correlation_length=length)
    scale = tops.std(ddof=1) * math.sqrt(6) / math.pi * (2 if count < 14 else 1)
    place = tops.mean() - 1.5e-7 - 0.5772 * scale
    touching = 1 - math.exp(-math.exp(place / scale))
    sphere = 4 / 3 * (E_PRIME / 2) * math.sqrt(math.sqrt(RX * RY)) * scale**1.5 * 1.3293
    assert result == pytest.approx(touching * sphere / (8 * spacing[1]) * WIDTH, rel=1e-3)


def test_the_load_on_the_tail_of_the_heights_is_that_of_the_summits_counted_above_a_film():
    """On 3,000 correlation lengths squared, at a film of 3 Sq: each summit by itself, as a sphere pressed in by its
    excess."""
    surface = lubfric.generate_surface((512, 512), 1e-6, sq=1e-7, correlation_length=8e-6, acf="gaussian", seed=2)
    z = surface.heights - surface.heights.mean()
    film = 3.0 * surface.sq
    labels, count = ndimage.label(z > film)
    excess = ndimage.maximum(z, labels, range(1, count + 1)) - film
    counted = np.sum(4 / 3 * (E_PRIME / 2) * math.sqrt(summit_radius(z, surface.spacing)) * excess**1.5)
    thickness = np.full(512, film)
    load = load_of_tail(surface, thickness=thickness, step=1e-6, e_prime=E_PRIME, width=surface.size[1])
    assert 1 / 3 < counted / load < 1.2  # at 3 Sq excesses are shorter than those of the asymptotic law
    assert (
        load_of_tail(surface, thickness=2 * thickness, step=1e-6, e_prime=E_PRIME, width=surface.size[1]) < 1e-4 * load
    )
    assert load_of_tail(surface, thickness=thickness / 6, step=1e-6, e_prime=E_PRIME, width=surface.size[1]) == math.inf


def test_the_error_of_load_sharing_itself_is_that_of_its_rule():
    """docs/uncertainty.md, by hand: a film of λ = 2, 4, 8 by .3, .2, .05 of its shear; half of the load on asperities
    with f_b .12 beside a film of .04: .35 of .08 exchanged, .3 of the film's .02, and .25 sqrt(.5) of f = .08; a tenth
    of the load: no more than that tenth can go to the film."""
    films = [load_sharing_error(ratio, share=0.0, boundary=0.0, shear=0.03) for ratio in (2.0, 4.0, 8.0)]
    assert np.array(films) == pytest.approx(np.array([[0.3, 0.3], [0.2, 0.2], [0.05, 0.05]]))
    down, up = load_sharing_error(1.0, share=0.5, boundary=0.06, shear=0.02)
    others = (0.35 * 0.08 + 0.3 * 0.02) / 0.08
    of_all = 0.25 * math.sqrt(0.5)
    assert (down, up) == pytest.approx((1 - (1 - others) * (1 - of_all), others + of_all))
    down, up = load_sharing_error(8.0, share=0.1, boundary=0.012, shear=0.0)
    of_all = 0.25 * math.sqrt(0.9)
    assert (down, up) == pytest.approx((1.0, 0.7 * 0.3 * 0.12 / 0.012 + of_all))
    down, up = load_sharing_error(
        8.0, share=0.9, boundary=0.009, shear=0.03
    )  # the film rubs more: its tenth may go to the asperities
    assert down == pytest.approx(1 - (1 - (0.1 * 0.29 + 0.05 * 0.03) / 0.039) * (1 - 0.25 * math.sqrt(0.1)))
    assert load_sharing_error(1.0, share=0.0, boundary=0.0, shear=4e-4, rolling=4e-4) == pytest.approx(
        (8.3, 8.3)
    )  # pure rolling
    assert load_sharing_error(30.0, share=0.0, boundary=0.0, shear=4e-4, rolling=4e-4) == pytest.approx(
        ((3.2 + 18) / 900,) * 2
    )
    assert load_sharing_error(1.0, share=1e-9, boundary=0.0, shear=4e-4, rolling=4e-4)[0] == pytest.approx(
        8.3, rel=1e-3
    )  # no less for a touch
    assert load_sharing_error(math.inf, share=0.0, boundary=0.0, shear=0.03) == (0.0, 0.0)
    assert max(load_sharing_error(0.1, share=0.99999, boundary=0.0899991, shear=1e-7)) < 3e-3


PARTS_OF_F = [(0.11, 0.03, 0.0), (0.11, 0.3, 0.0), (0.11, 0.002, -0.003), (0.0, 4e-4, 4e-4)]


@pytest.mark.parametrize("ratio", [0.3, 2.0, 6.0])
@pytest.mark.parametrize(("on_asperities", "on_film", "rolling"), PARTS_OF_F)
def test_the_error_of_load_sharing_has_no_step_and_is_the_same_in_both_senses(ratio, on_asperities, on_film, rolling):
    """In f itself over the larger friction of both parts, from no contact to all; the law is a square root at its ends,
    so steps of 1e-7 in the share move it by some 1e-4. -f has the sides of f."""
    largest = max(on_asperities, on_film)

    def ends(share, sense=1.0):
        boundary = sense * on_asperities * share
        shear = sense * (on_film + rolling) * (1 - share)
        flanks = sense * rolling * (1 - share)
        sides = load_sharing_error(ratio, share=share, boundary=boundary, shear=shear, rolling=flanks)
        f = boundary + shear
        return np.array([f - abs(f) * sides.below_and_above(f)[0], f + abs(f) * sides.below_and_above(f)[1]])

    shares = np.concatenate([[0.0], np.geomspace(1e-9, 0.5, 150), 1 - np.geomspace(1e-9, 0.5, 150)])
    steps = [np.abs(ends(min(share + 1e-7, 1.0)) - ends(share)) for share in shares]
    assert np.max(steps) < 1e-3 * largest
    for share in shares[::10]:
        np.testing.assert_allclose(ends(share, -1.0)[::-1], -ends(share), rtol=1e-12)
    assert least_error(ratio, 0.0) == 0.0 and least_error(ratio, 0.1) == 0.1 * min(ratio, 1.0)


def test_the_error_of_load_sharing_covers_what_it_was_measured_on():
    """Stored contacts of oils with a limit of their stress, solved by both models: from a tenth of the load on asperities
    the law in contact is that which was measured, 0.25 sqrt(1 - s) of f beside the other parts."""
    inside = []
    for motion in ("rest", "rolling"):
        for row in calibration_rows(motion):
            if row["failure"] or row["fluid"] == "newtonian":
                continue
            share, boundary, couette, rolling = (
                float(row[f"ls_{n}"]) for n in ("contact", "boundary", "couette", "rolling")
            )
            parts = {"share": share, "boundary": boundary, "shear": couette + rolling}
            moving = rolling if motion == "rolling" else 0.0
            sides = load_sharing_error(float(row["ls_lambda"]), rolling=moving, **parts)
            change = float(row["det_f"]) / (boundary + couette + rolling) - 1
            inside.append(-sides.towards <= change <= sides.away)
    assert len(inside) > 400 and np.mean(inside) > 0.92


def test_an_interval_has_two_sides_and_the_farther_one_lies_away_from_0():
    parts = {"numerical": 0.03, "sampling_error": StandardError(0.0, 30), "model_error": (0.04, 0.4)}
    assert interval(0.05, **parts) == pytest.approx((0.0475, 0.05 * (1 + math.hypot(0.03, 0.4))))
    assert interval(-0.05, **parts) == pytest.approx((-0.05 * (1 + math.hypot(0.03, 0.4)), -0.0475))


def test_freedom_of_a_sum_is_no_more_than_that_of_its_largest_part():
    """Welch and Satterthwaite: 9²/(8.1²/5 + .9²/50) = 6.2, cut to 6."""
    result = add_errors(StandardError(3 * math.sqrt(0.9), 5), StandardError(math.sqrt(0.9), 50))
    assert result.value == pytest.approx(3.0) and result.freedom == 6


@pytest.fixture(scope="module")
def point():
    scene = paper_scene(numerics={"sampling_tolerance": 0.2})
    return scene, lubfric.friction(scene, 0.01)


def test_the_parts_of_the_error_of_f_belong_together(point):
    """The interval from its parts; another line of the width B; and neither part is nothing."""
    scene, result = point
    stated = result.uncertainty
    t = 2.0 if stated.freedom >= 60 else 1.96  # no table has less
    half = (stated.interval[1] - stated.interval[0]) / 2 / result.coefficient
    assert half >= math.hypot(stated.numerical, t * stated.sampling) * 0.98
    assert stated.line_scatter == pytest.approx(stated.sampling * math.sqrt(stated.length / scene.bodies.width))
    assert result.errors.coefficient == pytest.approx(math.hypot(stated.numerical, stated.sampling))
    assert 1e-4 < stated.numerical < 0.01 and 0.01 < stated.sampling < 0.2


# how they are printed: one way for all, and never as if they included a model-form error that is not known

KNOWN = {"numerical": 0.001, "sampling": 0.01, "freedom": 30.0, "model": 0.05}
CASES = [
    (
        KNOWN,
        (0.045, 0.055),
        "f = 0.0500 (0.0450 to 0.0550 at 95 %); numerical 0.1 %, sampling 2 %, model-form 5 %",
    ),
    (
        KNOWN | {"inputs": 0.3},
        (0.035, 0.054),
        "f = 0.0500 (0.0350 to 0.0540 at 95 %); numerical 0.1 %, sampling 2 %, model-form 5 %, input 30 %",
    ),
    (
        KNOWN | {"model": 0.41, "model_sides": (0.29, 0.41), "inputs": 0.3, "input_sides": (0.3, 0.3)},
        (0.035, 0.071),
        "numerical 0.1 %, sampling 2 %, model-form -29 to +41 %, input 30 %",
    ),
    (KNOWN | {"model": 1e-7}, (0.049, 0.051), "model-form < 0.1 %"),
    (KNOWN | {"model": 4e-3, "model_sides": (0.0, 4e-3)}, (0.049, 0.051), "model-form 0 to +0.4 %"),
    (KNOWN | {"model": 4e-3, "model_sides": (4e-3, 1e-7)}, (0.049, 0.051), "model-form -0.4 to 0 %"),
    (KNOWN | {"inputs": math.nan}, (0.045, 0.055), "model-form 5 %, input not known"),
    (
        KNOWN | {"model": math.nan},
        (0.049, 0.051),
        "(0.04900 to 0.05100 at 95 %); numerical 0.1 %, sampling 2 %, model-form not known (not included)",
    ),
    (
        KNOWN | {"sampling": math.nan, "notes": ("one map is too short",)},
        (math.nan, math.nan),
        "model-form 5 %; no 95 % interval",
    ),
    (
        KNOWN | {"sampling": math.nan},
        (math.nan, math.nan),
        "f = 0.05; numerical 0.1 %, sampling not known, model-form 5 %; no 95 % interval",
    ),
]


@pytest.mark.parametrize("parts, interval, words", CASES)
def test_an_interval_in_words(parts, interval, words):
    known = Uncertainty(**parts, interval=interval)
    assert known.short(0.05).endswith(words)
    first, second = known.short_lines(0.05)
    assert first.startswith("f = ") and "numerical" not in first and second.startswith("uncertainty budget: ")
    assert ("no 95 % interval" in first) == ("no 95 % interval" in words)
    assert second.partition(": ")[2] in known.short(0.05)
    if math.isnan(known.model):
        assert "model-form not known (not included)" in known.text


def test_the_error_of_a_moment_has_no_step_where_the_share_of_the_asperities_rounds_to_1():
    """A film that carries next to nothing keeps its least error; one that carries nothing has none."""
    scene = lubfric.load_scene("paper")
    parts = {"film_to_roughness_ratio": 0.5, "boundary": 0.09, "shear": 0.0, "rolling": 0.0, "by_heat": 0.0}
    near = moment_model_error(scene, share=1 - 1e-15, film_load=1e-15, **parts)
    at = moment_model_error(scene, share=1.0, film_load=1e-20, **parts)
    assert at == pytest.approx(near, abs=1e-6) and min(at) > 0.04
    assert moment_model_error(scene, share=1.0, film_load=0.0, **parts) == (0.0, 0.0)


def test_the_largest_part_of_an_interval_is_named_with_what_narrows_it():
    known = Uncertainty(numerical=0.01, sampling=0.02, freedom=4.0, model=0.03, interval=(0.9, 1.1))
    assert known.largest_part.startswith("largest part: sampling 5.6 %")  # Student's t of four degrees: 2.78
    by_input = replace(known, inputs=0.2, largest_input="lubricant.eyring_stress")
    assert by_input.largest_part == "largest part: input 20 %; give a measured lubricant.eyring_stress to reduce it"
    named = replace(by_input, inputs_in_interval=("bodies.hardness", "lubricant.eyring_stress"))
    assert named.largest_part.startswith("largest part: input (hardness, eyring_stress) 20 %; give a measured")
    part = ModelErrorPart(sides=(0.3, 0.2), cause="the boundary film", recommendation="bodies.boundary_film reduces it")
    by_model = replace(known, model=0.3, largest_in_model=part)
    assert by_model.largest_part == "largest part: model-form 30 % (the boundary film); bodies.boundary_film reduces it"
    assert not replace(known, sampling=math.nan).largest_part


def test_a_large_model_error_is_reported_beside_a_part_that_is_larger():
    of_model = Violation(
        assumption=Assumption.MODEL_FORM_ERROR,
        what="error",
        value=14,
        limit=5,
        unit="%",
        consequence="",
        recommendation="shorter cells",
    )
    known = Uncertainty(numerical=0.01, sampling=0.02, freedom=4.0, model=0.14, interval=(0.9, 1.1))
    assert beside_larger_part(of_model, known) == of_model
    film = replace(known, not_given=0.53, missing_input="bodies.boundary_film")
    said = beside_larger_part(of_model, film).recommendation
    assert (
        said.startswith("shorter cells. A larger part of the interval")
        and "not given 53 %; give a measured bodies.boundary_film to reduce it" in said
    )


def test_the_numerical_part_says_what_narrows_it():
    known = Uncertainty(numerical=0.2, sampling=0.01, freedom=20.0, interval=(0.04, 0.06))
    assert known.largest_part == "largest part: numerical 20 %; set a smaller numerics.tolerance to reduce it"
    assert replace(known, narrows_numerical="shorter cells narrow it").largest_part.endswith(
        "; shorter cells narrow it"
    )


def test_the_report_shows_every_part_of_the_budget():
    assert set(budget_bars.BUDGET) == set(budget_bars.BUDGET_ON_LONG_CELLS) == set(PARTS) == set(Uncertainty().budget)
    assert {part.quantity for part in PARTS.values()} <= set(OF_UNCERTAINTY)


def test_the_largest_part_of_any_kind_is_named_with_what_reduces_it():
    for name, part in PARTS.items():
        known = Uncertainty(**{"sampling": 0.0, "missing_input": "a.b", "freedom": 9.0, part.quantity: 0.4})
        called = "a.b not given" if name == "not given" else name
        assert known.largest_part.startswith(f"largest part: {called} ")
        assert known.largest_part.endswith("to reduce it")
        assert not part.sides or len(getattr(known, part.sides)) == 2


def test_a_run_in_time_has_the_same_parts_of_the_budget():
    columns = {"coefficient": np.full(2, 0.05), "sampling_error": np.full(2, 0.1)}
    assert set(errors_in_time(columns, np.zeros(2), np.zeros(2))) == set(PARTS) - set(PARTS_NOT_IN_TIME)


def test_towards_zero_is_above_a_negative_friction():
    """By hand, for one point and for many."""
    below, above = below_and_above(np.array([0.05, -0.05]), np.array([0.2, 0.2]), np.array([0.7, 0.7]))
    assert below.tolist() == [0.2, 0.7] and above.tolist() == [0.7, 0.2]
    assert Sides.of_ends(0.7, 0.2, -0.05) == (0.2, 0.7) == Sides.of_ends(0.2, 0.7, 0.05)
    assert Sides(3.0, 5.0).capped() == (1.0, 5.0)
    assert added_changes([(-3.0, 1.0), (4.0, -4.0), (2.0, 2.0)]) == pytest.approx((5.0, math.sqrt(21.0)))


def test_why_points_have_no_interval_is_said_once():
    """One patch of 8 correlation lengths at two speeds: one line, with what gives an interval."""
    patch = {"shape": (96, 64), "spacing": 1e-6}
    scene = lubfric.load_scene("paper").with_(numerics={"model": "paper", "sampling": "patch"}, contact=patch)
    curve = lubfric.stribeck(scene.with_(lubricant={"limiting_stress_coefficient": "f_b"}), [0.01, 0.02])
    (line,) = _doubts(scene, curve)
    begin = "no 95 % interval of f at 2 speeds, 0.01 and 0.02 m/s: 8 correlation lengths of the solved surface"
    assert (
        line.startswith(begin)
        and "omit numerics.sampling, or give a contact.shape or a map that is longer along y" in line
    )


@pytest.mark.parametrize("shear", [0.02, 0.002, -0.004, -0.03, -0.2])
@pytest.mark.parametrize("boundary", [0.0, 0.01, 0.05])
@pytest.mark.parametrize("share", [0.05, 0.4, 0.95])
def test_the_sides_of_a_division_of_the_load_are_those_of_all_loads_that_it_allows(share, boundary, shear):
    """Also where f is negative, by the rolling part of the film's force: f at all asperity load ratios within
    0.7 sqrt(s (1 - s)) of s, each part of the load with its own friction coefficient."""
    f = boundary + shear
    reach = 0.7 * math.sqrt(share * (1 - share))
    ratios = np.linspace(max(share - reach, 0.0), min(share + reach, 1.0), 11)
    of_each = boundary / share * ratios + shear / (1 - share) * (1 - ratios)
    sides = load_sharing_error_parts(1.0, share=share, boundary=boundary, shear=shear).of_share
    below, above = sides.below_and_above(f)
    assert (f - below, f + above) == pytest.approx((of_each.min(), of_each.max()), abs=1e-12)
