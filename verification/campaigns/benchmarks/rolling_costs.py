"""What rolling contacts and the same bodies at rest cost: processor time and counted work of usual jobs.

    python -m verification.campaigns.benchmarks.rolling_costs [--jobs NAME ...] [--docs docs]

Processor seconds of one thread hang on the machine and on its other jobs, counted work on neither. Jobs with ranges of
inputs solve their ends too.
"""

import os

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(name, "1")

import argparse
import math
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

import lubfric
from lubfric._base import limited_work
from lubfric.models.deterministic import RoughBody, solve_moving_strip
from lubfric.scene import Scene

from . import page

# What is printed.
COLUMNS = ("", "CPU s, 0.2.0", "CPU s", "counted work (s)", "f")

# Columns of the page.
OF_PAGE = (0, 2, 3)

# Speeds of the roller at rest [m/s].
RESTING_SPEEDS = (10.0, 3.0, 1.0, 0.3, 0.1, 0.03)

# Speeds of the curve of the scene "paper" [m/s].
PAPER_SPEEDS = np.geomspace(1e-3, 0.3, 25)

# Cells of the map that passes, and their length [m].
PASSING_SHAPE = (256, 64)
PASSING_CELL = 2e-6

# Speed of the rough body over U in the pass [-]: a slide-roll ratio of 0.1.
PASSING_RATIO = 1.05

# The pair C of the FZG rig: teeth, distance between the centres [m], pressure angle in operation [rad], radii of the
# tips [m], speed in the pitch circle [m/s], force along the path of contact [N], points on the path.
TEETH = (16, 24)
CENTRES = 91.5e-3
ANGLE = math.radians(22.44)
TIPS = (41.23e-3, 59.18e-3)
PITCH_SPEED = 2.1
FORCE = 3.5e3
PLACES = 9

MINERAL_OIL = {"viscosity_index": 95, "eyring_stress": "mineral"}
ANTI_WEAR_STEEL = {"material": "100Cr6", "hardness": "100Cr6", "boundary_friction_coefficient": "anti-wear"}


@dataclass(frozen=True, kw_only=True)
class CostJob:
    """A job: ``run`` returns its friction coefficients; ``before``: processor seconds of version 0.2.0 (NaN: not
    known)."""

    run: Callable[[], list[float]]
    before: float = math.nan


def _rolling_steel(
    radii: tuple[float, float], width: float, load: float, oil: dict[str, str], slip: str, roughness: tuple[str, str]
) -> Scene:
    """Return two rough steel bodies [m, N] in mineral oil, by the names that a user types."""
    (ra, other_ra) = roughness
    rough = {"correlation_length": "20 um", "acf": "gaussian"}
    return lubfric.load_scene(
        {
            "bodies": {"radii": radii, "width": width, "load": load, **ANTI_WEAR_STEEL},
            "lubricant": MINERAL_OIL | oil,
            "motion": {"entrainment_speed": 1.0, "slip_percent": slip},
            "surface": {"ra": ra, **rough},
            "counterface": {"ra": other_ra, **rough},
            "contact": {"shape": (128, 128), "spacing": 4e-6},
        }
    )


def bearing() -> list[float]:
    """Return f of the bearing of the start page at 3 m/s."""
    oil = {"grade": "ISO VG 68", "temperature": "70 °C"}
    scene = _rolling_steel((6e-3, 30e-3), 14e-3, 2000.0, oil, "3 %", ("0.2 um", "0.1 um"))
    return [lubfric.friction(scene, 3.0).coefficient]


def needle(speed: float) -> list[float]:
    """Return f of a needle roller at a ``speed`` [m/s]."""
    oil = {"grade": "ISO VG 46", "temperature": "80 °C"}
    scene = _rolling_steel((3e-3, 30e-3), 10e-3, 800.0, oil, "1 %", ("0.15 um", "0.08 um"))
    return [lubfric.friction(scene, speed).coefficient]


def roller(slide_roll_ratio: float) -> Scene:
    """Return a roller of 1 GPa with a roughness of 150 nm."""
    return lubfric.load_scene("paper").with_(
        bodies={
            "radius": 6e-3,
            "width": 10e-3,
            "load": 1600.0,
            "material": "steel",
            "hardness": None,
            "boundary_friction_coefficient": 0.12,
        },
        lubricant={
            "viscosity": 0.02,
            "pressure_viscosity_coefficient": 18e-9,
            "eyring_stress": 5e6,
            "limiting_stress_coefficient": 0.06,
        },
        motion={"slide_roll_ratio": slide_roll_ratio},
        surface={"sq": 150e-9, "correlation_length": 10e-6, "acf": "gaussian"},
        contact={"shape": PASSING_SHAPE, "spacing": PASSING_CELL},
    )


