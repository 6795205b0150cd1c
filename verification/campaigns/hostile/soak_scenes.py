"""Random scenes over what machines have, for the soak: every key that a scene file is likely to carry."""

import math
from collections.abc import Mapping

import numpy as np

import lubfric

from ...types import Keywords, PlainRow

RANGES = {  # of the logarithms: N/m, m/s, m, Pa s, 1/Pa, m, slide-roll ratio
    "load_per_width": (1e2, 5e5),
    "speed": (1e-5, 10.0),
    "radius": (1e-3, 5e-2),
    "viscosity": (5e-3, 1.0),
    "alpha": (5e-9, 2.5e-8),
    "sq": (1e-8, 1e-6),
    "ratio": (0.02, 2.0),
}
WIDTH = 1e-2  # m, of a contact
E_PRIME = 231e9  # Pa, E' of two steel bodies
OTHERS = {"width": (1e-3, 5e-2), "e_prime": (1e9, 6e11)}  # of the logarithms: m, Pa
OTHER_TOLERANCES = (0.002, 0.01, 0.03, 0.1)
EYRING = {"eyring_stress": 5e6}
LIMIT = {"limiting_stress_coefficient": 0.06, "limiting_stress_offset": 2e6}
STRESS_LAWS: tuple[dict[str, float], ...] = (EYRING, EYRING | LIMIT, LIMIT, {})
GRADES = (10, 32, 68, 100, 220, 460)
BASES = ("mineral", "pao", "ester", "polyglycol")
STRIPS = 0.2  # of the scenes under a cylinder: strips cost as much as ten patches
WARM = {"temperature": 350.0, "temperature_coefficient": 0.035}


def random_scene(rng: np.random.Generator, *, any_material: bool = False) -> lubfric.Scene:
    """Return a random scene; of steel bodies of one width or, with ``any_material``, of soft to hard ones, with steeper
    roughness and other tolerances.

    It is flat, or under a cylinder on strips or a patch; elastic or with a plastic limit; a height map or asperities;
    with one rough body or two; with an oil or with numbers, with and without its heat; with any shear law and
    slide-roll ratio.
    """
    v = _drawn(rng, RANGES)
    body = _drawn(rng, OTHERS) if any_material else {"width": WIDTH, "e_prime": E_PRIME}
    flat = bool(rng.random() < 0.5)
    strips = bool(rng.random() < STRIPS)
    scene = lubfric.load_scene("flat" if flat else "paper").with_(
        bodies={
            "radius": v["radius"],
            **body,
            "load": v["load_per_width"] * body["width"],
            "hardness": None,
            "boundary_friction_coefficient": float(rng.uniform(0.05, 0.15)),
        },
        lubricant=_lubricant(rng, v),
        motion={
            "entrainment_speed": v["speed"] * rng.choice((-1.0, 1.0)),
            "slide_roll_ratio": 0.0 if rng.random() < 0.04 else v["ratio"] * rng.choice((-1.0, 1.0)),
            "speeds": (),
        },
        numerics={
            "model": "paper",  # whose balance the judge solves
            "accept": False,
            "tolerance": float(rng.choice(OTHER_TOLERANCES if any_material else (0.01, 0.01, 0.05))),
            "sampling": "strips" if strips else "patch",
            "sampling_tolerance": 0.02 if rng.random() < 0.1 else 0.2,
        },
    )
    if rng.random() < 0.35:
        of_body = body["e_prime"] * float(rng.uniform(0.005, 0.05)) if any_material else float(rng.uniform(1.5e9, 8e9))
        hardness = max(of_body, 1.6 * scene.bodies.mean_hertz_pressure)
        scene = scene.with_(bodies={"hardness": hardness})
    return _rough(rng, scene, v["sq"], 0.2 if any_material else 0.05, flat=flat)


def _drawn(rng: np.random.Generator, ranges: Mapping[str, tuple[float, float]]) -> dict[str, float]:
    return {name: math.exp(rng.uniform(math.log(low), math.log(high))) for name, (low, high) in ranges.items()}


def _lubricant(rng: np.random.Generator, v: dict[str, float]) -> PlainRow:
    stress = dict.fromkeys(("eyring_stress", "limiting_stress_coefficient"), None)
    stress |= STRESS_LAWS[rng.choice(4, p=(0.5, 0.25, 0.15, 0.1))]
    common = stress | {"density_law": str(rng.choice(("constant", "dowson-higginson")))}
    if rng.random() < 0.4:
        return common | {
            "grade": f"ISO VG {rng.choice(GRADES)}",
            "viscosity_index": float(rng.uniform(85, 150)),
            "base": str(rng.choice(BASES)),
            "temperature": float(rng.uniform(300, 390)),
        }
    numbers = {"viscosity": v["viscosity"], "pressure_viscosity_coefficient": v["alpha"]}
    law = {"viscosity_law": str(rng.choice(("roelands", "roelands", "roelands", "constant")))}
    return common | numbers | law | (WARM if rng.random() < 0.3 else {})


def _rough(rng: np.random.Generator, scene: lubfric.Scene, sq: float, steepest: float, *, flat: bool) -> lubfric.Scene:
    """Return ``scene`` with a random map of ``sq`` [m], but at most ``steepest`` cells."""
    half_width = scene.bodies.half_width
    nx = int(rng.choice((28, 36, 48)))
    spacing = (6 * half_width if not flat else 2e-4) / nx
    long = nx == 48 and scene.numerics.sampling == "strips" and not flat  # their cells are twice the scene's
    keys: Keywords = {
        "sq": min(sq, steepest * spacing),
        "correlation_length": spacing * float(rng.uniform(2.1, 9.0 if long else nx / 11)),
        "acf": str(rng.choice(("gaussian", "exponential"))),
        "seed": int(rng.integers(2**31)),
    }
    grid: Keywords = {"shape": (nx, nx), "spacing": spacing}
    grid["region"] = "box" if rng.random() < 0.1 and not flat else "hertz"
    if flat and rng.random() < 0.12:
        grid |= {"model": str(rng.choice(("summits", "patches")))}
    scene = scene.with_(surface=keys, contact=grid)
    if rng.random() < 0.15:
        scene = scene.with_(counterface=keys | {"sq": 0.5 * keys["sq"]})
    return scene
