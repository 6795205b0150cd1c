"""What one input changes between two points of a study, by hand; and why f and the power loss have different orders."""

import math
from dataclasses import replace

import numpy as np
import pytest
from small_study import SCENE, made_study

import lubfric
from lubfric.output import study_answer, study_pictures, study_tables
from lubfric.studies import differences, single_changes

OIL = SCENE.with_(
    lubricant={"grade": "ISO VG 46", "viscosity_index": 95, "temperature_celsius": 80},
    bodies={"boundary_friction_coefficient": [0.12, 0.09, 0.15]},
    motion={"slide_roll_ratio": 0.01},
)
GRADES = {
    ("lubricant.grade", "lubricant.temperature_celsius"): [("ISO VG 46", 80), ("ISO VG 46", 100), ("ISO VG 68", 80)]
}
F = np.array([0.11963, 0.12007, 0.11921])
OWN = 0.014


def made(plan, f, *, common=0.25, own=OWN, **others):
    """A study with made numbers: f with a relative error by an input that its points have in ``common``, and an ``own``
    one; a power loss of 10 W f and a rolling resistance of 0 unless ``others`` give them."""
    f = np.reshape(f, plan.shape)
    half = math.hypot(common, own)
    loss = np.reshape(others.pop("power_loss", 10 * f), plan.shape)
    zero = np.zeros(plan.shape)
    names = lubfric.study(SCENE, {}, [0.3]).columns
    columns = dict.fromkeys(names, zero) | {"coefficient": f, "power_loss": loss, "film_load": zero + 1.0}
    columns |= {"interval_low": f * (1 - half), "interval_high": f * (1 + half)}
    columns |= {"power_loss_low": loss * (1 - half), "power_loss_high": loss * (1 + half)}
    columns |= {"numerical_error": zero + own, "input_error": zero + common}
    return made_study(plan, columns | {name: np.reshape(values, plan.shape) for name, values in others.items()})


def graded(**others):
    return made(lubfric.plan_study(OIL, GRADES, [0.3]), F, **others)


def test_points_that_differ_in_one_input_alone_are_compared_without_their_common_error():
    """Three points of two grades and two temperatures have one pair of each; the input of 25 % that both points share
    leaves 25 % of the difference."""
    result = graded()
    changes = single_changes(result)
    assert [(change.rows, list(change.before)) for change in changes] == [
        ((0, 2), ["lubricant.grade"]),
        ((0, 1), ["lubricant.temperature_celsius"]),
    ]
    for name, size in (("coefficient", F), ("power_loss", 10 * F)):
        (change,) = differences(result, name, [(0, 1)])
        error = math.hypot(0.25 * (size[1] - size[0]), OWN * math.hypot(size[0], size[1]))
        assert change.value == size[1] - size[0] and change.interval[1] - change.value == pytest.approx(error, rel=1e-9)
        assert change.value - change.interval[0] == pytest.approx(error, rel=1e-9) and not change.is_distinct


def test_model_form_errors_at_different_conditions_are_independent():
    """At two temperatures 10 % each of 0.1 and 0.2 are 0.022 together; of two roughnesses they are correlated."""
    scene = OIL.with_(numerics={"model": "paper"})
    for key, values, correlation in (
        ("lubricant.temperature_celsius", [80, 100], 0.0),
        ("surface.sq", [1e-7, 2e-7], 0.75),
    ):
        result = made(lubfric.plan_study(scene, {key: values}, [0.3]), [0.1, 0.2], common=0.0, own=0.0)
        f = result["coefficient"]
        ends = {"model_error": 0.0 * f + 0.1, "interval_low": 0.9 * f, "interval_high": 1.1 * f}
        (change,) = differences(replace(result, columns=result.columns | ends), "coefficient", [(0, 1)])
        square = 0.01**2 + 0.02**2 - 2 * correlation * 0.01 * 0.02
        assert change.interval[1] - change.value == pytest.approx(math.sqrt(square))


