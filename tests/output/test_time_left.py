"""The time left of a study: by work that is counted inside its points, and by the time since one ended."""

import io
import sys
import time

import numpy as np
import pytest
from small_study import SCENE

import lubfric
from lubfric import studies
from lubfric.output import ProgressLine, TimeLeft, main, progress, run_history
from lubfric.output.time_left import LEFT_OF_LATE
from lubfric.time import RunEstimate


class Machine:
    """A clock, and the work that is counted on it."""

    def __init__(self):
        self.now = 50.0
        self.work = 7.0

    def run(self, seconds, rate=1.0):
        self.now += seconds
        self.work += rate * seconds

    def left(self, expected, processes=1):
        return TimeLeft(expected, processes, clock=lambda: self.now, spent=lambda: self.work)


def test_points_that_take_as_long_as_estimated_leave_the_rest_of_the_estimate():
    machine = Machine()
    estimates = {"a": 20.0, "b": 10.0, "c": 30.0}
    left = machine.left(estimates)
    passed = 0.0
    for point, seconds in estimates.items():
        for _ in range(4):
            assert left.seconds == pytest.approx(60.0 - passed)
            machine.run(seconds / 4)
            passed += seconds / 4
        left.end(point)
    assert left.seconds == 0.0


def test_the_time_left_falls_inside_a_point_and_grows_on_a_slow_machine():
    (usual, slow) = (Machine(), Machine())
    lines = [machine.left({"a": 20.0, "b": 20.0}) for machine in (usual, slow)]
    seconds = []
    for _ in range(9):
        usual.run(2.0)
        slow.run(2.0, rate=0.5)
        seconds.append([line.seconds for line in lines])
    fast = [pair[0] for pair in seconds]
    assert fast == sorted(fast, reverse=True) and fast[-1] == pytest.approx(22.0)
    assert seconds[-1][1] > 1.5 * (40.0 - 9.0)  # 9 s of work in 18 s


def test_other_programs_that_begin_slow_the_time_left_within_a_minute():
    """A core does half of its work in the last of three points, each as long as estimated."""
    machine = Machine()
    left = machine.left(dict.fromkeys("abc", 100.0))
    for point in "ab":
        for _ in range(10):
            machine.run(10.0)
            assert left.seconds == pytest.approx(300.0 - machine.work + 7.0)
        left.end(point)
    for _ in range(7):
        machine.run(10.0, rate=0.5)
        shown = left.seconds
    assert shown == pytest.approx(2 * (100.0 - 35.0))


def test_the_time_left_of_a_run_in_time_follows_the_expected_course_of_its_steps():
    """Four fifths of the steps are around a reversal, between two outputs. A run that takes twice its estimate: the
    time left grew to 2.4 times as much before the first output."""
    course = {"times": np.array([0.0, 0.4, 0.6, 1.0]), "steps_until": np.array([0.0, 10.0, 90.0, 100.0])}
    run = RunEstimate(steps=100.0, seconds=120.0, start_seconds=20.0, **course)
    machine = Machine()
    left = run_history.time_left_of_run(run, clock=lambda: machine.now, spent=lambda: machine.work)
    machine.run(20.0)
    left.end(next(iter(left.expected)))
    moments = np.linspace(0.0, 1.0, 201)
    parts = [run.part(moment) for moment in moments]
    shown = [left.seconds]
    for moment, part in zip(moments[1:], np.diff(parts)):
        machine.run(200.0 * part)
        for end in [end for end in left.expected if end <= moment]:
            left.end(end)
        shown.append(left.seconds)
    true = 200.0 * (1.0 - np.array(parts))
    assert shown[0] == pytest.approx(100.0) and shown[-1] == 0.0
    growth = shown / np.maximum(np.minimum.accumulate(shown), 5.0)
    assert growth.max() < 1.3
    np.testing.assert_allclose(shown[100:], true[100:], rtol=0.15, atol=4.0)


def test_more_than_was_estimated_is_extrapolated_from_what_was_taken():
    """It said nine times "longer than estimated". A part that takes longer needs a part of what it took; another one as
    much more as those before it."""
    machine = Machine()
    left = machine.left({"a": 10.0, "b": 10.0})
    machine.run(19.0)
    of_b = 10.0 * ((1.0 + LEFT_OF_LATE) * 19.0 + 10.0) / (10.0 + 10.0)
    assert left.seconds == pytest.approx(LEFT_OF_LATE * 19.0 + of_b)
    machine.run(2.0)
    assert left.seconds > LEFT_OF_LATE * 19.0 + of_b and "left" in left.in_words(3.0)
    left.end("a")
    assert left.seconds == pytest.approx(10.0 * (21.0 + 10.0) / (10.0 + 10.0))
    left.end("b")
    assert left.in_words() == ""


