"""Shorter cells that do not converge leave the strips' answer, with a larger numerical error and a sentence."""

import pytest

import lubfric
from lubfric.models.deterministic import pieces, problem, shorter_cells
from lubfric.models.shared import checks

SCENE = lubfric.load_scene("paper").with_(
    lubricant={"limiting_stress_coefficient": "f_b"}, numerics={"sampling_tolerance": 0.1}
)
SPEED = 0.01


def fails(*_, **__):
    raise lubfric.ConvergenceError(
        "no film", lubfric.errors.Report("a piece", "diverged", iterations=3, residual=1.0, tolerance=1e-3)
    )


@pytest.fixture(scope="module")
def solved():
    return lubfric.friction(SCENE, SPEED)


def test_pieces_that_do_not_converge_enlarge_the_numerical_error(monkeypatch, solved):
    monkeypatch.setattr(pieces, "_refined", fails)
    unsolved = lubfric.friction(SCENE, SPEED)
    assert unsolved.decision.model == solved.decision.model == "deterministic"
    assert unsolved.uncertainty.numerical > 1.5 * solved.uncertainty.numerical
    low, high = unsolved.uncertainty.interval
    assert low < solved.coefficient < high
    assert "shorter cells did not converge" in unsolved.uncertainty.text
    assert unsolved.coefficient == pytest.approx(solved.coefficient, rel=0.1)


def test_pieces_of_too_many_cells_leave_the_answer_of_the_strips(monkeypatch, solved):
    """The strips have 35 x 200 cells, a piece on shorter ones 69 x 192."""
    monkeypatch.setattr(problem, "MOST_GRID_CELLS", 12_000)
    limited = lubfric.friction(SCENE, SPEED)
    assert limited.decision.model == solved.decision.model == "deterministic"
    assert abs(limited.coefficient / solved.coefficient - 1) < limited.uncertainty.numerical
    assert limited.uncertainty.numerical > 10 * solved.uncertainty.numerical  # without the factor of 2: 7 times
    assert "shorter cells of a piece of the surface would be more than" in limited.uncertainty.text
    assert "the largest number that is solved" not in solved.uncertainty.text
    (violation,) = (each for each in limited.validity if each.what == "estimated numerical error of f")
    assert "a narrow patch" in violation.recommendation
    monkeypatch.setattr(pieces, "_refined", fails)
    assert lubfric.friction(SCENE, SPEED).uncertainty.numerical == limited.uncertainty.numerical


def test_strips_of_too_many_cells_leave_the_answer_to_load_sharing(monkeypatch):
    named = SCENE.with_(numerics={"model": "deterministic"})
    by_load_sharing = lubfric.friction(SCENE.with_(numerics={"model": "paper"}), SPEED)
    monkeypatch.setattr(problem, "MOST_GRID_CELLS", 1000)
    for scene in (SCENE, named):
        assert lubfric.friction(scene, SPEED).coefficient == by_load_sharing.coefficient
    assert "more than the 1e+03 that are solved at most" in lubfric.friction(named, SPEED).decision.text


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
    assert "the largest number that is solved" in limited.uncertainty.text
    (violation,) = (each for each in limited.validity if each.what == "estimated numerical error of f")
    assert "a smaller patch (contact.shape)" in violation.recommendation
    assert "the largest number that is solved" not in solved.uncertainty.text


def test_a_patch_keeps_its_shorter_cells_where_still_shorter_ones_do_not_converge(monkeypatch):
    """f on its own cells lies within the numerical error that is stated from cells twice as long."""
    solved = lubfric.friction(PATCH, SPEED)
    solve = shorter_cells.solve_strip

    def solve_long_cells(*arguments, map_coarsening, **keywords):
        if map_coarsening == (1, 1):
            fails()
        return solve(*arguments, map_coarsening=map_coarsening, **keywords)

    monkeypatch.setattr(shorter_cells, "solve_strip", solve_long_cells)
    unsolved = lubfric.friction(PATCH, SPEED)
    assert unsolved.details["deterministic"].pressure.shape == (62, 32)
    assert abs(unsolved.coefficient / solved.coefficient - 1) < unsolved.uncertainty.numerical
    assert unsolved.uncertainty.numerical > solved.uncertainty.numerical
    assert "shorter cells did not converge" in unsolved.uncertainty.text


def test_an_axis_of_a_patch_with_many_cells_keeps_longer_ones():
    """Its cells along y, which divide 4 x 61, are a fourth of those along x: f on native ones is within the stated
    error."""
    patch = PATCH.with_(
        surface={"correlation_length": (12e-6, 14e-6)},
        contact={"shape": (96, 244), "spacing": (1e-6, 0.25e-6)},
        numerics={"tolerance": 2.5e-2},
    )
    native = lubfric.friction(patch.with_(numerics={"grid": "given"}), SPEED)
    result = lubfric.friction(patch, SPEED)
    assert native.details["deterministic"].pressure.shape[1] == 244
    assert result.details["deterministic"].pressure.shape[1] <= 122
    assert abs(result.coefficient / native.coefficient - 1) < result.uncertainty.numerical < 0.03


@pytest.mark.parametrize(
    ("scene", "work", "more"),
    [
        pytest.param(
            SCENE.with_(numerics={"model": "deterministic", "tolerance": 4e-3}), 1.0, 60.0, marks=pytest.mark.slow
        ),
        (PATCH, 0.3, 3.0),
    ],
)
def test_cells_that_the_work_ended_have_one_advice_that_helps(scene, work, more):
    """A larger numerics.max_work lowers the numerical error. On the cells of the map the same work gives no lower one,
    or no answer."""
    ended = lubfric.friction(scene.with_(numerics={"max_work": work}), SPEED)
    (note,) = (each for each in ended.validity if each.what == "estimated numerical error of f")
    assert note.recommendation == "set a larger numerics.max_work for shorter cells"
    assert "numerics.grid" not in ended.uncertainty.text and ended.uncertainty.text.count("numerics.max_work") >= 1
    helped = lubfric.friction(scene.with_(numerics={"max_work": more}), SPEED)
    assert helped.uncertainty.numerical < 0.8 * ended.uncertainty.numerical
    assert "did not converge" not in helped.uncertainty.text
    on_given_cells = scene.with_(numerics={"max_work": work, "grid": "given"})
    try:
        assert lubfric.friction(on_given_cells, SPEED).uncertainty.numerical >= ended.uncertainty.numerical
    except lubfric.errors.WorkLimitError:
        pass


@pytest.mark.parametrize("speed", [0.01, 0.2])
def test_a_local_peak_is_between_asperity_contacts_only_where_asperities_carry_load(monkeypatch, speed):
    monkeypatch.setitem(checks.OF_VISCOSITY_LAW, "roelands", 1e6)
    monkeypatch.setattr(checks, "SPIKE", 0.5)
    point = lubfric.friction(PATCH.with_(numerics={"tolerance": 0.05}), speed)
    (peak,) = (each.consequence for each in point.validity if each.what == "highest film pressure")
    assert ("next to asperity contacts" in peak) == (point.contact_load > 0) == (speed < 0.1)
    assert ("over the roughness" in peak) == (point.contact_load == 0)
