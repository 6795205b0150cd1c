"""Smooth films compared with the closed forms and fits of Martin, Blok, Moes, Grubin, Dowson, Higginson and Toyoda."""

import math
from collections.abc import Iterator

import numpy as np

import lubfric
from lubfric.film import moes_film

from ... import plotting
from ...check import Check, Figure, Item, listed_near
from ...types import Option
from .. import references
from ..exact import Parabola
from ..parts import ALPHA, E_PRIME, RADIUS, VISCOSITY, case_of, moes_unit
from ..waves import smooth_film
from . import against

MOES = ((5, 5), (20, 5), (100, 5), (10, 10), (50, 10), (200, 16))  # M, L
GRUBIN = ((100, 10), (200, 10), (200, 16))  # films of at most 0.02 b²/R, as its inlet asks
DOWSON = ((10, 5), (100, 5), (50, 10), (200, 16))
TOLERANCE = 1e-3  # of the films
STATIC = 4e9  # Pa
DRY_INLET = "its inlet has the gap of a dry contact; the pressure there opens it (inlet of M -> infinity: within 2 %)"
BEYOND = "a fit used at 4.1 GPa, above the 4 GPa at which ISO 76 ends the static rating of roller bearings"
# the flow film of lubfric in Moes' units, and the smallest film [m], where they differ from the publication; by M and L
GRUBIN_DIFFERS = {(100, 10): listed_near(4.372, "theirs", DRY_INLET)}
DOWSON_DIFFERS = {("smallest film", 200, 16): listed_near(4.297e-7, "theirs", BEYOND)}


def films(level: str) -> Iterator[Item]:
    """Compare `solve_ehl`, and the film of the deterministic model, with published films.

    The error of lubfric is the sum of the errors that the solver states for its grid and its inlet. Fits are valid to
    some 5 %; asymptotes are valid only far in their regime and differ where M and L are finite. Grubin's oil follows
    Barus' law. Whether the oils of Dowson and others follow Barus' or Roelands' law is not known here: the value of
    lubfric is the mean of both, and half their difference is part of the error.
    """
    yield from rigid()
    yield from limits()
    for m, l in MOES:
        solution = film(m, l)
        ours = solution.flow_film / unit(solution)
        name = f"flow film, M = {m}, L = {l}"
        yield against("moes", name, ours, references.moes(m, l), own(solution))
    for m, l in GRUBIN:
        solution = film(m, l, law="barus")
        theirs = references.grubin(*numbers(solution)) * RADIUS / unit(solution)
        name = f"flow film, M = {m}, L = {l}, Grubin"
        ours = solution.flow_film / unit(solution)
        yield against("grubin", name, ours, theirs, own(solution), note=DRY_INLET, listed=GRUBIN_DIFFERS.get((m, l)))
    for m, l in DOWSON:
        for key, name, density, law in (
            ("dowson66", "smallest film", "dowson-higginson", references.dowson_higginson),
            ("dowson78", "central film", "constant", references.dowson_toyoda),
        ):
            two = [film(m, l, density, viscosity) for viscosity in ("roelands", "barus")]
            films = [f.min_film if key == "dowson66" else f.central_film for f in two]
            ours = sum(films) / 2
            theirs = law(*numbers(two[0])) * RADIUS
            error = abs(films[1] - films[0]) / 2 / ours + max(map(own, two))
            note = BEYOND if two[0].hertz_pressure > STATIC else ""
            listed = DOWSON_DIFFERS.get((name, m, l))
            yield against(key, f"{name}, M = {m}, L = {l}", ours, theirs, error, "m", note, listed=listed)
    yield one_gap()
    yield drawn()


def film(m: float, l: float, density: str = "constant", law: str = "roelands", **options: Option) -> lubfric.EHLResult:
    """Return a film with Moes' numbers."""
    case = case_of(m, l, law, density)
    return lubfric.solve_ehl(**{**case, "tolerance": TOLERANCE, **options})


