"""Runs in time: the interval and the power loss of every output and of the mean, against steady answers and sums."""

import csv
import math
import re
from dataclasses import replace
from html import unescape

import numpy as np
import pytest
from scene_text import paper_scene
from scipy.optimize import brentq

import lubfric
from lubfric._base import read_table
from lubfric.models.load_sharing import MomentResponse, moment_model_error
from lubfric.output import describe_scene, history_answer, main
from lubfric.scene import Harmonic, Ramp, Transient
from lubfric.time import PARTS_NOT_IN_TIME, counts_in_average
from lubfric.time.result import largest_friction_in_time

SMALL = {"shape": (48, 48), "spacing": 1.8e-6}
# A coarse film, where its numbers are not the matter.
LOOSE = {"tolerance": 0.05}
PATCH = LOOSE | {"sampling": "patch"}
STRIPS = paper_scene(motion={"entrainment_speed": 0.02}, bodies={"boundary_friction_coefficient": 0.09})
RUN = STRIPS.with_(transient=lubfric.Transient(3e-3))


@pytest.fixture(scope="module")
def held():
    """At one speed throughout: a steady contact."""
    return lubfric.transient(STRIPS, [0.0, 1e-3, 3e-3])


def test_a_steady_contact_has_the_model_form_error_of_the_steady_answer(held):
    steady = lubfric.friction(STRIPS)
    assert held.uncertainty.model[-1] == pytest.approx(steady.uncertainty.model, rel=0.05)
    half = np.diff(held.uncertainty.interval[-1]) / 2
    np.testing.assert_allclose(half, np.diff(steady.uncertainty.interval) / 2, rtol=0.1)
    assert held.power_loss[-1] == pytest.approx(steady.power_loss, rel=5e-3)
    np.testing.assert_allclose(
        [held.power_loss_low[-1], held.power_loss_high[-1]], steady.power_loss_interval, rtol=0.03
    )


def test_the_model_form_error_by_heat_is_that_of_the_steady_answer():
    """A thick film with a hot inlet: without heat the error is less than half as large."""
    hot = paper_scene(
        motion={"entrainment_speed": 2.0},
        lubricant={"grade": "ISO VG 220", "viscosity_index": 95, "temperature_celsius": 60},
        numerics={"sampling": "patch", "film_deflection": "hydrodynamic", "accept": True},
    )
    steady = lubfric.friction(hot)
    run = lubfric.transient(hot.with_(transient=Transient(1e-4, outputs=1)))
    sides = [run.model_error_low[-1], run.model_error_high[-1]]
    np.testing.assert_allclose(sides, steady.uncertainty.model_sides, rtol=0.01)
    assert 3.2 / run.film_to_roughness_ratio[-1] ** 2 < 0.5 * min(sides)


@pytest.mark.parametrize("contact_load", [0.4, 2.0, 5.0])
def test_the_sensitivity_of_f_at_a_moment_is_that_of_a_balance_solved_again(contact_load):
    """G = G0 - softness ln F_C and h = c F_H^-n meet; the film is changed by a millionth, and friction forces are
    proportional to the loads. The shear stress of a given division adds its own part."""
    total = 5.5
    softness = 6e-8
    exponent = 0.8
    film = 2e-7
    boundary = 0.1 * contact_load
    viscous = 0.02 * (total - contact_load)

    def friction(change):
        def excess(load):
            gap = film - softness * math.log(load / contact_load)
            return gap - film * (1 + change) * ((total - load) / (total - contact_load)) ** -exponent

        load = brentq(excess, 0.9 * contact_load, min(1.1 * contact_load, 0.999 * total), xtol=1e-15, rtol=1e-14)
        return 0.1 * load + 0.02 * (total - load)

    by_division = (friction(1e-6) - friction(-1e-6)) / (2e-6 * (boundary + viscous))
    response = MomentResponse(
        contact_load=contact_load,
        film_load=total - contact_load,
        boundary=boundary,
        viscous=viscous,
        softness=softness,
        film_load_exponent=exponent,
        mean_film=film,
    )
    assert response.per_film(viscous) == pytest.approx(abs(by_division) + viscous / (boundary + viscous), rel=1e-5)


