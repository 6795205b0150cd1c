"""The best combination of design at each operating condition, found again with loops over the points."""

import itertools
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from small_study import SCENE, made_study

import lubfric
from lubfric.models.shared import violations_by_typical_heat
from lubfric.output import best_designs, study_answer, study_pictures, study_report
from lubfric.studies import design_keys, operating_keys
from lubfric.units import with_interval

LOADS = [3.0, 5.0, 8.0]
SQ = [5e-8, 1e-7, 2e-7]
MATERIALS = ["100Cr6", "silicon nitride"]
SPEEDS = [0.1, 1.0]
VARY = {"surface.sq": SQ, "bodies.load": LOADS, "bodies.material": MATERIALS}


def made(f, half_width, scene=SCENE, **plan):
    """A study of ``VARY`` at ``SPEEDS`` with made numbers: nothing is solved."""
    planned = lubfric.plan_study(scene, **({"vary": VARY, "speeds": SPEEDS} | plan))
    columns = {"coefficient": f, "interval_low": f - half_width, "interval_high": f + half_width}
    columns |= {"power_loss": 10 * f, "power_loss_low": 10 * (f - half_width), "power_loss_high": 10 * (f + half_width)}
    columns |= {"film_load": np.ones(planned.shape), "model_error": half_width / np.abs(f)}
    numbers = dict.fromkeys(lubfric.study(SCENE, {}, [0.3]).columns, np.zeros(planned.shape)) | columns
    return made_study(planned, numbers)


RANDOM = np.random.default_rng(3)
F = RANDOM.uniform(0.05, 0.1, (3, 3, 2, 2))
WIDTH = RANDOM.uniform(0.001, 0.02, F.shape)


def test_the_best_design_of_each_condition_is_that_of_loops_over_the_points():
    found = {tuple(one.condition.values()): one for one in made(F, WIDTH).best()}
    assert len(found) == len(LOADS) * len(SPEEDS)
    for (j, load), (m, speed) in itertools.product(enumerate(LOADS), enumerate(SPEEDS)):
        one = found[load, speed]
        designs = {(sq, name): (i, k) for (i, sq), (k, name) in itertools.product(enumerate(SQ), enumerate(MATERIALS))}
        ordered = sorted(designs, key=lambda design: F[designs[design][0], j, designs[design][1], m])
        (i, k) = designs[ordered[0]]
        assert tuple(one.design.values()) == ordered[0] and one.value == F[i, j, k, m]
        assert one.row == np.ravel_multi_index((i, j, k, m), F.shape) + 1 and one.compared == 6
        near = []
        for design in ordered[1:]:
            (a, b) = designs[design]
            (one_width, other_width) = (WIDTH[i, j, k, m], WIDTH[a, j, b, m])
            # .75 up to a factor of 2 of Sq, .5 at a factor of 4, none between materials
            correlation = {0: 0.75, 1: 0.75, 2: 0.5}[abs(a - i)] if b == k else 0.0
            square = one_width**2 + other_width**2 - 2 * correlation * one_width * other_width
            if F[a, j, b, m] - F[i, j, k, m] <= math.sqrt(square):
                near.append(design)
        assert [tuple(rival.values()) for rival in one.rivals] == near


@pytest.mark.parametrize("width, count", [(0.0, 0), (1.0, 5), (math.nan, 5)])
def test_points_are_told_apart_as_their_intervals_are_narrow_or_wide(width, count):
    result = made(F, width * np.ones(F.shape))
    assert {len(one.rivals) for one in result.best()} == {count}
    words = " ".join(best_designs.best_lines(result))
    expected = {
        0: "by more than the error of the difference",
        1: "cannot be distinguished from any of the 5 other",
    }.get(width, "interval is not known")
    assert expected in words


def test_the_mean_over_all_conditions_has_the_mean_of_the_intervals():
    mean = made(F, WIDTH).best_mean()
    means = F.mean(axis=(1, 3))
    (i, k) = np.unravel_index(means.argmin(), means.shape)
    assert mean.design == {"surface.sq": SQ[i], "bodies.material": MATERIALS[k]} and mean.row is None
    width = WIDTH.mean(axis=(1, 3))[i, k]
    assert mean.value == pytest.approx(means.min())
    assert mean.interval == pytest.approx((means.min() - width, means.min() + width))


