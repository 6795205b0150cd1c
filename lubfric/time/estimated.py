"""Estimated steps and processor time of a run in time. Nothing is solved."""

from dataclasses import dataclass

from ..estimate import PointWorkEstimate, estimated_work_of_point, seconds_of_points
from ..models.load_sharing import expected_gap
from ..samples import Sample
from ..scene import Harmonic, History, Scene, Table
from ..surface import Surface
from .film_setting import TIME_SHARE
from .scene_in_time import transient_of
from .start import speeds_of_run
from .transient_deterministic import work_of_run

# Tolerance of a step at which the steps of runs of the paper's scene were counted [-].
STEP_TOLERANCE = 3e-5

# Steps in a period of a history, or in a history that does not repeat, at that tolerance.
STEPS_OF_SWING = 80.0

# Steps at the start of a run.
STEPS_OF_START = 30.0

# Processor seconds of the film in a step.
FILM_STEP_SECONDS = 6e-3

# Processor seconds of the contact in a step, over its cells.
CELL_STEP_SECONDS = 1.5e-7


@dataclass(frozen=True, kw_only=True)
class RunEstimate:
    """About how many ``steps`` a run takes, and its processor ``seconds``; ``widest``: the work estimate at the speed that
    needs most strips of the roughness, whose sample all times share (None: the run has one strip)."""

    steps: float
    seconds: float
    widest: PointWorkEstimate | None = None


def estimated_deterministic(scene: Scene, sample: Sample, surface: Surface) -> RunEstimate:
    """Return the estimate of a deterministic run, which has one strip; arguments as of `estimated_run`."""
    steps, seconds = work_of_run(scene)
    return RunEstimate(steps=steps, seconds=seconds)


def estimated_load_sharing(scene: Scene, sample: Sample, surface: Surface) -> RunEstimate:
    """Return the estimate of a run by load sharing; arguments as of `estimated_run`.

    The run first solves steady friction at some of its speeds, for its strips. The number of steps follows
    from the tolerance of a step with the order of the march, 2, and from the part of the gap that the film fills.
    """
    plan = transient_of(scene)
    moving = [speed for speed in speeds_of_run(scene) if speed]
    points = [estimated_work_of_point(scene, sample, surface, speed) for speed in speeds_of_run(scene) or [0.0]]
    widest = None
    cells = surface.heights.size
    if sample.represents_more:
        widest = max(points, key=lambda point: point.strips)
        cells = round(sample.cells.columns * widest.length / sample.cells.spacing[1])
    tolerance = plan.tolerance or TIME_SHARE * scene.numerics.tolerance_of("film")
    swings = max((periods(history, plan.duration) or 1.0 for history in plan.histories), default=0.5)
    carried = sum(_part_of_film(scene, surface.sq, speed) for speed in moving) / len(moving) if moving else 1.0
    changing = STEPS_OF_SWING * swings * (STEP_TOLERANCE / tolerance) ** (1 / 3)
    steps = max(plan.outputs, carried ** (1 / 3) * changing) + carried ** (1 / 3) * STEPS_OF_START
    seconds = seconds_of_points(points) + steps * (FILM_STEP_SECONDS + CELL_STEP_SECONDS * cells)
    return RunEstimate(steps=steps, seconds=seconds, widest=widest)


def _part_of_film(scene: Scene, sq: float, speed: float) -> float:
    """Return the part of the gap, at rough surfaces of ``sq`` [m], that the film fills at ``speed`` [m/s]: of what changes
    in time only so much moves the gap, by which a step is judged."""
    film = scene.line_contact(abs(speed)).expected_film
    return min(film / expected_gap(film, sq), 1.0)


def periods(history: History, duration: float) -> float:
    """Return how often ``history`` repeats itself in ``duration`` [s]; 0 for one that does not."""
    if isinstance(history, Harmonic):
        return history.frequency * duration
    return duration / history.times[-1] if isinstance(history, Table) and history.repeat else 0.0