def test_the_sampling_error_of_a_moment_does_not_depend_on_how_it_was_reached():
    """A film of constant speed, and one that has come to this speed slowly from a lower one."""
    scene = paper_scene(contact=SMALL, motion={"entrainment_speed": 0.03}, numerics={"sampling_tolerance": 0.1})
    slow_start = Ramp(start=0.02, end=0.03, until=0.02)
    plans = (Transient(duration=0.03, outputs=1), Transient(duration=0.03, outputs=1, speed=slow_start))
    held, slowed = (lubfric.transient(scene.with_(transient=plan)) for plan in plans)
    assert slowed.coefficient[-1] == pytest.approx(held.coefficient[-1], rel=1e-3)
    assert slowed.uncertainty.sampling[-1] == pytest.approx(held.uncertainty.sampling[-1], rel=0.01)


def test_the_mean_is_the_integral_over_the_cycle_and_its_interval_that_of_the_ends(held):
    mean = held.average()
    duration = held.time[-1] - held.time[0]
    for number, column in zip(
        (mean.power_loss, *mean.power_loss_interval, *mean.interval),
        (held.power_loss, held.power_loss_low, held.power_loss_high, *held.uncertainty.interval.T),
    ):
        assert number == pytest.approx(np.trapezoid(column, held.time) / duration)
    assert mean.interval[0] < mean.coefficient < mean.interval[1]
    assert held.cite().splitlines()[0] == lubfric.friction(STRIPS).cite().splitlines()[0]


def test_moments_of_rolling_do_not_count_in_the_mean_of_f_but_in_that_of_the_power(held):
    """At the pitch point of a gear f falls to that of rolling."""
    rolling = {"couette_force": 0.0, "boundary_force": 0.0, "coefficient": 1e-3}
    columns = {name: held.columns[name] * np.array([1.0, factor, 1.0]) for name, factor in rolling.items()}
    columns["rolling_force"] = held.columns["rolling_force"] + np.array([0.0, 1e-3, 0.0])
    run = replace(held, columns=held.columns | columns)
    assert run.average().coefficient == pytest.approx(held.coefficient[[0, 2]].mean(), rel=0.01)
    assert run.average().power_loss == held.average().power_loss


def test_the_time_of_a_mean_is_that_of_the_outputs(held):
    later = replace(held, columns=held.columns | {"time": held.time + 0.06})
    for run, words in ((held, "over 3 ms is "), (later, "over the time from 60 ms to 63 ms is ")):
        assert history_answer.history_answer(RUN, run, complete=True)[0].startswith(
            f"The mean friction coefficient {words}"
        )


def test_the_largest_f_and_the_lambda_ratios_of_a_run_are_those_of_its_motion(held):
    """At a reversal a frequency of nine digits leaves some 1e-8 of the speed."""
    slow = {"entrainment_speed": 1e-8, "sliding_speed": 1e-8, "lambda_ratio": 1e-8, "coefficient": 10.0}
    columns = {name: held.columns[name] * np.array([1.0, factor, 1.0]) for name, factor in slow.items()}
    text = " ".join(history_answer.history_answer(RUN, replace(held, columns=held.columns | columns), complete=True))
    pattern = r"largest f is (\S+) .*lies between (\S+) and (\S+); 1 output without entrainment has none\. "
    largest, low, high = re.search(pattern, text).groups()
    assert float(largest) == pytest.approx(held.coefficient.max(), rel=0.01)
    assert [float(low), float(high)] == pytest.approx(held.lambda_ratio[[0, 2]], rel=0.01)


