"""Dry contact of `lubfric` against closed forms on ever finer grids, for each of the three boundary conditions."""

from collections.abc import Callable, Iterator

import numpy as np

import lubfric

from ...check import AT_LEAST, Item, Table, bound, compared
from ...types import Keywords
from ..convergence import Series, convergence
from ..exact_contact import Line, Sphere, Wave
from ..parts import pressed_cylinder

E_PRIME = 231e9  # Pa, E' of the paper's cylinder
RADIUS = 2e-3  # m, of the paper's cylinder
SIZE = 4.5e-6  # m, half-width or radius of the contact
TOLERANCE = 1e-8  # of the contact: below the errors of the grid
CELLS = {"quick": (8, 16, 32), "default": (8, 16, 32, 64, 128), "full": (8, 16, 32, 64, 128, 256)}
SPHERE_CELLS = {"quick": (4, 8, 16), "default": (4, 8, 16, 32, 64), "full": (4, 8, 16, 32, 64, 128)}
PLACES = 6  # positions of the contact edge within a cell
HERTZ = "closed form, Hertz 1882"
REASONS = {
    1: "cells are wholly in contact or not, pressure rises like a root at the edge",
    2: "means are of second order",
}
# bound on the error with 32 cells in the half-width or a quarter of the wave, 16 in the radius, and its order
LINE = {"peak pressure": (2e-4, 2), "contact size": (4e-4, 2), "contact area": (2e-2, 1), "mean gap": (4e-4, 2)}
BALL = {
    "peak pressure": (1.5e-3, 2),
    "contact size": (7e-4, 2),
    "contact area": (2.5e-2, 1),
    "mean gap": (8e-4, 2),
    "approach": (3e-4, 2),
}
WAVE = {"peak pressure": (5e-4, 2), "contact area": (2e-2, 1), "mean gap": (3e-4, 2), "pressure, L2": (1.2e-2, 1)}


def contact_grid(level: str) -> Iterator[Item]:
    """`lubfric.solve_contact` on smooth shapes with closed forms. Errors are shown against the cells in the contact.

    The shapes are a cylinder (free along x, periodic along y), a sphere (free both ways), a wave (periodic both ways),
    and a row of spheres so far apart that they do not interact (free along x, periodic along y: only the waves along y
    distinguish it from a cylinder). The position of the edge of the contact in its cell is random, so errors are root
    mean squares over six positions. A cell is in contact or not, so the area is of first order. Pressure and gap are
    smoother. The contact size follows from the second moment of the pressure.
    """
    yield from family(cylinder, CELLS[level], "cells in a half-width", 32, LINE, HERTZ)
    yield from family(sphere, SPHERE_CELLS[level], "cells in a radius", 16, BALL, HERTZ)
    source = "closed form, Westergaard 1939"
    yield from family(wave, CELLS[level], "cells in a quarter of the wave", 32, WAVE, source)
    yield from row_of_spheres(16)


def family(
    solve: Callable[[int, float], tuple[float, ...]],
    cells: tuple[int, ...],
    size: str,
    at: int,
    allowed: dict[str, tuple[float, int]],
    source: str,
) -> Iterator[Item]:
    """Errors of one shape on all grids.

    ``allowed`` is the bound with ``at`` cells, and the order by which it falls.
    """
    name = solve.__name__
    errors = np.array(
        [np.sqrt(np.mean([np.square(solve(n, place / PLACES)) for place in range(PLACES)], axis=0)) for n in cells]
    )
    sizes = 1 / np.array(cells)
    series = []
    for (quantity, (most, order)), column in zip(allowed.items(), errors.T, strict=True):
        limit = most * (at / cells[-1]) ** order
        note = f"{cells[-1]} {size}"
        yield bound(f"{name}: {quantity}, relative error", column[-1], limit, source, note)
        check = f"{name}: {quantity}, order"
        series.append(
            Series(
                quantity,
                sizes,
                errors=column,
                order=order,
                check=check,
                tolerance=0.3,
                source=REASONS[order],
                kind=AT_LEAST,
            )
        )
    caption = f"Relative errors of a {name}, root mean squares over {PLACES} places of the edge."
    yield Table(f"contact_{name}", caption, (size, *allowed), [(n, *row) for n, row in zip(cells, errors.tolist())])
    caption = f"Errors of a {name} by lubfric.solve_contact against the closed form. Dotted: the expected order."
    yield from convergence(f"contact_{name}", caption, series, f"1 / {size}", "relative error")


