"""The tables: moving answers on surfaces of their own, and the friction of the endless line that they are compared with.

An answer is one strip, followed until its error is within the tolerance of the scene, as `lubfric.friction` takes it. Its
half-width here has the sampling error and that of the cells only. The reference of a contact is the mean over other
strips, each followed over a whole pass after a longer discard, times the change of f on shorter and shorter cells. That is
the mean change on cells half as long along both axes of narrower strips, over the same way, and a third of it more: the
limit of second order (`moving_cells`).
"""

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

import lubfric
from lubfric.estimate import sampled
from lubfric.models import DeterministicModel, prepare
from lubfric.models.deterministic import (
    TIGHT,
    DeterministicSolution,
    MovingStripSolution,
    RoughBody,
    SampleTarget,
    effort_of,
    mean_over_blocks,
    solve_moving_strip,
)
from lubfric.models.deterministic.rough_bodies import bodies_of, summit_control
from lubfric.models.deterministic.strip_on_two_grids import surface_and_factors
from lubfric.models.shared import Prepared, student
from lubfric.scene import Scene, moving_bodies
from lubfric.surface import generate_surface

from ...types import Option, PlainRow
from .. import table_file

# The tables of answers and references.
FOLDER = Path(__file__).parent
ANSWERS = "answers.csv"
REFERENCES = "references.csv"
ANSWER_COLUMNS = (
    "contact",
    "seed",
    "f",
    "sampling",
    "freedom",
    "numerical",
    "by_longer",
    "by_film",
    "strips",
    "steps",
    "work",
    "seconds",
    "failure",
)
REFERENCE_COLUMNS = ("contact", "kind", "seed", "f", "error", "plain", "plain_error", "seconds", "failure")

# Seeds of the strips of references, far from those of answers.
REFERENCE_SEED = 1000

# Surfaces of a reference: of its strips, and of the narrower strips on shorter cells.
REFERENCE_SEEDS = 3

# Half-widths that a strip of a reference discards.
REFERENCE_DISCARDED = 4.0

# Relative error of f that no pass reaches: all of the map passes.
WHOLE_PASS = 1e-9

NARROW = 24  # correlation lengths along y of the narrower strip on shorter cells
WAY = 2.0  # half-widths whose moments count there

# Change of f from the cells of an answer to the limit, over that to cells half as long: by second order.
LIMIT = 4.0 / 3.0

# Standard errors of the reference that an answer may be off beyond its own half-width.
OF_REFERENCE = 2.0

DIGITS = 7  # of a number in the tables


@dataclass(frozen=True)
class RollingContact:
    """A rolling contact: its scene, its speed [m/s], and whether it is heavily loaded, at 1 GPa."""

    name: str
    scene: Scene
    speed: float
    heavy: bool = False


def _contact(name: str, speed: float, *, heavy: bool = False, **sections: Option) -> RollingContact:
    """Return a contact of steel bodies with a stated boundary film, so that only cells and sample are uncertain."""
    bodies = {"boundary_film": 2e-8, "hardness": None, "boundary_friction_coefficient": 0.12} | sections.pop("bodies")
    scene = lubfric.load_scene("paper").with_(bodies=bodies, **sections)
    return RollingContact(name, scene, speed, heavy)


