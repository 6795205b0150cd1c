"""The documents keep their word: every scene key is described, the CI runs the README's command, examples run."""

import json
import math
from dataclasses import fields
from pathlib import Path

import pytest

from lubfric.scene import SECTIONS, short_keys

ROOT = Path(__file__).parent.parent


@pytest.mark.parametrize("section", SECTIONS)
def test_every_scene_key_is_documented(section):
    text = (ROOT / "docs" / "scene.md").read_text()
    part = text.split(f"## [{section}]")[1].split("\n## ")[0]
    for key in [f.name for f in fields(SECTIONS[section])] + list(short_keys(section)):
        assert f"`{key}`" in part, f"[{section}] {key} is missing in docs/scene.md"


def test_ci_runs_the_readme_test_command():
    readme = (ROOT / "README.md").read_text()
    ci = (ROOT / ".ci" / "run").read_text()
    command = next(line for line in readme.splitlines() if line.endswith("-m pytest -n 2"))
    environment = command.split("-m venv ")[1].split()[0]
    assert (
        command.replace(environment, '"$environment"')
        .replace('"$environment"/', '"$environment/')
        .replace("/bin/pip", '/bin/pip"')
        .replace("/bin/python", '/bin/python"')
        in ci
    )


# Two seconds and more: their calls are those of other tests.
LONG = (
    "plot_04_oil",
    "plot_05_traction",
    "plot_07_study",
    "plot_08_stop_and_start",
    "plot_09_fit",
    "plot_14_bearing_torque",
)
LONG += ("plot_14_six_contacts", "plot_15_gear_flank", "plot_16_paper_band")


@pytest.mark.parametrize("script", sorted((ROOT / "docs" / "examples").glob("*.py")), ids=lambda p: p.name)
def test_examples_run(script, tmp_path, monkeypatch, load_sharing):
    import runpy

    monkeypatch.chdir(tmp_path)
    namespace = runpy.run_path(str(script))
    namespace["main"]()


@pytest.mark.parametrize(
    "script",
    [
        pytest.param(script, marks=[pytest.mark.slow] * (script.stem in LONG), id=script.stem)
        for script in sorted((ROOT / "docs" / "gallery").glob("plot_*.py"))
    ],
)
def test_gallery_runs_and_draws(script, tmp_path, monkeypatch, load_sharing):
    """Every script of the gallery stands alone, and ends with a picture that has something in it."""
    import runpy

    import matplotlib

    monkeypatch.chdir(tmp_path)
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.close("all")
    runpy.run_path(str(script))
    figures = [plt.figure(number) for number in plt.get_fignums()]
    plt.close("all")
    assert any(axes.has_data() for figure in figures for axes in figure.axes)


def test_example_scenes_are_valid_but_for_their_file(tmp_path):
    import numpy as np

    import lubfric

    np.save(tmp_path / "map.npy", np.zeros((4, 4)))
    for scene in sorted((ROOT / "docs" / "examples").glob("*.toml")):
        measured = "\nfile = " in scene.read_text()
        assert lubfric.load_scene(scene, surface_file=tmp_path / "map.npy" if measured else None).bodies.load > 0


@pytest.mark.parametrize("section", [name for name in SECTIONS if name != "counterface"])
def test_the_defaults_of_the_page_are_those_of_the_code(section):
    """Every default that the page states as a number or a word in quotes; the others are said in words."""
    text = (ROOT / "docs" / "scene.md").read_text()
    known = {f.name: f.default for f in fields(SECTIONS[section])}
    seen = 0
    columns: list[str] = []
    for line in text.split(f"## [{section}]")[1].split("\n## ")[0].splitlines():
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if "default" in cells:
            columns = cells
        elif (
            "default" in columns
            and len(cells) == len(columns)
            and (key := cells[0].partition("`")[2].partition("`")[0]) in known
        ):
            stated = cells[columns.index("default")].strip("`")
            try:
                value = json.loads(stated.replace("1/e", str(math.exp(-1))))
            except ValueError:
                continue
            if known[key] is None:  # found later, as the unit of a file
                continue
            assert value == pytest.approx(known[key]), (section, key)
            seen += 1
    least = {"bodies": 0, "surface": 6, "numerics": 10}
    assert seen >= least.get(section, 1)