def own(solution: lubfric.EHLResult) -> float:
    """Return what the solver leaves open."""
    return solution.report.residuals["discretisation"] + solution.report.residuals["domain"]


def unit(solution: lubfric.EHLResult) -> float:
    """Return the film that is 1 in Moes' units, m."""
    return moes_unit(solution.entrainment_speed)


def numbers(solution: lubfric.EHLResult) -> tuple[float, float, float]:
    """Return eta U/(E' R), alpha E' and w/(E' R)."""
    scale = E_PRIME * RADIUS
    return VISCOSITY * solution.entrainment_speed / scale, ALPHA * E_PRIME, solution.line.load_per_width / scale


def rigid() -> Iterator[Item]:
    """A load so light that nothing deflects: M = 0.001."""
    solution = film(1e-3, 5.0, law="constant", tolerance=1e-4)
    scale = 1e-3 / unit(solution)
    h0 = solution.min_film
    r = references.RIGID
    yield against("martin", "rigid cylinder, smallest film", solution.min_film * scale, r["smallest"], own(solution))
    yield against("martin", "rigid cylinder, flow film", solution.flow_film * scale, r["flow"], own(solution))
    where = solution.rupture / math.sqrt(2 * RADIUS * h0)
    yield against("swift", "rigid cylinder, rupture of the film", where, r["rupture"], own(solution))

    closed = Parabola(viscosity=VISCOSITY, speed=solution.entrainment_speed, radius=RADIUS, film_thickness=h0)
    yield against("swift", "rupture, closed form of the verification", closed.exit, r["rupture"], 1e-9)
    rolled = closed.rolling / (2 * VISCOSITY * solution.entrainment_speed * math.sqrt(RADIUS / h0))
    yield against("martin", "rolling force, closed form of the verification", rolled, r["rolling"], 1e-9)
    name = "the fit as lubfric has it, M = 20, L = 5"
    yield against("moes", name, moes_film(20, 5), references.moes(20, 5), 0, error=1e-6)


def limits() -> Iterator[Item]:
    """Near two of the four corners of Moes."""
    for m in (10, 50, 200):
        solution = film(m, 5.0, law="constant")
        theirs = references.ISOVISCOUS_ELASTIC * m**-0.2
        name = f"flow film, M = {m}, constant viscosity"
        yield against("moes", name, solution.flow_film / unit(solution), theirs, own(solution))
    solution = film(0.5, 60.0, law="barus")
    for name, ours in (("smallest", solution.min_film), ("flow", solution.flow_film)):
        theirs = references.BLOK[name] * 60 ** (2 / 3)
        yield against("blok", f"{name} film, M = 0.5, L = 60, Barus", ours / unit(solution), theirs, own(solution))


def one_gap() -> Check:
    """Return the deterministic model on a surface without roughness."""
    flow = smooth_film(film(20, 5).line, 0.0).flow_film
    theirs = references.moes(20, 5) * unit(film(20, 5))
    return against("moes", "one gap, one pressure: flow film, M = 20, L = 5", flow, theirs, 1e-3, "m")


def drawn() -> Figure:
    """Return flow films over M."""
    canvas, ax = plotting.panel(6.0, 4.0)
    dense = np.geomspace(2, 250, 60)
    for l, mark in ((5, "o"), (10, "s"), (16, "D")):
        (line,) = ax.loglog(dense, [references.moes(m, l) for m in dense], label=f"Moes, L = {l}")
        mine = [(m, film(m, l)) for m in (5, 20, 50, 200)]
        ax.loglog([m for m, _ in mine], [f.flow_film / unit(f) for _, f in mine], mark, color=line.get_color())
    ax.set(xlabel="M", ylabel="H, in Moes' units")
    ax.legend()
    return plotting.finish("films", canvas, "Flow film: points by lubfric, lines by the fit of Moes")
