"""Heat of a film compared with Nahme, Blok and Jaeger, and two fits for the inlet."""

import math
from collections.abc import Iterator

import numpy as np

from lubfric.film import Surroundings, heated_film, heated_stress, inlet_heat
from lubfric.oil import Lubricant

from ... import plotting
from ...check import Figure, Item
from ...types import Keywords, Law
from .. import references
from . import against

OIL = Lubricant(0.1, viscosity_law="constant", temperature=313.15, temperature_coefficient=0.04, conductivity=0.13)
NUMBERS = (0.1, 1.0, 10.0, 100.0)
HALF = 1e-4  # m, half-width of the band of heat
CARRIED = 2e4  # J/(m² K s^½) (m/s)^½: effusivity times root of the speed, of both bodies together
PEAK = 1e7  # W/m², of the heat


def heat(level: str) -> Iterator[Item]:
    """Shear of a film that heats itself, the flash temperature under a band of heat, and the factor of the inlet."""
    values = [nahme(number) for number in NUMBERS]
    for number, ours in zip(NUMBERS, values):
        yield against("nahme", f"shear stress at a Nahme number of {number:g}", ours, references.nahme(number), 1e-9)
    for key, name, shape, theirs in (
        ("blok-flash", "Hertz", lambda t: np.sqrt(np.maximum(1 - t**2, 0)), references.FLASH_HERTZ),
        ("jaeger", "uniform", lambda t: (np.abs(t) <= 1).astype(float), references.FLASH_UNIFORM),
    ):
        fine = flash(shape, 2.2 / 250)
        coarse = flash(shape, 2.2 / 125)
        yield against(key, f"flash temperature, {name} band", fine, theirs, abs(fine / coarse - 1))
    for number, ratio, pressed in ((0.1, 0.1, 0.003), (1.0, 0.5, 0.003), (1.0, 2.0, 0.0)):
        made = inlet_heat(
            viscosity=number,
            temperature_coefficient=1.0,
            conductivity=1.0,
            speed=1.0,
            slide_roll_ratio=ratio,
            pressure_ratio=pressed,
        )
        at = f"L = {number:g}, slide-roll {ratio:g}"
        yield against("gupta", f"inlet factor, {at}", made.factor, references.gupta(number, ratio, pressed), 1e-9)
        yield against("wilson", f"other inlet factor, {at}", made.other, references.olver_spikes(number, ratio), 1e-9)
    yield drawn(values)


def nahme(number: float) -> float:
    """Return stress over the isothermal one in a film of 1 µm."""
    sliding = math.sqrt(number * 0.13 / (0.04 * 0.1))
    stress, _ = heated_stress(OIL, np.zeros(1), np.full(1, 1e-6), sliding, np.full(1, 313.15))
    return float(stress[0]) * 1e-6 / (0.1 * sliding)


def flash(shape: Law, step: float) -> float:
    """Return largest rise of a fast band of heat over q_mean sqrt(2 b)/(e1 sqrt(u1) + e2 sqrt(u2)), by steps of
    half-widths. lubfric uses at most 257 nodes."""
    t = np.arange(-1.0, 1.2, step)
    heat = PEAK * shape(t)
    still = Surroundings(CARRIED, 0.0, np.zeros(t.size), heat)
    solution = heated_film(OIL, HALF * t, np.zeros(t.size), np.full(t.size, 1e-6), still)
    mean = PEAK * (math.pi / 4 if shape(np.array([0.9]))[0] < 1 else 1.0)
    return solution.flash * CARRIED / (mean * math.sqrt(2 * HALF))


def drawn(rows: list[float]) -> Figure:
    """Return stress over the Nahme number."""
    dense = np.geomspace(0.03, 300, 100)
    curves = [(dense, [references.nahme(n) for n in dense], "-", "Nahme 1940"), (NUMBERS, rows, "o", "lubfric")]
    scales: Keywords = {
        "xscale": "log",
        "yscale": "log",
        "xlabel": "Nahme number",
        "ylabel": "stress over the isothermal one",
    }
    return plotting.chart("nahme", "Shear of a film that heats itself", curves, **scales)
