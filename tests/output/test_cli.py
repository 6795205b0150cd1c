"""The command: files written, both ways of calling it, exit codes, and the library's lightness."""

import csv
import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL

import lubfric
from lubfric._base import read_table, validate
from lubfric.output import main, parser

SCENE = BODIES_AND_OIL.replace("[lubricant]", "hardness = 6e9\n[lubricant]")
SCENE += "[motion]\nentrainment_speed = 0.001\nspeeds = [0.001, 0.01, 0.3]\n"
SCENE += "[surface]\nsq = 1e-7\ncorrelation_length = 4e-6\nseed = 7\n[contact]\nshape = [64, 64]\nspacing = 0.9e-6\n"
SCENE += '[numerics]\nsampling = "patch"\nmodel = "paper"\n'


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    (folder / "small.toml").write_text(SCENE)
    assert main(["run", str(folder / "small.toml"), "--out", str(folder / "out")]) == 0
    return folder / "out"


def test_run_writes_its_record(run):
    names = (
        "result.json stribeck.csv stribeck.png fields.npz contact.png surface.png report.html references.bib "
        "resolved.toml"
    )
    assert {p.name for p in run.iterdir()} == {".lubfric", *names.split()}
    assert lubfric.load_scene(run / "resolved.toml") == lubfric.load_scene(run.parent / "small.toml")
    record = json.loads((run / "result.json").read_text())
    assert record["scene"]["bodies"]["hardness"] == 6e9 and record["seed"] == 7
    assert record["versions"]["lubfric"] == lubfric.__version__ and record["seconds"] > 0
    assert [p["speed"] for p in record["points"]] == [0.001, 0.01, 0.3]
    for point in record["points"]:
        assert point["report"]["converged"] and point["report"]["residual"] <= point["report"]["tolerance"]
    with np.load(run / "fields.npz") as fields:
        assert fields["speed"] == [0.001] and fields["pressure_0"].shape == fields["heights_0"].shape == (64, 64)
        assert fields["pressure_0"].max() <= 6e9


def test_csv_equals_json_and_the_library(run):
    with (run / "stribeck.csv").open() as file:
        rows = list(csv.DictReader(file))
    record = json.loads((run / "result.json").read_text())
    curve = lubfric.stribeck(lubfric.load_scene(run.parent / "small.toml"))
    for row, point, f in zip(rows, record["points"], curve.coefficient):
        assert float(row["coefficient [-]"]) == point["coefficient"] == f
    curve.to_csv(run.parent / "own.csv")
    own, command = (read_table(path) for path in (run.parent / "own.csv", run / "stribeck.csv"))
    assert list(own) == list(command)
    for name in own:
        assert np.array_equal(own[name], command[name], equal_nan=own[name].dtype.kind == "f"), name
    assert (run.parent / "own.csv").read_bytes() == (run / "stribeck.csv").read_bytes()  # no times in it
    assert all(point["seconds"] > 0 for point in record["points"])


def test_a_map_where_a_gap_is_expected_is_distinguished():
    surface = lubfric.generate_surface((32, 32), 1e-6, sq=1e-7, correlation_length=3e-6, seed=1)
    with pytest.raises(lubfric.InputError, match=r"gap0 .*gap0 = -surface.heights in m"):
        lubfric.solve_contact(surface, surface.spacing, 2.3e11, mean_pressure=1e7)
    with pytest.raises(lubfric.InputError, match="start .*heights"):
        lubfric.solve_contact(-surface.heights, surface.spacing, 2.3e11, mean_pressure=1e7, start=surface)


@pytest.mark.parametrize(
    "arguments, word",
    [
        (["run", "papr"], "did you mean 'paper'"),
        (["info", "nothing.toml"], "nothing.toml"),
        (["run", "paper", "--speeds", "a,b"], "speeds"),
        (["run", "paper", "--speeds", "0,01", "--out", "nowhere"], "a point in decimals"),
        (["plot", "nowhere"], "there is no folder"),
        (["run", "flat", "--sampling-tolerance", "0.01"], "flat is solved on one patch"),
        (["plot", "nowhere", "--speed", "U [m/s]"], "give --measured as well"),
    ],
)
def test_bad_input_ends_with_2_and_one_line(arguments, word, capsys):
    assert main(arguments) == 2
    error = capsys.readouterr().err
    assert word in error and error.count("\n") == 1 and not Path("nowhere").exists()


def test_a_failed_speed_ends_with_1_and_keeps_the_rest(tmp_path, monkeypatch, capsys, draws):
    draws("stribeck.png")
    from lubfric.studies import points

    real = points.friction

    def failing(model, speed, **kw):
        if speed == 0.01:
            raise lubfric.ConvergenceError(
                "injected", lubfric.Report("x", "diverged", iterations=1, residual=1.0, tolerance=0.1)
            )
        return real(model, speed, **kw)

    monkeypatch.setattr(points, "friction", failing)
    (tmp_path / "small.toml").write_text(SCENE)
    assert main(["run", str(tmp_path / "small.toml"), "--out", str(tmp_path / "o")]) == 1
    assert "1 of 3 speeds failed" in capsys.readouterr().err
    record = json.loads((tmp_path / "o" / "result.json").read_text())
    assert "injected" in record["points"][1]["error"] and record["points"][2]["coefficient"] > 0
    assert (tmp_path / "o" / "stribeck.png").stat().st_size > 10_000


