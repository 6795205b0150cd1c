"""Names that keys and keywords had before still lead to the same numbers, and never beside those of today."""

import pytest

import lubfric
from lubfric.errors import InputError

CONTACT = {
    "load_per_width": 1e5,
    "radius": 0.01,
    "e_prime": 2.2e11,
    "entrainment_speed": 1.0,
    "viscosity": 0.04,
    "pressure_viscosity_coefficient": 2e-8,
}


def test_density_of_a_film_is_density_law():
    today = lubfric.solve_ehl(**CONTACT, density_law="dowson-higginson")
    before = lubfric.solve_ehl(**CONTACT, density="dowson-higginson")
    assert before.min_film == today.min_film != lubfric.solve_ehl(**CONTACT).min_film
    with pytest.raises(InputError, match="density and density_law say the same"):
        lubfric.solve_ehl(**CONTACT, density="constant", density_law="constant")


def test_ehl_tolerance_of_a_scene_is_film_tolerance():
    scene = lubfric.load_scene("paper")
    before = scene.with_(numerics={"ehl_tolerance": 2e-4})
    assert before == scene.with_(numerics={"film_tolerance": 2e-4}) and before.numerics.tolerances.film == 2e-4
    with pytest.raises(InputError, match="ehl_tolerance and film_tolerance"):
        scene.with_(numerics={"ehl_tolerance": 2e-4, "film_tolerance": 2e-4})


@pytest.mark.parametrize(("before", "today"), [("Patch", "ContactDomain"), ("Model", "Prepared")])
def test_a_class_by_its_old_name_leads_to_that_of_today(before, today):
    with pytest.raises(AttributeError, match=today):
        getattr(lubfric, before)