def test_a_condition_without_sliding_has_no_best_f_and_no_part_in_the_mean():
    """Designs whose order is reversed there: f of rolling resistance, much smaller, would decide."""
    f = np.array([[0.05, 2e-4], [0.06, 1e-4]])
    cycle = {"speed [m/s]": [0.1, 0.2], "motion.slide_roll_ratio": [0.2, 0.0]}
    result = made(f, 0.0 * f, vary={"surface.sq": SQ[:2]}, speeds=None, points=cycle)
    forces = {"couette_force": [[1.0, 0.0]] * 2, "rolling_force": [[0.1, 0.1]] * 2}
    rolls = replace(result, columns=result.columns | {name: np.array(values) for name, values in forces.items()})
    (one,) = rolls.best()
    assert one.value == 0.05 and one.design == {"surface.sq": SQ[0]} and len(result.best()) == 2
    assert rolls.best_mean() is None and len(rolls.best("power_loss")) == 2


def test_a_cycle_is_compared_by_its_mean_power_loss_weighted_by_the_durations():
    cycle = {"load [N]": [3, 5], "speed [m/s]": [0.1, 0.2], "position [m]": [0, 1], "duration [s]": [1.0, 9.0]}
    f = np.array([[0.05, 0.09], [0.09, 0.05]])  # (Sq, point): the second is better where it counts
    result = made(f, 0.0 * f, vary={"surface.sq": SQ[:2]}, speeds=None, points=cycle)
    assert result.best_mean("power_loss").design == {"surface.sq": SQ[1]}
    assert result.best_mean("power_loss").value == pytest.approx(10 * (0.1 * 0.09 + 0.9 * 0.05))
    assert [one.design["surface.sq"] for one in result.best()] == SQ[:2]
    assert "position on the path of contact 1 m" in best_designs.best_table(result)
    assert "The table of the report has a row for each condition." in " ".join(best_designs.best_lines(result))


def test_seeds_and_numerics_are_no_design():
    plan = lubfric.plan_study(
        SCENE, {"surface.seed": [1, 2], "surface.sq": SQ, "numerics.heat": ["auto", "off"]}, [0.1]
    )
    assert lubfric.studies.design_keys(plan) == ("surface.sq",)
    assert "designs  (surface.sq) are compared at each condition (surface.seed, numerics.heat)" in plan.explain()


def test_all_columns_of_a_table_of_operating_points_are_conditions():
    """The radius of a gear flank is no choice: it changes along the path of contact. In a table of radii alone it is
    one."""
    path = {"radius [mm]": [4, 5], "load [N]": [3, 5], "speed [m/s]": [0.1, 0.2]}
    scene = lubfric.load_scene("paper")
    flank = lubfric.plan_study(scene, {"surface.sq": [1e-7, 2e-7]}, points=path)
    assert operating_keys(flank) == ("bodies.radius", "bodies.load", "speed") and design_keys(flank) == ("surface.sq",)
    assert "designs" not in lubfric.plan_study(scene, points=path).explain()
    radii = lubfric.plan_study(scene, points={"radius [mm]": [4, 5], "speed [m/s]": [0.1, 0.1]})
    assert design_keys(radii) == ("bodies.radius",)


def test_a_negative_f_counts_by_its_magnitude():
    f = np.array([-0.02, 0.01])
    result = made(f[:, None], np.array([[0.001], [0.03]]), vary={"surface.sq": SQ[:2]}, speeds=[0.1])
    (one,) = result.best()
    assert one.value == 0.01 and one.interval == pytest.approx((0.0, 0.04))


def test_curves_that_chose_their_speeds_are_not_compared():
    result = made(F[..., :1], WIDTH[..., :1], speeds=[0.1])
    chosen = replace(result, plan=replace(result.plan, speeds=()))
    with pytest.raises(lubfric.InputError, match="give the same speeds"):
        chosen.best()
    assert best_designs.best_lines(chosen) == []


