"""One linear system of Newton's method: GMRES applies the dense K by FFT; the preconditioner is a sparse LU with its
diagonal.

Every cell has one unknown: p, the dent if it has yielded, or the fill if it has ruptured; h0 is one more. Through h
every cell depends on every pressure. ``R_p + R_h diag(K)`` is sparse, and near enough to that for a preconditioner.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from scipy.linalg import solve_triangular
from scipy.sparse import csc_matrix, csr_matrix
from scipy.sparse.linalg import splu

from ..._base import BoolArray, FloatArray, IntArray
from ...film import line_peak_pressure
from .flow import Stencil, derivatives
from .problem import Problem
from .state import RUPTURED, TOUCHING, Iterate, State, stored

# The comments state how results change with half and with twice the value of a constant, on the counted work of eight
# films, light, heavy, soft and moving (`python -m verification.campaigns.newton_constants
# lubfric.models.deterministic.linear.`).

# Residual of the linear system over its right side, at which GMRES ends [-]. Half and twice this value change the work
# by 1 %; 0.03 fails at 1 GPa and 0.03 m/s.
GMRES_RESIDUAL = 0.01

# Residual of the linear system over its right side, at which GMRES ends at rest where rows are scaled [-]. A roller of
# 1 GPa at 1, 0.3, 0.1, 0.03 m/s: 9, 9, -1 and 41 % less time than with `GMRES_RESIDUAL` in rows that are not scaled;
# light contacts 7 % more. Half and twice: 1 % more work.
SCALED_ACCURACY = 0.1

# Pressure-viscosity coefficient times Hertz pressure, from which on rows are scaled at rest [-]: 2 and 18 were
# measured. Half this value changes nothing, twice this value takes 11 % more work, 66 % at 1 GPa.
HIGH_PRESSURE = 10.0

# Diagonal of the scaled sparse part, below which a row is not scaled up further [-]: a guard against division by 0.
# Half and twice this value change nothing.
SMALLEST_DIAGONAL = 1e-12

# Coefficient of the sparse part over the diagonal of its row, below which the LU of a step in time that follows the
# lubricant omits it [-]. A roller of 1 GPa (162 x 64 cells) with 0, 0.01, 0.03, 0.1 takes 285, 291, 289, 510 Newton
# steps, and an LU 11.4, 10.6, 8.1, 4.6 ms; with 0.03 light, needle and gear contacts take as many steps as with 0, and
# 2 to 7 % fewer iterations of GMRES. At rest, where lubricant flows with U, 0.01 takes up to three times the steps.
OMITTED_COEFFICIENT = 0.03

# Iterations of GMRES, after which it begins anew [-]: a bound of its memory. Half and twice this value change nothing;
# some 10 are usual.
MOST_KRYLOV = 40

# Times that GMRES begins, at most [-]: a bound. Half and twice this value change nothing.
CYCLES = 3

# Length of the two entries that a rotation of GMRES turns, at least [-]: an image of length 0 has no direction. A
# choice, near the smallest number of double precision.
SMALLEST_PIVOT = 1e-300

# Columns that are eliminated together [-]: 1, 2, 4, 8 take 10.4, 10.5, 11.0, 11.6 ms on 10,368 cells.
PANEL = 1

# Cells that nested dissection does not cut again [-]: with 6, 12, 24, 48, 96 the LU of a five-point stencil on 162 x 64
# cells takes 8.8, 9.1, 9.3, 10.6, 12.3 ms.
UNCUT_CELLS = 6


@dataclass(frozen=True, kw_only=True)
class Change:
    """Changes of pressure [Pa], fill [-], dent [m], gap [m] (nx, ny) and h0 [m]."""

    pressure: np.ndarray
    fill: np.ndarray
    dent: np.ndarray
    gap: np.ndarray
    approach: float

    def added(self, state: State, part: float) -> State:
        """Return ``state`` with this ``part`` of the changes."""
        return replace(
            state,
            pressure=state.pressure + part * self.pressure,
            fill=state.fill + part * self.fill,
            dent=state.dent + part * self.dent,
            approach=state.approach + part * self.approach,
        )


class System:
    """The linear system at a state. Rows are scaled by U and a film, columns by a pressure, so that both have no
    dimension."""

    def __init__(self, at: Iterate):
        problem = at.problem
        state = at.state
        self.at = at
        self.film = max(at.mean_flow / problem.speed, problem.floor)
        self.row = 1.0 / (problem.speed * self.film / problem.spacing[0])
        self.touching = state.kind == TOUCHING
        ruptured = state.kind == RUPTURED
        dented = state.yielded
        self.to_pressure = np.where(ruptured | dented, 0.0, problem.load / (problem.spacing[0] * 64))
        self.to_dent = np.where(dented, self.film, 0.0)
        self.to_fill = np.where(ruptured, 1.0, 0.0)
        inlet = at.mass_balance.inlet
        shape = at.gap.shape
        by_p = np.full(shape, problem.spacing[0] / shape[1])
        by_p[0] += inlet.load_by_pressure
        # relative to the load
        self.load_by_p = by_p / problem.load
        self.load_by_h = inlet.load_by_film / problem.load
        by_p, by_h, by_fill = self._rows()
        patterns = Patterns.of(*shape)
        neighbours = Stencil.neighbours(*shape)
        by_own = self.to_pressure.ravel()[neighbours]
        local = by_p * by_own
        if dented.any():
            local += by_h * self.to_dent.ravel()[neighbours]
        if ruptured.any():
            local += by_fill * self.to_fill.ravel()[neighbours]
        together = local + by_h * (problem.self_deflection * by_own)
        self.local = patterns.rows(local)  # all but the deflection and h0
        self.by_h = patterns.rows(by_h)
        self.by_approach = self.by_h @ np.full(at.gap.size, self.film)
        flow_of_first_order(together, except_from=dented if at.history is None else None)
        self.order = patterns.order
        matrix = patterns.ordered(_notable(together) if follows_lubricant(at) else together)
        ordered = {"permc_spec": "NATURAL", "diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}
        try:
            self.lu = splu(matrix.astype(np.float32), panel_size=PANEL, **ordered)
            self.precision: type[np.floating] = np.float32
        except RuntimeError:  # singular to single precision
            self.lu = splu(matrix, panel_size=PANEL, **ordered)
            self.precision = np.float64
        diagonal = np.abs(together[Stencil.NAMES.index(0)].ravel())
        self.row_weights = np.append(1.0 / np.maximum(diagonal, SMALLEST_DIAGONAL), 1.0)
        self.load_row = (self.load_by_p * self.to_pressure).ravel()
        self.solved_column = self._inner(self.by_approach)
        self.schur = float(self.load_by_h.sum()) * self.film - float(self.load_row @ self.solved_column)

    def _rows(self) -> tuple[np.ndarray, ...]:
        """Return d(equation)/dp, d/dh and d/dfill of every cell, as the data of a `Stencil`."""
        at = self.at
        fluid = self.at.mass_balance.fluid
        fill = self.at.state.fill
        diagonal = Stencil.NAMES.index(0)
        open_ = ~self.touching  # also where h is still the floor: it is about to rise
        rows = derivatives(at.problem, at.mass_balance, open_)
        if at.history is not None:
            film = at.mass_balance.flow_gap
            rate = stored(at.mass, at.history)[1]
            by = fluid.density_slope * film * fill, fluid.density * open_ * fill, fluid.density * film
            for data, mass in zip(rows, by):
                data[diagonal] += mass * rate
        for data in rows:
            data *= np.where(self.touching, 0.0, self.row)
        rows[1][diagonal] += self.touching / self.film
        return rows

    def _inner(self, rows: FloatArray) -> FloatArray:
        inner = np.empty_like(rows)
        inner[self.order] = self.lu.solve(rows[self.order].astype(self.precision))
        return inner

    def change(self, unknowns: FloatArray) -> Change:
        """Return the `Change` of scaled ``unknowns`` (n + 1,)."""
        cells = unknowns[:-1].reshape(self.at.gap.shape)
        approach = float(unknowns[-1] * self.film)
        pressure, fill, dent = (cells * scale for scale in (self.to_pressure, self.to_fill, self.to_dent))
        return Change(
            pressure=pressure,
            fill=fill,
            dent=dent,
            gap=self.at.problem.operator.apply(pressure) + dent + approach,
            approach=approach,
        )

    def equations(self, at: Iterate) -> np.ndarray:
        """Return by how much the state of ``at`` misses the equations of this system (n + 1,): mass of fluid cells,
        gap of touching ones, load."""
        rows = np.where(self.touching, (at.gap - at.problem.floor) / self.film, at.residual * self.row)
        return np.append(rows.ravel(), at.load_error / at.problem.load)

    def apply(self, unknowns: FloatArray) -> FloatArray:
        """Return the Jacobian times scaled unknowns."""
        cells = unknowns[:-1]
        pressure = cells.reshape(self.at.gap.shape) * self.to_pressure
        deflection = self.at.problem.operator.apply(pressure)
        rows = self.local @ cells + self.by_h @ deflection.ravel() + unknowns[-1] * self.by_approach
        first_gap = deflection[0] + cells[: deflection.shape[1]] * self.to_dent[0] + unknowns[-1] * self.film
        return np.append(rows, float((self.load_by_p * pressure).sum() + self.load_by_h @ first_gap))

    def precondition(self, rows: FloatArray) -> FloatArray:
        """Apply the inverse of the sparse part, bordered by h0 and the load, to ``rows``."""
        inner = self._inner(rows[:-1])
        approach = (rows[-1] - float(self.load_row @ inner)) / self.schur
        return np.append(inner - approach * self.solved_column, approach)

    def solve(self, accuracy: float = GMRES_RESIDUAL) -> tuple[Change, int]:
        """Return the Newton step, and the iterations of GMRES.

        The right side is minus the `equations` at the state. GMRES ends at a residual of ``accuracy`` times the right
        side. In a step in time, and at rest where the pressure is high (`HIGH_PRESSURE`), each row counts by the
        diagonal of its sparse part in that norm: a cell at high pressure has coefficients that are larger by the
        viscosity.
        """
        at = self.at
        right = -self.equations(at)
        weights = self.row_weights
        if at.history is None and not has_high_pressure(at.problem):
            unknowns, iterations = gmres(self.apply, self.precondition, right, accuracy)
        else:
            accuracy = SCALED_ACCURACY if at.history is None else accuracy
            unknowns, iterations = gmres(
                lambda unknowns: weights * self.apply(unknowns),
                lambda rows: self.precondition(rows / weights),
                weights * right,
                accuracy,
            )
        return self.change(unknowns), iterations


def flow_of_first_order(data: FloatArray, except_from: BoolArray | None = None) -> None:
    """Let the coefficients ``data`` (6, nx, ny) of the cell two cells upstream count for the next one, in place, but
    where that cell is in ``except_from`` (nx, ny).

    The Couette flow of the preconditioner then is first-order upwind: its LU has half the entries, and its single
    precision loses less. A roller of 1 GPa at rest at 10, 3, 1, 0.3 m/s takes 99, 300, 555, 763 iterations of GMRES
    with the second-order flow, and 93, 232, 441, 788 with this one, in 22 % less time. Cells that have yielded are
    excepted: the unknown there is a dent, which nothing but this flow joins to the next cells. On 261 x 64 cells of a
    measured map, of which 0.5 % have yielded, 869 iterations in 33 Newton steps become 61 in 15.
    """
    far = Stencil.NAMES.index("WW")
    replaced = data[far].copy()
    if except_from is not None:
        replaced[2:][except_from[:-2]] = 0.0
    data[Stencil.NAMES.index("W")] += replaced
    data[far] -= replaced


def _notable(data: FloatArray) -> np.ndarray:
    """Return the coefficients ``data`` (6, nx, ny) with zeros where one is smaller than `OMITTED_COEFFICIENT` of the
    cell's own."""
    diagonal = Stencil.NAMES.index(0)
    size = np.abs(data)
    least = OMITTED_COEFFICIENT * size[diagonal]
    notable = size >= least
    notable[diagonal] = True
    return np.where(notable, data, 0.0)


