"""The folder of a run: nothing lost, torn or mixed by kills, interrupts, full disks, broken streams and other runs."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH

import lubfric
from lubfric._base import read_table
from lubfric.output import curve_picture, main
from lubfric.studies import Store

ROOT = Path(__file__).parents[2]
SCENE = BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.01\nspeeds = [0.003, 0.01, 0.03, 0.1, 0.3]\n" + SMALL_PATCH
HISTORY = (
    "[transient]\nduration = 0.0005\noutputs = 3\n"
    'speed = { kind = "harmonic", amplitude = 0.05, frequency = 500.0, phase = 1.0 }\n'
)
RATIOS = "--ratios=0.1,0.5,-0.5,1.5,0.02"
TABLES = ("stribeck.csv", "history.csv", "traction.csv")
MOVING = SCENE.replace("tolerance = 0.03\n", "") + HISTORY
COUNTED = """
import sys
from pictures import leave_out
leave_out()
from lubfric.studies import points
real = points.friction
def counted(*arguments, **options):
    found = real(*arguments, **options)
    print("solved", flush=True)
    return found
points.friction = counted
from lubfric.studies.store import Store
add = Store.add
Store.add = lambda *arguments, **options: (add(*arguments, **options), print("saved", flush=True))
from lubfric.output import main
sys.exit(main(["run", *sys.argv[1:2], "--out", *sys.argv[2:]]))
"""
SHARED = """
import os, signal, sys, time
from pictures import leave_out
leave_out()
from lubfric.studies import points
real, command = points.friction, os.getpid()
def dying(model, speed, **options):
    if os.getpid() != command and speed in (0.003, 0.3):
        if sys.argv[3] == "worker":
            os.kill(os.getpid(), signal.SIGKILL)
        time.sleep(900)
    return real(model, speed, **options)
