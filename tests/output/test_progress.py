"""The line of progress: on a terminal alone, with the time left, and gone before any other line."""

import io
import re
import sys
import time

import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH

import lubfric
from lubfric.output import ProgressLine, estimate_scene, main, progress
from lubfric.output.commands import moment_reports, say
from lubfric.output.progress import CLEAR_LINE
from lubfric.output.slow_run import SlowRun


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def quick(monkeypatch):
    monkeypatch.setattr(progress, "REFRESH", 0.02)
    monkeypatch.setitem(sys.modules, "tqdm", None)  # the plain line


def test_the_time_left_is_that_of_the_points_left(monkeypatch):
    """Points that the store held took no time: 2 of 10 at the begin, 4 more in 8 s, so that 4 take about 8 s."""
    now = [100.0]
    monkeypatch.setattr(progress.time, "monotonic", lambda: now[0])
    shown = ProgressLine("points")
    shown.update(3, 10)  # the first point that was solved is reported when it ends
    now[0] += 8.0
    shown.update(6, 10)
    assert shown.text == "6 of 10 points, about 8 s passed, about 8 s left" or re.match(
        r"6 of 10 points, .*8 s passed, about .*8 s left", shown.text
    )


def test_a_terminal_sees_a_line_that_other_lines_replace(monkeypatch, quick):
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    with ProgressLine("points") as shown:
        shown.update(1, 4)
        time.sleep(0.1)
        say("a finished line")
        time.sleep(0.05)
    text = stream.getvalue()
    assert f"{CLEAR_LINE}1 of 4 points" in text and " left" in text
    assert f"{CLEAR_LINE}a finished line\n" in text and text.endswith(CLEAR_LINE)


def test_how_far_a_point_is_stands_on_the_line_of_progress_alone(monkeypatch, quick):
    """A line each five seconds for each strip of a point is a page for every point of a study."""
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    with ProgressLine("points") as shown:
        shown.update(1, 4)
        report = moment_reports(0.0)
        report("moving roughness", 2, 10)
        assert shown.text.endswith("; now moving roughness: step 2 of 10")
        shown.update(2, 4)
        assert "moving" not in shown.text
    assert "\n" not in stream.getvalue()


def test_a_slow_run_says_where_it_is_slow_and_what_can_be_done():
    """Of 100 s of a run of 20 ms that is estimated at 200 s: 15 s for each hundredth, then 25 s for one, 5 steps in
    it."""
    now = [7.0]
    slow = SlowRun(200.0, 20e-3, lambda time: 1e3 * time, spent=lambda: now[0])
    slow.begin(0.0, earlier=30.0)
    for step in range(1, 4):
        now[0] += 15.0
        assert not slow.text
        slow.step(2e-4 * step)
    for _ in range(5):
        now[0] += 5.0
        slow.step(6.1e-4)
    assert slow.text.startswith(
        "slow at t = 600 µs, U = 0.6 m/s, 5 steps in 25 s: 100 s of processor time, estimated 3.3 min"
    )
    assert slow.text.endswith("its state is kept, and the same command continues it")
    slow.step(8.1e-4)
    assert not slow.text
    now[0] += 501.0
    slow.step(2e-3)
    assert slow.text.startswith("slow at t = 2 ms, U = 2 m/s: 10 min of")  # three times as long as estimated in all


def test_a_terminal_gets_a_remark_once_on_a_line_of_its_own(monkeypatch, quick):
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    with ProgressLine("points", remark=lambda: "slow here") as shown:
        shown.update(1, 4)
        time.sleep(0.1)
    assert stream.getvalue().count("slow here\n") == 1 and shown.text.endswith("; slow here")


def test_a_file_gets_no_progress(monkeypatch, quick, tmp_path):
    """Nor do the numbers of a run depend on who watches it."""
    tables = []
    for name, stream in (("file", io.StringIO()), ("terminal", Terminal())):
        (tmp_path / "s.toml").write_text(BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.3\n" + SMALL_PATCH)
        monkeypatch.setattr(sys, "stderr", stream)
        out = tmp_path / name
        assert main(["run", str(tmp_path / "s.toml"), "--speeds", "0.1,0.3", "--out", str(out)]) == 0
        assert ("\033" in stream.getvalue() or "\r" in stream.getvalue()) == (name == "terminal")
        tables.append([line.split(",")[1:4] for line in (out / "stribeck.csv").read_text().splitlines()])
    assert tables[0] == tables[1]


@pytest.mark.parametrize("over", [["--speeds", "0.1,0.2,0.3"], ["--ratios", "0.5,1,2"]])
def test_a_run_states_the_time_left_of_all_its_points(over, monkeypatch, tmp_path, capsys):
    """On a file as well, from before the first of them ends."""
    monkeypatch.setattr(progress, "REFRESH", 1e-3)
    monkeypatch.setattr(progress, "SILENCE", 1e-3)
    (tmp_path / "s.toml").write_text(BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.3\n" + SMALL_PATCH)
    out = ["--out", str(tmp_path / "o"), "--workers", "1"]
    assert main(["run", str(tmp_path / "s.toml"), *over, *out]) == 0
    assert re.search(r"^0 of 3 (speeds|ratios), .* s passed, .* s left$", capsys.readouterr().err, re.M)


@pytest.mark.parametrize("over", [{"speeds": [0.1, 0.2, 0.3]}, {"speeds": [], "ratios": [0.5, 1.0]}])
def test_the_points_of_a_curve_take_the_time_of_all(over):
    prepared = lubfric.prepare(lubfric.load_scene("paper"))
    estimate = estimate_scene(prepared.scene, prepared.sample, prepared.surface, **over)
    assert list(estimate.point_seconds) == over.get("ratios", over["speeds"])
    assert sum(estimate.point_seconds.values()) == pytest.approx(estimate.seconds) and estimate.seconds > 0


def test_a_bar_of_tqdm_takes_its_place_where_it_is_installed(monkeypatch):
    pytest.importorskip("tqdm")
    monkeypatch.setattr(progress, "REFRESH", 0.02)
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    with ProgressLine("points") as shown:
        shown.update(1, 4)
        time.sleep(0.1)
        say("a finished line")
    text = stream.getvalue()
    assert "1/4" in text and "a finished line\n" in text and "1 of 4 points" not in text


def test_a_run_in_time_says_how_far_it_is_before_its_first_output(monkeypatch, tmp_path, capsys):
    """It takes one process, also where that is written."""
    monkeypatch.setattr(progress, "REFRESH", 1e-4)
    monkeypatch.setattr(progress, "SILENCE", 1e-4)
    plan = "[transient]\nduration = 3e-4\nfirst_output = 2e-4\noutputs = 1\n"
    (tmp_path / "s.toml").write_text(BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.3\n" + plan + SMALL_PATCH)
    assert main(["run", str(tmp_path / "s.toml"), "--out", str(tmp_path / "o"), "--workers", "1"]) == 0
    lines = [line for line in capsys.readouterr().err.splitlines() if " % of the duration" in line]
    before = [line for line in lines if " % of the duration, " in line and " passed, " in line]
    reached = [float(line.split()[0]) for line in before]
    assert len(reached) > 2 and reached == sorted(reached) and reached[0] < 33.0
    assert any("f = " in line and "t = 0.0003 of" in line for line in lines)