def centred(count: int, step: float) -> np.ndarray:
    """Return centres of ``count`` cells about 0."""
    return (np.arange(count) - (count - 1) / 2) * step


def cylinder(cells: int, place: float) -> tuple[float, ...]:
    """Return errors with ``cells + place`` cells in the half-width. The patch is four half-widths wide and four cells
    long."""
    exact = Line(E_PRIME, RADIUS, SIZE)
    x, c = pressed_cylinder(exact, cells + place)
    dx = x[1] - x[0]
    p = c.pressure[:, 0]
    return (
        p.max() / exact.peak - 1,
        2 * np.sqrt(p @ x**2 / p.sum()) / SIZE - 1,
        np.count_nonzero(p) * dx / (2 * SIZE) - 1,
        c.gap.mean() / exact.mean_gap(x[-1] + dx / 2) - 1,
    )


def sphere(cells: int, place: float) -> tuple[float, ...]:
    """Return errors with ``cells + place`` cells in the contact radius, on a square of four radii."""
    across = cells + place
    exact = Sphere(E_PRIME, RADIUS, SIZE)
    dx = SIZE / across
    n = 2 * int(2 * across)
    x = centred(n, dx)
    square = x[:, None] ** 2 + x**2
    options: Keywords = {"boundary": ("free", "free"), "tolerance": TOLERANCE}
    mean = exact.load / (n * dx) ** 2
    c = lubfric.solve_contact(square / (2 * RADIUS), dx, E_PRIME, mean_pressure=mean, **options)
    p = c.pressure
    near = square < (2 * SIZE) ** 2
    fine = centred(8 * n, dx / 8)
    gap = exact.gap(np.hypot(fine[:, None], fine)).reshape(n, 8, n, 8).mean(axis=(1, 3))[near].mean()
    return (
        p.max() / exact.peak - 1,
        np.sqrt(2.5 * np.sum(p * square) / p.sum()) / SIZE - 1,
        np.count_nonzero(p) * dx**2 / (np.pi * SIZE**2) - 1,
        c.gap[near].mean() / gap - 1,
        c.approach / exact.approach - 1,
    )


def wave(cells: int, place: float) -> tuple[float, ...]:
    """Return errors with four times ``cells`` cells in the wave. ``place`` shifts the crest and changes the load."""
    n = 4 * cells
    exact = Wave(E_PRIME, 100e-9, 45e-6, 0.2 + 0.3 * place)
    x = (np.arange(n) + 0.5 + place) * exact.length / n
    gap0 = np.tile(-exact.amplitude * np.cos(2 * np.pi * x / exact.length)[:, None], (1, 4))
    options: Keywords = {"mean_pressure": exact.mean_pressure, "tolerance": TOLERANCE}
    c = lubfric.solve_contact(gap0, exact.length / n, E_PRIME, **options)
    p = c.pressure[:, 0]
    true = exact.pressure(x)
    return (
        p.max() / exact.pressure(0) - 1,
        c.contact_area_fraction / exact.contact - 1,
        c.mean_gap / exact.mean_gap - 1,
        float(np.linalg.norm(p - true) / np.linalg.norm(true)),
    )


def row_of_spheres(cells: int) -> Iterator[Item]:
    """Spheres in a row, 24 radii apart. The semi-periodic operator has to let each be a point contact.

    The others press it down by ``(2/(pi E')) F sum 2/(n s)``, which is a constant and a curvature. The curvature widens
    the contact by less than 1e-4 at this distance.
    """
    exact = Sphere(E_PRIME, RADIUS, SIZE)
    dx = SIZE / cells
    nx = 4 * cells
    ny = 24 * cells
    square = centred(nx, dx)[:, None] ** 2 + centred(ny, dx) ** 2
    options: Keywords = {"boundary": ("free", "periodic"), "tolerance": 1e-6}
    mean = exact.load / (nx * ny * dx**2)
    p = lubfric.solve_contact(square / (2 * RADIUS), dx, E_PRIME, mean_pressure=mean, **options).pressure
    rows = [
        ("peak pressure", "Pa", p.max(), exact.peak, 5e-3),
        ("contact radius", "m", np.sqrt(2.5 * np.sum(p * square) / p.sum()), SIZE, 5e-3),
    ]
    yield from compared("row of spheres", rows, f"{HERTZ}; neighbours 24 radii away")
