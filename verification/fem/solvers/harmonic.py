"""Elastic body under pressures that are periodic along y: finite elements in the section (x, z), waves along y.

For a pressure ``p(x) cos(k y)`` the displacement is ``u_x, u_z ~ cos(k y)``, ``u_y ~ sin(k y)``. So elasticity in
three dimensions becomes one problem in the section for each wavenumber k. Its unknowns are the three amplitudes, and k
appears in the strains (the semi-analytical form: O. C. Zienkiewicz, The Finite Element Method, 3rd ed. 1977). P2
triangles on a square of side D, its bottom fixed and its sides free, represent the half-space. The error is a constant
and a part that falls like 1/D^2 for k = 0, and exp(-k D/2) for every other k.

Pressure is constant on the cells of a patch along x, and the compliance gives mean displacements of the cells. So it is
symmetric. Along y cells are points of a trigonometric series, as in any contact solver by Fourier transforms.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp
from scipy import fft
from skfem import Basis, BilinearForm, ElementTriP2, ElementVector, MeshTri

from ...types import FloatArray, Option
from .compliance import Elastic
from .contact import Contact, solve_contact
from .report import require
from .triangles import factorised, graded

if TYPE_CHECKING:
    from skfem.assembly.form.form import FormExtraParams
    from skfem.element.discrete_field import DiscreteField


SIDE = 12  # that of the square body is dx 2^SIDE
GROWTH = 0.5  # of the cells, per distance from the patch


@dataclass(frozen=True)
class HarmonicStrip:
    """A patch of ``shape`` (nx, ny) cells of ``spacing`` (dx, dy) m, centred on x = 0 and repeated along y. nx is even.

    fineness : each cell along x is 2^fineness facets
    """

    shape: tuple[int, int]
    spacing: tuple[float, float]
    body: Elastic
    fineness: int = 1

    def __post_init__(self) -> None:
        message = f"shape = {self.shape}, spacing = {self.spacing} m, fineness = {self.fineness}"
        fits = not self.shape[0] % 2 and min(self.shape) >= 2 and min(self.spacing) > 0
        require(fits and 8 * self.shape[0] <= 1 << SIDE, message, f"nx even, 2 to {(1 << SIDE) // 8} cells, > 0 m")
        require(0 <= self.fineness <= 4, message, "fineness 0 to 4")

    @property
    def half(self) -> float:
        """Half the length of the patch along x, m."""
        return self.shape[0] * self.spacing[0] / 2


@dataclass(frozen=True)
class Compliance:
    """Mean displacements of cells (m, downwards) per pressure (Pa).

    ``harmonics`` (ny//2 + 1, nx, nx) has one for each wave along y. ``unknowns`` are those of each system that was
    solved.
    """

    strip: HarmonicStrip
    harmonics: np.ndarray
    unknowns: int

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        """Return displacement (nx, ny) under a pressure (nx, ny)."""
        waves = fft.rfft(pressure, axis=1)
        return fft.irfft(np.einsum("mij,jm->im", self.harmonics, waves), n=self.strip.shape[1], axis=1)


def press(
    compliance: Compliance,
    gap0: np.ndarray,
    load_per_width: float,
    *,
    hardness: float = math.inf,
    **options: Option,
) -> Contact:
    """Return `contact.solve_contact` of the strip: ``gap0`` and the fields of the result are (nx, ny), the load is in
    N/m."""
    (nx, ny) = compliance.strip.shape
    (dx, dy) = compliance.strip.spacing
    most = hardness * nx * dx
    fits = gap0.shape == (nx, ny) and 0 < load_per_width < most
    require(fits, f"gap0 has shape {gap0.shape}, {load_per_width = } N/m", f"{(nx, ny)}, 0 to {most:g}")

    def displacement(force: np.ndarray) -> np.ndarray:
        return compliance.apply(force.reshape(nx, ny) / (dx * dy)).ravel()

    limit = hardness if math.isfinite(hardness) else None
    cells = np.full(gap0.size, dx * dy)
    solution = solve_contact(displacement, cells, gap0.ravel(), load_per_width * ny * dy, limit=limit, **options)
    fields = ("pressure", "gap", "displacement", "touching", "saturated")
    return replace(solution, **{name: getattr(solution, name).reshape(nx, ny) for name in fields})


def compliance(strip: HarmonicStrip) -> Compliance:
    """Return the compliance of the surface: factorise and solve once for every wave along y."""
    mesh = graded_mesh(strip)
    basis = Basis(mesh, ElementVector(ElementTriP2(), 3), intorder=4)
    depth = -mesh.p[1].min()
    free = np.setdiff1d(np.arange(basis.N), basis.get_dofs(lambda x: x[1] < -depth * (1 - 1e-9)).all())
    unit = 1 / strip.spacing[0]
    constant, linear, square = (part[free][:, free] for part in stiffness(basis, strip.body, unit))
    loads = cell_loads(strip, mesh, basis)[free]
    dense = loads.toarray()
    waves = 2 * np.pi * np.arange(strip.shape[1] // 2 + 1) / (strip.shape[1] * strip.spacing[1])
    harmonics = [unit * loads.T @ factorised(constant + k * linear + k**2 * square).solve(dense) for k in waves / unit]
    return Compliance(strip, np.array(harmonics), free.size)


def graded_mesh(strip: HarmonicStrip) -> MeshTri:
    """Return triangles, none longer than ``hypot(diagonal of the finest, growth * distance from the patch)``."""
    dx = strip.spacing[0]
    side = dx * 2**SIDE
    mesh = MeshTri.init_tensor(np.linspace(-side / 2, side / 2, 9), np.linspace(-side, 0, 9))
    fine = 1.001 * np.sqrt(2) * dx / 2**strip.fineness

    def allowed(corners: FloatArray) -> FloatArray:
        aside = np.maximum(np.abs(corners[0]) - strip.half, 0)
        return np.hypot(fine, GROWTH * np.hypot(aside, corners[1]).min(axis=0))

    return graded(mesh, allowed)


def stiffness(basis: Basis, body: Elastic, unit: float) -> tuple[sp.csr_matrix, sp.csr_matrix, sp.csr_matrix]:
    """Return (A, B, C) of the stiffness ``A + k B + k^2 C`` at the wavenumber ``k unit``."""
    lame = body.young * body.poisson / ((1 + body.poisson) * (1 - 2 * body.poisson))
    shear = body.young / (2 * (1 + body.poisson))

    @BilinearForm
    def energy(u: DiscreteField, v: DiscreteField, w: FormExtraParams) -> FloatArray:
        (ux, uz, uy, *u_shears) = strains(u, w.k)
        (vx, vz, vy, *v_shears) = strains(v, w.k)
        direct = lame * (ux + uz + uy) * (vx + vz + vy) + 2 * shear * (ux * vx + uz * vz + uy * vy)
        return direct + shear * sum(a * b for a, b in zip(u_shears, v_shears, strict=True))

    at = {k: energy.assemble(basis, k=k * unit) for k in (-1, 0, 1)}
    return at[0], (at[1] - at[-1]) / 2, (at[1] + at[-1]) / 2 - at[0]


def strains(u: DiscreteField, k: float) -> tuple[FloatArray, ...]:
    """Return amplitudes of e_xx, e_zz, e_yy, and of the shears xz, xy, zy; components of u are x, z, y."""
    g = u.grad
    return g[0, 0], g[1, 1], k * u[2], g[0, 1] + g[1, 0], g[2, 0] - k * u[0], g[2, 1] - k * u[1]


def cell_loads(strip: HarmonicStrip, mesh: MeshTri, basis: Basis) -> sp.csr_matrix:
    """Return (degrees of freedom, nx): forces of 1 Pa, downwards, on each cell of the patch."""
    top = mesh.facets_satisfying(lambda x: np.abs(x[1]) < 1e-9 * np.abs(mesh.p[1]).max(), boundaries_only=True)
    ends = mesh.p[0, mesh.facets[:, top]]
    inside = np.abs(ends.mean(axis=0)) < strip.half
    top = top[inside]
    ends = ends[:, inside]
    cell = np.floor((ends.mean(axis=0) + strip.half) / strip.spacing[0]).astype(int)
    edges = (cell[None] + np.array([[0], [1]])) * strip.spacing[0] - strip.half
    overhang = max(np.max(edges[0] - ends.min(axis=0)), np.max(ends.max(axis=0) - edges[1]))
    if overhang > 1e-6 * strip.spacing[0]:
        raise AssertionError("a facet of the mesh crosses the edge of a cell")
    length = np.abs(np.diff(ends, axis=0))[0]
    rows = np.concatenate([*basis.nodal_dofs[1, mesh.facets[:, top]], basis.facet_dofs[1, top]])
    weights = np.concatenate([length / 6, length / 6, 4 * length / 6])  # Simpson: exact for P2
    return sp.csr_matrix((-weights, (rows, np.tile(cell, 3))), shape=(basis.N, strip.shape[0]))
