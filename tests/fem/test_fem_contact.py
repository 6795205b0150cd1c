"""Active-set contact on the finite-element layer: closed forms, another algorithm, relations, injected faults."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import nnls
from skfem import MeshTri

from verification.fem.compliance import Elastic, layer_compliance
from verification.fem.contact import solve_contact
from verification.fem.layer import graded_mesh, make_layer
from verification.fem.layer3d import Layer3D, graded_levels
from verification.fem.layer_waves import fourier_compliance
from verification.fem.report import SolveError

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


def distance(layer, p, q):
    return np.sqrt(layer.weights @ (p - q) ** 2 / (layer.weights @ q**2))


@pytest.fixture(scope="module")
def period():
    """One wavelength of a layer two wavelengths thick."""
    return make_layer(MeshTri.init_tensor(np.linspace(-0.5, 0.5, 65), -2 * np.linspace(1, 0, 33) ** 2), BODY)


@pytest.mark.parametrize("share", [0.05, 0.3, 0.7, 0.95])
def test_westergaard_wave(period, share):
    """Contact of a wave at a share of the pressure that flattens it."""
    height, layer = 0.01, period
    flat = np.pi * BODY.e_prime / 2 * height
    compliance = layer.compliance
    gap0 = height * (1 - np.cos(2 * np.pi * layer.x))
    found = solve_contact(lambda f: compliance @ f, layer.weights, gap0, share * flat)
    a = np.arcsin(np.sqrt(share)) / np.pi
    edge, at = np.sin(np.pi * a) ** 2, np.where(np.abs(layer.x) < a, np.pi * layer.x, np.pi * a)
    exact = 2 * share * flat * np.cos(at) / edge * np.sqrt(np.maximum(edge - np.sin(at) ** 2, 0.0))
    assert distance(layer, found.pressure, exact) < 0.02
    assert layer.weights @ found.touching == pytest.approx(2 * a, abs=1.5 / 64)


def test_full_contact_is_the_inverse_of_the_exact_compliance():
    grid = Layer3D(BODY, (1.0, 1.0), graded_levels(0.5, 16, 3.0), (32, 32), 2)
    wave, height = np.cos(2 * np.pi * (grid.x[0] + grid.x[1])), 1e-3
    amplitude = height / layer_compliance(2 * np.pi * np.sqrt(2), 0.5, BODY)
    found = solve_contact(
        fourier_compliance(grid).displacement, grid.weights.ravel(), -height * wave.ravel(), 2 * amplitude
    )
    assert found.touching.all()
    weights = grid.weights.ravel()
    projected = np.sum(weights * (found.pressure - 2 * amplitude) * wave.ravel()) / np.sum(weights * wave.ravel() ** 2)
    assert projected == pytest.approx(amplitude, rel=2e-3)
    assert found.gap == pytest.approx(0, abs=1e-9 * height)


@settings(max_examples=20)
@given(st.integers(0, 10_000), st.floats(0.02, 2.0))
def test_another_algorithm_finds_the_same_pressure(seed, load):
    """Non-negative least squares on the same compliance, at the approach that was found."""
    layer = make_layer(MeshTri.init_tensor(np.linspace(-0.5, 0.5, 13), np.linspace(-0.5, 0, 7)), BODY)
    compliance, gap0 = layer.compliance, 0.3 * np.random.default_rng(seed).standard_normal(layer.x.size)
    found = solve_contact(lambda f: compliance @ f, layer.weights, gap0, load, tolerance=1e-10)
    factor = np.linalg.cholesky(compliance)
    force, _ = nnls(factor.T, -np.linalg.solve(factor, gap0 - found.approach))
    assert found.pressure * layer.weights == pytest.approx(force, abs=1e-7 * load)


@settings(max_examples=15)
@given(st.floats(1e-9, 1e6), st.floats(-1e3, 1e3), st.sampled_from([None, 0.35]))
def test_heights_and_load_scale_together_and_a_raised_body_changes_nothing(coarse, factor, lift, limit):
    compliance, gap0 = coarse.compliance, coarse.x**2 / 2
    base = press(coarse, limit=limit)
    other = solve_contact(
        lambda f: compliance @ f,
        coarse.weights,
        factor * (gap0 + lift),
        factor * LOAD,
        limit=None if limit is None else factor * limit,
        tolerance=1e-7,
    )
    assert other.pressure == pytest.approx(factor * base.pressure, abs=1e-4 * factor * base.pressure.max())
    assert np.mean(other.touching != base.touching) < 0.05


@settings(max_examples=25)
@given(st.integers(0, 10_000), st.floats(0.02, 10.0), st.floats(1.03, 6.0))
def test_capped_contact_of_random_heights_meets_every_condition(bricks, seed, pressure, over):
    """From a few touching nodes to full contact, from nearly all saturated to nearly none."""
    grid, compliance = bricks
    weights, limit = grid.weights.ravel(), over * pressure
    gap0 = np.random.default_rng(seed).standard_normal(weights.size)
    found = solve_contact(compliance.displacement, weights, gap0, pressure, limit=limit)
    gap = gap0 - found.approach + compliance.displacement(found.pressure * weights)
    small = 1e-7 * np.ptp(found.displacement)
    between = found.touching & ~found.saturated
    assert np.all((found.pressure >= 0) & (found.pressure <= limit * (1 + 1e-12)))
    assert np.abs(gap[between]).max(initial=0) <= small
    assert gap[found.pressure == 0].min(initial=0) >= -small
    assert gap[found.saturated].max(initial=0) <= small
    assert weights @ found.pressure == pytest.approx(pressure, rel=1e-7)


def test_load_that_saturated_nodes_carry_exactly():
    """One node at its cap carries all: a tie, with the approach free between two values."""
    found = solve_contact(lambda f: f, np.ones(3), np.array([0.0, 5.0, 9.0]), 2.0, limit=2.0 * (1 + 1e-15))
    assert found.pressure == pytest.approx([2, 0, 0]) and found.report.converged
    found = solve_contact(lambda f: f, np.ones(3), np.array([0.0, 0.1, 9.0]), 2.0, limit=1.0)
    assert found.pressure == pytest.approx([1, 1, 0]) and found.report.converged


@pytest.fixture(scope="module")
def bricks():
    """A unit period of 16 x 16 nodes of unequal weight, and its compliance."""
    grid = Layer3D(BODY, (1.0, 1.0), graded_levels(1.0, 5, 4.0), (16, 16), 2)
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
