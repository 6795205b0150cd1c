"""Heat of an operating point: against the isothermal point, the standalone solve, and a film solved
hotter."""

import re

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.film import Surroundings, heated_film

OIL = {"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 70, "density": 870}
SHEAR = {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.08}
BASE = paper_scene(
    bodies={"radius": 0.01, "hertz_pressure": 0.9e9, "width": 0.01, "e_prime": 2.27e11},
    lubricant=OIL | SHEAR,
    contact={"shape": (128, 64), "spacing": 4e-6},
    surface={"sq": 5e-8, "correlation_length": 3e-5, "acf": "gaussian"},
    numerics={"sampling": "patch"},
)


@pytest.fixture(scope="module")
def model():
    return lubfric.prepare(BASE)


def at(model, speed, ratio=2.0, **sections):
    numerics = {"heat": "auto"} | sections.pop("numerics", {})
    scene = BASE.with_(motion={"slide_roll_ratio": ratio}, numerics=numerics, **sections)
    return lubfric.friction(lubfric.prepare(scene, like=model), speed)


def test_switched_off_it_is_the_point_of_the_plain_numbers(model):
    lubricant = BASE.lubricant
    plain = {
        "viscosity": lubricant.viscosity,
        "pressure_viscosity_coefficient": lubricant.pressure_viscosity_coefficient,
    }
    numbers = BASE.with_(lubricant=plain).with_(lubricant={"temperature": None, "temperature_coefficient": None})
    off = at(model, 1.0, numerics={"heat": "off"})
    assert off.coefficient == lubfric.friction(lubfric.prepare(numbers, like=model), 1.0).coefficient
    for name in ("inlet_film_factor", "flash_temperature_rise", "film_temperature_rise"):
        assert np.isnan(getattr(off, name)) and off.errors.reasons[name] == "not computed: numerics.heat = 'off'"
    assert "is not given" in lubfric.friction(numbers, 1.0).errors.reasons["flash_temperature_rise"]
    assert off.decision.heat_in_words == ""


@pytest.mark.parametrize("speed, ratio", [(1.0, 0.3), (0.05, 2.0)])
def test_friction_is_that_of_the_standalone_solve(model, speed, ratio):
    result = at(model, speed, ratio, numerics={"heat": "on"})
    film = result.balance.film
    contact = result.balance.contact_state
    bodies = BASE.bodies
    share = 1 - contact.touching(film.x)
    share = np.where(film.x[:-1] < film.rupture, share, 0)
    wet = 0.5 * (np.append(share[:1], share) + np.append(share, share[-1:]))
    b = bodies.half_width
    contacts = 2 * result.contact_load / (np.pi * b * bodies.width) * np.sqrt(np.maximum(1 - (film.x / b) ** 2, 0))
    carried = sum(e * np.sqrt(speed * abs(1 + s * ratio / 2)) for e, s in zip(bodies.effusivity, (-1, 1)))
    around = Surroundings(carried, ratio * speed, wet, 0.09 * contacts * ratio * speed)
    heated = heated_film(BASE.lubricant, film.x, film.pressure, film.film_thickness, around)
    couette = bodies.width * np.trapezoid(wet * heated.stress, film.x)
    assert result.couette_force == pytest.approx(couette, rel=3e-3)
    assert result.flash_temperature_rise == pytest.approx(heated.flash, rel=1e-6)
    assert f"surfaces up to {heated.flash:.2g} K and film " in result.decision.heat_in_words
    assert result.coefficient < at(model, speed, ratio, numerics={"heat": "off"}).coefficient


def test_the_film_is_thinner_by_the_inlet_factor(model):
    """The film of the heated inlet comes from a solve with another viscosity; Moes' exponent and the solve's agree to 1
    %."""
    on = at(model, 5.0, 0.1)
    off = at(model, 5.0, 0.1, numerics={"heat": "off"})
    assert on.inlet_film_factor < 0.95
    assert on.central_film / off.central_film == pytest.approx(on.inlet_film_factor, rel=0.01)


def test_what_is_omitted_is_part_of_the_numerical_error(model):
    auto = at(model, 0.3, 0.01)
    on = at(model, 0.3, 0.01, numerics={"heat": "on"})
    omitted = "heat within the contact: neglected"
    assert omitted in auto.decision.heat_in_words and omitted not in on.decision.heat_in_words
    assert max(on.flash_temperature_rise, on.film_temperature_rise) < 0.1  # K, of which no digit is stated
    assert "(surfaces less than 0.1 K and film less than 0.1 K warmer)" in on.decision.heat_in_words
    assert auto.uncertainty.numerical >= abs(on.coefficient / auto.coefficient - 1) > 1e-3
    for name in ("shear_force", "couette_force"):
        assert getattr(auto.errors, name) >= abs(getattr(on, name) / getattr(auto, name) - 1), name
    for name in ("flash_temperature_rise", "film_temperature_rise"):  # none was computed: nothing is known of its error
        assert np.isnan(getattr(auto, name)) and "less than the tolerance" in auto.errors.reasons[name]
        assert getattr(on, name) > 0 and 0 < getattr(on.errors, name) < 0.1


def test_the_temperatures_do_not_depend_on_which_surface_is_the_faster_one(model):
    """Of two bodies of one material: both surfaces are as hot, and the film has one temperature."""
    ahead, behind = (at(model, 1.0, ratio=ratio) for ratio in (0.4, -0.4))
    for name in ("film_temperature_rise", "flash_temperature_rise", "inlet_film_factor"):
        assert getattr(ahead, name) == pytest.approx(getattr(behind, name), rel=1e-9) and getattr(ahead, name) > 0


def test_the_model_form_error_by_heat_is_stated_by_its_parts(model):
    """At small slip the thinner film by the heat of the inlet may count for more than the temperatures in the contact.
    The first part is half of the change that the decision states, and both add up to the model-form error of a thick
    film."""
    hot = at(model, 5.0, 0.05, numerics={"model": "paper"})
    note = next(note for note in hot.uncertainty.notes if note.startswith("the model-form error by heat is "))
    total, within, thinner, inlet = (float(number) for number in re.findall(r"([\d.]+) %", note)[:4])
    assert thinner == pytest.approx(100 * (1 - hot.inlet_film_factor), rel=0.06)
    change = float(re.search(r"changes f by -([\d.]+) %", hot.decision.heat_in_words)[1])
    assert within == pytest.approx(change / 2, rel=0.06) and inlet > within
    assert inlet == pytest.approx(50 * (1 - hot.inlet_film_factor), rel=0.06)
    assert total == pytest.approx(within + inlet, rel=0.06)
    assert total == pytest.approx(100 * hot.uncertainty.largest_in_model.error, rel=0.02)
    assert "half of their effect on f" in note and "an upper bound: f inversely proportional" in note