def test_the_thinnest_film_of_a_run_is_stated_with_its_time_and_its_part_of_the_load(held):
    """A film that carries little is thick where asperities keep the surfaces apart."""
    film = held.min_film * np.array([1.0, 0.5, 1.0])
    for carried, words in (
        (0.012, "it carries 1.2 % of the load there, and asperities carry the rest."),
        (1.0, "it carries 100 % of the load there."),
        (0.0, "asperities carry all of the load there."),
    ):
        thin = {name: held.columns[name] / np.array([1.0, 1.0, 3.0]) for name in ("full_load_film", "lambda_ratio")}
        columns = held.columns | {"min_film": film, "contact_load": (1 - carried) * held.load} | thin
        text = " ".join(history_answer.history_answer(RUN, replace(held, columns=columns), complete=True))
        assert re.search(rf"The solved film is thinnest at t = 1 ms: [\d.]+ .m; {words}", text)
        full_load = re.search(r"The full-load film is thinnest at t = 3 ms: [\d.]+ .m, a lambda ratio of (\S+)\.", text)
        assert float(full_load[1]) == pytest.approx(held.lambda_ratio[2] / 3, rel=0.01)
        assert text.index(full_load[0]) < text.index("The solved film")
        assert {*history_answer.named_outputs(RUN, replace(held, columns=columns))} >= {1, 2}


def test_the_full_load_film_of_a_reversal_is_no_answer(held):
    """The speed reverses at 1 ms, where the closed form of the film has 1e-4 of its thickness."""
    speed = Harmonic(amplitude=5.0, frequency=50.0, phase=math.pi - 2 * math.pi * 50.0 * 1e-3)
    scene = RUN.with_(transient=Transient(3e-3, speed=speed))
    factors = {"full_load_film": 1e-4, "lambda_ratio": 1e-4, "entrainment_speed": 1e-3}
    columns = held.columns | {name: held.columns[name] * np.array([1.0, factors[name], 1.0]) for name in factors}
    run = replace(held, columns=columns)
    text = " ".join(history_answer.history_answer(scene, run, complete=True))
    low, high = re.search(
        r"lies between (\S+) and (\S+); 1 output at a reversal or start, .* has none\. ", text
    ).groups()
    assert [float(low), float(high)] == pytest.approx(held.lambda_ratio[[0, 2]], rel=0.01)
    assert not history_answer.have_lambda_ratio(scene, run)[1] and " nm, the Sq of the surface used)" in text


def test_friction_gives_no_power():
    """Rolling, sliding and asperity contacts nearly cancel in f, whose interval is wide: that of the power ends at
    0."""
    sliding = Harmonic(amplitude=0.2, frequency=500.0, phase=3.3)
    scene = paper_scene(contact=SMALL, numerics={"sampling": "patch"}, motion={"entrainment_speed": 0.1})
    run = lubfric.transient(scene.with_(transient=Transient(5e-4, outputs=4, sliding=sliding)))
    assert np.all(run.power_loss > 0) and np.all(run.uncertainty.interval[:, 0] < 0)
    assert np.all(run.power_loss_low >= 0) and np.any(run.power_loss_low == 0)


def test_no_time_of_a_run_has_an_interval_beyond_the_limits_of_the_shear_stress():
    """Asperities carry nearly all: f is f_b, and its interval ends at f_b, or at the upper end of its range."""
    slow = STRIPS.with_(
        motion={"entrainment_speed": 0.001},
        lubricant={"limiting_stress_coefficient": "f_b"},
    )
    for friction, most in ((0.09, 0.09), ([0.09, 0.08, 0.11], 0.11)):
        run = lubfric.transient(slow.with_(bodies={"boundary_friction_coefficient": friction}), [0.0, 1e-3])
        (low, high) = run.uncertainty.interval.T
        assert np.all(run.coefficient > 0.085) and np.all(run.coefficient <= high)
        rolling = 2 * np.abs(run.rolling_force) / run.load  # the rough body is at rest
        np.testing.assert_allclose(run.largest_friction, most + rolling, rtol=1e-9)
        assert np.all(high <= run.largest_friction) and np.all(low < run.coefficient)
        ends = ["ends at the largest f by the limits of the shear stress" in text for text in run.uncertainty.text]
        np.testing.assert_array_equal(ends, high == run.largest_friction)
        np.testing.assert_array_equal(high, run.columns["interval_high"])