def test_a_refused_point_is_said_kept_and_can_be_accepted(tmp_path, capsys, draws):
    draws("stribeck.png")
    heavy = SCENE.replace("load = 5.5", "load = 500.0").replace("0.9e-6", "1.8e-6").replace("4e-6", "8e-6")
    heavy += 'film_deflection = "hydrodynamic"\n'  # the film too thick, and its friction with it
    (tmp_path / "heavy.toml").write_text(heavy)
    command = ["run", str(tmp_path / "heavy.toml"), "--speeds", "0.001", "--fields", "0.001", "--out"]
    assert main([*command, str(tmp_path / "o")]) == 1
    said = capsys.readouterr().err
    assert said.index("estimate: ") < said.index("refused only if") < said.index("[1/1]") < said.index("not valid")
    assert "Newtonian shear reaches" in said and "eyring_stress" in said and "--accept" in said
    record = json.loads((tmp_path / "o" / "result.json").read_text())
    assert record["points"][0]["validity"][0]["severe"] in (True, False) and "not valid" in record["points"][0]["error"]
    assert "not valid" in (tmp_path / "o" / "stribeck.csv").read_text()
    assert main([*command, str(tmp_path / "a"), "--accept"]) == 0
    assert "accepted outside the range of the model" in capsys.readouterr().err
    accepted = json.loads((tmp_path / "a" / "result.json").read_text())
    assert accepted["points"][0]["coefficient"] > 0 and accepted["scene"]["numerics"]["accept"] is True
    assert any("not valid" in text for text in accepted["validity"])
    assert (tmp_path / "a" / "stribeck.png").stat().st_size > 10_000
    assert main(["plot", str(tmp_path / "a")]) == 0


def test_a_table_and_a_record_of_different_runs_are_not_drawn_together(run, tmp_path, capsys):
    shutil.copytree(run, tmp_path / "a")
    rows = (tmp_path / "a" / "stribeck.csv").read_text().splitlines()
    (tmp_path / "a" / "stribeck.csv").write_text("\n".join([*rows, rows[-1]]) + "\n")
    assert main(["plot", str(tmp_path / "a")]) == 2
    assert "run 'lubfric run' again" in capsys.readouterr().err
    assert main(["plot", str(tmp_path / "none")]) == 2
    assert "there is no folder" in capsys.readouterr().err


def test_the_error_of_the_model_is_a_column_inside_the_interval(tmp_path, capsys):
    assert main(["run", "paper", "--speeds", "0.001,0.3", "--fields", "0.001", "--out", str(tmp_path)]) == 0
    table = read_table(tmp_path / "stribeck.csv")
    half = (table["interval_high"] - table["interval_low"]) / 2 / table["coefficient"]
    assert np.all(0 < table["model_error"]) and np.all(table["model_error"] < half)
    said = capsys.readouterr().err
    assert (tmp_path / "sharing.png").is_file()  # what the deterministic strips correct
    assert f"model-form {100 * table['model_error'][0]:.2g} %" in said
    assert main(["info", "paper", "--speeds", "0.001,0.3"]) == 0
    cost = capsys.readouterr().out.partition("cost: ")[2].splitlines()[0]
    assert f"estimate: {cost.partition('; ')[0]}\n" in said


@pytest.mark.slow
def test_the_scene_of_init_meets_its_tolerance_where_its_numerical_error_is_largest(tmp_path):
    """With a tolerance of 1 % it missed that at five of its thirteen speeds."""
    assert main(["init", str(tmp_path / "s.toml")]) == 0
    point = lubfric.friction(lubfric.load_scene(tmp_path / "s.toml"), 0.4642)
    assert 0 < point.uncertainty.numerical <= lubfric.load_scene(tmp_path / "s.toml").numerics.tolerance


def test_how_far_a_long_point_is_is_reported(capsys, monkeypatch):
    """Without a line of progress, as of a fit."""
    from lubfric.output import commands

    clock = iter((0.0, 0.0, 1.0, 6.0, 7.0, 12.0))
    monkeypatch.setattr(commands.time, "monotonic", lambda: next(clock))
    report = commands.moment_reports(5.0)
    for done in range(1, 6):
        report("moving roughness", done, 10)
    lines = capsys.readouterr().err.splitlines()
    assert [line.strip() for line in lines] == [
        "now moving roughness: step 3 of 10",
        "now moving roughness: step 5 of 10",
    ]


@pytest.mark.parametrize("name", ["", "  ", "~nobody-of-that-name/out"])
def test_a_path_that_names_no_place_is_refused_before_any_work(name, tmp_path, monkeypatch, capsys):
    """An empty name was the current folder, and its files lay among the user's."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as ended:
        main(["run", "paper", "--speeds", "0.03", "--out", name])
    assert ended.value.code == 2 and list(tmp_path.iterdir()) == []
    assert ("empty" if not name.strip() else "unknown user") in capsys.readouterr().err


def test_a_tilde_in_a_path_is_the_home_directory(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    for command in (["run", "paper"], ["study", "plan.toml"], ["run-in", "paper"]):
        assert parser().parse_args([*command, "--out", "~/results"]).out == tmp_path / "results"
    assert validate.folder("store", "~/points") == validate.folder("store", Path("~/points")) == tmp_path / "points"
    with pytest.raises(lubfric.InputError, match="store"):
        validate.folder("store", "~nobody-of-that-name/points")
