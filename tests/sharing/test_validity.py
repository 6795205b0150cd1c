"""Validity of converged results: told where the model leaves its range, silent on the paper's scene, refused where f is
none."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from scene_text import paper_scene
from small_study import SCENE

import lubfric
from lubfric.film import ShearForce
from lubfric.models.shared import (
    Assumption,
    Heat,
    Violation,
    expected_typical_heat,
    gathered,
    gathered_in_table,
    gathered_on_curve,
    in_a_cell,
    sentence,
    violations_by_bodies,
    violations_by_deflection,
    violations_by_heat,
    violations_by_map,
    violations_by_motion,
    violations_by_numerical_error,
    violations_by_pressure,
    violations_by_shear,
    violations_by_thickness,
)
from lubfric.output import estimate_scene

PAPER = paper_scene(contact={"shape": (96, 96), "spacing": 0.9e-6}, numerics={"sampling": "patch"})
FRICTION = 0.09 * PAPER.bodies.load


def test_the_paper_scene_needs_none():
    model = lubfric.prepare(PAPER)
    assert model.violations == () and lubfric.friction(model, 0.003).validity == ()


@pytest.mark.parametrize(
    "words, entries",
    [
        ("extrapolated", violations_by_pressure(PAPER, 2e9)),
        (
            "eyring_stress",
            violations_by_shear(PAPER, ShearForce(couette=5.0, rolling=0.0), PAPER.bodies.load, FRICTION),
        ),
        ("f stays below f_b", violations_by_deflection(PAPER.with_(bodies={"load": 550.0}), 3e-7)),
        ("thin compared", violations_by_thickness(PAPER.with_(bodies={"radius": 1e-6}), 3e-7)),
        ("opposite directions", violations_by_motion(PAPER.with_(motion={"slide_roll_ratio": 3.0}), 0.003, 3e-7)),
        ("wider than it is long", violations_by_bodies(PAPER.with_(bodies={"width": 4e-6, "load": 0.01}).bodies)),
        ("steel yields", violations_by_bodies(PAPER.with_(bodies={"hardness": None, "hertz_pressure": 6e9}).bodies)),
    ],
)
def test_each_limit_is_reported(words, entries):
    (entry,) = [entry for entry in entries if words in entry.text]
    assert entry.value != entry.limit and entry.recommendation
    assert entry.text.startswith("warning: ") and not entry.severe


@pytest.mark.parametrize("share, severe", [(0.005, None), (0.05, False), (0.5, True)])
def test_stress_that_no_oil_carries_by_its_share_of_f(share, severe):
    shear = ShearForce(couette=0.0, rolling=0.0, excess=share * FRICTION, stress_ratio=3.0)
    entries = list(violations_by_shear(PAPER, shear, PAPER.bodies.load, FRICTION))
    assert [entry.severe for entry in entries] == ([] if severe is None else [severe])
    assert all("Newtonian" in entry.text for entry in entries)


def test_bodies_and_maps_are_judged_before_anything_is_solved():
    wide = PAPER.with_(bodies={"radius": 0.01, "load": 3e5, "e_prime": 1e8, "width": 0.1, "hardness": None})
    assert [e.severe for e in violations_by_bodies(wide.bodies) if "half-space model" in e.text] == [True]
    short = PAPER.with_(bodies={"width": 4e-6, "load": 0.01})
    assert any("bodies.width, radius and load" in e.recommendation for e in violations_by_bodies(short.bodies))
    assert [[e.severe for e in violations_by_map(slope, 20)] for slope in (0.3, 0.7, 2.0)] == [[], [False], [True]]
    assert "few asperities" in next(violations_by_map(0.1, 3)).text


@pytest.mark.parametrize("axis", [0, 1])
def test_a_map_that_is_noise_along_an_axis_is_refused_with_what_to_do(axis):
    """Lines of waves, each at a place of its own: neighbours along the other axis have nothing in common."""
    shift = np.random.default_rng(1).uniform(0, 7, 128)
    heights = 1e-7 * np.sin(0.2 * np.arange(128)[:, None] + shift)
    surface = lubfric.Surface(heights if axis else heights.T, 1e-6, periodic_axes=(True, True))
    scene = paper_scene(numerics={"sampling": "patch"})
    with pytest.raises(lubfric.ValidityError, match=f"along {'xy'[axis]} is 0.[67].*noise.*s_filter"):
        lubfric.friction(lubfric.prepare(scene, surface), 0.1)
    kept = lubfric.friction(lubfric.prepare(scene.with_(numerics={"accept": True}), surface), 0.1)
    assert [e.what[-1] for e in kept.validity if "noise" in e.text] == ["xy"[axis]]
    steep = lubfric.prepare(PAPER.with_(surface={"sq": 3e-6}))
    assert any("rms slope" in entry.what for entry in steep.violations)


def test_the_reynolds_number_is_that_of_the_film():
    scene = PAPER.with_(lubricant={"viscosity": 1e-4, "viscosity_law": "constant"})
    entry = next(violations_by_motion(scene, 100.0, 30e-6))
    assert entry.value == pytest.approx(870 * 100 * 30e-6 / 1e-4) and entry.severe
    assert not list(violations_by_motion(PAPER, 1.0, 1e-6))


def heavy(**lubricant):
    """A steel roller at 0.9 GPa with an ordinary oil, in pure sliding."""
    return PAPER.with_(
        bodies={"radius": 0.01, "hertz_pressure": 0.9e9, "width": 0.01, "e_prime": 2.27e11},
        lubricant={"viscosity": 0.02, "pressure_viscosity_coefficient": 2e-8} | lubricant,
        contact={"shape": (128, 64), "spacing": 4e-6},
        surface={"sq": 5e-8, "correlation_length": 3e-5, "acf": "gaussian"},
    )


def test_the_ordinary_bearing_without_a_shear_law_is_refused():
    with pytest.raises(lubfric.ValidityError, match="eyring_stress") as caught:
        lubfric.friction(heavy(), 1.0)
    error = caught.value
    assert isinstance(error, lubfric.LubfricError)
    assert error.result.coefficient > 1 and error.result.report.converged
    assert error.violations[0].severe and error.violations[0] in error.result.validity
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and again.result.coefficient == error.result.coefficient
    accepted = lubfric.friction(heavy().with_(numerics={"accept": True}), 1.0)
    assert accepted.coefficient == error.result.coefficient and accepted.validity == error.result.validity
    assert any("not valid" in note for note in accepted.report.notes)


def test_a_shear_law_makes_it_an_answer():
    result = lubfric.friction(heavy(eyring_stress=5e6, limiting_stress_coefficient=0.08), 1.0)
    assert result.coefficient < 0.2 and not any(entry.severe for entry in result.validity)


def test_a_sweep_marks_the_point_and_keeps_the_rest():
    with pytest.raises(lubfric.ValidityError) as caught:
        lubfric.stribeck(heavy(), [0.5, 1.0])
    curve = caught.value.result
    assert set(curve.errors) == {0, 1} and np.isnan(curve.coefficient[0])
    assert curve.violations(0)[0].what and any("2 speeds, 0.5 and 1 m/s" in text for text in curve.validity)
    rolling = lubfric.stribeck(heavy().with_(motion={"slide_roll_ratio": 1e-9}), [0.5, 1.0])
    assert not rolling.errors and not any("not valid" in text for text in rolling.validity)
    accepted = lubfric.stribeck(heavy().with_(numerics={"accept": True}), [0.5, 1.0])
    assert not accepted.errors and any("not valid" in text for text in accepted.validity)


@pytest.mark.parametrize("column", [0, -1])
@pytest.mark.parametrize("grid", ["given", "auto"])
def test_a_contact_on_the_edge_columns_of_a_patch_is_refused(grid, column):
    """A ridge on an edge column carries the load, also where the cells that are solved leave that column out. The
    whole result is kept, and returned where it is accepted."""
    scene = PAPER.with_(numerics={"grid": grid})
    rough = lubfric.prepare(scene).surface
    heights = rough.heights.copy()
    heights[column] += 5e-6
    surface = lubfric.Surface(heights, rough.spacing, periodic_axes=(False, True))
    with pytest.raises(lubfric.ValidityError, match="edge columns") as caught:
        lubfric.friction(lubfric.prepare(scene, surface), 1e-3, fields=True)
    result = caught.value.result
    pressure = result.pressure
    assert pressure[column].sum() > 0.5 * pressure.sum()
    accepted = lubfric.friction(lubfric.prepare(scene.with_(numerics={"accept": True}), surface), 1e-3)
    entry = next(e for e in accepted.validity if "edge columns" in e.what)
    assert entry.severe and entry.value > 50
    assert lubfric.friction(scene, 1e-3).validity == ()


def test_a_contact_that_only_load_sharing_cuts_off_is_answered_by_default():
    """A bump at the end of a patch carries the load. f is that on the patch between its own mirror images, whose
    contact no end cuts off."""
    numerics = {"sampling": "patch", "model": "auto"}
    scene = lubfric.load_scene("paper").with_(contact={"shape": (48, 24), "spacing": 1.8e-6}, numerics=numerics)
    rough = lubfric.prepare(scene).surface
    heights = rough.heights + 1.5e-6 * np.exp(-((np.arange(48) / 4.5) ** 2))[:, None]
    longer = np.concatenate([heights[::-1], heights, heights[::-1]])
    maps = [lubfric.Surface(each, rough.spacing, periodic_axes=(False, True)) for each in (heights, longer)]
    with pytest.raises(lubfric.ValidityError, match="edge columns"):
        lubfric.friction(lubfric.prepare(scene.with_(numerics={"model": "paper"}), maps[0]), 1e-3)
    short, long = (lubfric.friction(lubfric.prepare(scene, surface), 1e-3) for surface in maps)
    assert [point.decision.model for point in (short, long)] == ["deterministic"] * 2
    assert short.coefficient == pytest.approx(long.coefficient, rel=1e-3)
    assert not any(violation.severe for violation in short.validity)


@pytest.mark.parametrize(
    "numerics", [{"film_tolerance": 0.03, "heat": "off"}, {"model": "deterministic", "grid": "given"}]
)
def test_an_error_above_the_tolerance_is_a_warning(numerics):
    """Settings that do not follow the tolerance: f and its error stay the same, above one tolerance and below
    another."""
    scene = PAPER.with_(contact={"shape": (48, 48), "spacing": 1.8e-6})
    points = [lubfric.friction(scene.with_(numerics=numerics | {"tolerance": t}), 0.03) for t in (1e-4, 0.2)]
    stated = [[entry for entry in p.validity if "estimated numerical error of f" in entry.what] for p in points]
    assert 1e-4 < points[0].uncertainty.numerical < 0.2 and stated[1] == []
    assert stated[0][0].value == pytest.approx(100 * points[0].uncertainty.numerical) and stated[0][0].limit == 0.01
    assert stated[0][0].text in points[0].report.notes


def test_cells_too_long_for_the_roughness_are_a_warning():
    """An exponential ACF has detail at every scale: cells half as long would go on changing f."""
    rough = PAPER.with_(surface={"acf": "exponential"}, numerics={"sampling": "strips", "sampling_tolerance": 0.2})
    result = [lubfric.friction(rough.with_(numerics={"tolerance": t}), 0.03) for t in (0.01, 0.05)]
    stated = [[e.value for e in p.validity if "cells half as long" in e.what] for p in result]
    assert len(stated[0]) == 1 and 1 < stated[0][0] < 5 and stated[1] == []


def entry(value, what="slip", *, severe=False):
    return Violation(
        what=what, value=value, limit=5.0, unit="%", consequence="it slides", recommendation="less", severe=severe
    )


def test_a_warning_of_several_speeds_gives_the_smallest_and_the_largest_value_with_their_speeds():
    points = [(0.1, (entry(8.69),)), (0.3, (entry(6.0),)), (3.0, (entry(5.2),)), (4.0, ())]
    (text,) = gathered(points)
    assert text == (
        "at 3 speeds, 0.1 to 3 m/s: warning: slip is 5.2 % (at 3 m/s) to 8.69 % (at 0.1 m/s), above 5 %. It slides. "
        "Recommendation: less."
    )
    slower, faster = (replace(entry(value), consequence=f"it takes {value} s") for value in (8.69, 5.2))
    (text,) = gathered([(0.1, (slower,)), (3.0, (faster,))])
    assert "above 5 %. At 0.1 m/s: it takes 8.69 s." in text  # of the one point that has these numbers
    (in_table,) = gathered_in_table([[faster], [slower]])
    assert in_table.text.startswith(
        "At points 1 and 2: slip is 5.2 to 8.69 % (at point 2), above 5 %. At point 2: it takes 8.69 s."
    )
    points = [(0.1, (entry(8.0),)), (0.3, (replace(entry(7.0), recommendation="more"),))]
    (text,) = gathered(points)
    assert text.endswith("above 5 %. It slides. Recommendation at 0.1 m/s: less.")  # the consequence holds at both
    points += [(0.2, (entry(9.0),)), (0.4, (replace(entry(6.0), consequence="it sticks"),))]
    (text,) = gathered(points)
    assert text.endswith("At 3 speeds, 0.1 to 0.3 m/s: it slides. Recommendation at 3 speeds, 0.1 to 0.4 m/s: less.")
    (in_table,) = gathered_in_table([violations for _, violations in points])
    assert in_table.text.endswith("above 5 %. At points 1 to 3: it slides. Recommendation at points 1, 3 and 4: less.")
    (alike,) = gathered([(0.1, (entry(8.0),)), (0.3, (entry(8.0),))])
    assert "slip is 8 %, above" in alike


@pytest.mark.parametrize(
    "values, limit, worst", [((5.2, 8.69, 6.0), 5.0, 2), ((4.67, 3.38, 4.0), 5.0, 2), ((4.67, 4.0, 3.38), 5.0, 3)]
)
def test_a_warning_of_a_table_quotes_the_value_farthest_beyond_its_limit(values, limit, worst):
    """Above a limit that is the largest value, below one the smallest."""
    entries = [replace(entry(value), limit=limit, consequence=f"it takes {value} s") for value in values]
    text = gathered_in_table([[each] for each in entries])[0].text
    assert f"At point {worst}: it takes {values[worst - 1]} s" in text
    is_below = limit > max(values) or ", below " in text
    place = f" (at point {worst})"
    ends = f"{min(values)}{place} to {max(values)} %" if is_below else f"{min(values)} to {max(values)} %{place}"
    assert f"slip is {ends}, " in text


@pytest.mark.parametrize(
    "places, words",
    [
        ((1,), "At point 1: slip is 6 %"),
        ((1, 2, 3, 4, 5), "At points 1 to 5: slip is 6 to 10 % (at point 5)"),
        ((1, 3), "At points 1 and 3: slip is 6 to 8 % (at point 3)"),
        ((1, 2, 3, 5), "At points 1 to 3 and 5: slip is 6 to 10 % (at point 5)"),
    ],
)
def test_warnings_of_a_table_name_their_points(places, words):
    (gathered_here,) = gathered_in_table([[entry(5.0 + n)] if n in places else [] for n in range(1, 6)])
    assert gathered_here.numbers == places and gathered_here.text.startswith(f"{words}, above 5 %. It slides.")


def test_warnings_at_many_scattered_points_name_the_worst_and_how_many_there_are():
    (gathered_here,) = gathered_in_table([[entry(6.0 + (n == 7))] if n % 2 else [] for n in range(41)])
    assert gathered_here.text.startswith("At 20 of 41 points: slip is 6 to 7 % (at point 8), above 5 %.")


def test_a_local_film_peak_is_distinguished_from_the_hertz_pressure():
    heavy = PAPER.with_(bodies={"hertz_pressure": 1.2e9, "hardness": None})
    (at_hertz,) = violations_by_pressure(heavy, 1.2e9)
    (local,) = violations_by_pressure(heavy, 3e9, "of one film")
    assert "a local peak of one film" in local.text
    assert "highest film pressure is 1.2 GPa" in at_hertz.text and "local" not in at_hertz.text
    assert (
        "highest film pressure is 3 GPa" in local.text
        and "a local peak" in local.text
        and "the peak Hertz pressure is 1.2 GPa" in local.text
    )


def test_a_pressure_at_which_no_oil_is_liquid_is_apart_from_one_above_the_viscosity_law():
    """Of the made pressures 3 GPa is three times its limit and 12 GPa a fifth above its own, which is the stronger
    one."""
    elastic = PAPER.with_(bodies={"hertz_pressure": 0.5e9, "hardness": None})
    at = [
        (u, tuple(violations_by_pressure(elastic, p, "of one film")))
        for u, p in ((0.05, 3e9), (0.1, 12.5e9), (0.2, 12e9))
    ]
    for found in gathered_on_curve(at), gathered_in_table([violations for _, violations in at]):
        (extrapolated, not_liquid) = sorted((each.text for each in found), key=lambda text: "above 10 GPa" in text)
        assert "3 GPa, above 1 GPa. The viscosity law" in extrapolated and "12.5 GPa" in not_liquid
        assert "above 10 GPa. No oil is liquid at this pressure, so the viscosity has no meaning there" in not_liquid
        assert "f has no meaning" not in not_liquid and "extrapolated" not in not_liquid


@pytest.mark.parametrize("hardness, recommendation", [(None, "give bodies.hardness"), (8e9, "check the heights")])
def test_asperities_that_press_the_film_beyond_any_liquid_are_not_answered_by_the_load(hardness, recommendation):
    """The Hertz pressure is below the limit: another load would change little."""
    scene = PAPER.with_(bodies={"hertz_pressure": 0.5e9, "hardness": hardness})
    (local,) = violations_by_pressure(scene, 12e9, "of one film")
    assert not local.severe and not local.is_note
    assert recommendation in local.recommendation and "bodies.load" not in local.recommendation
    limited = scene.with_(lubricant={"limiting_stress_coefficient": 0.05})
    (bounded,) = violations_by_pressure(limited, 12e9, "of one film")
    assert "the limiting stress bounds the friction of the film" in bounded.consequence and not bounded.is_note
    (smooth,) = violations_by_pressure(scene, 12e9)
    assert smooth.severe and "f has no meaning" in smooth.consequence and "bodies.load" in smooth.recommendation


@pytest.mark.parametrize("values, limits, worst", [((3.0, 12.0), (1.0, 10.0), 12.0), ((0.5, 0.2), (5.0, 0.3), 0.2)])
def test_a_warning_with_several_limits_takes_the_words_of_its_largest_value(values, limits, worst):
    """Below a limit that is the smallest value."""
    made = [
        (replace(entry(value), limit=limit, consequence=f"it takes {value} s"),) for value, limit in zip(values, limits)
    ]
    (on_curve,) = gathered_on_curve(list(enumerate(made)))
    (in_table,) = gathered_in_table(made)
    assert on_curve.violation.value == in_table.violation.value == worst
    assert f"it takes {worst} s" in on_curve.text and f"it takes {worst} s" in in_table.text


def test_a_warning_of_several_points_has_the_words_of_the_largest_effect_on_f():
    """The lowest Péclet number is not that of the point where f is changed the most."""
    slow, fast = (replace(entry(value), consequence=f"by {e}", effect=e) for value, e in ((1.2, 0.01), (2.9, 0.04)))
    (on_curve,) = gathered_on_curve([(0.2, (slow,)), (0.5, (fast,))])
    assert on_curve.text.endswith(
        "slip is 1.2 % (at 0.2 m/s) to 2.9 % (at 0.5 m/s), below 5 %. At 0.5 m/s: by 0.04. Recommendation: less."
    )
    (in_table,) = gathered_in_table([[fast], [slow]])
    assert in_table.text.endswith(
        "slip is 1.2 (at point 2) to 2.9 %, below 5 %. At point 1: by 0.04. Recommendation: less."
    )


def test_notes_are_apart_from_warnings():
    """A note is named as one, counted apart, and does not hide in the sentence of a warning on the same quantity."""
    note = Violation(
        what="slip", value=7.0, limit=5.0, unit="%", consequence="it slides", recommendation="", is_note=True
    )
    assert note.text == "note: slip is 7 %, above 5 %. It slides."
    on_curve = gathered_on_curve([(0.1, (entry(8.0),)), (0.2, (note,))])
    assert [each.is_note for each in on_curve] == [False, True]
    assert on_curve[1].text_without_head == "at 0.2 m/s: slip is 7 %, above 5 %. It slides."
    assert [each.is_note for each in gathered_in_table([[note, entry(8.0)]])] == [True, False]
    assert in_a_cell([note, entry(8.0)]) == f"{note.text} | {entry(8.0).text}" and not in_a_cell([])


@pytest.mark.parametrize("coefficient, is_note", [(None, False), (0.05, True), ("f_b", True)])
def test_a_film_above_the_range_of_its_law_is_a_note_where_its_stress_is_limited(coefficient, is_note):
    scene = PAPER.with_(lubricant={"limiting_stress_coefficient": coefficient})
    (found,) = violations_by_pressure(scene, 2e9)
    assert found.is_note == is_note and ("limiting stress bounds" in found.consequence) == is_note
    assert ("give a measured limiting stress" in found.recommendation) != is_note


def test_the_error_of_the_solve_is_a_note_and_heat_that_is_left_out_stands_beside_f():
    scene = lubfric.load_scene("paper").with_(numerics={"model": "paper", "tolerance": 1e-4, "film_tolerance": 0.03})
    fast = lubfric.friction(scene, 1.0)
    kinds = {violation.assumption: violation.is_note for violation in fast.validity}
    assert kinds[Assumption.NUMERICAL_ERROR] is True and kinds[Assumption.HEAT_INCLUDED] is False
    for error, is_magnitude in (0.22, False), (0.49, False), (0.6, True):
        (large,) = violations_by_numerical_error(error, 0.01, "")
        assert not large.is_note and ("order of magnitude" in large.consequence) == is_magnitude
    for has_interval in (True, False):
        (note,) = violations_by_numerical_error(0.02, 0.01, "", has_interval=has_interval)
        assert ("the interval of f includes it" in note.text) == has_interval
        assert ("f has no interval" in note.text) != has_interval
    assert fast.not_in_interval.startswith(
        "f and its interval are without the heat of the film, which lowers f by up to 2"
    )
    assert lubfric.friction(scene.with_(numerics={"heat": "off"}), 1.0).not_in_interval == ""
    (solved,) = (each.effect for each in fast.validity if each.assumption == Assumption.HEAT_INCLUDED)
    assert 0.8 < expected_typical_heat(scene, scene.surface.sq, 1.0) / solved < 1.25
    before = lubfric.output.describe_scene(scene, [1.0]).partition("estimate with closed forms")[0]
    assert "reduction of f by the heat of the film is" in " ".join(before.split())


def test_the_first_line_says_which_inputs_the_interval_contains_and_that_an_estimate_is_not_among_them():
    """A coefficient that is given is no estimate."""
    oil = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 70, "eyring_stress": [4e6, 6e6]}
    scene = PAPER.with_(lubricant=oil, numerics={"model": "paper", "sampling": "strips", "sampling_tolerance": 0.2})
    texts = []
    for alpha in (None, 2e-8):
        point = lubfric.friction(scene.with_(lubricant={"pressure_viscosity_coefficient": alpha}), 0.5)
        texts.append((point.uncertainty.short(point.coefficient), point.not_in_interval))
    (estimated, given) = texts
    assert (
        "the pressure-viscosity coefficient is an estimate, and the interval does not contain the range" in estimated[1]
    )
    assert given[1] == ""
    assert "input (eyring_stress) " in estimated[0] and "input (eyring_stress) " in given[0]


def test_slow_surfaces_are_a_warning_where_heat_changes_f_by_more_than_the_target_of_the_model_error():
    """It depends on the Péclet number and on how much heat changes f: the slowest points may have too little of it."""
    scene = lubfric.load_scene("paper")
    heats = [Heat(peclet=peclet, change=change) for peclet, change in ((2.0, 0.002), (3.0, 0.04), (6.0, 0.04))]
    none, (slow,), fast = (tuple(violations_by_heat(scene, heat)) for heat in heats)
    assert none == fast == ()
    assert "f is too low by at most 4 %, half of which its model-form error contains" in slow.text and slow.is_note
    (slow,) = violations_by_heat(scene, Heat(peclet=3.0, change=0.06))
    assert not slow.is_note and slow.effect == 0.06


def test_a_sentence_begins_with_the_symbol_of_friction_as_it_is():
    assert sentence("f depends on it") == "f depends on it." and sentence("film and f") == "Film and f."


def test_the_width_of_the_map_matters_where_it_gives_a_sampling_error():
    """A patch of nine correlation lengths: at high speed no asperity touches, and another patch has the same f."""
    short = PAPER.with_(
        contact={"shape": (48, 44), "spacing": 1.8e-6}, numerics={"model": "paper", "sampling": "patch"}
    )
    slow, fast = (lubfric.friction(short, speed) for speed in (0.01, 1.0))
    assert any(violation.assumption == Assumption.LONG_SAMPLE for violation in slow.validity)
    assert fast.contact_load == 0 and (
        fast.uncertainty.sampling != 0 or Assumption.LONG_SAMPLE not in [v.assumption for v in fast.validity]
    )


def test_a_sample_that_ends_asks_for_a_larger_map():
    wide = lubfric.load_scene("paper").with_(numerics={"model": "paper", "sampling_tolerance": 0.2})
    few = lubfric.friction(wide, 0.03).uncertainty
    assert "numerics.sampling_tolerance" in few.narrows_sampling
    surface = lubfric.generate_surface((64, 400), 1.8e-6, sq=1e-7, correlation_length=8e-6, seed=2)
    given = lubfric.friction(lubfric.prepare(wide, surface), 0.03).uncertainty
    assert given.narrows_sampling == "give a larger map to reduce it"


def test_a_generated_patch_asks_for_its_keys_and_names_the_interval_that_is_known():
    """A patch of 13 correlation lengths in boundary lubrication: f is near its largest, and has no sampling error."""
    patch = lubfric.friction(SCENE.with_(lubricant={"limiting_stress_coefficient": "f_b"}), 1e-3).uncertainty
    assert "numerics.sampling" in patch.narrows_sampling and "contact.shape" in patch.narrows_sampling
    assert "map" not in patch.narrows_sampling and np.isnan(patch.interval).all()
    assert patch.cut and all(text.startswith("the interval without the sampling error ends") for text in patch.cut)


def test_a_former_name_of_the_recommendation_names_that_of_today():
    with pytest.raises(AttributeError, match="recommendation"):
        entry(6.0).remedy
    with pytest.raises(AttributeError, match="recommendation"):
        lubfric.InputError("text").way_out


@pytest.mark.parametrize("sliding, is_opposed", [(-2.5133, False), (-2.55, True)])
def test_rounded_speeds_of_a_body_at_rest_do_not_make_it_move_against_the_other(sliding, is_opposed):
    """A follower at rest on the base circle of a cam, with speeds of four digits: U = 1.2566 m/s, u2 - u1 = -2.5133
    m/s."""
    scene = PAPER.with_(motion={"slide_roll_ratio": sliding / 1.2566})
    found = [violation.consequence for violation in violations_by_motion(scene, 1.2566, 3e-7)]
    assert any("opposite directions" in consequence for consequence in found) == is_opposed


@pytest.mark.parametrize("model", ["paper", "quick", "deterministic"])
def test_asperity_pressures_that_no_steel_carries_have_a_warning(model):
    """The pressures of the drawn contact show which: elastic ones rise with the slope of the roughness."""
    numerics = {"model": model, "sampling": "patch", "accept": True}
    patch = {"shape": (64, 16), "spacing": 2e-6}
    scene = PAPER.with_(bodies={"hardness": None, "load": 20.0}, contact=patch, numerics=numerics)
    rough = [{"correlation_length": 4e-6, "sq": sq} for sq in (0.1e-6, 0.8e-6)]
    flat, steep = (lubfric.friction(scene.with_(surface=each), 0.01) for each in rough)
    assert flat.pressure.max() < 8e9 and steep.pressure.max() > 10e9
    (warning,) = (each for each in steep.validity if "bodies.hardness" in each.recommendation)
    assert not warning.is_note and "pressure is" in warning.text
    assert not any("bodies.hardness" in each.recommendation for each in flat.validity)
    hard = lubfric.friction(scene.with_(surface=rough[1], bodies={"hardness": 7e9}), 0.01)
    assert hard.pressure.max() <= 7e9 and not any("bodies.hardness" in each.recommendation for each in hard.validity)


def test_advice_at_several_points_has_the_smallest_and_the_largest_of_their_known_times():
    times = (math.nan, 2.4, 46.0)
    points = [(0.1 * k, (replace(entry(8.0), recommendation_seconds=time),)) for k, time in enumerate(times, 1)]
    (text,) = gathered(points)
    assert text.endswith("It slides. Recommendation (about 2 to 50 s of processor time a point): less.")
    (in_table,) = gathered_in_table([violations for _, violations in points])
    assert in_table.text.endswith("It slides. Recommendation (about 2 to 50 s of processor time a point): less.")
    assert gathered(points[:1])[0].endswith("It slides. Recommendation: less.")
    points += [(0.4, (replace(entry(7.0), recommendation="more", recommendation_seconds=300.0),))]
    (text,) = gathered(points)  # the time is that of its own recommendation
    assert text.endswith(
        "Recommendation at 3 speeds, 0.1 to 0.3 m/s (about 2 to 50 s of processor time a point): less."
    )


def test_advice_to_solve_by_the_deterministic_model_has_the_time_that_info_states_for_it():
    on_patch = {"contact": {"shape": (128, 64), "spacing": 0.9e-6}}
    numerics = {"sampling": "patch", "model": "quick", "model_tolerance": 0.01, "accept": True}
    scene = lubfric.load_scene("paper").with_(**on_patch, numerics=numerics)
    point = lubfric.friction(scene, 0.03)
    (of_model,) = [each for each in point.validity if each.assumption == Assumption.MODEL_FORM_ERROR]
    named = lubfric.prepare(scene.with_(numerics={"model": "deterministic"}))
    stated = estimate_scene(named.scene, named.sample, named.surface, [0.03]).seconds
    assert math.isclose(of_model.recommendation_seconds, stated, rel_tol=1e-9)
    digit = float(f"{stated:.0e}")
    assert f"Recommendation (about {digit:g} s of processor time a point): set numerics.model = " in of_model.text


@pytest.mark.parametrize("peak, is_bounded", [(3e9, False), (7.83e9, True)])
def test_a_peak_at_the_plastic_limit_is_said_to_be_that_of_yielding_asperities(peak, is_bounded):
    """100Cr6 of 7.83 GPa: a peak film pressure there is no property of the oil."""
    scene = PAPER.with_(bodies={"hardness": 7.83e9}, lubricant={"limiting_stress_coefficient": 0.05})
    (found,) = violations_by_pressure(scene, peak, "of single cells")
    assert ("asperities yield at 7.83 GPa, the plastic limit" in found.text) == is_bounded
