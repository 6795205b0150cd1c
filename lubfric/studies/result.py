"""`study`: carry out a plan on any executor, keep it point by point, and read it back; its numbers, as arrays over what
was varied."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .._base import Renamed, Shown, validate, with_default_errors
from .._base.processes import checked_executor, checked_workers, pool, spread
from ..errors import InputError
from ..estimate import (
    PARTS,
    UNCERTAINTY_COLUMNS,
    MethodUse,
    Uncertainty,
    cited,
    inputs_to_quote,
    methods_of,
    shared_inputs,
    varied_to_quote,
)
from ..models import Model, models_up_to, prepare
from ..models.shared import Assumption, GatheredTexts, gathered_in_table, in_a_cell, is_by_sliding
from ..quantities import COLUMN_OF_ERROR, NUMBERS, counted
from ..scene import Scene, inputs_not_given
from .best import best, best_mean
from .interpolate import Interpolant, through
from .law import law_of_study
from .operating_points import DURATION, INTERVAL_COLUMNS, mean_over_cycle
from .plan import StudyPlan, plan_study, scenes_of
from .points import CONVERGED_COLUMN, MISSING, MODEL, SPEED, STATUS, UNUSED, VALIDITY, MapError, solved_together
from .store import PLAN, PLANNED, Store, digest, opened, point_key
from .study_lines import plot
from .study_table import StudyTable
from .tables import place_in_words, to_csv, to_frame, to_netcdf, to_parquet, to_xarray

PLAN_FIELDS = (
    "scene",
    "axes",
    "speeds",
    "keys",
    "point_speeds",
    "coordinates",
    "notes",
    "drawn",
)  # what is stored of it
# Columns of the uncertainty, which a study has even if no point of it is solved.
COLUMNS_OF_ERRORS = (*UNCERTAINTY_COLUMNS, *INTERVAL_COLUMNS["power_loss"])
# Errors of f whose tolerances a list names the points of.
OF_TOLERANCES = (Assumption.NUMERICAL_ERROR, Assumption.SAMPLING_ERROR, Assumption.MODEL_FORM_ERROR)
# Names of columns by those of version 0.2.0, which a study still takes.
OLD_COLUMNS = {f"uncertainty_{name}": column for name, column in COLUMN_OF_ERROR.items()} | {
    "uncertainty_low": "interval_low",
    "uncertainty_high": "interval_high",
    "uncertainty_tolerance": "sampling_tolerance",
}
# Points that a process of an executor receives at once, at most, and jobs that a study has at least where it has so
# many points. Choices: more points wait for longer, fewer cost messages; fewer jobs leave processes idle.
POINTS_AT_ONCE = 8
LEAST_JOBS = 64


@dataclass(frozen=True, repr=False, kw_only=True)
class StudyResult(Renamed, Shown):
    """Numbers of a study: arrays over the varied values and, last, the speed.

    ``result["coefficient"]`` is such an array, ``result.dims`` names its axes, ``result.coords`` holds the values along
    them. Where each curve chose its speeds, the last dimension is "point", ``result["speed"]`` is such an array too,
    and ``result.at(speeds)`` puts all curves on the same speeds. `to_xarray`, `to_frame`, `to_csv` and `to_parquet`
    make tables for other tools.

    Attributes
    ----------
    plan : what was studied, a `StudyPlan`
    columns : every number of a `FrictionResult` by name; NaN where a point failed
    status : "converged", "not needed" (a place of a curve that chose fewer speeds than another), or why a point has no
        numbers
    model : the name of the model that answered at a point; "" where none did
    violations : the assumptions that do not hold at a point, a tuple of `lubfric.Violation`. With ``numerics.accept``
        these mark the points that are no answers
    """

    plan: StudyPlan
    columns: dict[str, np.ndarray]
    status: np.ndarray
    model: np.ndarray
    violations: np.ndarray
    _RENAMED = {"cautioned": "with_warnings"}

    plot = plot
    best = best
    best_mean = best_mean
    law = law_of_study
    to_csv = to_csv
    to_frame = to_frame
    to_parquet = to_parquet
    to_xarray = to_xarray
    to_netcdf = to_netcdf

    @property
    def chosen(self) -> bool:
        """Whether each curve chose its own speeds."""
        return self.plan.chooses_speeds

    @property
    def paired(self) -> bool:
        """Whether the study has operating points, each with its own speed, instead of curves."""
        return self.plan.paired

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the axes of the arrays."""
        return self.plan.dims

    @property
    def coords(self) -> dict[str, tuple[str, np.ndarray]]:
        """{key: (dimension, values along it)} of every varied key and, unless chosen, the speed [m/s]."""
        return self.plan.coords

    @property
    def failures(self) -> tuple[str, ...]:
        """Why points could not be solved, one text for each of them."""
        return tuple(status for status in self.status.flat if status not in (CONVERGED_COLUMN, MISSING, UNUSED))

    @property
    def failed(self) -> int:
        """Number of points that could not be solved."""
        return len(self.failures)

    @property
    def solved(self) -> int:
        """Number of points that have been solved, or failed."""
        return int(np.count_nonzero(~np.isin(self.status, (MISSING, UNUSED))))

    @property
    def total_seconds(self) -> float:
        """Wall-clock time of all points together [s], each as it was solved, also by an earlier call; of identical
        points that of one."""
        (_, different) = np.unique(self.plan.keys, return_index=True)
        return float(np.nansum(self["seconds"].reshape(len(self.plan.keys), -1)[different]))

    @property
    def with_warnings(self) -> int:
        """Number of points at which an assumption does not hold; notes do not count."""
        return sum(any(not violation.is_note for violation in at_point) for at_point in self.violations.flat)

    @cached_property
    def validity(self) -> np.ndarray:
        """The assumptions that do not hold at each point, as text; "" where all hold."""
        texts = np.empty(self.violations.shape, dtype=object)
        for index in np.ndindex(*texts.shape):
            texts[index] = in_a_cell(self.violations[index])
        return texts

    @property
    def missing(self) -> int:
        """Number of points (of curves, if speeds are chosen) that an interrupted study has not reached."""
        return int(np.count_nonzero(self.status == MISSING))

    @cached_property
    def gathered(self) -> tuple[GatheredTexts, ...]:
        """One text for each assumption that does not hold somewhere, with the numbers of its points, from 1."""
        return tuple(gathered_in_table(self.violations[self.status != UNUSED].tolist()))

    def __getitem__(self, name: str) -> np.ndarray:
        if name in (STATUS, MODEL, VALIDITY):
            text: np.ndarray = getattr(self, name)
            return text
        name = OLD_COLUMNS.get(name, name)
        if name not in self.columns:
            raise InputError(f"a study has no column {name!r}{validate.nearest(name, self.columns)}; see .columns")
        return self.columns[name]

    def _facts(self) -> dict[str, str]:
        facts = {"": " x ".join(f"{n} {d}" for n, d in zip(self.status.shape, self.dims))}
        good = np.isfinite(self["coefficient"])
        if good.any():
            f = self["coefficient"][good]
            facts["f"] = f"{f.min():.4g} to {f.max():.4g}"
        unknown = int(np.isnan(self["interval_low"][good]).sum()) if "interval_low" in self.columns else 0
        if unknown:
            facts["without interval"] = str(unknown)
        counts = {"failed": self.failed, "not computed": self.missing, "with warnings": self.with_warnings}
        return facts | {name: str(count) for name, count in counts.items()}

    def speeds(self, index: tuple[int, ...]) -> np.ndarray:
        """Return the speeds [m/s] of the curve at one position along the axes."""
        if self.paired:
            return np.array(self.plan.point_speeds[index[-1]])
        return self.columns[SPEED][index] if self.chosen else np.array(self.plan.speeds)

    def at(self, speed: ArrayLike) -> np.ndarray:
        """Return f of every curve at ``speed`` [m/s], one or several, interpolated as in `StribeckResult.at`: an array
        over the axes and, for several speeds, over these. NaN outside the speeds for which a curve is known, and in the
        other direction."""
        self._check_curves()
        speeds = validate.array("speed", validate.listed(speed), "m/s", ndim=1)
        values = np.full((*self.status.shape[:-1], speeds.size), np.nan)
        for index in np.ndindex(*values.shape[:-1]):
            curve = self.curve(index)
            if curve is not None:
                inside = curve.within(speeds)
                values[index][inside] = curve.at(curve.sense * speeds[inside])
        return values[..., 0] if np.ndim(speed) == 0 else values

    @property
    def lift_off(self) -> np.ndarray:
        """The lift-off speed [m/s], over the axes and in the direction of the curves, above which the film separates
        the surfaces; NaN if a curve does not reach it, or if its speeds around it differ by more than a factor of 2."""
        self._check_curves()
        shape = self.status.shape[:-1]
        speeds = [np.nan if (curve := self.curve(i)) is None else curve.lifted for i in np.ndindex(*shape)]
        return np.array(speeds).reshape(shape)

    def place(self, index: tuple[int, ...]) -> str:
        """Return where a point lies, as text: the values of what is varied, and the speed."""
        speed = self.columns[SPEED][index] if self.chosen else self.plan.point_speed(index)
        return place_in_words(self.plan, index, float(speed))

    def mean(self, name: str) -> np.ndarray | float:
        """Return the mean of a number over the operating points, weighted by their ``duration`` (or all alike, if they
        have none): an array over the other axes. ``study.mean("power_loss")`` is the power loss of a duty cycle [W].
        NaN where a point that counts failed. In the mean of f no point counts at which f is that of rolling resistance
        (`is_by_sliding`)."""
        if not self.paired:
            raise InputError("mean is that over operating points; give points = a table")
        values = self[name]
        durations = self.plan.coordinates.get(DURATION)
        weights = np.ones(values.shape[-1]) if durations is None else np.array(durations)
        is_of_f = name in ("coefficient", *INTERVAL_COLUMNS["coefficient"])
        means = np.empty(values.shape[:-1])
        for index in np.ndindex(means.shape):
            counted = weights * self.counts_in_means(index) if is_of_f else weights
            means[index] = mean_over_cycle(values[index], counted)
        return float(means) if means.ndim == 0 else means

    def counts_in_means(self, index: tuple[int, ...] = ()) -> np.ndarray:
        """Return which operating points, (n,), count in means of f (`is_by_sliding`), at the ``index`` of the other
        axes."""
        return is_by_sliding({name: values[index] for name, values in self.columns.items()})

    def mean_interval(self, name: str) -> tuple[np.ndarray | float, np.ndarray | float]:
        """Return the ends of the 95 % interval of the `mean` of "coefficient" or "power_loss" over the operating
        points.

        The errors of the points are taken as fully correlated, as one model, one surface and one oil cause them: the
        ends are the means of the ends of the points. NaN where the interval of a point that counts is not known.
        """
        low, high = INTERVAL_COLUMNS[validate.choice("name", name, INTERVAL_COLUMNS)]
        return self.mean(low), self.mean(high)

    def cite(self, format: str = "text") -> str:
        """Return the papers behind what was used for this study, the model's first: one a line, or with ``format``
        "bibtex" as BibTeX entries, or "methods" as a paragraph. Nothing is cited where no point is solved."""
        if not np.isfinite(self["coefficient"]).any():
            return ""
        solved = np.isfinite(self["coefficient"])
        first = int(np.argmax(solved.reshape(len(self.plan.keys), -1).any(axis=1)))
        prepared = prepare(self.plan.scenes[first])
        points_by_model = Counter(self.model[solved].tolist())
        all_models = models_up_to("auto")
        models = [model for model in all_models if model.name in points_by_model]
        control = all_models[:1] if any(m.takes_control(prepared.scene, prepared.sample) for m in models) else []
        uses = [self._use(model) for model in (*models, *control)]
        names = dict.fromkeys(name for use in uses for name in methods_of(prepared, use))
        roughness = [(scene.surface, scene.counterface) for scene in self.plan.scenes]
        is_alike = all(pair == roughness[0] for pair in roughness)
        maps = prepared.sample.maps_before_extension if is_alike else ()
        is_sampled = bool(np.isfinite(self["sampling_error"]).any())
        by_film = any(answers.takes_boundary_film for answers in models)
        texts = [
            inputs_to_quote(scene, maps, has_sampling_error=is_sampled, takes_boundary_film=by_film)
            for scene in self.plan.scenes
        ]
        inputs = shared_inputs(texts)
        varied = [varied_to_quote(key, values.tolist()) for key, (_, values) in self.coords.items()]
        drawn = [self.plan.drawn] if self.plan.drawn else []
        points = [counted(int(solved.sum()), "points")]
        return cited(
            names,
            format,
            errors=self._uncertainties(),
            inputs=[*inputs, *varied, *drawn, *points],
            points_by_model=points_by_model,
        )

    def _uncertainties(self) -> list[Uncertainty]:
        """Return what the columns keep of the uncertainty of f at each solved point."""
        columns: dict[str, Any] = {name: np.ravel(self.columns[column]) for name, column in COLUMN_OF_ERROR.items()}
        f = np.ravel(self["coefficient"])
        ends = np.stack([np.ravel(self["interval_low"]), np.ravel(self["interval_high"])], axis=-1).tolist()
        scene = self.plan.scene
        sides: dict[str, Any] = {
            part.sides: [np.ravel(self.columns[f"{COLUMN_OF_ERROR[part.quantity]}_{end}"]) for end in ("low", "high")]
            for part in PARTS.values()
            if part.sides and f"{COLUMN_OF_ERROR[part.quantity]}_low" in self.columns
        }

        def errors_of(i: int) -> dict[str, Any]:
            both = {name: (low[i].item(), high[i].item()) for name, (low, high) in sides.items()}
            return {name: values[i].item() for name, values in columns.items()} | both

        return [
            Uncertainty(
                coefficient=float(f[i]),
                interval=(ends[i][0], ends[i][1]),
                missing_input=next(iter(inputs_not_given(scene)), ""),
                inputs_in_interval=tuple(name for name, *_ in scene.ranges),
                **errors_of(i),
            )
            for i in np.flatnonzero(np.isfinite(f)).tolist()
        ]

    def _use(self, model: Model) -> MethodUse:
        """Return what the columns show of the methods that the study uses, where ``model`` answers."""

        def above(name: str, limit: float = 0.0) -> bool:
            return bool((self.columns.get(name, np.zeros(1)) > limit).any())

        factor = self.columns.get("inlet_film_factor", np.ones(1))
        return MethodUse(
            model=model,
            has_contact=above("contact_load"),
            has_film=above("film_load"),
            slides=bool((self.columns.get("couette_force", np.zeros(1)) != 0).any()),
            is_sampled=above("sampling_error"),
            has_inlet_heat=bool((factor < 1).any()),
            has_film_heat=above("film_temperature_rise"),
            has_flash=above("flash_temperature_rise"),
        )

    def _check_curves(self) -> None:
        if self.paired:
            raise InputError("this study has operating points and no curves; give speeds instead of points")

    def curve(self, index: tuple[int, ...]) -> Interpolant | None:
        """Return the curve at one position along the axes, or None if fewer than three of its points are solved, if
        they run both ways, or if no curve goes through their numbers, as those of a store that somebody changed."""
        if self.paired:
            return None
        numbers = {name: values[index] for name, values in self.columns.items()} | {SPEED: self.speeds(index)}
        try:
            interpolant = through(numbers)
            s = interpolant.samples
            return interpolant if np.allclose(interpolant.at(s.speed), s.boundary + s.film, rtol=1e-2) else None
        except ValueError:  # InputError, or that of an interpolation
            return None