points.friction = dying
from lubfric.output import main
sys.exit(main(["run", *sys.argv[1:2], "--out", sys.argv[2], "--workers", "2"]))
"""


def written(folder, text=SCENE):
    (folder / "scene.toml").write_text(text)
    return str(folder / "scene.toml")


def start(scene, out, *more, code=COUNTED, **options):
    environment = os.environ | {"PYTHONPATH": f"{ROOT}{os.pathsep}{ROOT / 'tests'}", "OMP_NUM_THREADS": "1"}
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True} | options
    return subprocess.Popen([sys.executable, "-c", code, scene, str(out), *more], env=environment, **options)


def same(one: Path, other: Path):
    """The same numbers to the last bit."""
    name = next(name for name in TABLES if (one / name).is_file())
    here, there = (read_table(folder / name) for folder in (one, other))
    for column in here:
        np.testing.assert_array_equal(here[column], there[column], err_msg=column)
    if name == "traction.csv":
        return
    with np.load(one / "fields.npz") as here, np.load(other / "fields.npz") as there:
        assert here.files == there.files
        for column in here.files:
            np.testing.assert_array_equal(here[column], there[column], err_msg=column)


def complete(out: Path):
    """Nothing in the folder but what its result names, and the record of whose files they are."""
    record = json.loads((out / "result.json").read_text())
    assert sorted([".lubfric", *record["files"]]) == sorted(path.name for path in out.iterdir()), list(out.iterdir())
    return record


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    assert main(["run", written(folder), "--out", str(folder / "out")]) == 0
    return folder / "out"


@pytest.fixture(scope="module")
def whole_history(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    assert main(["run", written(folder, MOVING), "--out", str(folder / "out")]) == 0
    return folder / "out"


def readable(out: Path):
    """Every file of the outputs that is there is whole."""
    for path in out.glob("*"):
        if path.suffix == ".csv":
            assert len(read_table(path)) > 10
        elif path.suffix == ".json":
            json.loads(path.read_text())
        elif path.suffix == ".npz":
            with np.load(path) as fields:
                assert all(fields[name].size for name in fields.files)
        elif path.suffix == ".png":
            assert path.read_bytes()[-8:-4] == b"IEND"


def killed_until_done(scene, out, rng, kills, *more):
    """(points solved in all runs together, kills): killed at random moments after a point or the state of a step."""
    solved = used = 0
    while True:
        process = start(scene, out, *more)
        text = ""
        if used < kills:
            text = "".join(process.stdout.readline() for _ in range(rng.integers(1, 5)))  # beyond the imports
            time.sleep(rng.exponential(0.02))
            process.kill()
            used += process.wait() == -signal.SIGKILL
        text += process.communicate()[0]
        solved += text.count("solved")
        if out.is_dir():
            readable(out)
        if process.returncode == 0:
            return solved, used
        assert process.returncode == -signal.SIGKILL, process.returncode


@pytest.mark.parametrize("kills", [1, pytest.param(30, marks=pytest.mark.slow)])
@pytest.mark.parametrize(
    "text, uninterrupted",
    [
        pytest.param(SCENE, "whole", id="sweep"),
        pytest.param(MOVING, "whole_history", id="in time", marks=pytest.mark.slow),
    ],
)
def test_killed_runs_lose_repeat_and_tear_nothing(request, tmp_path, text, uninterrupted, kills):
    rng = np.random.default_rng(kills)
    left = kills
    for run in range(100):
        out = tmp_path / str(run)
        solved, used = killed_until_done(written(tmp_path, text), out, rng, min(left, 4))
        complete(out)
        same(out, request.getfixturevalue(uninterrupted))
        assert solved <= 5 + used  # a kill costs at most the point that is being solved
        left -= used
        if left <= 0:
            break


@pytest.mark.slow
def test_killed_traction_curves_lose_and_repeat_nothing(tmp_path):
    """As Stribeck curves: a point that ended is kept, and the rows are those of a run that nobody killed."""
    assert main(["run", written(tmp_path), RATIOS, "--out", str(tmp_path / "whole")]) == 0
    solved, kills = killed_until_done(
        str(tmp_path / "scene.toml"), tmp_path / "out", np.random.default_rng(7), 1, RATIOS
    )
    assert kills > 0 and 5 <= solved <= 5 + kills
    complete(tmp_path / "out")
    same(tmp_path / "out", tmp_path / "whole")


def test_an_interrupted_traction_curve_is_drawn_and_serves_a_run_at_other_ratios(tmp_path, monkeypatch, capsys, draws):
    """Its points are those of `lubfric.traction`; no ratio is solved twice, and what one run leaves out stays for
    another."""
    out = tmp_path / "out"
    draws("traction.png")
    monkeypatch.setattr("lubfric.studies.points.friction", signalling(signal.SIGINT, 4))
    assert main(["run", written(tmp_path), RATIOS, "--out", str(out)]) == 130
    assert "3 of 5 points are kept in" in " ".join(capsys.readouterr().err.split())
    shown = []
    real = curve_picture.plot_traction
    monkeypatch.setattr(curve_picture, "plot_traction", lambda *a, **b: (shown.append(a), real(*a, **b)))
    assert main(["plot", str(out)]) == 0
    assert "3 of 5 slide-roll ratios are solved" in " ".join(capsys.readouterr().err.split())
    (_, columns, title, *_), *_ = shown
    curve = lubfric.traction(lubfric.load_scene(tmp_path / "scene.toml"), [-0.5, 0.1, 0.5])
    np.testing.assert_array_equal(columns["coefficient"], curve.coefficient)
    assert "not finished: 3 of 5" in title and (out / "so_far" / "traction.png").is_file()
    solved = Mock(side_effect=lubfric.friction)
    monkeypatch.setattr("lubfric.studies.points.friction", solved)
    assert main(["run", written(tmp_path), "--ratios=0.1,0.7", "--out", str(out)]) == 0
    said = " ".join(capsys.readouterr().err.split())
    assert "1 of 2 points is solved already" in said and "of this scene with more points" in said
    assert [call.args[0].scene.motion.slide_roll_ratio for call in solved.call_args_list] == [0.7]
    assert main(["run", written(tmp_path), RATIOS, "--out", str(out), "--workers", "1"]) == 0
    assert [call.args[0].scene.motion.slide_roll_ratio for call in solved.call_args_list] == [0.7, 1.5, 0.02]
    assert not (out / "unfinished").exists()


SLOW = 1000.0  # s that a point says it took, in place of what it took


def signalling(sent, after, longer=0.0):
    """`lubfric.friction` that sends its own process a signal after some calls, and takes so many seconds ``longer``."""
    count = [0]

    def solve(*arguments, **options):
        count[0] += 1
        if count[0] == after:
            os.kill(os.getpid(), sent)
        point = lubfric.friction(*arguments, **options)
        return replace(point, seconds=point.seconds + longer)

    return solve


@pytest.mark.parametrize("sent, code", [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_an_interrupt_is_one_line_that_says_what_is_kept(tmp_path, whole, monkeypatch, capsys, sent, code):
    out = tmp_path / "out"
    monkeypatch.setattr("lubfric.studies.points.friction", signalling(sent, 4, SLOW))
    assert main(["run", written(tmp_path), "--out", str(out)]) == code
    said = capsys.readouterr().err.splitlines()
    assert said[-1] == f"lubfric: interrupted; 3 of 5 points are kept in {out}: the same command continues from there"
    assert not (out / "result.json").exists()
    monkeypatch.setattr("lubfric.studies.points.friction", signalling(sent, 3))
    assert main(["run", written(tmp_path), "--out", str(out)]) == 0  # two points were left
    record = complete(out)
    slow = [point["seconds"] for point in record["points"] if point["seconds"] >= SLOW]
    assert len(slow) == 3 == record["points_read"] and record["seconds"] < SLOW
    assert record["points_seconds"] == pytest.approx(sum(point["seconds"] for point in record["points"]))
    stated = f"{record['points_seconds']:.0f} s"
    assert "solved: 3 of 5" in " ".join(capsys.readouterr().err.split())
    page = (out / "report.html").read_text()
    assert stated in page and "3 of 5" in page and "which continued an interrupted run" in page
    same(out, whole)


def test_a_killed_worker_loses_nothing(tmp_path, whole):
    out = tmp_path / "out"
    process = start(written(tmp_path), out, "worker", code=SHARED)
    stated = process.communicate(timeout=600)
    assert process.returncode == 0, stated
    complete(out)
    same(out, whole)


@pytest.mark.parametrize("sent, code", [(signal.SIGINT, 130), pytest.param(signal.SIGKILL, -9, marks=pytest.mark.slow)])
def test_a_command_that_ends_takes_its_processes_along_and_keeps_their_points(tmp_path, whole, monkeypatch, sent, code):
    out = tmp_path / "out"
    process = start(written(tmp_path), out, "command", code=SHARED)
    said = []
    while sum("U = " in line for line in said) < 3:  # the others wait
        said.append(process.stderr.readline())
        assert said[-1], said
    process.send_signal(sent)
    text = process.communicate(timeout=600)[1]  # the ends of its pipes that its processes hold are closed
    assert process.returncode == code
    if sent == signal.SIGINT:
        assert text == f"lubfric: interrupted; 3 of 5 points are kept in {out}: the same command continues from there\n"
    again = Mock(side_effect=lubfric.friction)
    monkeypatch.setattr("lubfric.studies.points.friction", again)
    assert main(["run", written(tmp_path), "--out", str(out)]) == 0 and again.call_count == 2
    same(out, whole)


def test_an_interrupt_of_a_run_in_time(tmp_path, whole_history, monkeypatch, capsys):
    real = Store.add
    count = [0]

    def add(*arguments, **options):
        real(*arguments, **options)
        count[0] += 1
        if count[0] == 9:
            os.kill(os.getpid(), signal.SIGTERM)

    monkeypatch.setattr(Store, "add", add)
    assert main(["run", written(tmp_path, MOVING), "--out", str(tmp_path / "out")]) == 143
    assert "is kept in" in capsys.readouterr().err.splitlines()[-1]
    assert main(["run", written(tmp_path, MOVING), "--out", str(tmp_path / "out")]) == 0
    said = capsys.readouterr().err
    assert "the run continues from" in said and "not used" not in said
    words = " ".join(said.split())
    assert 0.0 < float(re.search(r"continues at t = \S+ s, (\S+) % of the duration, which took", words)[1]) < 100.0
    in_all, before = re.search(r"\((\S+) s of processor time, all processes together, (\S+) s of it", words).groups()
    record = json.loads((tmp_path / "out" / "result.json").read_text())
    assert 0.0 < record["earlier_processor_seconds"] == pytest.approx(float(before), abs=0.06)
    assert record["earlier_processor_seconds"] < record["processor_seconds"] <= float(in_all) + 0.06
    complete(tmp_path / "out")
    same(tmp_path / "out", whole_history)


@pytest.mark.parametrize("text", [SCENE, pytest.param(MOVING, marks=pytest.mark.slow)])
def test_broken_streams_never_stop_a_computation(tmp_path, text):
    process = start(
        written(tmp_path, text),
        tmp_path / "out",
        code="import sys\nfrom pictures import leave_out\nleave_out()\nfrom lubfric.output import main\n"
        "sys.exit(main(['run', sys.argv[1], '--out', sys.argv[2]]))",
    )
    process.stderr.close(), process.stdout.close()
    assert process.wait() == 0
    complete(tmp_path / "out")


def test_a_closed_stdout_is_no_error_of_info():
    code = "import sys; from lubfric.output.command_line import main; sys.exit(main(['info', sys.argv[1]]))"
    process = start("paper", "-", code=code)
    process.stdout.close()
    with process.stderr as stderr:
        assert process.wait() == 0 and stderr.read() == ""


def test_the_results_of_an_earlier_run_stay_until_the_new_ones_are_there(tmp_path, monkeypatch, capsys):
    out = tmp_path / "out"
    assert main(["run", written(tmp_path), "--out", str(out), "--speeds", "0.3"]) == 0
    before = {path.name: path.read_bytes() for path in out.iterdir()}
    for text in (
        SCENE.replace("load = 5.5", "load = -1"),
        SCENE.replace("1.1e-6", "1e-4"),
        SCENE + "[transient]\nduration = 1\nload = 99.0",
    ):
        assert main(["run", written(tmp_path, text), "--out", str(out)]) == 2
        assert {path.name: path.read_bytes() for path in out.iterdir()} == before
    assert main(["run", written(tmp_path), "--out", str(out), "--speeds", "nan"]) == 2
    assert {path.name: path.read_bytes() for path in out.iterdir()} == before
    assert main(["run", written(tmp_path, MOVING), "--out", str(out)]) == 0  # a sweep and a run in time do not mix
    assert "history.csv" in complete(out)["files"] and not (out / "stribeck.csv").exists()


@pytest.mark.parametrize("name", ["fields.npz", "result.json"])
def test_a_full_disk_is_one_line_and_the_points_are_kept(tmp_path, whole, monkeypatch, capsys, name):
    real = os.replace

    def full(part, path):
        if Path(path).name == name:
            raise OSError(28, "No space left on device")
        real(part, path)

    monkeypatch.setattr(os, "replace", full)
    assert main(["run", written(tmp_path), "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err.splitlines()
    assert said[-1].endswith(f"{name} was not written: No space left on device") and "Traceback" not in "".join(said)
    assert not (tmp_path / "out" / "result.json").exists()
    monkeypatch.setattr(os, "replace", real)
    monkeypatch.setattr("lubfric.studies.points.friction", None)  # every point is there
    assert main(["run", written(tmp_path), "--out", str(tmp_path / "out")]) == 0
    same(tmp_path / "out", whole)


def test_another_unfinished_run_in_the_folder_is_kept_and_named(tmp_path, whole, monkeypatch, capsys):
    out = tmp_path / "out"
    monkeypatch.setattr("lubfric.studies.points.friction", signalling(signal.SIGINT, 3))
    assert main(["run", written(tmp_path), "--out", str(out)]) == 130
    other = written(tmp_path, SCENE.replace("entrainment_speed = 0.01", "entrainment_speed = 0.02"))
    assert main(["run", other, "--out", str(out), "--speeds", "0.3", "--fields", "0.3"]) == 0
    assert json.loads((out / "result.json").read_text())["points"][0]["speed"] == 0.3
    assert len(list((out / "unfinished").iterdir())) == 1
    note = "keeps the points of an interrupted run of other inputs"
    said = capsys.readouterr().err
    unused = "contains saved states of an interrupted run of another scene or version of lubfric; they are not used"
    assert said.count(f"{out / 'unfinished'} {unused}") == 1 and f"{out / 'unfinished'} {note}" in said
    assert main(["run", written(tmp_path), "--out", str(out)]) == 0
    said = capsys.readouterr().err
    assert note not in said and unused not in said
    complete(out)
    same(out, whole)


def test_points_of_an_interrupted_run_serve_a_run_at_any_speeds_of_the_scene(tmp_path, whole, monkeypatch, capsys):
    """The order of the speeds is that of the scene: 0.003, 0.01 (with fields) and 0.03 m/s are kept. No point is solved
    twice."""
    out = tmp_path / "out"
    monkeypatch.setattr("lubfric.studies.points.friction", signalling(signal.SIGINT, 4))
    assert main(["run", written(tmp_path), "--out", str(out)]) == 130
    capsys.readouterr()
    solved = Mock(side_effect=lubfric.friction)
    monkeypatch.setattr("lubfric.studies.points.friction", solved)
    assert main(["run", written(tmp_path), "--out", str(out), "--speeds", "0.01,0.03,0.3", "--fields", "0.3"]) == 0
    said = " ".join(capsys.readouterr().err.split())
    assert "2 of 3 points are solved already, by an interrupted run" in said and "not used" not in said
    assert [call.args[1] for call in solved.call_args_list] == [0.3]
    assert "keeps the points of an interrupted run of this scene with more points" in said
    assert main(["run", written(tmp_path), "--out", str(out)]) == 0
    assert [call.args[1] for call in solved.call_args_list] == [0.3, 0.1]
    complete(out)
    same(out, whole)


def test_an_interrupted_run_is_drawn_as_far_as_it_is(tmp_path, monkeypatch, capsys, drawn):
    """The points that are drawn are those that `lubfric.stribeck` computes at these speeds."""
    out = tmp_path / "out"
    monkeypatch.setattr("lubfric.studies.points.friction", signalling(signal.SIGINT, 4))
    assert main(["run", written(tmp_path), "--out", str(out)]) == 130
    before = sorted(out.rglob("*.bin"))
    shown = []
    real = curve_picture.plot_stribeck
    monkeypatch.setattr(curve_picture, "plot_stribeck", lambda *a, **b: (shown.append(a), real(*a, **b)))
    assert main(["plot", str(out)]) == 0
    assert "the run is not finished: 3 of 5 speeds are solved; the picture has these" in capsys.readouterr().err
    (_, columns, title, *_), *_ = shown
    assert "not finished: 3 of 5 speeds are solved" in title and sorted(out.rglob("*.bin")) == before
    curve = lubfric.stribeck(lubfric.load_scene(tmp_path / "scene.toml"), [0.003, 0.01, 0.03])
    np.testing.assert_array_equal(columns["coefficient"], curve.coefficient)
    assert (out / "so_far" / "stribeck.png").is_file() and not (out / "stribeck.png").exists()
    (out / "so_far" / "mine.txt").write_text("not of lubfric")
    monkeypatch.undo()
    assert main(["run", written(tmp_path), "--out", str(out)]) == 0
    assert sorted(path.name for path in (out / "so_far").iterdir()) == [".lubfric", "mine.txt"]
