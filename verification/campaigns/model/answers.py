"""The default answer, and the fast answer by load sharing alone, on surfaces, loads and fluids of many kinds: how
often the interval contains f of an infinite line contact.

The reference of a case is solved once, and several answers, each on another surface, are compared with it: the
deterministic model on strips of another seed (of a measured map: on all of it), with about half of the target errors.
"""

import itertools
import math
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import lubfric
from lubfric.scene import Roughness, Scene

from ...check import ABSOLUTE, REPORTED, Check, Figure, Item, Table
from ...fem.parts import halved
from ...kept import Run
from ...plotting import Curve, chart
from ...types import FloatArray, Keywords, Option, PlainRow

SEED = 884  # so that the first few differ in surface and load
DRAWN = {"quick": 2, "default": 6, "full": 24}  # combinations, drawn from all; of rollers a third of them
RATIOS = {"quick": (1.5,), "default": (1.5, 0.8, 0.3)}  # Moes' film over Sq; "full" has those of "default"
SEEDS = {"quick": 1, "default": 4, "full": 4}  # answers on generated surfaces; of a measured map there is one
REFERENCE = 1001  # seed
ASKED = {"tolerance": 0.01, "sampling_tolerance": 0.012, "model_tolerance": 0.03}  # of the reference
CELLS = (640, 448)  # of a map from a file
CELL = 1.8e-6  # m, their length
LENGTH = 8e-6  # m, correlation length of the Gaussian surface, which other lengths are given over
ROLLER = "roller, 1 GPa"
CONTACTS = {  # changes of the built-in scene, and the lengths of the surface over those of its own
    "5.5 N": ({}, 1.0),
    "27.5 N": ({"bodies": {"load": 27.5}}, 1.0),
    "110 N": ({"bodies": {"load": 110.0}}, 1.0),
    ROLLER: (
        {
            "bodies": {"radius": 6e-3, "width": 0.01, "load": 1600.0, "boundary_friction_coefficient": 0.12},
            "lubricant": {"viscosity": 0.02, "pressure_viscosity_coefficient": 1.8e-8, "eyring_stress": 5e6},
            "surface": {"sq": 150e-9},
        },
        1.25,
    ),
}
GENERATED = {
    "Gaussian": ("gaussian", (8e-6, 8e-6)),
    "exponential": ("exponential", (8e-6, 8e-6)),
    "ridges across": ("gaussian", (4e-6, 40e-6)),
    "ridges along": ("gaussian", (40e-6, 4e-6)),
}
MEASURED = ("ridges at 45 degrees", "plateau", "peaks", "self-affine")
COLUMNS = ("", "answers", "error", "interval", "inside", "paper: error", "interval ", "inside ")
WAYS = {"default": {}, "load sharing": {"model": "paper"}}


@dataclass(frozen=True, kw_only=True)
class AnswerCase:
    """A kind of surface under a contact with ``over`` = f_b over the limit of the oil, at a film/Sq; the
    roughness rests."""

    surface: str
    contact: str
    over: float
    ratio: float

    def scene(self, seed: int, folder: str, **numerics: Option) -> Scene:
        """Return the scene with a surface of its own ``seed``; maps are written to ``folder``."""
        changes, times = CONTACTS[self.contact]
        scene = lubfric.load_scene("paper").with_(**changes)
        limit = scene.bodies.boundary_friction_coefficient / self.over
        oil = {"limiting_stress_coefficient": limit, "density_law": "dowson-higginson"}
        rough: Keywords | Roughness
        if self.surface in GENERATED:
            acf, lengths = GENERATED[self.surface]
            rough = {"acf": acf, "correlation_length": tuple(times * length for length in lengths), "seed": seed}
            rough["oversize"] = 1 if lengths[0] < 20e-6 else 3  # ridges along are longer than a light contact
            patch: Keywords = {"spacing": 0.45e-6 * times}
        else:
            path = Path(folder) / f"{self.surface}-{seed}.npy"
            np.save(path, heights(self.surface, seed) * scene.surface.sq)
            rough = Roughness(file=str(path), spacing=CELL * times)
            patch = {"shape": None, "spacing": None}
        keys = {"accept": True, "film_deflection": "scaled"} | numerics
        film = {"boundary_film": 20e-9}  # given, so that both answers have it and the interval leaves it out
        motion = {"slide_roll_ratio": 2.0}
        return scene.with_(bodies=film, lubricant=oil, surface=rough, contact=patch, motion=motion, numerics=keys)

    def speed(self, scene: Scene) -> float:
        """Return the speed [m/s] at which Moes' film under the total load is the given number of Sq."""
        sq = CONTACTS[self.contact][0].get("surface", {}).get("sq", 100e-9)
        return halved(1e-7, 1e3, lambda u: scene.line_contact(u).moes_film < self.ratio * sq)