@pytest.mark.parametrize(
    ("boundary", "rolling", "sampling", "cause"),
    [
        (0.0, 0.002, 0.0, "pressure on the flanks of moving roughness"),
        (0.008, 0.0, 0.0, "how film and asperities divide the load"),
        (0.0, 0.0, 0.6, "is sampling. To narrow it, set a smaller numerics.sampling_tolerance"),
    ],
)
def test_an_interval_that_reaches_zero_says_why(held, boundary, rolling, sampling, cause):
    """f = 0.01 at a film of 1.5 Sq: flanks may add 8 times the rolling part, and a share of 0.08 may be all film."""
    share = boundary / 0.1
    model = 1.0 if boundary or rolling else 0.1
    parts = {"boundary_force": boundary, "rolling_force": rolling, "couette_force": 0.01 - boundary - rolling}
    of_f = {"coefficient": 0.01, "sampling_error": sampling, "model_error_low": model, "film_to_roughness_ratio": 1.5}
    forces = {name: value * held.load for name, value in (parts | {"contact_load": share}).items()}
    columns = held.columns | forces | {name: np.full(held.time.size, value) for name, value in of_f.items()}
    scene = RUN.with_(motion={"slide_roll_ratio": 0.5})
    run = replace(held, columns=columns, inputs=0.0)
    assert np.all(run.uncertainty.interval[:, 0] == 0.0)
    assert all("begins at the smallest f that resists the sliding" in each for each in run.uncertainty.text)
    assert not any("resists the sliding" in each for each in held.uncertainty.text)
    text = " ".join(history_answer.history_answer(scene, run, complete=True))
    assert f"At 3 outputs, between t = 0 s and {3} ms, the interval of f contains 0" in text and cause in text


def test_all_outputs_whose_interval_contains_zero_are_counted_and_the_steady_point_is_advised_once(held):
    """At the first, rolling resistance makes f negative, at the second it makes most of f, at the third little."""
    forces = {"rolling_force": [-0.006, 0.002, 0.0], "boundary_force": [0.001, 0.001, 0.008], "couette_force": 0.0}
    of_f = {"coefficient": [-0.005, 0.003, 0.008], "model_error_low": 1.2, "model_error_high": 1.5}
    of_f |= {"sampling_error": 0.0, "film_to_roughness_ratio": 1.5, "contact_load": [0.1, 0.1, 0.8] * held.load}
    of_f |= {name: value * held.load for name, value in forces.items()}
    run = replace(
        held, columns=held.columns | {name: np.broadcast_to(value, 3) for name, value in of_f.items()}, inputs=0.0
    )
    low, high = run.uncertainty.interval.T
    assert np.all(low <= 0) and np.all(high >= 0) and not counts_in_average(run.columns)[:2].any()
    text = " ".join(history_answer.history_answer(RUN, run, complete=True) + history_answer.history_notes(RUN, run))
    assert "At 3 outputs, between t = 0 s and 3 ms, the interval of f contains 0" in text
    assert text.count("steady point") == text.count("numerics.model = 'deterministic'") == 1


@pytest.mark.parametrize("boundary", [0.0014, 0.0016])
def test_the_ends_of_f_are_continuous_where_it_changes_its_sign(boundary):
    """A hundredth of the load on asperities, f_b 0.14 or 0.16, and a rolling part of -0.0015: f = -0.0001 or 0.0001 may
    have 0.7 sqrt(s (1 - s)) more of the load on asperities, and no less than none."""
    share = 0.01
    f = boundary - 0.0015
    exchanged = boundary / share + 0.0015 / (1 - share)
    sides = moment_model_error(
        paper_scene().with_(transient=Transient(1e-3)),
        film_to_roughness_ratio=100.0,
        share=share,
        film_load=1.0,
        boundary=boundary,
        shear=-0.0015,
        rolling=-0.0015,
        by_heat=0.0,
    )
    below, above = sides.below_and_above(f)
    expected = (share * exchanged, 0.7 * math.sqrt(share * (1 - share)) * exchanged)
    assert (abs(f) * below, abs(f) * above) == pytest.approx(expected, abs=1e-4)