def contacts() -> tuple[RollingContact, ...]:
    """Return the contacts; the surfaces have no seeds of their own yet."""
    return (
        _contact(
            "needle roller",
            2.0,
            heavy=True,
            bodies={"radii": (3e-3, 30e-3), "width": 10e-3, "load": 800.0, "material": "steel"},
            lubricant={"viscosity": 0.0105, "pressure_viscosity_coefficient": 17e-9, "eyring_stress": 5e6},
            motion={"slide_roll_ratio": 0.01},
            surface={"sq": 1.88e-7, "correlation_length": 20e-6, "acf": "gaussian"},
            counterface={"sq": 1.0e-7, "correlation_length": 20e-6, "acf": "gaussian"},
            contact={"shape": (100, 100), "spacing": 5e-6},
        ),
        _contact(
            "roller bearing",
            3.0,
            heavy=True,
            bodies={"radii": (6e-3, 30e-3), "width": 14e-3, "load": 2000.0, "material": "steel"},
            lubricant={
                "viscosity": 0.018,
                "pressure_viscosity_coefficient": 18e-9,
                "eyring_stress": 5e6,
                "limiting_stress_coefficient": 0.06,
            },
            motion={"slide_roll_ratio": 0.1},
            surface={"sq": 2.5e-7, "correlation_length": 30e-6, "acf": "gaussian"},
            counterface={"sq": 1.2e-7, "correlation_length": 30e-6, "acf": "gaussian"},
            contact={"shape": (80, 80), "spacing": 7e-6},
        ),
        _contact(
            "gear flank",
            2.5,
            bodies={"radii": (8e-3, 14e-3), "width": 14e-3, "load": 1750.0, "material": "steel"},
            lubricant={
                "viscosity": 0.03,
                "pressure_viscosity_coefficient": 18e-9,
                "eyring_stress": 5e6,
                "limiting_stress_coefficient": 0.05,
            },
            motion={"slide_roll_ratio": 0.4},
            surface={"sq": 3e-7, "correlation_length": 25e-6, "acf": "gaussian"},
            counterface={"sq": 3e-7, "correlation_length": 25e-6, "acf": "gaussian"},
            contact={"shape": (96, 96), "spacing": 6e-6},
        ),
        _contact(
            "light contact",
            0.6,
            bodies={"radius": 5e-3, "width": 10e-3, "load": 150.0, "material": "steel"},
            lubricant={"viscosity": 0.05, "pressure_viscosity_coefficient": 15e-9, "eyring_stress": 5e6},
            motion={"slide_roll_ratio": -0.5},
            surface={"sq": 1.5e-7, "correlation_length": 15e-6, "acf": "gaussian"},
            contact={"shape": (80, 80), "spacing": 3.5e-6},
        ),
        _contact(
            "sliding roller",
            1.5,
            bodies={"radius": 6e-3, "width": 10e-3, "load": 500.0, "material": "steel"},
            lubricant={
                "viscosity": 0.02,
                "pressure_viscosity_coefficient": 16e-9,
                "limiting_stress_coefficient": 0.08,
            },
            motion={"slide_roll_ratio": 1.0},
            surface={"sq": 1.2e-7, "correlation_length": 20e-6, "acf": "gaussian"},
            contact={"shape": (80, 80), "spacing": 5e-6},
        ),
        _contact(
            "exponential surface",
            1.0,
            bodies={"radius": 6e-3, "width": 10e-3, "load": 700.0, "material": "steel"},
            lubricant={"viscosity": 0.03, "pressure_viscosity_coefficient": 18e-9, "eyring_stress": 8e6},
            motion={"slide_roll_ratio": 0.1},
            surface={"sq": 2e-7, "correlation_length": 45e-6, "acf": "exponential"},
            contact={"shape": (96, 96), "spacing": 5e-6},
        ),
    )


def with_seed(contact: RollingContact, seed: int) -> Scene:
    """Return the scene of ``contact`` with surfaces of this ``seed``."""
    sections = {name: {"seed": seed + 500_000 * k} for k, (name, _) in enumerate(moving_bodies(contact.scene))}
    return contact.scene.with_(**sections)


def answer(contact: RollingContact, seed: int) -> PlainRow:
    """Return the row of one moving answer."""
    solution = sampled(prepare(with_seed(contact, seed)), contact.speed, DeterministicModel())
    assert isinstance(solution, DeterministicSolution)
    parts = solution.answer()
    pairs = solution.pairs
    first = pairs[0].resolved
    assert isinstance(first, MovingStripSolution)
    results = [pair.resolved.result for pair in pairs]
    return {
        "f": parts.numbers["coefficient"],
        "sampling": parts.sampling.error,
        "freedom": parts.sampling.freedom,
        "numerical": parts.numerical,
        "by_longer": float(np.mean([pair.change_by_cells for pair in pairs])),
        "by_film": float(np.mean([abs(result.at_twice_film / result.coefficient - 1) for result in results])),
        "strips": len(pairs),
        "steps": first.times.size - first.discarded,
        "work": sum(pair.resolved.work for pair in pairs),
    }


