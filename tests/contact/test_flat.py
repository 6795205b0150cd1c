"""The nominally flat contact: the film's mean over the strip, and where it is said to touch."""

import math

import numpy as np
import pytest

import lubfric
from verification.hostile.soak_judge import verdict

SCENE = lubfric.load_scene("flat").with_(
    surface={"correlation_length": 1.7e-5},
    contact={"shape": (28, 28), "spacing": 7.142857e-6},
    numerics={"sampling": "patch", "grid": "given"},
)


@pytest.mark.parametrize("opens", [0.3, 1e-2, 1e-3])
def test_the_mean_of_a_film_that_opens_at_the_ends_of_the_strip(opens):
    """h = h0 + h1 exp(-(b - |x|)/l): its mean in closed form, down to ends of a thousandth of the strip."""
    contact = lubfric.prepare(SCENE).contact
    b = SCENE.bodies.half_width
    film = 1e-8 + 4e-7 * np.exp(-(b - np.abs(contact.x)) / (opens * b))
    mean = 1e-8 + 4e-7 * opens * (1 - math.exp(-1 / opens))
    state = contact.close(film, 0.5 * SCENE.bodies.load)
    assert state.mean_film == pytest.approx(mean, rel=2e-4)
    load, carried = contact.carry(film)
    assert carried.mean_gap == pytest.approx(mean, rel=2e-3) or load == pytest.approx(SCENE.bodies.load)


@pytest.mark.parametrize("share", [0.02, 0.3])
def test_a_film_that_opens_at_the_ends_carries_what_an_even_one_of_its_mean_does(share):
    """The mean in closed form is the gap under a known load, which has to come back."""
    contact, opens = lubfric.prepare(SCENE).contact, 0.05
    b, load = SCENE.bodies.half_width, share * SCENE.bodies.load
    gap = contact.close(np.zeros(contact.x.size), load).mean_gap
    rise = 0.5 * gap / (opens * (1 - math.exp(-1 / opens)))
    film = 0.5 * gap + rise * np.exp(-(b - np.abs(contact.x)) / (opens * b))
    carried, state = contact.carry(film)
    assert carried == pytest.approx(load, rel=1e-3) and state.mean_gap == pytest.approx(gap, rel=1e-4)


def test_it_touches_evenly_from_end_to_end_of_the_strip():
    contact = lubfric.prepare(SCENE).contact
    b = SCENE.bodies.half_width
    state = contact.close(np.full(contact.x.size, 1e-8), 0.5 * SCENE.bodies.load)
    x = np.array([-3, -2, -1, -0.5, 0, 0.7, 1, 1.5]) * b
    touching = state.real_contact_area_fraction
    assert state.touching(x) == pytest.approx(touching * np.array([0, 0, 1, 1, 1, 1, 0.0]), abs=1e-12)


@pytest.mark.parametrize("viscosity", [0.06, 0.3])
def test_a_soft_body_whose_film_opens_in_the_last_columns(viscosity):
    """A film of 8 nm on a strip of 7 mm: f was 6.5 % off, against the judge that closes the balance by another film."""
    scene = SCENE.with_(
        bodies={
            "radius": 0.0316,
            "width": 0.0108,
            "load": 2700.0,
            "e_prime": 1.63e9,
            "hardness": 6e7,
            "boundary_friction_coefficient": 0.0765,
        },
        lubricant={"viscosity": viscosity, "pressure_viscosity_coefficient": 2.3e-8, "eyring_stress": 5e6},
        motion={"entrainment_speed": 1.43e-4, "slide_roll_ratio": -0.14, "speeds": ()},
        surface={"sq": 2.66e-8, "correlation_length": 1.73e-5},
    )
    prepared = lubfric.prepare(scene)
    assert verdict(prepared, lubfric.friction(prepared))["friction"] < 0.3
