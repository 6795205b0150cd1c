"""Computed curves of a fit: f at the measured points for any values of the parameters, each curve computed once."""

import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from .._base.processes import spread
from ..errors import LubfricError
from ..estimate import FrictionResult
from ..models import prepare
from ..models.shared import Prepared
from ..scene import Scene
from .curve import without_rolling
from .explain import curve_seconds
from .fit_input import SPEED, Measured, values_at
from .points import at_ratios, key_of, solved
from .vary import Between

# Relative scatter of data whose deviations are not stated, by which the tolerance of the solves is chosen.
USUAL_SCATTER = 0.05

# Numerical error of f over the scatter of the data: small beside it, and no smaller than needed. A choice: added by
# squares it is 2 %.
SHARE_OF_SCATTER = 0.2

# Smallest relative tolerance on f that a fit solves to. A choice, for time.
TIGHTEST = 1e-3

# Step of the differences, as a share of the bounds: its effect on f stays above the tolerance of the solves. A choice:
# more bends over it.
PARAMETER_STEP = 0.04

# Points of a curve of the coarse search: enough to tell where in the bounds a minimum lies. A choice: more takes
# longer.
COARSE_POINTS = 8

# Tolerances of the coarse search over those of the fit, and the largest tolerance on f. A choice, for time.
COARSER = 4.0
COARSEST_TOLERANCE = 0.05

# Sampling tolerance of the coarse search: that of the first strips, whatever it is. A choice: less takes longer.
COARSE_SAMPLING = 0.5


class FitCurves:
    """Curves of ``scene`` at the points of ``measured``, for positions of ``parameters`` between their bounds.

    A position ``unit`` (p,) is 0 at the lower and 1 at the upper bound of each parameter. ``on_curve`` is called
    without arguments after every curve that was computed.
    """

    def __init__(
        self,
        scene: Scene,
        measured: Measured,
        parameters: dict[str, Between],
        executor: Any = None,
        folder: str | Path | None = None,
    ):
        self.scene = scene
        self.measured = measured
        self.parameters = parameters
        self.tolerance = scene.numerics.tolerance
        self.on_curve: Callable[[], None] = lambda: None
        self._executor = executor
        self._folder = folder
        self._curves: dict[bytes, tuple[FrictionResult, ...]] = {}
        self._slopes_at = np.full(len(parameters), np.inf)
        self._slopes = np.empty((0, 0))
        self._prepared: Prepared | None = None

    @property
    def last(self) -> np.ndarray:
        """The position of the curve that was computed last, (p,)."""
        return np.frombuffer(list(self._curves)[-1])

    @property
    def count(self) -> int:
        """Number of curves that were computed."""
        return len(self._curves)

    @property
    def spent(self) -> float:
        """Seconds that the points of these curves took."""
        return sum(point.seconds for curve in self._curves.values() for point in curve)

    def points(self, unit: np.ndarray) -> tuple[FrictionResult, ...]:
        """Return the points of the curve at ``unit``. Raises the `LubfricError` of a point that fails."""
        if unit.tobytes() not in self._curves:
            prepared = self.prepared(unit)
            x = self.measured.x.tolist()
            if self.measured.over == SPEED:
                key = key_of(prepared)
                places = [(prepared, key, speed) for speed in x]
            else:
                speed = prepared.scene.motion.entrainment_speed
                places = [(model, key_of(model), speed) for model in at_ratios(prepared, x)]
            once = {(key, u): model for model, key, u in places}  # ramps may have points at one speed
            jobs = [partial(solved, model, key, (u,), folder=self._folder) for (key, u), model in once.items()]
            outcomes = {(key, u): outcome for key, u, outcome in spread(self._executor, jobs)}
            points = tuple(outcomes[key, u] for _, key, u in places)
            for failure in (outcome for outcome in points if isinstance(outcome, LubfricError)):
                raise failure
            self._curves[unit.tobytes()] = points
            self.on_curve()
        return self._curves[unit.tobytes()]

    def coefficient(self, unit: np.ndarray) -> np.ndarray:
        """Return f (n,), with or without the rolling part of the film's force, as was measured."""
        points = self.points(unit)
        return np.array([p.coefficient if self.measured.rolling else without_rolling(p) for p in points])

    def residuals(self, unit: np.ndarray) -> np.ndarray:
        """Return computed minus measured f over the scale of the measured points, (n,)."""
        return (self.coefficient(unit) - self.measured.coefficient) / self.measured.scale

    def misfit(self, unit: np.ndarray) -> float:
        """Return the root mean square of the residuals: relative to f, or in deviations where these are stated."""
        return float(np.sqrt(np.mean(self.residuals(unit) ** 2)))

    def slopes(self, unit: np.ndarray) -> np.ndarray:
        """Return df/d(unit), (n, p), by differences over `PARAMETER_STEP`. Slopes at most that far away are used unchanged."""
        if np.abs(unit - self._slopes_at).max() <= PARAMETER_STEP:
            return self._slopes
        columns = []
        for i in range(unit.size):
            moved = unit.copy()
            moved[i] += PARAMETER_STEP if moved[i] + PARAMETER_STEP <= 1.0 else -PARAMETER_STEP  # within the bounds
            columns.append((self.coefficient(moved) - self.coefficient(unit)) / (moved[i] - unit[i]))
        self._slopes_at = unit.copy()
        self._slopes = np.stack(columns, axis=1)
        return self._slopes

    def forget_slopes(self) -> None:
        """Compute the slopes anew, also near a position where they are known: beside an edge of f they differ."""
        self._slopes_at = np.full(len(self.parameters), np.inf)

    def prepared(self, unit: np.ndarray) -> Prepared:
        """Return the scene at ``unit``, made ready, with the map of the last one where that is the same."""
        scene = self.scene.with_keys(values_at(self.parameters, np.clip(unit, 0.0, 1.0)))
        last = self._prepared
        maps = [(s.surface, s.counterface, s.contact, s.bodies.e_prime) for s in (scene, last.scene if last else scene)]
        self._prepared = prepare(scene, like=last if maps[0] == maps[1] else None)
        return self._prepared

    def estimated_seconds(self, unit: np.ndarray) -> float:
        """Return the estimated processor seconds of the curve at ``unit``, with those of its map unless it is the last."""
        last = self._prepared
        begun = time.process_time()
        prepared = self.prepared(unit)
        seconds = time.process_time() - begun
        has_new_map = last is None or prepared.sample is not last.sample
        x = self.measured.x.tolist()
        if self.measured.over == SPEED:
            return seconds + curve_seconds(prepared, x, has_new_map=has_new_map)
        speed = [prepared.scene.motion.entrainment_speed]
        return seconds + sum(curve_seconds(model, speed, has_new_map=False) for model in at_ratios(prepared, x))