def reference_strip(contact: RollingContact, seed: int) -> PlainRow:
    """Return f of a whole pass of one strip and its standard error, on the cells of the answers."""
    prepared = prepare(with_seed(contact, REFERENCE_SEED + seed))
    _, factors = surface_and_factors(prepared, 0)
    bodies = bodies_of(prepared, 0, contact.speed)
    effort = replace(effort_of(prepared.scene, bodies, contact.speed, factors), discarded=REFERENCE_DISCARDED)
    control = summit_control(prepared)
    assert control is not None  # the sample has strips
    length = prepared.sample.correlation_lengths[1]
    target = SampleTarget(error=WHOLE_PASS, correlation_length=length, control=control)
    strip = solve_moving_strip(prepared.scene, bodies, contact.speed, factors=factors, effort=effort, target=target)
    mean = mean_over_blocks([strip.places], "friction", length, control)
    plain = {"plain": mean.value - mean.correction, "plain_error": mean.plain.error}
    return {"f": mean.value, "error": mean.error.error} | plain


def tight_strip(contact: RollingContact, seed: int) -> PlainRow:
    """Return f of a whole pass of one strip in tight steps, without a control: as version 0.2.0 took it, but on its cells
    of today."""
    prepared = prepare(with_seed(contact, REFERENCE_SEED + seed))
    _, factors = surface_and_factors(prepared, 0)
    bodies = bodies_of(prepared, 0, contact.speed)
    strip = solve_moving_strip(prepared.scene, bodies, contact.speed, factors=factors, effort=TIGHT)
    mean = mean_over_blocks([strip.places], "friction", prepared.sample.correlation_lengths[1], None)
    return {"f": mean.value, "error": mean.error.error}


def narrow_strip(
    contact: RollingContact, seed: int, halvings: tuple[int, int]
) -> tuple[Prepared, list[RoughBody], tuple[int, int]]:
    """Return the prepared scene of ``contact``, rough bodies `NARROW` correlation lengths wide on cells halved so often along x and
    y, and the length of the cells of an answer in these."""
    scene = with_seed(contact, REFERENCE_SEED + seed)
    prepared = prepare(scene)
    _, (fx, fy) = surface_and_factors(prepared, 0)
    (dx, dy) = prepared.sample.cells.spacing
    factors = (fx * 2 ** halvings[0], fy * 2 ** halvings[1])
    columns = factors[0] * math.ceil(6 * scene.bodies.half_width / (fx * dx))
    rows = 4 * factors[1] * math.ceil(NARROW * prepared.sample.correlation_lengths[1] / (4 * fy * dy))
    bodies = []
    for k, (name, ratio) in enumerate(moving_bodies(scene)):
        rough = getattr(scene, name)
        surface = generate_surface(
            (columns, rows),
            (dx / 2 ** halvings[0], dy / 2 ** halvings[1]),
            sq=rough.sq,
            correlation_length=rough.correlation_length,
            acf=rough.acf,
            decay_level=rough.decay_level,
            seed=seed + 17 * k,
        )
        bodies.append(RoughBody(surface, contact.speed * ratio, name == "counterface"))
    return prepared, bodies, factors


