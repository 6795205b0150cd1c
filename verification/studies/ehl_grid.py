"""The line-contact film of `lubfric` against exact and tight references: grid, inlet."""

from __future__ import annotations

import math

import numpy as np

import lubfric

from .. import plotting
from ..check import ABSOLUTE, AT_LEAST, AT_MOST, Check, Table
from ..exact import Parabola
from ..rates import fitted_order

ALPHA, INDEX, E_PRIME, RADIUS = 2.2e-8, 0.68, 2.2e11, 0.01
VISCOSITY = math.exp(ALPHA * 1.96e8 / INDEX - 9.67)
# (M, L): smallest film and flow film in Moes' units, constant density
TABLE = {
    (5, 5): (3.105, 4.082),
    (10, 5): (2.826, 3.744),
    (20, 5): (2.572, 3.423),
    (100, 5): (2.061, 2.758),
    (10, 10): (4.153, 5.491),
}
TABLE_SOURCE = "separate finite-difference solver on nested meshes, inlet at -6 b, stable to 5e-4"
TOLERANCES = {
    "quick": (1e-1, 1e-3, 1e-4),
    "default": (1e-1, 1e-2, 1e-3, 1e-4, 3e-5),
    "full": (1e-1, 1e-2, 1e-3, 1e-4, 1e-5),
}
CELLS = {"quick": (96, 192, 384), "default": (96, 192, 384, 768), "full": (96, 192, 384, 768, 1536)}
RIGID_LOAD = 1e-3  # M at which elastic deflection is 5e-7 of the film
INLETS = (1.5, 3.0, 6.0, 12.0, 24.0)


def ehl_grid(level: str):
    """`lubfric.solve_ehl` on its nested grids, and with inlets ever farther away.

    Its one knob is ``tolerance``: grids are doubled until the estimated error is below it. Films are held against a
    table made by another program, and against the closed form of the rigid isoviscous cylinder, to which a light load
    leads. There the error itself can be seen falling with the grid, and with the distance of a starved inlet. The
    estimate has to cover the error. (Finite elements against this solver: study "ehl".)
    """
    yield from table()
    yield from rigid(level)
    yield from elastic(level)
    yield from starved()


def film(M: float, L: float, tolerance: float, law: str = "roelands", **options) -> lubfric.EHLResult:
    """A film with Moes' numbers M and L. L sets the speed also where the law is "constant"."""
    number = (L / (ALPHA * E_PRIME)) ** 4
    return lubfric.solve_ehl(
        load_per_width=M * math.sqrt(number) * E_PRIME * RADIUS,
        radius=RADIUS,
        e_prime=E_PRIME,
        entrainment_speed=number * E_PRIME * RADIUS / (2 * VISCOSITY),
        viscosity=VISCOSITY,
        pressure_viscosity_coefficient=ALPHA,
        viscosity_law=law,
        tolerance=tolerance,
        **options,
    )


def unit(f: lubfric.EHLResult) -> float:
    """The film that is 1 in Moes' units, m."""
    return math.sqrt(2 * VISCOSITY * f.entrainment_speed / (E_PRIME * RADIUS)) * RADIUS


def table():
    """Films of the table."""
    for (M, L), (smallest, flow) in TABLE.items():
        half_width = RADIUS * (L / (ALPHA * E_PRIME)) * math.sqrt(8 * M / math.pi)
        f = film(M, L, 1e-4, inlet_length=6 * half_width)
        yield Check(f"M = {M}, L = {L}: smallest film", f.min_film / unit(f), smallest, 1e-3, TABLE_SOURCE)
        yield Check(f"M = {M}, L = {L}: flow film", f.flow_film / unit(f), flow, 1e-3, TABLE_SOURCE)


