"""The tables: moving answers on surfaces of their own, and the friction of the endless line that they are compared
with.

An answer is one strip, followed until its error is within the tolerance of the scene, as `lubfric.friction` takes it.
Its half-width here has the sampling error and that of the cells only. The reference of a contact is the mean over other
strips, each followed over a whole pass after a longer discard, times the change of f on shorter and shorter cells. That
is the mean change on cells half as long along both axes of narrower strips, over the same way, and a third of it more:
the limit of second order (`moving_cells`).
"""

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

import lubfric
from lubfric.estimate import solve_to_tolerance
from lubfric.models import DeterministicModel, prepare
from lubfric.models.deterministic import (
    CellsInMotion,
    DeterministicSolution,
    RoughBody,
    SampleTarget,
    cells_of_strips,
    effort_of,
    mean_over_blocks,
    solve_moving_strip,
)
from lubfric.models.deterministic.rough_bodies import bodies_of, summit_control
from lubfric.models.deterministic.strip_on_two_grids import surface_and_map_coarsening
from lubfric.models.shared import Prepared, student
from lubfric.scene import Scene, moving_bodies
from lubfric.surface import generate_surface

from ...types import PlainRow
from .. import extending, table_file
from ..calibration.solve import limited
from .contacts import RANDOM, RollingContact, contact_named

# The tables of answers and references.
FOLDER = Path(__file__).parent
ANSWERS = "answers.csv"
REFERENCES = "references.csv"
ANSWER_COLUMNS = (
    "contact",
    "seed",
    "f",
    "change",
    "sampling",
    "freedom",
    "film_ratio",
    "coarse_x",
    "coarse_y",
    "coarse_b",
    "by_longer",
    "follows_lubricant",
    "is_smooth",
    "sliding_share",
    "strips",
    "steps",
    "work",
    "seconds",
    "failure",
)
REFERENCE_COLUMNS = ("contact", "kind", "seed", "f", "error", "plain", "plain_error", "seconds", "failure")

# Seeds of the strips of references, far from those of answers.
REFERENCE_SEED = 1000

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

# Scatter of the change by cells between narrow strips: a share of its mean, and at least so much, relative to f [-]. Of
# 14 contacts with two or three narrow strips, ten scatter by less.
NARROW_SCATTER = (0.25, 0.005)

DIGITS = 7  # of a number in the tables

ANSWER = "answer"  # the kind of a job that is no reference

# Processor time of a job [s], at most.
MOST_SECONDS = 150.0


def with_seed(contact: RollingContact, seed: int) -> Scene:
    """Return the scene of ``contact`` with surfaces of this ``seed``."""
    sections = {name: {"seed": seed + 500_000 * k} for k, (name, _) in enumerate(moving_bodies(contact.scene))}
    return contact.scene.with_(**sections)


def answer(contact: RollingContact, seed: int) -> PlainRow:
    """Return the row of one moving answer."""
    solution = solve_to_tolerance(prepare(with_seed(contact, seed)), contact.speed, DeterministicModel())
    assert isinstance(solution, DeterministicSolution)
    parts = solution.answer()
    pairs = solution.pairs
    places = pairs[0].resolved.places_over_time
    assert places is not None  # the roughness moves
    strips = [pair.resolved for pair in pairs]
    by_longer = float(np.mean([pair.change_by_cells for pair in pairs]))
    cells = cells_of_strips(solution.prepared, strips, by_longer)
    return {
        "f": parts.numbers["coefficient"],
        "change": cells.change,
        "sampling": parts.errors.sampling_error.value,
        "freedom": parts.errors.sampling_error.freedom,
        "strips": len(pairs),
        "steps": places.friction.shape[0],
        "work": sum(strip.work for strip in strips),
    } | {name: float(value) for name, value in vars(cells).items()}


def cells_of(row: dict[str, str]) -> CellsInMotion:
    """Return the cells of the answer in a ``row`` of the table, whose effect is that by the law of today."""
    return CellsInMotion(
        film_ratio=float(row["film_ratio"]),
        coarse_x=float(row["coarse_x"]),
        coarse_y=float(row["coarse_y"]),
        coarse_b=float(row["coarse_b"]),
        by_longer=float(row["by_longer"]),
        follows_lubricant=float(row["follows_lubricant"]) == 1.0,
        is_smooth=float(row["is_smooth"]) == 1.0,
        sliding_share=float(row["sliding_share"]),
    )


def coefficient_of(row: dict[str, str]) -> float:
    """Return f of the answer in a ``row`` of the table, with the effect of cells by the law of today."""
    return float(row["f"]) / (1.0 + float(row["change"])) * (1.0 + cells_of(row).change)


