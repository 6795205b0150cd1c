"""What else the sampling states: pieces of a map, every other number, the bias of one patch, the cost of an error."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import lubfric
from lubfric.quantities import ESTIMATED

from ..check import AT_LEAST, TOLD, Check, Item, Table
from ..hostile.soak_scenes import random_scene
from ..kept import Run
from ..plotting import axes, finish
from . import SEED
from .coverage import ENDLESS, SPEEDS, chance, solve, truths, within

MAP = (1600, 1600)  # cells
MAPS = {"quick": 1, "default": 2, "full": 6}
PIECES, ASKED = (0.85, 0.99), 0.02  # bounds of the coverage by pieces; their standard error
GENERATED = ("sq", "correlation_length")  # keys that do not go with a file
SCENES = {"quick": 4, "default": 24, "full": 100}
TIGHT, FLOOR, WITHIN = 1e-4, 1e-3, 0.95  # tolerance of the reference; what it may be off by; share asked for
PATCHES = {"quick": 2, "default": 8, "full": 24}
LENGTHS, CELL = (90e-6, 180e-6, 360e-6, 720e-6, 1.44e-3), 1.8e-6
SURFACES = {"quick": 1, "default": 3, "full": 8}


def pieces(level: str, run: Run = Run(), seed: int = SEED, scene: str | None = None, cuts=(2, 2)) -> Iterator[Item]:
    """How often the interval of a piece holds the friction of the map that it was cut from.

    The maps are generated ones, or the measured map of ``scene`` at its entrainment speed.
    """
    if scene:
        maps = [(scene, 0, tuple(cuts))]
    else:
        maps = [("", seed + 90_000 + k, (2, 2)) for k in range(MAPS[level])]
    places = [None, *np.ndindex(*maps[0][2])]
    cases = {f"{one}, piece {place}": (*one, place) for one in maps for place in places}
    rows = [row for _, row in run.solved(cases, piece)]
    covered = []
    for whole, *parts in np.array(rows).reshape(len(maps), len(places)).tolist():
        covered += [part["low"] <= whole["f"] <= part["high"] for part in parts]
    words = "pieces of a map: coverage"
    yield within(words, float(np.mean(covered)), len(covered), PIECES, "the whole map")


def piece(case: tuple) -> dict:
    """A point on one piece of a map, which is written and read again as instrument files are, or (None) on all of
    it."""
    name, seed, cuts, place = case
    if name:
        scene, contact = lubfric.load_scene(name), {}
        rough, speed = scene.surface, scene.motion.entrainment_speed
        whole = lubfric.read_surface(rough.file, spacing=rough.spacing, unit=rough.unit, level=False)
    else:
        scene, contact, speed = lubfric.load_scene("paper"), {"shape": None, "spacing": None}, 0.02
        keys = {"sq": 100e-9, "correlation_length": 8e-6, "acf": "gaussian", "seed": seed}
        whole = lubfric.generate_surface(MAP, 0.45e-6, **keys)
    heights = whole.heights
    if place is not None:
        nx, ny = heights.shape[0] // cuts[0], heights.shape[1] // cuts[1]
        heights = heights[place[0] * nx : (place[0] + 1) * nx, place[1] * ny : (place[1] + 1) * ny]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "piece.npy"
        np.save(file, heights)
        named = {
            "file": str(file),
            "spacing": tuple(whole.spacing),
            "unit": "m",
            "sq": None,
            "correlation_length": None,
        }
        return solve(scene.with_(surface=named, contact=contact), speed, ASKED)


def quantities(level: str, run: Run = Run()) -> Iterator[Item]:
    """Every reported number of random scenes beside the same at a tolerance of 0.01 %: is it within its stated
    error?"""
    found = [row for _, row in run.solved({str(k): k for k in range(SCENES[level])}, beside)]
    rows = []
    for name in ESTIMATED:
        stated = [row[name] for row in found if row and row[name] is not None]
        if stated:
            held = float(np.mean([off <= max(error, FLOOR) for off, error in stated]))
            median = float(np.median([error for _, error in stated]))
            rows.append((f"`{name}`", f"{len(stated)} of {len(found)}", f"{100 * held:.0f} %", f"{100 * median:.2g} %"))
            words = f"{name}: within its stated error in {len(stated)} scenes"
            yield Check(words, held, WITHIN, chance(len(stated)), "the same scene at 0.01 %", AT_LEAST)
    columns = ("quantity", "scenes that state an error", "within it", "median of it")
    yield Table("sampling-numbers", "Every number beside its stated error", columns, rows)


def beside(number: int) -> dict:
    """(relative deviation, stated relative error) of every quantity of a random patch, None where none is stated;
    nothing where the scene is refused."""
    scene = random_scene(np.random.default_rng((11, number))).with_(numerics={"sampling": "patch", "tolerance": 0.01})
    try:
        found = lubfric.friction(scene)
        tight = lubfric.friction(scene.with_(numerics={"tolerance": TIGHT}))
    except lubfric.LubfricError:
        return {}
    row: dict = {}
    for name in ESTIMATED:
        value, reference, error = getattr(found, name), getattr(tight, name), getattr(found.errors, name)
        largest = max(abs(value), abs(reference), 1e-300)
        stated = error is not None and np.isfinite(error)
        row[name] = (abs(value - reference) / largest, error) if stated else None
    return row


def bias(level: str, run: Run = Run(), seed: int = SEED) -> Iterator[Item]:
    """What one patch leaves unsaid: bias and scatter of its f against its length."""
    canvas, axis = axes()
    for case in (SPEEDS[1], SPEEDS[2]):
        truth = truths([case], seed, run)[case.name][0]
        rows = []
        for length in LENGTHS:
            count = max(PATCHES[level], int(PATCHES[level] * 360e-6 / length))
            cases = {
                f"{length} m, {case.speed} m/s, {k}": (length, case.speed, seed + 50_000 + k) for k in range(count)
            }
            f = np.array([f for _, f in run.solved(cases, patch)])
            rows.append((1e3 * length, 100 * (f.mean() / truth - 1), 100 * f.std(ddof=1) / truth, count))
            words = f"{case.name}: bias of f of {count} patches of {1e3 * length:g} mm"
            yield Check(words, f.mean() / truth - 1, 0.0, 0.0, ENDLESS, TOLD)
        length, off, scatter, count = np.array(rows).T
        bars = axis.errorbar(length, off, scatter / np.sqrt(count), marker="o", capsize=3, label=f"bias, {case.name}")
        axis.plot(length, scatter, "--", color=bars[0].get_color(), label=f"scatter, {case.name}")
    axis.axhline(0, color="black", lw=0.8)
    axis.set(xscale="log", xlabel="length of the patch along y (mm)", ylabel="bias and scatter of f (% of f∞)")
    axis.legend()
    yield finish("bias", canvas, "Bias and scatter of f of one patch against its length", "png")


def patch(case: tuple[float, float, int]) -> float:
    """f of one patch of a length [m] at a speed [m/s]."""
    length, speed, seed = case
    contact = {"shape": (50, 4 * round(length / (4 * CELL))), "spacing": CELL}
    numerics = {"sampling": "patch", "grid": "given"}
    scene = lubfric.load_scene("paper").with_(surface={"seed": seed}, contact=contact, numerics=numerics)
    return lubfric.friction(scene, speed).coefficient


def cost(level: str, run: Run = Run(), seed: int = SEED) -> Iterator[Item]:
    """Processor seconds for every standard error asked, and the error of f that was really made."""
    canvas, axis = axes()
    for case in SPEEDS[1:]:
        truth = truths([case], seed, run)[case.name][0]
        rows = []
        for asked in (0.05, 0.02, 0.01):
            cases = {f"{case.name}, {asked}, {k}": (case, seed + 61_000 + k, asked) for k in range(SURFACES[level])}
            made = [row for _, row in run.solved(cases, asked_for)]
            error = np.sqrt(np.mean([(m["f"] / truth - 1) ** 2 for m in made]))
            rows.append((asked, np.mean([m["seconds"] for m in made]), error))
            words = f"{case.name}: rms error of f, asked {100 * asked:g} %"
            yield Check(words, error, asked, 0.0, ENDLESS, TOLD)
        wanted, seconds, errors = np.array(rows).T
        axis.loglog(100 * errors, seconds, "o-", label=case.name)
        for error in np.unique(errors):  # where the first line does for several of what was asked, one label for all
            words = " and ".join(f"{100 * a:g} %" for a in wanted[errors == error])
            at = 100 * error, seconds[errors == error].max()
            axis.annotate(words, at, xytext=(4, 4), textcoords="offset points", fontsize=8)
    axis.set(xlabel="root mean square error of f, surface included (%); labels: asked", ylabel="processor time (s)")
    axis.legend()
    yield finish("cost", canvas, "Processor time against the error of f", "png")


def asked_for(case: tuple) -> dict:
    """One point at the standard error asked for."""
    case_, seed, asked = case
    return solve(case_.scene(seed), case_.speed, asked)
