"""Strips: generated, and windows of a measured map, joined to one line; their cells and seams."""

import json
import re

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.samples import measured_strips
from lubfric.samples import strips as strips_room

PAPER = paper_scene()


def test_a_strip_is_always_the_same_and_like_no_other():
    strips = lubfric.prepare(PAPER).sample
    one = strips.joined(range(1))
    both = strips.joined(range(2))
    length = one.shape[1]
    assert both.shape[1] == 2 * length and one.size[1] == pytest.approx(90 * strips.correlation_lengths[1], rel=0.05)
    np.testing.assert_array_equal(strips.joined(range(2)).heights, both.heights)
    middle = slice(length // 4, length)
    np.testing.assert_array_equal(one.heights[:, middle], both.heights[:, middle])
    first = both.heights[:, :length].ravel()
    second = both.heights[:, length:].ravel()
    assert abs(np.corrcoef(first, second)[0, 1]) < 0.1
    assert both.sq == pytest.approx(PAPER.surface.sq, rel=0.03)
    other = lubfric.prepare(PAPER.with_(surface={"seed": 2})).sample.joined(range(1))
    assert abs(np.corrcoef(one.heights.ravel(), other.heights.ravel())[0, 1]) < 0.1


def test_all_strips_of_a_body_are_made_from_one_spectrum(monkeypatch):
    made = []
    real = strips_room.surface_generator
    monkeypatch.setattr(
        strips_room, "surface_generator", lambda *given, **how: made.append(given) or real(*given, **how)
    )
    sample = strips_room.generated_strips(PAPER)
    maps = [sample.strip(index).heights for index in range(3)]
    assert len(made) == 1 and not np.array_equal(maps[1], maps[2])


def test_a_measured_map_gives_its_own_columns_no_more_than_it_holds():
    surface = lubfric.generate_surface((600, 256), 0.45e-6, sq=1e-7, correlation_length=4e-6, acf="gaussian", seed=1)
    strips = measured_strips(PAPER.with_(contact={"shape": None, "spacing": None}), surface)
    fx, fy = strips.cells.coarsening
    wide = strips.cells.columns * fx
    assert (
        not strips.is_homogeneous
        and strips.ends_after(len(strips.starts))
        and all(0 <= start <= 600 - wide for start in strips.starts)
    )
    assert strips.rows == strips.strip(0).shape[1]
    assert np.diff(sorted(strips.starts)).min() * 0.45e-6 >= 4 * 3.5e-6
    line = strips.joined(range(strips.available_strips))
    assert line.size[1] == pytest.approx(strips.available_strips * strips.strip_length, rel=0.05)
    own = surface.heights[strips.starts[0] + fx // 2 : strips.starts[0] + wide : fx, fy // 2 :: fy]
    np.testing.assert_array_equal(line.heights[:, 20:40], own[:, 20:40])


def test_a_piece_has_the_stated_length_and_is_no_longer_than_its_map():
    """The time of the fields of a piece was estimated for ten times as many cells as a narrow map holds."""
    surface = lubfric.generate_surface((600, 256), 0.45e-6, sq=1e-7, correlation_length=4e-6, acf="gaussian", seed=1)
    generated = lubfric.prepare(PAPER).sample
    for sample in (generated, measured_strips(PAPER.with_(contact={"shape": None, "spacing": None}), surface)):
        for length in (8.0, 20.0, 300.0):
            piece = sample.piece(0, length)
            stated = sample.length_of_piece(length)
            assert stated == pytest.approx(piece.size[1], rel=0.2)  # rows that suit the transform
            assert sample is generated or stated <= surface.size[1]


@pytest.mark.parametrize("width", [4])
def test_a_map_too_narrow_for_a_line_is_refused_by_its_width(tmp_path, width):
    np.save(tmp_path / "m.npy", np.random.default_rng(0).normal(0, 1e-8, (64, width)))
    surface = {"file": str(tmp_path / "m.npy"), "spacing": 1e-6}
    scene = PAPER.with_(surface=surface, contact={"shape": None, "spacing": None})
    with pytest.raises(lubfric.InputError, match=f"the map is {width} cells wide along y.*sampling = 'patch'"):
        lubfric.prepare(scene)
    assert lubfric.prepare(scene.with_(numerics={"sampling": "patch"})).surface.shape[1] >= width


def test_a_prepared_scene_is_used_again_or_made_again():
    model = lubfric.prepare(PAPER)
    same = lubfric.prepare(PAPER.with_(motion={"slide_roll_ratio": 1.0}), like=model)
    assert same.surface is model.surface and same.rough_contact.operator is model.rough_contact.operator
    patch = lubfric.prepare(PAPER.with_(numerics={"sampling": "patch"}), like=model)
    assert not patch.sample.represents_more and patch.surface.shape == PAPER.contact.shape
    back = lubfric.prepare(PAPER, like=patch)
    np.testing.assert_array_equal(back.surface.heights, model.surface.heights)
    with pytest.raises(lubfric.InputError, match="surface = .* is not that of the prepared scene"):
        lubfric.prepare(PAPER.with_(surface={"seed": 2}), like=model)


def test_a_patch_from_a_file_answers_as_the_same_map_from_memory(tmp_path):
    """Its own rows, none twice; by both models, and the same if it is turned along y."""
    rough = lubfric.generate_surface((80, 96), 2e-6, sq=1e-7, correlation_length=8e-6, acf="gaussian", seed=6)
    x, y = np.meshgrid(*(np.linspace(-1, 1, n) for n in rough.shape), indexing="ij")
    plane = np.column_stack([np.ones(x.size), x.ravel(), y.ravel()])
    level = rough.heights - (plane @ np.linalg.lstsq(plane, rough.heights.ravel(), rcond=None)[0]).reshape(x.shape)
    np.save(tmp_path / "m.npy", level)
    scene = PAPER.with_(contact={"shape": (80, 96), "spacing": 2e-6}, numerics={"sampling": "patch", "tolerance": 0.1})
    own = {"surface": {"file": str(tmp_path / "m.npy"), "spacing": 2e-6}, "contact": {"shape": None, "spacing": None}}
    file = lubfric.prepare(scene.with_(**own))
    n = file.surface.shape[0]
    cut = level[(80 - n) // 2 : (80 - n) // 2 + n]
    np.testing.assert_allclose(file.surface.heights, cut, atol=1e-12)
    memory, rolled = (
        lubfric.prepare(scene, lubfric.Surface(z, (2e-6, 2e-6), periodic_axes=(False, True)))
        for z in (cut, np.roll(cut, 16, axis=1))
    )
    for model in ("paper", "deterministic"):
        f = [lubfric.friction(one, 0.01, model=model).coefficient for one in (file, memory, rolled)]
        assert f[0] == pytest.approx(f[1], rel=1e-6) and f[0] == pytest.approx(f[2], rel=0.02)


@pytest.mark.parametrize("lengths", [3e-6, (8e-6, 40e-6)])
def test_a_scene_without_cells_is_answered_with_cells_that_work(lengths):
    """As many as contain the contact and all of the surface's longest wavelengths, each a tenth of the shortest."""
    scene = lubfric.load_scene("paper").with_(
        contact={"shape": None, "spacing": None}, surface={"correlation_length": lengths}
    )
    with pytest.raises(lubfric.InputError, match=r"contact.shape .* for example shape = \[") as refused:
        lubfric.friction(scene, 0.03)
    example = re.search(r'shape = (\[.*?\]) and spacing = "(.*?)"', str(refused.value))
    suggested = scene.with_(contact={"shape": json.loads(example[1]), "spacing": example[2]})
    shortest = np.min(lengths)
    assert 0.5 * shortest / 10 < suggested.contact.spacing < 1.5 * shortest / 10
    assert suggested.contact.shape[0] * suggested.contact.spacing > max(
        8 * np.max(lengths), 2 * scene.bodies.half_width
    )
    assert lubfric.prepare(suggested).surface.sq > 0


@pytest.mark.parametrize("row", [10, 200, 330])
def test_the_piece_of_a_picture_holds_the_main_ridge_of_a_map(tmp_path, row):
    """A ridge along the motion, 300 nm high, wherever it is across; the pieces that f is corrected by stay where they
    are."""
    rough = lubfric.generate_surface((128, 400), 1e-6, sq=2e-8, correlation_length=6e-6, acf="gaussian", seed=1)
    ridge = 3e-7 * np.exp(-(((np.arange(400) - row) / 4.0) ** 2))
    np.save(tmp_path / "ridge.npy", rough.heights + ridge)
    keys = {"file": str(tmp_path / "ridge.npy"), "spacing": 1e-6, "outliers": "keep"}
    grid = {"shape": None, "spacing": None}
    sample = lubfric.prepare(lubfric.load_scene("paper").with_(surface=keys, contact=grid)).sample
    pictured = sample.pictured_piece()
    assert pictured.shape[1] == sample.piece(0).shape[1] < 300 and pictured.heights.max() > 2.5e-7
    assert (sample.piece(0).heights.max() > 2.5e-7) == (row == 200)
