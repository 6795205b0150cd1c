"""Thousands of friction calls over random scenes in one process, judged by an independent balance."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field

import numpy as np

import lubfric

from ..stability.sharing_map import checked
from .case import resident_memory

MOST_GROWTH = 256.0  # MiB from the first quarter of the run to its end: what the allocator keeps of the largest film
RANGES = {  # of the logarithms: N/m, m/s, m, Pa s, 1/Pa, m, slide-roll ratio
    "load_per_width": (1e2, 5e5),
    "speed": (1e-5, 10.0),
    "radius": (1e-3, 5e-2),
    "viscosity": (5e-3, 1.0),
    "alpha": (5e-9, 2.5e-8),
    "sq": (1e-8, 1e-6),
    "ratio": (0.02, 2.0),
}
WIDTH, E_PRIME, EYRING = 1e-2, 231e9, 5e6


@dataclass
class Run:
    """What became of the calls: numbers of them, the worst error over what is allowed, why scenes were refused."""

    answered: int = 0
    refused: int = 0
    judged: int = 0
    raw: int = 0
    wrong: int = 0
    worst: float = 0.0
    growth: float = 0.0
    first_bad: str = ""
    worst_case: str = ""
    reasons: Counter = field(default_factory=Counter)


def random_scene(rng: np.random.Generator) -> lubfric.Scene:
    """Loads, speeds, sizes and oils of machines, flat or under a cylinder, with or without a plastic limit."""
    v = {name: math.exp(rng.uniform(math.log(low), math.log(high))) for name, (low, high) in RANGES.items()}
    flat = bool(rng.random() < 0.5)
    scene = lubfric.load_scene("flat" if flat else "paper").with_(
        bodies={
            "radius": v["radius"],
            "width": WIDTH,
            "load": v["load_per_width"] * WIDTH,
            "e_prime": E_PRIME,
            "hardness": None,
            "boundary_friction_coefficient": float(rng.uniform(0.05, 0.15)),
        },
        lubricant={"viscosity": v["viscosity"], "pressure_viscosity_coefficient": v["alpha"], "eyring_stress": EYRING},
        motion={
            "entrainment_speed": v["speed"] * rng.choice((-1.0, 1.0)),
            "slide_roll_ratio": v["ratio"],
            "speeds": (),
        },
        numerics={"accept": True},
    )
    half_width, nx = scene.bodies.half_width, int(rng.choice((32, 48, 64)))
    spacing = (6 * half_width if not flat else 2e-4) / nx
    return scene.with_(
        surface={
            "sq": min(v["sq"], 0.05 * spacing),
            "correlation_length": spacing * float(rng.uniform(2.5, nx / 12)),
            "acf": str(rng.choice(("gaussian", "exponential"))),
            "seed": int(rng.integers(2**31)),
        },
        contact={"shape": (nx, 32 if not flat else nx), "spacing": spacing},
    )


def soak(count: int, seed: int, judged_share: float) -> Run:
    """``count`` scenes of ``seed``; about ``judged_share`` of the answers are closed again."""
    rng, run, early = np.random.default_rng(seed), Run(), 0
    for i in range(count):
        if i == count // 4:
            early = resident_memory()
        scene = random_scene(rng)
        _one(scene, run, bool(rng.random() < judged_share))
    run.growth = (resident_memory() - early) / 2**20
    return run


def _one(scene: lubfric.Scene, run: Run, judge_it: bool) -> None:
    speed = scene.motion.entrainment_speed
    try:
        model = lubfric.prepare(scene)
        result = lubfric.friction(model)
    except lubfric.LubfricError as error:
        run.refused += 1
        run.reasons[str(error).split("=")[0].split(":")[0][:60]] += 1
        return
    except Exception as error:  # what must never happen
        run.raw += 1
        run.first_bad = run.first_bad or f"{type(error).__name__}: {error} of {scene}"[:300]
        return
    run.answered += 1
    if not (
        math.isfinite(result.coefficient)
        and math.isclose(result.contact_load + result.film_load, scene.bodies.load, rel_tol=1e-2)
    ):
        run.wrong += 1
    if not judge_it:
        return
    ratios = checked(model, speed)(result)
    run.judged += 1
    worst = max(ratios, key=lambda name: ratios[name])
    run.wrong += not ratios[worst] <= 1
    if not ratios[worst] <= run.worst:
        run.worst = ratios[worst]
        run.worst_case = f"{worst} {ratios[worst]:.3g} of {scene}"[:400]
