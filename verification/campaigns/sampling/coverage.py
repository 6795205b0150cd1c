"""Trials of the built-in scene at four speeds and of other surfaces and loads, each on another surface, compared with
the friction of an infinite line contact.

That friction comes from plain balances of patches 1,900 correlation lengths long, without the corrections of the
library. At this length the bias of a patch is below 0.1 %. Their cells are a quarter of the correlation length. The
effect of these cells is computed on shorter patches, on the scene's own cells and on a part of them.
"""

import math
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.special import stdtrit

import lubfric
from lubfric.scene import Scene
from lubfric.surface import Surface

from ...check import ABSOLUTE, Check, Figure, Item, Table
from ...kept import Run
from ...plotting import finish, panels
from ...types import Keywords, PlainRow
from . import SEED

TRIALS = {"quick": 16, "default": 60, "full": 400}
OTHERS = 200  # trials of other surfaces and loads, at most
REPORTED = 1_000_000  # seeds of the truth begin so far behind those of the trials
PATCHES = 160  # of the reference, at most
FEWEST = 16  # patches of the reference, at least
CLOSE = 0.1  # standard error of the reference over the target
LENGTHS = 1900  # correlation lengths in a patch of the reference
PIECES = 8  # patches on the cells of the scene
PIECE = 90  # correlation lengths in such a patch
CHANCE = 2.0  # standard errors of a proportion or ratio of few trials, granted beyond the bounds
RATIO = 0.15  # distance of the reported error over the scatter from 1 that is allowed
BIAS = 0.3  # of the sampling tolerance: bias that is allowed
ENDLESS = "plain balances of long patches"
SHARED = lubfric.load_scene("paper").with_(numerics={"model": "paper"})
COLUMNS = ("case", "trials", "coverage", "bias")


@dataclass(frozen=True, kw_only=True)
class CoverageCase:
    """A scene, its speed [m/s], the target of the relative standard error, and the bounds of the coverage."""

    name: str
    speed: float = 0.01
    target: float = 0.02
    bounds: tuple[float, float] = (0.92, 0.98)
    changes: Keywords = field(default_factory=dict)

    def scene(self, seed: int) -> Scene:
        """Return the scene with a surface of its own ``seed``."""
        rough = self.changes.get("surface", {}) | {"seed": seed}
        return SHARED.with_(**self.changes | {"surface": rough})


def _other(name: str, **changes: dict[str, float | str | tuple[float, float]]) -> CoverageCase:
    return CoverageCase(name=name, bounds=(0.88, 0.99), changes=changes)


SPEEDS = (
    CoverageCase(name="0.003 m/s", speed=0.003),
    CoverageCase(name="0.01 m/s", speed=0.01, target=0.01),
    CoverageCase(name="0.03 m/s", speed=0.03),
    CoverageCase(name="0.046 m/s", speed=0.046),
)
CASES = (
    *SPEEDS,
    _other("exponential ACF", surface={"acf": "exponential"}),
    _other("4 µm", surface={"correlation_length": 4e-6}),
    _other("16 µm", surface={"correlation_length": 16e-6}, contact={"shape": (320, 200)}),
    _other("55 N", bodies={"load": 55.0}),
    _other("plastic", bodies={"hardness": 2e9}),
    _other("2.2 x 40 µm", surface={"correlation_length": (2.2e-6, 40e-6)}, contact={"shape": (200, 600)}),
)


@dataclass(frozen=True)
class Result:
    """The rows of the trials of a case, and the truth with its relative standard error."""

    case: CoverageCase
    rows: list[PlainRow]
    truth: float
    error: float

    def column(self, name: str) -> np.ndarray:
        """Return one number of all trials."""
        return np.array([row[name] for row in self.rows])

    @property
    def covered(self) -> np.ndarray:
        """For each trial, whether its interval holds the truth."""
        return (self.column("low") <= self.truth) & (self.truth <= self.column("high"))

    @property
    def ratio(self) -> float:
        """Root mean square of the reported standard error over the observed standard deviation."""
        f = self.column("f")
        return float(np.sqrt(np.mean((self.column("sampling") * f) ** 2)) / f.std(ddof=1))

    @property
    def bias(self) -> float:
        """Deviation of the mean of the trials from the truth, relative to it."""
        return float(self.column("f").mean() / self.truth - 1)

    @property
    def bias_error(self) -> float:
        """Relative standard error of the bias."""
        scatter = float(self.column("f").std(ddof=1)) / self.truth / math.sqrt(len(self.rows))
        return math.hypot(scatter, self.error)


