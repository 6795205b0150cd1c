"""Random contacts with moving roughness: each is solved or reports its failure, and the balances of its fields are
checked.

Lines of 5 N/mm to 1 GPa, Sq of 50 to 300 nm, films of 0.2 to 3 Sq, slide-roll ratios of -2 to 2, three kinds of oil,
roughness on one body or both. The map has 2.5 cells in a correlation length, and at least 3 in the Hertz half-width.
"""

import math
import time
from collections.abc import Iterator

import numpy as np

import lubfric
from lubfric.models.deterministic import RoughBody

from ...check import REPORTED, Check, Item, Table
from ...kept import Run
from ...types import Keywords, PlainRow
from .boundary_film import speed_of
from .moved import BALANCES, passed

POINTS = {"quick": 3, "default": 40, "full": 200}
E_PRIME = 2.2e11  # Pa, E' of two steel bodies
LIGHTEST = 5e3  # N/m, smallest load
HEAVIEST = 1e9  # Pa, largest pressure of Hertz
PER_LENGTH = 2.5  # cells in a correlation length, at least
PER_HALF_WIDTH = 3.0  # cells in a half-width, at least
COLUMNS = 12  # cells across the motion
ALLOWED = {"mass": 0.05, "load": 1e-3, "gap": 1e-2, "bounds": 1e-6}  # of a solved point
DRAWN = 0.1  # share of the lubricant out of touching cells from which a result has a warning; it is in the balance
OILS: tuple[Keywords, ...] = ({}, {"eyring_stress": 5e6}, {"eyring_stress": 5e6, "limiting_stress_coefficient": 0.06})


def drawn(seed: int) -> tuple[lubfric.Scene, list[RoughBody], float, PlainRow]:
    """Return scene, rough bodies and speed [m/s] of one random contact, and what it is in numbers."""
    rng = np.random.default_rng([33, seed])

    def between(low: float, high: float) -> float:
        return float(math.exp(rng.uniform(math.log(low), math.log(high))))

    radius = between(2e-3, 2e-2)
    sq = between(50e-9, 300e-9)
    length = between(8e-6, 25e-6)
    ratio = between(0.2, 3.0)
    lightest = math.sqrt(LIGHTEST * E_PRIME / (2 * math.pi * radius))
    pressure = between(lightest, HEAVIEST)
    slip = rng.uniform(-2, 2)
    kind = int(rng.integers(len(OILS)))
    rough = ("lower", "upper", "both")[int(rng.integers(3))]
    scene = lubfric.load_scene("paper").with_(
        bodies={"radius": radius, "hertz_pressure": pressure, "e_prime": E_PRIME, "hardness": None},
        lubricant={"viscosity": between(0.01, 0.2), "pressure_viscosity_coefficient": 18e-9} | OILS[kind],
        motion={"slide_roll_ratio": slip},
        numerics={"accept": True},
    )
    cell = min(length / PER_LENGTH, scene.bodies.half_width / PER_HALF_WIDTH)
    shape = int(min(96, 2 * math.ceil(max(32, 6 * length / cell) / 2))), COLUMNS
    maps = [
        lubfric.generate_surface(
            shape, (cell, length / PER_LENGTH), sq=sq / math.sqrt(2) if rough == "both" else sq,
            correlation_length=length, acf="gaussian", seed=2 * seed + k,
        )
        for k in range(2)
    ]  # fmt: skip
    speed = speed_of(scene, ratio * sq)
    bodies = [RoughBody(m, speed * (1 + s * slip / 2), s > 0) for m, s in zip(maps, (-1, 1))]
    chosen = {"lower": bodies[:1], "upper": bodies[1:], "both": bodies}[rough]
    inputs = {
        "pressure": pressure,
        "sq": sq,
        "ratio": ratio,
        "slip": slip,
        "radius": radius,
        "rough": rough,
        "oil": kind,
    }
    return scene, chosen, speed, inputs


def solved(seed: int) -> PlainRow:
    """Return one point: f and its balances; or how it was said not to be solved."""
    begun = time.process_time()
    inputs: Keywords = {}
    try:
        scene, bodies, speed, inputs = drawn(seed)
        solution = passed(scene, bodies, speed)
    except lubfric.LubfricError as error:
        return inputs | {"failure": f"{type(error).__name__}: {error}"[:200], "seconds": time.process_time() - begun}
    return inputs | solution | {"seconds": time.process_time() - begun}


def random_moving(level: str, run: Run = Run()) -> Iterator[Item]:
    """Check that every point fulfils its balances or reports its failure; show the largest imbalance of each kind."""
    rows = [row for _, row in run.solved({f"{k}": k for k in range(POINTS[level])}, solved)]
    fine = [row for row in rows if "failure" not in row]
    off = {name: np.array([row["off"][name] for row in fine]) for name in BALANCES}
    given = np.array([row["drawn"] for row in fine])
    wrong = np.any([~(off[name] <= ALLOWED[name]) for name in BALANCES], axis=0)
    name = f"{len(rows)} random points of moving roughness"
    yield Check(
        f"{name}: silently wrong",
        int(wrong.sum()),
        expected=0,
        tolerance=0.0,
        source="balances of the fields",
        kind="absolute",
    )
    what = f"{name}: said to rest on the lubricant of touching cells"
    yield Check(
        what, int((given > DRAWN).sum()), expected=0, tolerance=0.0, source="the warning of a result", kind=REPORTED
    )
    yield Check(
        f"{name}: said not to be solved",
        len(rows) - len(fine),
        expected=0,
        tolerance=0.0,
        source="the solver's report",
        kind=REPORTED,
    )
    table = [
        (name, f"{np.median(off[name]):.1e}", f"{np.quantile(off[name], 0.95):.1e}", f"{off[name].max():.1e}",
         f"{ALLOWED[name]:g}") for name in BALANCES
    ]  # fmt: skip
    columns = ("balance", "median", "95 %", "worst", "allowed")
    yield Table("moving-points", f"{len(fine)} of {len(rows)} random points solved: their balances", columns, table)
