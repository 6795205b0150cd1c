"""A temperature coefficient that is given beside an oil is the one that is used."""

import pytest

import lubfric

OIL = {"nu40": 68e-6, "nu100": 8.4e-6, "eyring_stress": 5e6, "temperature_celsius": 70}
HOT = {"bodies": {"load": 200.0}, "motion": {"slide_roll_ratio": 0.5}, "numerics": {"sampling": "patch"}}


def lubricant(**given):
    return lubfric.load_scene("paper").with_(lubricant=OIL | given).lubricant


def test_it_is_kept_through_changes_of_the_oil():
    assert lubricant().temperature_coefficient == pytest.approx(0.0345, rel=0.01)
    scene = lubfric.load_scene("paper").with_(lubricant=OIL | {"temperature_coefficient": 0.02})
    changes = ({"temperature_celsius": 60}, {"density": 900}, {"base": "pao"}, {"nu40": 60e-6, "nu100": 8e-6})
    for changed in ({}, *changes):
        assert scene.with_(lubricant=changed).lubricant.temperature_coefficient == 0.02
    assert scene.with_(lubricant={"temperature_coefficient": 0.04}).lubricant.temperature_coefficient == 0.04


def test_that_of_the_oil_follows_its_temperature():
    scene = lubfric.load_scene("paper").with_(lubricant=OIL)
    moved = scene.with_(lubricant={"temperature_celsius": 60}).lubricant
    assert moved.temperature_coefficient == lubricant(temperature_celsius=60).temperature_coefficient


def test_it_reaches_the_friction_of_a_hot_film():
    base = lubfric.load_scene("paper").with_(**HOT)
    beside = base.with_(lubricant=OIL | {"temperature_coefficient": 0.01})
    plain = lubricant()
    numbers = {
        "viscosity": plain.viscosity,
        "pressure_viscosity_coefficient": plain.pressure_viscosity_coefficient,
        "temperature": plain.temperature,
        "conductivity": plain.conductivity,
        "temperature_coefficient": 0.01,
        "eyring_stress": 5e6,
    }
    f, of_numbers = (lubfric.friction(s, 5.0).coefficient for s in (beside, base.with_(lubricant=numbers)))
    assert f == pytest.approx(of_numbers, rel=1e-12)
    assert f > 1.05 * lubfric.friction(base.with_(lubricant=OIL), 5.0).coefficient


def test_a_conductivity_given_later_is_kept_as_well():
    scene = lubfric.load_scene("paper").with_(lubricant=OIL).with_(lubricant={"conductivity": 0.2})
    for changed in ({}, {"temperature_celsius": 60}, {"density": 900}):
        assert scene.with_(lubricant=changed).lubricant.conductivity == 0.2
