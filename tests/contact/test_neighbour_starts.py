"""A contact that is closed from the state of a neighbour: the same answer as from nothing, with fewer convolutions."""

from dataclasses import replace

import numpy as np
import pytest

import lubfric
from lubfric.contact import LoadedCylinder, half_space_contact

CELL = 2e-6
SHAPE = (64, 48)
LOAD = 20.0


def contact_of(hardness=None, e_prime=2.3e11, tolerance=1e-6):
    surface = lubfric.generate_surface(SHAPE, CELL, sq=0.2e-6, correlation_length=20e-6, acf="gaussian", seed=3)
    cylinder = LoadedCylinder(radius=8e-3, width=96e-6, load=LOAD, e_prime=e_prime, hardness=hardness)
    return half_space_contact(np.array(surface.heights), (CELL, CELL), cylinder, tolerance=tolerance)


def film_under(contact):
    return contact.x**2 / (2 * 8e-3)


def test_the_state_itself_takes_no_convolution():
    contact = contact_of(hardness=4e9)
    first = contact.close(film_under(contact), LOAD)
    again = contact.close(film_under(contact), LOAD, first)
    assert first.plastic_area_fraction > 0
    assert again.fields.report.converged and again.fields.report.evaluations == 0
    assert np.array_equal(again.fields.pressure, first.fields.pressure)


@pytest.mark.parametrize("hardness", [None, 4e9])
@pytest.mark.parametrize("factor", [0.93, 0.999, 1.0005, 1.06])
def test_a_scaled_neighbour_leads_to_the_answer_from_nothing(hardness, factor):
    contact = contact_of(hardness)
    film = film_under(contact)
    neighbour = contact.close(film, LOAD)
    cold = contact.close(film, factor * LOAD)
    warm = contact.close(film, factor * LOAD, neighbour)
    highest = cold.fields.pressure.max()
    assert warm.fields.pressure == pytest.approx(cold.fields.pressure, abs=2e-4 * highest)
    assert warm.mean_gap == pytest.approx(cold.mean_gap, rel=1e-5)
    assert warm.fields.report.evaluations < cold.fields.report.evaluations
    deflection = contact.operator.apply(warm.fields.pressure)
    assert warm.fields.displacement == pytest.approx(deflection, abs=1e-12 * np.abs(deflection).max())


def test_a_displacement_of_other_bodies_is_not_taken():
    """With twice the stiffness the same pressure gives half the displacement."""
    soft = contact_of()
    stiff = contact_of(e_prime=4.6e11)
    film = film_under(soft)
    begun = stiff.close(film, LOAD, soft.close(film, LOAD))
    assert begun.fields.pressure == pytest.approx(
        stiff.close(film, LOAD).fields.pressure, abs=2e-4 * begun.fields.pressure.max()
    )
    assert soft.operator.identity != stiff.operator.identity


def test_operators_that_deflect_alike_have_one_identity():
    operator = contact_of().operator
    assert operator.identity == contact_of().operator.identity
    assert len({operator.identity, operator.single.identity, operator.with_layer(1e-18).identity}) == 3
    assert replace(operator, spacing=(CELL, 2 * CELL)).identity != operator.identity