def has_high_pressure(problem: Problem) -> bool:
    """Return whether the viscosity at the Hertz pressure is larger by more than exp(`HIGH_PRESSURE`)."""
    pressure = line_peak_pressure(problem.load, problem.radius, problem.e_prime)
    return problem.lubricant.pressure_viscosity_coefficient * pressure > HIGH_PRESSURE


def gmres(
    apply: Callable[..., Any],
    precondition: Callable[..., Any],
    right: FloatArray,
    accuracy: float = GMRES_RESIDUAL,
    most: int = MOST_KRYLOV,
    cycles: int = CYCLES,
) -> tuple[np.ndarray, int]:
    """Solve ``apply(x) = right`` by right-preconditioned GMRES until |residual| <= accuracy |right|; restarted after
    ``most`` iterations, in all ``cycles`` times begun.

    Y. Saad, M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856-869, doi:10.1137/0907058. Returns x and the
    iterations. ``scipy.sparse.linalg.gmres`` on the preconditioned operator takes 885 products for 378, and 1.3 times
    as long, on the scene "paper" at 0.003, 0.03 and 0.1 m/s.
    """
    size = np.linalg.norm(right)
    x = np.zeros_like(right)
    count = 0
    if size == 0:
        return x, 0
    residual = right.copy()
    basis = np.empty((most + 1, right.size))
    directions = np.empty((most, right.size))
    for _ in range(cycles):
        beta = np.linalg.norm(residual)
        basis[0] = residual / beta
        hessenberg = np.zeros((most + 1, most))
        reduced = np.zeros((most, most))  # upper triangle: the Hessenberg matrix after its Givens rotations
        rotations: list[tuple[float, float]] = []
        target = [beta]
        for k in range(most):
            directions[k] = precondition(basis[k])
            image = apply(directions[k])
            along = basis[: k + 1] @ image
            image = image - along @ basis[: k + 1]
            hessenberg[: k + 1, k] = along
            size_of_image = float(np.linalg.norm(image))
            hessenberg[k + 1, k] = size_of_image
            count += 1
            column = along.tolist()
            for j, (cosine, sine) in enumerate(rotations):
                upper = cosine * column[j] + sine * column[j + 1]
                column[j + 1] = cosine * column[j + 1] - sine * column[j]
                column[j] = upper
            radius = max(math.hypot(column[k], size_of_image), SMALLEST_PIVOT)
            cosine = column[k] / radius
            sine = size_of_image / radius
            rotations.append((cosine, sine))
            column[k] = radius
            reduced[: k + 1, k] = column
            target.append(-sine * target[k])
            target[k] *= cosine
            basis[k + 1] = image / max(size_of_image, SMALLEST_PIVOT)
            if abs(target[k + 1]) <= 0.5 * accuracy * size or size_of_image <= 1e-14 * beta:
                break
        y = solve_triangular(reduced[: k + 1, : k + 1], target[: k + 1], check_finite=False)
        left = -(hessenberg[: k + 2, : k + 1] @ y)
        left[0] += beta
        x = x + y @ directions[: k + 1]
        residual = left @ basis[: k + 2]
        if np.linalg.norm(residual) <= accuracy * size:
            break
    return x, count


