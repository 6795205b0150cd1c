"""The line-contact film of `lubfric` against exact and tight references: grid, inlet."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...check import AT_LEAST, Item, Table, bound, compared
from ..convergence import Series, convergence
from ..exact import Parabola
from ..parts import ALPHA, E_PRIME, RADIUS, VISCOSITY
from ..published.films import film, own, unit

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
SECOND = "fluxes through faces, second order"


def ehl_grid(level: str) -> Iterator[Item]:
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


def table() -> Iterator[Item]:
    """Films of the table."""
    for (M, L), (smallest, flow) in TABLE.items():
        half_width = RADIUS * (L / (ALPHA * E_PRIME)) * math.sqrt(8 * M / math.pi)
        f = film(M, L, tolerance=1e-4, inlet_length=6 * half_width)
        rows = [
            ("smallest film", "1", f.min_film / unit(f), smallest, 1e-3),
            ("flow film", "1", f.flow_film / unit(f), flow, 1e-3),
        ]
        yield from (replace(c, grade="C") for c in compared(f"M = {M}, L = {L}", rows, TABLE_SOURCE))


def rigid(level: str) -> Iterator[Item]:
    """Light load: smallest film 2.447484/M and flow film 3.000000/M of the rigid isoviscous cylinder.

    What is left on fine grids is the finite inlet, which is estimated apart. So the order is that of the changes from
    grid to grid.
    """
    cells = np.array(CELLS[level])
    errors = []
    estimates = []
    films = []
    for n in cells:
        f = film(RIGID_LOAD, 5.0, law="constant", tolerance=0.1, least_cells=int(n))
        scale = RIGID_LOAD / unit(f)
        films.append(f.min_film)
        errors.append(max(abs(f.min_film * scale / 2.447484 - 1), abs(f.flow_film * scale / 3 - 1)))
        estimates.append(own(f))
    allowed = 1e-4 if level == "quick" else 2e-5
    yield bound("rigid limit: film error on the finest grid", errors[-1], allowed, "closed form, Martin 1916")
    yield Series(
        "",
        1 / cells[1:],
        np.abs(np.diff(films)),
        order=2.0,
        check="rigid limit: order in the cells",
        tolerance=0.3,
        source=SECOND,
        kind=AT_LEAST,
    ).check_order()
    worst = float(np.max(np.array(errors) / estimates))
    yield bound("rigid limit: error per estimated error", worst, 1.0, "the estimate has to cover the error")
    caption = "lubfric.solve_ehl at M = 0.001: film error against the closed form, and the error it states."
    series = [Series("error", 1 / cells, errors=errors, order=2), Series("stated", 1 / cells, errors=estimates)]
    yield from convergence("ehl_rigid", caption, series, "1 / cells", "relative film error")


def elastic(level: str) -> Iterator[Item]:
    """Elastic, piezoviscous films against the solution on a grid of its own at the finest tolerance."""
    series = []
    rows = []
    for M, L in ((20, 5),) if level == "quick" else ((0.5, 5), (20, 5), (50, 10)):
        finest = film(M, L, tolerance=1e-5)
        cells = []
        errors = []
        for tolerance in TOLERANCES[level]:
            f = film(M, L, tolerance=tolerance)
            if f.state.pressure.size >= finest.state.pressure.size or f.state.pressure.size in cells:
                continue
            cells.append(f.state.pressure.size)
            errors.append(max(abs(f.min_film / finest.min_film - 1), abs(f.flow_film / finest.flow_film - 1)))
            rows.append((M, L, cells[-1], tolerance, f.report.residuals["discretisation"], errors[-1]))
        name = f"M = {M:g}, L = {L:g}"
        series.append(
            Series(
                name,
                1 / np.array(cells),
                errors=errors,
                order=2.0,
                check=f"{name}: order in the cells",
                tolerance=0.5,
                source=SECOND,
                kind=AT_LEAST,
            )
        )
    columns = ("M", "L", "cells", "requested", "stated", "actual")
    yield Table("ehl_grid", "Requested tolerance, stated error and actual error.", columns, rows)
    caption = "lubfric.solve_ehl: largest error of smallest film and flow film against its finest grid."
    yield from convergence("ehl_grid", caption, series, "1 / cells", "relative film error")


def starved() -> Iterator[Item]:
    """A starved inlet at light load: the load of the closed form with the same inlet."""
    losses = []
    inlets = np.array([1.5, 3.0, 6.0, 12.0, 24.0])
    flooded = film(RIGID_LOAD, 5.0, law="constant", tolerance=1e-4)
    for inlet in inlets:
        begins = inlet * math.sqrt(2 * RADIUS * flooded.min_film)
        f = film(RIGID_LOAD, 5.0, law="constant", tolerance=1e-4, inlet_length=begins)
        scaled_inlet = inlet * math.sqrt(flooded.min_film / f.min_film)  # in units of sqrt(2 R h) of this film
        load = Parabola(
            viscosity=VISCOSITY,
            speed=f.entrainment_speed,
            radius=RADIUS,
            film_thickness=f.min_film,
            inlet=-scaled_inlet,
        ).load
        rows = [("load", "N/m", f.load, load, 1e-3)]
        source = "closed form with the same inlet, Martin 1916"
        yield from compared(f"starved inlet at {inlet:g} √(2 R h)", rows, source)
        losses.append(1 - f.flow_film / flooded.flow_film)
    name = "starved inlet: order of the loss of film"
    source = "pressure falls like |x|^-3, its integral like |x|^-2"
    series = [
        Series("flow film", 1 / inlets, errors=losses, order=2.0, check=name, tolerance=0.2, source=source, finest=3)
    ]
    caption = "Loss of film by an inlet that is not flooded, rigid cylinder. lubfric's flooded inlet follows the "
    caption += "parabolic gap to infinity."
    yield from convergence("ehl_inlet", caption, series, "√(2 R h) / inlet distance", "1 − film / flooded film")