def test_of_the_largest_friction_of_the_film_only_its_part_of_the_load_counts():
    """f_b is 0.09 on asperities that carry 0, 0.5 and 0.99 of the load; the film may have 0.7 sqrt(s (1 - s)) more of
    it than Eq. (8) says, and at least a tenth."""
    scene = paper_scene(bodies={"boundary_friction_coefficient": 0.09}).with_(transient=Transient(1.0))
    columns = {"time": np.zeros(3), "sliding_speed": np.full(3, 0.1), "load": np.full(3, 5.0)}
    columns |= {"contact_load": np.array([0.0, 2.5, 4.95]), "film_to_roughness_ratio": np.full(3, 2.0)}
    largest = largest_friction_in_time(scene, columns | {"rolling_force": np.zeros(3)}, (0.0, 2.0))
    assert largest[0] > 0.09
    np.testing.assert_allclose((largest - 0.09) / (largest[0] - 0.09), [1.0, 0.85, 0.11])


def test_the_largest_f_with_a_table_of_f_b_is_that_of_the_sliding_speed_of_the_moment():
    """f_b falls from 0.15 to 0.05 between 0 and 1 m/s, and the stress of the oil is limited to f_b p."""
    table = {"sliding_speed": [0, 1], "values": [0.15, 0.05]}
    plan = Transient(1.0, sliding=Ramp(start=0.2, end=-0.8, until=1.0))
    scene = paper_scene(
        bodies={"boundary_friction_coefficient": table}, lubricant={"limiting_stress_coefficient": "f_b"}
    ).with_(transient=plan)
    columns = {"time": np.array([0.0, 1.0]), "sliding_speed": np.array([0.2, -0.8]), "load": np.full(2, 5.0)}
    columns |= {"contact_load": np.full(2, 1.0), "film_to_roughness_ratio": np.ones(2)}
    largest = largest_friction_in_time(scene, columns | {"rolling_force": np.array([0.0, -0.01])}, (0.0, 2.0))
    np.testing.assert_allclose(largest, [0.13, 0.07 + 2 * 0.01 / 5.0])


def test_the_largest_f_of_a_moment_does_not_depend_on_what_follows():
    """Asperities carry all but 0.5 % of the load, so the upper end of the range of f_b alone gives f at the upper end.
    Later the surfaces are so fast that the oil decides the largest f."""
    friction = [0.08, 0.06, 0.11]
    scene = paper_scene(
        contact=SMALL,
        bodies={"boundary_friction_coefficient": friction},
        lubricant={"eyring_stress": 5e6},
        numerics=PATCH,
    )
    faster = Ramp(start=2e-4, end=1.0, until=1e-3)
    of_run = scene.with_(transient=Transient(duration=1.0, speed=faster))
    short, long = (lubfric.transient(of_run, times) for times in ([0.0, 1e-8], [0.0, 1e-8, 3e-4]))
    load_ratio = long.contact_load[1] / long.load[1]
    by_contacts = friction[2] * load_ratio
    film = long.coefficient[1] - friction[0] * load_ratio
    assert long.contact_load[-1] == 0 and load_ratio > 0.99
    assert by_contacts + film <= long.largest_friction[1] == pytest.approx(short.largest_friction[1], rel=1e-3)


def test_the_budget_of_the_mean_is_that_of_a_steady_contact_at_one_speed(held):
    steady = lubfric.friction(STRIPS)
    budget = held.average().budget
    np.testing.assert_allclose(budget["model-form"], steady.uncertainty.model_sides, rtol=0.05)
    assert (
        budget["sampling"][0] == budget["sampling"][1] == pytest.approx(steady.uncertainty.budget["sampling"], rel=0.2)
    )
    assert set(budget) == set(steady.uncertainty.budget) - set(PARTS_NOT_IN_TIME)


