"""A rough elastohydrodynamic line contact, film and elastic body with one gap and one pressure, by finite elements.

    d(rho h)/dt + d(rho U h)/dx - div( rho h³/(12 eta) grad p ) = 0,   p >= 0 (Swift-Stieber outlet)
    h = h0 + x²/(2R) - z(x, y, t) + K p,   mean of p over y, integrated over x, = load

The film is discretised with bilinear quadrilaterals (scikit-fem), x along the motion. The surface is its own mirror
image in y, so half of the period is meshed, between two planes through which nothing flows. The inlet begins with p =
0. K is that of `harmonic`: finite elements in the section, waves along y. Its cells have the nodes of the film as
their centres.

The weak form is Galerkin's. Under high pressure only (rho h)' remains, for which Galerkin's form is as unstable as for
convection. So the jumps of that slope between elements have a penalty, as in `ehl_film` (interior penalty of Burman &
Hansbo 2004, doi:10.1016/j.cma.2003.12.032): a term of third order in the cell, where the error is of second order.

Where a ``floor`` is stated, the bodies touch: complementarity decides at every node,

    h >= floor,   contact >= 0,   (h - floor) contact = 0,

where p is then the whole pressure and its equation h = floor. The node opens again when more lubricant flows into it
than out of it. With a floor the rigid gap is interpolated between the nodes, so no gap is below the floor anywhere.

Newton's method solves for all pressures and h0 at once, with the full dense matrix and active sets: nodes with p = 0,
and nodes with h = floor. Steps in time are implicit, of second order (BDF2; the first is Euler's).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import scipy.linalg
import scipy.sparse as sp
from scipy.interpolate import RegularGridInterpolator
from skfem import Basis, BilinearForm, ElementQuad1, LinearForm, MeshQuad
from skfem.helpers import grad

from ...types import FloatArray
from .compliance import Elastic
from .ehl import LineContact, solve_ehl
from .fluid import slope
from .harmonic import Compliance, HarmonicStrip, compliance
from .report import CONVERGED, DIVERGED, ITERATION_LIMIT, SolveReport, require

if TYPE_CHECKING:
    from skfem.assembly.form.form import FormExtraParams
    from skfem.element.discrete_field import DiscreteField


PENALTY = 0.03  # on the jumps of slope: the value of `ehl_film`
LARGEST_GROWTH = 3.0  # of ln(eta) at any node in one step of Newton's method
SMALLEST_SHARE = 0.3  # of the film at any node that one step leaves
SMOOTH_CELL = 0.05  # half-widths: longest cell of the smooth film that a rough one starts from
TOUCHING_SHARES = 9  # of the heights, in even steps from smooth, through which touching bodies are reached
POISSON = 0.3  # of the body; only E' acts on the line of contact
PULL = 0.01  # of U times the floor: surplus of inflow, up to which a touching node stays closed
BDF2 = (1.5, -2.0, 0.5)
EULER = (1.0, -1.0, 0.0)
REST = (0.0, 0.0, 0.0)

Heights = Callable[[np.ndarray, np.ndarray, float], np.ndarray]


@dataclass(frozen=True, kw_only=True)
class RoughLine:
    """What is solved, and on which cells.

    contact : load, bodies, lubricant and speed
    inlet, outlet : ends of the film [m], p = 0 there; inlet < 0 < outlet
    period : of the roughness along y [m]
    cells : (nx, ny), nx even, ny even; nx nodes between the ends, ny over the period
    heights : z [m] of coordinates x, y [m] and the time [s], even in y about 0 and about half of the period
    fineness : each cell along x is 2^fineness facets of the elastic body
    floor : gap [m] of bodies that touch (None: they never touch)
    """

    contact: LineContact
    inlet: float
    outlet: float
    period: float
    cells: tuple[int, int]
    heights: Heights
    fineness: int = 1
    floor: float | None = None

    def __post_init__(self) -> None:
        message = f"cells = {self.cells}, inlet = {self.inlet} m, outlet = {self.outlet} m"
        even = not (self.cells[0] % 2 or self.cells[1] % 2)
        require(even and self.inlet < 0 < self.outlet and self.period > 0, message, "even numbers, inlet < 0 < outlet")

    @property
    def spacing(self) -> tuple[float, float]:
        """(dx, dy) [m]."""
        return (self.outlet - self.inlet) / (self.cells[0] - 1), self.period / self.cells[1]

    @property
    def x(self) -> np.ndarray:
        """Positions of the nodes along the motion [m]."""
        return np.linspace(self.inlet, self.outlet, self.cells[0])

    @property
    def y(self) -> np.ndarray:
        """Positions of the nodes across, over half of the period [m]."""
        return np.arange(self.cells[1] // 2 + 1) * self.spacing[1]


@dataclass(frozen=True, kw_only=True)
class RoughStripFilm:
    """A film at a moment: pressure [Pa] and gap [m] at the nodes (nx, ny/2 + 1), approach h0 [m], flow [m²/s] per width
    that enters, time [s], the report of the solve, and whether the bodies touch at each node."""

    problem: RoughLine
    pressure: np.ndarray
    gap: np.ndarray
    approach: float
    flow: float
    time: float
    report: SolveReport
    touching: np.ndarray

    @property
    def weights(self) -> np.ndarray:
        """Return the width [m] of each node along x, times its part of the period along y."""
        (nx, ny) = self.problem.cells
        along = np.full(nx, self.problem.spacing[0])
        along[[0, -1]] /= 2
        across = np.full(ny // 2 + 1, 2.0 / ny)
        across[[0, -1]] /= 2
        return np.outer(along, across)


class Discretisation:
    """The matrices of a `RoughLine` that stay the same in every step. The elastic body of another one, ``like``, is
    taken where it has as many cells of the same proportions: displacements per pressure grow with the cell."""

    def __init__(self, problem: RoughLine, like: "Discretisation | None" = None):
        self.like = like
        (nx, ny) = problem.cells
        self.problem = problem
        self.mesh = MeshQuad.init_tensor(problem.x, problem.y)
        self.basis = Basis(self.mesh, ElementQuad1(), intorder=4)
        order = np.lexsort((self.basis.doflocs[1], self.basis.doflocs[0]))
        self.place = np.argsort(order)  # of the degrees of freedom, in arrays (nx, ny/2 + 1)
        self.quadrature = np.asarray(self.basis.global_coordinates())
        self.edge = np.isin(self.basis.doflocs[0], (self.basis.doflocs[0].min(), self.basis.doflocs[0].max()))
        self.first = self.basis.doflocs[0] == self.basis.doflocs[0].min()
        ones = LinearForm(lambda v, w: 1.0 * v).assemble(self.basis)
        self.load_weights = ones / (problem.period / 2)  # of p in the load per width
        second = sp.diags([1.0, -2.0, 1.0], [0, 1, 2], shape=(nx - 2, nx))
        across = np.full(ny // 2 + 1, problem.spacing[1])
        across[[0, -1]] /= 2
        jumps = sp.kron(second, sp.eye(ny // 2 + 1)).tocsc()[:, self.place]
        self.jumps = jumps.tocsr()
        self.facets = np.tile(across, nx - 2)

    @cached_property
    def body(self) -> Compliance:
        """The elastic body under the cells."""
        (nx, ny) = self.problem.cells
        (dx, dy) = self.problem.spacing
        if self.like is not None and self.like.problem.cells == (nx, ny):
            known = self.like.body
            growth = dx / known.strip.spacing[0]
            alike = abs(dy / known.strip.spacing[1] / growth - 1) < 1e-9
            if alike and self.problem.contact.e_prime == self.like.problem.contact.e_prime:
                strip = replace(known.strip, spacing=(dx, dy))
                return Compliance(strip, known.harmonics * growth, known.unknowns)
        body = Elastic.from_e_prime(self.problem.contact.e_prime, POISSON)
        return compliance(HarmonicStrip((nx, ny), self.problem.spacing, body, fineness=self.problem.fineness))

    @cached_property
    def stiff(self) -> np.ndarray:
        """K: displacements [m] of the degrees of freedom per pressure [Pa] at each, mirrored in y."""
        (nx, ny) = self.problem.cells
        half = ny // 2 + 1
        unit = np.zeros((half, ny))
        unit[np.arange(half), np.arange(half)] = 1.0
        unit[np.arange(1, half - 1), ny - np.arange(1, half - 1)] = 1.0
        spectrum = np.fft.rfft(unit, axis=1)  # of each mirrored line, real
        parts = np.zeros((half, half, half))
        for m in range(half):
            only = np.zeros((half, half), complex)
            only[:, m] = spectrum[:, m]
            parts[m] = np.fft.irfft(only, n=ny, axis=1)[:, :half]
        matrix = np.einsum("mab,mij->ibja", parts, self.body.harmonics).reshape(nx * half, nx * half)
        return matrix[np.ix_(self.place, self.place)]

    def shape(self, time: float, height_share: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
        """Return x²/(2R) - s z [m] at the points of quadrature and at the degrees of freedom; s: ``height_share``."""
        values = []
        for x, y in (self.quadrature, self.basis.doflocs):
            heights = height_share * self.problem.heights(x, y, time)
            values.append(x**2 / (2 * self.problem.contact.radius) - heights)
        if self.problem.floor is not None:
            values[0] = np.asarray(self.basis.interpolate(values[1]))
        return values[0], values[1]

    @cached_property
    def area(self) -> np.ndarray:
        """Area [m²] that each degree of freedom stands for."""
        return self.load_weights * (self.problem.period / 2)

    def field(self, values: np.ndarray) -> np.ndarray:
        """Return values at the degrees of freedom as an array (nx, ny/2 + 1)."""
        result = np.empty_like(values)
        result[self.place] = values
        return result.reshape(self.problem.cells[0], -1)


@LinearForm
def residual_form(v: DiscreteField, w: FormExtraParams) -> FloatArray:
    """Return ``(c, v) - (q, grad v)``: what is gained, and the flow."""
    return w.c * v - w.qx * grad(v)[0] - w.qy * grad(v)[1]


@BilinearForm
def tangent_form(u: DiscreteField, v: DiscreteField, w: FormExtraParams) -> FloatArray:
    """Return the derivative of `residual_form` by a field: by its value in c and q, and by its gradient in q."""
    flow = (w.x_value * u - w.mobility * grad(u)[0]) * grad(v)[0]
    flow = flow + (w.y_value * u - w.mobility * grad(u)[1]) * grad(v)[1]
    return w.c_value * u * v - flow


@dataclass(frozen=True)
class Balance:
    """Lost mass at the degrees of freedom [m³/s], its derivatives by p and by h, and what the film holds [m]."""

    lost: np.ndarray
    by_pressure: sp.csr_matrix
    by_gap: sp.csr_matrix
    content: np.ndarray


def balance(
    grid: Discretisation, p: np.ndarray, moved: np.ndarray, shape: np.ndarray, nodal: np.ndarray, step: "Step"
) -> Balance:
    """Return the balance of mass for pressures ``p`` and displacements with the approach ``moved`` at the dofs, over
    the rigid gaps ``shape`` at the points of quadrature and ``nodal`` at the dofs."""
    basis = grid.basis
    contact = grid.problem.contact
    speed = contact.entrainment_speed
    fluid = contact.fluid
    field = basis.interpolate(p)
    value = np.maximum(np.asarray(field), 0.0)
    gradient = np.asarray(grad(field))
    h = shape + np.asarray(basis.interpolate(moved))
    h = np.maximum(h, 1e-3 * np.abs(h).min() + 1e-12 if grid.problem.floor is None else grid.problem.floor)
    rho = fluid.rho(value)
    denser = slope(fluid.rho, value)
    mobility = rho * h**3 / (12 * fluid.eta(value))
    growth = denser / rho - slope(fluid.log_viscosity, value)
    rate = step.rates[0] / step.length
    content = rho * h
    flow = speed * content - mobility * gradient[0], -mobility * gradient[1]
    gained = rate * content + (step.rates[1] * step.now + step.rates[2] * step.before) / step.length
    lost = residual_form.assemble(basis, c=gained, qx=flow[0], qy=flow[1])
    still = 0.0 * h
    by_pressure = tangent_form.assemble(
        basis,
        c_value=rate * denser * h,
        x_value=speed * denser * h - mobility * growth * gradient[0],
        y_value=-mobility * growth * gradient[1],
        mobility=mobility,
    )
    by_gap = tangent_form.assemble(
        basis,
        c_value=rate * rho,
        x_value=speed * rho - 3 * mobility / h * gradient[0],
        y_value=-3 * mobility / h * gradient[1],
        mobility=still,
    )
    at = np.maximum(p, 0.0)
    gap = nodal + moved
    dense = fluid.rho(at)
    size = grid.problem.spacing[0]
    diffusion = 6 * dense * np.maximum(gap, 0.0) ** 3 / (12 * fluid.eta(at)) / size
    charge = 1 / np.sqrt(1 + (diffusion / (speed * (np.abs(gap) * slope(fluid.rho, at) + compliant(grid)))) ** 2)
    inner = np.abs(grid.jumps) @ charge / 4
    weighted = grid.jumps.T @ sp.diags(PENALTY * speed * inner * grid.facets) @ grid.jumps
    lost = lost + weighted @ (dense * gap)
    by_pressure = by_pressure + weighted @ sp.diags(slope(fluid.rho, at) * gap)
    by_gap = by_gap + weighted @ sp.diags(dense)
    return Balance(lost, by_pressure.tocsr(), by_gap.tocsr(), content)


def compliant(grid: Discretisation) -> float:
    """Return the gap that a Hertz pressure changes [m/Pa]: b²/R over p_h."""
    contact = grid.problem.contact
    return contact.film_unit / contact.hertz_pressure


@dataclass(frozen=True)
class Step:
    """A step in time: its length [s], the rates of BDF2 or Euler, what the film held [m] now and before. At rest all
    rates are 0."""

    length: float = 1.0
    rates: tuple[float, float, float] = REST
    now: np.ndarray | float = 0.0
    before: np.ndarray | float = 0.0


@dataclass(frozen=True, kw_only=True)
class ActiveSets:
    """Which degrees of freedom have p = 0 (``held``), and which have h = floor (``touching``)."""

    held: np.ndarray
    touching: np.ndarray

    def differs(self, other: "ActiveSets") -> bool:
        """Return whether ``other`` has another node in one of the sets."""
        return bool(((self.held != other.held) | (self.touching != other.touching)).any())


@dataclass(frozen=True, kw_only=True)
class NewtonIterate:
    """An iterate of Newton's method at the degrees of freedom: ``pressure`` [Pa], ``approach`` h0 [m] and ``gap`` [m],
    the balance of ``mass``, and the ``excess`` of the load, relative."""

    pressure: np.ndarray
    approach: float
    gap: np.ndarray
    mass: Balance
    excess: float


@dataclass(frozen=True, kw_only=True)
class SolvedMoment:
    """What `newton` reached at the ``time`` [s]: its last iterate, the nodes that touch, and the report."""

    iterate: NewtonIterate
    touching: np.ndarray
    time: float
    report: SolveReport


def newton(
    grid: Discretisation,
    p: np.ndarray,
    approach: float,
    time: float,
    step: Step = Step(),
    *,
    tolerance: float = 1e-7,
    max_iterations: int = 60,
    touching: np.ndarray | None = None,
    height_share: float = 1.0,
) -> SolvedMoment:
    """Return the solution of a moment, from pressure ``p`` [Pa] and ``approach`` [m] on. ``touching``: the nodes that
    touch at first; ``height_share``: the heights of the problem count so much.

    The residuals are the mass lost on the way to the rupture over the inflow, the load, the largest tension over the
    Hertz pressure, and the largest |h - floor| of touching nodes over the film of Moes."""
    shape, nodal = grid.shape(time, height_share)
    held = grid.edge | (p <= 0)
    touching = np.zeros(p.size, bool) if touching is None else touching & ~held
    sets = ActiveSets(held=held, touching=touching)
    history: list[float] = []
    status = ITERATION_LIMIT
    while True:
        moved = approach + grid.stiff @ p
        at = NewtonIterate(
            pressure=p,
            approach=approach,
            gap=nodal + moved,
            mass=balance(grid, p, moved, shape, nodal, step),
            excess=float(grid.load_weights @ p) / grid.problem.contact.load_per_width - 1,
        )
        residuals = residuals_of(grid, at, sets)
        history.append(max(residuals.values()))
        following = following_sets(grid, at, sets)
        if not np.isfinite(history[-1]):
            status = DIVERGED
            break
        if history[-1] <= tolerance and not following.differs(sets):
            status = CONVERGED
            break
        if len(history) > max_iterations:
            break
        sets = following
        change, rise = newton_step(grid, at, sets)
        share = step_share(grid, p, change, at.gap, rise, sets.touching)
        p = p + share * change
        approach = approach + share * rise
    report = SolveReport(
        solver="rough EHL by finite elements",
        status=status,
        iterations=len(history) - 1,
        tolerance=tolerance,
        residuals=residuals,
        history=tuple(history),
    )
    return SolvedMoment(iterate=at, touching=sets.touching, time=time, report=report)


def inflow_of(grid: Discretisation) -> float:
    """Return the flow [m³/s] of the film of Moes into half of the period."""
    contact = grid.problem.contact
    return contact.entrainment_speed * contact.moes_film * grid.problem.period / 2


def residuals_of(grid: Discretisation, at: NewtonIterate, sets: ActiveSets) -> dict[str, float]:
    """Return the residuals of an iterate by name, as in `newton`."""
    contact = grid.problem.contact
    floor = grid.problem.floor
    fluid = ~sets.held & ~sets.touching
    residuals = {"mass": float(np.abs(at.mass.lost[fluid]).sum() / inflow_of(grid)), "load": abs(at.excess)}
    residuals["tension"] = float(max(-at.pressure.min(), 0.0) / contact.hertz_pressure)
    if floor is not None:
        off_floor = np.abs(at.gap[sets.touching] - floor)
        residuals["touching"] = float(off_floor.max(initial=0.0) / contact.moes_film)
    return residuals


def following_sets(grid: Discretisation, at: NewtonIterate, sets: ActiveSets) -> ActiveSets:
    """Return the sets that the next step takes: by the signs of pressure, gap and lost mass at an iterate."""
    contact = grid.problem.contact
    floor = grid.problem.floor
    p = at.pressure
    lost = at.mass.lost
    held = grid.edge | np.where(sets.held, lost > 0, p < 0)
    if floor is None:
        return ActiveSets(held=held, touching=np.zeros(p.size, bool))
    pull = PULL * contact.entrainment_speed * floor * grid.area / grid.problem.spacing[0]
    touching = np.where(sets.touching, (lost >= -pull) & (p > 0), at.gap < floor) & ~grid.edge
    return ActiveSets(held=held & ~touching, touching=touching)


def newton_step(grid: Discretisation, at: NewtonIterate, sets: ActiveSets) -> tuple[np.ndarray, float]:
    """Return the change of the pressures [Pa] and of the approach [m] in a full step of Newton's method."""
    contact = grid.problem.contact
    load = contact.load_per_width
    unit = contact.hertz_pressure
    inflow = inflow_of(grid)
    mass = at.mass
    free = np.flatnonzero(~sets.held)
    contacts = sets.touching[free]
    change = np.where(sets.held, -at.pressure, 0.0)
    matrix = np.zeros((free.size + 1, free.size + 1), order="F")
    matrix[:-1, :-1] = mass.by_pressure[free][:, free].toarray() + mass.by_gap[free] @ grid.stiff[:, free]
    matrix[:-1, :-1] *= unit / inflow
    matrix[:-1, -1] = np.asarray(mass.by_gap[free].sum(axis=1)).ravel() * contact.film_unit / inflow
    matrix[-1, :-1] = grid.load_weights[free] * unit / load
    lost = mass.lost + mass.by_pressure @ change + mass.by_gap @ (grid.stiff @ change)
    right = -np.append(lost[free] / inflow, at.excess + grid.load_weights @ change / load)
    if contacts.any():
        rows = np.flatnonzero(contacts)
        nodes = free[rows]
        matrix[rows, :-1] = grid.stiff[np.ix_(nodes, free)] * unit / contact.film_unit
        matrix[rows, -1] = 1.0
        right[rows] = (grid.problem.floor - at.gap[nodes] - grid.stiff[nodes] @ change) / contact.film_unit
    solution = scipy.linalg.solve(matrix, right, overwrite_a=True, check_finite=False)
    change[free] = solution[:-1] * unit
    return change, float(solution[-1]) * contact.film_unit