def fit_tolerance(scene: Scene, measured: Measured) -> float:
    """Return the relative tolerance on f that a fit solves to: small compared with the scatter of the data."""
    stated = measured.deviation is not None
    scatter = float(np.median(measured.scale / np.abs(measured.coefficient))) if stated else USUAL_SCATTER
    return min(scene.numerics.tolerance, max(SHARE_OF_SCATTER * scatter, TIGHTEST))


def coarse_scene(scene: Scene) -> Scene:
    """Return ``scene`` by the load-sharing model, on the first strips of its surface, with loose tolerances. Points
    that the model would refuse count as well: the search only compares them."""
    tolerance = scene.numerics.tolerance
    loose = {
        "model": "paper",
        "tolerance": max(tolerance, min(COARSER * tolerance, COARSEST_TOLERANCE)),
        "sampling_tolerance": COARSE_SAMPLING,
        "accept": True,
    }
    return scene.with_(numerics=loose)


def coarse_measured(measured: Measured) -> Measured:
    """Return at most `COARSE_POINTS` of the measured points, spread evenly over their order."""
    order = np.argsort(measured.x)
    kept = order[np.unique(np.linspace(0, order.size - 1, COARSE_POINTS).round().astype(int))]
    return Measured(
        x=measured.x[kept],
        coefficient=measured.coefficient[kept],
        deviation=None if measured.deviation is None else measured.deviation[kept],
        over=measured.over,
        source=measured.source,
        rolling=measured.rolling,
        branch=None if measured.branch is None else measured.branch[kept],
    )
