"""The length of the sample: one number in the estimate, the result, the fields and the picture."""

import re
import time

import numpy as np
import pytest

import lubfric
from lubfric.output import describe_scene, estimate_scene
from lubfric.output.contact_pictures import part_in_words

PAPER = lubfric.load_scene("paper")
ROLLING = PAPER.with_(
    bodies={"load": 60.0, "boundary_film": 2e-8},
    lubricant={"viscosity": 0.1, "eyring_stress": 5e6, "limiting_stress_coefficient": 0.06},
    motion={"slide_roll_ratio": 0.2, "entrainment_speed": 0.3},
    contact={"shape": (96, 48), "spacing": 1.8e-6},
    numerics={"model": "quick", "sampling_tolerance": 0.5, "tolerance": 0.1},
)


def row_of_table(scene: lubfric.Scene) -> dict[str, str]:
    """Return the row of the estimate at 0.3 m/s, by its headings."""
    prepared = lubfric.prepare(scene)
    (heads, *rows) = estimate_scene(prepared.scene, prepared.sample, prepared.surface).table
    return dict(zip(heads, next(row for row in rows if row[0] == "0.3")))


def test_length_of_the_line_is_the_same_before_and_after_the_solve():
    row = row_of_table(ROLLING)
    point = lubfric.friction(ROLLING, fields=True)
    assert point.decision.strips == int(row["strips"]) == 1
    stated = point.uncertainty.length
    assert float(row["length of the line [mm]"]) == pytest.approx(1e3 * stated, rel=0.05)
    y = point.y
    assert y.size * (y[1] - y[0]) == pytest.approx(stated, rel=1e-9)
    assert f"of a line of {1e3 * stated:.3g} mm" in point.uncertainty.text


@pytest.mark.parametrize("newtonian", [True, False])
def test_load_that_rubs_is_the_same_in_the_answer_and_in_the_method(newtonian):
    """The calibration takes a bias from the asperity load of the strips; the text has the load of the answer."""
    oil = {"eyring_stress": None, "limiting_stress_coefficient": None} if newtonian else {}
    scene = ROLLING.with_(motion={"slide_roll_ratio": 2.0}, lubricant=oil | {"viscosity": 0.01})
    point = lubfric.friction(scene)
    (text,) = [part for part in point.decision.parts if part.startswith("load on gaps below the boundary film")]
    parts = [float(part) for part in re.findall(r"([0-9.e-]+) %", text)]
    rubs = parts[0] + parts[2] if newtonian else parts[0]
    assert rubs == pytest.approx(100 * point.contact_load / scene.bodies.load, rel=0.01)
    assert (
        ("limiting stress" in point.decision.contact_load_in_words)
        == newtonian
        == text.endswith("part of the asperity load")
    )


def test_a_named_model_has_no_column_of_another():
    assert "deterministic strips" not in row_of_table(ROLLING)
    assert "deterministic strips" in row_of_table(ROLLING.with_(numerics={"model": "auto"}))


def test_picture_of_a_part_counts_whole_cells():
    y = 8e-6 * np.arange(60)
    assert part_in_words(y, slice(10, 48), "the map") == "; 304 of 480 µm of the map"
    assert part_in_words(y, slice(None), "the map") == ""


def test_warnings_recommend_nothing_that_the_scene_has():
    """Simple sliding is at the edge of the calibration, and a given limiting stress is not recommended again."""
    scene = ROLLING.with_(motion={"slide_roll_ratio": 2.0}, bodies={"load": 400.0})
    text = describe_scene(scene)
    assert "highest film pressure is" in text and "give a measured limiting stress" not in text
    assert "slide-roll ratio is 2" not in text
    without = describe_scene(scene.with_(lubricant={"limiting_stress_coefficient": None}))
    assert "give a measured limiting stress" in without


def test_the_reason_against_the_deterministic_model_has_the_unit_of_its_key():
    scene = ROLLING.with_(lubricant={"shear_modulus": "100 MPa"}, numerics={"model": "auto"})
    assert "lubricant.shear_modulus = 100 MPa (the deterministic model allows none," in describe_scene(scene)


def test_the_estimate_of_a_measured_map_has_the_time_in_which_its_file_is_made_ready(tmp_path):
    patch = {"contact": {"shape": None, "spacing": None}, "numerics": {"model": "quick", "sampling": "patch"}}
    rng = np.random.default_rng(5)
    waves = np.exp(-((np.hypot(np.fft.fftfreq(300)[:, None], np.fft.rfftfreq(300)) * 20.0) ** 2))
    heights = np.fft.irfft2(np.fft.rfft2(rng.standard_normal((300, 300))) * waves, (300, 300))
    np.save(tmp_path / "map.npy", 1e-7 * heights / heights.std())
    scene = PAPER.with_(surface={"file": str(tmp_path / "map.npy"), "spacing": 2e-7}, **patch)
    begun = time.process_time()
    prepared = lubfric.prepare(scene)
    taken = time.process_time() - begun
    with_file, without = (
        estimate_scene(each, prepared.sample, prepared.surface, [0.03]).seconds
        for each in (scene, PAPER.with_(**patch))
    )
    assert 0.1 < (with_file - without) / taken < 10.0