def reference_strip(contact: RollingContact, seed: int) -> PlainRow:
    """Return f of a whole pass of one strip and its standard error, on the cells of the answers."""
    prepared = prepare(with_seed(contact, REFERENCE_SEED + seed))
    _, map_coarsening = surface_and_map_coarsening(prepared, 0)
    bodies = bodies_of(prepared, 0, contact.speed)
    effort = replace(effort_of(prepared.scene, bodies, contact.speed, map_coarsening), discarded=REFERENCE_DISCARDED)
    control = summit_control(prepared)
    assert control is not None  # the sample has strips
    length = prepared.sample.correlation_lengths[1]
    target = SampleTarget(relative_error=WHOLE_PASS, correlation_length=length, control=control)
    strip = solve_moving_strip(
        prepared.scene, bodies, contact.speed, map_coarsening=map_coarsening, effort=effort, target=target
    )
    mean = mean_over_blocks([strip.places], "friction", length, control)
    plain = {"plain": mean.value - mean.correction, "plain_error": mean.plain.value}
    return {"f": mean.value, "error": mean.error.value} | plain


def narrow_strip(
    contact: RollingContact, seed: int, halvings: tuple[int, int]
) -> tuple[Prepared, list[RoughBody], tuple[int, int]]:
    """Return the prepared scene of ``contact``, rough bodies `NARROW` correlation lengths wide on cells halved so often
    along x and y, and the length of the cells of an answer in these."""
    scene = with_seed(contact, REFERENCE_SEED + seed)
    prepared = prepare(scene)
    _, (fx, fy) = surface_and_map_coarsening(prepared, 0)
    (dx, dy) = prepared.sample.cells.spacing
    map_coarsening = (fx * 2 ** halvings[0], fy * 2 ** halvings[1])
    columns = map_coarsening[0] * math.ceil(6 * scene.bodies.half_width / (fx * dx))
    rows = 4 * map_coarsening[1] * math.ceil(NARROW * prepared.sample.correlation_lengths[1] / (4 * fy * dy))
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
    return prepared, bodies, map_coarsening