def test_the_report_has_a_row_for_each_condition_with_what_it_cannot_be_distinguished_from():
    result = made(F, WIDTH)
    page = study_report.study_page(result, {}, study_answer.answer_lines(result)).decode()
    part = page.split("Lowest friction at each operating condition")[1].split("</table>")[0]
    rows = re.findall(r"<tr>(.*?)</tr>", part, re.DOTALL)[1:]
    for row, one in zip(rows, result.best(), strict=True):
        cells = re.findall(r"<td[^>]*>([^<]*)</td>", row)
        (number, interval, row_number, rivals) = cells[2:]
        low, high = map(float, interval.split(" to "))
        assert low <= float(number) <= high and float(number) == pytest.approx(one.value, rel=0.05)
        assert row_number == str(one.row)
        numbers = re.findall(r"no\. (\d+)", rivals)
        assert [int(number) for number in numbers] == [*one.rival_rows[:3], *sorted(one.rival_rows[3:])][: len(numbers)]
        assert (rivals == "none") == (not one.rivals)


def test_a_study_marks_the_points_without_the_heat_of_the_film():
    """In its answer and its status, with how many they are and the largest change."""
    result = made(F, WIDTH)
    violations = result.violations.copy()
    for number, change in ((3, 0.2), (7, 0.6)):
        violations.flat[number] = tuple(violations_by_typical_heat(SCENE, change))
    without = replace(result, violations=violations)
    words = (
        f"At 2 of {F.size} points f and its interval are without the heat of the film, which lowers f by up to 60 % "
        "(at point 8)."
    )
    for study, is_marked in ((without, True), (result, False)):
        lines = study_answer.answer_lines(study)
        page = study_report.study_page(study, {}, lines).decode()
        assert any(words in line for line in lines) == is_marked == (words in page.partition("<table")[0])


@pytest.mark.parametrize("film", [1e-9, 1.01e-9, 3.4e-9, 6e-9])
def test_a_study_says_what_a_smallest_film_of_1_nm_is(film):
    """A mean over strips some of which have that gap is little more."""
    result = made(F, WIDTH)
    result = replace(result, columns=dict(result.columns) | {"min_film": np.full(F.shape, film)})
    page = study_report.study_page(result, {}, study_answer.answer_lines(result)).decode()
    assert ("A smallest film of 1 nm is the gap that the deterministic model assumes" in page) == (film < 5e-9)
    assert ("one below 5 nm is a mean" in page) == (1e-9 < film < 5e-9)


def test_combinations_that_are_not_listed_or_drawn_are_counted(tmp_path, monkeypatch):
    cycle = {"load [N]": [3, 5], "speed [m/s]": [0.1, 0.2], "position [m]": [0, 1]}
    f = RANDOM.uniform(0.05, 0.1, (12, 2))
    result = made(f, 0.0 * f, vary={"surface.sq": np.linspace(5e-8, 2e-7, 12).tolist()}, speeds=None, points=cycle)
    lines = study_answer.answer_lines(result)
    assert sum("mean power loss of the operating points" in line for line in lines) == 6
    assert any(line.startswith("The means of 6 other combinations are not listed") for line in lines)
    titles = []
    monkeypatch.setattr("lubfric._base.figures.head", lambda figure, title: titles.append(title))
    study_pictures.plot_study(tmp_path / "study.png", result)
    assert titles[0].endswith("the first 10 of 12 combinations; study.csv has all")


def with_shared_range(vary, f, part, own=0.0):
    """A study of two designs with made f, whose interval has a relative ``part`` by ranges of inputs and an ``own``
    one."""
    scene = SCENE.with_(bodies={"boundary_friction_coefficient": [0.09, 0.15]})
    values = np.array(f)[:, None]
    made_study = made(values, values * math.hypot(part, own), scene=scene, vary=vary, speeds=[0.1])
    parts = {"input_error": np.full(values.shape, part), "model_error": np.full(values.shape, own)}
    return replace(made_study, columns=made_study.columns | parts)