def coverage(level: str, run: Run = Run(), seed: int = SEED) -> Iterator[Item]:
    """How often the 95 % interval holds the friction of an endless line, over trials on surfaces of their own."""
    chosen = SPEEDS if level == "quick" else CASES
    friction_of = truths(chosen, seed, run)
    numbers = {case.name: min(TRIALS[level], TRIALS["full"] if case in SPEEDS else OTHERS) for case in chosen}
    trials = {f"{case.name}, {seed + k}": (case, seed + k) for case in chosen for k in range(numbers[case.name])}
    rows: dict[str, list[PlainRow]] = {case.name: [] for case in chosen}
    for (case, _), row_of_trial in run.solved(trials, trial):
        rows[case.name].append(row_of_trial)
    results = [Result(case, rows[case.name], *friction_of[case.name]) for case in chosen]
    for result in results:
        yield from checks(result)
    yield Table(
        "sampling-coverage", "Trials of every case compared with its infinite line contact", COLUMNS, map(row, results)
    )
    yield picture(results)


def truths(cases: Iterable[CoverageCase], seed: int, run: Run) -> dict[str, tuple[float, float]]:
    """Return f of an endless line and its relative standard error, by the name of the case."""
    wanted = {f"{case.name}, {seed}": (case, seed + REPORTED) for case in cases}
    return {case.name: (f, error) for (case, _), (f, error) in run.solved(wanted, endless, "truths")}


def trial(case_and_seed: tuple[CoverageCase, int]) -> PlainRow:
    """Return one trial of a case."""
    case, seed = case_and_seed
    return solve(case.scene(seed), case.speed, case.target)


def solve(scene: Scene, speed: float, target: float) -> PlainRow:
    """Return one point with its interval and its processor seconds."""
    begun = time.process_time()
    point = lubfric.friction(scene.with_(numerics={"sampling_tolerance": target}), speed)
    u = point.uncertainty
    f = point.coefficient
    half = f * math.hypot(u.numerical, stdtrit(max(u.freedom, 1.0), 0.975) * u.sampling)  # the truth, too, is Eq. (8)
    return {
        "f": f,
        "sampling": u.sampling,
        "low": f - half,
        "high": f + half,
        "length": u.length,
        "few": bool(u.notes),
        "seconds": time.process_time() - begun,
    }


def endless(case_and_seed: tuple[CoverageCase, int]) -> tuple[float, float]:
    """Return f of an endless line by the mean of patches with seeds from ``seed`` on, and its relative standard
    error."""
    case, seed = case_and_seed
    scene = case.scene(seed)
    spacing, factors, along = cells_of(scene)
    coarse = (spacing[0] * factors[0], spacing[1] * factors[1])
    assert scene.contact.shape is not None  # of a case
    across = 4 * math.ceil(scene.contact.shape[0] / (4 * factors[0]))
    change, change_error = _change(scene, case.speed, seed + 500, across)
    columns = 64 * round(LENGTHS * along / coarse[1] / 64)
    values: list[float] = []
    while len(values) < FEWEST or (len(values) < PATCHES and _error(values) > CLOSE * case.target):
        surface = _surface(scene, (across, columns), coarse, seed + len(values))
        values.append(_plain(scene, surface, case.speed))
    return float(np.mean(values)) * (1 + change), math.hypot(_error(values), change_error)


def cells_of(scene: Scene) -> tuple[tuple[float, float], tuple[int, int], float]:
    """Return the scene's own spacing [m]; how many of its cells (a power of two) make a quarter of the correlation
    length along x and y, and half the Hertz strip; the correlation length along y [m]."""
    spacing = np.broadcast_to(np.asarray(scene.contact.spacing), 2).tolist()
    length = np.broadcast_to(np.asarray(scene.surface.correlation_length), 2).tolist()
    most = min(length[0] / 4, scene.bodies.half_width / 2) / spacing[0], length[1] / 4 / spacing[1]
    fx, fy = (2 ** max(0, math.floor(math.log2(m * (1 + 1e-9)))) for m in most)
    return (spacing[0], spacing[1]), (fx, fy), length[1]


