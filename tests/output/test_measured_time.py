"""The time that `lubfric info` measures on the first steps of a strip of moving roughness."""

import math
import time
from importlib import import_module

import pytest

import lubfric
from lubfric.estimate import estimated_work_of_point
from lubfric.models import MeasuredTime, models_up_to
from lubfric.models.deterministic import expected_way
from lubfric.output import described_scene, main

NEEDLE = """
name = "needle"
bodies = { radii = ["1.5 mm", "20 mm"], width = "20 mm", load = "600 N", material = "100Cr6", boundary_friction_coefficient = 0.12 }
motion = { entrainment_speed = "0.05 m/s", slip_percent = "2 %" }
surface = { ra = "0.2 µm", correlation_length = ["40 µm", "4 µm"], acf = "gaussian" }
contact = { shape = [64, 64], spacing = ["4 µm", "2 µm"] }
lubricant = { grade = "ISO VG 46", viscosity_index = 95, temperature = "80 °C", eyring_stress = "5 MPa" }
"""


@pytest.fixture
def needle(tmp_path):
    file = tmp_path / "needle.toml"
    file.write_text(NEEDLE, encoding="utf-8")
    return file


def measured_time(over_expected, speed=0.05):
    return MeasuredTime(speed=speed, over_expected=over_expected, steps=10, seconds=1.0)


def seconds_of(text):
    """The seconds that ``text`` states of its speeds."""
    return float(text.replace("\n        ", " ").partition("cost: about ")[2].partition(" s of processor")[0])


def test_info_measures_the_first_steps_of_rolling(needle, capsys):
    assert main(["info", str(needle)]) == 0
    text = capsys.readouterr().out
    assert "measured on 10 steps in time of a strip at 0.05 m/s, in" in " ".join(text.split())
    assert 0 < seconds_of(text) < math.inf


@pytest.mark.slow
def test_the_measured_time_is_within_a_factor_of_two_of_what_the_point_takes(needle, capsys):
    """In the same process: a whole point is solved."""
    assert main(["info", str(needle)]) == 0
    text = capsys.readouterr().out
    begun = time.process_time()
    result = lubfric.friction(lubfric.load_scene(needle))
    taken = time.process_time() - begun
    assert result.decision.model == "deterministic"
    assert taken / 2 <= seconds_of(text) <= 2 * taken


def test_a_measured_time_moves_the_estimate_of_its_model_alone(needle):
    prepared = lubfric.prepare(lubfric.load_scene(needle))
    at = (prepared.scene, prepared.sample, prepared.surface, 0.05)
    expected = estimated_work_of_point(*at)
    of_other = estimated_work_of_point(*at, {"paper": [measured_time(1.0)]})
    doubled = estimated_work_of_point(*at, {"deterministic": [measured_time(2.0)]})
    assert of_other == expected
    assert doubled.slow_strip_seconds == pytest.approx(2 * expected.slow_strip_seconds)
    assert doubled.seconds - expected.seconds == pytest.approx(
        expected.slow_strips * expected.slow_strip_seconds, rel=0.5
    )
    limited = prepared.scene.with_(numerics={"max_work": 1.0})
    far_longer = {"deterministic": [measured_time(100.0)]}
    assert estimated_work_of_point(limited, *at[1:], far_longer).seconds < 2.0


def test_between_two_measured_speeds_the_time_follows_a_power_of_the_speed(needle):
    """The ratio to the expected time is 0.4 at 0.05 m/s and 0.9 at 5 m/s, so 0.6 at their geometric mean."""
    prepared = lubfric.prepare(lubfric.load_scene(needle))
    times = {"deterministic": [measured_time(0.9, 5.0), measured_time(0.4)]}
    for speed, ratio in {0.05: 0.4, 0.5: 0.6, 5.0: 0.9, 0.01: 0.4, 9.0: 0.9}.items():
        at = (prepared.scene, prepared.sample, prepared.surface, speed)
        expected = estimated_work_of_point(*at).slow_strip_seconds
        assert estimated_work_of_point(*at, times).slow_strip_seconds == pytest.approx(ratio * expected)


def test_roughness_travels_further_for_a_smaller_sampling_error(needle):
    """Twice as far for half of the error, between the distance at which the error is known first and a complete pass."""
    scene = lubfric.load_scene(needle)
    prepared = lubfric.prepare(scene)
    (coarse, some, more, fine) = (
        expected_way(
            scene.with_(numerics={"sampling_tolerance": tolerance}), prepared.sample, sq=prepared.surface.sq, speed=0.05
        )
        for tolerance in (0.5, 0.04, 0.02, 0.001)
    )
    assert coarse == 1.5 < some and more == pytest.approx(2 * some) and more < fine
    assert fine == pytest.approx(256e-6 / scene.bodies.half_width)


