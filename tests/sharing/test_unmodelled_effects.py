"""What a scene leaves out, told with its likely size: against the friction of scenes that have it."""

import csv
import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest
import small_study
from scene_text import paper_scene

import lubfric
from lubfric.models.shared import (
    UnmodelledEffect,
    alpha_of_points_in_words,
    change_in_words,
    effect_in_words,
    expected_alpha_of_scene,
    expected_effects,
    length_beside_interval,
    unmodelled_effects,
)
from lubfric.output import describe_scene

ROLLER = lubfric.load_scene(
    {
        "bodies": {"radii": [8e-3, math.inf], "width": 1e-2, "load": 2000.0, "material": "steel"}
        | {"boundary_friction_coefficient": 0.12},
        "lubricant": {"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 70}
        | {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.06},
        "motion": {"entrainment_speed": 1.0, "slip_percent": 5},
        "surface": {"sq": 1.5e-7, "correlation_length": 1.5e-5},
        "contact": {"shape": [96, 48], "spacing": 4e-6},
        "numerics": {"model": "paper", "sampling": "patch", "heat": "off", "accept": True},
    }
)
SQ = ROLLER.surface.sq


def test_a_large_change_is_reported_without_powers_of_ten():
    changes = (1.4, -0.126, 0.013, math.nan)
    effects = [UnmodelledEffect(what="starved", change=change, recommendation="oil") for change in changes]
    words = list(map(effect_in_words, effects))
    assert words == [f"starved: f {w}; oil" for w in ("+140 %", "-13 %", "+1.3 %", "not estimated")]


def test_the_largest_change_by_an_estimated_pressure_viscosity_coefficient_is_stated():
    """The words are of the effect itself, which is not found by its text; below the tolerance there is none."""
    effects = unmodelled_effects(ROLLER, SQ, 1.0)
    ends = [
        dataclasses.replace(effect, change=0.67 if effect.is_of_alpha else effect.change, what="in other words")
        for effect in effects
    ]
    assert "the range of measured oils changes f by at most about 67 % either way;" in alpha_of_points_in_words(
        {1: ends}, 1
    )
    without = [effect for effect in ends if not effect.is_of_alpha]
    assert len(without) == len(ends) - 1 and alpha_of_points_in_words({1: without}, 1) == ""


# Asperity load ratio, f and its changes with the lowest and the highest pressure-viscosity coefficient of measured
# oils, solved by the quick model: contacts at rest (slide-roll ratio 2) and rolling, Newtonian and of 5 MPa, under 50 N
# and 2 kN.
SOLVED_ENDS = [
    (0.03, 5e6, 2e3, 0.1, 0.889, 0.0987, 0.0101, -0.00157),
    (0.03, 5e6, 2e3, 1.0, 0.235, 0.0519, 0.00435, 0.181),
    (0.03, 5e6, 2e3, 3.0, 0.0, 0.0364, -0.527, 0.51),
    (0.03, 5e6, 2e3, 10.0, 0.0, 0.0362, -0.664, 0.445),
    (2.0, 5e6, 2e3, 0.3, 0.415, 0.0718, 0.0353, 0.0967),
    (2.0, 5e6, 2e3, 3.0, 0.0, 0.0307, -0.277, 0.132),
    (2.0, None, 2e3, 0.5, 0.962, 0.106, -0.0233, 0.00474),
    (2.0, None, 50.0, 1.0, 0.594, 0.0737, -0.0301, 0.0119),
    (0.2, None, 50.0, 3.0, 0.269, 0.0382, -0.0211, 0.00572),
]


@pytest.mark.parametrize("ratio, eyring, load, speed, asperities, f, low, high", SOLVED_ENDS)
def test_the_bound_of_an_estimated_coefficient_holds_the_solved_changes(
    ratio, eyring, load, speed, asperities, f, low, high
):
    """Where the two effects of the coefficient nearly cancel, it is up to 16 times the larger change."""
    given = {
        "bodies": {"radii": [6e-3, 30e-3], "width": 14e-3, "load": load, "material": "100Cr6"}
        | {"boundary_friction_coefficient": 0.11},
        "lubricant": {"grade": "ISO VG 68", "viscosity_index": 95, "temperature": "70 °C", "eyring_stress": eyring},
        "motion": {"slide_roll_ratio": ratio},
        "surface": {"ra": 0.2e-6, "correlation_length": 20e-6, "acf": "gaussian"},
        "contact": {"shape": [128, 128], "spacing": 4e-6},
    }
    if ratio < 2:
        given["counterface"] = given["surface"] | {"ra": 0.1e-6}
    scene = paper_scene(**given)
    sq = math.hypot(scene.surface.sq, scene.counterface.sq if scene.counterface else 0.0)
    effects = unmodelled_effects(scene, sq, speed, (0.11 * asperities, f))
    (bound,) = (effect.change for effect in effects if effect.is_of_alpha)
    true = max(abs(low), abs(high))
    assert true <= bound <= 16 * true


def test_the_bound_of_an_estimated_coefficient_follows_the_shear_of_a_film_that_solved_friction_shows():
    """A film of 0.44 GPa at a slip of 0.5 %: load sharing gives f = 0.0066 and, at the ends of the range, 45 % less and
    111 % more. The shear of the closed form is smaller."""
    given = {
        "bodies": {"radius": 10.2e-3, "width": 10e-3, "load": 554.66, "material": "100Cr6"}
        | {"boundary_friction_coefficient": 0.11},
        "lubricant": {"nu40": "320 cSt", "viscosity_index": 95, "temperature": "90 °C", "eyring_stress": "mineral"}
        | {"limiting_stress_coefficient": 0.08},
        "motion": {"slide_roll_ratio": "0.5 %"},
        "surface": {"sq": 20e-9, "correlation_length": 20e-6},
    }
    effects = unmodelled_effects(paper_scene(**given), 20e-9, 9.1346, (0.0, 0.0066))
    (bound,) = (effect.change for effect in effects if effect.is_of_alpha)
    assert 1.11 < bound < 2.5


def told(lacks, word):
    (effect,) = [effect for effect in lacks if word in effect.what]
    return effect.change


@pytest.mark.parametrize("speed", [0.3, 1.0])
def test_the_likely_size_is_that_of_the_scene_that_has_it_to_a_factor_of_three(speed):
    result = lubfric.friction(ROLLER, speed)
    film = {"inlet_film": 0.7 * result.balance.film.flow_film}
    warm = {
        "oil": None,
        "viscosity": ROLLER.lubricant.viscosity * math.exp(-10 * ROLLER.lubricant.temperature_coefficient),
    }
    alpha = ROLLER.lubricant.oil.pressure_viscosity_coefficient(ROLLER.lubricant.temperature)
    by_alpha = [
        lubfric.friction(ROLLER.with_(lubricant={"pressure_viscosity_coefficient": end}), speed)
        for end in (alpha.low, alpha.high)
    ]
    largest = max(abs(point.coefficient / result.coefficient - 1) for point in by_alpha)
    assert 0.95 <= told(result.unmodelled_effects, "measured oils") / largest < 3
    for word, there in (
        ("starved", ROLLER.with_(lubricant=film)),
        ("warmer", ROLLER.with_(lubricant=warm)),
        ("running-in", ROLLER.with_(surface={"sq": 0.6 * SQ})),
        ("f_b", ROLLER.with_(bodies={"boundary_friction_coefficient": 0.75 * 0.12})),
    ):
        change = lubfric.friction(there, speed).coefficient / result.coefficient - 1
        for guess in (told(result.unmodelled_effects, word), told(unmodelled_effects(ROLLER, SQ, speed), word)):
            assert 1 / 3 < guess / change < 3, (word, guess, change)
    assert told(result.unmodelled_effects, "f_b") == pytest.approx(
        -0.25 * result.boundary_force / 2000.0 / result.coefficient
    )
    sizes = [effect.largest_change for effect in result.unmodelled_effects if not math.isnan(effect.change)]
    assert sizes == sorted(sizes, reverse=True) and math.isnan(told(result.unmodelled_effects, "motion"))


def test_compressibility_at_high_pressure_has_the_sign_and_size_of_that_of_a_solved_compressible_film():
    """At 0.96 GPa to a factor of four; a compressible oil has none, and at low pressure it is not stated."""
    incompressible = ROLLER.with_(lubricant={"density_law": "constant"})
    points = [lubfric.friction(scene, 1.0) for scene in (incompressible, ROLLER)]
    change = points[1].coefficient / points[0].coefficient - 1
    assert 1 / 4 < told(points[0].unmodelled_effects, "compressibility") / change < 4
    low = incompressible.with_(bodies={"load": 200.0})
    for effects in (points[1].unmodelled_effects, unmodelled_effects(low, SQ, 1.0)):
        assert not any("compressibility" in effect.what for effect in effects)


def test_what_is_given_and_what_is_below_the_tolerance_is_not_reported():
    given = ROLLER.with_(lubricant={"inlet_length": 1.0}, bodies={"boundary_friction_coefficient": [0.1, 0.12]})
    words = " ".join(effect.what for effect in unmodelled_effects(given, SQ, 1.0))
    assert "starved" not in words and "f_b" not in words and "running-in" in words
    smooth = " ".join(effect.what for effect in unmodelled_effects(ROLLER, 0.0, 1.0))
    assert "running-in" not in smooth and "motion" not in smooth
    loose = dataclasses.replace(ROLLER, numerics=dataclasses.replace(ROLLER.numerics, tolerance=0.2))
    assert all(effect.change**2 > 0.04 or math.isnan(effect.change) for effect in unmodelled_effects(loose, SQ, 0.3))
    given = loose.with_(lubricant={"pressure_viscosity_coefficient": 18e-9})
    assert [effect.what for effect in unmodelled_effects(given, 0.0, 1.0)] == []
    assert "f_b" in unmodelled_effects(paper_scene(), 1e-7, 0.0)[0].what


def test_info_shows_the_range_of_each_effect():
    effects = expected_effects(ROLLER, SQ, 1.0, includes_motion=False)  # by load sharing
    text = describe_scene(ROLLER)
    assert not any(effect.low > effect.high for effect in effects)
    for effect in (each for each in effects if not each.is_of_alpha):
        changes = change_in_words(effect.low, effect.high)
        assert f"{effect.what}: f {changes}; {effect.recommendation}" in text
    assert "effects not modelled" in text and len(effects) >= 5


@pytest.mark.parametrize("model", ["paper", "quick", "deterministic"])
@pytest.mark.parametrize("speed", [0.003, 0.03, 0.3])
def test_no_report_contradicts_info(model, speed):
    """The changes of f that a result states are in the ranges that were stated before it, whatever the model."""
    scene = small_study.SCENE.with_(numerics={"model": model})
    result = lubfric.friction(scene, speed)
    ranges = {each.what: (each.low, each.high) for each in expected_effects(scene, scene.surface.sq, speed)}
    for effect in result.unmodelled_effects:
        low, high = ranges[effect.what]
        assert math.isnan(effect.change) or low - 0.02 <= effect.change <= high + 0.02, effect.what


def test_a_soft_body_is_answered_with_how_thick_its_cover_has_to_be():
    soft = ROLLER.with_(bodies={"e_prime": 2e7, "load": 100.0})
    (cover,) = [each.recommendation for each in unmodelled_effects(soft, SQ, 1.0) if "cover" in each.what]
    assert f"{5e3 * soft.bodies.half_width:.2g} mm" in cover


def test_a_given_pressure_viscosity_coefficient_is_no_estimate():
    """As one value it is exact; as a range its change of f is in the interval."""
    oil = ROLLER.lubricant
    alpha = oil.pressure_viscosity_coefficient
    givens = [{"pressure_viscosity_coefficient": given} for given in (alpha, [alpha, 0.7 * alpha, 1.1 * alpha])]
    scenes = (ROLLER, *(ROLLER.with_(lubricant=given) for given in givens))
    (estimated, *exact) = (" ".join(effect.what for effect in unmodelled_effects(scene, SQ, 1.0)) for scene in scenes)
    assert "in place of the estimate" in estimated
    assert not any("in place of the estimate" in text for text in exact)


def test_a_range_is_recommended_where_the_interval_will_contain_it():
    """The interval of a run in time contains no range of the coefficient."""
    of_runs = [unmodelled_effects(ROLLER, SQ, 1.0, run=run) for run in (None, ROLLER)]
    (at_point, in_time) = (next(each.recommendation for each in of_run if each.is_of_alpha) for of_run in of_runs)
    assert "[value, low, high]" in at_point and "[value, low, high]" not in in_time


def test_info_states_the_range_of_an_estimated_coefficient_once_with_what_to_do():
    """Nothing is said of a given coefficient."""
    text = " ".join(describe_scene(ROLLER).split())
    speed = ROLLER.motion.entrainment_speed
    ends = [effect for effect in expected_effects(ROLLER, SQ, speed) if effect.is_of_alpha]
    section = text.partition("effects not modelled")[2]
    assert len(ends) == 1 and section.count("pressure-viscosity coefficient") == 1
    alpha = ROLLER.lubricant.oil.pressure_viscosity_coefficient(ROLLER.lubricant.temperature)
    assert f"the range of measured oils is {1e9 * alpha.low:.3g} to {1e9 * alpha.high:.3g} 1/GPa" in section
    assert "Give lubricant.pressure_viscosity_coefficient from a data sheet" in section
    given = ROLLER.with_(lubricant={"pressure_viscosity_coefficient": ROLLER.lubricant.pressure_viscosity_coefficient})
    assert "pressure-viscosity" not in describe_scene(given).partition("effects not modelled")[2]


def test_a_starved_inlet_is_reported_where_the_asperities_carry_most():
    """The film carries little there, and is thicker than that of the whole load would be."""
    small = {"shape": (96, 48), "spacing": 1.1e-6}
    scene = paper_scene(contact=small, surface={"correlation_length": 4e-6}, numerics={"sampling": "patch"})
    point_scene = scene.with_(lubricant={"inlet_length": 60e-6}, motion={"entrainment_speed": 0.03})
    point = lubfric.friction(point_scene)
    (stated,) = (entry for entry in point.validity if "flooded inlet" in entry.what)
    assert point.contact_load > point.film_load and stated.value < 0.8
    assert stated.what in " ".join(describe_scene(point_scene).split())


@pytest.mark.parametrize("length", [1e-3, 3e-3, 0.1])
def test_rolling_friction_that_a_given_inlet_omits_is_reported(length):
    """Of a film that hardly gets thinner; by f with a full inlet."""
    scene = paper_scene()
    full, given = (lubfric.friction(scene.with_(lubricant={"inlet_length": x}), 1.0) for x in (None, length))
    stated = [entry.value for entry in given.validity if "beyond inlet_length" in entry.what]
    lost = 100 * (full.rolling_force - given.rolling_force) / (given.coefficient * scene.bodies.load)
    assert stated == ([pytest.approx(lost, rel=0.25)] if lost > 1 else []) and bool(stated) == (length < 0.1)


@pytest.mark.parametrize(
    "slip, speed, asperities, is_listed",
    [
        (2.0, 1.0, 0.0, False),
        (2.0, 1.0, 0.01, True),
        (2.0, 1.0, 0.06, True),
        (2.0, 1.0, 0.1195, False),
        (0.05, 1.6, 0.0, True),  # twice the length, solved by the quick model: 5 % less f at a lambda ratio of 1.5
        (0.0, 1.6, 0.0, True),
        (0.05, 1.0, 0.1195, False),
        (0.05, 100.0, 0.0, False),
    ],
)
def test_the_correlation_length_of_generated_roughness_is_listed_where_it_matters(slip, speed, asperities, is_listed):
    """In mixed lubrication; where roughness moves, in any film that is not thick. Without asperities its change is not
    estimated."""
    f = max(asperities, 0.02)
    effects = unmodelled_effects(ROLLER.with_(motion={"slide_roll_ratio": slip}), SQ, speed, (asperities, f))
    listed = [effect for effect in effects if "correlation length" in effect.what]
    assert len(listed) == is_listed
    for effect in listed:
        assert "surface.correlation_length" in effect.recommendation
        assert [math.isnan(change) for change in effect.changes] == 2 * [asperities <= 0.02 * 0.12]


LENGTHS = Path(__file__).parents[2] / "verification/campaigns/calibration/tables/lengths.csv"


def effects_of_length(row, **surface):
    """The effects of the correlation length at the f and the asperity load ratio in a ``row`` of `LENGTHS`."""
    (slip, f_b, contact, f) = (float(row[name]) for name in ("slip", "friction", "contact", "f"))
    scene = ROLLER.with_(
        bodies={"boundary_friction_coefficient": f_b}, motion={"slide_roll_ratio": slip}, surface=surface
    )
    effects = unmodelled_effects(scene, SQ, 1.0, (f_b * contact, f))
    assert effects
    return [each for each in effects if each.kind == "correlation_length"]


def test_the_change_by_another_correlation_length_is_about_that_of_solved_contacts():
    """At half and at twice the length, at rest and rolling, by the quick model: with the sign of each change above 5 %,
    and to a factor of two in six of ten; with its range in the scene it is in the interval, and no effect."""
    contacts = {}
    with LENGTHS.open() as file:
        for row in csv.DictReader(file):
            contacts.setdefault((row["motion"], row["seed"]), {})[row["factor"]] = row
    ratios = []
    for by_factor in contacts.values():
        row = by_factor["1.0"]
        if not 0.02 < float(row["contact"]) < 0.98:
            continue
        changes = [change for effect in effects_of_length(row) for change in effect.changes] or [0.01, -0.01]
        for change, factor in zip(changes, ("0.5", "2.0"), strict=True):
            if factor in by_factor:
                solved = float(by_factor[factor]["f"]) / float(row["f"]) - 1
                ratios += [solved / change] if abs(solved) > 0.05 else []
        assert effects_of_length(row, correlation_length=[1.5e-5, 1e-5, 3e-5]) == []
    ratios = np.array(ratios)
    assert ratios.size > 40 and ratios.min() > 0 and 0.8 < np.median(ratios) < 1.4
    assert np.mean((ratios > 0.5) & (ratios < 2)) > 0.6


def test_a_correlation_length_that_may_leave_the_interval_is_beside_it():
    """Both f of the effect are stated, and none where twice the change is within half the width of the interval."""
    effect = UnmodelledEffect(
        what="length", change=0.25, other_change=-0.2, recommendation="", kind="correlation_length"
    )
    text = length_beside_interval([effect], 0.06, (0.04, 0.065))
    assert "half of it gives about 0.075, twice about 0.048" in text
    for effects, interval in (([effect], (0.02, 0.09)), ([], (0.06, 0.06)), ([effect], (math.nan, math.nan))):
        assert length_beside_interval(effects, 0.06, interval) == ""
    unknown = dataclasses.replace(effect, change=math.nan, other_change=math.nan)
    assert length_beside_interval([unknown], 0.06, (0.06, 0.06)) == ""


def test_the_correlation_length_of_a_measured_map_is_no_effect(tmp_path):
    surface = lubfric.generate_surface((96, 48), 4e-6, sq=1.5e-7, correlation_length=1.5e-5, seed=1)
    np.save(tmp_path / "map.npy", surface.heights)
    measured = ROLLER.with_(surface={"file": str(tmp_path / "map.npy"), "spacing": 4e-6, "unit": "m"})
    effects = unmodelled_effects(measured, SQ, 1.0, (0.06, 0.08))
    assert effects and not any("correlation length" in effect.what for effect in effects)


def test_a_thinner_film_moves_load_to_asperities_as_solved_contacts_show():
    """In mixed lubrication f of the quick model rises where the film is thinner, as solved again; by load sharing it
    rises by less."""
    loose = {"sampling_tolerance": 0.3, "tolerance": 0.05}
    scene = ROLLER.with_(
        surface={"correlation_length": 3e-5},
        contact={"spacing": 8e-6},
        numerics={"model": "quick", "sampling": None} | loose,
    )
    at = scene.line_contact(1.0).moes_film / SQ
    speed = (0.5 / at) ** 1.5  # a lambda ratio of some 0.5
    result = lubfric.friction(scene, speed)
    assert 0.3 < result.contact_load / 2000.0 < 0.95
    smoother = lubfric.friction(scene.with_(surface={"sq": 0.6 * SQ}), speed).coefficient / result.coefficient - 1
    assert 0.4 < told(result.unmodelled_effects, "running-in") / smoother < 2.5


@pytest.mark.parametrize("oil, origin", [("fva-3", "measured for this oil"), ("mineral-100", "an estimate")])
def test_a_coefficient_that_is_measured_for_the_oil_is_no_estimate(oil, origin):
    """FVA 3 has measured coefficients, with their range; before the solve no second number of its effect is stated."""
    scene = ROLLER.with_(lubricant={"oil": oil})
    words = alpha_of_points_in_words({1: unmodelled_effects(scene, SQ, 1.0)}, 1)
    assert words.startswith(f"The pressure-viscosity coefficient is {origin}; ")
    assert ("measured oils" in words) == (origin == "an estimate")
    before = expected_alpha_of_scene(scene, expected_effects(scene, SQ, 1.0))
    assert before.startswith(f"the pressure-viscosity coefficient is {origin}; ") and "%" not in before
