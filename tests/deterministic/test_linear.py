"""The linear solver of a Newton step."""

from dataclasses import replace
from itertools import islice

import numpy as np
import pytest
from scipy.sparse import diags, eye, kron
from scipy.sparse.linalg import splu

import lubfric
from lubfric.models.deterministic import (
    RoughBody,
    System,
    TimeHistory,
    evaluated,
    gmres,
    lay_out,
    linear,
    moments,
    nested_dissection,
    solve_point,
    travelling,
)
from lubfric.oil import Lubricant


def system(size=60, seed=1):
    rng = np.random.default_rng(seed)
    return np.eye(size) + 0.3 * rng.standard_normal((size, size)) / np.sqrt(size), rng.standard_normal(size)


@pytest.mark.parametrize("accuracy", [0.1, 1e-3, 1e-9])
def test_gmres_ends_at_the_accuracy_and_no_later(accuracy):
    matrix, right = system()
    x, iterations = gmres(lambda v: matrix @ v, lambda v: v, right, accuracy)

    def least(count):
        """The least residual in the Krylov space of this dimension, by a dense least-squares fit."""
        basis = np.linalg.qr(np.stack([np.linalg.matrix_power(matrix, k) @ right for k in range(count)], axis=1))[0]
        return np.linalg.norm(right - matrix @ basis @ np.linalg.lstsq(matrix @ basis, right, rcond=None)[0])

    size = np.linalg.norm(right)
    assert np.linalg.norm(matrix @ x - right) <= accuracy * size
    if iterations < 12:  # beyond, powers of the matrix are no basis in double precision
        assert np.linalg.norm(matrix @ x - right) == pytest.approx(least(iterations), rel=1e-6)
        assert least(iterations - 1) > 0.5 * accuracy * size


def test_a_preconditioner_that_is_the_inverse_takes_one_iteration():
    matrix, right = system()
    inverse = np.linalg.inv(matrix)
    x, iterations = gmres(lambda v: matrix @ v, lambda v: inverse @ v, right, 1e-10)
    assert iterations == 1 and x == pytest.approx(inverse @ right)
    assert gmres(lambda v: v, lambda v: v, np.zeros(3))[1] == 0


def test_restarts_go_on_from_the_residual():
    matrix, right = system()
    x, iterations = gmres(lambda v: matrix @ v, lambda v: v, right, 1e-8, most=5, cycles=20)
    assert iterations > 5 and np.linalg.norm(matrix @ x - right) <= 1e-8 * np.linalg.norm(right)


def five_points(nx, ny):
    """Return the matrix of a five-point stencil on a grid (nx, ny), periodic along y."""
    along = diags([-1.0, 2.5, -1.0], [-1, 0, 1], shape=(nx, nx))
    across = diags([-1.0, 2.5, -1.0], [-1, 0, 1], shape=(ny, ny)).tolil()
    across[0, -1] = across[-1, 0] = -1.0
    return (kron(along, eye(ny)) + kron(eye(nx), across)).tocsc()


@pytest.mark.parametrize("shape", [(40, 24), (25, 60), (7, 3)])
def test_nested_dissection_fills_in_less_than_cells_row_by_row(shape):
    """Both orders are permutations; on a grid of any use dissection leaves a fifth fewer entries, by SuperLU's
    count."""
    matrix = five_points(*shape)
    counts = []
    for order in (nested_dissection(*shape), np.arange(matrix.shape[0])):
        assert np.array_equal(np.sort(order), np.arange(matrix.shape[0]))
        factors = splu(matrix[order][:, order].tocsc(), permc_spec="NATURAL", options={"SymmetricMode": True})
        counts.append(factors.L.nnz)
    assert counts[0] < 0.8 * counts[1] or matrix.shape[0] < 100


SCENE = lubfric.load_scene("paper")
MAP = lubfric.generate_surface((48, 24), 2e-6, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=4)
PROBLEM = lay_out(MAP, SCENE.line_contact(0.05), sliding=0.1, boundary_friction=0.09)
SOLVED = solve_point(PROBLEM)
OIL = Lubricant(0.02, 1.8e-8, eyring_stress=5e6, limiting_stress_coefficient=0.06)


