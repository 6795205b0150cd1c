"""Maps of smooth line contacts: load, material, speed, laws, tolerance, poor starts, starvation."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import Any

import numpy as np

from lubfric import EHLResult, LubfricError, solve_differential_deflection, solve_ehl
from lubfric.film import moes_film

from ..cases import E_PRIME, RADIUS, VISCOSITY, case_of
from ..check import Check
from .cell import Condition, judged
from .film_check import film_deviations

TOLERANCE = 3e-3  # the default of `solve_ehl`
FILM = 2.0  # times the tolerance asked for: allowed difference of films to the judge
OWN = {"elastic": 1e-3, "load": 1e-3, "tension": 1e-3, "gap": 1e-3, "flow": 0.01}
NODES = 8193  # of the differential deflection: where it needs more it fails, and the tightest Newton solution judges
FORMULA = 0.10  # error at which a regression formula counts as wrong
LAWS = (("roelands", "constant"), ("barus", "constant"), ("roelands", "dowson-higginson"))
PAPER = {"radius": 2e-3, "e_prime": 231e9, "viscosity": 0.36, "pressure_viscosity_coefficient": 25e-9}


def cells(level: str) -> Iterator[Check]:
    """All film cells of ``level`` ("quick" or "full")."""
    quick = level == "quick"
    yield from load_and_material(quick)
    yield from speeds(quick)
    yield from tolerances(quick)
    yield from starts(quick)
    yield from starved(quick)


@lru_cache(maxsize=4096)
def _judge(items: tuple, tolerance: float) -> tuple[float, float, str]:
    """(min_film, flow_film, method) by another discretisation, or else by the tightest Newton solution that
    there is."""
    case = dict(items)
    ways: tuple[tuple[Callable[..., EHLResult], str, dict[str, Any]], ...] = (
        (
            solve_differential_deflection,
            "differential deflection",
            {"tolerance": max(tolerance / 3, 1e-4), "most_nodes": NODES},
        ),
        (solve_ehl, "tight", {"tolerance": 0.1 * tolerance}),
        (solve_ehl, "finer", {"tolerance": 0.3 * tolerance}),
    )
    for solve, name, options in ways:
        try:
            film = solve(**case, **options)
        except LubfricError:
            continue
        return film.min_film, film.flow_film, name
    return math.nan, math.nan, "none"


@lru_cache(maxsize=4096)
def _tight(items: tuple) -> tuple[float, float]:
    """Films [m] of the default at a tenth of its tolerance. A step further costs seconds at ten gigapascals."""
    film = solve_ehl(**dict(items), tolerance=0.1 * TOLERANCE)
    return film.min_film, film.flow_film


def reference(case: dict, tolerance: float = TOLERANCE) -> tuple[float, float, str]:
    """Films [m] to judge by, found without trust in the solver at hand."""
    return _judge(tuple(sorted(case.items())), tolerance)


def checked(case: dict, tolerance: float = TOLERANCE, judge=None):
    """check(result) for `judged`: the own residuals, and both films against ``judge`` (default: `reference`)."""

    def check(film) -> dict[str, float]:
        smallest, flow, _ = judge or reference(case, tolerance)
        ratios = {name: value / OWN[name] for name, value in film_deviations(film, case).items()}
        if tolerance > TOLERANCE:
            ratios["flow"] *= TOLERANCE / tolerance  # judged by the grid that was asked for
        return ratios | {
            "min_film": abs(film.min_film / smallest - 1) / (FILM * tolerance),
            "flow_film": abs(film.flow_film / flow - 1) / (FILM * tolerance),
        }

    return check


def promised(M: float, L: float) -> bool:
    """Whether M and L lie within the range that the default answers for."""
    return 0.99e-3 <= M <= 1001 and L <= 20.01


def load_and_material(quick: bool) -> Iterator[Check]:
    """M by L for each law. Where the law is Roelands' at constant density, all methods and the formula are tried."""
    loads = np.geomspace(1e-3, 1e3, 3) if quick else np.append(np.geomspace(1e-3, 1e3, 9), (3e3, 1e4))
    materials = (0.0, 5.0, 20.0) if quick else (0.0, 1.0, 2.5, 5.0, 10.0, 15.0, 20.0, 25.0)
    for law, density in LAWS:
        for M in loads:
            for L in materials:
                case = case_of(float(M), L, law, density)
                here = Condition("film: load and material", f"{law}, density {density}", M, L, promised(M, L))
                yield judged(here, "solve_ehl", lambda case=case: solve_ehl(**case), checked(case))
                if (law, density) == LAWS[0]:
                    yield from other_methods(here, case, float(M), L)