def step_share(
    grid: Discretisation, p: np.ndarray, change: np.ndarray, gap: np.ndarray, rise: float, touching: np.ndarray
) -> float:
    """Return the part of a step of Newton's method that is taken: no viscosity grows by more than
    exp(`LARGEST_GROWTH`), and no film of bodies that never touch falls below `SMALLEST_SHARE` of it."""
    fluid = grid.problem.contact.fluid
    wet = ~touching
    growth = np.abs(fluid.log_viscosity(np.maximum(p + change, 0)) - fluid.log_viscosity(np.maximum(p, 0)))
    share = min(1.0, LARGEST_GROWTH / max(float(growth[wet].max()), 1e-9))
    if grid.problem.floor is not None:
        return share
    thinner = -(rise + grid.stiff @ change) / np.maximum(gap, 1e-12)
    return min(share, (1 - SMALLEST_SHARE) / max(float(thinner.max()), 1e-9))


def film_of(grid: Discretisation, moment: SolvedMoment) -> RoughStripFilm:
    """Return the result of a converged solve; `SolveError` for another."""
    at = moment.iterate
    nodal = grid.shape(moment.time)[1]
    gap = nodal + at.approach + grid.stiff @ at.pressure
    flow = float(at.mass.lost[grid.first].sum()) / (grid.problem.period / 2)
    return moment.report.checked(
        RoughStripFilm(
            problem=grid.problem,
            pressure=grid.field(at.pressure),
            gap=grid.field(gap),
            approach=at.approach,
            flow=flow,
            time=moment.time,
            report=moment.report,
            touching=grid.field(moment.touching),
        )
    )


