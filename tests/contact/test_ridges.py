"""Asperities without ends: f then depends on how long the map is, and a warning tells."""

import numpy as np
import pytest
from scipy import ndimage

import lubfric
from lubfric.contact import ridges
from lubfric.models.shared import violations_by_patches

FLAT = lubfric.load_scene("flat").with_(
    contact={"shape": (64, 64), "spacing": 8e-6, "model": "patches"},
    surface={"sq": 1e-7, "correlation_length": 24e-6, "acf": "gaussian", "seed": 3},
    numerics={"tolerance": 3e-3},
)
N = 48


def ridge(slope=0, axis=1):
    """A ridge that rises by ``slope`` of its period over one period along ``axis``."""
    i, j = np.indices((N, N))
    z = np.cos(2 * np.pi * (i - slope * j) / N)
    return z if axis == 1 else z.T


@pytest.mark.parametrize("periodic", [(True, True), (False, True), (True, False), (False, False)])
def test_a_patch_without_ends_holds_the_same_cell_of_two_periods(periodic):
    """Random small maps, laid side by side nine times along every periodic axis, and filled from cell to cell."""
    rng = np.random.default_rng(8)
    result = []
    copies = [9 if axis else 1 for axis in periodic]
    for _ in range(60):
        heights = rng.random(rng.integers(2, 8, 2))
        bearing = rng.uniform(0.1, 0.5)
        touching = heights > np.quantile(heights, 1 - bearing)
        label, _ = ndimage.label(np.tile(touching, copies), np.ones((3, 3)))
        (nx, ny) = heights.shape
        (a, b) = copies
        by_period = label.reshape(a, nx, b, ny).swapaxes(1, 2).reshape(a * b, nx * ny)
        middle = by_period[a // 2 * b + b // 2]
        again = np.count_nonzero((by_period == middle) & (middle > 0), axis=0) > 1
        result.append((ridges(heights, bearing, periodic) > 0, bool(again.any())))
    assert all(one == other for one, other in result)
    assert not any(periodic) or 4 < sum(one for one, _ in result) < 56


@pytest.mark.parametrize(
    "geometry, axis, reaches_round",
    [("flat", 0, True), ("flat", 1, True), ("cylinder", 0, False), ("cylinder", 1, True)],
)
def test_a_map_under_a_cylinder_repeats_along_the_cylinder_only(geometry, axis, reaches_round):
    scene = FLAT.with_(contact={"geometry": geometry})
    crest_in_the_middle = np.roll(ridge(axis=axis), N // 2, (0, 1))
    assert [entry.value for entry in violations_by_patches(scene, crest_in_the_middle, 0.05)] == [1.0] * reaches_round
    for model in ("summits", "half-space"):
        assert not list(violations_by_patches(scene.with_(contact={"model": model}), crest_in_the_middle, 0.05))


def told(result):
    return any("extend across the whole map" in entry.what for entry in result.validity)


ROUND = lubfric.generate_surface((64, 64), 8e-6, sq=1e-7, correlation_length=24e-6, seed=3).heights
WAVY = 1.5e-7 * np.cos(2 * np.pi * np.indices((64, 64))[0] / 32)


def of(heights, speed, model="patches"):
    """Friction of the flat scene on ``heights`` [m], and on two of them, end to end."""
    result = []
    for repeats in (1, 2):
        surface = lubfric.Surface(np.tile(heights, (1, repeats)), (8e-6, 8e-6), periodic_axes=(True, True))
        scene = FLAT.with_(contact={"shape": surface.shape, "model": model})
        result.append(lubfric.friction(lubfric.prepare(scene, surface), speed))
    return result


@pytest.mark.parametrize("heights, speed", [(ROUND, 0.03), (WAVY + 0.1 * ROUND, 0.03)])
def test_no_warning_where_the_map_may_be_repeated(heights, speed):
    once, twice = of(heights, speed)
    assert not told(once) and not told(twice)
    assert twice.coefficient == pytest.approx(once.coefficient, rel=5e-4)


@pytest.mark.parametrize("noise, speed", [(0.1, 0.02), (0.02, 0.03)])
def test_a_warning_where_f_depends_on_how_long_the_map_is(noise, speed):
    once, twice = of(WAVY + noise * ROUND, speed)
    assert told(once) and told(twice)
    assert twice.contact_load < 0.8 * once.contact_load


def test_a_half_space_is_not_reported_and_may_be_repeated():
    once, twice = of(WAVY + 0.1 * ROUND, 0.02, "half-space")
    assert not told(once) and once.contact_load > 0
    assert twice.coefficient == pytest.approx(once.coefficient, rel=3e-3)
