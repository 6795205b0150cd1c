"""``lubfric run-in``: the map it writes is that of `lubfric.run_in`, and the scene it writes takes this map."""

import html
import json
from dataclasses import replace

import numpy as np
import pytest
from scene_text import BODIES_AND_OIL, SMALL_PATCH

import lubfric
from lubfric.output import main

SCENE = BODIES_AND_OIL.replace("e_prime", "hardness = 2e9\ne_prime") + "[motion]\nentrainment_speed = 0.01\n"
SCENE += "slide_roll_ratio = 2.0\n" + SMALL_PATCH
WEAR = ["--distance", "1 mm", "--wear-coefficient", "1e-6"]


@pytest.fixture(scope="module", autouse=True)
def few_records():
    """Distances at which a lift-off speed is sought take most of the time."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("lubfric.running_in.wear.RECORDS", 2)
        yield


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run_in")
    (folder / "s.toml").write_text(SCENE)
    assert main(["run-in", str(folder / "s.toml"), *WEAR, "--out", str(folder / "out")]) == 0
    return folder


def test_the_files_hold_what_the_function_returns(folder):
    steps = []
    scene = lubfric.load_scene(folder / "s.toml")
    result = lubfric.run_in(scene, distance=1e-3, wear_coefficient=1e-6, on_progress=lambda *step: steps.append(step))
    np.testing.assert_array_equal(np.load(folder / "out" / "surface.npy"), result.surface.heights)
    table = (folder / "out" / "run_in.csv").read_text().splitlines()
    assert len(table) == 1 + 2 + result.wear.distance.size
    last = dict(zip(table[0].split(","), table[-1].split(",")))
    assert float(last["sq [m]"]) == result.wear.sq[-1] and float(last["distance [m]"]) == 1e-3
    assert float(last["lift_off_speed [m/s]"]) == pytest.approx(result.wear.lift_off_speed[-1], nan_ok=True)
    assert {what for what, _, _ in steps} == {"pass", "wear", "friction at distances of wear"}
    assert ("wear", 100, 100) in steps
    assert json.loads((folder / "out" / "run_in.json").read_text())["passes"]["shaken_down"] is True
    sources = (folder / "out" / "references.bib").read_text(encoding="utf-8")
    assert sources == f"{result.cite('bibtex')}\n" and "10.1063/1.1721448" in sources  # of Archard's law
    quoted = result.cite("methods")
    for words in (
        "Running-in of the surface was computed with lubfric",
        "Sq 100 nm (Ra 79.79 nm); correlation length",
        "plastic limit of the contact pressure 2 GPa",
        f"{result.deepest.size} passes in steps of ",
        "entrainment speed 0.01 m/s",
        "sliding distance 1 mm",
        "wear coefficient 1·10⁻⁶",
        "hardness 2 GPa of the rough body and 2 GPa of the other one",
        f"; {result.wear.steps} step",
    ):
        assert words in quoted.replace("\n- ", "; "), words
    page = (folder / "out" / "report.html").read_text(encoding="utf-8")
    assert html.escape(quoted) in page
    assert "Archard" not in replace(result, wear=None).cite() and "Polonsky" in replace(result, wear=None).cite()


def test_the_scene_it_writes_takes_the_map(folder):
    scene = lubfric.load_scene(folder / "out" / "scene.toml")
    heights = np.load(folder / "out" / "surface.npy")
    surface = lubfric.prepare(scene).surface
    plane = np.linalg.lstsq(_plane(heights.shape), heights.ravel(), rcond=None)[0]
    left = heights - (_plane(heights.shape) @ plane).reshape(heights.shape)
    assert surface.sq == pytest.approx(left.std(), rel=1e-6)
    assert lubfric.friction(scene).coefficient > 0


def _plane(shape):
    x, y = np.meshgrid(np.arange(shape[0]), np.arange(shape[1]), indexing="ij")
    return np.stack([np.ones(x.size), x.ravel(), y.ravel()], axis=1)


def test_the_report_states_what_has_changed(folder):
    page = (folder / "out" / "report.html").read_text(encoding="utf-8")
    assert "Sq changes from 100 nm to" in page and "The lift-off speed changes from" in page
    assert "Archard" in page and "Effects not modelled" in page and page.count("<img") == 1


def test_half_of_wear_is_refused(folder, capsys):
    assert main(["run-in", str(folder / "s.toml"), "--distance", "1 m", "--out", str(folder / "x")]) == 2
    assert "--distance is for wear, which needs --wear-coefficient as well" in capsys.readouterr().err
    assert not (folder / "x").exists()


def test_passes_end_a_running_in_that_still_yields(folder, capsys):
    out = folder / "one"
    assert main(["run-in", str(folder / "s.toml"), "--passes", "1", "--out", str(out)]) == 0
    result = lubfric.run_in(lubfric.load_scene(folder / "s.toml"), passes=1)
    np.testing.assert_array_equal(np.load(out / "surface.npy"), result.surface.heights)
    assert not result.shaken_down and "Give more --passes" in capsys.readouterr().err
    assert "Not complete: asperities still yield." in (out / "report.html").read_text(encoding="utf-8")