def test_points_of_two_processes_correct_the_others_by_all_that_ended():
    """Seven points that take three times their estimates, of different lengths: from the second that ended on, the time
    left is within 40 % of the true one, and never longer than what a point more would add."""
    machine = Machine()
    estimates = dict(zip("abcdefg", [30.0, 18.0, 18.0, 18.0, 18.0, 18.0, 30.0]))
    left = machine.left(estimates, processes=2)
    ends = {"a": 90.0, "b": 54.0, "c": 108.0, "d": 144.0, "e": 162.0, "f": 198.0, "g": 252.0}
    begun = machine.now
    for point, end in sorted(ends.items(), key=lambda pair: pair[1]):
        machine.now = begun + end
        left.end(point)
        if point not in "bg":
            assert left.seconds == pytest.approx(252.0 - end, rel=0.4)


def test_longer_points_lengthen_the_others():
    machine = Machine()
    left = machine.left(dict.fromkeys("abcd", 10.0))
    machine.run(30.0)
    left.end("a")
    assert left.seconds == pytest.approx(3 * 10.0 * (30.0 + 10.0) / (10.0 + 10.0))
    left.end("not one of them")
    assert list(left.expected) == ["b", "c", "d"]


@pytest.mark.parametrize("times, rate", [(5.0, 1.0), (0.5, 1.0), (4.0, 0.3)])
def test_the_time_left_does_not_grow_from_the_second_point_on_at_one_pace(times, rate):
    """Points of two lengths take so many times their estimates, on a core that is shared: what is left is known."""
    machine = Machine()
    estimates = {name: (8.0 if number % 2 else 12.0) for number, name in enumerate("abcdefgh")}
    left = machine.left(estimates)
    remaining = sum(estimates.values()) * times / rate
    for number, (name, seconds) in enumerate(estimates.items(), 1):
        machine.run(seconds * times / rate, rate)
        remaining -= seconds * times / rate
        left.end(name)
        if number >= 2:
            assert left.seconds == pytest.approx(remaining)


def test_a_time_left_that_no_one_waits_for_is_no_number():
    assert Machine().left({"a": 2e-5}).in_words() == ", less than 0.1 s left"


def test_a_point_that_is_known_takes_no_time_and_says_nothing_of_the_others():
    machine = Machine()
    left = machine.left(dict.fromkeys("abc", 10.0))
    left.omit("a")
    assert left.seconds == pytest.approx(20.0)
    machine.run(5.0)
    assert left.seconds == pytest.approx(15.0)


def test_several_processes_share_the_points():
    machine = Machine()
    left = machine.left(dict.fromkeys(range(8), 10.0), processes=4)
    assert left.seconds == pytest.approx(20.0)
    machine.now += 5.0  # the work is counted elsewhere
    assert left.seconds == pytest.approx(15.0)
    machine.now += 5.0
    for point in range(4):
        left.end(point)
    assert left.seconds == pytest.approx(10.0)


def test_the_work_of_a_point_is_about_what_is_expected_of_it():
    """Both are seconds of a usual core; the estimate is within a factor of 3 in most cases."""
    plan = lubfric.plan_study(SCENE, {"bodies.load": [3.0, 4.0]}, [0.1, 0.3])
    (text, expected, _) = studies.explained(plan)
    assert text.startswith(plan.explain().partition("  time ")[0]) and list(expected) == [
        (key, speed) for key in plan.keys for speed in (0.1, 0.3)
    ]
    assert sum(expected.values()) == pytest.approx(studies.estimated_study(plan), rel=0.5)
    left = TimeLeft({"all": 1000.0}, clock=lambda: 0.0)  # of a machine without a clock the work alone counts
    lubfric.study(plan)
    work = (1000.0 - left.seconds) / (1.0 + left.seconds / 5.0)
    assert 0.02 < work / sum(expected.values()) < 50


def test_a_pipe_gets_a_line_where_none_came_for_long(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(progress, "REFRESH", 0.01)
    monkeypatch.setattr(progress, "SILENCE", 0.05)
    with ProgressLine("points", TimeLeft({"a": 40.0, "b": 40.0}, spent=time.monotonic)) as shown:
        shown.update(0, 2)
        time.sleep(0.15)
    lines = stream.getvalue().splitlines()
    assert 1 <= len(lines) <= 3 and lines[0].startswith("0 of 2 points, ") and "about 80 s left" in lines[0]


def test_the_command_states_the_time_left_after_the_first_point(tmp_path, capsys):
    (tmp_path / "s.toml").write_text(SCENE.to_toml())
    (tmp_path / "study.toml").write_text('scene = "s.toml"\nspeeds = [0.1, 0.3]\n[vary]\nbodies.load = [3.0, 4.0]\n')
    assert main(["study", str(tmp_path / "study.toml"), "--out", str(tmp_path / "out")]) == 0
    points = " ".join(capsys.readouterr().err.split()).split("] point ")[1:]
    assert ["left)" in text for text in points] == [True, True, True, False]
