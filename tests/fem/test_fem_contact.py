"""Active-set contact on the finite-element layer: closed forms, another algorithm, relations, injected faults."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import nnls
from skfem import MeshTri

from verification.fem.solvers.compliance import Elastic
from verification.fem.solvers.contact import solve_contact
from verification.fem.solvers.layer import graded_mesh, make_layer
from verification.fem.solvers.layer3d import Layer3D, graded_levels
from verification.fem.solvers.layer_waves import fourier_compliance
from verification.fem.solvers.report import SolveError

BODY = Elastic.from_e_prime(2.0, 0.3)
LOAD = np.pi / 4  # makes b = R = 1 and the peak 0.5 with E' = 2


def cylinder(fine, degree=2, depth=20.0):
    return make_layer(graded_mesh(8 * depth, depth, 1.5, fine, 4 * fine), BODY, degree=degree, strip=1.5)


@pytest.fixture(scope="module")
def coarse():
    return cylinder(0.2)


def press(layer, load=LOAD, **options):
    compliance = layer.compliance
    return solve_contact(lambda f: compliance @ f, layer.weights, layer.x**2 / 2, load, **options)


@settings(max_examples=20)
@given(st.integers(0, 10_000), st.floats(0.02, 2.0))
def test_another_algorithm_finds_the_same_pressure(seed, load):
    """Non-negative least squares on the same compliance, at the approach that was found."""
    layer = make_layer(MeshTri.init_tensor(np.linspace(-0.5, 0.5, 13), np.linspace(-0.5, 0, 7)), BODY)
    compliance = layer.compliance
    gap0 = 0.3 * np.random.default_rng(seed).standard_normal(layer.x.size)
    result = solve_contact(lambda f: compliance @ f, layer.weights, gap0, load, tolerance=1e-10)
    factor = np.linalg.cholesky(compliance)
    force, _ = nnls(factor.T, -np.linalg.solve(factor, gap0 - result.approach))
    assert result.pressure * layer.weights == pytest.approx(force, abs=1e-7 * load)


@settings(max_examples=25)
@given(st.integers(0, 10_000), st.floats(0.02, 10.0), st.floats(1.03, 6.0))
def test_capped_contact_of_random_heights_meets_every_condition(bricks, seed, pressure, over):
    """From a few touching nodes to full contact, from nearly all saturated to nearly none."""
    grid, compliance = bricks
    weights = grid.weights.ravel()
    limit = over * pressure
    gap0 = np.random.default_rng(seed).standard_normal(weights.size)
    result = solve_contact(compliance.displacement, weights, gap0, pressure, limit=limit)
    gap = gap0 - result.approach + compliance.displacement(result.pressure * weights)
    small = 1e-7 * np.ptp(result.displacement)
    between = result.touching & ~result.saturated
    assert np.all((result.pressure >= 0) & (result.pressure <= limit * (1 + 1e-12)))
    assert np.abs(gap[between]).max(initial=0) <= small
    assert gap[result.pressure == 0].min(initial=0) >= -small
    assert gap[result.saturated].max(initial=0) <= small
    assert weights @ result.pressure == pytest.approx(pressure, rel=1e-7)


def test_load_that_saturated_nodes_carry_exactly():
    """One node at its cap carries all: a tie, with the approach free between two values."""
    result = solve_contact(lambda f: f, np.ones(3), np.array([0.0, 5.0, 9.0]), 2.0, limit=2.0 * (1 + 1e-15))
    assert result.pressure == pytest.approx([2, 0, 0]) and result.report.converged
    result = solve_contact(lambda f: f, np.ones(3), np.array([0.0, 0.1, 9.0]), 2.0, limit=1.0)
    assert result.pressure == pytest.approx([1, 1, 0]) and result.report.converged


@pytest.fixture(scope="module")
def bricks():
    """A unit period of 16 x 16 nodes of unequal weight, and its compliance."""
    grid = Layer3D(body=BODY, size=(1.0, 1.0), levels=graded_levels(1.0, 5, 4.0), shape=(16, 16), degree=2)
    return grid, fourier_compliance(grid)


# ---- failures ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "fault",
    [
        lambda c: c + 0.3 * np.triu(c, 1),  # not symmetric
        lambda c: -c,  # pulls the surface up
        lambda c: c - 2 * np.diag(np.diag(c)),  # not positive
        lambda c: np.full_like(c, np.nan),
    ],
)
def test_a_broken_compliance_does_not_pass(coarse, fault):
    broken = fault(coarse.compliance)
    with np.errstate(all="ignore"), pytest.raises(SolveError):
        solve_contact(lambda f: broken @ f, coarse.weights, coarse.x**2 / 2, LOAD, max_iterations=8)
