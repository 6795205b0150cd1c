"""The elastic body of the full-system line contact: its mesh, its stiffness, and the surface that carries the film.

One body represents both. It is in plane strain, with E = E' (1 - nu^2)/2, so that its half-space compliance is that of
E' (2/E' = sum (1 - nu^2)/E over the two). Lengths are in Hertz half-widths b, displacements in b^2/R, stresses in p_h.
In these units E' is 4.

A square below the contact represents the half-space, its bottom fixed and its sides free (Habchi, Eyheramendy, Vergne
& Morales-Espejel 2008, doi:10.1115/1.2842246). Compared with a half-space, its surface has an additional curvature
that falls like (b/D)^2 with its side D, and a constant displacement, which the approach compensates.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import SuperLU
from scipy.spatial import cKDTree
from skfem import Basis, BilinearForm, ElementLineP2, ElementTriP2, ElementVector, MeshLine, MeshTri
from skfem.models.elasticity import lame_parameters, linear_elasticity

from ...types import FloatArray
from .triangles import factorised, graded, section_stress

POISSON = 0.3  # ratio of the elastic body; with `YOUNG` its E' is 4
YOUNG = 2 * (1 - POISSON**2)
NEAR = 1e-9  # of the side: the same point
QUARTERS = np.array([(i, j) for i in range(5) for j in range(5 - i)]).T / 4  # P2 nodes of the four parts of a triangle


@dataclass(frozen=True, kw_only=True)
class Layout:
    """Where the mesh is fine. Lengths are in b.

    side : D of the square body
    inlet, outlet : ends of the surface that carries the film
    edges : where pressure rises and where the film ruptures
    fine : cell length there
    growth : cell length per distance from there
    between : longest cell of the surface between the edges
    """

    side: float
    inlet: float
    outlet: float
    edges: tuple[float, float]
    fine: float
    growth: float
    between: float = math.inf


def graded_mesh(layout: Layout) -> tuple[MeshTri, Layout]:
    """Return triangles on ``[-D/2, D/2] x [-D, 0]``, split until none is longer than ``hypot(fine, growth *
    distance)``, nor than ``hypot(between, growth * distance)`` from the surface between the edges.

    The layout that is returned has the ends of the film moved outwards to vertices.
    """
    half = layout.side / 2
    mesh = MeshTri.init_tensor(np.linspace(-half, half, 9), np.linspace(-layout.side, 0, 9))

    def allowed(corners: FloatArray) -> FloatArray:
        distance = np.min([np.hypot(corners[0] - e, corners[1]).min(axis=0) for e in layout.edges], axis=0)
        away = corners[0] - np.clip(corners[0], *layout.edges)
        inside = np.hypot(layout.between, layout.growth * np.hypot(away, corners[1]).min(axis=0))
        return np.minimum(np.hypot(layout.fine, layout.growth * distance), inside)

    mesh = graded(mesh, allowed)
    x = np.sort(mesh.p[0, np.abs(mesh.p[1]) < NEAR * layout.side])
    return mesh, replace(
        layout, inlet=float(x[np.searchsorted(x, layout.inlet) - 1]), outlet=float(x[np.searchsorted(x, layout.outlet)])
    )


@dataclass(frozen=True, kw_only=True)
class Body:
    """The discrete body and the line on top of it.

    basis : P2 displacement on the body; ``free`` are its degrees of freedom off the bottom
    line : P2 on the surface that carries the film
    stiffness : (free, free)
    traction : (free, line) ``integral P v_z`` for a pressure P on the line
    trace : (line, free) upward displacement at the degrees of freedom of the line
    """

    basis: Basis
    line: Basis
    free: np.ndarray
    stiffness: sp.csc_matrix
    traction: sp.csc_matrix
    trace: sp.csc_matrix

    @property
    def x(self) -> np.ndarray:
        """Coordinates of the degrees of freedom of the line."""
        return self.line.doflocs[0]

    @cached_property
    def factors(self) -> SuperLU:
        """Factors of the stiffness alone."""
        return factorised(self.stiffness)

    @cached_property
    def order(self) -> np.ndarray:
        """An order of elimination with little fill, found once for every matrix that holds this stiffness."""
        return np.argsort(self.factors.perm_c)

    @cached_property
    def compliance(self) -> np.ndarray:
        """(line, line): how far the surface goes down, per pressure at the degrees of freedom of the line."""
        return self.trace @ self.factors.solve(self.traction.toarray())

    def displacement(self, pressure: np.ndarray) -> np.ndarray:
        """Return displacement at the free degrees of freedom of the body under a pressure on the line."""
        return -self.factors.solve(self.traction @ pressure)

    def everywhere(self, displacement: np.ndarray) -> np.ndarray:
        """Return displacement at all degrees of freedom of ``basis``."""
        full = np.zeros(self.basis.N)
        full[self.free] = displacement
        return full

    def stress(self, displacement: np.ndarray) -> np.ndarray:
        """Return (3, vertices): sigma_xx, sigma_zz, sigma_xz, projected on continuous linear functions."""
        return section_stress(self.basis, self.everywhere(displacement), YOUNG, POISSON)


def make_body(mesh: MeshTri, layout: Layout) -> Body:
    """Return the body on a `graded_mesh` or a uniform refinement of it."""
    basis = Basis(mesh, ElementVector(ElementTriP2()), intorder=2)
    near = NEAR * layout.side
    free = np.setdiff1d(np.arange(basis.N), basis.get_dofs(lambda x: x[1] < near - layout.side).all())
    stiffness = linear_elasticity(*lame_parameters(YOUNG, POISSON)).assemble(basis)[free][:, free]
    x = np.sort(mesh.p[0, np.abs(mesh.p[1]) < near])
    x = x[(x > layout.inlet - near) & (x < layout.outlet + near)]
    line = Basis(MeshLine(x), ElementLineP2(), intorder=8)
    trace = trace_matrix(basis, line)[:, free]
    mass = BilinearForm(lambda u, v, w: u * v).assemble(line)
    return Body(
        basis=basis,
        line=line,
        free=free,
        stiffness=stiffness.tocsc(),
        traction=(trace.T @ mass).tocsc(),
        trace=trace.tocsc(),
    )


def trace_matrix(basis: Basis, line: Basis) -> sp.csr_matrix:
    """Return (line, body): picks the vertical displacement at every degree of freedom of the line."""
    near = NEAR * np.ptp(basis.mesh.p[1])
    vertical = basis.get_dofs(lambda x: np.abs(x[1]) < near).all("u^2")
    at = basis.doflocs[0, vertical]
    ascending = np.argsort(at)
    result = ascending[np.searchsorted(at[ascending], line.doflocs[0] - near)]
    if np.abs(at[result] - line.doflocs[0]).max() > near:
        raise AssertionError("the line is not made of the facets of the body")
    return sp.csr_matrix((np.ones(line.N), (np.arange(line.N), vertical[result])), shape=(line.N, basis.N))


def refined_displacement(coarse: Body, fine: Body, displacement: np.ndarray) -> np.ndarray:
    """Return a displacement on the uniform refinement of the mesh, exactly."""
    lattice = Basis(coarse.basis.mesh, coarse.basis.elem, quadrature=(QUARTERS, np.ones(QUARTERS.shape[1])))
    values = np.asarray(lattice.interpolate(coarse.everywhere(displacement))).reshape(2, -1)
    points = np.asarray(lattice.global_coordinates()).reshape(2, -1)
    away, nearest = cKDTree(points.T).query(fine.basis.doflocs.T)
    if away.max() > NEAR * np.ptp(points[1]):
        raise AssertionError("the fine mesh is not the uniform refinement of the coarse one")
    component = np.zeros(fine.basis.N, dtype=int)
    component[fine.basis.nodal_dofs[1]] = 1
    component[fine.basis.facet_dofs[1]] = 1
    return values[component, nearest][fine.free]
