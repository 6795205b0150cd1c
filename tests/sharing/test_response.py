"""What an error of the gap does to a point: against solving again on another surface, and in closed form."""

from dataclasses import replace

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.models.load_sharing import Response, Slopes, balanced_sample, solve_balance

SCENE = paper_scene(
    contact={"shape": (96, 96), "spacing": 0.9e-6},
    numerics={"sampling": "patch", "grid": "given", "tolerance": 1e-3, "balance_tolerance": 1e-5},
)


@pytest.mark.parametrize("load, speed, near", [(5.5, 0.01, 0.05), (110.0, 0.03, 0.2)])
def test_it_is_what_a_rougher_surface_does(load, speed, near):
    """Heights 1 % larger open the gap at given load; the balance is then solved again. The response takes the gap at a
    given shape of the film; under 110 N the film changes its shape with its load."""
    scene = SCENE.with_(bodies={"load": load}, lubricant={"limiting_stress_coefficient": 0.05})
    model = lubfric.prepare(scene)
    result = lubfric.friction(model, speed).balance
    rougher = replace(model.rough_contact, heights=1.01 * model.rough_contact.heights)
    thickness = result.film.film_at(model.rough_contact.x)
    gap = [each.close(thickness, result.contact_load).mean_gap for each in (model.rough_contact, rougher)]
    again = solve_balance(scene, speed, rougher, model.surface.sq, result)
    moved = again.log_load_ratio - result.log_load_ratio
    response = result.response
    assert response.log_load_ratio_per_gap * (gap[1] - gap[0]) == pytest.approx(moved, rel=near)
    change = again.forces.coefficient / result.forces.coefficient - 1
    if load < 10:  # under more load f also feels where a rougher surface touches
        assert response.rates["coefficient"] * moved == pytest.approx(change, rel=near)
    assert response.rates["contact_load"] == pytest.approx(-result.film_load / load, rel=1e-2)
    film = again.film.central_film / result.film.central_film - 1
    assert response.rates["central_film"] * moved == pytest.approx(film, rel=near)


def test_slopes_of_a_contact_are_those_of_two_loads():
    model = lubfric.prepare(SCENE)
    result = lubfric.friction(model, 0.01).balance
    film = result.film.film_at(model.rough_contact.x)
    width = SCENE.bodies.width
    loads = result.contact_load * np.array([0.99, 1.01])
    light, heavy = (model.rough_contact.close(film, load) for load in loads)
    per_load = width / (loads[1] - loads[0])
    slopes = result.response.slopes
    assert slopes.gap == pytest.approx((heavy.mean_gap - light.mean_gap) * per_load, rel=0.05)
    touched = heavy.real_contact_area_fraction - light.real_contact_area_fraction
    assert slopes.area == pytest.approx(touched * per_load, rel=0.2)


@pytest.mark.parametrize("load_ratio", [0.3, 1.0, 30.0])
def test_an_error_of_the_gap_counts_as_it_moves_a_light_contact(load_ratio):
    """F_C = F/(1 + e^s) in closed form, s moved by the error of the gap; to first order where little changes."""
    rate = -load_ratio / (1 + load_ratio)  # d ln F_C/ds
    slopes = Slopes(gap=0.0, area=0.0, contact_length=0.0)
    response = Response(slopes=slopes, log_load_ratio_per_gap=1.0, rates={"contact_load": rate}, load_ratio=load_ratio)
    for moved in (1e-3, 0.5, 3.0):
        exact = (1 + load_ratio) / (1 + load_ratio * np.exp(-moved)) - 1
        assert response.relative("contact_load", moved) == pytest.approx(max(exact, -rate * moved), rel=1e-9)
        allowed = response.gap_for("contact_load", 0.1)
        assert response.relative("contact_load", allowed) <= 0.1 * (1 + 1e-9)
    assert response.per_gap("contact_load") == -rate


def test_without_a_film_nothing_is_divided_again():
    response = lubfric.friction(SCENE, 0.0).balance.response
    assert response.rates is None and response.relative("coefficient", 1e-6) == 0.0
    assert response.slopes.gap < 0 < response.slopes.contact_length and response.gap_for("coefficient", 0.01) == np.inf


def test_the_points_of_a_traction_curve_start_from_one_balance(monkeypatch):
    """Solved once, at a ratio of its own; each point has the bits of a point that was solved alone."""
    ratios = [-0.4, 0.003, 1.2]
    loose = {"sampling_tolerance": 0.3, "tolerance": 0.05}
    scene = lubfric.load_scene("paper").with_(numerics={"model": "paper"} | loose)
    starts = []

    def counted(scene, *arguments, **options):
        if scene.motion.slide_roll_ratio == balanced_sample.REFERENCE_RATIO:
            starts.append(scene)
        return solve_balance(scene, *arguments, **options)

    monkeypatch.setattr(balanced_sample, "solve_balance", counted)
    curve = lubfric.traction(scene, ratios, speed=0.03)
    assert len(starts) == 1
    alone = [lubfric.friction(scene.with_(motion={"slide_roll_ratio": ratio}), 0.03) for ratio in ratios]
    assert len(starts) == 1 + len(ratios)
    assert curve.coefficient.tolist() == [point.coefficient for point in alone]
    assert curve["contact_load"].tolist() == [point.contact_load for point in alone]