def test_info_measures_the_slowest_and_the_fastest_speed(needle, monkeypatch, capsys):
    """One speed where they are near: the one that takes the longest."""
    (slow,) = [type(model) for model in models_up_to("auto") if model.has_slow_strips]
    speeds = []
    monkeypatch.setattr(slow, "measure_time", lambda self, prepared, speed: speeds.append(speed) or measured_time(1.0))
    assert main(["info", str(needle), "--speeds", "0.05,0.3,0.6"]) == 0
    assert speeds == [0.05, 0.6] and "measured on 20 steps" in " ".join(capsys.readouterr().out.split())
    assert main(["info", str(needle), "--speeds", "0.05,0.1"]) == 0
    assert len(speeds) == 3 and speeds[-1] in (0.05, 0.1)


def test_what_is_said_before_a_run_leads_to_what_is_measured(needle):
    said = " ".join(lubfric.output.describe_scene(lubfric.load_scene(needle)).split())
    assert (
        "of processor time for 1 speed (within a factor of 3 in four of five cases; 'lubfric info' measures it" in said
    )


def test_info_at_rest_solves_nothing(monkeypatch, capsys):
    """Nor where roughness moves, but a strip takes little."""

    def unexpected(*given, **named):
        raise AssertionError("something was solved")

    monkeypatch.setattr("lubfric.models.deterministic.first_steps.strip_at_rest", unexpected)
    assert main(["info", "paper"]) == 0
    assert "measured on" not in capsys.readouterr().out


def test_a_rolling_contact_has_cells_enough(needle):
    """Six in the half-width of the rough contact, √(b² + 2 R Sq) = 32 µm, where roughness moves; of a body at rest two
    in that of the Hertz strip, b = 21.5 µm."""
    rolling = lubfric.load_scene(needle)
    at_rest = rolling.with_(motion={"slip_percent": 200.0})
    along = [lubfric.prepare(scene).sample.cells.spacing[0] for scene in (rolling, at_rest)]
    assert along == pytest.approx([4e-6, 8e-6])
    fine = rolling.with_(contact={"spacing": [1e-6, 2e-6], "shape": [256, 64]})
    assert lubfric.prepare(fine).sample.cells.spacing[0] == pytest.approx(4e-6)


def test_info_makes_the_surface_and_the_estimate_of_each_speed_once(needle, monkeypatch):
    """Also where it measures a strip, for which the scene is made ready."""
    scene = lubfric.load_scene(needle).with_(motion={"speeds": (0.05, 0.5, 2.0)})
    made = []
    estimated = []
    measured = []
    for module in (import_module("lubfric.models.prepare"), import_module("lubfric.output.describe")):
        sample_of = module.sample_of
        monkeypatch.setattr(
            module, "sample_of", lambda *given, of=sample_of, **named: made.append(1) or of(*given, **named)
        )
    (slow,) = [type(model) for model in models_up_to("auto") if model.has_slow_strips]
    estimate_work = slow.estimate_work

    def counted(self, scene, sample, surface, speed, cheaper):
        estimated.append(speed)
        return estimate_work(self, scene, sample, surface, speed, cheaper)

    monkeypatch.setattr(slow, "estimate_work", counted)
    monkeypatch.setattr(slow, "measure_time", lambda self, prepared, speed: measured.append(prepared.scene))
    described_scene(scene, measures=True)
    assert made == [1] and measured == [scene, scene]
    assert sorted(estimated) == [0.05, 0.5, 2.0]


def test_a_run_states_the_time_that_info_states(needle, monkeypatch, tmp_path, capsys):
    """One function gives both; nothing is solved here."""
    (slow,) = [type(model) for model in models_up_to("auto") if model.has_slow_strips]
    measured = measured_time(0.4)
    monkeypatch.setattr(slow, "measure_time", lambda self, prepared, speed: measured)
    for model in models_up_to("auto"):
        monkeypatch.setattr(type(model), "solve", refuse)
    speeds = ["--speeds", "0.05, 0.5"]
    assert main(["info", str(needle), *speeds]) == 0
    in_info = " ".join(capsys.readouterr().out.split()).partition("cost: ")[2].partition(" for start")[0]
    assert main(["run", str(needle), *speeds, "--out", str(tmp_path / "out"), "--workers", "1"]) != 0
    in_run = " ".join(capsys.readouterr().err.split()).partition("estimate: ")[2].partition(" for start")[0]
    assert "measured on 20 steps" in in_info and in_run == in_info


def refuse(*_args, **_named):
    """Solve nothing."""
    raise lubfric.ConvergenceError("not solved")
