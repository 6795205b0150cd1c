"""Dry contact compared with Hertz, Westergaard, Johnson, Greenwood and Higginson, and two programs for rough
surfaces."""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np

import lubfric
from lubfric.contact import find_asperities

from ... import plotting
from ...check import Check, Figure, Item
from ...types import Keywords
from .. import references
from ..exact_contact import Line
from ..parts import pressed_cylinder
from . import against

E_PRIME = 231e9  # Pa, E' of the paper's cylinder
RADIUS = 2e-3  # m, of the paper's cylinder
LOAD = 5.5 / 6e-3  # N/m, of the paper's cylinder
AMPLITUDE = 100e-9  # m, of the wave
WAVELENGTH = 45e-6  # m
WAVE = 256  # cells in the wave
SHARES = (0.1, 0.3, 0.5, 0.7, 0.9)
SQ = 100e-9  # m, of the surface whose summits are counted
LENGTH = 20e-6  # m, its correlation length
CELL = 1e-6  # m, its cells
CELLS = 768  # cells in its side
SEEDS = (1, 2, 3, 4)
# cells of a patch of four longest waves: with the cells of Xu et al. in its shortest wave, and with half as many
FINE_PATCH = round(400 * references.SELF_AFFINE_CELLS)
COARSE_PATCH = FINE_PATCH // 2
PRINTED = 0.01  # least relative 95 % bound of their areas: cells and slope are inferred


def dry(level: str) -> Iterator[Item]:
    """`solve_contact` on a cylinder, two kinds of waves and rough surfaces; the summits of generated surfaces.

    The error of lubfric is the change when the cells are halved; for the wave, a cell at each edge of the contact; for
    rough surfaces, twice the standard error over several surfaces. The area on cells is too large by their edges. The
    areas of figure 2 of Xu et al. contain this error: they are compared with the area counted on as many cells in the
    shortest wave. The areas of their other set are compared with the area after Yastrebov's correction; a tenth of the
    correction is part of the error (0.3 % remain on half and a quarter of the cells). The shortest wave of the
    challenge is 1/1000 of its patch; here it is 1/250, and the change from 1/125 is part of the error.
    """
    yield from cylinder()
    areas = [line_wave(share, WAVE) for share in SHARES]
    values = [(area, 2 / WAVE / area) for area in areas]
    for share, (area, error) in zip(SHARES, values):
        name = f"wave, contact at p/p* = {share:g}"
        yield against("westergaard", name, area, references.westergaard_area(share), error)
    for share in (0.002, 0.01, 0.9, 0.97):
        area, error = halved(partial(bisinusoid, share), 512)
        side = share < 0.5
        ours, theirs = (v if side else 1 - v for v in (area, references.bisinusoid_area(share)))
        own_error = error * area / ours
        what = "contact" if side else "no contact"
        yield against("jgh", f"bisinusoid, {what} at p/p* = {share:g}", ours, theirs, own_error)
    yield summits()
    if level != "quick":
        yield from self_affine()
    yield drawn(values)