def test_what_one_input_changes_is_stated_with_the_error_of_the_difference():
    film = [23.1e-9, 16.1e-9, 28.2e-9]
    lines = study_answer.answer_lines(graded(full_load_film=film))
    (of_grade, of_temperature) = (line for line in lines if line.startswith("From "))
    assert "grade ISO VG 46 to ISO VG 68, at temperature of the oil 80 °C (points 1 and 3)" in of_grade
    assert "temperature of the oil 80 to 100 °C, at grade ISO VG 46 (points 1 and 2), f changes by +0.4 % (-1.6 to" in (
        of_temperature
    )
    assert "full-load film by -30 % (23.1 to 16.1 nm)" in of_temperature
    assert "These changes of f and the power loss cannot be distinguished from 0" in of_temperature
    assert not any("not known, because" in line for line in lines)
    assert sum("cannot be distinguished from the smallest" in line for line in lines) == 2
    distinct = study_answer.answer_lines(graded(own=1e-5))
    assert not any("cannot be distinguished from" in line for line in distinct)


def test_an_input_without_such_a_pair_is_named():
    keys = ("lubricant.grade", "surface.sq", "bodies.width")
    rows = [("ISO VG 46", 1e-7, 1e-3), ("ISO VG 68", 1e-7, 1e-3), ("ISO VG 46", 2e-7, 2e-3), ("ISO VG 68", 3e-7, 1e-3)]
    lines = study_answer.answer_lines(made(lubfric.plan_study(OIL, {keys: rows}, [0.3]), [0.1, 0.11, 0.12, 0.13]))
    assert [line.partition(" (points")[2][:8] for line in lines if line.startswith("From ")] == [" 1 and 2", " 2 and 4"]
    assert any(
        line.startswith("What length of the line contact does by itself is not known, because") for line in lines
    )


@pytest.mark.parametrize("rolling, is_stated", [([9.7, 5.7, 13.1], True), ([9.7, 13.1, 5.7], False)])
def test_the_reason_for_another_order_of_the_power_loss_is_the_rolling_resistance(rolling, is_stated):
    resistance = 1e-3 * np.array(rolling) / 0.3
    lines = study_answer.answer_lines(graded(power_loss=[0.297, 0.294, 0.299], rolling_resistance=resistance))
    reason = (
        "because the rolling resistance of both surfaces, a part of it, is 5.7 mW at point 2 and 13.1 mW at point 3"
    )
    assert (f"The power loss is smallest at point 2 and f at point 3, {reason}." in lines) == is_stated


def test_the_reason_is_the_product_of_load_and_sliding_speed_where_that_differs():
    plan = lubfric.plan_study(OIL, {"bodies.load": [10.0, 20.0]}, [0.3])
    lines = study_answer.answer_lines(made(plan, [0.12, 0.11], power_loss=[0.0036, 0.0066]))
    expected = "because load times sliding speed is 30 mW at point 1 and 60 mW at point 2."
    assert f"The power loss is smallest at point 1 and f at point 2, {expected}" in lines


def test_a_given_pressure_viscosity_coefficient_that_stays_the_same_is_a_warning():
    given = OIL.with_(lubricant={"pressure_viscosity_coefficient": [17.5e-9, 12.2e-9, 20.1e-9]})
    plan = lubfric.plan_study(given, GRADES, [0.3])
    assert any(
        "pressure_viscosity_coefficient = 17.5 1/GPa is used at all values of" in text for text in plan.warnings()
    )
    one = [("ISO VG 46", 80), ("ISO VG 46", 80)]
    column = {"lubricant.pressure_viscosity_coefficient": [17e-9, 12e-9]}
    for scene, vary in (
        (OIL, GRADES),
        (given, {next(iter(GRADES)): one}),
        (given, {"lubricant.temperature_celsius": [80, 100], **column}),
        (given, {"lubricant.oil": ["fva-3", "pao-94"]}),
    ):
        assert not any("is used at all values of" in text for text in lubfric.plan_study(scene, vary, [0.3]).warnings())