def test_the_budget_of_the_mean_is_the_mean_of_the_ends_where_one_part_is_all(held):
    """A mean of half widths, whichever way the surfaces move, and at rest none."""
    f = np.array([0.04, 0.06, -0.05, 0.0])
    columns = dict.fromkeys(held.columns, np.zeros(4)) | {
        "time": np.arange(4.0),
        "coefficient": f,
        "load": np.ones(4),
        "entrainment_speed": np.array([1.0, 1.0, 1.0, 0.0]),
        "model_error_low": np.array([0.5, 0.4, 0.3, np.nan]),
        "model_error_high": np.array([0.1, 0.2, 0.6, np.nan]),
    }
    weight = np.array([0.5, 1.0, 1.5])  # between the third and the standstill f is that of the third
    mean = replace(held, columns=columns, inputs=0.0, requested=()).average()
    below, above = mean.budget["model-form"]
    assert mean.coefficient * (1 - below) == pytest.approx(mean.interval[0])
    assert mean.coefficient * (1 + above) == pytest.approx(mean.interval[1])
    assert below * 3.0 * mean.coefficient == pytest.approx(weight @ [0.02, 0.024, 0.03])
    assert mean.budget["sampling"] == (0.0, 0.0)


def test_friction_drives_no_sliding_but_by_its_rolling_part(held):
    """A model-form error of 300 %: the lower end is 0, or below it by a rolling part that points the way of the
    sliding."""
    count = 3
    columns = dict.fromkeys(held.columns, np.zeros(count)) | {
        "time": np.arange(float(count)),
        "coefficient": np.full(count, 0.01),
        "load": np.full(count, 100.0),
        "entrainment_speed": np.ones(count),
        "sliding_speed": np.array([1.0, 1.0, -1.0]),
        "rolling_force": np.array([0.2, -0.2, 0.2]),
        "model_error_low": np.full(count, 3.0),
        "model_error_high": np.zeros(count),
    }
    low = replace(held, columns=columns, inputs=0.0, requested=()).uncertainty.interval[:, 0]
    assert low[0] == 0.0
    assert low[1] == low[2] and -0.02 < low[1] < -0.002  # eight times the rolling part, at most


def test_the_work_of_sliding_is_the_weighted_mean_of_f_times_load_and_distance(held):
    """By trapezes over four outputs: f F |u2 - u1|, with a load and a speed that change."""
    f = np.array([0.04, 0.06, 0.05, 0.03])
    load = np.array([100.0, 300.0, 200.0, 50.0])
    sliding = np.array([1.0, -0.5, 0.2, 2.0])
    columns = dict.fromkeys(held.columns, np.zeros(4)) | {
        "time": np.array([0.0, 1.0, 3.0, 3.5]),
        "coefficient": f,
        "entrainment_speed": np.ones(4),
        "sliding_speed": sliding,
        "load": load,
        "boundary_force": f * load,
    }
    mean = replace(held, columns=columns, inputs=0.0, requested=()).average()
    slid = load * np.abs(sliding)
    work = np.trapezoid(f * slid, columns["time"])
    assert mean.coefficient_of_losses * np.trapezoid(slid, columns["time"]) == pytest.approx(work, rel=1e-12)


def test_a_reversal_is_reported_without_the_advice_on_percent():
    plan = Transient(0.02, outputs=20, speed=Harmonic(amplitude=0.05, frequency=50.0, phase=1.5), sliding=0.05)
    scene = paper_scene(contact=SMALL, numerics=PATCH).with_(transient=plan)
    text = " ".join(lubfric.transient(scene).validity)
    assert "slide-roll ratio is" in text and "percent" not in text and "motion.sliding_speed over the run" in text
    assert "slide-roll ratio: 2" not in describe_scene(scene)


def test_info_refuses_what_a_run_refuses(tmp_path, capsys):
    plan = Transient(0.02, load=Harmonic(mean=5.5, amplitude=1.0, frequency=50.0))
    scene = paper_scene().with_(transient=plan)
    with pytest.raises(lubfric.InputError) as of_info:
        describe_scene(scene)
    with pytest.raises(lubfric.InputError) as of_run:
        lubfric.transient(scene)
    assert str(of_info.value) == str(of_run.value) and "rises to 6.5 N" in str(of_info.value)