def halved(solve: Callable[[int], float], cells: int) -> tuple[float, float]:
    """Return the value with ``cells`` cells, and its relative change from half as many."""
    fine = solve(cells)
    coarse = solve(cells // 2)
    return fine, abs(fine / coarse - 1)


def cylinder() -> Iterator[Item]:
    """Half-width and peak pressure of the cylinder."""
    half_width, peak = references.hertz_line(LOAD, RADIUS, E_PRIME)

    line = Line(E_PRIME, RADIUS, half_width)

    def solved(across: int) -> tuple[float, float]:
        x, result = pressed_cylinder(line, across)
        p = result.pressure[:, 0]
        return 2 * math.sqrt(p @ x**2 / p.sum()), float(p.max())

    fine = solved(64)
    coarse = solved(32)
    for name, unit, k, theirs in (("half-width", "m", 0, half_width), ("peak pressure", "Pa", 1, peak)):
        yield against("hertz", f"cylinder, {name}", fine[k], theirs, abs(fine[k] / coarse[k] - 1), unit)


def line_wave(share: float, n: int) -> float:
    """Return contact area of a sinusoidal wave."""
    return wavy(np.cos(2 * np.pi * (np.arange(n) + 0.5) / n)[:, None] * np.ones(4), share * math.pi, n)


def bisinusoid(share: float, n: int) -> float:
    """Return contact area of the product of two waves."""
    wave = np.cos(2 * np.pi * (np.arange(n) + 0.5) / n)
    return wavy(wave[:, None] * wave, share * math.sqrt(2) * math.pi, n)


def wavy(shape: np.ndarray, pressure: float, n: int) -> float:
    """Return contact area under ``pressure`` in units of E* amplitude/wavelength."""
    mean = pressure * E_PRIME / 2 * AMPLITUDE / WAVELENGTH
    solve = lubfric.solve_contact(-AMPLITUDE * shape, WAVELENGTH / n, E_PRIME, mean_pressure=mean, tolerance=1e-8)
    return solve.contact_area_fraction


def summits() -> Check:
    """Return summits of generated Gaussian surfaces."""
    keys: Keywords = {"sq": SQ, "correlation_length": LENGTH, "acf": "gaussian"}
    maps = [lubfric.generate_surface((CELLS, CELLS), CELL, seed=seed, **keys).heights for seed in SEEDS]
    counts = [find_asperities(z, CELL, E_PRIME)(z.min() - SQ).contacts / (CELLS * CELL) ** 2 for z in maps]
    theirs = references.summit_density(LENGTH)
    return against("longuet", "summits of a Gaussian surface", *mean(counts, theirs), "1/m²")


def self_affine() -> Iterator[Item]:
    """Compare gap, area and pressure of self-affine surfaces with other programs."""
    slope, _ = references.self_affine_full_contact(references.SELF_AFFINE_PATCH)
    for theirs in references.SELF_AFFINE:
        load = theirs.load / slope
        cells = FINE_PATCH if theirs.area else COARSE_PATCH
        solutions = [pressed(waves(seed, (4, 4, 400), cells), load) for seed in SEEDS[:3]]
        gaps, areas, edges, squares = np.transpose(solutions)
        at = f"self-affine surface, load {load:.4f} of E* slope"
        if theirs.gap:
            yield against("xu", f"{at}: mean gap over Sq", *mean(gaps, theirs.gap))
        if theirs.area:
            scatter = max(2 * theirs.scatter / theirs.area, PRINTED)
            yield against("xu", f"{at}: area on their cells", *mean(areas, theirs.area), error=scatter)
        if theirs.other_area:
            corrected, other, own_error = mean(areas - edges, theirs.other_area)
            yield against("xu", f"{at}: area", corrected, other, own_error + 0.1 * edges.mean() / corrected)
        if theirs.mean_square:
            square = theirs.mean_square / slope**2
            yield against("xu", f"{at}: mean square pressure", *mean(squares, square), error=0.02)
    load = references.CHALLENGE["load"]
    wide, narrow = (
        np.transpose([pressed(waves(s, (1, 5, last), 4 * last), load) for s in SEEDS]) for last in (250, 125)
    )
    for name, k, cut in (("area", 1, 2), ("mean square pressure", 3, None)):
        values = [f[k] - (f[cut] if cut else 0) for f in (wide, narrow)]
        ours, published, own_error = mean(values[0], references.CHALLENGE[name])
        yield against(
            "challenge", f"contact challenge: {name}", ours, published, own_error + abs(values[1].mean() / ours - 1)
        )


def waves(seed: int, numbers: tuple[int, int, int], cells: int) -> np.ndarray:
    """Return heights of rms slope 1 on a periodic patch 2 pi long, self-affine with H = 0.8 and random phases. Its wave
    ``numbers``: the first, that from which the spectrum falls, and the last."""
    first, bend, last = numbers
    k = np.fft.fftfreq(cells, 1 / cells)
    k = np.hypot(k[:, None], k)
    size = np.where((k >= first) & (k <= last), np.maximum(k, bend) ** -1.8, 0.0)
    noise = np.fft.fft2(np.random.default_rng(seed).standard_normal(k.shape))
    return np.fft.ifft2(size * noise / np.abs(noise)).real / math.sqrt(((size * k) ** 2).sum()) * cells**2


def pressed(heights: np.ndarray, load: float) -> tuple[float, float, float, float]:
    """Return mean gap over Sq, area on the cells, what its edges make it too large, and mean square pressure; E* =
    1."""
    solution = lubfric.solve_contact(-heights, 2 * math.pi / len(heights), 2.0, mean_pressure=load, tolerance=1e-5)
    on = solution.pressure > 0
    edges = sum(float((on != np.roll(on, 1, axis)).mean()) for axis in (0, 1))
    square = float((solution.pressure**2).mean())
    return float(solution.gap.mean() / heights.std()), solution.contact_area_fraction, references.EDGE * edges, square


def mean(values: Sequence[float], theirs: float) -> tuple[float, float, float]:
    """Return mean, their value, and twice the standard error of the mean, relative."""
    average = float(np.mean(values))
    return average, theirs, 2 * float(np.std(values, ddof=1)) / math.sqrt(len(values)) / average


def drawn(rows: list[tuple[float, float]]) -> Figure:
    """Return contact of the wave over the load."""
    dense = np.linspace(0, 1, 200)
    (ours, errors) = np.array(rows).T
    theirs = (dense, [references.westergaard_area(s) for s in dense], "-", "Westergaard 1939")
    curves = [theirs, (SHARES, ours, "o", "lubfric", ours * errors)]
    caption = "Contact of a wave with a flat: lubfric with its error, and the closed form"
    return plotting.chart("wave", caption, curves, xlabel="p/p*", ylabel="share of the length in contact")