@dataclass(frozen=True)
class Patterns:
    """Where the coefficients of a `Stencil` are in sparse matrices, and the ``order`` of elimination. A pattern has
    the places of its entries in the data, their indices, and the first of each row (or column)."""

    order: np.ndarray
    by_row: tuple[np.ndarray, np.ndarray, np.ndarray]
    in_order: tuple[np.ndarray, np.ndarray, np.ndarray]

    @staticmethod
    @lru_cache(maxsize=8)
    def of(nx: int, ny: int) -> Patterns:
        """Return the patterns of a grid (nx, ny)."""
        order = nested_dissection(nx, ny)
        column = Stencil.neighbours(nx, ny).reshape(-1, nx * ny)
        row = np.broadcast_to(np.arange(nx * ny), column.shape)
        place = np.empty_like(order)
        place[order] = np.arange(order.size)
        return Patterns(order, _pattern(row, column), _pattern(place[column], place[row]))

    def rows(self, data: FloatArray) -> csr_matrix:
        """Return the matrix of the coefficients ``data`` (6, nx, ny)."""
        return self._made(csr_matrix, self.by_row, data)

    def ordered(self, data: FloatArray) -> csc_matrix:
        """Return the matrix with rows and columns in the order of elimination, without zeros: they would fill in."""
        matrix = self._made(csc_matrix, self.in_order, data).copy()
        matrix.eliminate_zeros()  # in place
        return matrix

    def _made(
        self, kind: type, pattern: tuple[IntArray, IntArray, IntArray], data: FloatArray
    ) -> csc_matrix | csr_matrix:
        entries, indices, first = pattern
        return kind((data.ravel()[entries], indices, first), shape=(self.order.size,) * 2)


