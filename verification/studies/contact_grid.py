"""Dry contact of `lubfric` against closed forms on ever finer grids, for each of the three boundary conditions."""

from __future__ import annotations

import numpy as np

import lubfric

from .. import plotting
from ..check import AT_LEAST, AT_MOST, Check, Table
from ..exact_contact import Line, Sphere, Wave
from ..rates import fitted_order

E_PRIME, RADIUS, SIZE = 231e9, 2e-3, 4.5e-6  # Pa, m, m: modulus, radius, contact size of the paper
TOLERANCE = 1e-8
CELLS = {"quick": (8, 16, 32), "default": (8, 16, 32, 64, 128), "full": (8, 16, 32, 64, 128, 256)}
SPHERE_CELLS = {"quick": (4, 8, 16), "default": (4, 8, 16, 32, 64), "full": (4, 8, 16, 32, 64, 128)}
PLACES = 6  # positions of the contact edge within a cell
HERTZ = "closed form, Hertz 1882"
REASONS = {
    1: "cells are wholly in contact or not, pressure rises like a root at the edge",
    2: "means are of second order",
}


def contact_grid(level: str):
    """`lubfric.solve_contact` on smooth shapes with closed forms. Errors are shown against the cells in the contact.

    The shapes are a cylinder (free along x, periodic along y), a sphere (free both ways), a wave (periodic both ways),
    and a row of spheres so far apart that each is alone (free along x, periodic along y: only the waves along y tell it
    from a cylinder). It is chance where in its cell the edge of the contact lies, so errors are root mean squares over
    six places. Contact is all or nothing in a cell, so area is of first order. Pressure and gap are smoother. The
    contact size is taken from the second moment of the pressure.
    """
    yield from family(
        "cylinder",
        cylinder,
        CELLS[level],
        "cells in a half-width",
        32,
        {"peak pressure": (2e-4, 2), "contact size": (4e-4, 2), "contact area": (2e-2, 1), "mean gap": (4e-4, 2)},
    )
    yield from family(
        "sphere",
        sphere,
        SPHERE_CELLS[level],
        "cells in a radius",
        16,
        {
            "peak pressure": (1.5e-3, 2),
            "contact size": (7e-4, 2),
            "contact area": (2.5e-2, 1),
            "mean gap": (8e-4, 2),
            "approach": (3e-4, 2),
        },
    )
    yield from family(
        "wave",
        wave,
        CELLS[level],
        "cells in a quarter of the wave",
        32,
        {"peak pressure": (5e-4, 2), "contact area": (2e-2, 1), "mean gap": (3e-4, 2), "pressure, L2": (1.2e-2, 1)},
    )
    yield from row_of_spheres(16)


def family(name: str, solve, cells: tuple[int, ...], size: str, at: int, allowed: dict[str, tuple[float, int]]):
    """Errors of one shape on all grids.

    ``allowed`` is the bound with ``at`` cells, and the order by which it falls.
    """
    errors = np.array(
        [np.sqrt(np.mean([np.square(solve(n, place / PLACES)) for place in range(PLACES)], axis=0)) for n in cells]
    )
    sizes = [1 / n for n in cells]
    for (quantity, (bound, order)), column in zip(allowed.items(), errors.T, strict=True):
        yield Check(
            f"{name}: {quantity}, relative error",
            column[-1],
            0.0,
            bound * (at / cells[-1]) ** order,
            HERTZ if name != "wave" else "closed form, Westergaard 1939",
            AT_MOST,
            note=f"{cells[-1]} {size}",
        )
        yield Check(f"{name}: {quantity}, order", fitted_order(sizes, column), order, 0.3, REASONS[order], AT_LEAST)
    yield Table(
        f"contact_{name}",
        f"Relative errors of a {name}, root mean squares over {PLACES} places of the edge.",
        (size, *allowed),
        tuple((n, *(float(e) for e in row)) for n, row in zip(cells, errors, strict=True)),
    )
    yield plotting.convergence(
        f"contact_{name}",
        f"Errors of a {name} by lubfric.solve_contact against the closed form. Dotted: the expected order.",
        {q: (sizes, column, allowed[q][1]) for q, column in zip(allowed, errors.T, strict=True)},
        f"1 / {size}",
        "relative error",
    )


