"""Every option of the command line reaches what is solved and written: by the scene, the speeds and the columns that
the solver is given, and by the files beside it."""

import argparse
from types import SimpleNamespace

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH

import lubfric
from lubfric import studies
from lubfric.output import command_line, main, run_history

STUDY = "scene = 's.toml'\nspeeds = [0.1]\n[vary]\n'bodies.load' = [5.0, 6.0]\n"


class Reached(Exception):
    """What stands here in place of a solve."""


@pytest.fixture
def work(tmp_path, monkeypatch):
    """A folder with a scene, two maps and a measured curve; ``calls``: what each solver was given before it stopped."""
    for name, seed in (("rough.npy", 1), ("other.npy", 2)):
        np.save(tmp_path / name, 1e-8 * np.random.default_rng(seed).standard_normal((64, 64)))
    (tmp_path / "s.toml").write_text(BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.2\n" + SMALL_PATCH)
    mapped = SMALL_PATCH.replace("correlation_length = 4e-6", "file = 'rough.npy'\nspacing = 1.1e-6")
    both = mapped + "[counterface]\nfile = 'other.npy'\nspacing = 1.1e-6\n"
    (tmp_path / "maps.toml").write_text(BODIES_AND_OIL + "[motion]\nentrainment_speed = 0.2\n" + both)
    rows = "100,1,0.05,0.001\n200,2,0.04,0.002\n400,4,0.03,0.003\n"
    (tmp_path / "rig.csv").write_text(f"U [mm/s],srr [%],mu,sigma\n{rows}")
    calls = []

    def solver(*arguments, **options):
        calls.append((arguments, options))
        raise Reached

    for name in ("stribeck", "traction", "fit", "study"):
        monkeypatch.setattr(studies, name, solver)
    monkeypatch.setattr(run_history, "run_in_time", solver)
    monkeypatch.chdir(tmp_path)
    return SimpleNamespace(folder=tmp_path, calls=calls)


def given(work, *command):
    """What the solver of a command was given."""
    with pytest.raises(Reached):
        main([str(word) for word in command])
    return work.calls[-1]


def scene_of(call):
    first = call[0][0]
    return getattr(first, "scene", first)


def test_run_without_options_is_the_scene(work):
    call = given(work, "run", "s.toml")
    assert scene_of(call) == lubfric.load_scene("s.toml") and call[0][1] == [0.2] and call[1]["fields"] == [0.2]


def test_speeds_fields_and_ratios(work):
    call = given(work, "run", "s.toml", "--speeds", "0.1,0.4", "--fields", "0.4")
    assert list(call[0][1]) == [0.1, 0.4] and call[1]["fields"] == [0.4]
    call = given(work, "run", "s.toml", "--speeds", "0.01:1:3")
    assert call[0][1] == pytest.approx([0.01, 0.1, 1.0])
    assert call[1]["fields"] == pytest.approx([0.1])  # nearest to the scene's own, 0.2
    assert given(work, "run", "s.toml", "--speeds", "auto")[0][1] == "auto"
    assert given(work, "run", "s.toml", "--ratios", "0.1,0.4")[0][1] == [0.1, 0.4]


def test_tolerance_and_acceptance(work):
    for text in ("0.07", "7 %"):
        assert scene_of(given(work, "run", "paper", "--sampling-tolerance", text)).numerics.sampling_tolerance == 0.07
    assert scene_of(given(work, "run", "paper", "--accept")).numerics.accept
    plain = scene_of(given(work, "run", "paper")).numerics
    assert not plain.accept and plain.sampling_tolerance == 0.02


@pytest.mark.parametrize("command", ["run", "fit"])
def test_maps_of_both_bodies(work, command):
    more = ["--measured", "rig.csv", "--speed", "U", "--coefficient", "mu", "--parameter", "bodies.load=1:9"]
    more = more if command == "fit" else []
    scene = scene_of(given(work, command, "maps.toml", *more, "--surface", "other.npy", "--counterface", "rough.npy"))
    assert scene.surface.file.endswith("other.npy") and scene.counterface.file.endswith("rough.npy")
    scene = scene_of(given(work, command, "maps.toml", *more))
    assert scene.surface.file.endswith("rough.npy") and scene.counterface.file.endswith("other.npy")


def test_workers_of_a_curve_and_of_a_study(work, monkeypatch):
    requested = []

    def pool(count):
        requested.append(count)
        raise Reached

    monkeypatch.setattr(studies, "pool", pool)
    (work.folder / "study.toml").write_text(STUDY)
    for command in (["run", "s.toml", "--workers", "3"], ["study", "study.toml", "--workers", "2"]):
        with pytest.raises(Reached):
            main(command)
    assert requested == [3, 2]


def test_a_fit_gets_columns_bounds_and_axis(work):
    named = ["fit", "s.toml", "--measured", "rig.csv", "--coefficient", "mu"]
    named += ["--parameter", "bodies.load=1:9", "--parameter", "lubricant.viscosity=0.1:1"]
    (scene, measured, bounds), _ = given(work, *named, "--speed", "U", "--deviation", "sigma")
    assert measured.over == "speed" and measured.x == pytest.approx([0.1, 0.2, 0.4])
    assert measured.coefficient.tolist() == [0.05, 0.04, 0.03]
    assert measured.deviation.tolist() == [0.001, 0.002, 0.003]
    assert bounds == {"bodies.load": (1.0, 9.0), "lubricant.viscosity": (0.1, 1.0)}
    (_, measured, _), _ = given(work, *named, "--ratio", "srr")
    assert measured.over == "slide_roll_ratio" and measured.x == pytest.approx([0.01, 0.02, 0.04])
    assert measured.deviation is None and measured.rolling
    (_, measured, _), _ = given(work, *named, "--ratio", "srr", "--without-rolling")
    assert not measured.rolling


@pytest.mark.parametrize(
    "options, asked", [([], (False, False)), (["--netcdf"], (True, False)), (["--parquet"], (False, True))]
)
def test_other_tables_of_a_study(work, monkeypatch, options, asked):
    (work.folder / "study.toml").write_text(STUDY)
    tools = []
    monkeypatch.setattr(studies, "check_tools", lambda *, netcdf, parquet: tools.append((netcdf, parquet)))
    given(work, "study", "study.toml", *options)
    assert tools == [asked]


def test_the_folder_of_the_results_and_of_a_study(work):
    (work.folder / "study.toml").write_text(STUDY)
    (plan,), options = given(work, "study", "study.toml", "--out", work.folder / "kept")
    assert str(options["store"]).endswith("kept") and plan.scene == lubfric.load_scene("s.toml")
    given(work, "run", "s.toml", "--out", "there")
    assert (work.folder / "there").is_dir() and not (work.folder / "out").exists()


def options_of(parser):
    """Every long option of a parser and of its commands."""
    for action in parser._actions:
        yield from (word for word in action.option_strings if word.startswith("--"))
        if isinstance(action, argparse._SubParsersAction):
            for sub in action.choices.values():
                yield from options_of(sub)


def test_every_option_is_tested_somewhere(root):
    """An option that no test names does nothing that a test would miss."""
    tests = "\n".join(path.read_text("utf-8") for path in (root / "tests").rglob("test_*.py"))
    assert [word for word in set(options_of(command_line.parser())) - {"--help"} if f'"{word}"' not in tests] == []


def test_help_shows_what_there_is(capsys):
    """An option that does nothing is not shown, nor is the word with which argparse hides it."""
    with pytest.raises(SystemExit):
        main(["run", "-h"])
    stated = capsys.readouterr().out
    assert "--sampling-tolerance" in stated and "--report" not in stated and "SUPPRESS" not in stated


@pytest.mark.parametrize(
    "text, ratios",
    [
        ("0:0.5:11", np.linspace(0, 0.5, 11)),
        ("-0.2:0.2:5", [-0.2, -0.1, 0.0, 0.1, 0.2]),
        ("0.1:0.5:5:linear", [0.1, 0.2, 0.3, 0.4, 0.5]),
        ("0.01:1:3", [0.01, 0.1, 1.0]),
        ("0.01:1:3:log", [0.01, 0.1, 1.0]),
        ("0,0.5", [0.0, 0.5]),
    ],
)
def test_ratios_begin_at_zero_in_even_steps(work, text, ratios):
    np.testing.assert_allclose(given(work, "run", "s.toml", f"--ratios={text}")[0][1], ratios, atol=1e-15)


@pytest.mark.parametrize("text", ["0:0.5:1", "0.5:0:3", "0:0.5:11:even", "0:0.5:2.5", "0:0.5:11:log"])
def test_ranges_of_ratios_that_are_none(work, text, capsys):
    assert main(["run", "s.toml", f"--ratios={text}"]) != 0
    assert "--ratios" in capsys.readouterr().err
