"""Plateau-honed surfaces: their Sk, Spk, Svk, the direction of their grooves, and their way through a scene."""

import tomllib

import numpy as np
import pytest

import lubfric
from lubfric import InputError, generate_surface

TARGETS = [(600e-9, 200e-9, 1200e-9), (300e-9, 60e-9, 900e-9), (500e-9, 300e-9, 500e-9)]


def honed(targets=TARGETS[0], seed=1, shape=(256, 256), **more):
    sk, spk, svk = targets
    options = {"correlation_length": 8e-6, "groove_width": 20e-6, "honing_angle": 50.0} | more
    return generate_surface(shape, 2e-6, sk=sk, spk=spk, svk=svk, seed=seed, **options)


@pytest.mark.parametrize("targets", TARGETS)
def test_it_has_the_parameters_requested(targets):
    for seed in (1, 2):
        surface = honed(targets, seed)
        np.testing.assert_allclose((surface.sk, surface.spk, surface.svk), targets, rtol=3e-3)
        assert surface.ssk < -0.5 and surface.periodic_axes == (True, True)
    assert np.array_equal(honed(targets, 2).heights, surface.heights)
    assert not np.array_equal(honed(targets, 3).heights, surface.heights)


@pytest.mark.parametrize("angle", [0.0, 40.0, 90.0, 140.0])
def test_its_grooves_cross_at_the_honing_angle(angle):
    """The power of the deep part lies across the grooves: at ± half the angle from the x axis, in wave vectors."""
    surface = honed(honing_angle=angle, shape=(512, 512))
    deep = np.minimum(surface.heights - np.quantile(surface.heights, 0.15), 0.0)
    power = np.abs(np.fft.fft2(deep - deep.mean())) ** 2
    kx, ky = np.meshgrid(np.fft.fftfreq(512), np.fft.fftfreq(512), indexing="ij")
    long = (np.hypot(kx, ky) > 0) & (np.hypot(kx, ky) < 0.06)
    off = np.degrees(np.arctan2(np.abs(ky), np.abs(kx)))[long]
    mean = np.average(off, weights=power[long])
    assert mean == pytest.approx(angle / 2, abs=11.0)  # of few grooves


def test_wide_grooves_are_wide():
    widths = [10e-6, 40e-6]
    lengths = []
    for width in widths:
        surface = honed(groove_width=width, honing_angle=0.0, shape=(512, 256))
        lengths.append(lubfric.surface.correlation_length(surface, 0))
    assert 2.0 < lengths[1] / lengths[0] < 5.0


SCENE = lubfric.load_scene("paper").with_(
    surface={"sq": None, "sk": "300 nm", "spk": 6e-8, "svk": 9e-7, "correlation_length": 8e-6, "honing_angle": 60},
    motion={"entrainment_speed": 0.05},
    numerics={"model": "paper", "tolerance": 0.05},
)


def test_a_scene_has_it():
    rough = SCENE.surface
    assert (rough.sk, rough.spk, rough.svk, rough.honing_angle) == (3e-7, 6e-8, 9e-7, 60.0)
    made = lubfric.generate_surface(
        (256, 256), 2e-6, sk=3e-7, spk=6e-8, svk=9e-7, correlation_length=8e-6, groove_width=20e-6, seed=4
    )
    assert rough.sq == pytest.approx(made.sq, rel=0.12)
    again = lubfric.load_scene(tomllib.loads(SCENE.to_toml()))
    assert again.surface == rough
    smoother = SCENE.with_(surface={"svk": 3e-7})
    assert smoother.surface.sq < 0.8 * rough.sq
    patch = SCENE.with_(numerics={"sampling": "patch"}, surface={"groove_width": 10e-6})
    surface = lubfric.prepare(patch).surface
    np.testing.assert_allclose((surface.sk, surface.spk, surface.svk), (3e-7, 6e-8, 9e-7), rtol=3e-3)
    gaussian = SCENE.with_(surface={"sk": None, "spk": None, "svk": None, "honing_angle": None})
    assert gaussian.surface.sk is None and gaussian.surface.sq == rough.sq


@pytest.mark.parametrize(
    "key, value", [("sk", 5e-7), ("spk", 2e-7), ("svk", 3e-7), ("honing_angle", 100), ("groove_width", 12e-6)]
)
def test_every_key_moves_the_number(key, value):
    patch = SCENE.with_(numerics={"sampling": "patch"})
    old, new = (lubfric.friction(scene).coefficient for scene in (patch, patch.with_(surface={key: value})))
    assert abs(new / old - 1) > 1e-3


@pytest.mark.slow
def test_plateaus_rub_less_than_a_gaussian_surface_of_the_same_sq():
    strips = lubfric.friction(SCENE)
    gaussian = SCENE.with_(surface={"sk": None, "spk": None, "svk": None, "honing_angle": None})
    assert strips.contact_load < 0.9 * lubfric.friction(gaussian).contact_load


@pytest.mark.parametrize(
    "changes, said",
    [
        ({"svk": None}, "give sk, spk and svk"),
        ({"sq": 1e-7}, "surface.sq"),
        ({"sk": -1e-7}, "surface.sk"),
        ({"honing_angle": 200}, "honing_angle"),
        ({"sk": None, "spk": None, "svk": None}, "honing_angle"),
    ],
)
def test_keys_that_do_not_go_together(changes, said):
    with pytest.raises(InputError, match=said):
        SCENE.with_(surface=changes)


def test_a_map_that_cannot_have_it():
    with pytest.raises(InputError, match="groove_width"):
        honed(groove_width=3e-6)
    with pytest.raises(InputError, match="groove_width"):
        honed(groove_width=200e-6)
    with pytest.raises(InputError, match="groove_width"):
        generate_surface((64, 64), 1e-6, sq=1e-7, correlation_length=4e-6, groove_width=1e-5, seed=0)
