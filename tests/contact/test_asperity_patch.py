"""Other contact models, other closures and Johnson's modulus, all through the same balance."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

import lubfric
from lubfric.contact import asperity_contact, asperity_curve, contact_curve, find_asperities
from lubfric.contact.asperities import AsperityContact
from lubfric.sharing import prepare

CYLINDER = (
    lubfric.load_scene("paper")
    .with_(numerics={"sampling": "patch"})
    .with_(
        contact={"shape": (96, 96), "spacing": 0.6e-6},
        surface={"correlation_length": 4e-6},
        numerics={"tolerance": 1e-3},
    )
)
FLAT = lubfric.load_scene("flat").with_(
    contact={"shape": (128, 128), "spacing": 8e-6},
    surface={"correlation_length": 40e-6, "acf": "gaussian"},
    numerics={"tolerance": 1e-3},
)
MODELS = ("summits", "patches")
RADIUS, E = 30e-6, 231e9


def one_ball(model, reading="volume"):
    """A single paraboloid, 0.5 um high, in the middle of a patch 24 um square."""
    x = (np.arange(121) - 60) * 0.2e-6
    z = np.maximum(0.5e-6 - (x[:, None] ** 2 + x**2) / (2 * RADIUS), 0.0)
    z -= z.mean()
    return AsperityContact(z, (0.2e-6, 0.2e-6), x, np.ones(x.size), E, 121 * 0.2e-6, None, model, reading, 1e-6)


@pytest.mark.parametrize("model", MODELS)
def test_one_asperity_is_hertz(model):
    patch, load = one_ball(model), 2e-3
    closure = patch.close(np.full(121, 0.5e-6), load)
    approach = (load / (2 / 3 * E * np.sqrt(RADIUS))) ** (2 / 3)
    # patches are counted in whole cells
    assert closure.real_contact_area_fraction == pytest.approx(
        np.pi * RADIUS * approach / (121 * 0.2e-6) ** 2, rel=0.1 if model == "patches" else 0.02
    )
    separation = patch.heights.max() - approach
    gap = np.maximum(separation - patch.heights, 0).mean()
    assert closure.mean_gap == pytest.approx(gap, abs=0.03 * approach)
    centre = closure.contact_fraction[60] * 121 * 0.2e-6
    assert centre == pytest.approx(2 * np.sqrt(RADIUS * approach), rel=0.07)  # chord through the middle


@pytest.mark.parametrize("reading", ["volume", "mean-plane"])
@pytest.mark.parametrize("model", MODELS)
def test_carry_is_the_inverse_of_close(model, reading):
    patch = prepare(CYLINDER.with_(contact={"model": model, "asperity_separation": reading})).contact
    shape = patch.x**2 / (2 * CYLINDER.bodies.radius)
    closure = patch.close(shape + 2e-7, 3.0)
    film = shape + 2e-7 + closure.mean_gap - closure.mean_film
    load, again = patch.carry(film)
    assert load == pytest.approx(3.0, rel=2e-2 if model == "patches" else 1e-3)  # patches jump where they join
    assert again.mean_gap == pytest.approx(again.mean_film, rel=1e-5)
    assert patch.carry(shape + 1e-5)[0] == 0


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("speed", [1e-3, 2e-2])
def test_both_closures_agree(model, speed):
    for scene in (CYLINDER, FLAT):
        if scene is FLAT and model == "patches" and speed < 1e-2:
            continue  # patches cannot carry this load
        scene = scene.with_(contact={"model": model})
        load = lubfric.friction(scene, speed)
        separation = lubfric.friction(scene.with_(numerics={"closure": "separation"}), speed)
        assert separation.coefficient == pytest.approx(load.coefficient, rel=1e-3)
        assert separation.film_load == pytest.approx(load.film_load, rel=5e-3)


@pytest.mark.parametrize("hardness", [None, 2e9])
@pytest.mark.parametrize("speed", [1e-4, 1e-3, 1e-2, 3e-2])
def test_the_papers_way_agrees_with_the_load_controlled_balance(speed, hardness):
    scene = CYLINDER.with_(bodies={"hardness": hardness}, numerics={"tolerance": 1e-4})
    load = lubfric.friction(scene, speed)
    paper = lubfric.friction(scene.with_(numerics={"closure": "separation"}), speed, fields=True)
    assert paper.coefficient == pytest.approx(load.coefficient, rel=3e-4)  # each solved to 1e-4
    assert paper.film_load == pytest.approx(
        load.film_load, rel=max(2e-3, load.errors.film_load)
    )  # 1e-3 of the load at 1e-4 m/s
    assert abs(paper.load_residual) <= 2 * scene.numerics.tolerances.balance and abs(paper.volume_residual) < 1e-4
    assert paper.balance.contact.fields.report.solver == "single loop, consistent"


def test_the_flat_contact_closes_both_ways():
    curves = [
        lubfric.stribeck(FLAT.with_(numerics={"closure": c}), np.geomspace(1e-3, 1, 5)) for c in ("load", "separation")
    ]
    assert np.allclose(curves[0].coefficient, curves[1].coefficient, rtol=1e-3)


@pytest.mark.parametrize("model", MODELS)
def test_the_curve_is_the_law(model):
    z = lubfric.generate_surface((128, 128), 2e-6, sq=2e-7, correlation_length=12e-6, acf="gaussian", seed=2).heights
    law = find_asperities(z, 2e-6, E, definition=model).at
    separation = 2.2e-7
    curve = asperity_curve(z, 2e-6, E, heaviest=law(separation).mean_pressure, definition=model, reading="volume")
    for level in (2.5e-7, 3.5e-7):
        there = law(level)
        gap, area, _ = curve.at(there.mean_pressure)
        assert gap == pytest.approx(np.maximum(level - z, 0).mean(), rel=0.08 if model == "patches" else 0.02)
        assert area == pytest.approx(there.contact_area_fraction, rel=0.2 if model == "patches" else 0.05)
    assert np.all(np.diff(curve.mean_pressure) < 0) and np.all(np.diff(curve.mean_gap) > 0)
    plane = asperity_curve(z, 2e-6, E, heaviest=1e6, definition=model, reading="mean-plane")
    assert plane.touching_gap == pytest.approx(z.max())


def test_a_film_carries_what_patches_cannot():
    """The contact carries less than the load, and the search for their balance begins above what it carries. One map,
    and two of them end to end; the contact's load by the asperities at the gap found."""
    scene = FLAT.with_(bodies={"load": 8.0}, contact={"shape": (64, 64), "model": "patches"})
    rough = lubfric.generate_surface((64, 64), 8e-6, sq=1e-7, correlation_length=24e-6, seed=3)
    found = []
    for repeats in (1, 2):
        surface = lubfric.Surface(np.tile(rough.heights, (1, repeats)), rough.spacing, periodic_axes=(True, True))
        model = prepare(scene.with_(contact={"shape": surface.shape}), surface)
        assert model.contact.capacity < 0.8 * scene.bodies.load
        found.append(lubfric.friction(model, 0.01))
    once, twice = found
    assert twice.coefficient == pytest.approx(once.coefficient, rel=2e-3)
    assert once.contact_load < 0.9 * model.contact.capacity and abs(once.volume_residual) < 1e-3
    at_that_gap = asperity_contact(
        rough.heights,
        rough.spacing,
        scene.bodies.e_prime,
        separation=separation_of(rough.heights, once.mean_gap),
        definition="patches",
    )
    assert at_that_gap.mean_pressure * model.contact.area == pytest.approx(once.contact_load, rel=0.03)