def other_methods(here: Condition, case: dict, M: float, L: float) -> Iterator[Check]:
    """The paper's discretisation, judged by the tight default, and Moes' formula."""

    smallest, flow = _tight(tuple(sorted(case.items())))

    def check(film):
        return checked(case, judge=(smallest, flow, "tight"))(film)

    def formula(film) -> dict[str, float]:
        unit = case["radius"] * math.sqrt(2 * VISCOSITY * case["entrainment_speed"] / (E_PRIME * RADIUS))
        return {"flow_film": abs(film / (flow / unit) - 1) / FORMULA}

    yield judged(
        here, "differential deflection", lambda: solve_differential_deflection(**case, most_nodes=NODES), check, False
    )
    yield judged(here, "Moes formula", lambda: moes_film(M, L), formula, False)


def speeds(quick: bool) -> Iterator[Check]:
    """The paper's steel cylinder at speeds from 1e-8 m/s, either way, by load."""
    for speed in np.geomspace(1e-8, 10, 3 if quick else 10):
        for load in np.geomspace(1e-2, 1e4, 2 if quick else 7):
            sign = -1.0 if round(math.log10(load)) % 2 else 1.0
            case = PAPER | {"load_per_width": float(load), "entrainment_speed": sign * float(speed)}
            u1 = 2 * 0.36 * speed / (231e9 * 2e-3)
            M, L = load / (231e9 * 2e-3) / math.sqrt(u1), 25e-9 * 231e9 * u1**0.25
            yield judged(
                Condition("film: speed and load", "steel cylinder, R = 2 mm", speed, load, promised(M, L)),
                "solve_ehl",
                lambda case=case: solve_ehl(**case),
                checked(case),
            )


def tolerances(quick: bool) -> Iterator[Check]:
    """Tolerances from one tenth, where grids are far too coarse, to 1e-4. The error has to be what was asked for."""
    points = (
        ((1e-2, 5), (10, 10), (100, 20), (1000, 5))
        if quick
        else (
            (1e-3, 5),
            (1e-2, 5),
            (0.1, 10),
            (1, 0),
            (1, 10),
            (5, 5),
            (10, 10),
            (20, 5),
            (50, 10),
            (100, 5),
            (100, 15),
            (100, 20),
            (1000, 2.5),
            (1000, 10),
            (1000, 20),
        )
    )
    for row, (M, L) in enumerate(points):
        case = case_of(M, L)
        for tolerance in (0.1, 1e-2, 1e-3) if quick else (0.1, 0.05, 0.03, 0.01, 3e-3, 1e-3, 3e-4):
            here = Condition("film: tolerance", "cases by M, L", row, tolerance)
            yield judged(
                here,
                "solve_ehl",
                lambda case=case, t=tolerance: solve_ehl(**case, tolerance=t),
                checked(case, tolerance),
            )


def starts(quick: bool) -> Iterator[Check]:
    """Solves that start from the solution of a contact that may be a million times lighter, or of another lubricant."""
    points = (
        ((1e-2, 5), (10, 5), (1000, 20))
        if quick
        else (
            (1e-3, 0.5),
            (1e-2, 5),
            (0.1, 20),
            (1, 5),
            (5, 15),
            (20, 5),
            (100, 1),
            (100, 20),
            (1000, 5),
            (1000, 20),
        )
    )
    films = [solve_ehl(**case_of(M, L)) for M, L in points]
    for column, film in enumerate(films):
        for row, (M, L) in enumerate(points):
            case = case_of(M, L)
            here = Condition("film: poor start", "cases by M, L", column, row)
            yield judged(here, "solve_ehl", lambda case=case, film=film: solve_ehl(**case, start=film), checked(case))


def starved(quick: bool) -> Iterator[Check]:
    """Lubricant that begins at a distance of the dry contact (in half-widths plus inlet lengths)."""
    for M in (0.1, 10, 1000) if quick else (1e-3, 1e-2, 0.1, 1, 3, 10, 30, 100, 300, 1000):
        for share in (0.5, 5) if quick else (0.3, 0.5, 1, 2, 5, 20):
            case = case_of(M, 10)
            unit = RADIUS * math.sqrt(2 * VISCOSITY * case["entrainment_speed"] / (E_PRIME * RADIUS))
            half_width = math.sqrt(8 * case["load_per_width"] * RADIUS / (math.pi * E_PRIME))
            length = half_width + share * math.sqrt(2 * RADIUS * moes_film(M, 10) * unit)
            case["inlet_length"] = length
            yield judged(
                Condition("film: starved inlet", "L = 10", M, share),
                "solve_ehl",
                lambda case=case: solve_ehl(**case),
                checked(case),
            )