@with_default_errors
def study(
    scene: Scene | StudyPlan,
    vary: Mapping[Any, Any] | None = None,
    speeds: str | ArrayLike | None = None,
    *,
    points: Any = None,
    executor: Any = None,
    store: str | Path | None = None,
    on_progress: Callable[..., Any] | None = None,
    on_point: Callable[..., Any] | None = None,
    workers: int = 1,
) -> StudyResult:
    """Solve the friction of a scene at every combination of given values, and at every entrainment speed or operating
    point.

    Every point is solved from its scene alone, to the same bits on every executor. A point that fails is a row with
    its error as its status; the others are solved.

    Parameters
    ----------
    scene : from `lubfric.load_scene`; or a plan from `lubfric.plan_study`, whose ``explain()`` reports points and cost
    vary : {"section.key": [values]}, any key of a scene; {("section.key", "other.key"): [(value, value), ...]} for
        keys that change together (`lubfric.sample` makes random and Sobol samples of them); {"surface": [{...},
        {...}]} for complete sections, such as several height maps
    speeds : entrainment speeds [m/s]; None: those of the scene; "auto": each curve chooses its own, as in
        `lubfric.stribeck`, and the result has a dimension "point" instead of "speed"
    points : a table of operating points in place of speeds: a file, a list of rows, a dict of columns or a DataFrame
        with load, radius, speed (or u1 and u2), slide_roll_ratio (or sliding_speed), temperature, or any key of a
        scene; also position, angle, time and duration, which change no number (`lubfric.studies.operating_points`).
        The result has a dimension "point", and no "speed"; ``vary`` adds dimensions
    executor : None, a ``dask.distributed.Client``, or any `concurrent.futures.Executor` (a process pool,
        ``mpi4py.futures.MPIPoolExecutor``)
    store : folder that receives every finished point at once. The same study, or a longer one, continues from there
        and computes nothing twice. Workers that do not see it send their points to this process, which keeps them
    on_progress : called as on_progress(done, total) when points (with "auto": curves) have ended
    on_point : called as on_point(done, total, index, outcome) when a point is solved: ``index`` is its place in the
        arrays of the result, ``outcome`` its `FrictionResult` or the exception. Points that ``store`` has are not among
        them
    workers : processes of this machine that share the points, instead of an executor. A script that requests more than
        one needs ``if __name__ == "__main__":``

    Returns
    -------
    StudyResult

    Raises
    ------
    InputError : before any work

    Faults of the program are raised unchanged.
    """
    validate.called_back("on_progress", on_progress, "done, total")
    validate.called_back("on_point", on_point, "done, total, index, outcome")
    plan = scene if isinstance(scene, StudyPlan) else plan_study(scene, vary, speeds, points)
    if plan is scene and any(given is not None for given in (vary, speeds, points)):
        raise InputError("vary, speeds and points belong to the plan; give a scene with them, or a plan alone")
    executor = checked_executor(executor)
    if checked_workers(workers, executor) > 1:
        with pool(workers) as processes:
            return study(plan, executor=processes, store=store, on_progress=on_progress, on_point=on_point)
    with opened(store) as kept:
        kept.add(PLAN, tuple(getattr(plan, name) for name in PLAN_FIELDS))
        return result_of_table(_carried_out(plan, executor, kept, on_progress, on_point))


