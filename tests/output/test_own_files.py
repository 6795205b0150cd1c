"""`--out` and the files of the user: whatever they are called, none that lubfric did not write changes or goes."""

import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH

import lubfric
from lubfric._base import FolderLock, OwnFiles, write_checked
from lubfric.output import main

SCENE = BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.3\nspeeds = [0.3]\n" + SMALL_PATCH
MAPPED = SCENE.split("[surface]")[0] + "[surface]\nfile = 'MAP'\nspacing = 0.9e-6\n[numerics]\nsampling = 'patch'\n"
HISTORY = '[transient]\nduration = 1e-4\noutputs = 2\nspeed = { kind = "file", file = "FILE", column = "U" }\n'
STUDY = 'scene = "base.toml"\n[vary]\n"motion.slide_roll_ratio" = [1.0, 2.0]\n'
MEASURED = "U [m/s],f\n0.1,0.05\n0.2,0.05\n0.3,0.05\n0.5,0.052\n"
FIT = ["--coefficient", "f", "--speed", "U", "--parameter", "lubricant.viscosity=0.2:0.6"]
# Files of the user in the folder of the results, by kind of command: their names make the command refused.
IN_THE_WAY = {
    "run": "stribeck.csv stribeck.png fields.npz contact.png surface.png law.json law.c report.html references.bib result.json "
    "sharing.png resolved.toml .lubfric .lubfric.lock unfinished",
    "history": "history.csv history.png fields.npz surface.png report.html resolved.toml result.json unfinished",
    "study": "study.csv .lubfric",
    "fit": "fitted.toml fit.png report.html references.bib fit.json",
}
# Files of the user that stand beside the results.
BESIDE = {
    "run": "history.csv history.png animation.gif traction.csv traction.png contact_0.vtk contact_user.vtk .lock "
    ".part-mine .part-12345678-stribeck.csv study.csv fit.json notes.txt unfinished/notes.bin checkpoint/state.bin "
    "points/a.bin",
    "history": "stribeck.csv law.c animation.gif contact.png .lock .part-x unfinished/notes.bin checkpoint",
    "study": "study.nc study.parquet result.json .part-x points/notes.txt .lock fitted.toml",
}


def command(kind, folder, *more):
    """Return the command of a ``kind`` on small inputs in ``folder``."""
    folder.mkdir(exist_ok=True)
    (folder / "base.toml").write_text(SCENE)
    if kind == "study":
        (folder / "s.toml").write_text(STUDY)
        return ["study", str(folder / "s.toml"), *more]
    if kind == "fit":
        (folder / "m.csv").write_text(MEASURED)
        return ["fit", str(folder / "base.toml"), "--measured", str(folder / "m.csv"), *FIT, *more]
    if kind == "history":
        (folder / "u.csv").write_text("time [s],U [m/s]\n0,0.3\n1,0.3\n")
        (folder / "base.toml").write_text(SCENE + HISTORY.replace("FILE", "u.csv"))
    return ["run", str(folder / "base.toml"), *more]


def everything(folder):
    """Return what stands in a folder, by name; a link by where it points to."""
    return {
        str(path.relative_to(folder)): os.readlink(path) if path.is_symlink() else path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_symlink() or path.is_file()
    }


