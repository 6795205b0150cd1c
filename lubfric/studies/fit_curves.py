"""Computed curves of a fit: f at the measured points for any values of the parameters, each curve computed once."""

import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from .._base.processes import spread
from .._base.progress import report_progress
from ..errors import LubfricError
from ..estimate import FrictionResult
from ..models import prepare
from ..models.shared import Prepared
from ..scene import BOUNDARY_FRICTION_KEY, Scene
from .curve import without_rolling
from .explain import curve_seconds, traction_seconds
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

# Points of a curve of the coarse search: enough to tell where in the bounds a minimum lies. A choice: a larger value
# takes longer.
COARSE_POINTS = 8

# Tolerances of the coarse search over those of the fit, and the largest tolerance on f. A choice, for time.
COARSER = 4.0
COARSEST_TOLERANCE = 0.05

# Sampling tolerance of the coarse search: that of the first strips, whatever it is. A choice: a smaller value takes
# longer.
COARSE_SAMPLING = 0.5


class FitCurves:
    """Curves of ``scene`` at the points of ``measured``, for positions of ``parameters`` between their bounds.

    A position ``unit`` (p,) is 0 at the lower and 1 at the upper bound of each parameter. ``on_curve`` is called
    without arguments after every curve that was solved.

    A curve that differs from a solved one in f_b alone is not solved: at a given division of the load f is linear in
    f_b, as in the range of f_b of a point (`lubfric.estimate.ranges`). Where heat, or the calibration of the quick
    model, changes with f_b, it is so to first order, and `solve` shows the difference.
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
        self.linear_place = linear_place(scene, parameters)
        self.solves_differences = False  # whether a curve is one of the differences of the slopes
        self.expected = 0  # curves that will be solved, about, with those that are
        self._executor = executor
        self._folder = folder
        self._curves: dict[bytes, tuple[FrictionResult, ...]] = {}
        self._slopes_at = np.full(len(parameters), np.inf)
        self._slopes = np.empty((0, 0))
        self._prepared: Prepared | None = None

    @property
    def solved(self) -> list[np.ndarray]:
        """The positions of the curves that were solved, each (p,), in their order."""
        return [np.frombuffer(key) for key in self._curves]

    @property
    def count(self) -> int:
        """Number of curves that were solved."""
        return len(self._curves)

    @property
    def changed(self) -> int:
        """Number of the parameters whose change takes a solve."""
        return len(self.parameters) - (self.linear_place is not None)

    @property
    def has_executor(self) -> bool:
        """Whether points are solved by a given executor."""
        return self._executor is not None

    @property
    def spent(self) -> float:
        """Seconds that the points of these curves took."""
        return sum(point.seconds for curve in self._curves.values() for point in curve)

    def is_solved(self, unit: np.ndarray) -> bool:
        """Return whether the curve at ``unit`` is solved."""
        return unit.tobytes() in self._curves

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
            outcomes = {}
            for key, u, outcome in spread(self._executor, jobs):
                outcomes[key, u] = outcome
                if len(outcomes) < len(jobs):
                    report_progress("points of this curve", len(outcomes), len(jobs))
            points = tuple(outcomes[key, u] for _, key, u in places)
            for failure in (outcome for outcome in points if isinstance(outcome, LubfricError)):
                raise failure
            self._curves[unit.tobytes()] = points
            self.on_curve()
        return self._curves[unit.tobytes()]

    def coefficient(self, unit: np.ndarray) -> np.ndarray:
        """Return f (n,), with or without the rolling part of the film's force, as was measured; from the nearest solved
        curve that differs in f_b alone, if there is one."""
        known = self._known_balance(unit)
        if known is None:
            return self._measured_part(self.points(unit))
        f = self._measured_part(self.points(known))
        if known is unit:
            return f
        change = self._boundary_friction(unit) - self._boundary_friction(known)
        return f + change * self._per_boundary_friction(known)

    def lowest_over_boundary_friction(self, unit: np.ndarray) -> np.ndarray:
        """Return ``unit`` with the f_b of the least sum of squares, at the balances of the curve there; ``unit`` itself
        where f does not change with f_b, or f_b is no parameter."""
        place = self.linear_place
        known = self._known_balance(unit)
        if place is None or known is None or self._boundary_friction(known) == 0.0:
            return unit
        per_friction = self._per_boundary_friction(known) / self.measured.scale
        if not np.any(per_friction):
            return unit
        change = -float(per_friction @ self.residuals(unit)) / float(per_friction @ per_friction)
        bounds = list(self.parameters.values())[place]
        value = min(max(self._boundary_friction(unit) + change, bounds.low), bounds.high)
        moved = unit.copy()
        moved[place] = bounds.share(value)
        return moved

    def _measured_part(self, points: tuple[FrictionResult, ...]) -> np.ndarray:
        """Return f of ``points`` (n,), with or without the rolling part of the film's force, as was measured."""
        if self.measured.rolling:
            return np.array([point.coefficient for point in points])
        ratio = self.scene.motion.slide_roll_ratio
        ratios = np.full(len(points), ratio) if self.measured.over == SPEED else self.measured.x
        return np.array([without_rolling(*pair) for pair in zip(points, ratios)])

    def _boundary_friction(self, unit: np.ndarray) -> float:
        """Return f_b at ``unit``, a parameter."""
        return values_at(self.parameters, unit)[BOUNDARY_FRICTION_KEY]

    def _per_boundary_friction(self, unit: np.ndarray) -> np.ndarray:
        """Return df/df_b (n,) of the solved curve at ``unit``, whose f_b is above 0: the part of the load with the
        stress f_b p."""
        per_load = [point.boundary_force / (point.contact_load + point.film_load) for point in self.points(unit)]
        return np.array(per_load) / self._boundary_friction(unit)

    def _known_balance(self, unit: np.ndarray) -> np.ndarray | None:
        """Return ``unit`` if the curve there is solved, else the position of the nearest solved curve that differs in
        f_b alone; None: there is none."""
        if self.is_solved(unit):
            return unit
        place = self.linear_place
        if place is None:
            return None
        others = np.delete(unit, place)
        alike = [
            solved
            for solved in self.solved
            if np.array_equal(np.delete(solved, place), others) and self._boundary_friction(solved) > 0.0
        ]
        return min(alike, key=lambda solved: abs(solved[place] - unit[place]), default=None)

    def residuals(self, unit: np.ndarray) -> np.ndarray:
        """Return computed minus measured f over the scale of the measured points, (n,)."""
        return (self.coefficient(unit) - self.measured.coefficient) / self.measured.scale

    def misfit(self, unit: np.ndarray) -> float:
        """Return the root mean square of the residuals: relative to f, or in deviations where these are stated."""
        return float(np.sqrt(np.mean(self.residuals(unit) ** 2)))

    def slopes(self, unit: np.ndarray) -> np.ndarray:
        """Return df/d(unit), (n, p): by f_b at the balances of the curve, by the others from differences over
        `PARAMETER_STEP`. Differences at most that far away are used unchanged."""
        if np.abs(unit - self._slopes_at).max() > PARAMETER_STEP:
            self.solves_differences = True
            columns = []
            for i in range(unit.size):
                moved = unit.copy()
                moved[i] += PARAMETER_STEP if moved[i] + PARAMETER_STEP <= 1.0 else -PARAMETER_STEP  # within the bounds
                columns.append((self.coefficient(moved) - self.coefficient(unit)) / (moved[i] - unit[i]))
            self._slopes_at = unit.copy()
            self._slopes = np.stack(columns, axis=1)
            self.solves_differences = False
        place = self.linear_place
        known = self._known_balance(unit)
        if place is None or known is None or self._boundary_friction(known) == 0.0:
            return self._slopes
        slopes = self._slopes.copy()
        slopes[:, place] = self._per_boundary_friction(known) * list(self.parameters.values())[place].slope(unit[place])
        return slopes

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
        """Return the estimated processor seconds of the curve at ``unit``, with those of its map unless it is the
        last."""
        last = self._prepared
        begun = time.process_time()
        prepared = self.prepared(unit)
        seconds = time.process_time() - begun
        has_new_map = last is None or prepared.sample is not last.sample
        x = self.measured.x.tolist()
        if self.measured.over == SPEED:
            return seconds + curve_seconds(prepared, x, has_new_map=has_new_map)
        speed = prepared.scene.motion.entrainment_speed
        return seconds + traction_seconds(at_ratios(prepared, x), speed, has_new_map=has_new_map)


def linear_place(scene: Scene, parameters: dict[str, Between]) -> int | None:
    """Return the place of f_b among the ``parameters`` if f is linear in it at a given division of the load; None: it
    is no parameter, or bounds the stress of the film as well."""
    if BOUNDARY_FRICTION_KEY not in parameters or scene.lubricant.is_limited_by_boundary_friction:
        return None
    return list(parameters).index(BOUNDARY_FRICTION_KEY)


def fit_tolerance(scene: Scene, measured: Measured) -> float:
    """Return the relative tolerance on f that a fit solves to, to two digits: small compared with the scatter of the
    data."""
    stated = measured.deviation is not None
    scatter = float(np.median(measured.scale / np.abs(measured.coefficient))) if stated else USUAL_SCATTER
    by_scatter = float(f"{max(SHARE_OF_SCATTER * scatter, TIGHTEST):.2g}")
    return min(scene.numerics.tolerance, by_scatter)


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
