"""The default answer of light contacts whose roughness moves: how often f of the endless line lies within the interval.

That f is the mean of the other answers of a case, times what shorter cells change: half as long along x, on surfaces
that balance the load each by itself, extrapolated by second order.
"""

import itertools
import math
from collections.abc import Iterator

import numpy as np

import lubfric
from lubfric.models.deterministic import RoughBody, solve_moving_strip

from ...check import Item
from ...kept import Run
from .answers import LENGTH, WAYS, AnswerCase, answer, compared, interval_error

CONTACTS = {"5.5 N": 2.0, "110 N": 3.0}  # how many times as long their surface is, so that a strip takes seconds
# Moes' film over Sq; slide-roll ratios: surface 1 is rough
RATIOS = (1.5, 0.5)
SLIPS = (0.5, -1.0)
SEEDS = {"quick": 3, "default": 3, "full": 6}  # answers of a case
# seeds of the surfaces that tell the change, and their cells
CHANGES = range(7001, 7003)
SHAPE = (108, 96)
FINE = 160 / 18, 40 / 18  # of these in a correlation length: along x twice those of an answer


def cases(level: str) -> list[AnswerCase]:
    """The cases of ``level``."""
    every = itertools.product(CONTACTS.items(), RATIOS, SLIPS)
    values = [
        AnswerCase(surface="Gaussian", contact=contact, over=1.0, ratio=ratio, slip=slip, longer=times)
        for (contact, times), ratio, slip in every
    ]
    return values[-1:] if level == "quick" else values


def change(case_and_seed: tuple[AnswerCase, int]) -> float:
    """Relative change of f from the cells of an answer to endlessly short ones, on one surface."""
    case, seed = case_and_seed
    scene = case.scene(seed, "")
    length = LENGTH * case.longer
    cells = (length / FINE[0], length / FINE[1])
    z = scene.surface
    surface = lubfric.generate_surface(SHAPE, cells, seed=seed, sq=z.sq, acf=z.acf, correlation_length=length)
    speed = case.speed(scene)
    bodies = [RoughBody(surface, speed * (1 - case.slip / 2))]
    coarse, fine = (solve_moving_strip(scene, bodies, speed, factors=(n, 1)).result.coefficient for n in (2, 1))
    return 4 / 3 * (fine / coarse - 1)


def answers_moving(level: str, run: Run = Run()) -> Iterator[Item]:
    """Compare every answer by the moving model, and by load sharing alone, with the mean of the other answers of its
    case, extrapolated to infinitely short cells."""
    values = []
    left = 0
    for case in cases(level):
        changes = [row for _, row in run.solved({f"{case}, {k}": (case, k) for k in CHANGES}, change, "changes")]
        seeds = {f"{case}, {seed}": (case, seed) for seed in range(1, 1 + SEEDS[level])}
        rows = [row for _, row in run.solved(seeds, answer, "answers")]
        fine = [row for row in rows if row["default"].get("by") == "deterministic"]
        left += len(rows) - len(fine)
        for row in fine if len(fine) > 2 and changes else ():
            f = np.array([other["default"]["f"] for other in fine if other is not row])
            error = math.hypot(*(np.std(v) / math.sqrt(max(len(v) - 1, 1)) for v in (f / f.mean(), changes)))
            truth = {"f": f.mean() * (1 + np.mean(changes)), "error": error}
            groups = case.contact, f"film of {case.ratio:g} Sq", f"slide-roll ratio {case.slip:g}"
            values.append((groups, [interval_error(row[way], truth) for way in WAYS]))
    yield from compared("answers-moving", values, left, "the other answers on shorter cells")