def rigid(level: str):
    """Light load: smallest film 2.447484/M and flow film 3.000000/M of the rigid isoviscous cylinder.

    What is left on fine grids is the finite inlet, which is estimated apart. So the order is that of the changes from
    grid to grid.
    """
    cells, errors, estimates, films = CELLS[level], [], [], []
    for n in cells:
        f = film(RIGID_LOAD, 5.0, 0.1, "constant", least_cells=n)
        films.append(f.min_film)
        errors.append(
            max(abs(f.min_film / unit(f) * RIGID_LOAD / 2.447484 - 1), abs(f.flow_film / unit(f) * RIGID_LOAD / 3 - 1))
        )
        estimates.append(f.report.residuals["discretisation"] + f.report.residuals["domain"])
    yield Check(
        "rigid limit: film error on the finest grid",
        errors[-1],
        0.0,
        1e-4 if level == "quick" else 2e-5,
        "closed form, Martin 1916",
        AT_MOST,
    )
    yield Check(
        "rigid limit: order in the cells",
        fitted_order(1 / np.array(cells[1:]), np.abs(np.diff(films))),
        2.0,
        0.3,
        "fluxes through faces, second order",
        AT_LEAST,
    )
    yield Check(
        "rigid limit: error per estimated error",
        float(np.max(np.array(errors) / estimates)),
        1.0,
        0.0,
        "the estimate has to cover the error",
        AT_MOST,
    )
    yield plotting.convergence(
        "ehl_rigid",
        "lubfric.solve_ehl at M = 0.001: film error against the closed form, and the error it states.",
        {"error": (1 / np.array(cells), errors, 2), "stated": (1 / np.array(cells), estimates, None)},
        "1 / cells",
        "relative film error",
    )


def elastic(level: str):
    """Elastic, piezoviscous films against the solution on a grid of its own at the finest tolerance."""
    series, rows = {}, []
    for M, L in ((20, 5),) if level == "quick" else ((0.5, 5), (20, 5), (50, 10)):
        finest = film(M, L, 1e-5)
        cells, errors = [], []
        for tolerance in TOLERANCES[level]:
            f = film(M, L, tolerance)
            if f.state.pressure.size >= finest.state.pressure.size or f.state.pressure.size in cells:
                continue
            cells.append(f.state.pressure.size)
            errors.append(max(abs(f.min_film / finest.min_film - 1), abs(f.flow_film / finest.flow_film - 1)))
            rows.append((M, L, cells[-1], tolerance, f.report.residuals["discretisation"], errors[-1]))
        series[f"M {M:g}, L {L:g}"] = (1 / np.array(cells), errors, 2)
        yield Check(
            f"M = {M:g}, L = {L:g}: order in the cells",
            fitted_order(1 / np.array(cells), errors),
            2.0,
            0.5,
            "fluxes through faces, second order",
            AT_LEAST,
        )
    yield Table(
        "ehl_grid",
        "Tolerance asked, error stated and error found.",
        ("M", "L", "cells", "asked", "stated", "found"),
        tuple(rows),
    )
    yield plotting.convergence(
        "ehl_grid",
        "lubfric.solve_ehl: largest error of smallest film and flow film against its finest "
        "grid. Dotted: second order.",
        series,
        "1 / cells",
        "relative film error",
    )


def starved():
    """A starved inlet at light load: the load of the closed form with the same inlet."""
    distances, losses = [], []
    flooded = film(RIGID_LOAD, 5.0, 1e-4, "constant")
    for inlet in INLETS:
        f = film(RIGID_LOAD, 5.0, 1e-4, "constant", inlet_length=inlet * math.sqrt(2 * RADIUS * flooded.min_film))
        exact = Parabola(VISCOSITY, f.entrainment_speed, RADIUS, f.min_film, -f_inlet(f, inlet, flooded))
        yield Check(
            f"starved inlet at {inlet:g} √(2 R h): load",
            f.load,
            exact.load,
            1e-3,
            "closed form with the same inlet, Martin 1916",
            unit="N/m",
        )
        distances.append(1 / inlet)
        losses.append(1 - f.flow_film / flooded.flow_film)
    yield Check(
        "starved inlet: order of the loss of film",
        fitted_order(distances[-3:], losses[-3:]),
        2.0,
        0.2,
        "pressure falls like |x|^-3, so what is lost of its integral like |x|^-2",
        ABSOLUTE,
    )
    yield plotting.convergence(
        "ehl_inlet",
        "Loss of film by an inlet that is not flooded, rigid cylinder. lubfric's flooded inlet "
        "follows the parabolic gap to infinity.",
        {"flow film": (distances, losses, 2)},
        "√(2 R h) / inlet distance",
        "1 − film / flooded film",
    )


def f_inlet(f: lubfric.EHLResult, inlet: float, flooded: lubfric.EHLResult) -> float:
    """The inlet in units of sqrt(2 R h) of this film."""
    return inlet * math.sqrt(flooded.min_film / f.min_film)
