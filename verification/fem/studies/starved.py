"""A smooth film whose inlet starves, by finite elements: the lubricant begins at a stated place, or arrives as a layer.

The elements are those of `solvers.rough_ehl` with a smooth surface, on two grids. What is compared is extrapolated from
both by the second order of the elements; the observed order is a check of its own.
"""

import math
from collections.abc import Iterator

import numpy as np
from scipy.optimize import brentq

import lubfric

from ...check import AT_LEAST, Check, Item, Table
from ...types import Keywords, TableRow
from ..convergence import extrapolated_by, order_of_three
from ..solvers.ehl import LineContact
from ..solvers.rough_ehl import Discretisation, RoughLine, RoughStripFilm, solve_rough

CASE: Keywords = {
    "load_per_width": 1e5,
    "radius": 1e-2,
    "e_prime": 2.3e11,
    "viscosity": 0.04,
    "entrainment_speed": 0.5,
}
OIL: Keywords = {
    "pressure_viscosity_coefficient": 18e-9,
    "viscosity_law": "roelands",
    "density_law": "dowson-higginson",
}
PLACES = (1.8, 1.2)  # half-widths: where the lubricant begins; flooded is some 2.5
LAYERS = (0.8, 0.5)  # of the flooded flow: the layer that arrives
OUTLET = 1.4  # half-widths
GRIDS = {"quick": (48, 64, 96), "default": (64, 96, 128), "full": (96, 144, 192)}
ACROSS = 2  # nodes over a period: nothing changes across
ORDER = 2.0  # of bilinear elements
CLOSE = 0.1  # half-widths between two inlets: the film of one starts that of the other
NARROWEST = 1.05  # half-widths
FLOODED = 2.4  # half-widths: within 1 % of the flow of a longer inlet
SOURCE = "finite elements with the same inlet, extrapolated from two grids"
ALLOWED = {"smallest film": 0.01, "film at x = 0": 0.01, "flow film": 0.01}


def starved(level: str) -> Iterator[Item]:
    """Smallest film, film in the middle and flow of a starved inlet, by `lubfric.solve_ehl` and by finite elements.

    Where the lubricant begins is stated (``inlet_length``), or follows from the layer that arrives (``inlet_film``):
    the elements look for the place at which the flow is that of the layer, by a root finder of their own.
    """
    rows: list[TableRow] = []
    grids = GRIDS[level]
    bodies: dict[int, Discretisation] = {}
    for place in PLACES:
        films = [film_from(place, n, bodies) for n in grids]
        name = f"inlet at {place:g} b"
        ours = lubfric.solve_ehl(**CASE, **OIL, inlet_length=place * half_width(), tolerance=1e-4)
        yield from compared(name, ours, films, grids, rows)
        if place == PLACES[0]:
            yield order_of(films, grids)
    flooded = lubfric.solve_ehl(**CASE, **OIL, tolerance=1e-4).flow_film
    for share in LAYERS if level != "quick" else LAYERS[:1]:
        layer = share * flooded
        films = [fed_with(layer, n, bodies) for n in grids[1:]]
        name = f"layer of {share:g} of the flow"
        ours = lubfric.solve_ehl(**CASE, **OIL, inlet_film=layer, tolerance=1e-4)
        yield from compared(name, ours, films, grids[1:], rows)
    caption = "Starved inlets: films by lubfric, and by finite elements extrapolated to no cells"
    yield Table("starved", caption, ("case", "by", "smallest film (nm)", "film at x = 0 (nm)", "flow film (nm)"), rows)


def half_width() -> float:
    """Return the half-width of Hertz [m]."""
    return LineContact.of(CASE | OIL).half_width


def film_from(
    place: float, cells: int, bodies: dict[int, Discretisation], start: RoughStripFilm | None = None
) -> RoughStripFilm:
    """Return the film by finite elements, with the lubricant from ``place`` [half-widths] upstream on; ``start``: one
    with another inlet."""
    contact = LineContact.of(CASE | OIL)
    b = contact.half_width
    step = (place + OUTLET) * b / (cells - 1)
    problem = RoughLine(
        contact=contact,
        inlet=-place * b,
        outlet=OUTLET * b,
        period=4 * step,
        cells=(cells, ACROSS),
        heights=lambda x, y, time: 0.0 * x * y,
    )
    grid = Discretisation(problem, bodies.get(cells))
    bodies[cells] = grid
    return solve_rough(grid, start)


def fed_with(layer: float, cells: int, bodies: dict[int, Discretisation]) -> RoughStripFilm:
    """Return the film by finite elements into which flows what a ``layer`` [m] brings."""
    speed = CASE["entrainment_speed"]
    known: dict[float, RoughStripFilm] = {}

    def excess(place: float) -> float:
        near = min(known, key=lambda other: abs(other - place), default=math.inf)
        start = known[near] if abs(near - place) < CLOSE else None
        known[place] = film_from(place, cells, bodies, start)
        return float(known[place].flow / speed / layer - 1)

    place = brentq(excess, NARROWEST, FLOODED, xtol=1e-3)
    return known.get(place) or film_from(place, cells, bodies)


def films_of(film: RoughStripFilm) -> np.ndarray:
    """Return smallest film, film at x = 0 and flow film [m]."""
    x = film.problem.x
    gap = film.gap[:, 0]
    lowest = int(gap[1:-1].argmin()) + 1
    parabola = np.polynomial.Polynomial.fit(x[lowest - 1 : lowest + 2], gap[lowest - 1 : lowest + 2], 2)
    smallest = float(parabola(parabola.deriv().roots()[0].real))
    middle = float(np.interp(0.0, x, gap))
    return np.array([smallest, middle, film.flow / CASE["entrainment_speed"]])


def extrapolated(films: list[RoughStripFilm], grids: tuple[int, ...]) -> np.ndarray:
    """Return the three films [m] of the finest two grids, extrapolated."""
    return extrapolated_by(ORDER, [1 / (n - 1) for n in grids], [films_of(film) for film in films])


def compared(
    name: str, ours: lubfric.EHLResult, films: list[RoughStripFilm], grids: tuple[int, ...], rows: list[TableRow]
) -> Iterator[Item]:
    """The checks of one inlet."""
    mine = (ours.min_film, float(ours.film_at(np.array([0.0]))[0]), ours.flow_film)
    theirs = extrapolated(films, grids)
    for by, values in (("lubfric", mine), ("elements", theirs)):
        rows.append((name, by, *(f"{1e9 * value:.2f}" for value in values)))
    for (quantity, allowed), value, expected in zip(ALLOWED.items(), mine, theirs):
        yield Check(f"{name}: {quantity}", value, expected=float(expected), tolerance=allowed, source=SOURCE, unit="m")


def order_of(films: list[RoughStripFilm], grids: tuple[int, ...]) -> Check:
    """Return the order in which the flow of three grids converges."""
    order = order_of_three([1 / (n - 1) for n in grids], [film.flow for film in films])
    source = "bilinear elements: second order"
    return Check(
        "order of the flow in the cell of the elements",
        order,
        expected=ORDER,
        tolerance=0.6,
        source=source,
        kind=AT_LEAST,
        grade="B",
    )