def passing() -> list[float]:
    """Return the mean f while a map passes the roller once."""
    surface = lubfric.generate_surface(
        PASSING_SHAPE, PASSING_CELL, sq=150e-9, correlation_length=10e-6, acf="gaussian", seed=1
    )
    strip = solve_moving_strip(roller(0.1), [RoughBody(surface, PASSING_RATIO, upper=True)], 1.0)
    return [strip.result.coefficient]


def resting() -> list[float]:
    """Return f of the roller in sliding, its roughness at rest, at `RESTING_SPEEDS`."""
    prepared = lubfric.prepare(roller(2.0))
    return [lubfric.friction(prepared, speed).coefficient for speed in RESTING_SPEEDS]


def paper_curve() -> list[float]:
    """Return the Stribeck curve of the scene "paper"."""
    return lubfric.stribeck(lubfric.load_scene("paper"), PAPER_SPEEDS).coefficient.tolist()


def gear_flank() -> list[float]:
    """Return f along the path of contact of a gear, where one pair of teeth carries the load with it all."""
    pitch = np.array(TEETH) / sum(TEETH) * CENTRES
    foot = pitch * math.cos(ANGLE)
    reach = np.sqrt(np.array(TIPS) ** 2 - foot**2) - pitch * math.sin(ANGLE)
    base_pitch = 2 * math.pi * foot[0] / TEETH[0]
    base = lubfric.load_scene("paper").with_(
        bodies={"width": 14e-3, "material": "steel", "hardness": None, "boundary_friction_coefficient": 0.0675},
        lubricant={
            "grade": "ISO VG 100",
            "viscosity_index": 95,
            "temperature_celsius": 60,
            "eyring_stress": 5e6,
            "limiting_stress_coefficient": 0.05,
        },
        surface={"sq": 0.25e-6, "correlation_length": 30e-6, "acf": "gaussian"},
        counterface={"sq": 0.25e-6, "correlation_length": 30e-6, "acf": "gaussian"},
        contact={"shape": (128, 128), "spacing": 6e-6},
    )
    coefficients = []
    for place in np.linspace(-reach[1], reach[0], PLACES) + 1e-5:
        radii = pitch * math.sin(ANGLE) + np.array([1, -1]) * place
        (u1, u2) = PITCH_SPEED / pitch * radii
        is_single = reach[0] - base_pitch < place < base_pitch - reach[1]
        bodies = {"radii": radii.tolist(), "load": FORCE if is_single else FORCE / 2}
        motion = {"slide_roll_ratio": float(2 * (u2 - u1) / (u1 + u2))}
        coefficients.append(lubfric.friction(base.with_(bodies=bodies, motion=motion), (u1 + u2) / 2).coefficient)
    return coefficients


# The jobs by name: the bearing of the start page; the roller has 1 GPa, and rests at six speeds. The seconds of version
# 0.2.0 were measured with that version on the same kind of machine.
JOBS = {
    "bearing, 3 m/s": CostJob(run=bearing, before=630),
    "needle roller, 0.05 m/s": CostJob(run=lambda: needle(0.05), before=365),
    "needle roller, 2 m/s": CostJob(run=lambda: needle(2.0), before=278),
    "needle roller, 5 m/s": CostJob(run=lambda: needle(5.0), before=279),
    "gear flank, nine points": CostJob(run=gear_flank),
    "roller, one pass": CostJob(run=passing, before=59),
    "roller, six speeds": CostJob(run=resting, before=52),
    "paper, 25 speeds": CostJob(run=paper_curve, before=22),
}


def rows(names: list[str]) -> Iterator[list[str]]:
    """Run the jobs whose name begins with one of ``names``, and yield their rows."""
    for name, job in JOBS.items():
        if not name.startswith(tuple(names)):
            continue
        begun = time.process_time()
        with limited_work(math.inf) as meter:
            coefficients = job.run()
        seconds = time.process_time() - begun
        low = min(coefficients)
        high = max(coefficients)
        shown = f"{low:.4f}" if low == high else f"{low:.4f}–{high:.4f}"
        before = "" if math.isnan(job.before) else f"{job.before:.0f}"
        yield [name, before, f"{seconds:.1f}", f"{meter.spent:.1f}", shown]


def main() -> None:
    """Measure, and print what was measured."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jobs", nargs="+", default=[""], metavar="NAME", help="how the names of the jobs begin")
    page.add_option(parser)
    options = parser.parse_args()
    table = []
    print(" | ".join(COLUMNS))
    for row in rows(options.jobs):
        table.append([row[column] for column in OF_PAGE])
        print(" | ".join(row), flush=True)
    page.write("rolling-costs", [COLUMNS[column] for column in OF_PAGE], table, (parser, options))


if __name__ == "__main__":
    main()