def test_a_path_of_contact_states_what_its_points_do_not_show():
    """Between the points around the pitch point the power loss is the rolling resistance; at a point there it is
    computed."""
    path = {"position": [-2e-3, -1e-3, 1e-3], "speed": [2.0, 2.0, 2.0], "slide_roll_ratio": [0.2, 0.1, -0.1]}
    rolling = {"rolling_resistance": [1.6, 1.7, 1.9]}
    lines = study_answer.answer_lines(made(lubfric.plan_study(OIL, points=path), [0.05, 0.04, 0.06], **rolling))
    assert any("smallest power loss of the computed points is" in line for line in lines)
    assert any("all with the same weight, is 0.05" in line and "mean friction" in line for line in lines)
    (reversal,) = (line for line in lines if line.startswith("Between points 2 and 3 the sliding changes"))
    assert "rolling resistance, 3.40 to 3.80 W" in reversal
    still = lubfric.plan_study(OIL, points=path | {"slide_roll_ratio": [0.2, 0.0, -0.1]})
    assert not any("changes its direction" in line for line in study_answer.answer_lines(made(still, F, **rolling)))


def test_a_study_of_one_point_states_its_numbers_once():
    path = {"position": ["-4.6259 mm"], "speed": [2.0], "slide_roll_ratio": [0.2]}
    (numbers, *others) = study_answer.answer_lines(made(lubfric.plan_study(OIL, points=path), [0.05]))
    assert numbers.startswith("The friction coefficient is 0.050 (") and "and the power loss is 500 mW (" in numbers
    assert numbers.endswith("at point 1 (position -4.6259 mm).") and not any("power loss" in line for line in others)


def test_the_table_of_points_has_the_digits_of_their_own_errors_and_the_viscosity():
    result = graded(contact_load=[0.9904, 0.9946, 0.9863], film_load=[0.0096, 0.0054, 0.0137])
    page = study_tables.table_of_points(result, 3, [])
    assert all(f">{text}<" in page for text in ("0.1196", "0.1201", "0.1192", "0.9904", "0.9946", "0.986"))
    viscosities = [scene.lubricant.viscosity for scene in result.plan.scenes]
    assert "[mPa s]" in page and all(f">{1e3 * value:.3g}<" in page for value in viscosities)
    loads = lubfric.plan_study(OIL, {"bodies.load": [10.0, 20.0]}, [0.3])
    assert "[mPa s]" not in study_tables.table_of_points(made(loads, [0.12, 0.11]), 2, [])


def figure_of(result, tmp_path, monkeypatch):
    """The figure that is drawn of a study."""
    figures = []
    monkeypatch.setattr("matplotlib.figure.Figure.savefig", lambda figure, *_, **__: figures.append(figure))
    study_pictures.plot_study(tmp_path / "study.png", result)
    return figures[0]


def test_a_panel_has_the_points_that_differ_in_its_input_alone(tmp_path, monkeypatch):
    """Of three points two in each panel; the axis shows the part of the intervals that counts in differences, the square
    root of half the square of the error of the difference."""
    result = graded()
    (grade, temperature) = figure_of(result, tmp_path, monkeypatch).axes
    for axes, rows in ((grade, [0, 2]), (temperature, [0, 1])):
        (line,) = axes.lines
        np.testing.assert_allclose(line.get_ydata(), F[rows])
    (change,) = differences(result, "coefficient", [(0, 2)])
    half = (change.interval[1] - change.value) / math.sqrt(2)
    bars = grade.collections[1].get_segments()
    np.testing.assert_allclose([np.ptp(bar[:, 1]) for bar in bars], 2 * half)
    assert grade.get_ylim()[0] > 0.115 and grade.get_ylim()[1] < 0.125


@pytest.mark.parametrize("own, begins_at_0", [(0.006, False), (0.25, True)])
def test_differences_of_one_input_are_drawn_where_a_common_error_hides_them(own, begins_at_0, tmp_path, monkeypatch):
    plan = lubfric.plan_study(OIL, {"lubricant.temperature_celsius": [60, 80, 100]}, [0.3])
    (axes, *_) = figure_of(made(plan, [0.121, 0.118, 0.115], own=own), tmp_path, monkeypatch).axes
    assert (axes.get_ylim()[0] == 0) == begins_at_0


def test_several_numbers_of_an_input_have_their_unit():
    plan = lubfric.plan_study(OIL, {"surface.correlation_length": [[1e-5, 5e-5], [4e-5, 2e-4]]}, [0.3])
    assert "correlation length 10 x 50 to 40 x 200 µm" in " ".join(study_answer.answer_lines(made(plan, [0.1, 0.2])))
    assert "10 x 50 µm, 40 x 200 µm" in plan.explain()