@pytest.mark.parametrize("in_time", [False, True], ids=["at rest", "in time, with the lubricant"])
def test_the_linear_system_is_the_derivative_of_residual_and_load(in_time):
    """Of the pressure of fluid cells, the fill of ruptured ones and h0, by central differences."""
    state = SOLVED.state
    history = None
    if in_time:
        mass = evaluated(PROBLEM, state).mass
        step = PROBLEM.spacing[0] / PROBLEM.speed
        history = TimeHistory(extrapolated=0.98 * mass, step=step, last=1.01 * mass, follows_lubricant=True)
    at = evaluated(PROBLEM, state, history)
    system = System(at)
    direction = np.random.default_rng(2).standard_normal(at.gap.size + 1)
    direction[:-1] *= 1e-3
    change = system.change(direction)
    part = 1e-3
    ends = [evaluated(PROBLEM, change.added(state, sign * part), history) for sign in (-1, 1)]
    rate = (ends[1].residual - ends[0].residual) / (2 * part) * system.row
    load_rate = (ends[1].load_error - ends[0].load_error) / (2 * part) / PROBLEM.load
    image = system.apply(direction)
    apart = ~system.touching.ravel()
    assert apart.sum() > 0.9 * apart.size
    off = image[:-1][apart] - rate.ravel()[apart]
    assert np.abs(off).max() < 1e-3 * np.abs(rate).max()
    assert image[-1] == pytest.approx(load_rate, rel=1e-4)


def test_coefficients_that_the_lu_omits_do_not_change_a_step_in_time():
    """The system itself keeps them: a step to a tight residual is the same with all of them in the LU."""
    step = PROBLEM.spacing[0] / PROBLEM.speed
    ends = []
    for omitted in (0.0, 0.03):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(linear, "OMITTED_COEFFICIENT", omitted)
            passing = moments(
                travelling(PROBLEM, [RoughBody(MAP, 0.05)]),
                step,
                start=SOLVED.state,
                tolerance=1e-9,
                linear_accuracy=1e-6,
            )
            ends.append([moment.at.state.pressure for moment in islice(passing, 2)][-1])
    assert ends[1] == pytest.approx(ends[0], rel=1e-6, abs=1e-6 * ends[0].max())


def test_the_lu_at_rest_has_fewer_entries_than_that_of_the_matrix_of_second_order():
    """First-order flow needs cuts one cell wide. The complete coefficients, in the best order that SuperLU finds, have
    more."""
    system = System(evaluated(PROBLEM, SOLVED.state))
    complete = (system.local + PROBLEM.self_deflection * system.by_h @ diags(system.to_pressure.ravel())).tocsc()
    other = splu(complete, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    assert system.lu.nnz < 0.85 * other.nnz


def test_a_heavy_film_at_rest_takes_fewer_iterations_than_with_second_order_flow(monkeypatch):
    """The solution is that of the complete system, whatever the preconditioner."""
    line = replace(SCENE.line_contact(0.3), load_per_width=160e3, radius=6e-3, lubricant=OIL)
    problem = lay_out(MAP, line, sliding=0.03, boundary_friction=0.12)
    fast = solve_point(problem, tolerance=1e-6)
    monkeypatch.setattr(linear, "flow_of_first_order", lambda *_, **__: None)
    slow = solve_point(problem, tolerance=1e-6)
    assert fast.coefficient == pytest.approx(slow.coefficient, rel=1e-4)
    assert fast.report.evaluations < slow.report.evaluations


def test_cells_at_the_hardness_take_as_few_iterations_as_elastic_ones():
    """Lubricant carries a dent from cell to cell: a fifth of the cells have yielded, and cells next to each other share
    dents."""
    line = replace(SCENE.line_contact(0.03), load_per_width=160e3, radius=6e-3, lubricant=OIL)
    elastic, plastic = (
        solve_point(lay_out(MAP, line, sliding=0.03, boundary_friction=0.12, hardness=hardness), tolerance=1e-5)
        for hardness in (np.inf, 2e9)
    )
    assert plastic.plastic_fraction > 0.2 > elastic.plastic_fraction
    assert plastic.report.iterations <= 2 * elastic.report.iterations
    assert plastic.report.evaluations <= 2 * elastic.report.evaluations
