"""Mixed lubrication compared with laws of the asperity load ratio, Masjedi and Khonsari, the friction of gears, the
weight of boundary friction in a bearing, and the paper's own numbers."""

import math
from collections.abc import Iterator

import numpy as np

import lubfric
from lubfric.models.deterministic import BOUNDARY_FILM, RoughBody, solve_moving_strip, solve_strip
from lubfric.oil import named_oil

from ... import plotting
from ...campaigns.model.boundary_film import FILMS, RATIOS, SURFACES, shares
from ...check import Figure, Item, ListedDeviation, Table, beside, listed_near
from ...plotting import Curve
from .. import references
from . import against
from .friction import FVA_3, STEEL

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
# Gears: a torque on the pinion [N m] (load stage 7) at three speeds [rpm], FVA 3 at a temperature [°C] of the oil.
GEAR_TORQUE = 183.4
GEAR_SPEEDS = (300, 900, 1800)
GEAR_TEMPERATURE = 80.0  # °C, of the oil
GEAR_FRICTIONS = (0.065, 0.105)  # f_b: the range that is quoted for gears and rollers without additives
GEAR_LENGTHS = (20e-6, 40e-6)  # m: correlation lengths of ground flanks; those of C14 are not published
GEAR_PLACES = 5  # along the path of contact
BEARING_SPEEDS = (30, 60, 120)  # rpm
# the asperity load ratio of lubfric where it differs from SKF's weight, by rpm
SKF_WEIGHS = (
    "SKF weighs the friction of all sliding contacts of a bearing, flange and cage among them; their accuracy is not "
    "stated"
)
BEARING_DIFFERS = {
    30: ListedDeviation(cause="both", reason=SKF_WEIGHS, low=0.35, high=0.41),
    60: ListedDeviation(cause="both", reason=SKF_WEIGHS, low=0.02, high=0.055),
    120: ListedDeviation(cause="both", reason=SKF_WEIGHS, low=0.0, high=0.01),
}
MOTION = 0.4  # of the share at rest: what moving roughness changes of it (Masjedi and Khonsari's middle roughness)


def mixed(level: str) -> Iterator[Item]:
    """The share of the load on gaps below the boundary film, and the paper's cylinder.

    Theirs is the band that four published laws span. Ours is the mean of three kinds of roughness on a roller, each a
    patch; the error is twice its standard error.
    """
    values = np.array([shares((kind, PRESSURE)) for kind in SURFACES])[:, :, FILMS.index(BOUNDARY_FILM)]
    ours = values.mean(axis=0)
    own_errors = 2 * values.std(axis=0, ddof=1) / np.sqrt(len(values))
    low, high = references.load_share_band(RATIOS)
    for ratio, value, error, a, b in zip(RATIOS, ours, own_errors, low, high):
        name = f"asperity load ratio, Λ = {ratio:g}"
        half = (b - a) / (a + b)
        note = "not independent: the boundary film of 20 nm was chosen as the nearest to these laws"
        if ratio * min(SURFACES.values()) <= BOUNDARY_FILM:
            note = (
                "the film itself is 20 to 40 nm, so nearly all of it is below the boundary film; lubfric's roughness "
                "is at rest"
            )
        listed = listed_near(0.938, "ours", note, within=0.03) if ratio == 0.2 else None
        yield against("shares", name, value, (a + b) / 2, error / value, note=note, error=half, listed=listed)
    at = RATIOS.index(1.0)
    for key, (law_name, law) in zip(LAWS, references.LOAD_SHARES.items(), strict=True):
        name = f"asperity load ratio, Λ = 1, {law_name.partition(' (')[2].rstrip(')')}"
        note = "the laws differ among themselves by a factor of 2.5 there"
        yield against(key, name, ours[at], float(law(np.ones(1))[0]), own_errors[at] / ours[at], note=note)
    yield from masjedi(level)
    yield from bearing()
    yield from gears()
    scene = lubfric.load_scene("paper")
    line = scene.line_contact(0.001)
    mean = scene.bodies.load / scene.bodies.width / (2 * line.half_width)
    yield against("paper", "mean Hertz pressure", mean, references.PAPER["mean Hertz pressure"], 0.0, "Pa", error=5e-3)
    yield against("paper", "half-width", line.half_width, references.PAPER["half-width"], 0.0, "m", error=0.012)
    yield drawn(ours, own_errors)


