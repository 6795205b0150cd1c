"""Random runs of every kind, each with what lubfric estimates that it takes, and the call that does it."""

import math
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

import lubfric
from lubfric.output import described_scene, estimate_scene
from lubfric.running_in import estimated_run_in
from lubfric.scene import Harmonic, History, Table, Transient
from lubfric.studies import estimated_fit, estimated_study

from ...types import Keywords

KINDS = (
    "rest auto",
    "rest quick",
    "rest paper",
    "rest deterministic",
    "rolling auto",
    "rolling quick",
    "rolling deterministic",
    "curve",
    "traction",
    "study",
    "fit",
    "time",
    "time deterministic",
    "run-in",
    "wear",
    "command",
)
# The kinds of runs on one patch of few correlation lengths, which begin with number `FIRST_PATCH`.
PATCH_KINDS = (
    "patch rest deterministic",
    "patch rest quick",
    "patch rest paper",
    "patch rolling quick",
    "patch rolling deterministic",
    "patch traction",
)
FIRST_PATCH = 10_000
# The kinds of runs whose time `lubfric info` measures on their first steps, which begin with number `FIRST_MEASURED`.
MEASURED_KINDS = ("rolling auto measured", "rolling deterministic measured")
FIRST_MEASURED = 20_000
ROLLING = ("rolling auto", "rolling quick", "rolling deterministic", "traction", *MEASURED_KINDS)
# Model of a kind whose name does not say it. A fit by the quick model takes one to three minutes.
MODELS = {"curve": "paper", "study": "quick", "fit": "paper", "time": "paper", "run-in": "paper"}
# Usual ranges, drawn evenly in the logarithm: radius [m], E' [Pa], Hertz pressure [Pa], Sq [m], correlation length [m],
# viscosity [Pa s], and Moes' film of the whole load over Sq [-].
RANGES = {
    "radius": (2e-3, 3e-2),
    "e_prime": (1.1e11, 2.4e11),
    "pressure": (8e7, 1.2e9),
    "sq": (5e-8, 4e-7),
    "length": (4e-6, 3e-5),
    "viscosity": (0.01, 0.3),
    "ratio": (0.05, 5.0),
}
# Counted work [s] at which a point, or a run, is ended: its row has what it took until then.
MOST_WORK = 40.0
LONGEST = 30.0  # s: longest estimate of a run that is done
DRAWS = 100  # draws, at most, until an estimate is short enough
CELLS_IN_LENGTH = 5.0  # cells in a correlation length of a patch that runs in
LENGTHS_IN_PATCH = 10.0  # correlation lengths in its side
STRIPS_IN_PATCH = 4.0  # Hertz half-widths in its side
# Ends of the cells in the shortest correlation length of a patch at a point, and of the correlation lengths in its
# sides.
CELLS_OF_POINT = (4.0, 24.0)
LENGTHS_OF_POINT = (4.0, 14.0)
# Cells along each side of such a patch come in multiples of one of these numbers.
MULTIPLES = (4, 8, 16)
# Length of ridges over their width [-].
RIDGE = 5.0
# Speeds between which that film is searched [m/s].
SPEEDS = (1e-7, 100.0)
# Halvings of their logarithmic distance.
HALVINGS = 60


@dataclass(frozen=True, kw_only=True)
class RandomRun:
    """A run: its ``kind``, the number of its ``draw``, its ``scene``, the ``estimate`` [s], and the call that does
    it."""

    kind: str
    draw: int
    scene: lubfric.Scene
    estimate: Callable[[], float]
    run: Callable[[], object]


def kind_of(seed: int) -> str:
    """Return the kind of run number ``seed``: one on a patch from `FIRST_PATCH` on, one that is measured from
    `FIRST_MEASURED` on."""
    kinds: tuple[str, ...] = KINDS
    if seed >= FIRST_PATCH:
        kinds = PATCH_KINDS if seed < FIRST_MEASURED else MEASURED_KINDS
    return kinds[seed % len(kinds)]


def drawn(seed: int, draw: int | None = None) -> RandomRun:
    """Return the random run number ``seed``. Its kind (`kind_of`) follows from the number. A run that is estimated to
    take more than `LONGEST`, or that is refused, is drawn again; ``draw``: the number of the draw, where it is
    known."""
    kind = kind_of(seed)
    if draw is not None:
        return _drawn(seed, draw, kind)
    for draw in range(DRAWS):
        job = _drawn(seed, draw, kind)
        with suppress(lubfric.InputError):  # a map too short for its correlation length
            if 0 < job.estimate() <= LONGEST:
                return job
    raise RuntimeError(f"no run of the kind {kind!r} is short enough")


