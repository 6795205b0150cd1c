"""One fault has one recommendation, whichever part of an answer states it."""

from scene_text import paper_scene

import lubfric
from lubfric.models.shared import Assumption

SMALL = {"shape": (96, 64), "spacing": 1.8e-6}


def test_a_numerical_error_above_the_tolerance_has_the_advice_of_its_part_of_the_interval():
    """To take a larger tolerance reduces no error."""
    numerics = {"sampling": "patch", "model": "deterministic", "tolerance": 1e-4}
    result = lubfric.friction(paper_scene(contact=SMALL, numerics=numerics), 0.05)
    (note,) = [each for each in result.validity if each.assumption == Assumption.NUMERICAL_ERROR]
    assert result.uncertainty.numerical > 1e-4
    assert result.uncertainty.narrows_numerical == f"{note.recommendation} to reduce it"
    assert "larger numerics.tolerance" not in note.recommendation


def test_an_unknown_limiting_stress_has_one_advice():
    """In the warning of the saturated film, in the interval and in its note."""
    scene = paper_scene(contact=SMALL, numerics={"sampling": "patch", "model": "deterministic", "tolerance": 0.05})
    result = lubfric.friction(scene, 0.02)
    (warning,) = [each for each in result.validity if each.assumption == Assumption.FILM_BELOW_ITS_LIMIT]
    (note,) = [each for each in result.uncertainty.notes if "limiting stress of the oil is not given" in each]
    assert note.endswith(f"; {warning.recommendation}")
