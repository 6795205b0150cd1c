"""Runs in time and run-in whose writers fail, whose disk is full, or which are killed at any write: nothing that was
computed is lost."""

import errno
import os
from pathlib import Path

import numpy as np
import pytest
import scene_text

import lubfric
from lubfric._base import files
from lubfric.output import commands, main, run_history, run_in_command
from lubfric.quantities import KEYS
from lubfric.scene import Harmonic, Transient, typical

PATCH = scene_text.paper_scene(
    contact={"shape": (48, 48), "spacing": 1.8e-6}, numerics={"sampling": "patch", "tolerance": 0.05}
)
IN_TIME = PATCH.with_(
    motion={"entrainment_speed": 0.03},
    bodies={"hardness": [7e9, 8e9], "boundary_friction_coefficient": [0.1, 0.14]},
    lubricant={"eyring_stress": [4e6, 6e6], "limiting_stress_coefficient": [0.04, 0.09]},
    transient=Transient(duration=3e-4, outputs=2, speed=Harmonic(mean=0.03, amplitude=0.01, frequency=250.0)),
)
RUN_IN = PATCH.with_(bodies={"hardness": 2e9})
SCENES = {"run": IN_TIME, "run-in": RUN_IN}
TABLES = {"run": "history.csv", "run-in": "run_in.csv"}


def broken(*_, **__):
    raise RuntimeError("broken on purpose")


def full(*_, **__):
    raise OSError(errno.ENOSPC, "No space left on device")


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """Scene file and table of a run of each kind in which nothing fails."""
    made = {}
    for kind, scene in SCENES.items():
        folder = tmp_path_factory.mktemp(kind)
        (folder / "scene.toml").write_text(scene.to_toml())
        assert main([kind, str(folder / "scene.toml"), "--out", str(folder / "out")]) == 0
        made[kind] = folder / "scene.toml", (folder / "out" / TABLES[kind]).read_text()
    return made


def run(capsys, kind, scene_file, out):
    code = main([kind, str(scene_file), "--out", str(out)])
    return code, capsys.readouterr().err


def without_solving(monkeypatch):
    """Let nothing be solved from here on."""
    for module in (lubfric.time.load_sharing_solver, lubfric.time.transient_deterministic):
        monkeypatch.setattr(module, "advance", broken, raising=False)
    monkeypatch.setattr("lubfric.time.march.advance", broken)


def test_each_writer_of_a_run_in_time_may_fail(whole, tmp_path, capsys, monkeypatch, draws):
    """The same command then writes what is missing, and solves no step again."""
    draws("history.png")
    scene_file, table = whole["run"]
    out = tmp_path / "out"
    for name, missing in (("_table", "history.csv"), ("npz_bytes", "fields.npz"), ("plot_history", "history.png")):
        with monkeypatch.context() as patched:
            patched.setattr(run_history, name, broken)
            code, said = run(capsys, "run", scene_file, out)
        assert code == 2 and "broken on purpose" in said and "Traceback" not in said
        assert not (out / missing).exists() and (out / "result.json").exists()
        without_solving(monkeypatch)
    code, said = run(capsys, "run", scene_file, out)
    assert code == 0 and (out / missing).exists() and (out / "history.csv").read_text() == table


def test_a_run_in_time_whose_inputs_have_ranges_has_a_report(whole):
    """All keys that take a range have one here."""
    assert {name for name, *_ in IN_TIME.ranges} == {key for key in KEYS if typical(key)}
    assert "another additive" not in (whole["run"][0].parent / "out" / "report.html").read_text(encoding="utf-8")


def test_a_report_that_fails_costs_no_answer(whole, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(commands, "report_page", broken)
    code, said = run(capsys, "run", whole["run"][0], tmp_path / "out")
    assert code == 2 and "report.html was not written (RuntimeError: 'broken on purpose')" in said
    assert "The mean friction coefficient over" in said and "The mean power loss is" in said


@pytest.mark.parametrize("name, missing", {"_npy": "surface.npy", "_page": "report.html", "_record": "run_in.json", "draw_run_in": "run_in.png", "scene_after": "scene.toml", "table_bytes": "run_in.csv"}.items())  # fmt: skip
def test_each_writer_of_a_run_in_may_fail(name, missing, whole, tmp_path, capsys, monkeypatch, request):
    if name == "draw_run_in":
        request.getfixturevalue("drawn")
    scene_file, _ = whole["run-in"]
    monkeypatch.setattr(run_in_command, name, broken)
    code, said = run(capsys, "run-in", scene_file, tmp_path / "out")
    assert code == 2 and "broken on purpose" in said and "Traceback" not in said
    assert sorted(path.name for path in (tmp_path / "out").iterdir() if path.name[0] != ".") == sorted(
        {*run_in_command.FOLDER_FILES} - {missing}
    )


def test_a_full_disk_costs_no_step_of_a_run_in_time(whole, tmp_path, capsys, monkeypatch):
    scene_file, table = whole["run"]
    out = tmp_path / "out"
    with monkeypatch.context() as patched:
        patched.setattr(commands.OwnFiles, "replace", full)
        code, said = run(capsys, "run", scene_file, out)
    assert code == 2 and "No space left on device" in said and "Traceback" not in said
    without_solving(monkeypatch)
    code, said = run(capsys, "run", scene_file, out)
    assert code == 0 and (out / "history.csv").read_text() == table


def test_a_full_disk_leaves_a_run_in_elsewhere(whole, tmp_path, capsys, monkeypatch):
    scene_file, table = whole["run-in"]
    monkeypatch.setattr(commands.OwnFiles, "replace", full)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "elsewhere"))
    (tmp_path / "elsewhere").mkdir()
    code, said = run(capsys, "run-in", scene_file, tmp_path / "out")
    (rescued,) = (tmp_path / "elsewhere").glob("lubfric-run-in-*")
    assert code == 2 and "No space left on device" in said and str(rescued) in said and "Traceback" not in said
    assert (rescued / "run_in.csv").read_text() == table and np.load(rescued / "surface.npy").ndim == 2


@pytest.mark.parametrize("kind", SCENES)
def test_a_folder_that_cannot_be_written_is_refused_before_any_work(kind, whole, tmp_path, capsys, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setattr(run_history, "run_in_time", broken)
    monkeypatch.setattr(run_in_command, "run_in", broken)
    code, said = run(capsys, kind, whole[kind][0], tmp_path / "file" / "out")
    assert code == 2 and "broken" not in said and "Traceback" not in said and "file" in said


@pytest.mark.slow
@pytest.mark.parametrize("kind", SCENES)
def test_a_kill_at_any_write_leaves_a_folder_that_the_same_command_completes(
    kind, whole, tmp_path, capsys, monkeypatch
):
    scene_file, table = whole[kind]
    writes = 0
    original = files.os.replace
    for last in range(100):
        out = tmp_path / str(last)
        child = os.fork()
        if child == 0:

            def replace(part, path, last=last):  # fmt: skip
                nonlocal writes
                if writes == last:
                    os._exit(9)
                writes += 1
                original(part, path)

            files.os.replace = replace
            os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
            os._exit(main([kind, str(scene_file), "--out", str(out)]))
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        if code == 0:
            break
        assert code == 9
        if kind == "run" and last % 4:
            continue  # every fourth is continued
        assert run(capsys, kind, scene_file, out)[0] == 0
        assert (out / TABLES[kind]).read_text() == table
        assert not list(Path(out).glob(f"{files.PART_PREFIX}*"))
    assert last >= 6