def heights(kind: str, seed: int) -> np.ndarray:
    """Return a map of this ``kind``, with a standard deviation of 1, from its spectrum."""
    qx, qy = np.meshgrid(*(2 * np.pi * np.fft.fftfreq(n, CELL) for n in CELLS), indexing="ij")
    rng = np.random.default_rng(seed)

    def drawn(root: FloatArray) -> np.ndarray:
        z = np.fft.ifft2(np.fft.fft2(rng.standard_normal(CELLS)) * root).real
        return (z - z.mean()) / z.std()

    if kind == "self-affine":
        return drawn((1 + (np.hypot(qx, qy) * 20e-6) ** 2) ** -0.9)  # Hurst exponent .8
    if kind == "ridges at 45 degrees":
        along = (qx + qy) / math.sqrt(2)
        across = (qx - qy) / math.sqrt(2)
        return drawn(np.exp(-((along * 20e-6) ** 2 + (across * 4e-6) ** 2) / 8))
    smooth = np.hypot(qx, qy) ** 2 * LENGTH**2 / 8
    z = np.minimum(drawn(np.exp(-smooth)), 0.3) + 0.1 * drawn(np.exp(-smooth / 4))
    z = (z - z.mean()) / z.std()
    return z if kind == "plateau" else -z


def cases(level: str, *, rollers: bool) -> dict[str, AnswerCase]:
    """The combinations of ``level`` by name, the same first ones at every level: the lighter contacts, or rollers."""
    contacts = [name for name in CONTACTS if (name == ROLLER) == rollers]
    kinds = list(itertools.product((*GENERATED, *MEASURED), contacts, (1.0, 2.0)))
    order = np.random.default_rng(SEED).permutation(len(kinds))[: max(1, DRAWN[level] // (3 if rollers else 1))]
    every = [
        AnswerCase(surface=kinds[index][0], contact=kinds[index][1], over=kinds[index][2], ratio=ratio)
        for index in order.tolist()
        for ratio in RATIOS.get(level, RATIOS["default"])
    ]
    return {f"{c.surface}; {c.contact}; {c.over:g}; {c.ratio:g}": c for c in every}


def reference(case: AnswerCase) -> PlainRow:
    """Return f of the endless line, and its error."""
    return solved(case, 1 if case.surface in MEASURED else REFERENCE, {"model": "deterministic"} | ASKED)


def answer(case_and_seed: tuple[AnswerCase, int]) -> dict[str, PlainRow]:
    """Return f and its interval on one surface, both ways."""
    case, seed = case_and_seed
    return {way: solved(case, seed, numerics) for way, numerics in WAYS.items()}


def solved(case: AnswerCase, seed: int, numerics: Keywords) -> PlainRow:
    """Return one point: f, half of its interval and its standard error, all relative; or why there is none."""
    begun = time.process_time()
    with tempfile.TemporaryDirectory() as folder:
        scene = case.scene(seed, folder, **numerics)
        try:
            point = lubfric.friction(scene, case.speed(scene))
        except lubfric.LubfricError as error:
            return {"failure": f"{type(error).__name__}: {error}"[:200]}
    known = point.uncertainty
    f = point.coefficient
    row = {"f": f, "low": known.interval[0], "high": known.interval[1], "by": point.decision.model}
    return row | {"error": math.hypot(known.numerical, known.sampling), "seconds": time.process_time() - begun}


def answers(level: str, run: Run = Run(), *, rollers: bool = False) -> Iterator[Item]:
    """Every case by default, by load sharing alone, and by the reference: errors, intervals and coverage."""
    values = []
    failed = 0
    for case, truth in run.solved(cases(level, rollers=rollers), reference, "references"):
        seeds = range(1, 2 if case.surface in MEASURED else 1 + SEEDS[level])
        for _, row in run.solved({f"{case}, {seed}": (case, seed) for seed in seeds}, answer, "answers"):
            failed += "failure" in row["default"]
            if truth.get("error") and all(row[way].get("low") is not None for way in WAYS):
                values.append(((case.surface, case.contact), [interval_error(row[way], truth) for way in WAYS]))
    yield from compared("answers-rollers" if rollers else "answers", values, failed, "finer strips")


def compared(
    name: str, result: list[tuple[tuple[str, str], list[tuple[float, float, float]]]], failed: int, source: str
) -> Iterator[Item]:
    """Table, checks and picture of answers ``result``: the groups of each, and by both ways what is
    `interval_error`."""
    every = {way: np.array([sides[k] for _, sides in result]).reshape(-1, 3) for k, way in enumerate(WAYS)}
    all_names = dict.fromkeys(itertools.chain(*zip(*(groups for groups, _ in result))))
    # without those of loads, which differ less than surfaces
    names = [name for name in all_names if name != ROLLER and not name.endswith(" N")]
    rows = [
        [group, str(sum(here)), *summary(every["default"][here]), *summary(every["load sharing"][here])]
        for group in (*names, "all")
        if any(here := [group in (*groups, "all") for groups, _ in result])
    ]
    yield Table(name, f"The default answer, and load sharing alone, compared with {source}", COLUMNS, rows)
    for way, label in (("default", "default answer"), ("load sharing", "load sharing alone")):
        inside = float(np.mean(every[way][:, 1] <= every[way][:, 2])) if result else math.nan
        yield Check(
            f"{label}: share of {len(result)} intervals with f",
            inside,
            expected=1.0,
            tolerance=0.1,
            source=source,
            kind=ABSOLUTE,
        )
    yield Check(
        "default answers that failed, or gave moving roughness to load sharing",
        failed,
        expected=0,
        tolerance=0.0,
        source="the answers",
        kind=REPORTED,
    )
    yield drawn(name, every)


def interval_error(row: PlainRow, truth: PlainRow) -> tuple[float, float, float]:
    """Return half of the interval; by how much f is off; and how much of that its interval on this side and twice the
    error of the reference allow; all relative to the reference."""
    f = row["f"]
    t = truth["f"]
    side = f - row["low"] if f > t else row["high"] - f
    return (row["high"] - row["low"]) / (2 * t), abs(f / t - 1), math.hypot(side / t, 2 * truth["error"])


def summary(values: np.ndarray) -> list[str]:
    """Return the root mean square error, the mean half of the interval, and the share of intervals that hold f."""
    half, off, allowed = values.T
    errors = math.sqrt(np.mean(off**2)), half.mean()
    return [*(f"{100 * error:.1f} %" for error in errors), f"{100 * (off <= allowed).mean():.0f} %"]


def drawn(name: str, every: dict[str, np.ndarray]) -> Figure:
    """Return the error of f over what its interval allows, for both ways."""
    curves: list[Curve] = [([1, 100], [1, 100], "k-", "allowed")]
    for way, label in (("load sharing", "load sharing alone"), ("default", "default answer")):
        curves.append((*100 * np.maximum(every[way][:, [2, 1]].T, 1e-4), "o", label))
    caption = "Error of f over what its interval allows; below the line it is covered"
    labels: Keywords = {"xlabel": "stated error of interval and reference (%)", "ylabel": "error of f (%)"}
    return chart(name, caption, curves, xscale="log", yscale="log", **labels)
