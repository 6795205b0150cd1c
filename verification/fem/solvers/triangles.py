"""What the bodies of triangles share: graded meshes, factors of a stiffness, and stresses in plane strain."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse.linalg import SuperLU, splu
from skfem import Basis, ElementTriP1, MeshTri
from skfem.helpers import sym_grad
from skfem.models.elasticity import lame_parameters, linear_stress

from ...types import FloatArray

if TYPE_CHECKING:
    from scipy.sparse import csc_matrix, csr_matrix


def graded(mesh: MeshTri, allowed: Callable[[np.ndarray], np.ndarray]) -> MeshTri:
    """Return triangles, split until none is longer than ``allowed`` says for its corners (2, 3, triangles)."""
    while True:
        corners = mesh.p[:, mesh.t]
        longest = np.max([np.hypot(*(corners[:, i] - corners[:, j])) for i, j in ((0, 1), (1, 2), (2, 0))], axis=0)
        large = np.flatnonzero(longest > allowed(corners))
        if not large.size:
            return mesh
        mesh = mesh.refined(large)


def factorised(matrix: csc_matrix | csr_matrix) -> SuperLU:
    """Return sparse LU of a symmetric positive definite matrix."""
    return splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})


def section_stress(basis: Basis, displacement: FloatArray, young: float, poisson: float) -> np.ndarray:
    """Return (3, vertices): sigma_xx, sigma_zz, sigma_xz of a plane-strain ``displacement``, on linear functions."""
    sigma = linear_stress(*lame_parameters(young, poisson))(sym_grad(basis.interpolate(displacement)))
    linear = basis.with_element(ElementTriP1())
    return np.array([linear.project(sigma[i, j]) for i, j in ((0, 0), (1, 1), (0, 1))])


def von_mises(sigma: FloatArray, poisson: float) -> FloatArray:
    """Return von Mises stress in plane strain from sigma_xx, sigma_zz, sigma_xz."""
    xx, zz, xz = sigma
    yy = poisson * (xx + zz)
    return np.sqrt(((xx - zz) ** 2 + (zz - yy) ** 2 + (yy - xx) ** 2) / 2 + 3 * xz**2)
