"""Whatever raises between the last point and the files: the other files are written, the exit code is not 0, and the
answer is in a file or in the store. Each writer fails in turn."""

import errno
import json

import pytest
import scene_text
from pictures import STAND_IN

import lubfric
from lubfric.output import commands, curve_picture, main, run_curve, run_study

SCENE = scene_text.paper_scene(
    contact={"shape": (96, 96), "spacing": 0.9e-6}, numerics={"sampling": "patch"}, motion={"speeds": [0.03, 0.1]}
)


def broken(*_, **__):
    raise RuntimeError("broken on purpose")


@pytest.fixture(scope="module")
def scene_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("scene") / "scene.toml"
    path.write_text(SCENE.to_toml())
    return path


@pytest.fixture(scope="module")
def whole(scene_file, tmp_path_factory):
    """Speeds and coefficients of a run in which nothing fails."""
    out = tmp_path_factory.mktemp("whole") / "out"
    assert main(["run", str(scene_file), "--out", str(out), "--workers", "1"]) == 0
    return [(point["speed"], point["coefficient"]) for point in json.loads((out / "result.json").read_text())["points"]]


def run(capsys, *words):
    code = main([str(word) for word in words])
    return code, capsys.readouterr().err


# (module, attribute): the file that is missing then
WRITERS = {
    ("studies", "csv_bytes"): "stribeck.csv",
    ("run_curve", "fields_bytes"): "fields.npz",
    ("run_curve", "plot_contact"): "contact.png",
    ("run_curve", "draw_curve"): "stribeck.png",
    ("run_curve", "read_table"): "stribeck.png",
    ("run_curve", "vtk_bytes"): "contact_0.vtk",
    ("run_curve", "_law"): "",
    ("run_curve", "_doubts"): "",
    ("run_curve", "given_tables"): "",
    ("commands", "plot_surface"): "surface.png",
    ("commands", "report_page"): "report.html",
    ("commands", "rms_slope"): "",
    ("commands", "plain"): "",
}
MODULES = {"studies": lubfric.studies, "run_curve": run_curve, "commands": commands}


@pytest.mark.parametrize("module, name", WRITERS)
def test_each_writer_of_a_curve_may_fail(module, name, scene_file, whole, tmp_path, capsys, monkeypatch, drawn):
    for home, plot in ((curve_picture, "plot_stribeck"), (run_curve, "plot_contact"), (commands, "plot_surface")):
        monkeypatch.setattr(home, plot, lambda path, *_: path.write_bytes(STAND_IN))
    monkeypatch.setattr(MODULES[module], name, broken)
    out = tmp_path / "out"
    code, said = run(capsys, "run", scene_file, "--out", out, "--vtk", "--workers", 1)
    missing = WRITERS[module, name]
    assert code == 2 and "broken on purpose" in said and "Traceback" not in said
    assert not missing or not (out / missing).exists()
    files = ("stribeck.csv", "stribeck.png", "contact.png", "surface.png", "report.html", "resolved.toml", "fields.npz")
    kept = [file for file in files if (out / file).exists()]
    assert len(kept) >= len(files) - 4
    points = json.loads((out / "result.json").read_text())["points"]
    assert [(point["speed"], point["coefficient"]) for point in points] == whole


def test_a_full_disk_costs_no_point(scene_file, tmp_path, capsys, monkeypatch):
    """The points are in the store: the same command solves none of them again."""
    out = tmp_path / "out"
    replace = commands.OwnFiles.replace

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(commands.OwnFiles, "replace", full)
    code, said = run(capsys, "run", scene_file, "--out", out, "--workers", 1)
    assert code == 2 and "No space left on device" in said and "Traceback" not in said
    monkeypatch.setattr(commands.OwnFiles, "replace", replace)
    monkeypatch.setattr(lubfric.studies.points, "friction", broken)
    code, said = run(capsys, "run", scene_file, "--out", out, "--workers", 1)
    assert code == 0 and (out / "stribeck.csv").exists()


STUDY = """
scene = "scene.toml"
speeds = [0.03]
[vary]
"bodies.load" = [5.0, 6.0]
"""


@pytest.mark.parametrize("name", ["answer_lines", "study_page", "plot_study", "made"])
def test_each_writer_of_a_study_may_fail(name, tmp_path, capsys, monkeypatch, drawn):
    (tmp_path / "scene.toml").write_text(SCENE.to_toml())
    (tmp_path / "study.toml").write_text(STUDY)
    monkeypatch.setattr(run_study, name, broken)
    code, said = run(capsys, "study", tmp_path / "study.toml", "--out", tmp_path / "out")
    assert code == 2 and "broken on purpose" in said and "Traceback" not in said
    assert lubfric.open_study(tmp_path / "out")["coefficient"].size == 2


@pytest.mark.parametrize("name", ["plot_fit", "_record"])
def test_each_writer_of_a_fit_may_fail(name, scene_file, tmp_path, capsys, monkeypatch, drawn):
    curve = lubfric.stribeck(SCENE, [0.01, 0.03, 0.1, 0.3])
    rows = "\n".join(f"{u},{f}" for u, f in zip(curve.speed, curve.coefficient))
    (tmp_path / "rig.csv").write_text(f"speed [m/s],f\n{rows}\n")
    monkeypatch.setattr(run_study, name, broken)
    words = ["--speed", "speed", "--coefficient", "f", "--parameter", "bodies.boundary_friction_coefficient=0.05:0.15"]
    code, said = run(
        capsys, "fit", scene_file, "--measured", tmp_path / "rig.csv", *words, "--starts", 0, "--out", tmp_path / "out"
    )
    assert code == 2 and "broken on purpose" in said and "Traceback" not in said
    assert (tmp_path / "out" / "fitted.toml").exists()
