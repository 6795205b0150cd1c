"""Estimated steps and processor time of a run in time. Nothing is solved."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..estimate import PointWorkEstimate, estimated_work_of_point, seconds_of_points
from ..models.load_sharing import PaperModel, expected_gap
from ..samples import Sample
from ..scene import Harmonic, History, Scene, Table
from ..surface import Surface
from .film_setting import TIME_SHARE
from .scene_in_time import scene_at, transient_of, value_at
from .start import speeds_of_run
from .transient_deterministic import work_of_run

# Tolerance of a step at which the steps of runs were counted [-]. A choice: what `TIME_SHARE` gives by default.
STEP_TOLERANCE = 3e-5

# Steps while the speed changes by a factor of e, at that tolerance: 20 and 59 in the examples reciprocating and
# stop_and_start, 70 in a piston ring, 80 in a cam.
STEPS_OF_CHANGE = 60.0

# Part of these steps that a run saves where the film fills the complete gap [-]: 63 to 97 steps for 139 to 155 in five
# random runs of `python -m verification.campaigns.estimates` at lambda ratios above 2.3.
SPARED_BY_FILM = 0.5

# Steps that a change of the load takes, over those of a change of the speed [-]: measured 13 in a light and slow
# contact, 60 in a ring of thick film.
CHANGE_OF_LOAD = 0.5

# Steps that a change of the radius takes, over those of a change of the speed [-]: it moves the complete gap around the
# contact. A choice, above that of the load.
CHANGE_OF_RADIUS = 3.0

# Part of the largest speed below which the acceleration of a reversal is looked up. A choice, for an estimate.
SLOW = 0.1

# Part of the largest speed that counts as the smallest: a film at rest changes by squeeze alone. A choice: it moves
# estimates alone.
SMALLEST_SPEED = 1e-3

# Speeds between that and the largest one at which the film is estimated. A choice: a larger value takes longer, a
# smaller one errs more between them.
SPEEDS_OF_FILM = 16

# Times in a period, or in a run without periods, at which its histories are compared. A choice: a larger value takes
# longer, a smaller one misses short events.
TIMES_OF_PERIOD = 128

# Periods that are looked at; the others are like them. A choice, for time.
MOST_PERIODS = 100.0

# Steps at the start of a run, and after each jump. Measured in those runs.
STEPS_OF_START = 30.0

# Steps after each corner of a table, beside those of its change: 5, 5 and 6 for a wave through 11, 31 and 121 rows.
STEPS_OF_CORNER = 5.0

# Processor seconds of the film in a step: 3 to 6 ms in 15 random runs of `python -m verification.campaigns.estimates`.
FILM_STEP_SECONDS = 4e-3

# Processor seconds of the contact in a step, over its cells: .5e-7 there in thin films, 1.2e-7 to 1.6e-7 in thicker
# ones.
CELL_STEP_SECONDS = 1.3e-7


@dataclass(frozen=True, kw_only=True)
class RunEstimate:
    """About how many ``steps`` a run takes, and its processor ``seconds``.

    ``start_seconds``: the part of these that is solved before the first step;
    ``times`` [s], ``steps_until``: how many of the steps are expected until each of these times, (n,); ``widest``: the
    work estimate at the speed that needs most strips of the roughness, whose sample all times share (None: the run has
    one strip).
    """

    steps: float
    seconds: float
    times: np.ndarray
    steps_until: np.ndarray
    widest: PointWorkEstimate | None = None
    start_seconds: float = 0.0

    def part(self, time: float) -> float:
        """Return the part [-] of the steps that is expected until ``time`` [s]."""
        return float(np.interp(time, self.times, self._course) / self._course[-1])

    @property
    def _course(self) -> np.ndarray:
        """How many steps are expected until each of `times`: those of the start end at the second of these."""
        return np.append(0.0, self.steps_until[1:])

    def times_of_parts(self, count: int) -> list[float]:
        """Return the times [s] until which 1, 2, ... of so many (``count``) equal parts of the steps are expected; the
        last is the end."""
        course = self._course
        inner = np.interp(course[-1] * np.arange(1, count) / count, course, self.times)
        return np.unique([*inner[inner > 0.0], self.times[-1]]).tolist()

    def seconds_between(self, times: Sequence[float]) -> list[float]:
        """Return the processor seconds [s] of the steps until the first of ``times`` [s], and from each of them to the
        next."""
        parts = [0.0, *(self.part(time) for time in times)]
        return [(self.seconds - self.start_seconds) * each for each in np.diff(parts).tolist()]


def estimated_deterministic(scene: Scene, sample: Sample, surface: Surface) -> RunEstimate:
    """Return the estimate of a deterministic run, which has one strip; arguments as of `estimated_run`."""
    steps, seconds, stops = work_of_run(scene)
    times = np.array([0.0, *stops, transient_of(scene).duration])
    return RunEstimate(steps=steps, seconds=seconds, times=times, steps_until=np.linspace(0.0, steps, times.size))


def estimated_load_sharing(scene: Scene, sample: Sample, surface: Surface) -> RunEstimate:
    """Return the estimate of a run by load sharing; arguments as of `estimated_run`.

    The run first solves steady friction at some of its speeds, for its strips. The number of steps follows from how
    much the histories change (`changes`), from the tolerance of a step with the order of the march, 2, and from the
    part of the gap that the film fills.
    """
    transient = transient_of(scene)
    # whatever model steady friction would be by, and without the ends of input ranges, which its strips do not need
    by_load_sharing = replace(scene.with_(numerics={"model": PaperModel().name}), ranges=())
    speeds = speeds_of_run(scene) or [0.0]
    points = [estimated_work_of_point(by_load_sharing, sample, surface, speed) for speed in speeds]
    widest = None
    cells = surface.heights.size
    if sample.represents_more:
        widest = max(points, key=lambda point: point.strips)
        cells = round(sample.cells.columns * widest.length / sample.cells.spacing[1])
    tolerance = transient.tolerance or TIME_SHARE * scene.numerics.tolerance_of("film")
    times, changed, carried = changes(scene, surface.sq)
    jumps = sorted({time for history in transient.histories for time in history.jumps(transient.duration)})
    stops = {time for history in transient.histories for time in history.stops(transient.duration)}
    corners = sorted(stops.difference(jumps))
    begun = STEPS_OF_START * carried.mean() * (1.0 + np.searchsorted(jumps, times))
    begun += STEPS_OF_CORNER * carried.mean() * np.searchsorted(corners, times)
    changing = STEPS_OF_CHANGE * (STEP_TOLERANCE / tolerance) ** (1 / 3) * changed + begun
    steps_until = np.maximum(transient.outputs * times / transient.duration, changing)
    steps = float(steps_until[-1])
    start_seconds = seconds_of_points(points)
    seconds = start_seconds + steps * (FILM_STEP_SECONDS + CELL_STEP_SECONDS * cells)
    return RunEstimate(
        steps=steps,
        seconds=seconds,
        times=times,
        steps_until=steps_until,
        widest=widest,
        start_seconds=start_seconds,
    )


def changes(scene: Scene, sq: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return times [s] of a run, how much its speed, load and radius have changed until then, and a weight that follows
    from the part p of the gap that the film fills, at rough surfaces of ``sq`` [m], (n,) each. The changes are the sum
    of |d ln| of each, with the weights 1, `CHANGE_OF_LOAD` and `CHANGE_OF_RADIUS`, times p^(1/3) (1 - `SPARED_BY_FILM`
    p^4): of what changes only so much moves the gap, by which a step is judged, and a film that carries the load alone
    follows more smoothly.

    The speed of a reversal does not count as smaller than that which passes the contact and its inlet, of the length l,
    with the acceleration a: sqrt(2 l a).
    """
    transient = transient_of(scene)
    laps = max((periods(history, transient.duration) for history in transient.histories), default=0.0)
    shown = min(1.0, MOST_PERIODS / laps) if laps else 1.0
    times = np.linspace(0.0, shown * transient.duration, math.ceil(TIMES_OF_PERIOD * max(shown * laps, 1.0)) + 1)
    stops = {time for history in transient.histories for time in history.stops(transient.duration) if time < times[-1]}
    times = np.union1d(times, [*stops])
    constants = {
        "speed": scene.motion.entrainment_speed,
        "load": scene.bodies.load,
        "radius": scene.bodies.radius,
    }
    speed, load, radius = (
        np.array([value_at(scene, name, constant, time) for time in times.tolist()])
        for name, constant in constants.items()
    )
    fastest = float(np.max(np.abs(speed)))
    effective = np.maximum(np.abs(speed), 1e-300)
    slow = np.abs(speed) < SLOW * fastest
    if slow.any():
        now = scene_at(scene, float(times[np.argmax(np.abs(speed))]))
        line = now.line_contact(fastest)
        length = line.half_width + math.sqrt(2.0 * line.radius * line.expected_film)
        passing = math.sqrt(2.0 * length * float(np.max(np.abs(np.gradient(speed, times))[slow])))
        effective = np.hypot(speed, max(passing, SMALLEST_SPEED * fastest))
    weighted = (effective, 1.0), (load, CHANGE_OF_LOAD), (radius, CHANGE_OF_RADIUS)
    changed = np.sum([weight * np.abs(np.diff(np.log(values))) for values, weight in weighted], axis=0)
    parts = _parts_of_film(scene, sq, effective)
    carried = np.cbrt(parts) * (1.0 - SPARED_BY_FILM * parts**4)
    changed = np.append(0.0, np.cumsum(0.5 * (carried[1:] + carried[:-1]) * changed))
    return times / shown, changed / shown, carried


def _parts_of_film(scene: Scene, sq: float, speeds: np.ndarray) -> np.ndarray:
    """Return the part of the gap, at rough surfaces of ``sq`` [m], that the film fills at each of ``speeds`` [m/s]
    (n,), none negative; 1 where nothing is entrained."""
    fastest = float(speeds.max())
    if fastest < 1e-200:
        return np.ones(speeds.size)
    known = np.geomspace(SMALLEST_SPEED * fastest, fastest, SPEEDS_OF_FILM)
    films = [scene.line_contact(speed).expected_film for speed in known.tolist()]
    return np.interp(speeds, known, [min(film / expected_gap(film, sq), 1.0) for film in films])


def periods(history: History, duration: float) -> float:
    """Return how often ``history`` repeats itself in ``duration`` [s]; 0 for one that does not."""
    if isinstance(history, Harmonic):
        return history.frequency * duration
    return duration / history.times[-1] if isinstance(history, Table) and history.repeat else 0.0
