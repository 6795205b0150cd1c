"""Short strips of a measured map: which shorter cells are solved, counted, and whether the stated error covers them."""

import numpy as np
import pytest

import lubfric
from lubfric._base import count_work, limited_work
from lubfric.estimate import estimated_work_of_point
from lubfric.models.deterministic import ladder, pieces, shorter_cells
from lubfric.models.deterministic.strip import (
    cautious_changes,
    error_by_cells,
    error_of_patch,
    expected_error_after,
)

SPEED = 0.03


@pytest.fixture
def scene(tmp_path):
    """A map of 80 x 48 µm, smooth over its cells, which a strip of six correlation lengths takes up along y."""
    rough = {"sq": 8e-8, "correlation_length": 8e-6, "acf": "gaussian", "seed": 3}
    np.save(tmp_path / "map.npy", lubfric.generate_surface((160, 96), 0.5e-6, **rough).heights)
    paper = lubfric.load_scene("paper")
    bodies = paper.bodies
    return lubfric.load_scene(
        {
            "bodies": {
                "radius": bodies.radius,
                "width": bodies.width,
                "load": bodies.load,
                "e_prime": bodies.e_prime,
                "boundary_friction_coefficient": bodies.boundary_friction_coefficient,
                "boundary_film": 20e-9,
            },
            "lubricant": {
                "viscosity": paper.lubricant.viscosity,
                "pressure_viscosity_coefficient": paper.lubricant.pressure_viscosity_coefficient,
                "limiting_stress_coefficient": "f_b",
            },
            "motion": {"entrainment_speed": SPEED},
            "surface": {"file": str(tmp_path / "map.npy"), "spacing": 0.5e-6, "extension": "mirror"},
            "numerics": {"model": "deterministic", "accept": True},
        }
    )


def solved(scene, monkeypatch):
    """The result, and the shapes of the solves of shorter cells, in their order."""
    shapes = []

    def solve(*arguments, **keywords):
        strip = shorter_cells_solve(*arguments, **keywords)
        shapes.append(strip.problem.heights.shape)
        return strip

    shorter_cells_solve = shorter_cells.solve_strip
    with monkeypatch.context() as patch:
        for module in (pieces, shorter_cells):
            patch.setattr(module, "solve_strip", solve)
        return lubfric.friction(scene), shapes


def test_the_shortest_cells_of_a_short_strip_continue_its_own_solution(scene, monkeypatch):
    """Each length of cells is one more solve, on the strip itself: the longer ones are not solved again."""
    (result, shapes) = solved(scene, monkeypatch)
    (_, rows) = shapes[0]
    assert [shape for shape in shapes if shape == shapes[0]] == shapes[:1]
    further = [shape[1] for shape in shapes if shape[1] > rows]
    assert further == [rows * 2 ** (k + 1) for k in range(len(further))] and further
    assert result.uncertainty.numerical < 0.03


def test_cells_that_do_not_pay_are_not_solved_and_the_error_covers_them(scene, monkeypatch):
    """Where f changes as much from cells to cells as before, one more halving does not lead to the tolerance."""
    (complete, shapes) = solved(scene, monkeypatch)
    monkeypatch.setattr(ladder, "CHEAP_WORK", 0.0)
    (ended, fewer) = solved(scene, monkeypatch)
    assert fewer == shapes[: len(fewer)] and len(fewer) < len(shapes)
    assert abs(complete.coefficient / ended.coefficient - 1) < ended.uncertainty.numerical
    assert complete.uncertainty.numerical < ended.uncertainty.numerical
    assert "shorter cells were not solved" in ended.uncertainty.text
    assert "shorter cells were not solved" not in complete.uncertainty.text


def test_cells_that_take_more_than_those_that_converge_are_no_matter_of_the_work_of_the_point(scene, monkeypatch):
    """A larger numerics.max_work would not solve them, so it is not advised."""
    monkeypatch.setattr(shorter_cells, "solve_strip", lambda *_, **__: count_work(1e9))
    result = lubfric.friction(scene)
    assert "shorter cells did not converge: " in result.uncertainty.text
    assert "max_work" not in result.uncertainty.text
    (note,) = (each for each in result.validity if each.what == "estimated numerical error of f")
    assert "surface.s_filter" in note.recommendation


@pytest.mark.parametrize("ratio", [0.3, 0.5, 0.7])
def test_the_expected_error_is_the_rest_of_a_geometric_series(ratio):
    """Oracle: the sum of the changes that follow, without end and with three halvings left."""
    changes = [ratio**k for k in range(3)]
    rest = sum(ratio**k for k in range(4, 200))
    assert expected_error_after(changes, 1) == pytest.approx(rest)
    assert expected_error_after(changes, 2) == pytest.approx(rest - ratio**4)
    assert expected_error_after(changes, 1, 3) == pytest.approx(ratio**4 + ratio**5)


def test_a_small_change_after_a_large_one_is_not_believed():
    """On the ridges of a measured map f changes by -5.2, +.3 and +.5 %: the second change does not bound the third."""
    (first, second, third) = (0.052, 0.003, 0.005)
    assert error_by_cells(cautious_changes([first, second]), 5) > third
    assert cautious_changes([first, 0.04]) == (first, 0.04)


def test_a_change_of_a_patch_that_is_small_by_chance_does_not_make_its_error_small():
    """Oracle: what is left of two errors of first and of second order and opposite sign, a/2^k - b/4^k on grid k."""
    rest = 0.5 ** np.arange(4) - 4 / 3 * 0.25 ** np.arange(4)  # they cancel in the change from grid 1 to grid 2
    changes = abs(np.diff(rest))
    assert changes[1] < 1e-15
    assert rest[2] < error_of_patch(changes[:2]) < 1.2 * rest[2]
    rng = np.random.default_rng(0)
    inside = []
    for _ in range(500):
        (a, b) = rng.uniform(0.02, 0.2, 2)
        rest = a * 0.5 ** np.arange(12) - b * 0.25 ** np.arange(12)
        changes = abs(np.diff(rest))
        errors = [error_of_patch(changes[:k]) for k in range(1, 12)]
        last = next(k for k, error in enumerate(errors) if error <= 2e-3)  # where the first within the tolerance is
        inside.append(abs(rest[last + 1]) <= errors[last])
    assert np.mean(inside) > 0.9  # where the last change alone counts: 0.76


@pytest.mark.parametrize("speed", [0.003, 0.03])
def test_the_work_of_a_short_strip_is_estimated_within_four(scene, speed):
    """Oracle: the counted work of the solve, of which the processor takes about two thirds."""
    prepared = lubfric.prepare(scene)
    expected = estimated_work_of_point(prepared.scene, prepared.sample, prepared.surface, speed).seconds
    with limited_work(1e3) as meter:
        lubfric.friction(prepared, speed)
    taken = 0.64 * meter.spent
    assert taken / 4 <= expected <= 4 * taken