def _pattern(lines: IntArray, across: IntArray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the pattern of entries (6, n) on the ``lines`` of a matrix, sorted by them."""
    entries = np.lexsort((across.ravel(), lines.ravel()))
    first = np.searchsorted(lines.ravel()[entries], np.arange(lines.shape[1] + 1))
    return entries, across.ravel()[entries].astype(np.int32), first.astype(np.int32)


def follows_lubricant(at: Iterate) -> bool:
    """Return whether the masses follow the lubricant: then nothing flows with U."""
    return at.history is not None and at.history.follows_lubricant


def nested_dissection(nx: int, ny: int) -> np.ndarray:
    """Return the numbers of the cells (i ny + j) of a grid (nx, ny), free along x and periodic along y, in the order of
    elimination.

    A line of cells cuts the grid in two and comes last. Each half is cut again, and so on (A. George, SIAM J. Numer.
    Anal. 10 (1973) 345-363, doi:10.1137/0710032). y is periodic, and is cut twice first. The order follows from the
    grid at no cost. It fills in less than a minimum degree order that is found anew for every matrix.
    """
    order = np.concatenate(_ring(np.arange(nx * ny).reshape(nx, ny)))
    order.flags.writeable = False
    return order


def _ring(cells: np.ndarray) -> list[np.ndarray]:
    """Return the order for a part that is periodic along y. It is cut across x while the cut has fewer cells
    than two cuts along x."""
    nx, ny = cells.shape
    if 2 * nx > ny and nx > 3:
        return _cut_across(cells, _ring)
    if ny < 4:
        return _box(cells)
    half = ny // 2
    return [*_box(cells[:, :half]), *_box(cells[:, half + 1 : -1]), cells[:, half], cells[:, -1]]


def _box(cells: np.ndarray) -> list[np.ndarray]:
    nx, ny = cells.shape
    if cells.size <= UNCUT_CELLS:
        return [cells.ravel()]
    if nx >= ny:
        return _cut_across(cells, _box)
    middle = ny // 2
    return [*_box(cells[:, :middle]), *_box(cells[:, middle + 1 :]), cells[:, middle]]


def _cut_across(cells: np.ndarray, order: Callable[..., Any]) -> list[np.ndarray]:
    middle = cells.shape[0] // 2
    return [*order(cells[:middle]), *order(cells[middle + 1 :]), cells[middle]]