def solve_rough(
    grid: Discretisation, start: RoughStripFilm | None = None, *, time: float = 0.0, tolerance: float = 1e-7
) -> RoughStripFilm:
    """Return the film with the roughness as it lies at ``time``, at rest. Without a ``start`` it is raised in steps,
    from the smooth film of `ehl` on."""
    problem = grid.problem
    contact = problem.contact
    if start is not None:
        p = interpolated(start, grid)
        known = RegularGridInterpolator((start.problem.x, start.problem.y), start.touching.astype(float), "nearest")
        closed = at_nodes(known, start.problem, grid) > 0.5
        return film_of(grid, newton(grid, p, start.approach, time, tolerance=tolerance, touching=closed))
    smooth = solve_ehl(contact, refinements=0, fineness=1.0, between=SMOOTH_CELL)[-1]
    x = grid.basis.doflocs[0]
    ends = smooth.body.x.min(), smooth.body.x.max()
    p = smooth.at(np.clip(x, *(end * contact.half_width for end in ends)))[0]
    p = np.where(grid.edge, 0.0, np.maximum(p, 0.0))
    middle = np.argmin(np.abs(x))
    approach = float(smooth.at(x[middle : middle + 1])[1][0] - (x**2 / (2 * contact.radius) + grid.stiff @ p)[middle])
    touching = np.zeros(p.size, bool)
    for share in (0.0, 0.5, 1.0) if problem.floor is None else np.linspace(0.0, 1.0, TOUCHING_SHARES):
        moment = newton(grid, p, approach, time, tolerance=tolerance, touching=touching, height_share=float(share))
        p = moment.iterate.pressure
        approach = moment.iterate.approach
        touching = moment.touching
    return film_of(grid, moment)