def change_by_cells(contact: RollingContact, seed: int) -> PlainRow:
    """Return the ratio of f on cells half as long along both axes to that on the cells of the answers."""
    prepared, bodies, (fx, fy) = narrow_strip(contact, seed, (1, 1))
    scene = prepared.scene
    f = []
    for factors in ((fx, fy), (fx // 2, fy // 2)):
        steps = round(WAY * scene.bodies.half_width / (factors[0] * bodies[0].surface.spacing[0]))
        strip = solve_moving_strip(scene, bodies, contact.speed, factors=factors, most_steps=steps)
        f.append(strip.result.coefficient)
    return {"f": f[1] / f[0], "error": 0.0}


KINDS = {"strip": reference_strip, "cells": change_by_cells, "tight": tight_strip}


def extend(
    seeds: int, budget: float, folder: Path = FOLDER, names: Sequence[str] = (), *, references: bool = True
) -> Iterator[PlainRow]:
    """Solve what the tables have not, as long as the processor time of this process is below ``budget`` [s], and append
    each row as it is solved: all references (none without ``references``), then the answers of so many ``seeds``; of the
    contacts whose name is in ``names``, or all."""
    chosen = [contact for contact in contacts() if not names or contact.name in names]
    kept = {(row["contact"], row["kind"], row["seed"]) for row in table_file.rows(folder / REFERENCES)}
    for kind, number in (*((kind, k) for k in range(REFERENCE_SEEDS) for kind in ("strip", "cells")), ("tight", 0)):
        for contact in chosen if references else ():
            if time.process_time() > budget:
                return
            if (contact.name, kind, str(number)) not in kept and (contact.heavy or kind != "tight"):
                row = {"contact": contact.name, "kind": kind, "seed": number} | _timed(KINDS[kind], contact, number)
                yield _appended(folder / REFERENCES, REFERENCE_COLUMNS, row)
    known = {(row["contact"], row["seed"]) for row in table_file.rows(folder / ANSWERS)}
    for seed in range(seeds):
        for contact in chosen:
            if time.process_time() > budget:
                return
            if (contact.name, str(seed)) not in known:
                row = {"contact": contact.name, "seed": seed} | _timed(answer, contact, seed)
                yield _appended(folder / ANSWERS, ANSWER_COLUMNS, row)


def _timed(solve: Callable[[RollingContact, int], PlainRow], contact: RollingContact, seed: int) -> PlainRow:
    begun = time.process_time()
    try:
        row = solve(contact, seed) | {"failure": ""}
    except lubfric.LubfricError as error:
        row = {"failure": f"{type(error).__name__}: {error}".replace("\n", " ")[:120]}
    return row | {"seconds": time.process_time() - begun}


def _appended(file: Path, columns: tuple[str, ...], row: PlainRow) -> PlainRow:
    table_file.append(file, columns, row, DIGITS)
    return row


def covered(folder: Path = FOLDER) -> Iterator[PlainRow]:
    """Yield of each contact how many answers hold the reference within their half-width, and within it and
    `OF_REFERENCE` standard errors of the reference."""
    for contact in contacts():
        of_contact = [
            row for row in table_file.rows(folder / REFERENCES) if row["contact"] == contact.name and not row["failure"]
        ]
        strips = [row for row in of_contact if row["kind"] == "strip"]
        cells = [float(row["f"]) for row in of_contact if row["kind"] == "cells"]
        answers = [
            row for row in table_file.rows(folder / ANSWERS) if row["contact"] == contact.name and not row["failure"]
        ]
        if not strips or not cells or not answers:
            continue
        mean_of_strips = float(np.mean([float(row["f"]) for row in strips]))
        limits = [1.0 + LIMIT * (ratio - 1.0) for ratio in cells]
        truth = mean_of_strips * float(np.mean(limits))
        of_strips = math.sqrt(sum(float(row["error"]) ** 2 for row in strips)) / len(strips) / mean_of_strips
        of_cells = float(np.std(limits, ddof=1)) / math.sqrt(len(limits)) if len(limits) > 1 else 0.0
        error = math.hypot(of_strips, of_cells)
        deviations = np.array([1 - truth / float(row["f"]) for row in answers])  # over f, as its half-width is
        widths = np.array([_half_width(row) for row in answers])
        yield {
            "contact": contact.name,
            "heavy": contact.heavy,
            "answers": len(answers),
            "reference": truth,
            "reference_error": error,
            "mean_deviation": float(deviations.mean()),
            "scatter": float(deviations.std(ddof=1)) if len(answers) > 1 else math.nan,
            "half_width": float(np.median(widths)),
            "inside": int((np.abs(deviations) <= widths).sum()),
            "inside_with_reference": int((np.abs(deviations) <= np.hypot(widths, OF_REFERENCE * error)).sum()),
            "seconds": float(np.median([float(row["seconds"]) for row in answers])),
        }


def _half_width(row: dict[str, str]) -> float:
    return math.hypot(student(int(row["freedom"])) * float(row["sampling"]), float(row["numerical"]))
