"""Shorter cells that do not converge leave the strips' answer, with a larger numerical error and a sentence."""

import pytest

import lubfric
from lubfric.models.deterministic import problem, shorter_cells

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


PATCH = SCENE.with_(
    contact={"shape": (96, 64), "spacing": 1e-6},
    numerics={"sampling": "patch", "model": "deterministic", "tolerance": 1e-3},
)


@pytest.mark.parametrize("shortest", [(62, 32), (32, 16)])
def test_a_patch_ends_at_the_shortest_cells_that_are_not_too_many(monkeypatch, shortest):
    """f on the own cells of the patch lies within the numerical error that is stated without them."""
    solved = lubfric.friction(PATCH, SPEED)
    assert solved.details["deterministic"].pressure.shape == (122, 64)
    columns, rows = shortest
    monkeypatch.setattr(problem, "MOST_GRID_CELLS", columns * rows)
    limited = lubfric.friction(PATCH, SPEED)
    assert limited.details["deterministic"].pressure.shape == shortest
    assert abs(limited.coefficient / solved.coefficient - 1) < limited.uncertainty.numerical
    assert limited.uncertainty.numerical > solved.uncertainty.numerical
    assert "the most that are solved" in limited.uncertainty.text
    (violation,) = (each for each in limited.validity if each.what == "estimated numerical error of f")
    assert "a smaller patch (contact.shape)" in violation.recommendation
    assert "the most that are solved" not in solved.uncertainty.text
