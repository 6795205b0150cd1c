"""A Stribeck curve at speeds that it chooses itself, each from all that is solved so far."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..curve.choose import next_speed
from ..curve.interpolate import Samples
from ..curve.span import first_speeds
from ..prepared import Prepared
from ..result import FrictionResult
from ..store import digest
from .chain import solved_at, start_from
from .journal import Journal, outcome_of, without_fields
from .table_row import AT, CLEARANCE, CURVE, DECIDED, SPEED, STEEPNESS

AUTO = "auto"
MOST, CHOSEN = 25, 12  # speeds at most, and about
FEWEST = 3  # solved speeds that an interpolation needs


@dataclass(frozen=True)
class Search:
    """What to solve.

    ``first``: speeds [m/s] to begin with, both ends among them; ``tolerance``: relative, on f between the points;
    ``wanted``: speeds [m/s] that must be among those solved, with their fields; ``name``: fingerprint of all that the
    speeds depend on.
    """

    first: tuple[float, ...]
    tolerance: float
    wanted: tuple[float, ...]
    name: str

    @property
    def ahead(self) -> list[float]:
        """The speeds [m/s] that do not depend on any result, fastest first."""
        return sorted({*self.first, *self.wanted}, reverse=True)


def search_of(prepared: Prepared, name: str, wanted: tuple[float, ...] = ()) -> Search:
    """The search for the curve of ``prepared``; ``name`` is its fingerprint.

    The tolerance between the points is that on f. On a line of a rough surface neighbouring points may be solved on
    different lengths of it. There the tolerance is the root sum of squares of that on f and the sampling tolerance.
    """
    numerics = prepared.scene.numerics
    tolerance = numerics.tolerance
    if prepared.lines is not None:
        tolerance = math.hypot(tolerance, numerics.sampling_tolerance)
    return Search(first_speeds(prepared.scene, prepared.surface.sq), tolerance, wanted, name)


def curve_key(name: str) -> str:
    """The key under which a store says that the curve with fingerprint ``name`` is complete."""
    return digest([name, "complete"])


def run_adaptive(
    prepared: Prepared, search: Search, journal: Journal, known: dict[str, dict]
) -> Iterator[tuple[float, object]]:
    """Yield (speed, outcome) until the estimated error is within the tolerance, or 25 speeds are solved.

    Each point starts from the nearest one before it. Points among the ``known`` records (those of the ``journal``, by
    key) are taken from there. So the choices come out the same, and with them all later points.
    """
    trail = Trail(prepared, search, journal, known)
    ahead = search.ahead
    while len(trail.speeds) < MOST:
        speed = ahead.pop(0) if ahead else _next(trail, search.tolerance)
        if speed is None:
            break
        yield float(speed), trail.add(float(speed))
    trail.end()


class Trail:
    """The points so far: ``speeds`` [m/s] and ``outcomes``. These have no fields where none are wanted."""

    def __init__(self, prepared: Prepared, search: Search, journal: Journal, known: dict[str, dict]):
        self.speeds: list[float] = []
        self.outcomes: list = []
        self._prepared, self._search, self._journal = prepared, search, journal
        self._known = known
        self._keys: list[str] = []
        self._whole: dict[int, object] = {}  # outcomes with all that a neighbour starts from

    def add(self, speed: float):
        """The outcome at ``speed``, from the journal or solved and kept there."""
        search, journal = self._search, self._journal
        last = self._keys[-1] if self._keys else digest([search.name, search.first, search.tolerance, search.wanted])
        key, at, kept = digest([last, speed]), len(self.speeds), speed in search.wanted
        self._keys.append(key)
        self.speeds.append(speed)
        if key in self._known:
            outcome = outcome_of(self._known[key])
            outcome = (journal.fields(key) or outcome) if kept else outcome
        else:
            outcome = self._start_of(at)
            place = {CURVE: curve_key(search.name), AT: at, SPEED: speed}
            journal.keep(key, key, outcome, kept, place)
            outcome = outcome if kept else without_fields(outcome)
        self.outcomes.append(outcome)
        return outcome

    def end(self) -> None:
        """The curve is complete: no state is needed any more."""
        for key in self._keys:
            self._journal.end(key)

    def _start_of(self, at: int):
        """Outcome number ``at`` with all that a neighbour starts from: remembered, read, or solved from the nearest one
        before it."""
        if at not in self._whole:
            key, found = self._journal.state(self._keys[at])
            if key != self._keys[at]:
                near = min(range(at), key=lambda i: abs(math.log(self.speeds[i] / self.speeds[at])), default=None)
                start = None if near is None else start_from(self._start_of(near))
                found = solved_at(self._prepared, self.speeds[at], start, self.speeds[at] in self._search.wanted)
            self._whole[at] = found
        return self._whole[at]


def _next(trail: Trail, tolerance: float) -> float | None:
    good = [o for o in trail.outcomes if isinstance(o, FrictionResult)]
    if len(good) < FEWEST:
        return None
    tried = [u for u, o in zip(trail.speeds, trail.outcomes) if not isinstance(o, FrictionResult)]
    return next_speed(samples_of(good), tolerance, tried)[0]


def samples_of(points: list[FrictionResult]) -> Samples:
    """What an interpolation needs of solved points, by ascending speed."""
    points = sorted(points, key=lambda point: abs(point.speed))
    names = ("contact_load", "film_load", "boundary_force", "coefficient", "film_to_roughness_ratio")
    columns = {name: np.array([getattr(p, name) for p in points]) for name in names}
    for name in DECIDED:
        columns[name] = np.array([getattr(p.decision, name, None) for p in points], dtype=float)
    return samples_at(np.abs([p.speed for p in points]), columns)


def samples_at(speed: np.ndarray, columns: dict[str, np.ndarray]) -> Samples:
    """The same at ascending speeds [m/s], of the numbers of their points by name."""
    total = columns["contact_load"] + columns["film_load"]
    boundary = columns["boundary_force"] / total
    return Samples(
        speed=speed,
        share=columns["contact_load"] / total,
        boundary=boundary,
        film=columns["coefficient"] - boundary,
        thickness=columns["film_to_roughness_ratio"],
        clearance=columns[CLEARANCE],
        steepness=columns[STEEPNESS],
    )