@pytest.mark.parametrize("own, count", [(0.0, 0), (0.15, 0), (0.3, 1)])
def test_a_range_that_designs_share_leaves_the_difference_of_what_it_changes(own, count):
    """f of 0.05 and 0.08, each +-40 % by the range, move together, from a difference of 0.018 to one of 0.042."""
    result = with_shared_range({"bodies.material": MATERIALS}, [0.05, 0.08], 0.4, own)
    (one,) = result.best()
    assert len(one.rivals) == count == (0.03 < math.hypot(0.4 * 0.03, own * 0.05, own * 0.08))
    assert one.interval[1] > 0.08 * (1 - 0.4)  # the intervals overlap nevertheless


@pytest.mark.parametrize(
    "vary, model, is_alike",
    [
        ({"surface.sq": SQ[:2]}, "paper", True),
        ({"surface.sq": SQ[:2]}, "quick", True),
        ({"surface.sq": SQ[:2]}, "deterministic", False),
        ({"bodies.material": MATERIALS}, "paper", False),
        ({"lubricant.eyring_stress": [4e6, 6e6]}, "paper", False),
    ],
)
def test_similar_designs_share_most_of_the_model_form_error(vary, model, is_alike):
    """f of 0.05 and 0.08 with 40 % each: independent, the difference is uncertain by 0.038; with a correlation of .75
    by 0.021."""
    f = np.array([[0.05], [0.08]])
    scene = SCENE.with_(numerics={"model": model})
    (one,) = made(f, 0.4 * f, scene=scene, vary=vary, speeds=[0.1]).best()
    assert (not one.rivals) == is_alike


@pytest.mark.parametrize("part", ["model_error", "numerical_error"])
@pytest.mark.parametrize("towards, count", [(0.025, 1), (0.001, 0)])
def test_errors_count_by_the_sides_that_face_each_other(part, towards, count):
    """f of 0.05 and 0.08: with 0.025 above the first and below the second, the difference is uncertain by 0.035,
    otherwise by 0.001."""
    away = 0.026 - towards
    f = np.array([[0.05], [0.08]])
    result = made(f, 0.0 * f, vary={"bodies.material": MATERIALS}, speeds=[0.1])
    sides = {
        "interval_low": f - [[away], [towards]],
        "interval_high": f + [[towards], [away]],
        "model_error": 0.0 * f,
        part: 0.025 / f,
    }
    (one,) = replace(result, columns=result.columns | sides).best()
    assert len(one.rivals) == count


def test_a_range_of_an_input_that_is_varied_is_not_shared():
    vary = {"bodies.boundary_friction_coefficient": [[0.09, 0.15], [0.1, 0.16]]}
    (one,) = with_shared_range(vary, [0.05, 0.08], 0.4).best()
    assert len(one.rivals) == 1


def test_a_range_that_moves_one_design_alone_is_not_left_out():
    """As f_b of a design that touches beside one with a full film."""
    result = with_shared_range({"surface.sq": SQ[:2]}, [0.05, 0.08], 0.4)
    unlike = {
        "input_error": np.array([[0.0], [0.4]]),
        "interval_low": np.array([[0.05], [0.048]]),
        "interval_high": np.array([[0.05], [0.112]]),
    }
    (one,) = replace(result, columns=result.columns | unlike).best()
    assert len(one.rivals) == 1


def test_parts_of_the_variance_are_plain_percents():
    """Where errors of f are as wide as f, an input may explain nearly all of it."""
    rng = np.random.default_rng(1)
    f = F * np.exp(0.02 * rng.standard_normal(F.shape))
    (line, *_) = (text for text in study_answer.answer_lines(made(f, 0.9 * f)) if "ln f" in text)
    ends = re.findall(r"\(([\d.]+) to ([\d.e+]+) %", line)
    assert ends and all("e" not in end for pair in ends for end in pair)


