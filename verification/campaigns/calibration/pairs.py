"""Pairs of similar contacts: how the errors of the cheap models change from one design to another.

A pair is a case of the table and the same case with one input changed, on the same map. The error of ln f of both, by
the quick model and by load sharing, is that against the deterministic model.
"""

import math
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

import lubfric
from lubfric.models.quick import error_models
from lubfric.studies import COMPARED_DISTANCE, CORRELATION_OF_DESIGNS
from lubfric.surface import Surface

from ...check import AT_LEAST, REPORTED, Check, Item
from ...kept import Run
from ...types import PlainRow
from .. import table_file
from .case import Case
from .case import drawn as drawn_case
from .features import PER_LENGTH, quick
from .fit import MOTIONS, Solved, cases, solved_case
from .solve import deterministic, limited, load_sharing
from .table import DIGITS, TABLES

PAIRS = TABLES / "pairs.csv"

# Inputs that are changed, one in each pair.
KEYS = ("sq", "viscosity", "radius", "length", "friction")

# Factors on them, up to that of `COMPARED_DISTANCE`.
FACTORS = (0.7, 1.4, 0.5, 2.0)

# Seed of the order in which the cases of a motion are taken.
ORDER_SEED = 7

# Processor time [s] of a pair, at most.
LONGEST_PAIR = 60.0

# Share of the differences that shall be within their error.
LEAST = 0.92

COLUMNS = (
    *("motion", "number", "seed", "key", "factor", "quick_error", "quick_half_width", "quick_other_error"),
    *("quick_other_half_width", "paper_error", "paper_half_width", "paper_other_error", "paper_other_half_width"),
    *("seconds", "failure"),
)


@dataclass(frozen=True, kw_only=True)
class ErrorOfModel:
    """The ``error`` of ln f of a model, without its mean, and the ``half_width`` that is stated of it at 95 %."""

    error: float
    half_width: float


def changed(case: Case, key: str, factor: float) -> Case:
    """Return ``case`` with the input ``key`` times a ``factor``."""
    facts = dict(case.facts)
    scene = case.scene
    if key == "sq":
        facts["sq"] *= factor
        return replace(case, bodies=_with_maps(case, 1.0, factor), facts=facts)
    if key == "length":
        facts |= {name: factor * facts[name] for name in ("length_x", "length_y", "dx", "dy")}
        return replace(case, bodies=_with_maps(case, factor, 1.0), facts=facts)
    if key == "viscosity":
        viscosity = factor * scene.lubricant.viscosity
        return replace(case, scene=scene.with_(lubricant={"viscosity": viscosity}))
    if key == "friction":
        facts["friction"] *= factor
        friction = {"boundary_friction_coefficient": facts["friction"]}
        return replace(case, scene=scene.with_(bodies=friction), facts=facts)
    bodies = scene.bodies
    facts["radius"] = factor * bodies.radius
    facts["pressure"] = math.sqrt(bodies.load / bodies.width * bodies.e_prime / (2 * math.pi * facts["radius"]))
    scene = scene.with_(bodies={"radius": facts["radius"], "hertz_pressure": facts["pressure"]})
    return replace(case, scene=scene, facts=facts)


def _with_maps(case: Case, by_length: float, by_height: float) -> tuple[lubfric.models.deterministic.RoughBody, ...]:
    """Return the rough bodies of ``case`` with maps that are so much longer and higher."""
    bodies = []
    for body in case.bodies:
        (dx, dy) = body.surface.spacing
        heights = by_height * body.surface.heights
        surface = Surface(heights, (by_length * dx, by_length * dy), periodic_axes=(True, True))
        bodies.append(body._replace(surface=surface))
    return tuple(bodies)


def of_quick(motion: str, solved: Solved) -> ErrorOfModel:
    """Return the error of the quick model of a ``solved`` case, by the error model of today."""
    model = error_models()[motion]
    known = solved.features
    return ErrorOfModel(error=solved.error - model.bias_at(known), half_width=model.log_half_width(known))


def of_paper(det_f: float, ls_f: float, ls_model: float) -> ErrorOfModel:
    """Return the error of load sharing by both f and the model-form error that it states."""
    return ErrorOfModel(error=math.log(det_f / ls_f), half_width=ls_model)


