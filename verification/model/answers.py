"""The answer that a user gets without asking for anything, and the fast one by load sharing alone, on surfaces, loads
and fluids of many kinds: how often f of the endless line lies within the interval.

The reference is the deterministic model on strips of another seed (of a measured map: on all of it), on smaller cells,
with about half of the errors asked.
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
from lubfric.scene import Roughness

from ..check import ABSOLUTE, TOLD, Check, Figure, Item, Table
from ..kept import Run
from ..plotting import finish, panels

SEED = 32
DRAWN = {"quick": 2, "default": 8, "full": 32}  # combinations, drawn from all
RATIOS = (3.0, 1.5, 0.8, 0.4, 0.2, 0.1)  # Moes' film of the whole load over Sq
QUICK = (1.5,)
ASKED = {"tolerance": 0.01, "sampling_tolerance": 0.012, "model_tolerance": 0.03}  # of the reference
CELLS, CELL = (640, 448), 1.8e-6  # of a map from a file, and their length [m] over that of the Gaussian correlation
LENGTH = 8e-6
CONTACTS = {  # changes of the built-in scene, and the lengths of the surface over those of its own
    "5.5 N": ({}, 1.0),
    "27.5 N": ({"bodies": {"load": 27.5}}, 1.0),
    "110 N": ({"bodies": {"load": 110.0}}, 1.0),
    "roller, 1 GPa": (
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
COLUMNS = (
    "surface",
    "contact",
    "f_b/limit",
    "film/Sq",
    "f",
    "default off by",
    "interval",
    "Eq. (8) off by",
    "interval ",
)


@dataclass(frozen=True)
class Case:
    """A kind of surface under a contact with ``over`` = f_b over the limit of the oil, at a film/Sq."""

    surface: str
    contact: str
    over: float
    ratio: float

    def scene(self, seed: int, folder: str, **numerics):
        """The scene with a surface of its own ``seed``; maps are written to ``folder``."""
        changes, times = CONTACTS[self.contact]
        scene = lubfric.load_scene("paper").with_(**changes)
        limit = scene.bodies.boundary_friction_coefficient / self.over
        oil = {"limiting_stress_coefficient": limit, "density_law": "dowson-higginson"}
        rough: dict | Roughness
        if self.surface in GENERATED:
            acf, lengths = GENERATED[self.surface]
            rough = {"acf": acf, "correlation_length": tuple(times * one for one in lengths), "seed": seed}
            patch: dict = {"spacing": 0.45e-6 * times}
        else:
            path = Path(folder) / f"{self.surface}-{seed}.npy"
            np.save(path, heights(self.surface, seed) * scene.surface.sq)
            rough = Roughness(file=str(path), spacing=CELL * times)
            patch = {"shape": None, "spacing": None}
        keys = {"accept": True, "film_deflection": "scaled"} | numerics
        film = {"boundary_film": 20e-9}  # given, so that both answers have it and the interval leaves it out
        return scene.with_(bodies=film, lubricant=oil, surface=rough, contact=patch, numerics=keys)

    def speed(self, scene) -> float:
        """Speed [m/s] at which Moes' film of the whole load is so many Sq."""
        low, high, sq = 1e-7, 1e3, CONTACTS[self.contact][0].get("surface", {}).get("sq", 100e-9)
        for _ in range(60):
            middle = math.sqrt(low * high)
            thin = scene.line_contact(middle).moes_film < self.ratio * sq
            low, high = (middle, high) if thin else (low, middle)
        return low


def heights(kind: str, seed: int) -> np.ndarray:
    """A map of this ``kind``, with a standard deviation of 1, from its spectrum."""
    qx, qy = np.meshgrid(*(2 * np.pi * np.fft.fftfreq(n, CELL) for n in CELLS), indexing="ij")
    rng = np.random.default_rng(seed)

    def drawn(root) -> np.ndarray:
        z = np.fft.ifft2(np.fft.fft2(rng.standard_normal(CELLS)) * root).real
        return (z - z.mean()) / z.std()

    if kind == "self-affine":
        return drawn((1 + (np.hypot(qx, qy) * 20e-6) ** 2) ** -0.9)  # Hurst exponent .8
    if kind == "ridges at 45 degrees":
        along, across = (qx + qy) / math.sqrt(2), (qx - qy) / math.sqrt(2)
        return drawn(np.exp(-((along * 20e-6) ** 2 + (across * 4e-6) ** 2) / 8))
    smooth = np.hypot(qx, qy) ** 2 * LENGTH**2 / 8
    z = np.minimum(drawn(np.exp(-smooth)), 0.3) + 0.1 * drawn(np.exp(-smooth / 4))
    z = (z - z.mean()) / z.std()
    return z if kind == "plateau" else -z


