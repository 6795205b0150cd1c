"""The numbers of a study, as arrays over what was varied."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import validate
from ..errors import InputError
from ..plain import plain
from ..scene import scene_as_dict
from ..store import Records
from ..version import __version__
from .journal import POINTS
from .quantities import QUANTITIES
from .table_row import CONVERGED, SPEED, STATUS, row_of

PLAN = "study.json"
MISSING = "not computed"


@dataclass(frozen=True)
class StudyResult:
    """Numbers of a study: arrays over the varied values and, last, the speed.

    ``result["coefficient"]`` is such an array, ``result.dims`` names its axes, ``result.coords`` holds the values along
    them. `to_xarray`, `to_frame`, `to_csv` and `to_parquet` make tables for other tools.

    Attributes
    ----------
    plan : what was studied, as in study.json
    columns : every number of a `FrictionResult` by name; NaN where a point failed
    status : "converged", or why a point has no numbers
    """

    plan: dict
    columns: dict[str, np.ndarray]
    status: np.ndarray

    @classmethod
    def of_rows(cls, plan: dict, rows: dict[str, dict]) -> StudyResult:
        """The result of the ``rows`` (`row_of`) by key, as a plan puts them in order."""
        shape, keys = tuple(plan["shape"]), plan["keys"]
        columns = {name: np.full(len(keys), np.nan) for name in QUANTITIES}
        status = np.full(len(keys), MISSING, dtype=object)
        for at, key in enumerate(keys):
            row = rows.get(key, {})
            for name, value in row.items():
                if name == STATUS:
                    status[at] = value
                    continue
                columns.setdefault(name, np.full(len(keys), np.nan))[at] = value
        return cls(plan, {k: v.reshape(shape) for k, v in columns.items()}, status.reshape(shape))

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the axes of the arrays."""
        return (*(axis["name"] for axis in self.plan["axes"]), SPEED)

    @property
    def coords(self) -> dict[str, tuple[str, np.ndarray]]:
        """{key: (dimension, values along it)} of every varied key and the speed [m/s]."""
        found = {}
        for axis in self.plan["axes"]:
            for i, key in enumerate(axis["keys"]):
                found[key] = (axis["name"], _column([row[i] for row in axis["values"]]))
        return found | {SPEED: (SPEED, np.array(self.plan["speeds"]))}

    @property
    def failed(self) -> int:
        """Number of points that could not be solved."""
        return int(np.count_nonzero((self.status != CONVERGED) & (self.status != MISSING)))

    @property
    def missing(self) -> int:
        """Number of points that a study which was interrupted has not come to."""
        return int(np.count_nonzero(self.status == MISSING))

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self.columns:
            raise InputError(f"a study has no column {name!r}{validate.nearest(name, self.columns)}; see .columns")
        return self.columns[name]

    def __repr__(self) -> str:
        shape = " x ".join(f"{n} {d}" for n, d in zip(self.status.shape, self.dims))
        return f"<StudyResult: {shape}; {self.failed} failed, {self.missing} not computed>"

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
    path = Path(folder) / PLAN
    if not path.is_file():
        raise InputError(f"{folder} holds no {PLAN}; allowed: the store of a study")
    try:
        plan = json.loads(path.read_text(encoding="utf-8"))
        keys = set(plan["keys"])
    except (ValueError, KeyError, TypeError, UnicodeDecodeError):
        raise InputError(
            f"{path} is damaged; allowed: run the study again on this store, which writes it anew"
        ) from None
    rows = {key: row_of(value) for key, value in Records(Path(folder) / POINTS).read() if key in keys}
    return StudyResult.of_rows(plan, rows)


def plan_as_dict(plan) -> dict:
    """A `StudyPlan` in plain JSON types."""
    return {
        "format": 1,
        "lubfric": __version__,
        "name": plan.scene.name,
        "scene": plain(scene_as_dict(plan.scene)),
        "axes": [{"name": a.name, "keys": list(a.keys), "values": plain(a.values)} for a in plan.axes],
        "speeds": list(plan.speeds),
        "shape": list(plan.shape),
        "keys": list(plan.keys().flat),
    }


def _column(values: list) -> np.ndarray:
    """Numbers as floats, anything else as text."""
    if all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in values):
        return np.array(values, dtype=float)
    return np.array([v if isinstance(v, str) else json.dumps(v) for v in values])