def _carried_out(
    plan: StudyPlan,
    executor: Any,
    store: Store,
    on_progress: Callable[..., Any] | None,
    on_point: Callable[..., Any] | None,
) -> StudyTable:
    """Return the table of all points of a plan, those in the ``store`` and those that are solved now."""
    table = StudyTable(plan)
    table.read(store)
    total = len(plan.requested) if plan.chooses_speeds else sum(map(len, plan.requested.values()))

    def done() -> int:
        return len(table.ended) if plan.chooses_speeds else table.solved

    def report() -> None:
        if on_progress:
            on_progress(done(), total)

    report()
    left = list(table.left())
    at_once = min(POINTS_AT_ONCE, max(1, sum(len(speeds) for _, _, speeds in left) // LEAST_JOBS))
    jobs = _jobs(plan, left, store, at_once if executor is not None else None)
    if plan.chooses_speeds:  # points of a curve come again, in the order in which they were chosen
        for key in {*plan.keys} - table.ended:
            table.forget(key)
    for key, speed, outcome in spread(executor, jobs):
        if outcome is None:
            table.end(key)
            _keep(store, digest(key), (table.chosen(key), True))
        else:
            table.put(key, speed, outcome)
            if not isinstance(outcome, MapError):
                _keep(store, point_key(key, speed), outcome)
        if outcome is None or not plan.chooses_speeds:
            report()
        if on_point and outcome is not None:
            on_point(done(), total, table.index_of(key, speed), outcome)
    return table


def _jobs(
    plan: StudyPlan, left: list[Any], store: Store, together: int | None
) -> Iterator[Callable[[], Iterator[Any]]]:
    """Yield the jobs of what is ``left`` to solve (`StudyTable.left`), with at most so many points ``together``; None:
    a curve each, done here."""
    scenes = enumerate(scenes_of(plan.scene, plan.axes))
    tasks: list[tuple[Scene, str, tuple[float, ...]]] = []
    count = 0
    for curve, key, speeds in sorted(left):
        scene = next(scene for place, scene in scenes if place == curve)
        size = together or max(len(speeds), 1)
        for batch in [speeds[i : i + size] for i in range(0, len(speeds), size)] or [()]:
            tasks.append((scene, key, batch))
            count += len(batch) or size
            if count >= size:
                yield partial(solved_together, tuple(tasks), store.root)
                tasks = []
                count = 0
    if tasks:
        yield partial(solved_together, tuple(tasks), store.root)


def _keep(store: Store, key: str, record: Any) -> None:
    """Keep a ``record`` that a worker could not, as it does not see the folder of the store."""
    if not store.has(key):
        store.add(key, record)


def result_of_table(table: StudyTable) -> StudyResult:
    """Return the result of a ``table``."""
    columns, status, model, violations = table.cut()
    names = [name for name in NUMBERS if name in columns or name != SPEED or table.plan.chooses_speeds]
    names += [name for name in COLUMNS_OF_ERRORS if name not in names]
    missing = np.full(status.shape, np.nan)
    ordered = {name: columns.get(name, missing) for name in names}
    kept = _without_notes_of_rolling(ordered | columns, violations)
    return StudyResult(plan=table.plan, columns=ordered | columns, status=status, model=model, violations=kept)


def _without_notes_of_rolling(columns: dict[str, np.ndarray], violations: np.ndarray) -> np.ndarray:
    """Return ``violations`` without notes on relative errors of f where rolling resistance makes most of f
    (`is_by_sliding`): no relative error counts there."""
    kept = violations.copy()
    for index in np.argwhere(~is_by_sliding(columns)).tolist():
        at_point = violations[tuple(index)]
        kept[tuple(index)] = tuple(each for each in at_point if not (each.is_note and each.assumption in OF_TOLERANCES))
    return kept


def has_study(folder: str | Path) -> bool:
    """Return whether ``folder`` has the plan of a study, finished or not."""
    return Store(folder).has(PLAN)


@with_default_errors
def open_study(folder: str | Path) -> StudyResult:
    """Read the result of a study from its folder, whether it is finished or not.

    Parameters
    ----------
    folder : the ``store`` of `lubfric.study`, or the folder of ``lubfric study``

    Returns
    -------
    StudyResult : points that are still to come have the status "not computed"

    Raises
    ------
    InputError : the folder holds no study
    """
    store = Store(validate.folder("store", folder))
    stored = store.get(PLAN, PLANNED)
    plan = None if stored is None else StudyPlan(**dict(zip(PLAN_FIELDS, stored)))
    if plan is None or len(plan.keys) != math.prod(plan.curve_shape):
        recommendation = "give the folder of one, or run the study again in this folder, which writes its plan anew"
        raise InputError(f"{folder} has no study, or its plan is damaged; {recommendation}")
    table = StudyTable(plan)
    table.read(store)
    return result_of_table(table)
