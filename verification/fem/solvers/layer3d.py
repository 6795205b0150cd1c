"""Three-dimensional elastic layer, periodic in x and y and bonded to a rigid base, of hexahedra in equal columns.

Nodes form a grid: ``shape`` = (nx, ny) of them on the surface, and levels graded in depth. Every column of elements is
the same, so the element matrices of one column, made by scikit-fem, give the complete stiffness. Here it is assembled
and solved by conjugate gradients with smoothed aggregation. `layer_waves` solves the same discrete layer wave by wave.
Forces and displacements of the surface count positive downwards.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pyamg
import scipy.sparse as sp
from skfem import Basis, ElementHex1, ElementHex2, ElementVector, MeshHex
from skfem.models.elasticity import lame_parameters, linear_elasticity

from ...types import FloatArray
from .compliance import Elastic
from .report import CONVERGED, ITERATION_LIMIT, SolveReport, require

ELEMENTS = {1: ElementHex1, 2: ElementHex2}
RULES = {1: np.array([1.0]), 2: np.array([1 / 3, 2 / 3])}  # share of a cell's width by node, trapezoid and Simpson


@dataclass(frozen=True, kw_only=True)
class Layer3D:
    """What the layer is made of, and its grid.

    body : elastic constants
    size : (Lx, Ly) of one period in m
    levels : z of the element faces in m, ascending from -thickness to 0
    shape : surface nodes (nx, ny) of one period, multiples of ``degree``
    degree : 1 (trilinear) or 2 (triquadratic, 27 nodes)
    """

    body: Elastic
    size: tuple[float, float]
    levels: np.ndarray
    shape: tuple[int, int]
    degree: int = 1

    def __post_init__(self) -> None:
        levels = np.asarray(self.levels, dtype=float)
        object.__setattr__(self, "levels", levels)
        fits = self.degree in ELEMENTS and all(n >= 2 * self.degree and n % self.degree == 0 for n in self.shape)
        message = f"shape = {self.shape}, degree = {self.degree}"
        require(fits, message, "degree 1 or 2, nodes a multiple of the degree, two cells at least")
        ascending = levels.ndim == 1 and levels.size > 1 and bool(np.all(np.diff(levels) > 0)) and levels[-1] == 0
        message = f"size = {self.size}, levels = {levels}"
        require(min(self.size) > 0 and ascending, message, "lengths > 0, levels ascending to 0")

    @property
    def cells(self) -> tuple[int, int]:
        """Elements along x and y."""
        return self.shape[0] // self.degree, self.shape[1] // self.degree

    @property
    def cell_size(self) -> tuple[float, float]:
        """Widths of an element in m."""
        return self.size[0] / self.cells[0], self.size[1] / self.cells[1]

    @property
    def x(self) -> tuple[np.ndarray, np.ndarray]:
        """Surface nodes, (nx, 1) and (1, ny), from 0."""
        x, y = (np.arange(n) * s / n for n, s in zip(self.shape, self.size, strict=True))
        return x[:, None], y[None, :]

    @property
    def weights(self) -> np.ndarray:
        """(nx, ny) m^2, nodal force over nodal pressure: sums to the area of the period."""
        along = [np.tile(RULES[self.degree], c) * w for c, w in zip(self.cells, self.cell_size, strict=True)]
        return np.outer(*along)

    @property
    def planes(self) -> int:
        """Number of planes of nodes that can move."""
        return self.degree * (self.levels.size - 1)

    @property
    def unknowns(self) -> int:
        """Number of degrees of freedom of the assembled layer."""
        return 3 * self.shape[0] * self.shape[1] * self.planes

    @cached_property
    def elements(self) -> tuple[np.ndarray, np.ndarray]:
        """(stiffness (layers, dofs, dofs), nodes (4, dofs)) of the elements of a column from the base up.

        ``nodes`` says where each degree of freedom sits: ix, iy, iz from the element's lowest corner, 0 to
        ``degree``, and the component.
        """
        (hx, hy) = self.cell_size
        z = self.levels
        mesh = MeshHex.init_tensor(np.array([0, hx]), np.array([0, hy]), z)
        basis = Basis(mesh, ElementVector(ELEMENTS[self.degree]()), intorder=2 * self.degree)
        component = np.zeros(basis.N, dtype=int)
        for dofs in (basis.nodal_dofs, basis.edge_dofs, basis.facet_dofs, basis.interior_dofs):
            for row, numbers in enumerate(dofs):
                component[numbers] = row % 3
        form = linear_elasticity(*lame_parameters(self.body.young, self.body.poisson))
        upwards = np.argsort(z.searchsorted(mesh.p[2, mesh.t].mean(axis=0)))
        dofs = basis.element_dofs[:, upwards]
        low = np.stack([0 * z[:-1], 0 * z[:-1], z[:-1]])
        step = np.stack(np.broadcast_arrays(hx, hy, np.diff(z))) / self.degree
        at = np.round((basis.doflocs[:, dofs] - low[:, None]) / step[:, None]).astype(int)
        nodes = np.concatenate([at, component[None, dofs]])
        if np.any(nodes != nodes[:, :, :1]):
            raise AssertionError("scikit-fem numbers the elements of a column in different ways")
        return form.coo_data(basis).tolocal()[upwards], nodes[:, :, 0]


def graded_levels(thickness: float, layers: int, ratio: float) -> np.ndarray:
    """Return levels from -thickness to 0, with ``layers`` heights that grow geometrically downwards.

    The last height is about ``ratio`` times the first. Twice the layers at the same ratio halve every height.
    """
    fits = thickness > 0 and layers >= 1 and ratio >= 1
    require(fits, f"thickness {thickness}, layers {layers}, ratio {ratio}", "> 0, >= 1, >= 1")
    xi = np.linspace(1, 0, layers + 1)
    return -thickness * (xi if ratio == 1 else np.expm1(xi * np.log(ratio)) / (ratio - 1))


def stiffness(layer: Layer3D) -> sp.bsr_matrix:
    """Return (unknowns, unknowns) in N/m, numbered by plane from the base up, then ix, iy and component."""
    nx, ny = layer.shape
    corner = [layer.degree * np.arange(c)[:, None, None] for c in layer.cells]
    total = sp.csr_matrix((layer.unknowns, layer.unknowns))
    matrices, (ix, iy, iz, component) = layer.elements
    for number, matrix in enumerate(matrices):
        plane = number * layer.degree + iz - 1  # the base would be plane -1
        node = (plane * nx + (corner[0] + ix) % nx) * ny + (corner[1].transpose(1, 0, 2) + iy) % ny
        kept = plane >= 0
        rows = (3 * node + component).reshape(-1, ix.size)[:, kept]
        values = np.broadcast_to(matrix[np.ix_(kept, kept)], (rows.shape[0], kept.sum(), kept.sum()))
        columns = np.broadcast_to(rows[:, None, :], values.shape)
        rows = np.broadcast_to(rows[:, :, None], values.shape)
        total = total + sp.coo_matrix((values.ravel(), (rows.ravel(), columns.ravel())), shape=total.shape).tocsr()
    return total.tobsr((3, 3))


def rigid_body_modes(layer: Layer3D) -> np.ndarray:
    """Return (unknowns, 6): three translations and three rotations about the middle of the layer, each of unit length.

    A rotation does not fit together across the period. But each aggregate of nodes needs it only locally.
    """
    x, y = layer.x
    q = layer.degree
    z = np.interp(np.arange(1, layer.planes + 1) / q, np.arange(layer.levels.size), layer.levels)
    x, y, z = (c - c.mean() for c in np.broadcast_arrays(x[None], y[None], z[:, None, None]))
    ones = np.ones_like(x)
    zeros = np.zeros_like(x)
    modes = [
        (ones, zeros, zeros),
        (zeros, ones, zeros),
        (zeros, zeros, ones),
        (zeros, -z, y),
        (z, zeros, -x),
        (-y, x, zeros),
    ]
    B = np.array([np.stack(m, axis=-1).ravel() for m in modes]).T
    return B / np.linalg.norm(B, axis=0)


@dataclass(frozen=True)
class LayerSolution:
    """``displacement`` (planes from the base up, nx, ny, 3) in m, with z upwards, and ``report``, a `SolveReport`."""

    displacement: np.ndarray
    report: SolveReport

    @property
    def surface(self) -> np.ndarray:
        """(nx, ny) downward displacement of the surface."""
        return -self.displacement[-1, :, :, 2]


@dataclass(frozen=True)
class Multigrid:
    """The assembled layer and its hierarchy, which can be used for several loads."""

    layer: Layer3D
    matrix: sp.bsr_matrix
    hierarchy: pyamg.MultilevelSolver


def multigrid(layer: Layer3D, modes: np.ndarray | None = None) -> Multigrid:
    """Return the multigrid hierarchy of a layer, by smoothed aggregation on the rigid-body modes (P. Vanek, J. Mandel &
    M. Brezina, Computing 56 (1996) 179-196, doi:10.1007/BF02238511).

    ``modes`` replaces the near-null space, to see what becomes of the solve without it.
    """
    matrix = stiffness(layer)
    B = rigid_body_modes(layer) if modes is None else modes
    hierarchy = pyamg.smoothed_aggregation_solver(
        matrix, B=B, strength=("symmetric", {"theta": 0.0}), smooth=("jacobi", {"omega": 4 / 3}), max_coarse=50
    )
    return Multigrid(layer, matrix, hierarchy)


def solve(grid: Multigrid, force: FloatArray, *, tolerance: float = 1e-8, max_iterations: int = 100) -> LayerSolution:
    """Return displacement of the assembled layer under nodal surface forces (nx, ny) in N, downwards.

    The stopping test, made here on the returned displacement and not taken from the iteration: ``|f - K u|/|f|`` in the
    2-norm <= tolerance. Raises `SolveError` with report and result otherwise.
    """
    layer = grid.layer
    force = np.asarray(force, dtype=float)
    fits = force.shape == layer.shape and bool(np.all(np.isfinite(force)) and np.any(force))
    require(fits, f"force has shape {force.shape}", f"{layer.shape}, finite, not all zero, N")
    surface = np.zeros((layer.planes, *layer.shape, 3))
    surface[-1, :, :, 2] = -force
    load = surface.ravel()
    history: list[float] = []
    limits = {"tol": 0.1 * tolerance, "maxiter": max_iterations}
    result = grid.hierarchy.solve(load, **limits, accel="cg", residuals=history)
    scale = float(np.linalg.norm(load))
    residual = float(np.linalg.norm(load - grid.matrix @ result)) / scale
    status = CONVERGED if residual <= tolerance else ITERATION_LIMIT
    solver = "smoothed aggregation, conjugate gradients"
    past = tuple(r / scale for r in history)
    report = SolveReport(
        solver=solver,
        status=status,
        iterations=len(history) - 1,
        tolerance=tolerance,
        residuals={"equilibrium": residual},
        history=past,
    )
    return report.checked(LayerSolution(result.reshape(layer.planes, *layer.shape, 3), report))
