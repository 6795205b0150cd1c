"""Shorter cells that do not converge leave the strips' answer, with a larger numerical error and a sentence."""

import pytest

import lubfric
from lubfric.models.deterministic import shorter_cells

SCENE = lubfric.load_scene("paper").with_(
    lubricant={"limiting_stress_coefficient": "f_b"}, numerics={"sampling_tolerance": 0.1}
)
SPEED = 0.01


def test_pieces_that_do_not_converge_enlarge_the_numerical_error(monkeypatch):
    solved = lubfric.friction(SCENE, SPEED)

    def fails(*_, **__):
        raise lubfric.ConvergenceError(
            "no film", lubfric.errors.Report("a piece", "diverged", iterations=3, residual=1.0, tolerance=1e-3)
        )

    monkeypatch.setattr(shorter_cells, "_refined", fails)
    unsolved = lubfric.friction(SCENE, SPEED)
    assert unsolved.decision.model == solved.decision.model == "deterministic"
    assert unsolved.uncertainty.numerical > 1.5 * solved.uncertainty.numerical
    low, high = unsolved.uncertainty.interval
    assert low < solved.coefficient < high
    assert "shorter cells did not converge" in unsolved.uncertainty.text
    assert unsolved.coefficient == pytest.approx(solved.coefficient, rel=0.1)
