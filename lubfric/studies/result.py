"""The numbers of a study, as arrays over what was varied."""

from __future__ import annotations

import json
from dataclasses import dataclass, is_dataclass

import numpy as np

from .._base import Shown, __version__, plain, validate
from ..errors import InputError
from ..quantities import QUANTITIES
from ..scene import scene_as_dict
from .adaptive import AUTO, FEWEST, samples_at
from .interpolate import Interpolant, knee_of
from .journal import SPEED, Journal
from .table_row import CONVERGED, MISSING, STATUS, UNUSED, VALIDITY, row_of
from .walk import chosen_keys

PLAN = "study.json"
POINT = "point"  # the last dimension where speeds are chosen


@dataclass(frozen=True, repr=False)
class StudyResult(Shown):
    """Numbers of a study: arrays over the varied values and, last, the speed.

    ``result["coefficient"]`` is such an array, ``result.dims`` names its axes, ``result.coords`` holds the values along
    them. Where each curve chose its speeds, the last dimension is "point", ``result["speed"]`` is such an array too,
    and ``result.at(speeds)`` puts all curves on the same speeds. `to_xarray`, `to_frame`, `to_csv` and `to_parquet`
    make tables for other tools.

    Attributes
    ----------
    plan : what was studied, as in study.json
    columns : every number of a `FrictionResult` by name; NaN where a point failed
    status : "converged", "not needed" (a place of a curve that chose fewer speeds than another), or why a point has no
        numbers
    validity : the assumptions that do not hold at a point, in words; "" where all hold. With ``numerics.accept`` this
        marks the points that are no answers
    """

    plan: dict
    columns: dict[str, np.ndarray]
    status: np.ndarray
    validity: np.ndarray

    @classmethod
    def of_rows(cls, plan: dict, rows: dict[str, dict]) -> StudyResult:
        """The result of the ``rows`` (`row_of`) by key, as a plan puts them in order."""
        shape = tuple(plan["shape"])
        size = int(np.prod(shape))
        columns = {name: np.full(size, np.nan) for name in QUANTITIES}
        chosen = plan["speeds"] == AUTO
        if chosen:
            columns = {SPEED: np.full(size, np.nan), **columns}
        validity = np.full(size, "", dtype=object)
        placed, status = (_on_curves if chosen else _on_speeds)(plan, rows)
        for at, row in placed:
            for name, value in row.items():
                if name == STATUS:
                    status[at] = value
                elif name == VALIDITY:
                    validity[at] = value
                elif chosen or name != SPEED:
                    columns.setdefault(name, np.full(size, np.nan))[at] = value
        status = status.reshape(shape)
        most = 1 + int(np.flatnonzero((status != UNUSED).any(axis=tuple(range(status.ndim - 1)))).max(initial=0))
        cut = {name: column.reshape(shape)[..., :most] for name, column in columns.items()}
        return cls(plan, cut, status[..., :most], validity.reshape(shape)[..., :most])

    @property
    def chosen(self) -> bool:
        """Whether each curve chose its own speeds."""
        return self.plan["speeds"] == AUTO

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the axes of the arrays."""
        return (*(axis["name"] for axis in self.plan["axes"]), POINT if self.chosen else SPEED)

    @property
    def coords(self) -> dict[str, tuple[str, np.ndarray]]:
        """{key: (dimension, values along it)} of every varied key and, unless chosen, the speed [m/s]."""
        found = {}
        for axis in self.plan["axes"]:
            for i, key in enumerate(axis["keys"]):
                found[key] = (axis["name"], _column([row[i] for row in axis["values"]]))
        return found if self.chosen else found | {SPEED: (SPEED, np.array(self.plan["speeds"]))}

    @property
    def failed(self) -> int:
        """Number of points that could not be solved."""
        return int(np.count_nonzero(~np.isin(self.status, (CONVERGED, MISSING, UNUSED))))

    @property
    def solved(self) -> int:
        """Number of points that have been solved, or failed."""
        return int(np.count_nonzero(~np.isin(self.status, (MISSING, UNUSED))))

    @property
    def cautioned(self) -> int:
        """Number of points at which an assumption does not hold."""
        return int(np.count_nonzero(self.validity != ""))

    @property
    def missing(self) -> int:
        """Number of points (of curves, if speeds are chosen) that an interrupted study has not reached."""
        return int(np.count_nonzero(self.status == MISSING))

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self.columns:
            raise InputError(f"a study has no column {name!r}{validate.nearest(name, self.columns)}; see .columns")
        return self.columns[name]

    def _facts(self) -> dict[str, str]:
        facts = {"": " x ".join(f"{n} {d}" for n, d in zip(self.status.shape, self.dims))}
        good = np.isfinite(self["coefficient"])
        if good.any():
            f = self["coefficient"][good]
            facts["f"] = f"{f.min():.4g} to {f.max():.4g}"
        counts = {"failed": self.failed, "not computed": self.missing, "with cautions": self.cautioned}
        return facts | {name: str(count) for name, count in counts.items()}

    def plot(self, ax=None, **style):
        """f over speed, a line for each curve (at most 50 of them, evenly picked), on ``ax`` or new axes, which are
        returned; ``style``: of the lines."""
        from .draw import curves_axes

        return curves_axes(self, ax, **style)

    def at(self, speed) -> np.ndarray:
        """f of every curve at ``speed`` [m/s], one or several, interpolated as in `StribeckResult.at`: an array over
        the axes and, for several speeds, over these. NaN outside the speeds for which a curve is known, and in the
        other direction."""
        speeds = validate.array("speed", validate.listed(speed), "m/s", ndim=1)
        sense = self._sense
        found = np.full((*self.status.shape[:-1], speeds.size), np.nan)
        for index in np.ndindex(*found.shape[:-1]):
            curve = self.curve(index)
            if curve is not None:
                known, at = curve.samples.speed, sense * speeds
                inside = (at >= known[0] * (1 - 1e-9)) & (at <= known[-1] * (1 + 1e-9))
                found[index][inside] = curve.at(at[inside])
        return found[..., 0] if np.ndim(speed) == 0 else found

    @property
    def lift_off(self) -> np.ndarray:
        """The speed [m/s], over the axes and in the direction of the curves, at which the film lifts the surfaces off
        each other; NaN if a curve does not reach it."""
        found = np.full(self.status.shape[:-1], np.nan)
        for index in np.ndindex(*found.shape):
            curve = self.curve(index)
            if curve is not None and curve.lift_off is not None:
                found[index] = self._sense * curve.lift_off
        return found

    @property
    def _sense(self) -> float:
        """The sign of the speeds, where they run one way."""
        return -1.0 if not self.chosen and self.coords[SPEED][1].min() < 0 else 1.0

    def curve(self, index: tuple[int, ...]) -> Interpolant | None:
        """The curve at one position along the axes, or None if fewer than three of its points are solved, or if they
        run both ways."""
        columns = {name: values[index] for name, values in self.columns.items()}
        signed = columns[SPEED] if self.chosen else self.coords[SPEED][1]
        speed = np.abs(signed)
        if (signed < 0).any() and (signed > 0).any():
            return None
        good = np.flatnonzero(np.isfinite(columns["coefficient"]) & (speed > 0))
        good = good[np.argsort(speed[good])]
        if good.size < FEWEST or np.unique(speed[good]).size < good.size:
            return None
        samples = samples_at(speed[good], {name: values[good] for name, values in columns.items()})
        return Interpolant(samples, knee_of(samples))

    def to_xarray(self):
        """An `xarray.Dataset`: a dimension for each varied key, units and long names as attributes. Needs the ``study``
        extra."""
        from .tables import to_xarray

        return to_xarray(self)

    def to_frame(self):
        """A tidy `pandas.DataFrame`: one row a point. Needs the ``study`` extra."""
        from .tables import to_frame

        return to_frame(self)

    def to_csv(self, path) -> None:
        """One row a point, the unit in the heading; nothing beyond the standard library needed."""
        from .tables import to_csv

        to_csv(self, path)

    def to_parquet(self, path) -> None:
        """The table of `to_frame` as a Parquet file. Needs the ``study`` extra."""
        from .tables import to_parquet

        to_parquet(self, path)


def open_study(folder) -> StudyResult:
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
    path = validate.folder("store", folder) / PLAN
    if not path.is_file():
        raise InputError(f"{folder} holds no {PLAN}; give the folder of a study")
    try:
        plan = json.loads(path.read_text(encoding="utf-8"))
        keys = plan["keys"]
    except (ValueError, KeyError, TypeError, UnicodeDecodeError):
        raise InputError(f"{path} is damaged; run the study again in this folder, which writes it anew") from None
    if plan["speeds"] == AUTO:
        keys = [key for mark in keys for key in (mark, *chosen_keys(mark))]
    records = Journal(folder).records()
    return StudyResult.of_rows(plan, {key: row_of(records[key]) for key in keys if key in records})


def _on_speeds(plan: dict, rows: dict[str, dict]):
    """(place in the flat arrays, row) of the known points, and the status of all points before these are filled in."""
    status = np.full(len(plan["keys"]), MISSING, dtype=object)
    return [(at, rows[key]) for at, key in enumerate(plan["keys"]) if key in rows], status


def _on_curves(plan: dict, rows: dict[str, dict]):
    """The same for curves that chose their speeds. The first free place of an unfinished curve is "not computed"."""
    placed, most = [], plan["shape"][-1]
    status = np.full(most * len(plan["keys"]), UNUSED, dtype=object)
    for curve, mark in enumerate(plan["keys"]):
        keys = dict(enumerate(chosen_keys(mark), most * curve))
        placed += [(at, rows[key]) for at, key in keys.items() if key in rows]
        if mark not in rows:
            status[next(at for at, key in keys.items() if key not in rows)] = MISSING
    return placed, status


def plan_as_dict(plan) -> dict:
    """A `StudyPlan` in plain JSON types."""
    return {
        "format": 1,
        "lubfric": __version__,
        "name": plan.scene.name,
        "scene": plain(scene_as_dict(plan.scene)),
        "axes": [
            {"name": a.name, "keys": list(a.keys), "values": [_worded(row) for row in a.values]} for a in plan.axes
        ],
        "speeds": list(plan.speeds) or AUTO,
        "shape": list(plan.shape),
        "keys": list(plan.keys().flat),
    }


def _worded(row: tuple) -> list:
    """Values in plain JSON types; an oil or a whole section in words."""
    return [repr(value) if is_dataclass(value) else plain(value) for value in row]


def _column(values: list) -> np.ndarray:
    """Numbers as floats, anything else as text."""
    if all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in values):
        return np.array(values, dtype=float)
    return np.array([v if isinstance(v, str) else json.dumps(v) for v in values])