def masjedi(level: str) -> Iterator[Item]:
    """The asperity load ratio of the deterministic model at the three roughnesses of Masjedi and Khonsari.

    The roughness moves at a slide-roll ratio of 0.1. The value of lubfric is the load on gaps thinner than the
    boundary film, the mean of two correlation lengths, because the published length is not known; at full level it is
    the mean of three seeds. The error is half the difference between the lengths, and the relative change at rest with
    half or twice the boundary film. The table has each correlation length (first seed), also with the roughness at rest
    and by the paper's model."""
    case = references.MASJEDI_CASE
    table = []
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
                steady = strip.rest.result
                thickness.append([steady.pressure[steady.gap < film].sum() / steady.pressure.sum() for film in films])
                if seed == seeds[0] and theirs:  # of the first roughness all are zero
                    by_paper = lubfric.friction(
                        lubfric.prepare(scene.with_(numerics={"model": "paper", "accept": True}), surface), speed
                    )
                    ours = (rows[-1], thickness[-1][1], by_paper.contact_load / scene.bodies.load)
                    cells = (f"{ratio:g}", f"{1e6 * length:g}", f"{theirs:.2f}")
                    table.append((*cells, *(f"{share:.2f}" for share in ours)))
            by_length.append(np.mean(rows))
        usual = float(np.mean(by_length))
        thin, rested, thick = np.mean(thickness, axis=0)
        by_film = min(usual, (thick - thin) / 2 / rested * usual) if rested > 0 else 0.0
        error = float(np.hypot(np.ptp(by_length) / 2, by_film))
        name = f"asperity load ratio, Sq/R = {ratio:g}"
        note = "the published asperities have a statistical density, those of lubfric come from a surface"
        errors = (error, max(0.15 * theirs, FLOOR))
        source = references.SOURCES["masjedi"].text
        yield beside(name, usual, theirs, errors, source, note=note)
    columns = ("Sq/R", "correlation length (µm)", "published", "moving", "at rest", 'model "paper"')
    yield Table("masjedi", "Asperity load ratio of Masjedi and Khonsari's contact", columns, table)


def bearing() -> Iterator[Item]:
    """The asperity load ratio on the inner race of bearing 32216 at low speeds, compared with SKF's weight of boundary
    friction.

    Geometry, oil, load and Sq are published; the correlation length is not, and the roughness is at rest here. The
    error is half the difference of two lengths, what a boundary film of half or of twice its thickness changes, and
    `MOTION`."""
    data = references.BEARING
    inner = data["pitch"] - data["diameter"] * math.cos(data["angle"])
    radius = 1 / (2 / data["diameter"] + 2 * math.cos(data["angle"]) / inner)
    scene = lubfric.load_scene("paper").with_(
        bodies={
            "radius": radius,
            "width": data["length"],
            "load": data["axial load"] / (data["rollers"] * math.sin(data["angle"])),
            "e_prime": STEEL,
            "hardness": None,
        },
        lubricant={**FVA_3, "eyring_stress": 5e6, "limiting_stress_coefficient": 0.047},
        motion={"slide_roll_ratio": 0.0},
    )
    films = (BOUNDARY_FILM, BOUNDARY_FILM / 2, 2 * BOUNDARY_FILM)
    for rpm in BEARING_SPEEDS:
        outer = data["pitch"] + data["diameter"] * math.cos(data["angle"])
        speed = 2 * math.pi / 60 * rpm * inner * outer / (inner + outer) / 2
        rows = []
        for length in LENGTHS:
            surface = lubfric.generate_surface(
                MAP, length / 4, sq=references.BEARING_SQ, correlation_length=length, acf="gaussian", seed=1
            )
            result = solve_strip(scene, surface, speed).result
            rows.append([result.pressure[result.gap < film].sum() / result.pressure.sum() for film in films])
        usual, thin, thick = np.mean(rows, axis=0)
        error = float(np.hypot(np.hypot(np.ptp([row[0] for row in rows]) / 2, (thick - thin) / 2), MOTION * usual))
        theirs = references.skf_boundary_weight(rpm, references.BEARING_NU, data["pitch"])
        name = f"asperity load ratio, bearing 32216 at {rpm} rpm"
        errors = (error, references.SOURCES["skf"].error * theirs)
        listed = BEARING_DIFFERS[rpm]
        yield beside(name, float(usual), theirs, errors, references.SOURCES["skf"].text, note=SKF_WEIGHS, listed=listed)


