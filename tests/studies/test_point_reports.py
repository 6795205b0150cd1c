"""Each point of a study is reported when it is solved: to ``on_point``, and by the command in a line with f and P."""

import math
import re
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
from small_study import SCENE

import lubfric
from lubfric.output import main
from lubfric.output.study_warnings import why_no_intervals
from lubfric.units import with_interval

SPEEDS = [0.01, 0.1]


def reported(**arguments):
    points = []
    result = lubfric.study(SCENE, on_point=lambda *point: points.append(point), **arguments)
    return result, points


@pytest.mark.parametrize(
    "arguments",
    [
        {"vary": {"bodies.load": [3.0, 5.0], "lubricant.viscosity": [0.2, 0.3]}, "speeds": SPEEDS},
        {"points": {"speed": SPEEDS, "load": [3.0, 5.0]}, "vary": {"lubricant.viscosity": [0.2, 0.3]}},
        {"vary": {"bodies.load": [3.0]}, "speeds": "auto"},
    ],
    ids=["grid", "points", "chosen"],
)
def test_each_point_is_reported_once_at_its_place(arguments):
    result, points = reported(**arguments)
    assert len(points) == result.solved
    for done, total, index, outcome in points:
        assert outcome.coefficient == result["coefficient"][index]
        assert 0 <= done <= total
    assert len({index for _, _, index, _ in points}) == result.solved


def test_threads_report_in_this_process_and_failures_are_outcomes():
    with ThreadPoolExecutor(2) as executor:
        result, points = reported(vary={"contact.spacing": [1.1e-6, 1e-4]}, speeds=SPEEDS, executor=executor)
    failed = [index for _, _, index, outcome in points if isinstance(outcome, lubfric.LubfricError)]
    assert sorted(failed) == [(1, 0), (1, 1)] and result.failed == 2


def test_points_without_an_interval_are_counted():
    """A single patch has no sampling error, so that its points have no interval."""
    result, _ = reported(speeds=SPEEDS)
    count = int(np.isnan(result["interval_low"]).sum())
    assert count > 0 and f"without interval {count}" in repr(result)
    strips = lubfric.study(SCENE.with_(numerics={"sampling": "strips", "model": "paper"}), speeds=SPEEDS)
    assert "without interval" not in repr(strips)


def test_the_report_says_where_a_patch_has_no_interval_and_how_short_it_is_there():
    """Where roughness moves, 4 times the load has a Hertz strip twice as wide, and the same patch half as many
    half-widths."""
    scene = SCENE.with_(motion={"slide_roll_ratio": 0.5}, numerics={"model": "paper"})
    result = lubfric.study(scene, vary={"bodies.load": [1.0, 4.0]}, speeds=[0.1])
    low = np.array([0.01, np.nan]).reshape(result.status.shape)
    words = why_no_intervals(replace(result, columns=result.columns | {"interval_low": low}))
    assert "not known at 1 point (total load 4 N)" in words
    here, there = (float(number) for number in re.search(r"is ([\d.]+) half-widths .* and ([\d.]+) at", words).groups())
    assert there / here == pytest.approx(2, rel=0.01)
    assert here == pytest.approx(48 * 1.1e-6 / scene.with_(bodies={"load": 4.0}).bodies.half_width, rel=0.01)
    assert why_no_intervals(replace(result, columns=result.columns | {"interval_low": np.ones_like(low)})) == ""


def test_points_of_a_store_are_not_reported_again(tmp_path):
    reported(speeds=SPEEDS[:1], store=tmp_path)
    assert [index for _, _, index, _ in reported(speeds=SPEEDS, store=tmp_path)[1]] == [(1,)]


def test_command_writes_f_and_power_of_each_point(tmp_path, capsys):
    (tmp_path / "scene.toml").write_text(SCENE.to_toml())
    (tmp_path / "t.csv").write_text("position [mm],speed [m/s],load [N]\n-1,0.01,3\n2,0.1,5\n")
    out = tmp_path / "out"
    assert main(["study", str(tmp_path / "scene.toml"), "--points", str(tmp_path / "t.csv"), "--out", str(out)]) == 0
    lines = [line for line in capsys.readouterr().err.splitlines() if line.startswith("[")]
    for number, (place, load, speed) in enumerate([("-1 mm", 3.0, 0.01), ("2 mm", 5.0, 0.1)], 1):
        point = lubfric.friction(SCENE.with_(bodies={"load": load}), speed)
        power = with_interval(point.power_loss, *point.power_loss_interval, unit="W")
        start = f"[{number}/2] point {number} (position {place}): f = {point.coefficient:.3g}"
        assert lines[number - 1].startswith(start[:-1]) and f"P = {power} (" in lines[number - 1]
        is_unknown = math.isnan(point.uncertainty.interval[0])
        assert is_unknown == ("(95 % interval not known), P" in lines[number - 1])
    stated = r" \(wall-clock time of the point [\d.]+ s, of the study so far \d+ s(, [a-z ]+[\d.]+ s left)?\)$"
    assert [bool(re.search(stated, line)[1]) for line in lines] == [True, False]