def pair(motion: str, number: int) -> PlainRow:
    """Return the row of pair ``number`` of a ``motion``."""
    known = {int(case.row["seed"]): case for case in cases(motion) if case.row["repeat"] == "0"}
    seed = int(np.random.default_rng(ORDER_SEED).permutation(sorted(known))[number])
    key = KEYS[number % len(KEYS)]
    factor = FACTORS[number // len(KEYS) % len(FACTORS)]
    row: PlainRow = {"motion": motion, "number": number, "seed": seed, "key": key, "factor": factor, "failure": ""}
    first = known[seed]
    (det_f, ls_f, ls_model) = (float(first.row[name]) for name in ("det_f", "ls_f", "ls_model"))
    row |= _columns("quick", of_quick(motion, first)) | _columns("paper", of_paper(det_f, ls_f, ls_model))
    begun = time.process_time()
    try:
        with limited(LONGEST_PAIR):
            row |= _of_changed(changed(drawn_case(motion, seed), key, factor), motion)
    except (lubfric.LubfricError, FloatingPointError) as error:
        row["failure"] = f"{type(error).__name__}: {error}".replace("\n", " ")[:160]
    return row | {"seconds": time.process_time() - begun}


def _of_changed(case: Case, motion: str) -> PlainRow:
    """Return the errors of both models of the changed ``case``."""
    by_load_sharing = load_sharing(case)
    reference = deterministic(case)
    numbers = {f"ls_{name}": value for name, value in by_load_sharing.items()}
    numbers |= {f"det_{name}": value for name, value in reference.items()}
    row = {name: str(value) for name, value in (case.facts | numbers | {"failure": ""}).items()}
    on_long_cells = [{"per_length": cells} | quick(case, cells) for cells in PER_LENGTH[motion]]
    solved = solved_case(row, on_long_cells)
    if solved is None:
        raise lubfric.ConvergenceError("no sliding part of f on long cells")
    of_load_sharing = of_paper(reference["f"], by_load_sharing["f"], by_load_sharing["model"])
    return _columns("quick_other", of_quick(motion, solved)) | _columns("paper_other", of_load_sharing)


def _columns(name: str, error: ErrorOfModel) -> PlainRow:
    return {f"{name}_error": error.error, f"{name}_half_width": error.half_width}


def extend(motion: str, count: int, budget: float, file: Path = PAIRS) -> Iterator[PlainRow]:
    """Solve the first so many (``count``) pairs of a ``motion`` that the table in ``file`` has not, as long as the time
    of this process is below ``budget`` [s], and append each."""
    known = {int(row["number"]) for row in table_file.rows(file) if row["motion"] == motion}
    for number in range(count):
        if number in known:
            continue
        if time.process_time() > budget:
            return
        row = pair(motion, number)
        table_file.append(file, COLUMNS, row, DIGITS)
        yield row


def share_within(rows: list[dict[str, str]], model: str, correlation: float) -> float:
    """Return the share of the pairs in ``rows`` whose difference of the errors of ln f by a ``model`` is within the
    error that both half-widths and a ``correlation`` give it."""
    names = ("error", "half_width", "other_error", "other_half_width")
    (one, width, other, other_width) = np.array([[float(row[f"{model}_{name}"]) for name in names] for row in rows]).T
    of_difference = np.sqrt(width**2 + other_width**2 - 2.0 * correlation * width * other_width)
    return float(np.mean(np.abs(other - one) <= of_difference))


def coverage(level: str, run: Run = Run()) -> Iterator[Item]:
    """Yield for each motion and model the share of the pairs whose difference is within its error, with the correlation
    that a study takes, and with none."""
    assert max(FACTORS) == math.exp(COMPARED_DISTANCE)
    for motion in MOTIONS:
        rows = [row for row in table_file.rows(PAIRS) if row["motion"] == motion and not row["failure"]]
        for model in ("quick", "paper"):
            name = f"{len(rows)} pairs of designs, {motion}, model {model}: differences within their error"
            share = share_within(rows, model, CORRELATION_OF_DESIGNS)
            yield Check(name, share, expected=LEAST, tolerance=0.0, source="the deterministic model", kind=AT_LEAST)
            plain = share_within(rows, model, 0.0)
            yield Check(
                f"{name}, if they were independent",
                plain,
                expected=1.0,
                tolerance=0.0,
                source="the deterministic model",
                kind=REPORTED,
            )
