"""Maps of the deterministic model: load, speed, roughness.

The contact is a bearing of 10 mm radius with a shear-limited compressible oil. The check uses the fields alone. Load
and elastic gap are summed again, and pressure and gap have to be positive. The flow, of the ruptured film too, has to
be the same through every section before the first touching cell. It is computed with second-order upwind differences
and with quadratures of the laws and of 1/h³ between cells. The error of these quadratures is estimated and allowed.
"""

from collections.abc import Iterator

import numpy as np

import lubfric
from lubfric.contact import half_space
from lubfric.film import LineContact
from lubfric.models.deterministic import DeterministicResult, Problem, lay_out, solve_point
from lubfric.oil import Lubricant

from ...fem.solvers.fluid import Fluid
from .cell import Cell

RADIUS = 1e-2  # m
E_PRIME = 231e9  # Pa, E' of two steel bodies
WIDTH = 60e-6  # m, of the patch across the motion
HARDNESS = 6e9  # Pa
FRICTION = 0.1  # boundary friction coefficient
ETA = 0.04  # Pa s, viscosity
ALPHA = 22e-9  # 1/Pa, pressure-viscosity coefficient
COEFFICIENT = 0.09  # limiting stress over the pressure
OFFSET = 2e6  # Pa, limiting stress at ambient pressure
OIL = Lubricant(
    ETA, ALPHA, density_law="dowson-higginson", limiting_stress_coefficient=COEFFICIENT, limiting_stress_offset=OFFSET
)
FLUID = Fluid.of(vars(OIL))
ALLOWED = {"load": 1e-3, "gap": 1e-3, "signs": 1e-6, "flow": 0.03}
ACROSS = 48  # cells; on 24 the quadratures of the judge differ by 4 % from sums over cells at 1e5 N/m


def cells(*, quick: bool) -> Iterator[Cell[tuple[float, float, float]]]:
    """All cells. Where the solver fails is shown: the model promises no range."""
    for sq in (1e-7,) if quick else (2.5e-8, 5e-8, 1e-7, 2e-7):
        for load in (1e4, 1e5) if quick else (1e3, 1e4, 1e5, 2e5, 3e5):
            for speed in (0.01, 0.3) if quick else np.geomspace(1e-3, 1.0, 10).tolist():
                name = f"whole: Sq {1e9 * sq:g} nm"
                problem = (sq, load, speed)
                yield Cell(
                    map=name,
                    panel="load by speed",
                    x=load,
                    y=speed,
                    problem=problem,
                    method="deterministic",
                    inside=False,
                )


def solve(cell: Cell[tuple[float, float, float]]) -> DeterministicResult:
    """Return the film of the bearing of the cell."""
    return solve_point(bearing(*cell.problem))


def deviations(cell: Cell[tuple[float, float, float]], result: DeterministicResult) -> dict[str, float]:
    """Return `check` of the bearing of the cell."""
    return check(bearing(*cell.problem), result)


def bearing(sq: float, load: float, speed: float, seed: int = 1, across: int = ACROSS) -> Problem:
    """Return the bearing on ``across`` cells, with the surface of that ``seed``."""
    surface = lubfric.generate_surface(
        (128 * across // ACROSS, across), WIDTH / across, sq=sq, correlation_length=10e-6, acf="gaussian", seed=seed
    )
    contact = LineContact(load_per_width=load, radius=RADIUS, e_prime=E_PRIME, entrainment_speed=speed, lubricant=OIL)
    return lay_out(surface, contact, sliding=2 * speed, boundary_friction=FRICTION, hardness=HARDNESS)


def check(problem: Problem, result: DeterministicResult) -> dict[str, float]:
    """Return deviations over what is allowed, from the fields."""
    dx, _ = result.spacing
    p = result.pressure
    h = result.gap
    load = p.sum() * dx / p.shape[1] + result.inlet_load
    operator = half_space(p.shape, result.spacing, E_PRIME, ("free", "periodic"))
    elastic = (result.x**2 / (2 * RADIUS))[:, None] - problem.heights + operator.apply(p) + result.dent
    open_ = (h > 2e-9) & (result.dent == 0)
    offset = (h - elastic)[open_]
    signs = max(-float(p.min()), float(p.max()) - HARDNESS, 0.0) / float(p.max())
    gap = float(np.ptp(offset)) / float(h[open_].mean())
    errors = {"load": abs(load / problem.load - 1), "gap": gap, "signs": signs}
    return {name: error / ALLOWED[name] for name, error in errors.items()} | {"flow": flow_error(result)}


def flow_error(result: DeterministicResult) -> float:
    """Return largest relative difference of the flow through sections before the first touching cell, as a part of what
    is allowed there: 3 %, and the error of the check's own quadrature (`_pressure_flow`)."""
    speed = result.speed
    dx = result.spacing[0]
    broken = np.flatnonzero(result.touching.any(axis=1))
    last = (broken[0] if broken.size else result.pressure.shape[0]) - 2
    if last < 3:
        return 0.0
    p = result.pressure[: last + 1]
    h = result.gap[: last + 1]
    fill = result.fill[: last + 1]
    flow, open_ = _pressure_flow(p, h, speed, dx)
    mass = FLUID.rho(p) * h
    step = np.clip(mass[1:last] - mass[: last - 1], -mass[1:last], mass[1:last])  # a film that is never negative
    carried = speed * fill[1:last] * (mass[1:last] + 0.5 * step)  # second-order upwind
    through = speed * result.flow_film
    difference = np.abs((carried - flow[1:]).mean(axis=1) / through - 1)
    allowed = ALLOWED["flow"] + open_[1:].mean(axis=1) / abs(through)
    return float((difference / allowed).max())


def _pressure_flow(p: np.ndarray, h: np.ndarray, speed: float, dx: float) -> tuple[np.ndarray, np.ndarray]:
    """Return pressure flow along x between cells [m²/s], by the mean of the laws between their pressures, and its
    error: the difference from the mean by Simpson's rule on three points. Where the pressure jumps within one cell, as
    at the edge of an asperity contact, the law is not close to a parabola between two cells, which do not resolve the
    film there."""
    film = 0.5 * (h[:-1] + h[1:])
    along = h[:-1, :, None] + (h[1:] - h[:-1])[:, :, None] * np.linspace(0.0, 1.0, 801)
    by_step = (p[1:] - p[:-1]) / dx / (12 * np.trapezoid(along**-3, dx=1 / 800, axis=-1))
    fine, three = (by_step * _mean_fluidity(p, film, speed, points) for points in (129, 3))
    return fine, np.abs(fine - three)


def _mean_fluidity(p: np.ndarray, film: np.ndarray, speed: float, points: int) -> np.ndarray:
    """Return mean of rho/eta_eff between neighbours along x, p linear between them, by Simpson's rule."""
    between = p[:-1, :, None] + (p[1:] - p[:-1])[:, :, None] * np.linspace(0.0, 1.0, points)
    fluidity = 1 / FLUID.eta(between) + 2 * speed / (film[..., None] * (OFFSET + COEFFICIENT * between))
    weights = np.ones(points)
    weights[1:-1:2] = 4.0
    weights[2:-1:2] = 2.0
    return FLUID.rho(between) * fluidity @ (weights / weights.sum())
