"""``lubfric study``: files written, study files read strictly, exit codes, broken streams, interrupts."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH
from small_study import SCENE as SMALL

import lubfric
from lubfric._base.progress import report_progress
from lubfric.output import main, run_study
from lubfric.output.run_study import _kept, _picture
from lubfric.output.study_report import answer_lines

ROOT = Path(__file__).parents[2]
SCENE = BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.001\n" + SMALL_PATCH
STUDY = """
scene = "small.toml"
speed_range = [0.003, 0.3, 3]
[vary]
bodies.load = [3.0, 5.5]
[[together]]
"surface.seed" = [1, 2]
surface.sq = [1e-7, 1.2e-7]
"""


def written(folder, study=STUDY):
    (folder / "small.toml").write_text(SCENE)
    (folder / "study.toml").write_text(study)
    return str(folder / "study.toml")


def command(*arguments, **options):
    environment = os.environ | {"PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1"}
    return subprocess.Popen([sys.executable, "-m", "lubfric", *map(str, arguments)], env=environment, **options)


def test_a_study_file_is_carried_out(tmp_path, capsys):
    assert main(["study", written(tmp_path), "--out", str(tmp_path / "out")]) == 0
    said = capsys.readouterr().err
    assert "12 points" in said and "[12/12]" in said and "wrote report.html, study.csv" in said
    result = lubfric.open_study(tmp_path / "out")
    scene = lubfric.load_scene(tmp_path / "small.toml")
    pairs = [(1, 1e-7), (2, 1.2e-7)]
    again = lubfric.study(
        scene, {"bodies.load": [3.0, 5.5], ("surface.seed", "surface.sq"): pairs}, np.geomspace(0.003, 0.3, 3)
    )
    f = result["coefficient"]
    np.testing.assert_array_equal(f, again["coefficient"])
    for word, value in (("smallest", f.min()), ("largest", f.max())):  # at the end, with its place
        (row,) = (row for row in said.splitlines() if row.startswith(f"The {word} friction coefficient is"))
        assert float(row.split(" is ")[1].split()[0].rstrip(",")) == pytest.approx(value, rel=0.05)
        load, seed, speed = (
            axis[i] for axis, i in zip(((3, 5.5), (1, 2), (3e-3, 0.03, 0.3)), np.argwhere(f == value)[0])
        )
        assert f": total load {load:g} N, seed {seed}, " in row and row.endswith(f"speed {speed:g} m/s.")
    assert (tmp_path / "out" / "study.png").read_bytes().startswith(b"\x89PNG")
    rows = (tmp_path / "out" / "study.csv").read_text().splitlines()
    assert len(rows) == 13 and rows[0].startswith("bodies.load [N],surface.seed,surface.sq [m],speed [m/s],")
    assert not [p for p in (tmp_path / "out").rglob("*") if p.name.startswith(".part")]


@pytest.mark.parametrize("vary", [{}, {"bodies.load": [3.0, 5.5]}, {"bodies.load": [3.0, 5.5], "surface.seed": [1, 2]}])
def test_a_study_of_one_speed_is_drawn_over_what_is_varied(tmp_path, vary):
    result = lubfric.study(SMALL, vary, [0.3])
    _picture(tmp_path / "study.png", result)
    assert (tmp_path / "study.png").stat().st_size > 5000 and len(answer_lines(result)) == 5


def test_explain_solves_nothing(tmp_path, capsys):
    assert main(["study", written(tmp_path), "--out", str(tmp_path / "out"), "--explain"]) == 0
    assert "12 points" in capsys.readouterr().out and not (tmp_path / "out").exists()


@pytest.mark.parametrize("change, words", [(("speed_range", "speed_rnage"), "did you"), (("small", "smal"), "smal")])
def test_bad_study_files_are_one_line(tmp_path, capsys, change, words):
    assert main(["study", written(tmp_path, STUDY.replace(*change)), "--out", str(tmp_path / "out")]) == 2
    error = capsys.readouterr().err
    assert words in error and error.count("\n") == 1 and not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "solved, missing, words",
    [(1, 8, "1 point is kept in out, 8 points are left"), (8, 1, "8 points are kept in out, 1 point is left")],
)
def test_the_points_that_are_kept_are_counted_in_words(monkeypatch, solved, missing, words):
    study = SimpleNamespace(solved=solved, missing=missing, chosen=False)
    monkeypatch.setattr("lubfric.studies.open_study", lambda folder: study)
    assert _kept(Path("out")) == words


@pytest.mark.parametrize("sent, code", [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_an_interrupt_is_one_line_and_the_command_goes_on(tmp_path, sent, code):
    many = STUDY.replace("[3.0, 5.5]", str([3.0 + 0.001 * i for i in range(1500)]))
    path = written(tmp_path, many)
    out = tmp_path / "out"
    process = command("study", path, "--out", out, "--workers", 2, stderr=subprocess.PIPE, text=True)
    while process.poll() is None and not any(path.stat().st_size for path in out.glob(f"points/{'?' * 40}.bin")):
        time.sleep(0.05)
    process.send_signal(sent)
    said = process.communicate()[1].splitlines()
    assert process.returncode == code and "kept in" in said[-1] and "goes on from there" in said[-1], said
    assert not any("Traceback" in line for line in said)
    result = lubfric.open_study(out)
    assert 0 < result.missing < result.status.size


@pytest.mark.parametrize("arguments", [["--workers", "0"], ["--workers", str(2**70)], ["--out", "/dev/null/x"]])
def test_bad_options_are_one_line(tmp_path, capsys, arguments):
    assert main(["study", written(tmp_path), "--out", str(tmp_path / "out"), *arguments]) == 2
    assert capsys.readouterr().err.splitlines()[-1].startswith("lubfric: ")


def test_a_table_that_cannot_be_written_is_reported_before_any_point(tmp_path, monkeypatch, capsys):
    from lubfric import studies

    monkeypatch.setitem(sys.modules, "xarray", None)
    monkeypatch.setattr(studies, "study", lambda *a, **k: pytest.fail("solved"))
    (tmp_path / "study.toml").write_text('scene = "paper"\nspeeds = [0.01]\n[vary]\n"bodies.load" = [5.5]\n')
    assert main(["study", str(tmp_path / "study.toml"), "--netcdf", "--out", str(tmp_path / "out")]) == 2
    assert "needs the package xarray" in capsys.readouterr().err


def test_how_far_a_point_of_a_study_is_reaches_the_user(tmp_path, monkeypatch):
    """As at a point of a curve (`tests/output/test_cli.py`)."""
    seen = []

    def stopped(*_, **__):
        report_progress("moving roughness", 3, 10)
        raise lubfric.InputError("enough")

    monkeypatch.setattr(run_study, "moment_reports", lambda: lambda *said: seen.append(said))
    monkeypatch.setattr("lubfric.studies.study", stopped)
    (tmp_path / "scene.toml").write_text(SCENE)
    (tmp_path / "study.toml").write_text('scene = "scene.toml"\n[vary]\n"bodies.load" = [4.0, 5.0]\n')
    assert main(["study", str(tmp_path / "study.toml"), "--out", str(tmp_path / "out")]) == 2
    assert seen == [("moving roughness", 3, 10)]
