"""One strip of the deterministic model, rough in both directions, compared with finite elements: at rest and moving.

The strip is a steel roller with Roelands' oil whose inlet begins at a stated place, under a surface of a few waves
each way, 2 by 1 Hertz half-widths in period. `lubfric.models.deterministic` solves it on cells (finite volumes,
half-space by Fourier transforms), `solvers.rough_ehl` on bilinear elements over an elastic body of finite elements.
They have only the case in common. Both are solved on two or three grids; the change between them is the error of each.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from lubfric.models.deterministic import Problem, lay_out, moments, solve_point
from lubfric.surface import Surface

from ...check import ABSOLUTE, Check, Field, Item, Table
from ...types import Keywords, PlainRow, TableRow
from ..convergence import extrapolated_by, order_of_three
from ..parts import line_contact
from ..solvers.ehl import LineContact
from ..solvers.rough_ehl import Discretisation, RoughLine, RoughStripFilm, march, solve_rough

STEEL: Keywords = {"radius": 1e-2, "e_prime": 2.3e11, "viscosity": 0.04}
OIL: Keywords = {
    "pressure_viscosity_coefficient": 18e-9,
    "viscosity_law": "roelands",
    "density_law": "dowson-higginson",
}
LOADS = (1e5, 4e5)  # N/m: 0.61 and 1.21 GPa of Hertz
SPEED = 0.5  # m/s
SQ = 50e-9  # m, a quarter to a third of the film
INLET = 3.5  # half-widths: where the film begins
OUTLET = 1.5  # half-widths: where the grid ends
PERIODS = (2.0, 1.0)  # of the roughness along and across, in half-widths
WAVES = 2  # harmonics each way
SEED = 3  # of the heights and phases of the waves
PACE = 0.75  # speed of the roughness over that of the film: surface 1 at a slide-roll ratio of 0.5
GRIDS = {"quick": ((64, 8), (96, 12)), "default": ((64, 8), (96, 12)), "full": ((96, 12), (144, 16))}
# cells of lubfric in a half-width: at rest (a fraction of a second), and moving
CELLS = {"quick": (32, 64), "default": (32, 64), "full": (48, 96)}
MOVING_CELLS = {"default": (24, 36), "full": (32, 48)}
# Three grids of each program for the mesh study of the first load, at rest and moving. With multiples of three cells
# the film passes one cell in a step, so that the mass is followed along the lubricant, by steps of third order.
MOVING_STUDY_CELLS = (24, 36, 48)
STUDY_GRIDS = ((64, 8), (96, 12), (128, 16))
STUDY_CELLS = (32, 64, 128)
ORDER = 2.0  # of bilinear elements, and of the cells of lubfric
ALLOWED_ORDER = 0.4  # distance of an order from that
ALLOWED_MOVING_LIMIT = 0.005  # of the smallest gap while the surface moves, likewise: they differ by 1e-3
ALLOWED_LIMIT = 0.002  # of the flow, both extrapolated to no cells: they differ by 1e-4
SWEEP = 3.0  # half-widths that the film travels before a moving surface counts
MOMENTS = 8  # of a period that are compared
NEAR = 0.8  # half-widths: where fields are compared
PRECISION = 1e-7  # of the balances at rest
STEP_PRECISION = 1e-5  # of the balances of a step in time
SOURCE = "finite elements of one gap and one pressure"
# Allowed: of the mean gap, the flow, the smallest gap and the viscous force; rms of the gap over Sq, of the pressure
# over that of Hertz. The differences fall with the cell, as the table shows; these are for the finer grids.
ALLOWED = {"mean gap": 0.01, "flow": 0.015, "smallest gap": 0.02, "viscous force": 0.05}
THIN = 1.1  # of the floor: gaps up to which bodies count as touching; just above the floor there is no other difference
ALLOWED_GAP = 0.05  # rms difference of the gap, of Sq
ALLOWED_PRESSURE = 0.03  # rms difference of the pressure, of that of Hertz

Heights = Callable[[np.ndarray, np.ndarray, float], np.ndarray]


@dataclass(frozen=True, kw_only=True)
class StripCase:
    """A strip: load [N/m], speed of the film [m/s], roughness Sq [m], and the gap [m] of bodies that touch (``floor``;
    None: they never touch)."""

    load: float
    speed: float = SPEED
    sq: float = SQ
    floor: float | None = None

    @property
    def given(self) -> PlainRow:
        """The smooth contact, in the words of both programs."""
        return STEEL | OIL | {"load_per_width": self.load, "entrainment_speed": self.speed}

    @property
    def contact(self) -> LineContact:
        """The contact for the finite elements."""
        return LineContact.of(self.given)


@dataclass(frozen=True, kw_only=True)
class Fields:
    """A film at a moment, wherever it was solved: x, y [m] over half of the period, pressure [Pa] and gap [m] there,
    and the flow [m²/s] per width that enters, NaN if it was not summed."""

    x: np.ndarray
    y: np.ndarray
    pressure: np.ndarray
    gap: np.ndarray
    flow: float = math.nan


def rough_strip(level: str) -> Iterator[Item]:
    """Gap, pressure, flow and viscous force of a rough strip by the deterministic model and by finite elements.

    Two loads, roughness of two waves each way (Sq 50 nm) at rest, then moving at 0.75 U (slide-roll ratio 0.5), where
    the gap and pressure of eight moments of a period are compared. Each program is solved on two grids, and the check
    takes the finer of both; the table has all. The first load at rest is solved on three, with the order of the flow of
    each program, and both flows extrapolated to no cells. So is it moving, with the order of the smallest gap by
    lubfric and of the flow by elements: the flow by the pressure is of second order in both, which decides.
    """
    rows: list[TableRow] = []
    bodies: dict[tuple[int, int], Discretisation] = {}
    for load in LOADS:
        case = StripCase(load=load)
        for moving in (False, True):
            if level == "quick" and (moving or load != LOADS[0]):
                continue
            name = f"{load:g} N/m, {'moving' if moving else 'at rest'}"
            is_studied = level != "quick" and load == LOADS[0]
            cells: tuple[int, ...]
            grids: tuple[tuple[int, int], ...]
            if is_studied:
                cells = MOVING_STUDY_CELLS if moving else STUDY_CELLS
                grids = STUDY_GRIDS
            else:
                cells = MOVING_CELLS[level] if moving else CELLS[level]
                grids = GRIDS[level]
            ours, elements = both_programs(case, cells, grids, moving=moving, bodies=bodies)
            yield from judged_films(name, case, ours[-1], elements[-1], ALLOWED)
            if is_studied and not moving:
                yield from mesh_study(name, cells, ours, grids, elements)
            elif is_studied:
                yield from moving_mesh_study(name, case, cells, ours, grids, elements)
            rows += rows_of(name, case, cells, ours, grids, elements)
            if not moving:
                picture = f"rough_strip_{load:.0f}"
                yield picture_field(picture, f"the rough strip at {load:g} N/m", case, ours[-1][0], elements[-1][0])
    caption = (
        "One strip by both programs, on two or three grids each: means over |x| < 0.8 b, and over the moments compared"
    )
    yield Table("rough-strip", caption, ("case", "by", "cells in b", *QUANTITIES), rows)


def mesh_study(
    name: str,
    cells: tuple[int, ...],
    ours: list[list[Fields]],
    grids: tuple[tuple[int, int], ...],
    elements: list[list[Fields]],
) -> Iterator[Item]:
    """The order in which the flow of each program converges, and both flows extrapolated to no cells."""
    limits = []
    for by, sizes, solutions in (
        ("lubfric", [1 / count for count in cells], ours),
        ("elements", [1 / (grid[0] - 1) for grid in grids], elements),
    ):
        flows = [films[0].flow for films in solutions]
        source = "second order of cells and bilinear elements"
        yield order_check(f"{name}: order of the flow by {by}", sizes, flows, source)
        limits.append(extrapolated_by(ORDER, sizes, flows))
    mine, theirs = (float(limit) for limit in limits)
    yield Check(f"{name}: flow without cells", mine, expected=theirs, tolerance=ALLOWED_LIMIT, source=SOURCE)


def order_check(name: str, sizes: list[float], values: list[float], source: str) -> Check:
    """Return the check ``name`` of the order in which ``values`` on three grids of these ``sizes`` converge."""
    return Check(
        name,
        order_of_three(sizes, values),
        expected=ORDER,
        tolerance=ALLOWED_ORDER,
        source=source,
        kind=ABSOLUTE,
        grade="B",
    )


def moving_mesh_study(
    name: str,
    case: StripCase,
    cells: tuple[int, ...],
    ours: list[list[Fields]],
    grids: tuple[tuple[int, int], ...],
    elements: list[list[Fields]],
) -> Iterator[Item]:
    """The order in which the smallest gap of a moving strip converges by lubfric, and the flow by elements; and the
    smallest gap of both extrapolated to no cells."""
    source = "second order of the flow by the pressure; the mass that moves along is of third in lubfric"
    limits = []
    for by, quantity, sizes, solutions in (
        ("lubfric", "smallest gap", [1 / count for count in cells], ours),
        ("elements", "flow", [1 / (grid[0] - 1) for grid in grids], elements),
    ):
        means = [averages(case, films) for films in solutions]
        yield order_check(f"{name}: order of the {quantity} by {by}", sizes, [mean[quantity] for mean in means], source)
        limits.append(extrapolated_by(ORDER, sizes, [mean["smallest gap"] for mean in means]))
    mine, theirs = (float(limit) for limit in limits)
    words = f"{name}: smallest gap without cells"
    yield Check(words, mine, expected=theirs, tolerance=ALLOWED_MOVING_LIMIT, source=SOURCE, unit="m")


QUANTITIES = ("mean gap (m)", "smallest gap (m)", "flow (m²/s)", "viscous force (N/m per m/s)")


def both_programs(
    case: StripCase,
    cells: tuple[int, ...],
    grids: tuple[tuple[int, int], ...],
    *,
    moving: bool,
    bodies: dict[tuple[int, int], Discretisation],
) -> tuple[list[list[Fields]], list[list[Fields]]]:
    """Return the films of lubfric with each number of ``cells`` in a half-width, and those of finite elements on each
    of the ``grids``. ``bodies`` keeps the elastic body of each grid."""
    ours = [own_films(case, count, moving=moving) for count in cells]
    elements = []
    for grid in grids:
        films, bodies[grid] = element_films(case, grid, moving=moving, like=bodies.get(grid))
        elements.append(films)
    return ours, elements


def rows_of(
    name: str,
    case: StripCase,
    cells: tuple[int, ...],
    ours: list[list[Fields]],
    grids: tuple[tuple[int, int], ...],
    elements: list[list[Fields]],
) -> list[TableRow]:
    """Return the rows of the table: what each program has on each of its grids."""
    finenesses = [round((grid[0] - 1) / (INLET + OUTLET)) for grid in grids]
    rows: list[TableRow] = []
    for by, counts, solutions in (("lubfric", cells, ours), ("elements", finenesses, elements)):
        for count, films in zip(counts, solutions):
            rows.append((name, by, count, *(f"{value:.5g}" for value in averages(case, films).values())))
    return rows


def surface_of(b: float, pace: float = 0.0, sq: float = SQ) -> Heights:
    """Return z [m] of x, y [m] and a time [s]: waves with random heights and phases, even in y, that move at ``pace``
    [m/s]."""
    rng = np.random.default_rng(SEED)
    along = PERIODS[0] * b
    across = PERIODS[1] * b
    waves = [(m, n) for m in range(1, WAVES + 1) for n in range(WAVES + 1)]
    sizes = rng.standard_normal(len(waves)) / np.array([math.sqrt(1 + m * m + n * n) for m, n in waves])
    phases = rng.uniform(0, 2 * math.pi, len(waves))
    squares = [size**2 * (0.25 if n else 0.5) for size, (_, n) in zip(sizes, waves)]
    scale = sq / math.sqrt(sum(squares))

    def heights(x: np.ndarray, y: np.ndarray, time: float) -> np.ndarray:
        z = 0.0 * x * y
        for (m, n), size, phase in zip(waves, sizes, phases):
            z = z + size * np.cos(2 * math.pi * m * (x - pace * time) / along + phase) * np.cos(
                2 * math.pi * n * y / across
            )
        return scale * z

    return heights


def element_films(
    case: StripCase, cells: tuple[int, int], *, moving: bool, like: Discretisation | None
) -> tuple[list[Fields], Discretisation]:
    """Return the films by finite elements: one at rest, or the `MOMENTS` of a period."""
    contact = case.contact
    b = contact.half_width
    speed = contact.entrainment_speed
    pace = PACE * speed if moving else 0.0
    problem = RoughLine(
        contact=contact,
        inlet=-INLET * b,
        outlet=OUTLET * b,
        period=PERIODS[1] * b,
        cells=cells,
        heights=surface_of(b, pace, case.sq),
        floor=case.floor,
    )
    grid = Discretisation(problem, like)
    start = solve_rough(grid, tolerance=PRECISION)
    if not moving:
        return [fields_of(start)], grid
    count, first = steps_of(b, speed, problem.spacing[0])
    films = islice(march(grid, start, PERIODS[0] * b / pace / count, tolerance=STEP_PRECISION), first + count)
    every = count // MOMENTS
    chosen = [film for k, film in enumerate(films, 1) if k > first and (k - first) % every == 0]
    return [fields_of(film) for film in chosen], grid


def steps_of(b: float, speed: float, cell: float) -> tuple[int, int]:
    """Return steps in a period of the moving surface, about as many as the film needs cells, and the steps before the
    evaluation: an integer number of periods, so that both programs begin at the same phase."""
    period = PERIODS[0] * b / (PACE * speed)
    count = MOMENTS * max(1, round(period * speed / cell / MOMENTS))
    periods = math.ceil(SWEEP * b / speed / period)
    return count, periods * count


def fields_of(film: RoughStripFilm) -> Fields:
    """Return the fields of a finite-element film."""
    return Fields(x=film.problem.x, y=film.problem.y, pressure=film.pressure, gap=film.gap, flow=film.flow)


def own_films(case: StripCase, cells: int, *, moving: bool) -> list[Fields]:
    """Return the films of the deterministic model with so many ``cells`` in a half-width."""
    line = line_contact(case.given)
    b = line.half_width
    line = replace(line, lubricant=replace(line.lubricant, inlet_length=INLET * b))
    step = b / cells
    shape = (round(PERIODS[0] * cells), round(PERIODS[1] * cells / 2))
    flat = Surface(np.zeros(shape), (step, PERIODS[1] * b / shape[1]), periodic_axes=(True, True))
    ends = ((INLET + 1) * b, OUTLET * b)
    bare = lay_out(flat, line, sliding=0.0, boundary_friction=0.1, ends=ends)
    if case.floor is not None:
        bare = replace(bare, floor=case.floor)
    y = np.arange(shape[1]) * bare.spacing[1]
    speed = line.entrainment_speed
    pace = PACE * speed if moving else 0.0
    heights = surface_of(b, pace, case.sq)

    def problem(time: float) -> Problem:
        return replace(bare, heights=heights(bare.x[:, None], y, time))

    if not moving:
        result = solve_point(problem(0.0), tolerance=PRECISION)
        return [half_of(problem(0.0), result.pressure, result.gap, result.flow_film * speed)]
    count, first = steps_of(b, speed, step)
    films = islice(moments(problem, PERIODS[0] * b / pace / count, tolerance=STEP_PRECISION), first + count + 1)
    every = count // MOMENTS
    chosen = [m for k, m in enumerate(films) if k > first and (k - first) % every == 0]
    return [half_of(bare, m.at.state.pressure, m.at.gap, math.nan) for m in chosen]


def half_of(problem: Problem, pressure: np.ndarray, gap: np.ndarray, flow: float) -> Fields:
    """Return the fields over half of the period, which is its own mirror image."""
    half = gap.shape[1] // 2 + 1
    y = np.arange(half) * problem.spacing[1]
    return Fields(x=problem.x, y=y, pressure=pressure[:, :half], gap=gap[:, :half], flow=flow)


def middle_of(case: StripCase, film: Fields) -> tuple[np.ndarray, np.ndarray]:
    """Return pressure [Pa] and gap [m] on a common grid of the middle of the contact."""
    b = case.contact.half_width
    x = np.linspace(-NEAR * b, NEAR * b, 161)
    y = np.linspace(0.0, PERIODS[1] * b / 2, 41)
    points = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    values = []
    for field in (film.pressure, film.gap):
        method = "cubic" if case.floor is None else "linear"  # touching bodies have kinks in their gap
        values.append(RegularGridInterpolator((film.x, film.y), field, method)(points))
    return values[0], values[1]


def averages(case: StripCase, films: list[Fields]) -> dict[str, float]:
    """Return mean and smallest gap, flow, and the viscous force at a sliding speed of 1 m/s, over |x| < 0.8 b and over
    the moments. Of bodies that touch, the share of the load on gaps up to `THIN` floors stands for the smallest gap,
    which is the floor."""
    contact = case.contact
    width = 2 * NEAR * contact.half_width
    gaps = []
    forces = []
    shares = []
    for film in films:
        pressure, gap = middle_of(case, film)
        gaps.append(gap)
        forces.append(float((contact.fluid.eta(np.maximum(pressure, 0.0)) / gap).mean()) * width)
        if case.floor is not None:
            shares.append(float(pressure[gap <= THIN * case.floor].sum() / pressure.sum()))
    thinnest = {"touching load": float(np.mean(shares))} if shares else {"smallest gap": float(np.min(gaps))}
    return {
        "mean gap": float(np.mean(gaps)),
        **thinnest,
        "flow": float(np.mean([film.flow for film in films])),
        "viscous force": float(np.mean(forces)),
    }


def judged_films(
    name: str, case: StripCase, ours: list[Fields], elements: list[Fields], allowed: dict[str, float]
) -> Iterator[Item]:
    """Yield the checks of one case, of both programs at the same moments. ``allowed``: of each average, relative."""
    hertz = case.contact.hertz_pressure
    mine = averages(case, ours)
    theirs = averages(case, elements)
    for quantity, most in allowed.items():
        if math.isfinite(mine[quantity]) and math.isfinite(theirs[quantity]):
            yield Check(f"{name}: {quantity}", mine[quantity], expected=theirs[quantity], tolerance=most, source=SOURCE)
    pairs = [(middle_of(case, a), middle_of(case, b)) for a, b in zip(ours, elements, strict=True)]
    pressure = math.sqrt(np.mean([(a[0] - b[0]) ** 2 for a, b in pairs])) / hertz
    gap = math.sqrt(np.mean([(a[1] - b[1]) ** 2 for a, b in pairs])) / case.sq
    note = f"largest pressure {max(b[0].max() for _, b in pairs) / hertz:.2f} of Hertz"
    yield Check(
        f"{name}: rms of the pressure over Hertz",
        pressure,
        expected=0.0,
        tolerance=ALLOWED_PRESSURE,
        source=SOURCE,
        kind=ABSOLUTE,
        note=note,
    )
    yield Check(
        f"{name}: rms of the gap over Sq", gap, expected=0.0, tolerance=ALLOWED_GAP, source=SOURCE, kind=ABSOLUTE
    )


def picture_field(name: str, what: str, case: StripCase, ours: Fields, elements: Fields) -> Field:
    """Return pressure and gap of both on the common grid."""
    b = case.contact.half_width
    x, y = np.meshgrid(np.linspace(-NEAR * b, NEAR * b, 161), np.linspace(0, PERIODS[1] * b / 2, 41), indexing="ij")
    corner = np.arange(x.size).reshape(x.shape)
    quads = np.stack([corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]], axis=-1).reshape(-1, 4)
    data: dict[str, np.ndarray] = {}
    for by, film in (("lubfric", ours), ("elements", elements)):
        pressure, gap = middle_of(case, film)
        data |= {f"pressure_{by}": pressure.ravel(), f"gap_{by}": gap.ravel()}
    caption = f"Pressure (Pa) and gap (m) of {what} by both programs"
    return Field(name, caption, points=np.column_stack([x.ravel(), y.ravel()]), cells={"quad": quads}, point_data=data)
