"""Waves of a surface in the film compared with Venner et al., Greenwood and Morales-Espejel, and Hooke."""

import math
from collections.abc import Iterator

import numpy as np

import lubfric

from ... import plotting
from ...check import Check, Figure, Item
from ...plotting import Curve
from ...types import Keywords
from .. import references
from ..parts import case_of, line_contact
from ..waves import at_rest, history, laid_out, response
from . import against

DENSE = "dowson-higginson"
ROLLING: dict[str, dict[float, tuple[float, tuple[int, ...]]]] = {  # wavelength/b: cells in a half-width, amplitudes
    "default": {2: (40, (0,)), 1: (48, (0,)), 0.5: (64, (0, 2))},
    "full": {n: (max(48, 32 / n), (0, 1, 2)) for n in references.AMPLITUDES},
}
HEIGHTS = (0.1, 0.2, 0.5)  # of the film
FITS = ((20, 10, 2.0), (50, 10, 1.0))  # M, L, wavelength/b
SLIDING = {  # speed, wavelength/b
    "default": ((0.75, 0.5), (0.5, 0.5), (1.5, 0.12)),
    "full": ((1.25, 0.24), (1.5, 0.5), (0.75, 0.5), (0.5, 0.5), (1.5, 0.12)),
}
SHORT = 0.2  # half-widths: shorter waves get half as many cells, 20 in a wave
GREENWOOD = {"P": 20.0, "S": 5.0, "pressure": 1e9, "e_prime": 228e9, "eyring": 4e6}  # Hooke's contact
NOTES = {
    (0.125, 0): "the linear response of finite elements is 0.88: the published wave lost height on its cells",
    (0.125, 1): "as of waves half as high",
    (
        1,
        2,
    ): "waves a fifth as high have the same relative height, as in finite elements; the published ones have 7 % more",
}


def waves(level: str) -> Iterator[Item]:
    """The film over waves that move with both bodies, rest, or move with one of them.

    In pure rolling the amplitude of the film at x = 0 is taken over one period. It is extrapolated from cells twice as
    long, which make the steps in time twice as long too; our error is that step. (So extrapolated, low waves of 0.25 to
    2 b are within 1.5 % of finite elements.)

    At rest the residual wave is fitted over five wavelengths of a contact 20 wavelengths wide, for waves of a tenth of
    the height (the theory is linear); our error is the change to half the width. With Eyring's law both parts are
    fitted, as Hooke did.
    """
    table = {}
    for length, (cells, which) in ROLLING[level].items():
        for column in which:
            ours, error = reduced(100, 11, length, HEIGHTS[column], cells)
            theirs = references.AMPLITUDES[length][column]
            table[length, column] = ours, error * ours
            name = f"waves of {length:g} b and {HEIGHTS[column]:g} of the film, rolling: amplitude kept"
            yield against("venner", name, ours, theirs, error, note=NOTES.get((length, column), ""))
    for m, l, length in FITS:
        ours, error = reduced(m, l, length, 0.1, 40 / min(length, 1.0))
        name = f"waves of {length:g} b, M = {m}, L = {l}, rolling: amplitude kept"
        yield against("venner-fit", name, ours, references.amplitude_fit(m, l, length), error)
    for name in references.STEADY:
        yield from steady(name)
    for speed, length in SLIDING[level]:
        yield sliding(speed, length)
    yield drawn(table)


def reduced(m: float, l: float, length: float, height: float, cells: float) -> tuple[float, float]:
    """Return half the range of the gap at x = 0 over a period, over the height of the waves, and its relative error."""
    values = []
    for n in (cells, cells / 2):
        at = laid_out(line_contact(case_of(m, l, density=DENSE)), 1.0, n)
        tall = height * at.film.gap[at.middle, 0]
        _, gaps, _ = history(at, 2 * math.pi / (length * at.half_width), tall)
        values.append(np.ptp(gaps[:, at.middle]) / 2 / tall)
    fine, coarse = map(float, values)
    kept = fine + (fine - coarse) / 3
    return kept, abs(kept / fine - 1)


def steady(name: str) -> Iterator[Item]:
    """Residual wave and pressure of waves at rest, for the height that they have there."""
    alpha, film, pressure, wave = references.STEADY[name]
    wide = ripples(alpha, film, 20)
    narrow = ripples(alpha, film, 10)
    for what, k, theirs, unit in (("film", 0, wave, "m"), ("pressure", 1, pressure, "Pa")):
        error = abs(wide[k] / narrow[k] - 1)
        yield against("greenwood", f"waves at rest, {name}: {what}", wide[k], theirs, error, unit)