def cases(level: str) -> dict[str, Case]:
    """The combinations of ``level`` by name, the same first ones at every level."""
    kinds = list(itertools.product((*GENERATED, *MEASURED), CONTACTS, (1.0, 2.0)))
    order = np.random.default_rng(SEED).permutation(len(kinds))[: DRAWN[level]]
    ratios = QUICK if level == "quick" else RATIOS
    every = [Case(*kinds[int(index)], ratio) for index in order for ratio in ratios]
    return {f"{c.surface}; {c.contact}; {c.over:g}; {c.ratio:g}": c for c in every}


def solve(case: Case) -> dict:
    """f and its interval, by default and by load sharing, and f of the reference with its error."""
    row: dict = {}
    with tempfile.TemporaryDirectory() as folder:
        seed, other = 1, 1 if case.surface in MEASURED else 1001
        ways = {"default": (seed, {}), "eq8": (seed, {"model": "load-sharing"})}
        for name, (one, numerics) in (ways | {"reference": (other, {"model": "deterministic"} | ASKED)}).items():
            scene, begun = case.scene(one, folder, **numerics), time.process_time()
            try:
                found = lubfric.friction(scene, case.speed(scene))
            except lubfric.LubfricError as error:
                row |= {f"{name}_failure": f"{type(error).__name__}: {error}"[:200]}
                continue
            known, f = found.uncertainty, found.coefficient
            half = 0.5 * (known.interval[1] - known.interval[0]) / f
            share = found.contact_load / scene.bodies.load
            row |= {f"{name}_f": f, f"{name}_half": half, f"{name}_model": known.model, f"{name}_share": share}
            row |= {f"{name}_error": math.hypot(known.numerical, known.sampling)}
            row |= {f"{name}_by": found.decision.model, f"{name}_seconds": time.process_time() - begun}
    return row


def answers(level: str, run: Run = Run()) -> Iterator[Item]:
    """Every case by default, by load sharing alone, and by the reference: errors, intervals and coverage."""
    solved = list(run.solved(cases(level), solve))
    rows: list = []
    off: dict[str, list] = {"default": [], "eq8": []}
    for case, row in solved:
        truth = row.get("reference_f")
        cells = [case.surface, case.contact, f"{case.over:g}", f"{case.ratio:g}", f"{truth:.4f}" if truth else "-"]
        for way in off:
            f, half = row.get(f"{way}_f"), row.get(f"{way}_half")
            known = truth and f and half is not None
            if known:
                off[way].append((f / truth - 1, math.hypot(half, 2 * row["reference_error"] or 0.0)))
            cells += [f"{100 * (f / truth - 1):+.1f} %", f"{100 * half:.1f} %"] if known else ["-", "-"]
        rows.append(cells)
    yield Table("answers", "The default answer, and load sharing alone, beside finer strips", COLUMNS, rows)
    for way, name in (("default", "default answer"), ("eq8", "load sharing alone")):
        both = np.array(off[way]).reshape(-1, 2)
        covered = float(np.mean(np.abs(both[:, 0]) <= both[:, 1])) if both.size else math.nan
        yield Check(f"{name}: share of {len(both)} intervals with f", covered, 1.0, 0.15, "finer strips", ABSOLUTE)
    failed = sum("default_failure" in row for _, row in solved)
    yield Check("default answers that failed", failed, 0, 0.0, "the solver's own report", TOLD)
    yield drawn(off)


def drawn(off: dict[str, list]) -> Figure:
    """The error of f over the half-width of the interval, for both ways."""
    figure, (axes,) = panels(1, 1, 6.0, 4.5)
    for way, label in (("eq8", "load sharing alone"), ("default", "default answer")):
        both = 100 * np.array(off[way]).reshape(-1, 2)
        axes.plot(both[:, 1], both[:, 0], "o", label=label, alpha=0.7)
    most = max(1.0, *(100 * abs(value) for pairs in off.values() for pair in pairs for value in pair))
    axes.plot([0, most, 0, most], [0, most, 0, -most], "k-", lw=0.8)
    axes.set(xlabel="half of the interval (%)", ylabel="f off by (%)")
    axes.legend()
    return finish("answers", figure, "Error of f and half of its interval; between the lines it is covered")
