"""The linear solver of a Newton step."""

import numpy as np
import pytest

from lubfric.models.deterministic import gmres


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