def ripples(alpha: float, film: float, lengths: float) -> tuple[float, float]:
    """Return amplitudes of film [m] and pressure [Pa], in a contact whose width is so many wavelengths."""
    w = references.STEADY_WAVE
    b = lengths / 2 * w["wavelength"]
    k = 2 * math.pi / w["wavelength"]
    height = 0.1 * w["height"]
    peak = w["pressure"] / (1 - (5 / lengths) ** 2 / 6)  # so that the mean over five wavelengths is theirs
    case: Keywords = {
        "load_per_width": math.pi * b * peak / 2,
        "radius": w["e_prime"] * b / (4 * peak),
        "e_prime": w["e_prime"],
        "viscosity": 0.05,
        "pressure_viscosity_coefficient": alpha,
        "viscosity_law": "barus",
        "density_law": DENSE,
        "entrainment_speed": 1.0,
    }
    for _ in range(4):
        case["entrainment_speed"] *= (film / lubfric.solve_ehl(**case, tolerance=1e-3).central_film) ** (1 / 0.7)
    at = laid_out(line_contact(case), 0.0, 40 * lengths / 2)
    solution = at_rest(at, k, height)
    near = np.abs(at.film.x) < 2.5 * w["wavelength"]
    x = at.film.x[near]
    columns = np.stack([x**0, x / b, (x / b) ** 2, np.cos(k * x), np.sin(k * x)], axis=1)
    responses = np.stack(
        [(solution.gap - at.film.gap)[near, 0], (solution.pressure - at.film.pressure)[near, 0]], axis=1
    )
    film_wave, pressure_wave = np.hypot(*np.linalg.lstsq(columns, responses, rcond=None)[0][3:])
    return film_wave / height * w["height"], pressure_wave / height * w["height"]


def sliding(speed: float, length: float) -> Check:
    """Return what the film keeps of waves on one of two bodies that slide."""
    g = GREENWOOD
    alpha = g["P"] / g["pressure"]
    u1 = (g["S"] * 8**0.25 / (alpha * g["e_prime"])) ** 4  # L = 8^(1/4) S
    m = 2 * math.pi * (g["P"] / (g["S"] * 8**0.25)) ** 2
    case = case_of(1.0, 1.0, density=DENSE) | {"e_prime": g["e_prime"], "pressure_viscosity_coefficient": alpha}
    scale = g["e_prime"] * case["radius"]
    case |= {"load_per_width": m * math.sqrt(u1) * scale, "entrainment_speed": u1 * scale / (2 * case["viscosity"])}
    values = []
    fine = 40 if length > SHORT else 20
    for cells in (fine * max(1.0, speed) / length, fine / 2 * max(1.0, speed) / length):
        at = laid_out(line_contact(case | {"eyring_stress": g["eyring"]}), speed, cells)
        gap = at.film.gap[at.middle, 0]
        p = at.film.pressure[at.middle, 0]
        k = 2 * math.pi / (length * at.half_width)
        near = np.abs(at.film.x) < 0.6 * at.half_width
        slid = 2 * abs(speed - 1) * case["entrainment_speed"]
        eta = references.roelands(case["viscosity"], alpha, p)
        drag = eta / math.hypot(1, eta * slid / (gap * g["eyring"])) * case["entrainment_speed"]
        law = references.density
        step = 1e5
        stiffness = law(p) / ((law(p + step) - law(p - step)) / (2 * step))
        kept, inlet = references.hooke(k, speed, gap, drag, stiffness, g["e_prime"])
        wave = -response(at, k, 0.002 * gap)[0][near]
        columns = np.exp(1j * np.outer(at.film.x[near], [k, inlet]))
        values.append((np.linalg.lstsq(columns, wave, rcond=None)[0][0], kept))
    (finest, theirs), (coarse, _) = values
    name = f"waves of {length:g} b at {speed:g} U, Eyring: amplitude kept"
    step = (finest - coarse) / 3
    error = references.WITHIN / abs(theirs)
    return against("hooke", name, abs(finest + step), abs(theirs), abs(step / finest), error=error)


def drawn(table: dict[tuple[float, int], tuple[float, float]]) -> Figure:
    """Return amplitude kept in pure rolling over the wavelength."""
    dense = np.geomspace(0.1, 5, 100)
    curves: list[Curve] = [(dense, [references.amplitude_fit(100, 11, n) for n in dense], "k-", "their fit")]
    for column, height in enumerate(HEIGHTS):
        points = {n: v for (n, c), v in table.items() if c == column}
        if points:
            ours, errors = np.array(list(points.values())).T
            curves.append((list(points), ours, "osD"[column], f"lubfric, height {height:g} of the film", errors))
    theirs = [row[0] for row in references.AMPLITUDES.values()]
    curves.append((list(references.AMPLITUDES), theirs, "kx", "Venner et al. 1997, height 0.1"))
    caption = "Waves in pure rolling, M = 100, L = 11: what the film keeps of them"
    labels: Keywords = {
        "xscale": "log",
        "yscale": "log",
        "xlabel": "wavelength/b",
        "ylabel": "amplitude in the film over that of the surface",
    }
    return plotting.chart("waves", caption, curves, **labels)