def test_the_report_of_a_run_has_budget_table_and_sources(tmp_path):
    plan = Transient(0.0125, outputs=10, speed=Harmonic(amplitude=0.05, frequency=100.0, phase=1.5))
    (tmp_path / "s.toml").write_text(paper_scene(contact=SMALL, numerics=PATCH).with_(transient=plan).to_toml())
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(tmp_path / "out")]) in (0, 1)
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "<h2>Uncertainty budget</h2><p>Relative errors of the mean friction coefficient," in page
    assert "<h2>Uncertainty budget</h2>" in page and "<h2>Operating points</h2>" in page
    answer = page.partition("<h2>Answer</h2>")[2].partition("<h2>")[0]
    assert "The load-sharing model answers at all times. For a narrower interval" in answer
    assert "(numerics.model_tolerance)" in page.partition("<h2>Answer</h2>")[0]
    times = re.findall(r'<td data-label="time[^"]*" class="number">([^<]*)<', page)
    assert times[0] == "0" and times[-1] == "12.5" and len(set(times)) == len(times) > 5
    assert "The mean power loss is" in page and "Akchurin" in page.partition("Method and sources")[2]
    header = (tmp_path / "out" / "history.csv").read_text().splitlines()[0]
    assert "interval_low [-]" in header and "power_loss_high [W]" in header and "model_error_high [-]" in header


def run_and_page(scene, folder, capsys):
    """What the command says of a run, and its report as text without markup."""
    folder.mkdir()
    (folder / "s.toml").write_text(scene.to_toml())
    assert main(["run", str(folder / "s.toml"), "--out", str(folder / "out")]) in (0, 1)
    page = (folder / "out" / "report.html").read_text(encoding="utf-8")
    return capsys.readouterr().err, unescape(re.sub(r"<[^>]*>", " ", page.partition("</style>")[2]))


def test_the_report_of_a_cycle_states_ranges_signs_and_its_start(tmp_path, capsys):
    """Load and speed of a cycle that begins at rest and slides against the rolling."""
    plan = Transient(
        0.01,
        outputs=20,
        speed=Harmonic(amplitude=0.5, frequency=100.0),
        sliding=Harmonic(amplitude=-0.01, frequency=100.0),
        load=Harmonic(mean=3.0, amplitude=1.0, frequency=100.0),
    )
    hardness = paper_scene().bodies.hardness
    ranges = {"hardness": [hardness, 0.9 * hardness, 1.1 * hardness]}
    said, page = run_and_page(
        paper_scene(contact=SMALL, numerics=PATCH | {"accept": True}, bodies=ranges).with_(transient=plan),
        tmp_path / "a",
        capsys,
    )
    numerical = "numerical (grid of the film; not the steps in time)"
    assert all(" ".join(text.split()).count(numerical) >= 1 for text in (said, page))
    assert all("Range of hardness: not in the interval" in " ".join(text.split()) for text in (said, page))
    assert "under 2 to 4 N" in page and "total load 2 to 4 N over the run" in " ".join(page.split())
    assert "It is negative at" in page
    assert re.search(r"the largest [\d.]+ \S*W \([\d.]+ to [\d.]+ \S*W at 95 %\) at t = [\d.]+ m?s\.", said)
    assert re.search(
        r"The solved film is thinnest at t = [\d.]+ \S+: [\d.]+ .m; (it carries [\d.]+ %|asperities carry all) of the load there",
        said,
    )
    assert re.findall(r"at rest +- +(\S+)", page) == ["0"] * 3  # power loss at the start, the reversal and the end
    with open(tmp_path / "a" / "out" / "history.csv", newline="") as file:
        f = [row["coefficient [-]"] for row in csv.DictReader(file)]
    assert [i for i, cell in enumerate(f) if not cell] == [0, 10, 20] and all(map(float, filter(None, f)))
    (stated,) = re.findall(r"The largest f is (\S+)", said)
    order = (
        "The mean friction",
        "Uncertainty budget of the mean: numerical ",
        "Range of hardness",
        "answers at all times.",
        "wrote ",
    )
    places = [said.index(words) for words in order]
    assert places == sorted(places)
    assert abs(float(stated)) == pytest.approx(max(abs(float(cell)) for cell in f if cell), rel=0.01)
    (last,) = (line for line in said.splitlines() if "t = 0.01 of 0.01 s" in line)
    assert "t = 0.01 of 0.01 s, at rest: no f, F_C = " in last and "U = " not in last
    history = read_table(tmp_path / "a" / "out" / "history.csv")
    assert np.flatnonzero(np.isnan(history["coefficient"])).tolist() == [0, 10, 20]
    assert "The run is not periodic" in page and "the mean contains the start" in page
    assert "100 % of the duration: t = 0.01 of 0.01 s" in said and "without the model-form" not in said + page


