"""The deterministic answer and its warnings: heat on smooth surfaces is that of the smooth film, none of it the
isothermal answer; a recommendation exists."""

from dataclasses import replace

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric

ROLLER = paper_scene(
    bodies={"radius": 0.01, "hertz_pressure": 0.9e9, "width": 0.01, "e_prime": 2.27e11},
    lubricant={"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 70, "eyring_stress": 5e6},
    contact={"shape": (64, 16), "spacing": 8e-6},
    surface={"sq": 5e-8, "correlation_length": 3e-5, "acf": "gaussian"},
    numerics={"sampling": "patch", "accept": True},
)


def solved(speed, *, sq=5e-8, bodies=None, oil=None, **numerics):
    scene = ROLLER.with_(bodies=bodies or {}, surface={"sq": sq}, lubricant=oil or {}, numerics=numerics)
    return lubfric.friction(scene, speed)


def test_heat_does_to_smooth_surfaces_what_it_does_to_the_smooth_film():
    """The other model finds film and heat on a line, by other equations."""
    (hot, cold), (film, cold_film) = (
        [solved(3.0, sq=1e-10, model=model, heat=heat) for heat in ("on", "off")]
        for model in ("deterministic", "paper")
    )
    assert film.coefficient < 0.5 * cold_film.coefficient and film.central_film < 0.9 * cold_film.central_film
    for name, near in (("coefficient", 0.01), ("central_film", 5e-3)):
        result, known = (getattr(a, name) / getattr(b, name) for a, b in ((hot, cold), (film, cold_film)))
        assert result == pytest.approx(known, rel=near), name
    assert hot.coefficient == pytest.approx(film.coefficient, rel=0.01)
    assert hot.inlet_film_factor == film.inlet_film_factor
    assert hot.flash_temperature_rise == pytest.approx(film.flash_temperature_rise, rel=0.02)


def test_without_heat_it_is_the_isothermal_answer():
    """Where bodies carry all heat away, and the viscosity does not fall."""
    kept: dict = {"heat": "on", "bodies": {"conductivity": (1e12, 1e12)}}
    kept |= {"oil": {"temperature_coefficient": 1e-7, "conductivity": 2.0}}
    result, cold = (solved(0.3, model="deterministic", **how) for how in (kept, {"heat": "off"}))
    assert result.coefficient != cold.coefficient
    assert result.coefficient == pytest.approx(cold.coefficient, rel=3e-4)
    assert result.uncertainty.model == pytest.approx(cold.uncertainty.model, abs=3e-4)


def test_what_heat_does_to_f_is_partly_in_the_interval():
    hot, cold = (solved(0.3, model="deterministic", heat=heat) for heat in ("on", "off"))
    assert hot.uncertainty.model >= 0.5 * (1 - hot.coefficient / cold.coefficient) > 0
    assert "by Wilson and Sheu" in hot.decision.text and "without the heat of the inlet f would" in hot.decision.text
    assert np.isnan([cold.inlet_film_factor, cold.film_temperature_rise]).all() and cold.decision.heat_in_words == ""
    assert "numerics.heat = 'off'" in cold.errors.reasons["film_temperature_rise"]


def test_the_interval_of_eq_8_has_the_doubt_about_heat_too():
    """Of a thick film the model error was 4e-7 where heat takes half of f."""
    hot, cold = (solved(3.0, sq=1e-10, heat=heat) for heat in ("on", "off"))
    assert hot.decision.model == "paper" and cold.uncertainty.model < 1e-5
    assert 0.5 * (1 - hot.coefficient / cold.coefficient) < hot.uncertainty.model < 0.6


def test_much_heat_is_left_to_the_quick_answer_or_reported():
    """Half of what heat does counts as error, so that shorter cells would be of no use. Cells apart, both are one
    model."""
    auto, requested = (solved(3.0, model=model) for model in ("auto", "deterministic"))
    assert auto.decision.model == "quick" and "of its thickness, and f by" in auto.decision.text
    assert auto.coefficient == pytest.approx(requested.coefficient, rel=0.1)
    assert max(auto.uncertainty.model_sides) > 0.1
    assert requested.deterministic is not None and any(
        "for which the model was checked" in e.what for e in requested.validity
    )
    assert solved(0.02, model="auto").deterministic is not None


def test_the_recommendation_of_an_error_by_the_cells_is_one_that_the_map_has():
    scene = ROLLER.with_(numerics={"tolerance": 1e-4, "heat": "off", "model": "deterministic"})
    surface = lubfric.prepare(scene).surface
    made, given = (lubfric.friction(lubfric.prepare(scene, one), 0.3).validity for one in (None, surface))
    made, given = (next(e.recommendation for e in stated if "numerical error" in e.what) for stated in (made, given))
    assert "contact.spacing" in made and "contact.spacing" not in given


def test_the_range_of_a_conductivity_is_worth_what_it_is_to_the_other_model():
    scene = replace(ROLLER, ranges=(("lubricant.conductivity", 0.08, 0.25),))
    result, film = (
        lubfric.friction(scene.with_(numerics={"model": model}), 0.6) for model in ("deterministic", "paper")
    )
    assert result.uncertainty.inputs == pytest.approx(film.uncertainty.inputs, rel=0.15)
