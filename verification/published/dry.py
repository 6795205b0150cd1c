"""Dry contact beside Hertz, Westergaard, Johnson, Greenwood and Higginson, and two theories of rough surfaces."""

import math
from collections.abc import Iterator

import numpy as np

import lubfric
from lubfric.contact import find_asperities

from .. import plotting, references
from ..check import Check, Figure, Item
from . import against

E_PRIME, RADIUS, LOAD = 231e9, 2e-3, 5.5 / 6e-3  # Pa, m, N/m: the paper's cylinder
AMPLITUDE, WAVELENGTH, WAVE = 100e-9, 45e-6, 256  # m, m, cells
SHARES = (0.1, 0.3, 0.5, 0.7, 0.9)
SQ, LENGTH, CELL, CELLS, SEEDS = 100e-9, 20e-6, 1e-6, 768, (1, 2, 3, 4)


def dry(level: str) -> Iterator[Item]:
    """`solve_contact` on a cylinder, two kinds of waves and rough surfaces; the summits of generated surfaces.

    Our error is the change when the cells are halved; of the wave a cell at either edge of the contact, and of rough
    surfaces twice the standard error over four of them. The area over load of a rough surface is held against the band
    between two theories.
    """
    yield from cylinder()
    areas = [line_wave(share, WAVE) for share in SHARES]
    found = [(area, 2 / WAVE / area) for area in areas]
    for share, (area, error) in zip(SHARES, found):
        name = f"wave, contact at p/p* = {share:g}"
        yield against("westergaard", name, area, references.westergaard_area(share), error)
    for share in (0.002, 0.01, 0.9, 0.97):
        area, error = halved(lambda n, s=share: bisinusoid(s, n), 512)
        side = share < 0.5
        ours, theirs = (v if side else 1 - v for v in (area, references.bisinusoid_area(share)))
        own = error * area / ours
        what = "contact" if side else "no contact"
        yield against("jgh", f"bisinusoid, {what} at p/p* = {share:g}", ours, theirs, own)
    yield from rough()
    yield drawn(found)


def halved(solve, cells: int) -> tuple[float, float]:
    """The value with ``cells`` cells, and its relative change from half as many."""
    fine, coarse = solve(cells), solve(cells // 2)
    return fine, abs(fine / coarse - 1)


def cylinder() -> Iterator[Check]:
    """Half-width and peak pressure of the cylinder."""
    half_width, peak = references.hertz_line(LOAD, RADIUS, E_PRIME)

    def solved(n: int) -> tuple[float, float]:
        dx = 4 * half_width / n
        x = (np.arange(n) - (n - 1) / 2) * dx
        gap = np.tile(x[:, None] ** 2 / (2 * RADIUS), (1, 4))
        options = {"boundary": ("free", "periodic"), "tolerance": 1e-8, "mean_pressure": LOAD / (n * dx)}
        p = lubfric.solve_contact(gap, dx, E_PRIME, **options).pressure[:, 0]
        return 2 * math.sqrt(p @ x**2 / p.sum()), float(p.max())

    fine, coarse = solved(257), solved(129)
    for name, unit, k, theirs in (("half-width", "m", 0, half_width), ("peak pressure", "Pa", 1, peak)):
        yield against("hertz", f"cylinder, {name}", fine[k], theirs, abs(fine[k] / coarse[k] - 1), unit)


def line_wave(share: float, n: int) -> float:
    """Contact area of a sinusoidal wave."""
    return wavy(np.cos(2 * np.pi * (np.arange(n) + 0.5) / n)[:, None] * np.ones(4), share * math.pi, n)


def bisinusoid(share: float, n: int) -> float:
    """Contact area of the product of two waves."""
    wave = np.cos(2 * np.pi * (np.arange(n) + 0.5) / n)
    return wavy(wave[:, None] * wave, share * math.sqrt(2) * math.pi, n)


def wavy(shape: np.ndarray, pressure: float, n: int) -> float:
    """Contact area under ``pressure`` in units of E* amplitude/wavelength."""
    mean = pressure * E_PRIME / 2 * AMPLITUDE / WAVELENGTH
    solve = lubfric.solve_contact(-AMPLITUDE * shape, WAVELENGTH / n, E_PRIME, mean_pressure=mean, tolerance=1e-8)
    return solve.contact_area_fraction


def rough() -> Iterator[Check]:
    """Summits and contact area of generated Gaussian surfaces."""
    keys = {"sq": SQ, "correlation_length": LENGTH, "acf": "gaussian"}
    maps = [lubfric.generate_surface((CELLS, CELLS), CELL, seed=seed, **keys).heights for seed in SEEDS]
    counts = [find_asperities(z, CELL, E_PRIME)(z.min() - SQ).contacts / (CELLS * CELL) ** 2 for z in maps]
    slope = 2 * SQ / LENGTH
    options = {"mean_pressure": 0.01 * E_PRIME / 2 * slope, "tolerance": 1e-5}
    yield against("longuet", "summits of a Gaussian surface", *mean(counts, references.summit_density(LENGTH)), "1/m²")
    areas = [lubfric.solve_contact(-z, CELL, E_PRIME, **options).contact_area_fraction / 0.01 for z in maps]
    low, high = references.AREA_OVER_LOAD
    name, (ours, _, own) = "rough surface, area over load", mean(areas, 1.0)
    yield against("bush", name, ours, (low + high) / 2, own, error=(high - low) / (high + low))


def mean(values: list[float], theirs: float) -> tuple[float, float, float]:
    """Mean, their value, and twice the standard error of the mean, relative."""
    one = float(np.mean(values))
    return one, theirs, 2 * float(np.std(values, ddof=1)) / math.sqrt(len(values)) / one


def drawn(found: list[tuple[float, float]]) -> Figure:
    """Contact of the wave over the load."""
    canvas, ax = plotting.axes(width=5.6, height=3.6)
    dense = np.linspace(0, 1, 200)
    ax.plot(dense, [references.westergaard_area(s) for s in dense], "-", label="Westergaard 1939")
    ax.errorbar(SHARES, [a for a, _ in found], [a * e for a, e in found], fmt="o", label="lubfric")
    ax.set(xlabel="p/p*", ylabel="share of the length in contact")
    ax.legend()
    return plotting.finish("wave", canvas, "Contact of a wave with a flat, ours with its error beside the closed form")
