"""The speed at which a scene has a film of a given thickness."""

import sys

import pytest

import lubfric
from lubfric.models.shared import speed_of

PAPER = lubfric.load_scene("paper")


@pytest.mark.parametrize("thickness", [5e-9, 100e-9, 2e-6])
def test_the_film_at_that_speed_has_the_thickness(thickness):
    assert PAPER.line_contact(speed_of(PAPER, thickness)).expected_film == pytest.approx(thickness, rel=1e-6)


def test_it_does_not_import_the_optimizers_of_scipy(monkeypatch):
    """Their import takes a twentieth of a first point, which needs nothing else of them."""
    monkeypatch.setitem(sys.modules, "scipy.optimize", None)
    assert speed_of(PAPER, 100e-9) > 0


def test_a_film_thicker_than_what_arrives_is_reported():
    """At any speed no more than 60 nm arrive."""
    starved = PAPER.with_(lubricant={"inlet_film": 60e-9})
    with pytest.raises(lubfric.ConvergenceError):
        speed_of(starved, 1e-6)