def change_by_cells(contact: RollingContact, seed: int) -> PlainRow:
    """Return the ratio of f on cells half as long along both axes to that on the cells of the answers."""
    prepared, bodies, (fx, fy) = narrow_strip(contact, seed, (1, 1))
    scene = prepared.scene
    f = []
    for map_coarsening in ((fx, fy), (fx // 2, fy // 2)):
        steps = round(WAY * scene.bodies.half_width / (map_coarsening[0] * bodies[0].surface.spacing[0]))
        strip = solve_moving_strip(scene, bodies, contact.speed, map_coarsening=map_coarsening, most_steps=steps)
        f.append(strip.result.coefficient)
    return {"f": f[1] / f[0], "error": 0.0}


KINDS = {"strip": reference_strip, "cells": change_by_cells}


@dataclass(frozen=True)
class CoverageJob:
    """One row of a table: an answer, or a ``kind`` of reference, of the contact of this ``name`` on surfaces of
    ``seed``."""

    kind: str
    name: str
    seed: int

    def row(self) -> PlainRow:
        """Return the row, solved; where it takes more than `MOST_SECONDS`, ``failure`` says so."""
        contact = contact_named(self.name)
        solve = answer if self.kind == ANSWER else KINDS[self.kind]
        row: PlainRow = {"contact": self.name, "kind": self.kind, "seed": self.seed}
        begun = time.process_time()
        try:
            with limited(MOST_SECONDS):
                row |= solve(contact, self.seed) | {"failure": ""}
        except (lubfric.LubfricError, FloatingPointError, np.linalg.LinAlgError) as error:
            row["failure"] = f"{type(error).__name__}: {error}".replace("\n", " ")[:120]
        return row | {"seconds": time.process_time() - begun}


def jobs_left(folder: Path, names: Sequence[str], *, answers: int, strips: int, narrow: int) -> list[CoverageJob]:
    """Return what the tables have not of the contacts ``names``: so many ``answers``, ``strips`` of the reference, and
    ``narrow`` strips of it on shorter cells, a round of all contacts after the other."""
    kept = {(row["kind"], row["contact"], row["seed"]) for row in table_file.rows(folder / REFERENCES)}
    kept |= {(ANSWER, row["contact"], row["seed"]) for row in table_file.rows(folder / ANSWERS)}
    counts = {"cells": narrow, "strip": strips, ANSWER: answers}
    jobs = [
        CoverageJob(kind, name, seed)
        for seed in range(max(counts.values()))
        for kind, count in counts.items()
        if seed < count
        for name in names
    ]
    return [job for job in jobs if (job.kind, job.name, str(job.seed)) not in kept]


def extend(jobs: Sequence[CoverageJob], seconds: float, folder: Path = FOLDER, workers: int = 1) -> Iterator[PlainRow]:
    """Solve ``jobs`` in so many processes, and append each row to the tables in ``folder`` when it is solved; after so
    many ``seconds`` of elapsed time those that are not ready are left out."""
    for row in extending.solved_in_processes(jobs, seconds, workers):
        (file, columns) = (ANSWERS, ANSWER_COLUMNS) if row["kind"] == ANSWER else (REFERENCES, REFERENCE_COLUMNS)
        table_file.append(folder / file, columns, row, DIGITS)
        yield row


@dataclass(frozen=True, kw_only=True)
class Reference:
    """f of the infinite line contact on short cells, with its relative standard error; ``strips``: of other
    surfaces."""

    coefficient: float
    error: float


def reference_of(rows: Sequence[dict[str, str]]) -> Reference | None:
    """Return the reference by the ``rows`` of one contact; None where they lack strips, or narrow strips on shorter
    cells.

    The error of the strips is that of their blocks, or that by their scatter where it is larger. That of the narrow
    strips is by their scatter, or by that of all contacts (`NARROW_SCATTER`) where it is larger.
    """
    strips = [row for row in rows if row["kind"] == "strip" and not row["failure"]]
    limits = [1.0 + LIMIT * (float(row["f"]) - 1.0) for row in rows if row["kind"] == "cells" and not row["failure"]]
    if not strips or not limits:
        return None
    f = np.array([float(row["f"]) for row in strips])
    by_blocks = math.sqrt(sum(float(row["error"]) ** 2 for row in strips)) / f.size
    by_scatter = float(f.std(ddof=1)) / math.sqrt(f.size) if f.size > 1 else 0.0
    limit = float(np.mean(limits))
    (share, least) = NARROW_SCATTER
    scatter = max(float(np.std(limits, ddof=1)) if len(limits) > 1 else 0.0, share * abs(limit - 1.0) + least)
    of_cells = scatter / math.sqrt(len(limits)) / limit
    error = math.hypot(max(by_blocks, by_scatter) / float(f.mean()), of_cells)
    return Reference(coefficient=float(f.mean()) * limit, error=error)


@dataclass(frozen=True, kw_only=True)
class Judged:
    """One answer and its reference: the relative ``deviation`` from it, the ``half_width`` of the answer and its part
    by the ``cells``, the reference, and what the answer took: processor time and counted ``work`` [s]."""

    contact: RollingContact
    deviation: float
    half_width: float
    cells: float
    reference: Reference
    seconds: float
    work: float

    @property
    def is_inside(self) -> bool:
        """Whether the answer holds the reference, within its half-width and `OF_REFERENCE` standard errors of the
        reference."""
        return abs(self.deviation) <= math.hypot(self.half_width, OF_REFERENCE * self.reference.error)

    @property
    def is_fast(self) -> bool:
        """Whether its slide-roll ratio is above 1."""
        return abs(self.contact.scene.motion.slide_roll_ratio) > 1.0


def judged_answers(folder: Path = FOLDER) -> Iterator[Judged]:
    """Yield the answers whose contact has a reference, by contact, with the effect of cells by the law of today."""
    references = [row for row in table_file.rows(folder / REFERENCES) if not row["failure"]]
    answers = [row for row in table_file.rows(folder / ANSWERS) if not row["failure"]]
    for name in dict.fromkeys(row["contact"] for row in answers):
        reference = reference_of([row for row in references if row["contact"] == name])
        if reference is None:
            continue
        contact = contact_named(name)
        for row in answers:
            if row["contact"] == name:
                of_sample = student(int(row["freedom"])) * float(row["sampling"])
                cells = cells_of(row).error
                yield Judged(
                    contact=contact,
                    deviation=1 - reference.coefficient / coefficient_of(row),  # over f, as its half-width is
                    half_width=math.hypot(of_sample, cells),
                    cells=cells,
                    reference=reference,
                    seconds=float(row["seconds"]),
                    work=float(row["work"]),
                )


def summary(answers: Sequence[Judged]) -> PlainRow:
    """Return what these ``answers`` say together: how many hold their reference, and their errors and half-widths."""
    deviations = np.array([answer.deviation for answer in answers])
    return {
        "answers": len(answers),
        "inside": sum(answer.is_inside for answer in answers),
        "bias": float(deviations.mean()),
        "error": float(np.sqrt(np.mean(deviations**2))),
        "half_width": float(np.median([answer.half_width for answer in answers])),
        "cells": float(np.median([answer.cells for answer in answers])),
        "reference_error": float(np.median([answer.reference.error for answer in answers])),
        "seconds": float(np.median([answer.seconds for answer in answers])),
        "work": float(np.median([answer.work for answer in answers])),
    }


def covered(folder: Path = FOLDER) -> Iterator[PlainRow]:
    """Yield the `summary` of each group of answers: of each contact with a name, and of the random ones by load and
    sliding."""
    groups: dict[str, list[Judged]] = {}
    for answer in judged_answers(folder):
        name = answer.contact.name
        if name.startswith(RANDOM):
            kind = "heavy" if answer.contact.heavy else "light"
            if answer.is_fast:
                kind = "slide-roll 1 to 2"
            name = f"random, {kind}"
        groups.setdefault(name, []).append(answer)
    for name, answers in groups.items():
        yield {"contact": name, "heavy": answers[0].contact.heavy} | summary(answers)
