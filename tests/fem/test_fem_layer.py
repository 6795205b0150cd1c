"""Elastic layer by finite elements: exact compliance, orders, relations, two solvers, failures that must show."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm
from skfem import Basis, ElementHex1, ElementHex2, ElementVector, MeshHex, MeshTri
from skfem.models.elasticity import lame_parameters, linear_elasticity

from verification.fem.solvers.compliance import Elastic, half_space_compliance, layer_compliance, missing
from verification.fem.solvers.layer import graded_mesh, make_layer
from verification.fem.solvers.layer3d import Layer3D, graded_levels, multigrid, solve, stiffness
from verification.fem.solvers.layer_waves import fourier_compliance
from verification.fem.solvers.report import SolveError

STEEL = Elastic(206e9, 0.3)
UNIT = Elastic(1.0, 0.3)


def integrated_compliance(s: float, body: Elastic) -> float:
    """k C from the equations of elasticity integrated through the depth, for the wave with k = 1 and d = s."""
    lame, mu = lame_parameters(body.young, body.poisson)
    m = lame + 2 * mu
    # (u, w, sigma_zz, sigma_xz) along z, for u sin x, w cos x, sigma_zz cos x, sigma_xz sin x
    system = np.zeros((4, 4))
    system[0, [1, 3]] = 1, 1 / mu
    system[1, [0, 2]] = -lame / m, 1 / m
    system[2, 3] = -1
    system[3, [0, 2]] = m - lame**2 / m, lame / m
    through = expm(system * s)
    at_base = np.linalg.solve(through[2:, 2:], [-1.0, 0.0])
    return -float(through[1, 2:] @ at_base)


@pytest.mark.parametrize("poisson", [-0.5, 0.0, 0.3, 0.49])
@pytest.mark.parametrize("s", [1e-3, 0.1, 0.249, 0.251, 1.0, 4.0, 8.0])
def test_exact_compliance_solves_the_equations_of_elasticity(poisson, s):
    body = Elastic(2.0, poisson)
    assert layer_compliance(1.0, s, body) == pytest.approx(integrated_compliance(s, body), rel=1e-9)


@given(st.floats(-0.9, 0.499), st.floats(0.01, 20), st.floats(1.01, 3))
def test_a_thicker_layer_is_softer_and_a_half_space_softest(poisson, s, factor):
    body = Elastic(1.0, poisson)
    thin, thick = layer_compliance(1.0, np.array([s, factor * s]), body)
    softest = half_space_compliance(1.0, body)
    assert 0 < thin <= thick * (1 + 1e-14) <= softest * (1 + 1e-13)
    assert missing(s, poisson) == pytest.approx(1 - thin / softest, abs=1e-13)


# ---- plane strain ------------------------------------------------------------------------------------------------


def box(cells, depth=0.5):
    return MeshTri.init_tensor(np.linspace(-0.5, 0.5, cells + 1), np.linspace(-depth, 0, round(depth * cells) + 1))


@pytest.mark.parametrize("sides", ["periodic", "free"])
def test_compliance_is_reciprocal_and_positive(sides):
    layer = make_layer(graded_mesh(8.0, 1.0, 0.5, 0.1), UNIT, strip=0.5, sides=sides)
    assert np.all(np.abs(layer.x) <= 0.5 + 1e-9) and np.all(np.diff(layer.x) > 0)
    assert layer.compliance == pytest.approx(layer.compliance.T, abs=1e-12 * layer.compliance.max())
    assert np.linalg.eigvalsh(layer.compliance).min() > 0


# ---- three dimensions --------------------------------------------------------------------------------------------


def brick(nodes, degree, layers=None, depth=1.0, body=UNIT):
    return Layer3D(
        body=body,
        size=(1.0, 1.0),
        levels=graded_levels(depth, layers or nodes // degree, 4.0),
        shape=(nodes, nodes),
        degree=degree,
    )


@pytest.mark.parametrize("degree, element", [(1, ElementHex1), (2, ElementHex2)])
def test_assembled_layer_is_that_of_scikit_fem(degree, element):
    """The energy of a random periodic displacement, with the mesh of the whole period assembled by scikit-fem."""
    nx = 3 * degree
    ny = 2 * degree
    layer = Layer3D(body=UNIT, size=(1.2, 0.7), levels=graded_levels(0.9, 2, 3.0), shape=(nx, ny), degree=degree)
    x = np.linspace(0, 1.2, 4)
    y = np.linspace(0, 0.7, 3)
    basis = Basis(MeshHex.init_tensor(x, y, layer.levels), ElementVector(element()), intorder=2 * degree)
    planes = np.unique(np.round(basis.doflocs[2], 9))
    ix, iy = (np.round(basis.doflocs[i] / w * degree).astype(int) for i, w in enumerate(layer.cell_size))
    iz = np.searchsorted(planes, np.round(basis.doflocs[2], 9))
    component = np.zeros(basis.N, dtype=int)
    for dofs in (basis.nodal_dofs, basis.edge_dofs, basis.facet_dofs, basis.interior_dofs):
        for row, numbers in enumerate(dofs):
            component[numbers] = row % 3
    free = np.random.default_rng(3).standard_normal((layer.planes, nx, ny, 3))
    values = np.concatenate([np.zeros((1, nx, ny, 3)), free])[iz, ix % nx, iy % ny, component]
    whole = linear_elasticity(*lame_parameters(1.0, 0.3)).assemble(basis)
    assert free.ravel() @ (stiffness(layer) @ free.ravel()) == pytest.approx(values @ (whole @ values), rel=1e-12)


def test_bricks_are_reciprocal_and_the_same_from_every_cell():
    layer = brick(8, 2)
    waves = fourier_compliance(layer)
    rng = np.random.default_rng(2)
    p, q = rng.standard_normal((2, 8, 8))
    assert np.sum(q * waves.displacement(p)) == pytest.approx(np.sum(p * waves.displacement(q)), rel=1e-11)
    moved = np.roll(waves.displacement(p), (2, 4), (0, 1))
    assert waves.displacement(np.roll(p, (2, 4), (0, 1))) == pytest.approx(moved, abs=1e-12 * np.abs(moved).max())
    assert waves.displacement(layer.weights) == pytest.approx(1.0 / UNIT.oedometric, rel=1e-10)


def test_the_residual_is_not_taken_from_the_iteration():
    """A hierarchy of another, stiffer layer: its own residual falls, that of this layer does not."""
    layer = brick(8, 1)
    other = multigrid(replace(layer, body=Elastic(2.0, 0.3)))
    grid = multigrid(layer)
    with pytest.raises(SolveError):
        solve(replace(other, layer=layer, matrix=grid.matrix), layer.weights)