def _drawn(seed: int, draw: int, kind: str) -> RandomRun:
    rng = np.random.default_rng([48, seed, draw])
    is_on_patch = kind in PATCH_KINDS
    kind_of_run = kind.removeprefix("patch ")
    scene = _scene(rng, kind_of_run)
    if is_on_patch:
        scene = scene.with_(contact=_patch_of_point(rng, scene), numerics={"sampling": "patch"})
    speed = scene.motion.entrainment_speed
    is_measured = kind in MEASURED_KINDS
    model = kind.removesuffix(" measured").rpartition(" ")[2]
    model = MODELS.get(kind, model if model in ("auto", "paper", "deterministic") else "quick")
    scene = scene.with_(numerics={"model": model})
    if is_measured:  # a limit would end half of those that are drawn
        scene = scene.with_(numerics={"max_work": None})
    estimate: Callable[[], float] = partial(_measured, scene) if is_measured else partial(_of_scene, scene)
    run: Callable[[], object] = partial(lubfric.friction, scene, speed)
    if kind == "curve":
        estimate = partial(_of_scene, scene, speeds="auto")
        run = partial(lubfric.stribeck, scene, "auto")
    elif kind_of_run == "traction":
        ratios = np.geomspace(0.005, 1.0, int(rng.integers(3, 9))).tolist()
        estimate = partial(_of_scene, scene, ratios=ratios)
        run = partial(lubfric.traction, scene, ratios, speed=speed)
    elif kind == "study":
        factors = {"bodies.load": [scene.bodies.load * f for f in (0.5, 1.0, 2.0)][: int(rng.integers(1, 4))]}
        viscosities = {"lubricant.viscosity": [scene.lubricant.viscosity * f for f in (0.5, 1.0)]}
        axes = factors | viscosities
        speeds = [0.5 * speed, speed]
        estimate = partial(_of_study, scene, axes, speeds)
        run = partial(lubfric.study, scene, axes, speeds=speeds)
    elif kind == "fit":
        (estimate, run) = _fit(rng, scene, speed)
    elif kind.startswith("time"):
        scene = _in_time(rng, scene, speed, model)
        estimate = partial(_of_scene, scene)
        run = partial(lubfric.transient, scene)
    elif kind in ("run-in", "wear"):
        scene = scene.with_(bodies={"hardness": 10.0 ** rng.uniform(9.3, 9.9)}, contact=_patch(scene))
        keys = {"distance": 10.0 ** rng.uniform(0, 2), "wear_coefficient": 1e-8} if kind == "wear" else {}
        estimate = partial(estimated_run_in, scene, **keys)
        run = partial(lubfric.run_in, scene, **keys)
    elif kind == "command":
        speeds = np.geomspace(0.5 * speed, 2 * speed, int(rng.integers(1, 5))).tolist()
        scene = scene.with_(motion={"speeds": speeds})
        estimate = partial(_of_scene, scene, speeds=[*speeds, speed], command=True)
        run = partial(_command, scene)
    return RandomRun(kind=kind, draw=draw, scene=scene, estimate=estimate, run=run)


def _scene(rng: np.random.Generator, kind: str) -> lubfric.Scene:
    """Return a scene at the speed of its lambda ratio."""
    value = {name: math.exp(rng.uniform(math.log(ends[0]), math.log(ends[1]))) for name, ends in RANGES.items()}
    rolling = kind in ROLLING
    friction = rng.uniform(0.08, 0.13)
    oils: list[dict[str, object]] = [
        {"eyring_stress": 10.0 ** rng.uniform(6.5, 7.2)},
        {"eyring_stress": 10.0 ** rng.uniform(6.5, 7.2), "limiting_stress_coefficient": rng.uniform(0.05, 0.1)},
        {"limiting_stress_coefficient": rng.uniform(0.05, 0.1)},
    ]
    length = value["length"]
    lays = [length, length, (length, RIDGE * length), (RIDGE * length, length)]
    scene = lubfric.load_scene("paper").with_(
        bodies={
            "radius": value["radius"],
            "e_prime": value["e_prime"],
            "hertz_pressure": value["pressure"],
            "boundary_friction_coefficient": friction,
        },
        lubricant={"viscosity": value["viscosity"], "pressure_viscosity_coefficient": rng.uniform(12e-9, 26e-9)}
        | oils[int(rng.integers(3))],
        motion={"slide_roll_ratio": math.copysign(rng.uniform(0.02, 2.0), rng.uniform(-1, 1)) if rolling else 2.0},
        surface={
            "sq": value["sq"],
            "correlation_length": lays[int(rng.integers(4))],
            "acf": "exponential" if rng.random() < 0.3 else "gaussian",
            "seed": int(rng.integers(2**31)),
        },
        numerics={"accept": True, "film_deflection": "scaled", "max_work": MOST_WORK},
    )
    (low, high) = map(math.log, SPEEDS)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        thin = scene.line_contact(math.exp(middle)).moes_film < value["ratio"] * value["sq"]
        (low, high) = (middle, high) if thin else (low, middle)
    return scene.with_(motion={"entrainment_speed": math.exp(low), "speeds": [math.exp(low)]})