def gears() -> Iterator[Item]:
    """The mean friction of the gear FZG C14 along its path of contact, by the quick model, compared with two fits.

    It is weighted with the load and the sliding speed, as the fits define it; where two pairs of teeth are in contact
    each has half the load. The error is the model-form error that the model states, and half the differences that the
    range of f_b and two correlation lengths make. The film is isothermal."""
    fva_3 = named_oil("FVA 3")
    kelvin = GEAR_TEMPERATURE + 273.15
    viscosity = float(fva_3.viscosity(kelvin))
    alpha = fva_3.pressure_viscosity_coefficient(kelvin).value
    for rpm in GEAR_SPEEDS:
        middle = sum(GEAR_FRICTIONS) / 2
        short, long = (mean_friction(rpm, (viscosity, alpha), middle, length) for length in GEAR_LENGTHS)
        low, high = (mean_friction(rpm, (viscosity, alpha), f_b, GEAR_LENGTHS[0])[0] for f_b in GEAR_FRICTIONS)
        ours = (short[0] + long[0]) / 2
        parts = (abs(long[0] - short[0]) / 2, (high - low) / 2, max(short[1], long[1]) * ours)
        error = math.hypot(*parts)
        fits = {
            "schlenk": references.schlenk(GEAR_TORQUE, rpm, viscosity),
            "fernandes": references.fernandes(GEAR_TORQUE, rpm, viscosity, alpha),
        }
        for key, theirs in fits.items():
            name = f"friction of gear C14, {rpm} rpm, {key.capitalize()}"
            note = "f_b from 0.065 to 0.105; the film is isothermal"
            yield against(key, name, ours, theirs, error / ours, note=note)


def mean_friction(rpm: float, oil: tuple[float, float], f_b: float, length: float) -> tuple[float, float]:
    """Return mean friction of the gear `references.C14`, and the mean of the relative model-form errors along the path.
    ``oil``: viscosity [Pa s] and pressure-viscosity coefficient [1/Pa]."""
    gear = references.C14
    turn = rpm * 2 * math.pi / 60
    force = GEAR_TORQUE / gear.base[0]
    sine = math.sin(gear.angle)
    reach = [math.sqrt(t**2 - b**2) - p * sine for t, b, p in zip(gear.tips, gear.base, gear.pitch)]
    base_pitch = 2 * math.pi * gear.base[0] / gear.teeth[0]
    places = np.linspace(-reach[1], reach[0], 2 * GEAR_PLACES + 1)[1::2]
    weights = []
    frictions = []
    errors = []
    for place in places:
        radii = gear.pitch[0] * sine + place, gear.pitch[1] * sine - place
        speeds = turn * radii[0], turn * gear.teeth[0] / gear.teeth[1] * radii[1]
        single = reach[0] - base_pitch < place < base_pitch - reach[1]
        load = force if single else force / 2
        scene = lubfric.load_scene("paper").with_(
            bodies={
                "radii": list(radii),
                "width": gear.width,
                "load": load,
                "material": "steel",
                "hardness": None,
                "boundary_friction_coefficient": f_b,
            },
            lubricant={
                "viscosity": oil[0],
                "pressure_viscosity_coefficient": oil[1],
                "density_law": "dowson-higginson",
                "eyring_stress": 5e6,
                "limiting_stress_coefficient": 0.047,
            },
            surface={"sq": gear.sq, "correlation_length": length, "acf": "gaussian"},
            contact={"shape": (96, 32), "spacing": length / 4},
            motion={"slide_roll_ratio": 2 * (speeds[1] - speeds[0]) / sum(speeds)},
            numerics={"model": "quick", "sampling": "patch", "tolerance": 0.03},
        )
        result = lubfric.friction(scene, sum(speeds) / 2)
        weights.append(load * abs(speeds[0] - speeds[1]))
        frictions.append(abs(result.coefficient))
        errors.append(float(result.uncertainty.model))
    return float(np.average(frictions, weights=weights)), float(np.average(errors, weights=weights))


def drawn(ours: np.ndarray, own_errors: np.ndarray) -> Figure:
    """Return shares over the ratio, in the band of the laws."""
    dense = np.geomspace(min(RATIOS), max(RATIOS), 100)
    curves: list[Curve] = [(dense, law(dense), "-", name) for name, law in references.LOAD_SHARES.items()]
    curves.append((RATIOS, ours, "ko", "lubfric, three kinds of roughness", own_errors))
    caption = "Asperity load ratio compared with four published laws"
    return plotting.chart("shares", caption, curves, xscale="log", xlabel="film/Sq", ylabel="share of the load")
