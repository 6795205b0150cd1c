"""fit.png: a fit drawn from its record, fit.json."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from .. import studies
from .._base import figures, read_json
from ..errors import InputError
from .picture_options import PictureOptions

# Record of a fit.
FIT = "fit.json"

# Heights of the panels [inch] at the usual width: the curve, the residuals. A choice, by looking at the figures.
HEIGHTS = (4.3, 2.2)

# What the picture takes of a record, arrays with one number for each point.
DRAWN = ("x", "measured", "fitted", "low", "high")


def drawn_record(fitted: studies.FitResult) -> dict[str, Any]:
    """Return what the record of a fit has for its picture."""
    measured = fitted.measured
    (low, high) = fitted.band
    points = {"x": measured.x, "measured": measured.coefficient, "fitted": fitted.predicted, "low": low, "high": high}
    more = {
        "deviation": measured.deviation,
        "legend": measured.legend,
        "branch": measured.branch,
        "describes_data": fitted.describes_data,
    }
    return points | more | {"over": measured.over, "source": measured.source}


def read_fit(path: Path) -> dict[str, Any]:
    """Return the record of a fit in ``path``. Raise `InputError` where it has not what its picture needs."""
    again = "run 'lubfric fit' again"
    record = read_json(path, again)
    if not isinstance(record, dict) or not all(isinstance(record.get(name), list) for name in (*DRAWN,)):
        raise InputError(f"{path} is damaged, or of a version whose fits are not drawn again; {again}")
    if len({len(record[name]) for name in DRAWN}) > 1 or not {"over", "source"} <= record.keys():
        raise InputError(f"{path} is damaged; {again}")
    return record


@figures.styled
def plot_fit(path: Path, record: dict[str, Any], options: PictureOptions = PictureOptions()) -> None:
    """Draw the points, the fitted curve and its band of a ``record`` (`drawn_record`), and below the residuals."""
    (x, coefficient, predicted, low, high) = (np.array(record[name], dtype=float) for name in DRAWN)
    (deviation, branch) = (
        None if record.get(name) is None else np.array(record[name]) for name in ("deviation", "branch")
    )
    measured = studies.Measured(
        x,
        coefficient,
        deviation,
        over=record["over"],
        source=record["source"],
        legend=record.get("legend", ""),
        branch=branch,
    )
    figure = figures.new_figure(figsize=options.size(HEIGHTS))
    top, bottom = figure.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": HEIGHTS})
    is_valid = record.get("describes_data", True) is not False  # records of version 1.0.0 have not said
    studies.draw_fit(top, measured, predicted, (low, high) if is_valid else None)
    top.set_xlabel("")
    studies.draw_residuals(bottom, measured, predicted)
    options.scale(bottom, friction=top, f=coefficient)
    options.thin(figure)
    figure.savefig(path)
