"""Plane-strain elastic layer bonded to a rigid base: mesh, stiffness, and the compliance of its surface.

The layer fills ``-width/2 <= x <= width/2``, ``-thickness <= z <= 0``. It is periodic in x, or has free sides. Forces
and displacements of the surface count positive downwards, into the layer.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import SuperLU
from skfem import Basis, ElementTriP1, ElementTriP2, ElementVector, LinearForm, MeshTri
from skfem.models.elasticity import lame_parameters, linear_elasticity

from ...types import FloatArray
from .compliance import Elastic
from .report import require
from .triangles import factorised, graded, section_stress

ELEMENTS = {1: ElementTriP1, 2: ElementTriP2}
NEAR = 1e-9  # of the thickness: the same point
BLOCK = 64  # right-hand sides solved at a time


@dataclass(frozen=True, kw_only=True)
class Layer:
    """The discrete layer and the nodes of its surface that may carry force.

    body : what it is made of
    basis : displacement (two components) on all of the layer
    spread : (basis.N, unknowns) from unknowns to all degrees of freedom; excludes the base, joins periodic sides
    x : (n,) surface nodes that may carry force, ascending, m
    weights : (n,) integral of each node's shape function over the surface, m: nodal force over pressure
    unknowns : (n,) the unknown that is the vertical displacement of each of these nodes
    """

    body: Elastic
    basis: Basis
    spread: sp.csc_matrix
    x: np.ndarray
    weights: np.ndarray
    unknowns: np.ndarray

    @cached_property
    def stiffness(self) -> sp.csc_matrix:
        """(unknowns, unknowns) in Pa, per metre of depth."""
        full = linear_elasticity(*lame_parameters(self.body.young, self.body.poisson)).assemble(self.basis)
        return (self.spread.T @ full @ self.spread).tocsc()

    @cached_property
    def factors(self) -> SuperLU:
        """Factors of the stiffness."""
        return factorised(self.stiffness)

    def response(self, force: FloatArray) -> np.ndarray:
        """Return all unknowns under nodal forces (n,) or (n, m), N per metre of depth; checked to 1e-9."""
        force = np.asarray(force, dtype=float)
        load = np.zeros((self.stiffness.shape[0], *force.shape[1:]))
        load[self.unknowns] = -force
        result = self.factors.solve(load)
        left = np.abs(self.stiffness @ result - load).max()
        if not left <= 1e-9 * np.abs(load).max():
            raise ArithmeticError(
                f"factorised layer: residual {left:.1e} N/m for forces up to {np.abs(load).max():.1e}"
            )
        return result

    def displacement(self, force: FloatArray) -> np.ndarray:
        """Return downward displacement in m of the n surface nodes under forces there, N per metre of depth."""
        return -self.response(force)[self.unknowns]

    @cached_property
    def compliance(self) -> np.ndarray:
        """(n, n) downward displacement per nodal force, m per N/m; symmetric and positive definite."""
        n = self.x.size
        columns = np.eye(n)
        return np.hstack([self.displacement(columns[:, i : i + BLOCK]) for i in range(0, n, BLOCK)])

    def stress(self, force: FloatArray) -> np.ndarray:
        """Return (3, vertices) sigma_xx, sigma_zz, sigma_xz in Pa, projected on continuous linear functions."""
        return section_stress(self.basis, self.spread @ self.response(force), self.body.young, self.body.poisson)


def graded_mesh(width: float, thickness: float, strip: float, fine: float, growth: float = 0.4) -> MeshTri:
    """Return triangles, split until none is longer than ``fine + growth * distance`` from the surface strip ``|x| <=
    strip``.

    The mesh is mirrored about x = 0, so that the nodes on the two sides lie at the same depths.
    """
    message = f"width {width}, thickness {thickness}, strip {strip}, fine {fine}, growth {growth}"
    fits = 0 < fine < strip <= width / 2 and thickness > 0 and growth > 0
    require(fits, message, "0 < fine < strip <= width/2, thickness > 0, growth > 0")
    cells = np.maximum(1, np.round(np.array([width / 2, thickness]) / min(width / 2, thickness))).astype(int)
    mesh = MeshTri.init_tensor(np.linspace(0, width / 2, cells[0] + 1), np.linspace(-thickness, 0, cells[1] + 1))

    def allowed(corners: FloatArray) -> FloatArray:
        return fine + growth * np.hypot(np.maximum(corners[0] - strip, 0), corners[1]).min(axis=0)

    mesh = graded(mesh, allowed)
    mirrored = np.hstack([mesh.p, [[-1], [1]] * mesh.p]) + 0.0  # no -0.0, which unique would tell from 0.0
    points, shared = np.unique(mirrored, axis=1, return_inverse=True)
    cells = np.hstack([mesh.t, mesh.t + mesh.p.shape[1]])
    return MeshTri(np.ascontiguousarray(points), np.ascontiguousarray(shared[cells]))


def make_layer(
    mesh: MeshTri, body: Elastic, *, degree: int = 2, strip: float | None = None, sides: str = "periodic"
) -> Layer:
    """Return the layer on a mesh of a rectangle whose upper side is z = 0 (x = mesh.p[0], z = mesh.p[1]).

    Parameters
    ----------
    degree : 1 or 2, of the triangles
    strip : only nodes with ``|x| <= strip`` may carry force; None: all
    sides : "periodic", which needs nodes at the same depths on both sides, or "free"
    """
    fits = degree in ELEMENTS and sides in ("periodic", "free")
    require(fits, f"degree = {degree}, sides = {sides!r}", "1 or 2, 'periodic' or 'free'")
    (left, bottom) = mesh.p.min(axis=1)
    (right, top) = mesh.p.max(axis=1)
    near = NEAR * (top - bottom)
    require(abs(top) <= near, f"the surface lies at z = {top}", "0")
    basis = Basis(mesh, ElementVector(ELEMENTS[degree]()), intorder=2 * degree)
    spread = spread_matrix(basis, periodic=sides == "periodic")
    facets = mesh.facets_satisfying(lambda x: np.abs(x[1]) < near, boundaries_only=True)
    weights = LinearForm(lambda v, w: v[1]).assemble(basis.boundary(facets))
    vertical = basis.get_dofs(facets).all("u^2")
    x = basis.doflocs[0, vertical]
    inside = np.abs(x) <= (max(-left, right) if strip is None else strip) + near
    if sides == "periodic":
        inside &= x < right - near
    chosen = vertical[inside][np.argsort(x[inside])]
    unknowns = spread[chosen].tocsr().indices
    return Layer(
        body=body,
        basis=basis,
        spread=spread,
        x=basis.doflocs[0, chosen],
        weights=(spread.T @ weights)[unknowns],
        unknowns=unknowns,
    )


def spread_matrix(basis: Basis, *, periodic: bool) -> sp.csc_matrix:
    """Return (dofs, unknowns) with a 1 where a degree of freedom follows an unknown; rows of the base are empty."""
    x, z = basis.doflocs
    near = NEAR * np.ptp(z)
    follows = np.arange(basis.N)
    if periodic:
        component = np.zeros(basis.N, dtype=int)
        for dofs in (basis.nodal_dofs, basis.facet_dofs):
            component[dofs[1::2]] = 1
        masters, slaves = (np.flatnonzero(np.abs(x - end) < near) for end in (x.min(), x.max()))
        masters, slaves = (d[np.lexsort((z[d], component[d]))] for d in (masters, slaves))
        alike = masters.size == slaves.size and np.abs(z[masters] - z[slaves]).max() <= near
        require(alike, "a periodic layer with nodes at other depths on its two sides", "the same on both")
        follows[slaves] = masters
    free = np.flatnonzero((follows == np.arange(basis.N)) & (z > z.min() + near))
    number = np.full(basis.N, -1)
    number[free] = np.arange(free.size)
    rows = np.flatnonzero(number[follows] >= 0)
    return sp.csc_matrix((np.ones(rows.size), (rows, number[follows[rows]])), shape=(basis.N, free.size))
