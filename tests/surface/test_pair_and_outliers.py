"""Two rough bodies as one map; outliers; a map longer than measured; what cannot be changed or scaled."""

import copy
import math
import pickle

import numpy as np
import pytest

from lubfric import InputError, Surface, generate_surface, load_scene, prepare
from lubfric.contact import half_space


def rough(seed, shape=(160, 120), spacing=1e-6, sq=1e-7):
    return generate_surface(shape, spacing, sq=sq, correlation_length=8e-6, acf="gaussian", seed=seed)


def open_map(surface):
    return Surface(surface.heights, surface.spacing)


def test_the_gap_of_two_facing_waves():
    """cos(ky) against cos(ky) shifted: the second runs backwards in y, so a sine changes its sign and a cosine does
    not."""
    x = np.arange(40)[:, None] * 1e-6
    y = (np.arange(60) - 29.5)[None, :] * 1e-6
    k = 2 * np.pi / 20e-6
    cosine = np.cos(k * (x + y)) * 1e-7
    sine = np.sin(k * (x + y)) * 1e-7
    result = Surface(cosine, 1e-6).combined(Surface(sine, 1e-6)).heights
    expected = np.cos(k * (x + y)) * 1e-7 + np.sin(k * (x - y)) * 1e-7
    np.testing.assert_allclose(result - result.mean(), expected - expected.mean(), atol=1e-20)


def test_maps_of_other_spacing_and_length_meet_on_the_finer_one_and_the_shorter_length():
    fine = open_map(rough(1))
    coarse = open_map(rough(2, (50, 100), 2e-6))
    both = coarse.combined(fine)
    assert both.spacing == fine.spacing and both.shape == (100, 120) and both.periodic_axes == (False, False)
    repeated = rough(3, (64, 120)).combined(fine)  # a periodic map is repeated along the open one
    assert repeated.shape == (160, 120) and repeated.periodic_axes == (False, False)
    with pytest.raises(InputError, match="second surface has unmeasured"):
        fine.combined(Surface(np.where(fine.heights > 0, fine.heights, np.nan), 1e-6, mask=fine.heights > 0))


def test_masks_of_both_are_kept():
    mask = np.ones((160, 120), bool)
    mask[3, 5] = False
    with_hole = Surface(rough(1).heights, 1e-6, mask=mask)
    assert np.argwhere(~open_map(rough(2)).combined(with_hole).mask).tolist() == [[3, 114]]


@pytest.mark.parametrize("acf, cells", [("gaussian", 8), ("exponential", 20), ("exponential", 2), ("gaussian", 2)])
def test_a_gaussian_map_has_no_outliers(acf, cells):
    surface = generate_surface((300, 300), 1e-6, sq=1e-7, correlation_length=cells * 1e-6, acf=acf, seed=4)
    assert surface.without_outliers().mask is None


def test_spikes_are_found_and_filled_and_resolved_features_stay():
    clean = open_map(rough(5, (200, 200)))
    heights = clean.heights.copy()
    radius = np.hypot(np.arange(200)[:, None] - 100, np.arange(200) - 45)
    heights += 5e-6 * np.maximum(1 - (radius / 12) ** 2, 0)  # a summit 24 points wide, 50 Sq high
    heights[150:156, :] -= 3e-6  # a groove
    resolved = Surface(heights, 1e-6)
    assert resolved.without_outliers().mask is None
    heights[20, 30] += 2e-6
    heights[70:72, 80:82] -= 2e-6
    result = Surface(heights, 1e-6).without_outliers()
    assert sorted(map(tuple, np.argwhere(~result.mask))) == [(20, 30), (70, 80), (70, 81), (71, 80), (71, 81)]
    assert np.isnan(result.heights[20, 30]) and "outliers masked: 5 " in result.notes[-1]
    assert np.abs(result.fill().heights[20, 30] - clean.heights[20, 30]) < 2e-7


def test_one_spike_on_a_flat_map_is_an_outlier():
    heights = np.zeros((30, 30))
    heights[7, 9] = 1e-6
    surface = Surface(heights, 1e-6)
    assert surface.largest_ratio == pytest.approx(math.sqrt(899), rel=1e-6)
    assert np.argwhere(~surface.without_outliers().mask).tolist() == [[7, 9]]
    assert "max |z|/Sq 30" in surface.describe()


def test_a_short_map_is_continued_by_its_mirror_image():
    surface = open_map(rough(6)).cropped((40, 32))
    longer = surface.continued(110e-6)
    assert longer.shape == (160, 32) and longer.periodic_axes == (True, False)
    np.testing.assert_array_equal(longer.heights[40:80], surface.heights[::-1])
    assert longer.sq == pytest.approx(surface.sq, rel=1e-12) and surface.continued(40e-6) is surface
    with pytest.raises(InputError, match="points"):
        surface.continued(1e3)


def test_a_constant_map_cannot_be_scaled_and_levels_to_zero():
    """Rounding is no roughness: neither of a constant nor of an exact plane."""
    x, y = np.meshgrid(np.arange(64), np.arange(48), indexing="ij")
    for heights in (np.full((64, 48), 0.1 + 0.2), 1e-3 + 0.3e-6 * x - 0.7e-6 * y, np.full((64, 48), 1e-9)):
        level = Surface(heights, 1e-6).level()
        assert level.sq == 0.0 and level.largest_ratio == 0.0
        with pytest.raises(InputError, match="flat"):
            level.scaled(sq=1e-7)
    with pytest.raises(InputError, match="flat"):
        Surface(np.full((64, 48), 0.1), 1e-6).scaled(sq=1e-7)