def test_the_answer_begins_with_the_best_design_and_says_where_one_wins_everywhere():
    f = F.copy()
    f[1, :, 0, :] = 0.01
    result = made(f, 1e-5 * np.ones(f.shape))
    mean = result.best_mean()
    (best, *lines) = study_answer.answer_lines(result)
    winner = "root mean square height Sq 100 nm, "
    assert best.startswith(f"The mean friction coefficient over all operating conditions is lowest with {winner}")
    assert with_interval(mean.value, *mean.interval) in best and "lower than with all 5 other combinations" in best
    assert lines[0].startswith(f"One design has the lowest f at all 6 operating conditions: {winner}")
    assert lines[1].startswith("Part of the variance of ln f that each input alone explains")
    f[2, 1, 0, 0] = 0.005
    (best, *lines) = study_answer.answer_lines(made(f, WIDTH))
    assert lines[0].startswith(f"Of 6 operating conditions f is lowest with {winner}") and " at 5; with " in lines[0]
    assert "At all of them the lowest f has material 100Cr6." in lines[0]
    (one, *_) = sorted(made(f, WIDTH).best(), key=lambda one: one.value)
    least = with_interval(0.005, *one.interval)
    assert f"from {least} to 0.01" in lines[0]
    page = study_report.study_page(made(f, WIDTH), {}, [best, *lines]).decode()
    assert re.search(r'<p class="answer">The mean friction.*Of 6 operating conditions.*variance', page, re.DOTALL)
    assert "only the difference of their effects" in page and "report.html has all" not in page


def test_a_study_states_the_largest_change_by_an_estimated_pressure_viscosity_coefficient():
    """That of the single runs of its points, with the number of the point; the plan has no other number for it."""
    graded = SCENE.with_(
        lubricant={"grade": "ISO VG 46", "viscosity_index": 95, "temperature_celsius": 60}, numerics={"model": "paper"}
    )
    plan = lubfric.plan_study(graded, {"bodies.load": LOADS[:2]}, [2.0])
    changes = {}
    for number, scene in enumerate(plan.scenes, 1):
        point = lubfric.friction(scene, 2.0)
        assert "the range of measured oils, which changes f by at most" in point.not_in_interval
        (changes[number],) = (effect.change for effect in point.unmodelled_effects if effect.is_of_alpha)
    (line,) = (line for line in study_answer.answer_lines(lubfric.study(plan)) if "measured oils" in line)
    assert "At all points, by closed forms" in line
    assert "give lubricant.pressure_viscosity_coefficient = [value, low, high]" in line
    stated = re.search(r"by at most about (\S+) % either way \(at point (\d)\);", line)
    worst = max((1, 2), key=lambda number: changes[number])
    assert int(stated[2]) == worst
    assert float(stated[1]) == pytest.approx(100 * changes[worst], rel=0.06)
    (before,) = (text for text in plan.explain().splitlines() if "measured oils" in text)
    assert "the report states by how much this changes f" in before and "%" not in before
    given = graded.with_(lubricant={"pressure_viscosity_coefficient": 2e-8})
    assert "measured oils" not in lubfric.plan_study(given, {"bodies.load": LOADS[:2]}, [2.0]).explain()


def test_a_study_that_goes_on_states_the_estimated_coefficient_as_before(tmp_path):
    graded = SCENE.with_(
        lubricant={"grade": "ISO VG 46", "viscosity_index": 95, "temperature_celsius": 60}, numerics={"model": "paper"}
    )

    def plan_at(speeds):
        return lubfric.plan_study(graded, points={"load": LOADS[: len(speeds)], "speed": speeds})

    def stated(plan, *store):
        return next((line for line in plan.explain(*store).splitlines() if "measured oils" in line), "")

    plan = plan_at([0.01, 2.0])
    lubfric.study(plan_at([0.01]), store=tmp_path)
    assert "kept     1 of 2" in plan.explain(tmp_path)
    assert stated(plan, tmp_path) == stated(plan) != ""


@pytest.mark.parametrize("loads, compared", [((5.0, 3.0, 8.0), False), ((5.0, 3.0, 3.0), True)])
def test_designs_that_have_no_condition_in_common_are_not_compared(loads, compared):
    """Each roughness has a load of its own, as in a drawn sample; or two of three have one in common."""
    together = {("surface.sq", "bodies.load"): list(zip(SQ, loads))}
    text = lubfric.plan_study(SCENE, vary=together, speeds=[0.3]).explain()
    result = made(np.array([[0.05], [0.07], [0.06]]), np.full((3, 1), 1e-3), vary=together, speeds=[0.3])
    assert ("are compared at each condition" in text) == compared
    assert ("designs are not compared" in text) == (not compared)
    assert ("Designs are not compared" in " ".join(best_designs.best_lines(result))) == (not compared)
    assert bool(lubfric.studies.best(result)) == compared