def separation_of(heights, gap):
    """Separation at which the mean of what is open is ``gap`` [m]."""
    return brentq(lambda s: np.maximum(s - heights, 0).mean() - gap, heights.min(), heights.max())


def test_a_load_that_patches_cannot_carry_is_an_error():
    heavy = FLAT.with_(bodies={"load": 500.0}, contact={"model": "patches"})
    with pytest.raises(lubfric.ConvergenceError, match="carries .* at most"):
        lubfric.friction(heavy, 0.0)


def test_pressure_at_is_the_inverse_of_the_curve():
    z = lubfric.generate_surface((64, 64), 2e-6, sq=2e-7, correlation_length=12e-6, acf="gaussian", seed=2).heights
    curve = contact_curve(z, 2e-6, E, heaviest=2e8)
    for pressure in (2e8, 3e7, 1e4, 1e2, 1.0):
        assert curve.pressure_at(curve.at(pressure)[0]) == pytest.approx(pressure, rel=1e-6)
    assert curve.pressure_at(1e-3) == 0 and curve.pressure_at(0.0) == 2e8


def test_johnsons_modulus_keeps_the_strip_and_changes_little_when_the_film_carries_all():
    scaled = CYLINDER.with_(numerics={"film_deflection": "scaled"})
    point = lubfric.friction(scaled, 1e-2, fields=True)
    film = point.balance.film
    assert film.half_width == pytest.approx(CYLINDER.bodies.half_width, rel=1e-12)
    assert film.e_prime == pytest.approx(CYLINDER.bodies.e_prime * point.film_load / CYLINDER.bodies.load, rel=1e-12)
    alone = lubfric.friction(CYLINDER, 1e-2)
    assert point.film_load > alone.film_load  # a flatter gap carries more
    full = [lubfric.friction(s, 1.0).coefficient for s in (scaled, CYLINDER)]
    assert full[0] == pytest.approx(full[1], rel=1e-9)
    both = lubfric.friction(scaled.with_(numerics={"closure": "separation"}), 1e-2)
    assert both.coefficient == pytest.approx(point.coefficient, rel=1e-3)