def interpolated(coarse: RoughStripFilm, grid: Discretisation) -> np.ndarray:
    """Return the pressure of another grid at the degrees of freedom of this one."""
    known = RegularGridInterpolator((coarse.problem.x, coarse.problem.y), coarse.pressure)
    return np.maximum(at_nodes(known, coarse.problem, grid), 0.0)


def at_nodes(known: RegularGridInterpolator, coarse: RoughLine, grid: Discretisation) -> np.ndarray:
    """Return a field that is ``known`` on the nodes of a ``coarse`` problem at the degrees of freedom of ``grid``."""
    x, y = grid.basis.doflocs
    return known(np.column_stack([np.clip(x, coarse.x[0], coarse.x[-1]), np.clip(y, 0, coarse.y[-1])]))


def march(
    grid: Discretisation, start: RoughStripFilm, length: float, *, tolerance: float = 1e-6
) -> Iterator[RoughStripFilm]:
    """Yield films that are ``length`` [s] apart, without end, from ``start`` on, while the heights move."""
    p = np.empty(grid.basis.N)
    p[:] = start.pressure.ravel()[grid.place]
    approach = start.approach
    touching = start.touching.ravel()[grid.place]
    shape, nodal = grid.shape(start.time)
    now = balance(grid, p, approach + grid.stiff @ p, shape, nodal, Step()).content
    before = now
    time = start.time
    rates = EULER
    while True:
        time += length
        step = Step(length, rates, now, before)
        moment = newton(grid, p, approach, time, step, tolerance=tolerance, touching=touching)
        film = film_of(grid, moment)
        p = moment.iterate.pressure
        approach = moment.iterate.approach
        touching = moment.touching
        before = now
        now = moment.iterate.mass.content
        rates = BDF2
        yield film
