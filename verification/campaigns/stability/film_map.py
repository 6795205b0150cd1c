"""Maps of smooth line contacts: load, material, speed, laws, tolerance, poor starts, starvation."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from lubfric import EHLResult, LubfricError, solve_differential_deflection, solve_ehl
from lubfric.film.formulas import moes_film

from ...fem.parts import E_PRIME, RADIUS, case_of, moes_unit
from ...types import Keywords
from .cell import Cell
from .film_check import film_deviations

TOLERANCE = 3e-3  # the default of `solve_ehl`
FILM = 2.0  # times the tolerance asked for: allowed difference of films to the judge
OWN = {"elastic": 1e-3, "load": 1e-3, "tension": 1e-3, "gap": 1e-3, "flow": 0.01}
NODES = 8193  # of the differential deflection: where it needs more it fails, and the tightest Newton solution judges
FORMULA = 0.10  # error at which a regression formula counts as wrong
DIFFERENTIAL = "differential deflection"
MOES = "Moes formula"
LAWS = (("roelands", "constant"), ("barus", "constant"), ("roelands", "dowson-higginson"))
PAPER = {"radius": 2e-3, "e_prime": 231e9, "viscosity": 0.36, "pressure_viscosity_coefficient": 25e-9}


@dataclass(frozen=True)
class FilmCell:
    """Arguments ``case`` of the film solvers in SI units, the tolerance, and M and L of a film to start from."""

    case: Keywords = field(hash=False)
    tolerance: float = TOLERANCE
    start: tuple[float, float] | None = None


def solve(cell: Cell[FilmCell]) -> EHLResult | float:
    """Return the film of the cell by its method; of the formula, the flow film [m] alone."""
    film = cell.problem
    if cell.method == DIFFERENTIAL:
        return solve_differential_deflection(**film.case, most_nodes=NODES)
    if cell.method == MOES:
        return moes_film(cell.x, cell.y) * moes_unit(film.case["entrainment_speed"])
    start = None if film.start is None else solve_ehl(**case_of(*film.start))
    return solve_ehl(**film.case, tolerance=film.tolerance, start=start)


def deviations(cell: Cell[FilmCell], result: EHLResult | float) -> dict[str, float]:
    """Return the residuals of a film, and the deviations of its thicknesses from another discretisation, over the
    allowed ones."""
    case = cell.problem.case
    tolerance = cell.problem.tolerance
    if cell.default:
        smallest, flow = reference(tuple(sorted(case.items())), tolerance)
    else:
        tight = solve_ehl(**case, tolerance=0.1 * TOLERANCE)
        smallest = tight.min_film
        flow = tight.flow_film
    if isinstance(result, float):
        return {"flow_film": abs(result / flow - 1) / FORMULA}
    ratios = {name: value / OWN[name] for name, value in film_deviations(result, case).items()}
    ratios["flow"] *= min(1.0, TOLERANCE / tolerance)  # judged by the grid that was asked for
    films = {"min_film": result.min_film / smallest, "flow_film": result.flow_film / flow}
    return ratios | {name: abs(value - 1) / (FILM * tolerance) for name, value in films.items()}


@lru_cache(maxsize=64)
def reference(items: tuple[tuple[str, object], ...], tolerance: float) -> tuple[float, float]:
    """Return smallest and flow film [m] by another discretisation, or else by the tightest Newton solution that there
    is."""
    ways: tuple[tuple[Callable[..., EHLResult], Keywords], ...] = (
        (solve_differential_deflection, {"tolerance": max(tolerance / 3, 1e-4), "most_nodes": NODES}),
        (solve_ehl, {"tolerance": 0.1 * tolerance}),
        (solve_ehl, {"tolerance": 0.3 * tolerance}),
    )
    for solver, options in ways:
        try:
            film = solver(**dict(items), **options)
        except LubfricError:
            continue
        return film.min_film, film.flow_film
    return math.nan, math.nan


def promised(M: float, L: float) -> bool:
    """Return whether M and L lie within the range that the default answers for."""
    return 0.99e-3 <= M <= 1001 and L <= 20.01


def cells(*, quick: bool) -> Iterator[Cell[FilmCell]]:
    """All film cells."""
    for part in (load_and_material, speeds, tolerances, starts, starved):
        yield from part(quick=quick)


def load_and_material(*, quick: bool) -> Iterator[Cell[FilmCell]]:
    """M by L for each law. Where the law is Roelands' at constant density, the paper's discretisation and Moes'
    formula are also tried; their reference is the default method with a tight tolerance."""
    loads = np.geomspace(1e-3, 1e3, 3) if quick else np.append(np.geomspace(1e-3, 1e3, 9), (3e3, 1e4))
    for law, density in LAWS:
        for M in loads.tolist():
            for L in (0.0, 5.0, 20.0) if quick else (0.0, 1.0, 2.5, 5.0, 10.0, 15.0, 20.0, 25.0):
                for method in ("solve_ehl", DIFFERENTIAL, MOES) if (law, density) == LAWS[0] else ("solve_ehl",):
                    yield Cell(
                        map="film: load and material",
                        panel=f"{law}, density {density}",
                        x=M,
                        y=L,
                        problem=FilmCell(case_of(M, L, law, density)),
                        method=method,
                        default=method == "solve_ehl",
                        inside=promised(M, L),
                    )


def speeds(*, quick: bool) -> Iterator[Cell[FilmCell]]:
    """The paper's steel cylinder at speeds from 1e-8 m/s, either way, by load."""
    for speed in np.geomspace(1e-8, 10, 3 if quick else 10).tolist():
        for load in np.geomspace(1e-2, 1e4, 2 if quick else 7).tolist():
            sign = -1.0 if round(math.log10(load)) % 2 else 1.0
            u1 = 2 * 0.36 * speed / (231e9 * 2e-3)
            M = load / (231e9 * 2e-3) / math.sqrt(u1)
            L = 25e-9 * 231e9 * u1**0.25
            film = FilmCell(PAPER | {"load_per_width": load, "entrainment_speed": sign * speed})
            yield Cell(
                map="film: speed and load",
                panel="steel cylinder, R = 2 mm",
                x=speed,
                y=load,
                problem=film,
                method="solve_ehl",
                inside=promised(M, L),
            )


