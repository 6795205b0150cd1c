"""Independent asperities through the same balance as a half-space, and the curves they are read from."""

import numpy as np
import pytest
from scene_text import paper_scene
from scipy.optimize import brentq

import lubfric
from lubfric.contact import asperity_contact, asperity_curve, find_asperities
from lubfric.models import prepare

CYLINDER = paper_scene(
    contact={"shape": (96, 96), "spacing": 0.6e-6},
    surface={"correlation_length": 4e-6},
    numerics={"sampling": "patch", "tolerance": 1e-3},
)
FLAT = lubfric.load_scene("flat").with_(
    contact={"shape": (128, 128), "spacing": 8e-6},
    surface={"correlation_length": 40e-6, "acf": "gaussian"},
    numerics={"tolerance": 1e-3},
)
MODELS = ("summits", "patches")
RADIUS = 30e-6
E = 231e9


@pytest.mark.parametrize("reading", ["volume", "mean-plane"])
@pytest.mark.parametrize("model", MODELS)
def test_both_balances_recomputed_from_the_asperities(model, reading):
    """Of the offset at which the public model carries F_C, the film leaves the gap that the result tells."""
    scene = CYLINDER.with_(contact={"model": model, "asperity_separation": reading})
    prepared = prepare(scene)
    point = lubfric.friction(prepared, 0.01)
    contact = prepared.rough_contact
    film = point.balance.film.film_at(prepared.rough_contact.x)

    def carried(offset):
        result = asperity_contact(
            contact.heights,
            contact.spacing,
            E,
            separation=np.broadcast_to((film - offset)[:, None], contact.heights.shape),
            definition=model,
            periodic=(False, True),
            hardness=scene.bodies.hardness,
        )
        return result.mean_pressure * contact.x.size * contact.spacing[0] * scene.bodies.width

    offset = brentq(lambda o: carried(o) - point.contact_load, 0 if reading == "volume" else -1e-6, 5e-7, xtol=1e-13)
    gap = film[:, None] - offset - contact.heights
    gap = np.maximum(gap, 0.0) if reading == "volume" else gap
    mean = (contact.weight @ gap.mean(axis=1)) / contact.weight.sum()
    assert mean == pytest.approx(contact.weight @ film / contact.weight.sum(), rel=2e-3)
    assert point.contact_load + point.film_load == pytest.approx(scene.bodies.load, rel=1e-12)


def test_a_film_carries_what_patches_cannot():
    """The contact carries less than the load, and the search for their balance begins above what it carries. One map,
    and two of them end to end; the contact's load by the asperities at the gap found."""
    scene = FLAT.with_(bodies={"load": 8.0}, contact={"shape": (64, 64), "model": "patches"})
    rough = lubfric.generate_surface((64, 64), 8e-6, sq=1e-7, correlation_length=24e-6, seed=3)
    result = []
    for repeats in (1, 2):
        surface = lubfric.Surface(np.tile(rough.heights, (1, repeats)), rough.spacing, periodic_axes=(True, True))
        model = prepare(scene.with_(contact={"shape": surface.shape}), surface)
        assert model.rough_contact.capacity < 0.8 * scene.bodies.load
        result.append(lubfric.friction(model, 0.01))
    once, twice = result
    assert twice.coefficient == pytest.approx(once.coefficient, rel=2e-3)
    assert once.contact_load < 0.9 * model.rough_contact.capacity and abs(once.volume_residual) < 1e-3
    at_that_gap = asperity_contact(
        rough.heights,
        rough.spacing,
        scene.bodies.e_prime,
        separation=separation_of(rough.heights, once.mean_gap),
        definition="patches",
    )
    assert at_that_gap.mean_pressure * model.rough_contact.area == pytest.approx(once.contact_load, rel=0.03)


def separation_of(heights, gap):
    """Separation at which the mean of what is open is ``gap`` [m]."""
    return brentq(lambda s: np.maximum(s - heights, 0).mean() - gap, heights.min(), heights.max())


def test_a_load_that_patches_cannot_carry_is_an_error():
    heavy = FLAT.with_(bodies={"load": 500.0}, contact={"model": "patches"})
    with pytest.raises(lubfric.ConvergenceError, match="carries .* at most"):
        lubfric.friction(heavy, 0.0)


def test_oversize_cuts_the_middle_of_a_longer_map():
    scene = CYLINDER.with_(surface={"correlation_length": 30e-6, "oversize": 4})
    surface = prepare(scene).surface
    assert surface.heights.shape == (96, 192) and surface.sq == pytest.approx(100e-9, rel=1e-9)
    assert np.allclose(surface.heights, surface.heights[:, ::-1]) and "mirror" in " ".join(surface.notes)
    with pytest.raises(lubfric.InputError, match="correlation_length"):
        prepare(CYLINDER.with_(surface={"correlation_length": 30e-6}))


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
    within = []
    stated = []
    for approach in np.ptp(heights) * np.linspace(0.03, 0.3, 40):
        flat = heights.max() - approach
        pressed = asperities(flat)
        gap = np.maximum(flat - heights, 0).mean()
        if not curve.mean_pressure[-1] < pressed.mean_pressure < curve.mean_pressure[0]:
            continue
        read = curve.at(pressed.mean_pressure)
        errors = curve.errors_at(pressed.mean_pressure)
        within.append((abs(read[0] - gap) <= errors[0], abs(read[1] - pressed.contact_area_fraction) <= errors[1]))
        stated.append((errors[0] / heights.std(), errors[1] / read[1]))
    assert len(within) > 20 and np.mean(within, axis=0).min() >= 0.8
    assert np.median(stated, axis=0).max() < 0.05