def put(path, spelling):
    """Put a file of the user, or a link to one, at ``path``."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if spelling == "link":
        user = path.parents[1] / "user" if path.parent.name == "out" else path.parents[2] / "user"
        user.write_bytes(b"the user's own\n")
        path.symlink_to(user)
    else:
        path.write_bytes(b"the user's own\n")


@pytest.mark.parametrize("spelling", ["plain", "link"])
@pytest.mark.parametrize("kind", IN_THE_WAY)
def test_a_file_of_the_user_in_the_way_is_never_replaced(tmp_path, capsys, kind, spelling):
    for name in IN_THE_WAY[kind].split():
        work = tmp_path / name.strip(".")
        put(work / "out" / name, spelling)
        before = everything(work)
        assert main(command(kind, work, "--out", str(work / "out"))) == 2, capsys.readouterr().err
        assert {key: everything(work)[key] for key in before} == before
        assert everything(work / "out").keys() == {name}


@pytest.mark.parametrize("spelling", ["plain", "link"])
@pytest.mark.parametrize("kind", BESIDE)
def test_files_of_the_user_beside_the_results_stay(tmp_path, capsys, kind, spelling):
    for name in BESIDE[kind].split():
        put(tmp_path / "out" / name, spelling)
    before = everything(tmp_path)
    assert main(command(kind, tmp_path, "--out", str(tmp_path / "out"))) == 0, capsys.readouterr().err
    assert {key: everything(tmp_path)[key] for key in before} == before


# An input of each kind, and the outputs of the same command whose names it takes.
INPUTS = {
    "scene": "result.json stribeck.csv contact.png .lubfric .lubfric.lock",
    "map": "stribeck.csv fields.npz contact.png",
    "history": "history.csv result.json",
    "fit": "fitted.toml fit.json",
    "measured": "fit.json fitted.toml",
    "study": "study.csv",
}


def command_that_reads(kind, name):
    """Write an input of ``kind`` called ``name``, and what else its command reads, to this folder; return the
    command."""
    text = SCENE
    if kind == "map":
        np.savetxt(name, np.random.default_rng(1).normal(size=(64, 64)) * 1e-7, delimiter=",")
        text = MAPPED.replace("MAP", name)
    elif kind == "history":
        Path(name).write_text("time [s],U [m/s]\n0,0.3\n1,0.3\n")
        text += HISTORY.replace("FILE", name)
    elif kind == "measured":
        Path(name).write_text(MEASURED)
    elif kind == "study":
        Path(name).write_text(STUDY)
    scene = name if kind in ("scene", "fit") else "base.toml"
    Path(scene).write_text(text)
    if kind == "study":
        return ["study", name]
    if kind in ("fit", "measured"):
        Path("m.csv").write_text(MEASURED)
        return ["fit", scene, "--measured", name if kind == "measured" else "m.csv", *FIT]
    return ["run", scene]


@pytest.mark.parametrize("kind", INPUTS)
def test_an_input_is_never_an_output(tmp_path, monkeypatch, capsys, kind):
    for name in INPUTS[kind].split():
        here = tmp_path / name.strip(".") / "here"
        here.mkdir(parents=True)
        (here / "link").symlink_to(here)
        monkeypatch.chdir(here)
        words = command_that_reads(kind, name)
        before = everything(here)
        for out in (".", "link", "../here"):
            assert main([*words, "--out", out]) == 2
            assert everything(here) == before and "give another folder" in capsys.readouterr().err


def test_a_file_of_ours_that_is_an_input_stays(tmp_path, capsys):
    """fitted.toml of an earlier fit as the scene of the next one, also through a hard link; as the base of a study."""
    run = command("fit", tmp_path, "--out", str(tmp_path / "out"))
    (tmp_path / "out").mkdir()
    with FolderLock(tmp_path / "out"):
        OwnFiles(tmp_path / "out").replace({"fitted.toml": SCENE.encode(), "fit.json": b"{}"})
    os.link(tmp_path / "out" / "fitted.toml", tmp_path / "other.toml")
    before = everything(tmp_path / "out")
    for scene in (tmp_path / "out" / "fitted.toml", tmp_path / "other.toml"):
        assert main(["fit", str(scene), *run[2:]]) == 2
        assert "is read by this command" in capsys.readouterr().err
    assert everything(tmp_path / "out") == before


def test_a_history_that_an_earlier_run_wrote_is_not_removed_under_the_next(tmp_path):
    out = tmp_path / "out"
    assert main(command("history", tmp_path, "--out", str(out))) == 0
    history = HISTORY.replace("FILE", "history.csv").replace('"U"', '"entrainment_speed"')
    (out / "again.toml").write_text(SCENE + history)
    before = everything(out)
    assert main(["run", str(out / "again.toml"), "--out", str(out)]) == 2
    assert everything(out) == before


def test_a_result_that_the_user_changed_is_not_ours_any_more(tmp_path, capsys):
    out = tmp_path / "out"
    run = command("run", tmp_path, "--out", str(out))
    assert main(run) == 0 and main([*run, "--ratios", "0.5,1"]) == 0
    (out / "traction.png").write_text("with my notes")  # no output of the next command
    assert main(run) == 0 and (out / "traction.png").read_text() == "with my notes"
    (out / "stribeck.png").write_bytes(b"cropped")
    before = everything(out)
    assert main(run) == 2 and "was changed since" in capsys.readouterr().err
    assert main(["plot", str(out)]) == 2
    assert everything(out) == before
    (out / "stribeck.png").unlink()
    assert main(["plot", str(out)]) == 0 and main(run) == 0


def test_commands_share_a_folder_and_take_only_their_own(tmp_path):
    out = tmp_path / "out"
    assert main(command("study", tmp_path, "--out", str(out))) == 0
    kept = (out / "study.csv").read_bytes()
    assert main(command("run", tmp_path, "--out", str(out))) == 0
    assert main(command("history", tmp_path, "--out", str(out))) == 0
    assert (out / "study.csv").read_bytes() == kept and not (out / "stribeck.csv").exists()
    assert main(command("study", tmp_path, "--out", str(out))) == 0  # over its own


def test_a_run_removes_all_that_another_kind_of_run_wrote(tmp_path):
    """Options and pictures drawn again included."""
    out = tmp_path / "out"
    for kind, options in (("run", ["--vtk"]), ("run", ["--ratios", "0.5,1"]), ("history", ["--animation"])):
        assert main([*command(kind, tmp_path, "--out", str(out)), *options]) == 0
        names = {path.name for path in out.iterdir() if not path.name.startswith(".")}
        assert names == set(json.loads((out / "result.json").read_text())["files"])
        assert main(["plot", str(out), "--format", "svg"]) == 0


@pytest.mark.parametrize("content", ["", "[]", "{}", '{"stribeck.csv": 3}', "[" * 9999, '{"../m.csv": ["0"]}'])
def test_a_marker_that_is_none_is_refused_or_owns_nothing(tmp_path, capsys, content):
    out = tmp_path / "out"
    run = command("run", tmp_path, "--out", str(out))
    assert main(run) == 0
    write_checked(out / ".lubfric", content.encode())
    before = everything(out)
    assert main(run) == 2 and capsys.readouterr().err.splitlines()[-1].startswith("lubfric: ")
    assert everything(out) == before


def test_a_run_stopped_while_it_replaces_another_goes_on(tmp_path, monkeypatch):
    """A kill between any two of the files that appear: all is ours still, and result.json stands for a whole run."""
    run = command("run", tmp_path, "--out", str(tmp_path / "first"))
    real = os.replace
    assert main([*run, "--ratios", "0.5,1"]) == 0
    (tmp_path / "base.toml").write_text(SCENE.replace("0.36", "0.3"))
    for left in range(1, 99):
        out = tmp_path / str(left)
        shutil.copytree(tmp_path / "first", out)
        files = iter(range(left))

        def killed(part, path):
            if next(files, None) is None:
                raise KeyboardInterrupt
            real(part, path)

        monkeypatch.setattr(os, "replace", killed)
        code = main([*run[:-1], str(out)])
        monkeypatch.setattr(os, "replace", real)
        if (out / "result.json").exists():
            record = json.loads((out / "result.json").read_text())
            assert all((out / name).is_file() for name in record["files"])
        if code == 0:
            break
        assert main([*run[:-1], str(out)]) == 0
        assert not (out / "traction.csv").exists() and not list(out.glob(".part-*"))
        assert json.loads((out / "result.json").read_text())["scene"]["lubricant"]["viscosity"] == 0.3
    assert left > 8


def test_a_checkpoint_leaves_what_is_not_its_own(tmp_path):
    folder = tmp_path / "checkpoint"
    (folder / "points").mkdir(parents=True)
    (folder / "points" / "mine.bin").write_bytes(b"mine")
    (tmp_path / "aim").write_bytes(b"aim")
    (folder / "link").symlink_to(tmp_path / "aim")
    before = everything(folder)
    lubfric.transient(lubfric.load_scene(command("history", tmp_path)[1]), checkpoint=folder)
    assert everything(folder) == before and (tmp_path / "aim").read_bytes() == b"aim"


def test_a_lock_is_never_opened_through_a_link(tmp_path):
    (tmp_path / "aim").write_text("precious")
    for make in (os.symlink, os.link):
        make(tmp_path / "aim", tmp_path / ".lubfric.lock")
        with pytest.raises(lubfric.InputError, match=r"\.lubfric\.lock is"), FolderLock(tmp_path):
            pass
        assert (tmp_path / "aim").read_text() == "precious" and (tmp_path / ".lubfric.lock").exists()
        (tmp_path / ".lubfric.lock").unlink()
    (tmp_path / "aim").write_text("")  # nothing in it tells whose it is
    os.symlink(tmp_path / "aim", tmp_path / ".lubfric.lock")
    with pytest.raises(lubfric.InputError, match=r"\.lubfric\.lock is"), FolderLock(tmp_path):
        pass
    assert (tmp_path / "aim").read_text() == ""


def test_a_folder_that_was_copied_whole_is_still_ours(tmp_path):
    out = tmp_path / "out"
    run = command("run", tmp_path, "--out", str(out))
    assert main(run) == 0
    shutil.copytree(out, tmp_path / "copy")
    assert main([*run[:-1], str(tmp_path / "copy")]) == 0
    assert Path(tmp_path / "copy" / "result.json").is_file()