def test_an_interval_without_model_form_error_says_so_and_why(tmp_path, capsys):
    plan = Transient(1e-3, outputs=4)
    scene = paper_scene(numerics=LOOSE | {"accept": True}, contact={"region": "box"})
    scene = scene.with_(motion={"entrainment_speed": 0.03}, transient=plan)
    said, page = run_and_page(scene, tmp_path / "a", capsys)
    assert "without the model-form error, which is not known)" in said
    for text in (said, page):
        assert "Why the model-form error is not known: contact.region = 'box'" in text
    assert "95 % interval of f, without model-form error" in page
    known = lubfric.transient(paper_scene(contact=SMALL, numerics=PATCH).with_(transient=plan))
    assert known.model_form_unknown == "" and np.isfinite(known.uncertainty.model).all()


def test_a_run_that_ends_as_it_begins_says_nothing_of_its_start(held):
    assert held.start_in_words == ""
    other = replace(held, columns=held.columns | {"central_film": held.central_film * np.array([1.0, 1.0, 1.1])})
    assert "not periodic" in other.start_in_words
    faster = {"entrainment_speed": held.entrainment_speed * np.array([1.0, 1.0, 1.1])}
    assert replace(other, columns=other.columns | faster).start_in_words == ""


def test_the_second_period_of_two_is_read_alone(tmp_path):
    """Its numbers are those of the second half of a run with all outputs, and it ends as it begins."""
    motion = {
        "speed": Harmonic(amplitude=0.5, frequency=100.0),
        "load": Harmonic(mean=3.0, amplitude=1.0, frequency=100.0),
    }
    scene = paper_scene(contact=SMALL, numerics=PATCH | {"accept": True})
    whole = lubfric.transient(scene.with_(transient=Transient(0.02, outputs=16, **motion)))
    second = scene.with_(transient=Transient(0.02, outputs=8, first_output=0.01, **motion))
    (tmp_path / "s.toml").write_text(second.to_toml())
    result = lubfric.transient(lubfric.load_scene(tmp_path / "s.toml"))
    np.testing.assert_allclose(result.time, whole.time[8:], rtol=1e-12)
    for name in ("coefficient", "contact_load", "central_film"):
        np.testing.assert_allclose(getattr(result, name), getattr(whole, name)[8:], rtol=5e-3)
    between_standstills = whole.coefficient[[9, 10, 11, 13, 14, 15]]
    weight = np.array([1.5, 1.0, 1.5, 1.5, 1.0, 1.5])  # next to a standstill f is that of the output in motion
    assert result.average().coefficient == pytest.approx(weight @ between_standstills / 8, rel=5e-3)
    assert result.start_in_words.startswith("The run is periodic: ")
    by_ratio, by_film = map(
        float, re.search(r"differs by (\S+), .* differs by (\S+) %", result.start_in_words).groups()
    )
    ratio = result.contact_load / result.load
    assert by_ratio == pytest.approx(abs(ratio[-1] - ratio[0]), rel=0.5, abs=1e-12)
    assert by_film == pytest.approx(100 * abs(result.central_film[-1] / result.central_film[0] - 1), rel=0.5)
    first = lubfric.transient(scene.with_(transient=Transient(0.01, outputs=8, **motion)))
    assert "transient.first_output" in first.start_in_words
