"""The picture of a curve from its table and its record."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Container
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import studies
from .._base import figures
from ..errors import InputError
from ..models.shared import Violation, effect_in_words
from ..quantities import NUMBERS, counted
from .curve_answer import model_in_words
from .describe import is_among
from .picture_options import SPEED_AXIS, WITHOUT_ADDED, X_LABELS, PictureOptions
from .pictures import plot_stribeck, plot_traction

if TYPE_CHECKING:
    from .._base.tables import Columns


# Key of the speeds [m/s] of a record that were solved in addition to the requested ones.
ADDED_SPEEDS = "added_speeds"


def title_of_curve(name: str, points: list[dict[str, Any]]) -> str:
    """Return the title of the picture of a curve: the ``name`` of the scene, and by which models its ``points`` (of its
    record) are, the most frequent first. The band of the picture shows how large their errors are."""
    solved = [point for point in points if "error" not in point]
    stated = Counter(filter(None, map(_model_of_record, solved)))
    lines = [
        basis if count == len(solved) else f"{basis} ({count} of {counted(len(solved), 'points')})"
        for basis, count in stated.most_common()
    ]
    return "\n".join([name, *lines])


def _model_of_record(point: dict[str, Any]) -> str:
    """Return by which model a ``point`` of a record is, as `model_in_words`; "" in a record that does not have it."""
    model = point.get("model")
    return model_in_words(point.get("basis") or "", model or "") if model or point.get("basis") else ""


def operating_point_of_record(record: dict[str, Any]) -> float:
    """Return the scene's own speed [m/s] or slide-roll ratio that a ``record`` has; NaN where it has none."""
    value = record.get("operating_point")
    return float(value) if isinstance(value, (int, float)) else math.nan


def drawable(columns: Columns) -> np.ndarray:
    """Return which rows of the table of a curve its picture can show: f is known, and over speeds something moves."""
    drawable: np.ndarray = np.isfinite(columns["coefficient"]) & ("ratio" in columns or columns["speed"] != 0)
    return drawable


def points_of_record(source: Path, columns: Columns, record: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the points of a ``record`` that belong to the table ``source``, of which something can be drawn."""
    points: list[dict[str, Any]] = record.get("points", [])
    count = columns["coefficient"].size
    if len(points) != count:
        raise InputError(f"{source} has {count} rows and result.json {len(points)} points; run 'lubfric run' again")
    if not drawable(columns).any():
        first = next((f"; first: {point['error']}" for point in points if "error" in point), "")
        raise InputError(f"nothing to draw: none of the {count} points in {source} moves and has an answer{first}")
    return points


def over_x(columns: Columns, record: dict[str, Any], kind: str) -> Columns:
    """Return the ``columns`` of a Stribeck curve with those of its axis, of a ``kind`` in `X_LABELS`; the ``record`` has
    viscosity, load and length. Raises `InputError` where the curve has no such number, or it does not rise with the
    speed."""
    if kind == SPEED_AXIS:
        return columns
    speed = np.abs(columns["speed"])
    if kind == "lambda":
        x = columns["lambda_ratio"]
    else:
        (bodies, lubricant) = (record["scene"][name] for name in ("bodies", "lubricant"))
        x = lubricant["viscosity"] * speed * bodies["width"] / bodies["load"]
    shown = drawable(columns)
    rising = x[shown][np.argsort(speed[shown])]
    if not (rising > 0).all() or not (np.diff(rising) > 0).all():
        message = f" = {kind!r}: the {X_LABELS[kind].partition(' $')[0]} of this curve does not rise with the speed"
        raise InputError(message, "--x", recommendation="omit it")
    return type(columns)({**columns, studies.OVER_X: x})


def among_requested(
    columns: Columns, points: list[dict[str, Any]], record: dict[str, Any], left_out: Container[str]
) -> tuple[Columns, list[dict[str, Any]]]:
    """Return ``columns`` and ``points`` without the added speeds of their ``record`` that are ``left_out``: all of
    them, or the operating point."""
    added = record.get(ADDED_SPEEDS, [])
    if WITHOUT_ADDED not in left_out:
        own = [operating_point_of_record(record)] if figures.OPERATING_POINT_MARK in left_out else []
        added = [speed for speed in added if is_among(speed, own)]
    if "ratio" in columns or not added:
        return columns, points
    shown = [i for i, speed in enumerate(columns["speed"].tolist()) if not is_among(speed, added)]
    return type(columns)((name, column[shown]) for name, column in columns.items()), [points[i] for i in shown]


def table_of(curve: studies.CurveResult) -> str:
    """Return the name of the table and the picture of a ``curve``."""
    return "traction" if curve.SWEPT[0] == "ratio" else "stribeck"


def record_of_point(curve: studies.CurveResult, index: int) -> dict[str, Any]:
    """Return the record of a point: its numbers, the error of f as text too, and the errors of the other numbers; or
    why there are none."""
    name = curve.SWEPT[0]
    point = curve.points[index]
    swept = {
        name: getattr(curve, name)[index],
        "validity": [asdict(violation) for violation in curve.violations(index)],
    }
    if point is None:
        return swept | {"error": str(curve.errors[index])}
    more = {
        "uncertainty": asdict(point.uncertainty) | {"text": point.uncertainty.text},
        "errors": asdict(point.errors),
        "report": point.report.as_dict(),
        "unmodelled_effects": [effect_in_words(effect) for effect in point.unmodelled_effects],
        "basis": point.decision.basis,
        "model": point.decision.model,
    }
    return {number: getattr(point, number) for number in NUMBERS} | swept | more


def violations_of_record(points: list[dict[str, Any]]) -> list[list[Violation]]:
    """Return the assumptions that are violated at each of the ``points`` of a record."""
    unknown = {"value": math.nan, "limit": math.nan}  # numbers that are not finite are null in a record
    known = [
        [{k: v for k, v in violation.items() if v is not None} for violation in point["validity"]] for point in points
    ]
    return [[Violation(**unknown | violation) for violation in each] for each in known]


def draw_curve(
    path: Path,
    columns: Columns,
    title: str,
    points: list[dict[str, Any]],
    measured: Any = None,
    options: PictureOptions = PictureOptions(),
    operating_point: float = math.nan,
) -> None:
    """Draw the picture of the table of a curve; ``points``: those of its record; ``operating_point``: the scene's own
    speed [m/s] or slide-roll ratio."""
    violations = violations_of_record(points)
    title = figures.plain_words(title)
    if "ratio" in columns:
        (first, *others) = title.splitlines()
        speed = columns["speed"][np.isfinite(columns["coefficient"])][0]
        title = "\n".join([f"{first}, U = {speed:.4g} m/s", *others])
    if options.is_narrow:  # what the answers rest on is for the caption
        title = title.splitlines()[0]
    swept = columns["ratio" if "ratio" in columns else "speed"]
    own = [value for value in swept[drawable(columns)].tolist() if is_among(value, [operating_point])]
    plot = plot_traction if "ratio" in columns else plot_stribeck
    marked = own[0] if own and swept.size > 1 else math.nan
    plot(path, columns, title, violations, measured, options, operating_point=marked)
