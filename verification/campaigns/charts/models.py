"""The chart of the models: error of f against time on four kinds of surface, for load sharing by Eqs. (8) and (9) and
for the quick model, for the deterministic model on long cells, and for the default, which is the deterministic model on
levels of cells here.

An error is the root mean square over surfaces of other seeds. A map has one sample only, which the reference also uses.
"""

from functools import cache

import numpy as np

from ...types import Keywords, PlainRow
from ..model.answers import MEASURED, AnswerCase, reference, solved
from .measure import point, quartiles

SURFACES = "Gaussian", "exponential", "ridges along", "plateau"
SEEDS = {True: (1,), False: (1, 2)}
WAYS: dict[str, Keywords] = {
    'load sharing ("paper")': {"model": "paper"},
    "quick model": {"model": "quick"},
    "deterministic, long cells": {"model": "deterministic", "tolerance": 0.1},
    "default": {},
}
ASKED = {True: ((0.02, 0.05),), False: ((0.05, 0.1), (0.02, 0.05))}  # of surface and model


reference_once = cache(reference)


def cases(*, quick: bool) -> dict[str, tuple[AnswerCase, str, bool]]:
    """Return a panel for each surface, under the light load at a smooth film of 0.8 Sq, with a curve for each way."""
    surfaces = [
        AnswerCase(surface=name, contact="5.5 N", over=2.0, ratio=0.8) for name in SURFACES[: 1 if quick else None]
    ]
    return {f"{case.surface}, {way}": (case, way, quick) for case in surfaces for way in WAYS}


def measured(chosen: tuple[AnswerCase, str, bool]) -> list[PlainRow]:
    """Return one way at every setting, against the deterministic model on another surface, or on all of the map."""
    (case, way, quick) = chosen
    values = []
    truth = reference_once(case)["f"]
    one_map = case.surface in MEASURED
    seeds = (1,) if one_map else SEEDS[quick]
    for sampling, model in ASKED[quick]:
        numerics = {"sampling_tolerance": sampling, "model_tolerance": model} | WAYS[way]
        rows = [row for row in (solved(case, seed, numerics) for seed in seeds) if "failure" not in row]
        if rows:
            off = float(np.sqrt(np.mean([(row["f"] / truth - 1) ** 2 for row in rows])))
            at = {"default": way == "default" and sampling == 0.02, "apart": True}
            seconds = quartiles([row["seconds"] for row in rows])
            values.append(point(case.surface, way, f"surface {sampling:g}, model {model:g}", off, seconds, **at))
    return values
