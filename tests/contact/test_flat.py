"""The nominally flat contact: the film's mean over the strip, and where it is said to touch."""

import math

import numpy as np
import pytest

import lubfric

SCENE = lubfric.load_scene("flat").with_(
    surface={"correlation_length": 1.7e-5},
    contact={"shape": (28, 28), "spacing": 7.142857e-6},
    numerics={"sampling": "patch", "grid": "given"},
)


@pytest.mark.parametrize("opens", [0.3, 1e-2, 1e-3])
def test_the_mean_of_a_film_that_opens_at_the_ends_of_the_strip(opens):
    """h = h0 + h1 exp(-(b - |x|)/l): its mean in closed form, down to ends of a thousandth of the strip."""
    contact = lubfric.prepare(SCENE).rough_contact
    b = SCENE.bodies.half_width
    film = 1e-8 + 4e-7 * np.exp(-(b - np.abs(contact.x)) / (opens * b))
    mean = 1e-8 + 4e-7 * opens * (1 - math.exp(-1 / opens))
    state = contact.close(film, 0.5 * SCENE.bodies.load)
    assert state.mean_film == pytest.approx(mean, rel=2e-4)


def test_it_touches_evenly_from_end_to_end_of_the_strip():
    contact = lubfric.prepare(SCENE).rough_contact
    b = SCENE.bodies.half_width
    state = contact.close(np.full(contact.x.size, 1e-8), 0.5 * SCENE.bodies.load)
    x = np.array([-3, -2, -1, -0.5, 0, 0.7, 1, 1.5]) * b
    touching = state.real_contact_area_fraction
    assert state.touching(x) == pytest.approx(touching * np.array([0, 0, 1, 1, 1, 1, 0.0]), abs=1e-12)


@pytest.fixture(scope="module")
def flat():
    return lubfric.prepare(lubfric.load_scene("flat").with_(contact={"shape": (128, 128), "spacing": 8e-6}))


def test_it_ends_in_boundary_lubrication_and_in_a_full_film(flat):
    assert lubfric.friction(flat, 0.0).coefficient == pytest.approx(0.09)
    assert lubfric.friction(flat, 10.0).contact_load == 0
    loads = [lubfric.friction(flat, u).contact_load for u in np.geomspace(1e-4, 1, 8)]
    assert np.all(np.diff(loads) < 0) or loads[-1] == 0


@pytest.mark.parametrize("viscosity", [0.06, 0.3])
def test_a_soft_body_whose_film_opens_in_the_last_columns(viscosity):
    """A film of 8 nm on a strip of 7 mm: with a mean over even columns f was 6.5 % off. The film is averaged anew,
    densely, and its gap is that of the curve at the load found."""
    scene = SCENE.with_(
        bodies={"radius": 0.0316, "width": 0.0108, "load": 2700.0, "e_prime": 1.63e9, "hardness": 6e7}
        | {"boundary_friction_coefficient": 0.0765},
        lubricant={"viscosity": viscosity, "pressure_viscosity_coefficient": 2.3e-8, "eyring_stress": 5e6},
        motion={"entrainment_speed": 1.43e-4, "slide_roll_ratio": -0.14, "speeds": ()},
        surface={"sq": 2.66e-8, "correlation_length": 1.73e-5},
    )
    prepared = lubfric.prepare(scene)
    point = lubfric.friction(prepared, tolerance=1e-3)
    b = scene.bodies.half_width
    angle = np.linspace(0, np.pi, 20001)
    film = np.trapezoid(point.balance.film.film_at(-b * np.cos(angle)) * np.sin(angle), angle) / 2
    gap = prepared.rough_contact.curve.at(point.contact_load / prepared.rough_contact.area)[0]
    assert gap == pytest.approx(film, rel=5e-3)
