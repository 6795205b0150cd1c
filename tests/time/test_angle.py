"""Histories over the angle of a cam or a crank, and results that state it."""

import csv
import math

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH

import lubfric
from lubfric.output import main
from lubfric.scene import unusual_values
from lubfric.time import add_angle_axis

TURNS_PER_SECOND = 25.0  # 1500 1/min
TEXT = BODIES_AND_OIL + SMALL_PATCH + "[motion]\nentrainment_speed = 0.1\n"
LOADS = (2.0, 4.0, 3.0)
ANGLES = (0.0, 90.0, 360.0)


def scene(tmp_path, transient, load="", name="s.toml"):
    (tmp_path / name).write_text(f"{TEXT}[transient]\n{transient}\n{load}")
    return lubfric.load_scene(tmp_path / name)


def test_a_table_over_angles_is_that_over_the_times_at_which_they_are_reached(tmp_path):
    """t = angle/(360° n); a duration of degrees is a time too; and a scene that is written again is the same."""
    over_angles = f'load = {{ kind = "table", angles = {list(ANGLES)}, values = {list(LOADS)}, repeat = true }}'
    turning = 'rotational_speed = "1500 1/min"\nduration = "720 deg"\nfirst_output = "360°"\n'
    found = scene(tmp_path, turning + over_angles).transient
    assert found.rotational_speed == pytest.approx(TURNS_PER_SECOND)
    assert found.duration == pytest.approx(2 / TURNS_PER_SECOND)
    assert found.first_output == pytest.approx(1 / TURNS_PER_SECOND)
    np.testing.assert_allclose(found.load.times, np.array(ANGLES) / 360 / TURNS_PER_SECOND)
    assert found.load.values == LOADS and found.load.at(0.01) == pytest.approx(4.0)
    assert found.angle_at(0.01) == pytest.approx(90.0) and found.moment_in_words(0.01) == "10 ms (90°)"
    (tmp_path / "again.toml").write_text(scene(tmp_path, turning + over_angles).to_toml())
    assert lubfric.load_scene(tmp_path / "again.toml").transient == found
    without = scene(tmp_path, "duration = 0.08").transient
    assert math.isnan(without.angle_at(0.01)) and without.moment_in_words(0.01) == "10 ms"


@pytest.mark.parametrize("heading, factor", [("angle [deg]", 1.0), ("angle", 1.0), ("angle [rad]", math.pi / 180)])
def test_a_column_of_angles_is_in_degrees_or_in_its_unit(tmp_path, heading, factor):
    rows = "\n".join(f"{factor * angle!r},{load}" for angle, load in zip(ANGLES, LOADS))
    (tmp_path / "cam.csv").write_text(f"{heading},load [N]\n{rows}\n")
    history = 'load = { kind = "file", file = "cam.csv", angle_column = "angle", column = "load" }'
    found = scene(tmp_path, f"rotational_speed = 25\nduration = 0.04\n{history}").transient
    np.testing.assert_allclose(found.load.times, [0.0, 0.01, 0.04], atol=1e-15)
    read = lubfric.scene.read_history(tmp_path / "cam.csv", "load", angle_column="angle", rotational_speed=25.0)
    assert read == found.load
    plan = lubfric.Transient(0.04, rotational_speed=25.0, load={"kind": "table", "angles": ANGLES, "values": LOADS})
    assert plan.load == read


@pytest.mark.parametrize(
    "transient, words",
    [
        ('duration = "360 deg"', "angles are given without transient.rotational_speed"),
        ('duration = 0.1\nload = { kind = "table", angles = [0, 360], values = [2, 3] }', "rotational_speed"),
        (
            'rotational_speed = 25\nduration = 0.04\nload = { kind = "table", times = [0, 1], angles = [0, 360], values = [2, 3] }',
            "times and angles",
        ),
        ("rotational_speed = 0\nduration = 0.04", "above 0"),
        ('rotational_speed = "25 m"\nduration = 0.04', "Hz"),
    ],
)
def test_angles_that_say_no_time_are_refused(tmp_path, transient, words):
    with pytest.raises(lubfric.InputError, match=words):
        scene(tmp_path, transient)


def test_a_speed_in_turns_per_minute_without_its_unit_is_questioned(tmp_path):
    plan = scene(tmp_path, "rotational_speed = 3000\nduration = 0.02")
    (value,) = unusual_values(plan)
    assert value.key == "transient.rotational_speed" and "3000 1/min" in value.question


def test_table_picture_and_report_of_a_run_state_the_angle(tmp_path, capsys):
    load = f'load = {{ kind = "table", angles = {list(ANGLES)}, values = {list(LOADS)} }}'
    scene(tmp_path, f'rotational_speed = "1500 rpm"\nduration = "360 deg"\noutputs = 4\n{load}')
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(tmp_path / "o")]) == 0
    with open(tmp_path / "o" / "history.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["angle_of_rotation [°]"]) for row in rows] == pytest.approx([0.0, 90.0, 180.0, 270.0, 360.0])
    said = " ".join(capsys.readouterr().err.split())
    assert "at t = 10 ms (90°)" in said  # the largest power loss, at the largest load
    assert "angle of rotation [°]" in (tmp_path / "o" / "report.html").read_text(encoding="utf-8")
    assert main(["info", str(tmp_path / "s.toml")]) == 0
    said = capsys.readouterr().out
    assert "rotational speed: 1500 1/min, 1 turn in the run" in said and "angle" in said.partition("asperity")[2]


def test_the_axis_of_the_angle_has_round_parts_of_a_turn_at_their_times():
    from matplotlib.figure import Figure

    for last, step in ((40.0, 5.0), (360.0, 45.0), (720.0, 90.0), (3600.0, 720.0)):
        axes = Figure().subplots()
        time = np.linspace(0.0, last / 360 / TURNS_PER_SECOND, 5)
        axes.set_xlim(0.0, 1e3 * time[-1] if time[-1] < 1 else time[-1])
        add_angle_axis(axes, {"time": time, "angle_of_rotation": np.linspace(0.0, last, 5)})
        (axis,) = axes.child_axes
        ticks = axis.get_xticks()
        np.testing.assert_allclose(ticks, np.arange(0.0, last + 1e-9, step))
        axes.figure.draw_without_rendering()
        assert axis.get_xlim() == pytest.approx((0.0, last))
    axes = Figure().subplots()
    add_angle_axis(axes, {"time": time})
    assert not axes.child_axes
