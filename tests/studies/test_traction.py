"""Traction curves: shape, the same numbers as single points, errors kept, files, maps of two keys."""

import csv
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.output import main
from lubfric.studies import plot_map

NEWTONIAN = {"eyring_stress": None, "limiting_stress_coefficient": None}
SCENE = paper_scene(
    bodies={"radius": 0.01, "hertz_pressure": 1e9, "width": 0.01, "material": "steel"},
    lubricant={"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 70, "density": 870}
    | {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.08},
    motion={"entrainment_speed": 2.0},
    contact={"shape": (128, 64), "spacing": 4e-6},
    surface={"sq": 2e-8, "correlation_length": 3e-5, "acf": "gaussian"},
    numerics={"sampling": "patch"},
)


@pytest.fixture(scope="module")
def model():
    return lubfric.prepare(SCENE)


@pytest.mark.slow
def test_traction_rises_peaks_and_falls_with_heat_and_rises_without(model):
    ratios = np.geomspace(1e-3, 2, 12)
    f = lubfric.traction(model, ratios).coefficient
    top = int(np.argmax(f))
    assert 3 < top < 11 and np.all(np.diff(f[: top + 1]) > 0) and np.all(np.diff(f[top:]) < 0)
    cold = lubfric.traction(SCENE.with_(numerics={"heat": "off"}), ratios).coefficient
    assert np.all(np.diff(cold) > 0) and cold[-1] > 1.5 * f[-1]


def test_points_are_those_of_friction_in_the_order_requested(model):
    ratios = [0.5, 0.0, -0.5, 2.0]
    curve = lubfric.traction(model, ratios, speed=0.5)
    assert curve.speed == 0.5 and list(curve.ratio) == ratios
    for i, ratio in enumerate(ratios):
        alone = lubfric.friction(lubfric.prepare(SCENE.with_(motion={"slide_roll_ratio": ratio}), like=model), 0.5)
        assert curve.coefficient[i] == pytest.approx(alone.coefficient, rel=0.01, abs=1e-5)
        assert curve["film_load"][i] == pytest.approx(alone.film_load, rel=0.01)
    assert curve.points[1].boundary_force == 0  # rolling: spots do not slide


def test_a_store_and_processes_change_no_bit_of_a_traction_curve(tmp_path, monkeypatch):
    """Ratios of a longer call are solved once; a process for each ratio, or for the parts of each, gives the same."""
    ratios = [0.5, 0.1, -0.5]
    alone = lubfric.traction(SCENE, ratios, speed=0.5)
    lubfric.traction(SCENE, ratios[:2], speed=0.5, store=tmp_path / "store")
    seen = []
    for options in ({"store": tmp_path / "store"}, {"workers": 2}, {"workers": 4}):
        curve = lubfric.traction(SCENE, ratios, speed=0.5, on_point=lambda *point: seen.append(point), **options)
        np.testing.assert_array_equal(curve.coefficient, alone.coefficient)
        np.testing.assert_array_equal(curve["power_loss"], alone["power_loss"])
    assert [sorted(point[2] for point in seen[i : i + 3]) for i in (0, 3, 6)] == [sorted(ratios)] * 3
    assert [point[0] for point in seen] == [1, 2, 3] * 3 and {point[1] for point in seen} == {3}
    monkeypatch.setattr("lubfric.studies.points.friction", None)  # every point is there
    kept = lubfric.traction(SCENE, ratios, speed=0.5, store=tmp_path / "store")
    np.testing.assert_array_equal(kept.coefficient, alone.coefficient)
    with pytest.raises(TypeError) as fault:
        lubfric.traction(SCENE, [0.1, 0.7], speed=0.5, store=tmp_path / "store")
    assert fault.value.result.coefficient[0] == alone.coefficient[1] and np.isnan(fault.value.result.coefficient[1])


def test_the_mean_over_both_signs_of_slip_is_f_without_the_rolling_part():
    """Of a smooth film, which is the same whichever body is the faster: what is taken out is some 1e-4 of the load, and
    the more of f the less the bodies slide."""
    smooth = SCENE.with_(surface={"sq": 0.0})
    slips = np.array([1e-7, 5e-3, 0.2])
    there, back = (lubfric.traction(smooth, sense * slips) for sense in (1, -1))
    np.testing.assert_allclose(there.without_rolling, (there.coefficient + back.coefficient) / 2, rtol=1e-6, atol=1e-7)
    rolling = there.coefficient - there.without_rolling
    assert np.all(rolling > 5e-5) and rolling[0] == pytest.approx(rolling[2], rel=0.1)
    assert there.without_rolling[0] < rolling[0] < 0.01 * there.without_rolling[1]  # the rest vanishes with the slip


def test_f_without_rolling_is_the_mean_of_the_forces_on_both_surfaces():
    """Their powers add up to the power loss, P = F_1 u_1 + F_2 u_2, and their sum is the rolling resistance R: the
    rest, P - R U, is their mean difference times the sliding speed. The pressure on flanks of moving roughness, which
    opposes sliding, is in it."""
    curve = lubfric.traction(SCENE, [-0.4, 0.4], speed=0.1)
    resistance = curve["rolling_resistance"]
    sliding = np.array([-0.04, 0.04])
    rest = (curve["power_loss"] - 0.1 * resistance) / (SCENE.bodies.load * np.abs(sliding))
    np.testing.assert_allclose(curve.without_rolling, rest, rtol=1e-9)
    pushed = curve["rolling_force"][1] + 1.0  # by flanks: a part of f, and no resistance to rolling
    flanks = replace(curve.points[1], rolling_force=pushed)
    assert replace(curve, points=(None, flanks)).without_rolling[1] == curve.without_rolling[1]


def test_rolling_backwards_without_sliding_is_resisted_as_forwards():
    """Its slide-roll ratio comes out as -0.0, which is no sense of sliding."""
    smooth = SCENE.with_(surface={"sq": 0.0})
    there, back = (lubfric.friction(smooth.with_(motion={"surface_speeds": [u, u]})).coefficient for u in (0.3, -0.3))
    assert back == pytest.approx(there, rel=1e-9) and there > 0


def test_a_refused_ratio_is_marked_and_the_others_kept():
    plain = SCENE.with_(lubricant=NEWTONIAN, numerics={"heat": "off"})
    with pytest.raises(lubfric.LubfricError) as caught:
        lubfric.traction(plain, [0.0, 1.0])
    curve = caught.value.result
    assert "ratio" in str(caught.value) and set(curve.errors) == {1}
    assert np.isfinite(curve.coefficient[0]) and np.isnan(curve.coefficient[1])
    assert isinstance(curve.errors[1], lubfric.ValidityError) and any("not valid" in v for v in curve.validity)
    assert curve.report.notes[0].startswith("slide-roll ratio 1: ")
    assert "2 slide-roll ratios" in repr(curve) and "failed 1" in repr(curve)


def full_disk(path, *_, **__):
    Path(path).write_bytes(b"half")
    raise OSError(28, "No space left on device")


def test_command_writes_the_curve(tmp_path, capsys, monkeypatch, draws):
    draws("traction.png")
    (tmp_path / "map.npy").write_bytes(b"")
    surface = lubfric.generate_surface((128, 64), 4e-6, sq=2e-8, correlation_length=12e-6, seed=1)
    np.save(tmp_path / "map.npy", surface.heights)
    (tmp_path / "s.toml").write_text(
        '[bodies]\nradius = 0.01\nwidth = 0.01\nhertz_pressure = 1e9\nmaterial = "steel"\n'
        "boundary_friction_coefficient = 0.1\n[lubricant]\ngrade = 'ISO VG 68'\nviscosity_index = "
        "95\ntemperature_celsius = 70\n"
        "eyring_stress = 5e6\nlimiting_stress_coefficient = 0.08\n[motion]\nentrainment_speed = 2.0\n"
        "[surface]\nfile = 'map.npy'\nspacing = 4e-6\n"
    )
    out = tmp_path / "o"
    assert main(["run", str(tmp_path / "s.toml"), "--ratios", "0.01:1:3", "--out", str(out)]) == 0
    rows = list(csv.reader((out / "traction.csv").read_text().splitlines()))
    record = json.loads((out / "result.json").read_text())
    assert len(rows) == 4 and rows[0][0] == "ratio [-]" and rows[0][-3:] == ["model", "validity", "uncertainty"]
    assert float(rows[2][rows[0].index("coefficient [-]")]) == pytest.approx(record["points"][1]["coefficient"])
    low, high = (float(rows[2][rows[0].index(f"interval_{end} [-]")]) for end in ("low", "high"))
    alone = lubfric.friction(
        lubfric.load_scene(tmp_path / "s.toml").with_(motion={"slide_roll_ratio": float(rows[2][0])})
    )
    assert low < alone.coefficient < high and rows[2][-3] == alone.decision.model
    assert (low, high) == pytest.approx(alone.uncertainty.interval, rel=2e-3)
    assert (out / "traction.png").stat().st_size > 10_000
    stated = capsys.readouterr().err
    least, most = re.search(r"the film is ([\d.]+) or ([\d.]+) times as thick as the isothermal one", stated).groups()
    assert "factors for the heat of the inlet" in stated and float(least) < float(most)
    drawn = (out / "traction.png").read_bytes()
    (out / "traction.png").unlink()
    assert main(["plot", str(out)]) == 0 and (out / "traction.png").read_bytes() == drawn
    with monkeypatch.context() as full:
        full.setattr("lubfric.output.curve_picture.plot_traction", full_disk)
        assert main(["plot", str(out)]) != 0 and (out / "traction.png").read_bytes() == drawn
    assert main(["plot", str(out), "--measured", "m.csv", "--speed", "u", "--coefficient", "f"]) == 2
    assert "is not for a traction curve; give --ratio" in capsys.readouterr().err
    (out / "traction.csv").write_text("ratio [-],speed [m/s]\n0.1,")
    assert main(["plot", str(out)]) == 2 and "traction.csv" in capsys.readouterr().err


def test_a_map_needs_two_dimensions_and_marks_what_has_no_answer(tmp_path):
    small = SCENE.with_(lubricant=NEWTONIAN, numerics={"heat": "off"})
    refused = lubfric.study(small, {"motion.slide_roll_ratio": [0.0, 1.0]}, [1.0, 30.0])
    assert refused.failed == 2 and np.isnan(refused["coefficient"][1]).all()
    plot_map(tmp_path / "map.png", refused, "speed", "motion.slide_roll_ratio")
    with pytest.raises(lubfric.InputError, match="two dimensions"):
        plot_map(tmp_path / "x.png", refused, "speed", "speed")


def test_a_map_is_the_same_in_whatever_order_its_values_stand(tmp_path):
    smooth = paper_scene(surface={"sq": 0.0})
    for name, viscosities, speeds in (("rising", [0.1, 0.2, 0.4], [1.0, 2.0]), ("mixed", [0.4, 0.1, 0.2], [2.0, 1.0])):
        study = lubfric.study(smooth, {"lubricant.viscosity": viscosities}, speeds)
        plot_map(tmp_path / f"{name}.png", study, "speed", "lubricant.viscosity")
    assert (tmp_path / "rising.png").read_bytes() == (tmp_path / "mixed.png").read_bytes()
    for vary in ({"bodies.material": ["steel", "bronze"]}, {"bodies.load": [5.0]}):
        with pytest.raises(lubfric.InputError, match="different numbers"):
            plot_map(tmp_path / "x.png", lubfric.study(smooth, vary, [1.0, 2.0]), "speed", *vary)


@pytest.mark.parametrize("option, unit", [("--ratios", ""), ("--speeds", "m/s")])
@pytest.mark.parametrize("text", ["0.5:0.1:3", "1e9", "words"])
def test_what_a_list_of_a_command_is_allowed_to_be_is_reported_in_its_own_unit(tmp_path, capsys, option, unit, text):
    assert main(["run", "paper", option, text, "--out", str(tmp_path)]) == 2
    stated = capsys.readouterr().err
    assert unit in stated and option in stated and ("m/s" in stated) == (unit == "m/s")


def test_a_key_with_long_words_stays_in_its_picture():
    """As drawn: no word of it is cut off at the right, and the title is above it."""
    scene = paper_scene().with_(numerics={"sampling": "patch"})
    loads = {"bodies.load": [3.0, 5.0], "lubricant.pressure_viscosity_coefficient": [1e-8, 2e-8]}
    axes = lubfric.study(scene, loads, [0.01, 1.0]).plot()
    axes.figure.canvas.draw()
    key = axes.get_legend().get_window_extent()
    title = axes.title.get_window_extent()
    assert 0 < key.x0 < key.x1 < axes.figure.bbox.width and key.y1 <= title.y0
