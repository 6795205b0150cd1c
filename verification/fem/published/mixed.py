"""Mixed lubrication compared with four laws of the asperity load ratio, Masjedi and Khonsari, and the paper's own
numbers."""

from collections.abc import Iterator

import numpy as np

import lubfric
from lubfric.models.deterministic import BOUNDARY_FILM, RoughBody, solve_moving_strip

from ... import plotting
from ...campaigns.model.boundary_film import FILMS, RATIOS, SURFACES, shares
from ...check import Check, Figure, Item, beside
from .. import references
from . import against

FLOOR = 0.02  # of the load: what a plateau read off a figure leaves open
LAWS = ("law-arana", "law-zhou", "law-patir", "law-doleschel")  # keys of references.LOAD_SHARES
# Masjedi and Khonsari give numbers without dimension. These lengths make them a steel roller.
RADIUS = 10e-3  # m
MODULUS = 228e9  # Pa, E' of steel
VISCOSITY = 0.02  # Pa s
MAP = (128, 32)  # cells, four in a correlation length
LENGTHS = (10e-6, 20e-6)  # m: correlation lengths, a 16th and an 8th of a half-width; theirs is not known
SLIP = 0.1  # slide-roll ratio: the rough surface 1 moves at 0.95 U
PRESSURE = 0.5e9  # Pa, of Hertz


def mixed(level: str) -> Iterator[Item]:
    """The share of the load on gaps below the boundary film, and the paper's cylinder.

    Theirs is the band that four published laws span. Ours is the mean of three kinds of roughness on a roller, each a
    patch; the error is twice its standard error.
    """
    values = np.array([shares((kind, PRESSURE)) for kind in SURFACES])[:, :, FILMS.index(BOUNDARY_FILM)]
    ours = values.mean(axis=0)
    own = 2 * values.std(axis=0, ddof=1) / np.sqrt(len(values))
    low, high = references.load_share_band(RATIOS)
    for ratio, one, error, a, b in zip(RATIOS, ours, own, low, high):
        name = f"load share of the asperities, film/Sq = {ratio:g}"
        half = (b - a) / (a + b)
        note = "not independent: the boundary film of 20 nm was chosen as the nearest to these laws"
        if ratio * min(SURFACES.values()) <= BOUNDARY_FILM:
            note = "the film itself is 20 to 40 nm, so nearly all of it is below the boundary film; lubfric's roughness is at rest"
        yield against("shares", name, one, (a + b) / 2, error / one, note=note, error=half, cause="ours")
    at = RATIOS.index(1.0)
    for key, (law_name, law) in zip(LAWS, references.LOAD_SHARES.items(), strict=True):
        name = f"load share of the asperities, film/Sq = 1, {law_name}"
        note = "the laws differ among themselves by a factor of 2.5 there"
        yield against(key, name, ours[at], float(law(1.0)), own[at] / ours[at], note=note, cause="unknown")
    yield from masjedi(level)
    scene = lubfric.load_scene("paper")
    line = scene.line_contact(0.001)
    mean = scene.bodies.load / scene.bodies.width / (2 * line.half_width)
    yield against("paper", "mean Hertz pressure", mean, references.PAPER["mean Hertz pressure"], 0.0, "Pa", error=5e-3)
    yield against("paper", "half-width", line.half_width, references.PAPER["half-width"], 0.0, "m", error=0.012)
    yield drawn(ours, own)


def masjedi(level: str) -> Iterator[Check]:
    """The asperity load ratio of the deterministic model at the three roughnesses of Masjedi and Khonsari.

    The roughness moves at a slide-roll ratio of 0.1. The value of lubfric is the load on gaps thinner than the
    boundary film, the mean of two correlation lengths, because the published length is not known; at full level it is
    the mean of three seeds. The error is half the difference between the lengths, and the relative change at rest with
    half or twice the boundary film."""
    case = references.MASJEDI_CASE
    width = 5e-3
    scene = lubfric.load_scene("paper").with_(
        bodies={
            "radius": RADIUS,
            "width": width,
            "load": case["W"] * MODULUS * RADIUS * width,
            "e_prime": MODULUS,
            "hardness": case["V"] * MODULUS,
        },
        lubricant={
            "viscosity": VISCOSITY,
            "pressure_viscosity_coefficient": case["G"] / MODULUS,
            "density_law": "dowson-higginson",
            "eyring_stress": 5e6,
            "limiting_stress_coefficient": 0.06,
        },
        motion={"slide_roll_ratio": SLIP},
    )
    speed = case["U"] * MODULUS * RADIUS / VISCOSITY
    seeds = (1, 2, 3) if level == "full" else (1,)
    films = (BOUNDARY_FILM / 2, BOUNDARY_FILM, 2 * BOUNDARY_FILM)
    for ratio, theirs in references.MASJEDI.items():
        by_length = []
        thickness = []
        for length in LENGTHS:
            rows = []
            for seed in seeds:
                surface = lubfric.generate_surface(
                    MAP, length / 4, sq=ratio * RADIUS, correlation_length=length, acf="gaussian", seed=seed
                )
                body = RoughBody(surface, (1 - SLIP / 2) * speed)
                strip = solve_moving_strip(scene, (body,), speed)
                rows.append(float(strip.series["share"][strip.discarded :].mean()))
                rest = strip.rest.result
                thickness.append([rest.pressure[rest.gap < film].sum() / rest.pressure.sum() for film in films])
            by_length.append(np.mean(rows))
        usual = float(np.mean(by_length))
        thin, rested, thick = np.mean(thickness, axis=0)
        by_film = min(usual, (thick - thin) / 2 / rested * usual) if rested > 0 else 0.0
        error = float(np.hypot(np.ptp(by_length) / 2, by_film))
        name = f"asperity load ratio, Sq/R = {ratio:g}"
        note = "the published asperities have a statistical density, those of lubfric come from a surface"
        errors = (error, max(0.15 * theirs, FLOOR))
        source = references.SOURCES["masjedi"].text
        yield beside(name, usual, theirs, errors, source, note=note, cause="unknown")


def drawn(ours: np.ndarray, own: np.ndarray) -> Figure:
    """Shares over the ratio, in the band of the laws."""
    dense = np.geomspace(min(RATIOS), max(RATIOS), 100)
    curves: list[tuple] = [(dense, law(dense), "-", name) for name, law in references.LOAD_SHARES.items()]
    curves.append((RATIOS, ours, "ko", "lubfric, three kinds of roughness", own))
    caption = "Asperity load ratio compared with four published laws"
    return plotting.chart("shares", caption, curves, xscale="log", xlabel="film/Sq", ylabel="share of the load")