def test_nothing_is_writable_after_copies_and_pickles():
    surface = rough(1)
    hole = Surface(surface.heights, 1e-6, mask=surface.heights > -2e-7)
    operator = half_space((8, 8), 1e-6, 1e11)
    for thing in (surface, hole, operator):
        for twin in (thing, copy.copy(thing), copy.deepcopy(thing), pickle.loads(pickle.dumps(thing))):
            arrays = [v for v in vars(twin).values() if isinstance(v, np.ndarray)]
            assert arrays
            for array in arrays:
                with pytest.raises(ValueError, match="read-only"):
                    array[0, 0] = 1


def test_masked_arrays_keep_their_mask():
    z = np.ma.array(np.arange(12.0).reshape(3, 4) * 1e-9, mask=np.arange(12).reshape(3, 4) == 5)
    surface = Surface(z, 1e-6)
    assert np.argwhere(~surface.mask).tolist() == [[1, 1]] and np.isnan(surface.heights[1, 1])
    both = Surface(z, 1e-6, mask=np.arange(12).reshape(3, 4) != 7)
    assert np.count_nonzero(~both.mask) == 2
    for mask in (np.ones((3, 4)), [["False"] * 4] * 3, np.ones((4, 3), bool), np.zeros((3, 4), bool)):
        with pytest.raises(InputError, match="mask"):
            Surface(z.data, 1e-6, mask=mask)
    for axes in ("no", (1, 0), (True,), None):
        with pytest.raises(InputError, match="periodic_axes"):
            Surface(z.data, 1e-6, periodic_axes=axes)
    with pytest.raises(InputError, match="1000"):
        Surface(np.full((2, 2), 1e5), 1e-6)


def test_the_shorter_of_two_maps_is_named(tmp_path):
    np.save(tmp_path / "long.npy", rough(1, shape=(256, 64)).heights)
    np.save(tmp_path / "short.npy", rough(2, shape=(40, 64)).heights)
    scene = load_scene("paper").with_(
        bodies={"radius": 5e-3, "load": 600.0, "width": 14e-3},
        surface={
            "file": str(tmp_path / "long.npy"),
            "spacing": 1e-6,
            "sq": None,
            "correlation_length": None,
            "acf": None,
        },
        counterface={"file": str(tmp_path / "short.npy"), "spacing": 1e-6},
        contact={"shape": None, "spacing": None},
        numerics={"model": "paper", "sampling": "patch"},
    )
    with pytest.raises(InputError, match=r"map of the counterface \(.*short.npy\) is 40 µm.*counterface.extension"):
        prepare(scene)


def test_maps_of_very_different_cells_are_cut_before_they_are_resampled():
    """A map of 2 mm on cells of 4 µm against one of 51 µm on cells of 0.1 µm: on these the first had 4e8 points."""
    fine = Surface(1e-7 * np.random.default_rng(2).standard_normal((510, 510)), 1e-7)
    x = (np.arange(500) - 249.5) * 4e-6
    coarse = Surface(1e-3 * x[:, None] + np.zeros(500), 4e-6)
    both = coarse.combined(fine)
    assert both.shape == (510, 510) and both.spacing == (1e-7, 1e-7)
    slope = both.heights - (fine.heights - fine.heights.mean())[:, ::-1]
    np.testing.assert_allclose(slope, 1e-3 * (np.arange(510) - 254.5)[:, None] * 1e-7 + np.zeros(510), atol=1e-15)


def test_a_sum_that_is_too_large_names_the_map_and_what_to_do():
    across = Surface(1e-9 * np.arange(2)[:, None] + np.zeros(9_000), (5e-4, 1e-7), source="wide.sur")
    along = Surface(1e-9 * np.arange(2) + np.zeros((9_000, 2)), (1e-7, 5e-4), source="long.sur")
    with pytest.raises(
        InputError, match="10000 x 9000 points of wide.sur .*allowed: up to 6.71e.07 points; .*resampled"
    ):
        across.combined(along)


def test_filled_points_are_no_outliers():
    """A map that was filled before has its spike counted, and none of the points that were never measured."""
    heights = open_map(rough(5, (80, 80))).heights.copy()
    heights[40, 40] = 3e-6
    heights[5:9, 5:30] = np.nan
    filled = Surface(heights, 1e-6, mask=np.isfinite(heights)).fill()
    assert "outliers masked: 1 (" in " ".join(filled.without_outliers().notes)


def test_rz_is_stated_where_a_sampling_length_has_enough_points():
    """Of a map of 2 nm, on cells of 50 µm, a sampling length of 80 µm has two points: Rz was smaller than Ra."""
    z = 2e-9 * np.random.default_rng(1).standard_normal((60, 60))
    assert "Rz not known (the spacing is too long for a sampling length of 0.08 mm)" in Surface(z, 5e-5).describe()
    fine = Surface(z, 1e-6).describe()
    assert "Rz not known" not in fine and "Ssk " in fine and f"Ra {np.abs(z - z.mean()).mean() * 1e9:.4g} nm" in fine
