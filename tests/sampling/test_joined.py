"""Lines that are each in balance, and the balance of all of them under one film."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from lubfric.sampling.joined import joined
from lubfric.sampling.response import Slopes, respond
from scipy.optimize import brentq

import lubfric
from lubfric.sampling import line_friction

TOTAL = 10.0


def alone(scale, exponent):
    """Balance of a line that carries ``scale`` F_H^n under the film of F_H."""
    return brentq(lambda load: scale * (TOTAL - load) ** exponent - load, 0.0, TOTAL, xtol=1e-15)


@pytest.mark.parametrize("exponent", [0.7, 3.0, 15.0])
def test_lines_whose_load_is_a_power_of_that_of_the_film(exponent):
    """The joined balance in closed form is the upper end of what is left open, and the mean the lower one."""
    rng = np.random.default_rng(5)
    scales = TOTAL ** (1 - exponent) * np.exp(rng.uniform(-3, 1, 6))
    lengths = rng.uniform(1, 3, 6)
    loads = [alone(scale, exponent) for scale in scales]
    whole = alone(np.average(scales, weights=lengths), exponent)
    found = joined(lengths, loads, TOTAL, exponent)
    mean = np.average(loads, weights=lengths)
    assert whole > mean * (1 + 1e-3)
    assert found.load + found.open == pytest.approx(whole, rel=1e-9)
    assert found.load - found.open == pytest.approx(mean, rel=1e-9)


def test_equal_lines_and_one_line_carry_what_each_does():
    for lengths, loads in (([1.0], [3.0]), ([1.0, 2.0], [3.0, 3.0]), ([1.0, 1.0], [0.0, 0.0])):
        found = joined(lengths, loads, TOTAL, 5.0)
        assert found.load == loads[0] and found.open == 0


def test_the_whole_load_on_one_line_and_none_on_another():
    found = joined([1.0, 1.0], [TOTAL, 0.0], TOTAL, 2.0)
    assert TOTAL / 2 <= found.load - found.open and found.load + found.open <= TOTAL


def test_a_film_that_does_not_thin_leaves_the_mean():
    assert joined([1.0, 3.0], [1.0, 2.0], TOTAL, -0.5) == joined([1.0, 3.0], [1.0, 2.0], TOTAL, 0.0)
    assert joined([1.0, 3.0], [1.0, 2.0], TOTAL, 0.0).load == 1.75


def test_the_exponent_is_that_of_a_thinning_film_over_an_exponential_contact():
    """h ~ F_H^-m and P ~ exp(-G/sigma): the contact's load at the gap of the film is ~ exp(m h ln(F_H)/sigma)."""
    width, contact_load, sigma, thinning, film = 0.01, 2.0, 3e-8, 0.8, 2e-7
    film_load = TOTAL - contact_load
    split = np.log(film_load / contact_load)

    def at_split(s):
        return {"mean_gap": film * ((TOTAL / (1 + np.exp(-s))) / film_load) ** -thinning}

    balance = SimpleNamespace(split=split, contact_load=contact_load, film_load=film_load)
    found = respond(width, balance, Slopes(-sigma * width / contact_load, 0.0, 0.0), at_split)
    assert found.film_exponent == pytest.approx(thinning * film / sigma, rel=1e-3)
    moved = found.gap_of_load(1e-4)
    assert 1 / (1 + np.exp(split + found.split * moved)) == pytest.approx(contact_load / TOTAL * (1 + 1e-4), rel=1e-6)


def test_the_answer_carries_the_joined_load_on_the_area_that_it_needs(monkeypatch):
    """Lines of loads and lengths that are far apart, without an effect of the grid: the common load by bisection, the
    contact area by its secant from the mean load of the lines on, and what is left open as an error of the gap."""
    samples, found_of = [], line_friction._found
    monkeypatch.setattr(line_friction, "_found", lambda sample: samples.append(sample) or found_of(sample))
    scene = lubfric.load_scene("paper").with_(numerics={"sampling_tolerance": 0.05})
    lubfric.friction(scene, 0.06)
    sample = samples[-1]
    assert len(sample.records) > 2
    factors = np.linspace(0.2, 3.0, len(sample.records))
    records = tuple(replace(r, contact_load=k * r.contact_load) for r, k in zip(sample.records, factors))
    sample = replace(sample, records=records, anchor=replace(sample.anchor, grid=()))
    found, response = found_of(sample), sample.anchor.response

    total, n = scene.bodies.load, response.film_exponent
    lengths, loads = np.array([(r.length, r.contact_load) for r in records]).T
    mean, low, high = np.average(loads, weights=lengths), loads.min(), loads.max()
    for _ in range(60):
        common = (low + high) / 2
        asked = np.average(loads * ((total - common) / (total - loads)) ** n, weights=lengths)
        low, high = (common, high) if asked > common else (low, common)
    assert common > 1.02 * mean
    load, left_open = (common + mean) / 2, (common - mean) / 2
    assert found.point.balance.contact_load == pytest.approx(load, rel=1e-9)
    assert found.point.balance.film_load == pytest.approx(total - load, rel=1e-9)
    area = np.average([r.area_fraction for r in records], weights=lengths)
    grown = area + response.slopes.area * (load - mean) / scene.bodies.width
    assert found.point.balance.contact.real_contact_area_fraction == pytest.approx(grown, rel=1e-9)
    split = np.log((total - load * (1 + 1e-6)) / (load * (1 + 1e-6))) - np.log((total - load) / load)
    per_load = abs(split / response.split) / 1e-6  # of the gap [m], by a relative change of the load
    near = per_load * (1 + response.odds) / response.odds * (total - load) / total  # at the odds of the response
    assert found.unshared == pytest.approx(near * left_open / load, rel=1e-4)