def test_the_scaled_film_does_not_deform_the_contact_twice():
    """The surface is pressed under the film's own share of the deflection; the contact adds the rest itself."""
    model = prepare(CYLINDER.with_(numerics={"film_deflection": "scaled"}))
    point = lubfric.friction(model, 1e-3, fields=True)
    contact, b = point.balance.contact.fields, CYLINDER.bodies
    dry = lubfric.friction(model, 0.0, fields=True).balance.contact.fields
    assert point.film_load < 0.05 * b.load
    assert contact.pressure.max() == pytest.approx(dry.pressure.max(), rel=0.05)
    assert point.mean_gap == pytest.approx(lubfric.friction(replace(model), 0.0).mean_gap, rel=0.03)


def test_oversize_cuts_the_middle_of_a_longer_map():
    scene = CYLINDER.with_(surface={"correlation_length": 30e-6, "oversize": 4})
    surface = prepare(scene).surface
    assert surface.heights.shape == (96, 192) and surface.sq == pytest.approx(100e-9, rel=1e-9)
    assert np.allclose(surface.heights, surface.heights[:, ::-1]) and "mirror" in " ".join(surface.notes)
    with pytest.raises(lubfric.InputError, match="correlation_length"):
        prepare(CYLINDER.with_(surface={"correlation_length": 30e-6}))


@pytest.mark.parametrize(
    "section,key,value",
    [
        ("contact", "model", "summit"),
        ("contact", "asperity_separation", "plane"),
        ("numerics", "closure", "film"),
        ("numerics", "film_deflection", "totel"),
        ("surface", "oversize", 0),
    ],
)
def test_bad_options(section, key, value):
    with pytest.raises(lubfric.InputError, match=f"{section}.{key}"):
        CYLINDER.with_(**{section: {key: value}})


@pytest.mark.parametrize("columns", [1, 2, 3])
def test_a_map_without_a_summit_is_refused_in_words(columns):
    ridges = 1e-7 * np.cos(2 * np.pi * 3 * np.arange(31) / 31)[:, None] * np.ones((1, columns))
    scene = CYLINDER.with_(contact={"model": "summits", "geometry": "flat", "shape": None, "spacing": None})
    with pytest.raises(lubfric.InputError, match="half-space"):
        prepare(scene, lubfric.Surface(ridges, 3e-6))


@pytest.mark.parametrize("model", MODELS)
def test_between_its_nodes_a_curve_is_as_sure_as_it_tells(model):
    """Gap and area of asperities pressed by hand, at separations between those of the nodes: four in five are within
    the errors told (the load of patches jumps where two join), which are small beside what is read."""
    scene = FLAT.with_(surface={"seed": 4})
    heights = prepare(scene).surface.heights
    heights = heights - heights.mean()
    curve = asperity_curve(heights, (8e-6, 8e-6), E, heaviest=3e8, definition=model, reading="volume")
    asperities = find_asperities(heights, (8e-6, 8e-6), E, definition=model)
    within, told = [], []
    for approach in np.ptp(heights) * np.linspace(0.03, 0.3, 40):
        flat = heights.max() - approach
        pressed, gap = asperities.at(flat), np.maximum(flat - heights, 0).mean()
        if not curve.mean_pressure[-1] < pressed.mean_pressure < curve.mean_pressure[0]:
            continue
        read = curve.at(pressed.mean_pressure)
        errors = curve.error_at(pressed.mean_pressure), curve.area_error_at(pressed.mean_pressure)
        within.append((abs(read[0] - gap) <= errors[0], abs(read[1] - pressed.contact_area_fraction) <= errors[1]))
        told.append((errors[0] / heights.std(), errors[1] / read[1]))
    assert len(within) > 20 and np.mean(within, axis=0).min() >= 0.8
    assert np.median(told, axis=0).max() < 0.05