def cylinder(cells: int, place: float) -> tuple[float, ...]:
    """Errors with ``cells + place`` cells in the half-width. The patch is four half-widths wide and four cells long."""
    across = cells + place
    exact, dx = Line(E_PRIME, RADIUS, SIZE), SIZE / across
    n = 2 * int(2 * across)
    x = (np.arange(n) - (n - 1) / 2) * dx
    c = lubfric.solve_contact(
        np.tile(x[:, None] ** 2 / (2 * RADIUS), (1, 4)),
        dx,
        E_PRIME,
        boundary=("free", "periodic"),
        mean_pressure=exact.load / (n * dx),
        tolerance=TOLERANCE,
    )
    p = c.pressure[:, 0]
    width = 2 * np.sqrt(p @ x**2 / p.sum())
    return (
        p.max() / exact.peak - 1,
        width / SIZE - 1,
        np.count_nonzero(p) * dx / (2 * SIZE) - 1,
        c.gap.mean() / exact.mean_gap(n * dx / 2) - 1,
    )


def sphere(cells: int, place: float) -> tuple[float, ...]:
    """Errors with ``cells + place`` cells in the contact radius, on a square of four radii."""
    across = cells + place
    exact, dx = Sphere(E_PRIME, RADIUS, SIZE), SIZE / across
    n = 2 * int(2 * across)
    x = (np.arange(n) - (n - 1) / 2) * dx
    square = x[:, None] ** 2 + x**2
    c = lubfric.solve_contact(
        square / (2 * RADIUS),
        dx,
        E_PRIME,
        boundary=("free", "free"),
        mean_pressure=exact.load / (n * dx) ** 2,
        tolerance=TOLERANCE,
    )
    p, near = c.pressure, square < (2 * SIZE) ** 2
    radius = np.sqrt(2.5 * np.sum(p * square) / p.sum())
    fine = (np.arange(8 * n) - (8 * n - 1) / 2) * dx / 8
    r = np.hypot(fine[:, None], fine)
    gap = exact.gap(r).reshape(n, 8, n, 8).mean(axis=(1, 3))[near].mean()
    return (
        p.max() / exact.peak - 1,
        radius / SIZE - 1,
        np.count_nonzero(p) * dx**2 / (np.pi * SIZE**2) - 1,
        c.gap[near].mean() / gap - 1,
        c.approach / exact.approach - 1,
    )


def wave(cells: int, place: float) -> tuple[float, ...]:
    """Errors with four times ``cells`` cells in the wave. ``place`` shifts the crest and changes the load."""
    n = 4 * cells
    exact = Wave(E_PRIME, 100e-9, 45e-6, 0.2 + 0.3 * place)
    x = (np.arange(n) + 0.5 + place) * exact.length / n
    gap0 = -exact.amplitude * np.cos(2 * np.pi * x / exact.length)
    c = lubfric.solve_contact(
        np.tile(gap0[:, None], (1, 4)),
        exact.length / n,
        E_PRIME,
        mean_pressure=exact.mean_pressure,
        tolerance=TOLERANCE,
    )
    p, true = c.pressure[:, 0], exact.pressure(x)
    return (
        p.max() / exact.pressure(0) - 1,
        c.contact_area_fraction / exact.contact - 1,
        c.mean_gap / exact.mean_gap - 1,
        float(np.linalg.norm(p - true) / np.linalg.norm(true)),
    )


def row_of_spheres(cells: int):
    """Spheres in a row, 24 radii apart. The semi-periodic operator has to let each be a point contact.

    The others press it down by ``(2/(pi E')) F sum 2/(n s)``, which is a constant and a curvature. The curvature widens
    the contact by less than 1e-4 at this distance.
    """
    exact, dx = Sphere(E_PRIME, RADIUS, SIZE), SIZE / cells
    nx, ny = 4 * cells, 24 * cells
    x, y = ((np.arange(n) - (n - 1) / 2) * dx for n in (nx, ny))
    square = x[:, None] ** 2 + y**2
    c = lubfric.solve_contact(
        square / (2 * RADIUS),
        dx,
        E_PRIME,
        boundary=("free", "periodic"),
        mean_pressure=exact.load / (nx * ny * dx**2),
        tolerance=1e-6,
    )
    p = c.pressure
    found = (
        ("peak pressure", p.max(), exact.peak, "Pa"),
        ("contact radius", np.sqrt(2.5 * np.sum(p * square) / p.sum()), SIZE, "m"),
    )
    for name, measured, expected, unit in found:
        yield Check(
            f"row of spheres: {name}", measured, expected, 5e-3, f"{HERTZ}; neighbours 24 radii away", unit=unit
        )
