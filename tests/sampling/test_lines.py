"""Lines: generated and stacked from windows; their cells and seams."""

import dataclasses

import numpy as np
import pytest
from lubfric.sharing.lines_cells import cells_of_a_box, choose_cells
from lubfric.sharing.lines_generated import generated_lines, seed_of
from lubfric.sharing.lines_windows import measured_lines, spread, stack

import lubfric
from lubfric.sharing import next_length, thinned

PAPER = lubfric.load_scene("paper")


def test_cells_resolve_correlation_length_and_strip():
    cells = choose_cells((0.5e-6, 0.25e-6), (8e-6, 16e-6), 4.5e-6, 90e-6)
    assert cells.factors == (4, 16) and cells.coarse == (2e-6, 4e-6)
    assert 90e-6 <= cells.count * cells.coarse[0] < 90e-6 + 4 * cells.coarse[0]
    assert choose_cells((0.5e-6, 0.5e-6), (8e-6, 8e-6), 1.0e-6, 90e-6).factors == (1, 4)  # the strip asks for more
    assert cells_of_a_box((1e-6, 1e-6), (8e-6, 8e-6), 1.0, 50).count * 2 == 50
    assert cells.halved().factors == (2, 8) and cells.halved().count == 2 * cells.count


def test_a_line_has_its_seed_its_length_and_its_roughness():
    lines = generated_lines(PAPER)
    one, again, other = lines.line(1, 3e-3), lines.line(1, 3e-3), lines.line(2, 3e-3)
    np.testing.assert_array_equal(one.heights, again.heights)
    assert abs(np.corrcoef(one.heights.ravel(), other.heights.ravel())[0, 1]) < 0.1
    assert one.size[1] == pytest.approx(3e-3, rel=0.05) and one.sq == pytest.approx(PAPER.surface.sq)
    assert len({seed_of(1, 0, k) for k in range(100)} | {seed_of(1, 1, k) for k in range(100)}) == 200


def test_a_thinned_piece_lies_where_the_line_does():
    lines = generated_lines(PAPER)
    piece = lines.pair(0, 0.2e-3)
    coarse = thinned(PAPER, piece, lines.cells, lines.cells.factors)
    np.testing.assert_allclose(coarse.x, lines.cells.axis(), atol=1e-15)
    fine = thinned(PAPER, piece, lines.cells, (1, 1))
    shared = np.isin(np.round(fine.x / 1e-9), np.round(coarse.x / 1e-9))
    raw = fine.heights[shared][:, 2::4]
    np.testing.assert_allclose(raw - raw.mean(), coarse.heights - coarse.heights.mean(), atol=1e-18)
    assert fine.weight.sum() * fine.spacing[0] == pytest.approx(coarse.weight.sum() * coarse.spacing[0])


def test_stacked_windows_keep_their_variance_and_join_smoothly():
    rng = np.random.default_rng(3)
    pieces = [rng.standard_normal((200, 120)) for _ in range(6)]
    line = stack(pieces, 20)
    assert line.shape == (200, 6 * 100)
    assert line.std() == pytest.approx(1.0, abs=0.02)
    ramp = [np.full((1, 40), k, float) for k in (0.0, 1.0)]
    assert np.abs(np.diff(stack(ramp, 20)[0], append=stack(ramp, 20)[0, 0])).max() < 0.1


@pytest.mark.parametrize("count", [1, 2, 5, 12])
def test_windows_are_taken_from_the_middle_outwards_and_spread(count):
    order = spread(count)
    assert sorted(order) == list(range(count))
    assert abs(order[0] - (count - 1) / 2) <= 0.5
    if count == 12:
        assert np.ptp(order[:3]) >= 9


def test_a_measured_map_gives_its_own_columns_no_more_than_it_holds():
    heights = lubfric.generate_surface((600, 256), 0.45e-6, sq=1e-7, correlation_length=4e-6, acf="gaussian", seed=1)
    surface = dataclasses.replace(heights, periodic_axes=(False, False))
    lines = measured_lines(PAPER.with_(contact={"shape": None, "spacing": None}), surface)
    wide = lines.cells.count * lines.cells.factors[0]
    assert all(0 <= s <= 600 - wide for s in lines.starts)
    assert np.diff(sorted(lines.starts)).min() * 0.45e-6 >= 4 * 3.5e-6
    whole = lines.line(0, 1.0)
    assert whole.size[1] == pytest.approx(lines.available, rel=0.05)
    fx, fy = lines.cells.factors
    own = surface.heights[lines.starts[0] + fx // 2 : lines.starts[0] + wide : fx, fy // 2 :: fy]
    np.testing.assert_array_equal(whole.heights[:, 20:40], own[:, 20:40])


@pytest.mark.parametrize("width", [1, 2, 4])
def test_a_map_too_narrow_for_a_line_is_refused_by_its_width(tmp_path, width):
    np.save(tmp_path / "m.npy", np.random.default_rng(0).normal(0, 1e-8, (64, width)))
    surface = {"file": str(tmp_path / "m.npy"), "spacing": 1e-6}
    scene = lubfric.load_scene("paper").with_(surface=surface, contact={"shape": None, "spacing": None})
    with pytest.raises(lubfric.InputError, match=f"the map is {width} cells wide along y.*sampling = 'patch'"):
        lubfric.prepare(scene)
    assert lubfric.prepare(scene.with_(numerics={"sampling": "patch"})).surface.shape[1] >= width


def test_length_follows_the_square_of_the_error():
    assert next_length(1.0, 0.015, 0.01, 100.0) == pytest.approx(1.15 * 2.25 - 1)
    assert next_length(1.0, 0.1, 0.01, 100.0) == 3.0  # no further than four times at once
    assert next_length(1.0, 0.011, 0.01, 0.1) == 0.1
