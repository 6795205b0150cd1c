"""The chart of smooth films: error of smallest film, flow film and friction against time."""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np

from lubfric import EHLResult, solve_differential_deflection, solve_ehl
from lubfric.film import moes_film

from ...fem.parts import case_of, moes_unit
from ...fem.solvers import ehl as fem
from ...fem.solvers.report import SolveError
from ...types import FloatArray, Keywords, PlainRow
from ..dense_newton import dense_newton
from .measure import Quartiles, interleaved, point

# method, setting, its quantities, quartiles of the processor seconds, unknowns
FilmRun = tuple[str, str, Sequence[float] | FloatArray, Quartiles, int]
POINTS = ((1, 5), (10, 10), (20, 5), (100, 20), (1000, 20))
DEFAULT = 3e-3  # tolerance of `solve_ehl` that users get
FINER = 50  # M up to which finite elements are refined once: beyond, that takes minutes
SHEARED = (20, 5)  # below 1 GPa, where a Newtonian shear force still means something


def cases(*, quick: bool) -> dict[str, tuple[float, float, bool]]:
    """Return one panel for each (M, L)."""
    return {f"M = {M:g}, L = {L:g}": (M, L, quick) for M, L in (POINTS[1:2] if quick else POINTS)}


def measured(case: tuple[float, float, bool]) -> list[PlainRow]:
    """Return every method at every setting against a tight solution."""
    M, L, quick = case
    arguments = case_of(M, L)
    panel = f"M = {M:g}, L = {L:g}"
    values = []
    exact = quantities(solve_ehl(**arguments, tolerance=2e-5, raise_on_failure=False))
    for name, setting, films, seconds, size in runs(arguments, M, L, quick=quick):
        off = np.abs(np.array(films) / exact[: len(films)] - 1)
        at = {"default": name.startswith("default") and setting == f"tolerance {DEFAULT:g}", "size": size}
        values.append(point(panel, name, setting, float(np.nanmax(off[:2])), seconds, **at))
        if len(films) == 3 and (M, L) == SHEARED:
            values.append(point(f"{panel}: shear force", name, setting, float(off[2]), seconds, **at))
    return values


def quantities(film: EHLResult) -> np.ndarray:
    """Return smallest film and flow film [m], and ∫ eta/h dx, which is the Newtonian shear force per sliding speed."""
    x = film.x
    h = film.film_thickness
    eta = film.viscosity
    wet = x <= film.rupture + 1e-12 * film.half_width
    return np.array([film.min_film, film.flow_film, np.trapezoid((eta / h)[wet], x[wet])])


def runs(case: Keywords, M: float, L: float, *, quick: bool) -> Iterator[FilmRun]:
    """(method, setting, quantities, quartiles of seconds, unknowns) of every method and setting."""
    near = case | {"load_per_width": 0.97 * case["load_per_width"]}
    calls: dict[tuple[str, float], Callable[[], EHLResult]] = {}
    for t in (1e-2, 3e-3) if quick else (0.05, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4):
        calls["default, cold", t] = partial(solve_ehl, **case, tolerance=t)
        calls["default, warm", t] = partial(solve_ehl, **case, tolerance=t, start=solve_ehl(**near, tolerance=t))
    for (name, t), (film, seconds) in interleaved(calls, 2 if quick else 7).items():
        yield name, f"tolerance {t:g}", quantities(film), seconds, film.x.size
    for nodes in (129, 257) if quick else (129, 257, 513, 1025, 2049, 4097):
        call = partial(solve_differential_deflection, **case, nodes=nodes, tolerance=0.1, raise_on_failure=False)
        film, seconds = interleaved({"": call}, 1 if quick else 3)[""]
        if film.report.status == "converged":
            yield "differential deflection", f"{nodes} nodes", quantities(film), seconds, nodes
    for nodes in (129, 257) if quick else (129, 257, 513):
        plain, seconds = interleaved({"": partial(dense_newton, case, nodes)}, 1)[""]
        if plain.converged:
            yield "dense Newton", f"{nodes} nodes", (plain.min_film, plain.flow_film), seconds, nodes
    if M <= 100:  # beyond, its meshes cost minutes
        yield from finite_elements(case, quick=quick)
    value, seconds = interleaved({"": partial(moes_film, M, L)}, 21)[""]
    yield "Moes formula (flow film)", "", (math.nan, value * moes_unit(case["entrainment_speed"])), seconds, 1


def finite_elements(case: Keywords, *, quick: bool) -> Iterator[FilmRun]:
    """The full system by finite elements on its nested meshes. The time of each includes that of the coarser ones."""
    contact = fem.LineContact.of(case)
    for refinements in (0,) if quick or contact.load_number > FINER else (0, 1):
        try:
            solutions, seconds = interleaved({"": partial(fem.solve_ehl, contact, refinements=refinements)}, 1)[""]
        except SolveError:
            continue
        last = solutions[-1]
        yield "finite elements", f"{refinements} refinements", (last.min_film, last.flow_film), seconds, last.P.size
