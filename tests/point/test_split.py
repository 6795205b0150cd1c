"""Where the balance of another speed should be."""

import math
from dataclasses import replace

import numpy as np
import pytest
from lubfric.sharing.split import foretold_split

import lubfric
from lubfric.sharing import OperatingPoint, Settings, divided, solved
from lubfric.sharing.balance import _begin, drift

PAPER = lubfric.load_scene("paper").with_(numerics={"sampling": "patch"})


def at(scene, speed):
    made = lubfric.prepare(scene.with_(contact={"shape": (32, 32), "spacing": 2.8e-6}))
    return OperatingPoint(made, speed, made.contact, Settings(made.film_levels[0], 0.03, 1e-3))


@pytest.mark.parametrize("stiffness", [0.05, 0.2])
@pytest.mark.parametrize("speeds", [(0.03, 0.02), (0.01, 0.02), (1e-4, 3e-4)])
def test_it_closes_the_balance_of_moes_film_and_a_power_law_contact(speeds, stiffness):
    """The slope of that balance, by differences, is all that is told of the contact."""
    first, second = (at(PAPER, u) for u in speeds)
    load, split = PAPER.bodies.load, 0.2

    def mismatch(point, split):
        film_load, contact_load = divided(load, split)
        return math.log(contact_load**-stiffness / point.line(film_load).moes_film)

    slope = (mismatch(first, split + 1e-4) - mismatch(first, split - 1e-4)) / 2e-4 / 2
    found, slope_there = foretold_split(second, speeds[0], split, slope)
    assert mismatch(second, found) == pytest.approx(mismatch(first, split), abs=2e-3)
    there = (mismatch(second, found + 1e-4) - mismatch(second, found - 1e-4)) / 2e-4 / 2
    assert slope_there == pytest.approx(there, rel=0.02)


def test_without_a_slope_the_film_carries_in_proportion_to_its_speed():
    assert foretold_split(at(PAPER, 0.02), 0.01, 0.3, None) == (0.3 + math.log(2), None)
    assert foretold_split(at(PAPER, 0.02), 0.02, 0.3, 0.2) == (0.3, 0.2)


@pytest.mark.parametrize("speed", [0.03, 0.003])
def test_the_paper_balance_is_foretold(speed):
    """From half as far again: nearer than the film carrying in proportion to its speed, by far."""
    made = lubfric.prepare(PAPER)
    before, there = solved(made, 1.5 * speed).balance, solved(made, speed).balance
    point = OperatingPoint(made, speed, made.contact, Settings(before.level, 0.03, 1e-3))
    found, slope = foretold_split(point, 1.5 * speed, before.split, before.slope)
    plain = before.split - math.log(1.5)
    assert abs(found - there.split) < max(0.35 * abs(plain - there.split), 0.02)
    assert slope == pytest.approx(there.slope, rel=0.25)


def test_a_neighbour_saves_contacts_and_moves_nothing():
    """One film and one contact on every grid, where the balance is foretold well; f as from a cold start."""
    made = lubfric.prepare(PAPER)
    before = solved(made, 1e-3).balance
    warm, cold = solved(made, 7e-4, before).balance, solved(made, 7e-4).balance
    assert warm.report.evaluations == 1 and warm.contact is not cold.contact
    assert warm.forces.coefficient == pytest.approx(cold.forces.coefficient, rel=1e-3)
    shifted = solved(made, 7e-4, replace(before, coarse=0.5)).balance  # what finer grids take away, foretold wrongly
    assert shifted.forces.coefficient == pytest.approx(cold.forces.coefficient, rel=1e-3)


@pytest.fixture(scope="module")
def heavy():
    """Balances at speeds that fall by a fifth, under a load that bends the film, each started from the one before."""
    made = lubfric.prepare(PAPER.with_(bodies={"load": 60.0}))
    found = [solved(made, 0.03).balance]
    for speed in (0.024, 0.0192, 0.01536):
        found.append(solved(made, speed, found[-1]).balance)
    return made, found


def test_what_was_foretold_too_low_once_is_added_again(heavy):
    made, (_, _, before, there) = heavy
    point = OperatingPoint(made, 0.01536, made.contact, Settings(before.level, 0.03, 1e-3))
    assert before.drift != 0
    missed = [abs(_begin(point, start.closed)[0] - there.split) for start in (before, replace(before, drift=0.0))]
    assert missed[0] < 0.7 * missed[1]


def test_the_drift_is_what_was_missed_and_moves_no_answer(heavy):
    made, (first, before, there, _) = heavy
    point = OperatingPoint(made, 0.024, made.contact, Settings(before.level, 0.03, 1e-3))
    foretold = foretold_split(point, 0.03, first.closed.split, first.slope)[0]
    assert drift(point, first, before) == pytest.approx((before.closed.split - foretold) / math.log(0.8))
    assert drift(point, before, before) == before.drift  # the same speed again
    wrong = solved(made, 0.0192, replace(before, drift=-30.0)).balance
    assert wrong.forces.coefficient == pytest.approx(there.forces.coefficient, rel=2e-3)


@pytest.mark.parametrize("speed", [0.002, 0.01, 0.03])
def test_the_steepness_of_a_point_is_that_between_its_neighbours(speed):
    curve = lubfric.stribeck(PAPER, speed * np.array([0.9, 1.0, 1.1]), tolerance=1e-3)
    split = np.log(curve.film_load / curve.contact_load)
    found = curve.points[1].steepness
    assert found == pytest.approx((split[2] - split[0]) / math.log(1.1 / 0.9), rel=0.08)


def test_no_steepness_without_contact():
    assert np.isnan(lubfric.friction(PAPER, 0.3).steepness)