def _change(scene: Scene, speed: float, seed: int, across: int) -> tuple[float, float]:
    """Return relative change of f from the cells of the long patches to the scene's own, and its standard error."""
    spacing, (fx, fy), along = cells_of(scene)
    if (fx, fy) == (1, 1):
        return 0.0, 0.0
    changes = []
    for k in range(PIECES):
        rows = 16 * fy * round(PIECE * along / (fy * spacing[1]) / 16)
        fine = _surface(scene, (across * fx, rows), spacing, seed + k)
        some = fine.heights[fx // 2 :: fx, fy // 2 :: fy]
        coarse = replace(fine, heights=some, spacing=(spacing[0] * fx, spacing[1] * fy))
        changes.append(_plain(scene, fine, speed) / _plain(scene, coarse, speed) - 1)
    return float(np.mean(changes)), float(np.std(changes, ddof=1)) / math.sqrt(PIECES)


def _error(values: Sequence[float]) -> float:
    return float(np.std(values, ddof=1) / np.mean(values) / math.sqrt(len(values)))


def _surface(scene: Scene, shape: tuple[int, int], spacing: tuple[float, float], seed: int) -> Surface:
    rough = scene.surface
    keys: Keywords = {"sq": rough.sq, "correlation_length": rough.correlation_length, "acf": rough.acf}
    return lubfric.generate_surface(shape, spacing, seed=seed, **keys)


def _plain(scene: Scene, surface: Surface, speed: float) -> float:
    """Return f of one patch on its own cells."""
    contact = {"shape": surface.shape, "spacing": surface.spacing}
    patch = scene.with_(contact=contact, numerics={"sampling": "patch", "grid": "given", "tolerance": 2e-3})
    return lubfric.friction(lubfric.prepare(patch, surface), speed).coefficient


def checks(result: Result) -> Iterator[Item]:
    """Coverage, reported error over observed scatter, and bias against the truth.

    The coverage decides nothing in a case of which most trials say that the map is too small.
    """
    case = result.case
    n = len(result.rows)
    decides = float(result.column("few").mean()) <= 0.5
    yield within(f"{case.name}: coverage", float(result.covered.mean()), n, case.bounds, ENDLESS, decides=decides)
    slack = RATIO + CHANCE / math.sqrt(2 * n)
    yield Check(
        f"{case.name}: reported over scatter",
        result.ratio,
        expected=1.0,
        tolerance=slack,
        source="scatter of the trials",
        kind=ABSOLUTE,
    )
    slack = BIAS * case.target + CHANCE * result.bias_error
    yield Check(f"{case.name}: bias of f", result.bias, expected=0.0, tolerance=slack, source=ENDLESS, kind=ABSOLUTE)


def within(
    name: str, measured: float, trials: int, bounds: tuple[float, float], source: str, *, decides: bool = True
) -> Check:
    """Return a check of a share of trials between two bounds, with what chance does to it."""
    low, high = bounds
    return Check(
        name,
        measured,
        expected=(high + low) / 2,
        tolerance=(high - low) / 2 + chance(trials),
        source=source,
        kind=ABSOLUTE,
        decisive=decides,
    )


def chance(trials: int) -> float:
    """Return how much less than 95 % is granted to a share of few trials."""
    return CHANCE * math.sqrt(0.05 * 0.95 / trials)


def row(result: Result) -> tuple[str, ...]:
    """Return the numbers of a case as cells of a table (`COLUMNS`)."""
    return (
        result.case.name
        + (f", target {100 * result.case.target:g} %" if result.case.target != CoverageCase.target else ""),
        str(len(result.rows)),
        f"{100 * result.covered.mean():.1f} %",
        f"{100 * result.bias:+.2f} ± {100 * result.bias_error:.2f} %",
    )


def picture(results: list[Result]) -> Figure:
    """Return every interval of every case over the truth. Those that miss it are orange."""
    canvas, grid = panels(len(results), 2, 11, 2.6)
    for axis, result in zip(grid, results):
        order = np.argsort(result.column("f"))
        f, low, high = (100 * (result.column(name)[order] / result.truth - 1) for name in ("f", "low", "high"))
        for hit, colour in ((True, "#0072B2"), (False, "#D55E00")):
            k = np.flatnonzero(result.covered[order] == hit)
            axis.vlines(k, low[k], high[k], color=colour, lw=0.9)
        axis.plot(np.arange(f.size), f, ".", color="black", ms=2)
        axis.axhline(0, color="black", lw=0.8)
        axis.set_title(f"{result.case.name}: {100 * result.covered.mean():.1f} % of {f.size} cover")
        axis.set(ylabel="f/f∞ − 1 (%)", xlabel="trials, by f", xticks=[])
    return finish("coverage", canvas, "Every interval over the truth; those that miss it are orange", "png")