def _patch(scene: lubfric.Scene) -> dict[str, object]:
    """Return the keys of a patch that is longer than the Hertz strip and than some correlation lengths, on five cells
    in the shortest of them."""
    given = scene.surface.correlation_length or 0.0
    lengths = given if isinstance(given, tuple) else (given, given)
    spacing = min(lengths) / CELLS_IN_LENGTH
    sides = max(LENGTHS_IN_PATCH * lengths[0], STRIPS_IN_PATCH * scene.bodies.half_width), LENGTHS_IN_PATCH * lengths[1]
    return {"shape": tuple(4 * math.ceil(side / spacing / 4) for side in sides), "spacing": spacing}


def _patch_of_point(rng: np.random.Generator, scene: lubfric.Scene) -> dict[str, object]:
    """Return the keys of a patch of few correlation lengths, which is at least as long as `_patch` needs along x."""
    given = scene.surface.correlation_length or 0.0
    lengths = given if isinstance(given, tuple) else (given, given)
    (per_length, number) = (
        math.exp(rng.uniform(math.log(least), math.log(most))) for least, most in (CELLS_OF_POINT, LENGTHS_OF_POINT)
    )
    multiple = int(rng.choice(MULTIPLES))
    spacing = min(lengths) / per_length
    sides = max(number * lengths[0], STRIPS_IN_PATCH * scene.bodies.half_width), number * lengths[1]
    return {"shape": tuple(multiple * math.ceil(side / spacing / multiple) for side in sides), "spacing": spacing}


def _in_time(rng: np.random.Generator, scene: lubfric.Scene, speed: float, model: str) -> lubfric.Scene:
    """Return ``scene`` with a speed that changes in time: sinusoidally, or from rest."""
    way = scene.bodies.half_width
    duration = (1.0 if model == "deterministic" else 20.0) * way / speed
    if rng.random() < 0.5:
        history: History = Harmonic(mean=speed, amplitude=0.5 * speed, frequency=1.0 / duration)
    else:
        history = Table(times=(0.0, 0.5 * duration, duration), values=(0.2 * speed, speed, 0.6 * speed))
    return scene.with_(transient=Transient(duration=duration, speed=history, outputs=20))


def _fit(
    rng: np.random.Generator, scene: lubfric.Scene, speed: float
) -> tuple[Callable[[], float], Callable[[], object]]:
    """Return the estimate and the call of a fit of one or two parameters to a curve of a formula, with scatter."""
    speeds = np.geomspace(0.2 * speed, 5 * speed, int(rng.integers(4, 9)))
    share = 1 / (1 + speeds / speed)
    f = 0.11 * share + 0.03 * (1 - share)
    measured = lubfric.Measured(x=speeds, coefficient=f * (1 + 0.02 * rng.standard_normal(f.size)))
    parameters = {"bodies.boundary_friction_coefficient": (0.05, 0.15), "surface.sq": (3e-8, 6e-7)}
    chosen = dict(list(parameters.items())[: int(rng.integers(1, 3))])
    return partial(estimated_fit, scene, measured, chosen), partial(lubfric.fit, scene, measured, chosen)


def _of_scene(
    scene: lubfric.Scene,
    speeds: Sequence[float] | str = (),
    ratios: Sequence[float] = (),
    *,
    command: bool = False,
) -> float:
    prepared = lubfric.prepare(scene)
    estimate = estimate_scene(scene, prepared.sample, prepared.surface, speeds, ratios)
    return estimate.command_seconds if command else estimate.seconds


def _measured(scene: lubfric.Scene) -> float:
    """Return the seconds that ``lubfric info`` states."""
    (_, estimate) = described_scene(scene, measures=True)
    return estimate.seconds


def _of_study(scene: lubfric.Scene, axes: Keywords, speeds: list[float]) -> float:
    return estimated_study(lubfric.plan_study(scene, axes, speeds=speeds))


def _command(scene: lubfric.Scene) -> None:
    """Run ``lubfric run`` in a process of its own."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.toml"
        file.write_text(scene.to_toml())
        command = [sys.executable, "-m", "lubfric", "run", str(file), "--out", str(Path(folder) / "out")]
        subprocess.run(command, check=False, capture_output=True, env={**os.environ, "OMP_NUM_THREADS": "1"})


def seconds() -> float:
    """Return the processor time [s] of this process and of those that it waited for."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)
