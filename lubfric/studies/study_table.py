"""The numbers of a study while it is carried out, in arrays: a point takes some 400 bytes, whatever its result
holds."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from .choose import MOST_CHOSEN_SPEEDS
from .points import MISSING, MODEL, SPEED, STATUS, UNUSED, VIOLATIONS, Outcome, row_of
from .store import CHOSEN, OUTCOME, Store, digest, point_key


class StudyTable:
    """Columns (curves, points of a curve) of a `StudyPlan`, which are filled point by point in any order.

    Attributes
    ----------
    columns : numbers by name; NaN where a point failed, or is not computed
    status : as text
    model : the name of the model that answered; "" where none did
    violations : a tuple of `lubfric.Violation` for each point
    solved : number of points that have an outcome, equal ones of several curves counted once
    ended : keys of the curves that chose all their speeds
    """

    def __init__(self, plan: Any):
        self.plan = plan
        self.width = 1 if plan.paired else len(plan.speeds)
        if plan.chooses_speeds:
            self.width = MOST_CHOSEN_SPEEDS
        self.columns: dict[str, np.ndarray] = {}
        self.status = np.full(self._shape, UNUSED if plan.chooses_speeds else MISSING, dtype=object)
        self.model = np.full(self._shape, "", dtype=object)
        self.violations = np.empty(self._shape, dtype=object)
        self.violations.fill(())
        self.solved = 0
        self.ended: set[str] = set()
        self._curves: dict[str, list[int]] = {}
        for curve, key in enumerate(plan.keys):
            self._curves.setdefault(key, []).append(curve)
        self._chosen: dict[str, list[float]] = {}
        self._places = {speed: place for place, speed in enumerate(plan.speeds)}

    @property
    def _shape(self) -> tuple[int, int]:
        return len(self.plan.keys), self.width

    def put(self, key: str, speed: float, outcome: Outcome) -> None:
        """Put in the outcome of a point."""
        row = row_of(speed, outcome, self.plan.scene.numerics)
        places = self._places_of(key, speed)
        self.solved += 1
        for curve, place in places:
            self.status[curve, place] = row[STATUS]
            self.model[curve, place] = row.get(MODEL, "")
            self.violations[curve, place] = row.get(VIOLATIONS, ())
        for name, value in row.items():
            if name in (STATUS, MODEL, VIOLATIONS) or name == SPEED and not self.plan.chooses_speeds:
                continue
            if name not in self.columns:
                self.columns[name] = np.full(self._shape, np.nan)
            for curve, place in places:
                self.columns[name][curve, place] = value

    def end(self, key: str) -> None:
        """Mark a curve that has chosen all its speeds."""
        self.ended.add(key)

    def chosen(self, key: str) -> tuple[float, ...]:
        """Return the speeds [m/s] that a curve has chosen so far."""
        return tuple(self._chosen.get(key, ()))

    def forget(self, key: str) -> None:
        """Take the points of a curve out, which come again in the order in which they were chosen."""
        self.solved -= len(self._chosen.pop(key, ()))
        for curve in self._curves[key]:
            self.status[curve] = UNUSED
            self.model[curve] = ""
            self.violations[curve].fill(())
            for column in self.columns.values():
                column[curve] = np.nan

    def read(self, store: Store) -> None:
        """Put in all points that ``store`` has."""
        if not store.empty:
            with store.one_warning():
                self._read(store)

    def _read(self, store: Store) -> None:
        for key, speeds in self.plan.requested.items():
            if speeds:
                for speed in speeds:
                    outcome = store.get(point_key(key, speed), OUTCOME)
                    if outcome is not None:
                        self.put(key, speed, outcome)
                continue
            chosen_so_far, complete = store.get(digest(key), CHOSEN) or ((), False)
            outcomes = [(speed, store.get(point_key(key, speed), OUTCOME)) for speed in chosen_so_far]
            for speed, outcome in outcomes:
                if outcome is not None:
                    self.put(key, speed, outcome)
            if complete and all(outcome is not None for _, outcome in outcomes):
                self.end(key)

    def left(self) -> Iterator[tuple[int, str, tuple[float, ...]]]:
        """Yield (curve, key, speeds [m/s]) of what is still to be solved; no speeds: the curve chooses them."""
        for key, speeds in self.plan.requested.items():
            curve = self._curves[key][0]
            if not speeds:
                if key not in self.ended:
                    yield curve, key, ()
                continue
            missing = tuple(speed for speed in speeds if self._is_missing(key, speed))
            if missing:
                yield curve, key, missing

    def _is_missing(self, key: str, speed: float) -> bool:
        curve, place = self._places_of(key, speed)[0]
        return self.status[curve, place] == MISSING

    def _places_of(self, key: str, speed: float) -> list[tuple[int, int]]:
        """Return where a point is: (curve, place on it), of each curve that has it."""
        curves = self._curves[key]
        if self.plan.paired:
            return [(curve, 0) for curve in curves if self.plan.speeds_at(curve)[0] == speed]
        if not self.plan.chooses_speeds:
            return [(curve, self._places[speed]) for curve in curves]
        speeds = self._chosen.setdefault(key, [])
        if speed not in speeds:
            speeds.append(speed)
        return [(curve, speeds.index(speed)) for curve in curves]

    def index_of(self, key: str, speed: float) -> tuple[int, ...]:
        """Return where a point is in the arrays of the study: of the first curve that has it."""
        curve, place = self._places_of(key, speed)[0]
        along = tuple(map(int, np.unravel_index(curve, self.plan.curve_shape)))
        return along if self.plan.paired else (*along, place)

    def cut(self) -> tuple[dict[str, np.ndarray], np.ndarray, np.ndarray, np.ndarray]:
        """Return (columns, status, model, violations) in the shape of the study, without places that no curve used; a curve
        that has not ended has one place that is not computed."""
        if self.plan.chooses_speeds:
            for key, curves in self._curves.items():
                if key not in self.ended:
                    place = min(len(self._chosen.get(key, ())), self.width - 1)
                    self.status[curves, place] = MISSING
        used = 1 + int(np.flatnonzero((self.status != UNUSED).any(axis=0)).max(initial=0))
        shape = self.plan.curve_shape if self.plan.paired else (*self.plan.curve_shape, used)
        columns = {name: column[:, :used].reshape(shape) for name, column in self.columns.items()}
        status, model, violations = (
            each[:, :used].reshape(shape) for each in (self.status, self.model, self.violations)
        )
        return columns, status, model, violations
