"""The film in a rough gap that is given on cells: Reynolds' equation on triangles.

The gap comes as numbers at the centres of cells (x along the motion, y periodic and symmetric about its ends and its
middle). It is linear between them, and goes on upstream as a parabola. Spots of contact may come with their pressure,
which is then prescribed. Half of the period is meshed, because no flow passes the planes of symmetry.
"""

from dataclasses import dataclass

import numpy as np
import skfem
from scipy.interpolate import LinearNDInterpolator

from ...types import FloatArray
from .fluid import Fluid
from .report import require
from .reynolds import ReynoldsProblem, ReynoldsSolution, solve_reynolds

FAR = 30.0  # length upstream that is meshed, in lengths of the given gap upstream
COARSE = 160  # cells of it, geometrically longer
SYMMETRY = 1e-6  # of the largest gap: by so much a gap may differ from its mirror image


@dataclass(frozen=True, kw_only=True)
class GivenGap:
    """A gap that is given on cells.

    x, spacing : (nx,) [m] centres of the cells; dy [m]
    gap, pressure : (nx, ny) [m], [Pa]
    contact : (nx, ny) where the pressure is prescribed
    radius, log : [m] of h = h_first + (x² - x_first²)/(2R) - log ln(x/x_first) upstream
    """

    x: np.ndarray
    dy: float
    gap: np.ndarray
    pressure: np.ndarray
    contact: np.ndarray
    radius: float
    log: float

    def __post_init__(self) -> None:
        off = np.abs(self.gap - self.gap[:, ::-1]).max()
        require(off <= SYMMETRY * self.gap.max(), "gap is not symmetric along y", "one that is its own mirror image")

    @property
    def width(self) -> float:
        """Half of the period [m]."""
        return float(0.5 * self.gap.shape[1] * self.dy)

    def film(self, points: FloatArray) -> np.ndarray:
        """Return h [m] at points (2, ...)."""
        x = points[0]
        first = self.x[0]
        inside = self._linear(self.gap, np.maximum(x, first), points[1])
        away = np.minimum(x, first)
        return inside + (away**2 - first**2) / (2 * self.radius) - self.log * np.log(away / first)

    def guess(self, points: FloatArray) -> np.ndarray:
        """Return the pressure that came with the gap [Pa]; zero upstream."""
        return np.where(
            points[0] >= self.x[0], self._linear(self.pressure, np.maximum(points[0], self.x[0]), points[1]), 0
        )

    def prescribed(self, points: FloatArray) -> np.ndarray:
        """Return the given pressure [Pa] on asperity contacts, NaN elsewhere."""
        step = self.x[1] - self.x[0]
        i = np.clip(np.rint((points[0] - self.x[0]) / step).astype(int), 0, self.x.size - 1)
        j = np.clip((points[1] / self.dy).astype(int), 0, self.gap.shape[1] - 1)
        return np.where(self.contact[i, j] & (points[0] >= self.x[0]), self.guess(points), np.nan)

    def _linear(self, field: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
        nx, ny = field.shape
        s = np.clip((x - self.x[0]) / (self.x[1] - self.x[0]), 0, nx - 1 - 1e-9)
        t = y / self.dy - 0.5
        i = np.floor(s).astype(int)
        j = np.floor(t).astype(int)
        s = s - i
        t = t - j
        j0 = j % ny
        j1 = (j + 1) % ny
        return (1 - s) * ((1 - t) * field[i, j0] + t * field[i, j1]) + s * (
            (1 - t) * field[i + 1, j0] + t * field[i + 1, j1]
        )


def mesh_of(given: GivenGap, cells: int) -> skfem.MeshTri:
    """Return triangles with about ``cells`` of them across the period."""
    step = 2 * given.width / cells
    first = given.x[0]
    last = given.x[-1]
    inner = np.linspace(first, last, int(round((last - first) / step)) + 1)
    far = first * np.geomspace(FAR, 1.0, COARSE + 1)[:-1]
    y = np.linspace(0.0, given.width, cells // 2 + 1)
    return skfem.MeshTri.init_tensor(np.concatenate([far, inner]), y)


@dataclass(frozen=True)
class RoughFilm:
    """The finite-element film.

    It has the load [N/m] and the flow [m²/s], per width, upstream of the given cells; the pressure [Pa] (nx, ny/2) at
    the centres of the given cells in the half that was meshed; and the solution.
    """

    upstream: float
    flow: float
    pressure: np.ndarray
    solution: ReynoldsSolution


def rough_film(given: GivenGap, fluid: Fluid, speed: float, *, cells: int) -> RoughFilm:
    """Solve for the pressure in ``given`` at the entrainment ``speed`` [m/s]. The film ruptures where it would pull."""
    width = given.width
    problem = ReynoldsProblem(
        mesh=mesh_of(given, cells),
        film=given.film,
        fluid=fluid,
        speed=speed,
        open_boundary=lambda middle: (middle[1] < 1e-9 * width) | (middle[1] > width * (1 - 1e-9)),
        given=given.prescribed if given.contact.any() else None,
        cavitation=True,
    )
    basis = skfem.Basis(problem.mesh, problem.element())
    start = np.maximum(given.guess(basis.doflocs), 0.0)
    solution = solve_reynolds(problem, start=start, tolerance=1e-6)
    edge = given.x[0] - 0.5 * (given.x[1] - given.x[0])
    upstream = skfem.Functional(lambda w: np.where(w.x[0] < edge, w.p, 0.0)).assemble(
        solution.basis, p=solution.pressure
    )
    flow = solution.inflow(problem.mesh.p[0].min())
    return RoughFilm(float(upstream) / width, flow / width, _at_cells(given, solution), solution)


def _at_cells(given: GivenGap, solution: ReynoldsSolution) -> np.ndarray:
    half = given.gap.shape[1] // 2
    y = (np.arange(half) + 0.5) * given.dy
    x, y = np.meshgrid(given.x, y, indexing="ij")
    return LinearNDInterpolator(solution.problem.mesh.p.T, solution.at_vertices)(x, y)