def tolerances(*, quick: bool) -> Iterator[Cell[FilmCell]]:
    """Tolerances from one tenth, where grids are far too coarse, to 1e-4. The error has to be within the tolerance."""
    few = ((1e-2, 5), (10, 10), (100, 20), (1000, 5))
    many: tuple[tuple[float, float], ...] = ((1e-3, 5), (1e-2, 5), (0.1, 10), (1, 0), (1, 10), (5, 5), (10, 10))
    many += ((20, 5), (50, 10), (100, 5), (100, 15), (100, 20), (1000, 2.5), (1000, 10), (1000, 20))
    for row, (M, L) in enumerate(few if quick else many):
        for tolerance in (0.1, 1e-2, 1e-3) if quick else (0.1, 0.05, 0.03, 0.01, 3e-3, 1e-3, 3e-4):
            film = FilmCell(case_of(M, L), tolerance)
            yield Cell(
                map="film: tolerance", panel="cases by M, L", x=row, y=tolerance, problem=film, method="solve_ehl"
            )


def starts(*, quick: bool) -> Iterator[Cell[FilmCell]]:
    """Solves that start from the solution of a contact that may be a million times lighter, or of another lubricant."""
    few = ((1e-2, 5), (10, 5), (1000, 20))
    many = ((1e-3, 0.5), (1e-2, 5), (0.1, 20), (1, 5), (5, 15), (20, 5), (100, 1), (100, 20), (1000, 5), (1000, 20))
    for column, start in enumerate(few if quick else many):
        for row, (M, L) in enumerate(few if quick else many):
            film = FilmCell(case_of(M, L), start=start)
            yield Cell(map="film: poor start", panel="cases by M, L", x=column, y=row, problem=film, method="solve_ehl")


def starved(*, quick: bool) -> Iterator[Cell[FilmCell]]:
    """Lubricant that begins at a distance of the dry contact (in half-widths plus inlet lengths)."""
    for M in (0.1, 10, 1000) if quick else (1e-3, 1e-2, 0.1, 1, 3, 10, 30, 100, 300, 1000):
        for share in (0.5, 5) if quick else (0.3, 0.5, 1, 2, 5, 20):
            case = case_of(M, 10)
            half_width = math.sqrt(8 * case["load_per_width"] * RADIUS / (math.pi * E_PRIME))
            case["inlet_length"] = half_width + share * math.sqrt(
                2 * RADIUS * moes_film(M, 10) * moes_unit(case["entrainment_speed"])
            )
            yield Cell(
                map="film: starved inlet", panel="L = 10", x=M, y=share, problem=FilmCell(case), method="solve_ehl"
            )
