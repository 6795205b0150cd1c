"""The picture of a curve with one solved point: no axis of speeds, but f with its parts and its interval, load ratios
and film."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from .._base import FloatArray, figures
from ..estimate import PARTS
from ..models.shared import half_width_of_error
from ..quantities import COLUMN_OF_ERROR
from ..units import converted, printed, unit_for, worded
from .picture_options import PictureOptions

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Choices, by looking at the figures.
HEIGHT_OF_ROW = 0.33  # inch: of a row of a panel, at the usual width
PANEL_MARGIN = 0.75  # inch: of the labels of a panel
KEY_MARGIN = 0.3  # inch: of a key above a panel
BAR_HEIGHT = 0.6  # of a row
INTERVAL_WIDTH = 6.0  # pt: of the bar of an interval
TICKS = 7  # of an axis of numbers of many digits, at most
NARROW_TICKS = 3  # the same of a narrow picture
ZOOM = 0.15  # of the length of the interval, beside it

WHOLE_INTERVAL = "95 % interval of f"
# Names of those parts of the interval in the picture that are no errors of their own name.
PART_NAMES = {"not given": "input not given", "input": "ranges of inputs"}


def draw_point(columns: Mapping[str, np.ndarray], panels: list[str], options: PictureOptions) -> Figure:
    """Return a figure of the one point that the ``columns`` have, (1,): the ``panels`` that are wanted, of "friction",
    "load", "film" and "temperature", and below f the parts of its interval unless the ``options`` omit them."""
    numbers = {name: float(column[0]) for name, column in columns.items() if np.asarray(column).dtype.kind in "fiu"}
    rows: dict[str, int] = {}
    for name in panels:
        if name == "friction":
            rows["friction"] = len(_parts_of_friction(numbers, options))
            parts = _parts_of_interval(numbers) if options.has_parts else {}
            if parts:
                rows["interval"] = len(parts)
        else:
            rows[name] = 1 if name == "load" else 2
    heights = [
        HEIGHT_OF_ROW * count + PANEL_MARGIN + KEY_MARGIN * (name in ("load", "film")) for name, count in rows.items()
    ]
    figure = figures.new_figure(figsize=options.size(heights))
    axes = figure.subplots(len(rows), 1, squeeze=False, height_ratios=heights)[:, 0]
    draw = {
        "friction": _draw_friction,
        "interval": _draw_interval,
        "load": _draw_loads,
        "film": _draw_films,
        "temperature": _draw_temperatures,
    }
    for each, name in zip(axes, rows):
        draw[name](each, numbers, options)
        each.grid(visible=False, axis="y")
    return figure


def _parts_of_friction(numbers: Mapping[str, float], options: PictureOptions) -> dict[str, tuple[float, str]]:
    """Return f and its parts with their colours, by their names; without those that the ``options`` omit."""
    load = numbers["contact_load"] + numbers["film_load"]
    parts = {
        "friction coefficient": (numbers["coefficient"], figures.BLUE),
        figures.ASPERITY_FRICTION: (numbers["boundary_force"] / load, figures.RED),
        figures.FLUID_FRICTION: (numbers["shear_force"] / load, figures.GREEN),
    }
    return {name: part for name, part in parts.items() if name not in options.without}


def _parts_of_interval(numbers: Mapping[str, float]) -> dict[str, tuple[float, float]]:
    """Return the interval of f, and that by each part of its error alone, by their names; {} where it is not known."""
    ends = (numbers.get("interval_low", math.nan), numbers.get("interval_high", math.nan))
    if not all(map(math.isfinite, ends)):
        return {}
    f = numbers["coefficient"]
    intervals = {WHOLE_INTERVAL: ends}
    for name, part in PARTS.items():
        column = COLUMN_OF_ERROR[part.quantity]
        error = numbers.get(column, math.nan)
        if name == "sampling":
            error = half_width_of_error(error, numbers.get("sampling_freedom", math.nan))
        sides = [numbers.get(f"{column}_{end}", math.nan) for end in ("low", "high")]
        towards, away = (side if math.isfinite(side) else error for side in sides)
        if not error > 0:
            continue
        low, high = sorted((f * (1 - towards), f * (1 + away)))
        intervals[PART_NAMES.get(name, f"{name} error")] = (
            max(low, ends[0]),
            min(high, ends[1]),
        )  # a part of the whole
    return intervals


def _rows(axes: Axes, names: list[str]) -> FloatArray:
    """Give ``axes`` a row for each of the ``names``, from the top; return their places."""
    places = np.arange(len(names), dtype=float)
    axes.set_yticks(places, names)
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.tick_params(axis="y", length=0)
    return places


def _draw_friction(axes: Axes, numbers: Mapping[str, float], options: PictureOptions) -> None:
    """Draw f with its interval, and its parts, as bars from 0."""
    parts = _parts_of_friction(numbers, options)
    for place, (value, colour) in zip(_rows(axes, list(parts)), parts.values()):
        axes.barh(place, value, BAR_HEIGHT, color=colour, alpha=0.5)
    low, high = (numbers.get(f"interval_{end}", math.nan) for end in ("low", "high"))
    f = numbers["coefficient"]
    axes.errorbar(f, 0.0, xerr=[[f - low], [high - f]], fmt="o", color="k", ms=4, capsize=4, lw=1.2)
    axes.axvline(0.0, color=figures.GREY, lw=0.8)
    axes.set_xlabel(
        figures.FRICTION_LABEL if math.isfinite(low) else f"{figures.FRICTION_LABEL}; {WHOLE_INTERVAL} not known"
    )
    lowest = min([value for value, _ in parts.values()] + [low if low < 0 else 0.0])
    axes.set_xlim(left=min(0.0, 1.1 * lowest))


def _draw_interval(axes: Axes, numbers: Mapping[str, float], options: PictureOptions) -> None:
    """Draw the interval of f, and those by each part of its error alone."""
    intervals = _parts_of_interval(numbers)
    for place, (low, high) in zip(_rows(axes, list(intervals)), intervals.values()):
        axes.hlines(place, low, high, color=figures.BLUE, lw=INTERVAL_WIDTH, alpha=0.4 if place else 0.9)
    axes.axvline(numbers["coefficient"], color="k", lw=0.8)
    low, high = intervals[WHOLE_INTERVAL]
    room = ZOOM * (high - low)
    axes.locator_params(axis="x", nbins=NARROW_TICKS if options.is_narrow else TICKS)
    axes.set(
        xlim=(low - room, high + room), xlabel=f"{figures.FRICTION_LABEL}: its interval, and those by each error alone"
    )


def _draw_loads(axes: Axes, numbers: Mapping[str, float], options: PictureOptions) -> None:
    """Draw the asperity load ratio and the film load ratio as one bar."""
    share = numbers["contact_load"] / (numbers["contact_load"] + numbers["film_load"])
    (place,) = _rows(axes, ["load ratio"])
    axes.barh(place, share, BAR_HEIGHT, color=figures.RED, alpha=0.5, label="asperity load $F_C/F_T$")
    axes.barh(place, 1 - share, BAR_HEIGHT, left=share, color=figures.GREEN, alpha=0.3, label="film load $F_H/F_T$")
    axes.set(xlim=(0, 1), xlabel="load ratio (-)")
    figures.key_above(axes)


def _draw_films(axes: Axes, numbers: Mapping[str, float], options: PictureOptions) -> None:
    """Draw the full-load film thickness and the central separation, and the roughness to compare."""
    values = {
        "full-load film thickness": (numbers.get("full_load_film", math.nan), "o", figures.GREEN),
        "central separation": (numbers["central_film"], "s", figures.BLUE),
    }
    unit = unit_for([value for value, *_ in values.values() if math.isfinite(value)] or [0.0], "m")
    times = converted(1.0, "m", unit)
    for place, (value, marker, colour) in zip(_rows(axes, list(values)), values.values()):
        axes.plot(times * value, place, marker, color=colour, ms=6)
    sq = (
        numbers["central_film"] / numbers["film_to_roughness_ratio"] if numbers["film_to_roughness_ratio"] else math.nan
    )
    if sq > 0:  # not of smooth surfaces
        for ratio, dashes, name in (
            (1, "--", f"$Λ$ = 1 (Sq of solved surface {worded(sq, 'm')})"),
            (3, ":", "$Λ$ = 3"),
        ):
            axes.axvline(ratio * times * sq, color=figures.GREY, lw=0.8, ls=dashes, label=name)
        figures.key_above(axes, 2)
    axes.set(xscale="log", xlabel=f"film thickness ({printed(unit)})")
    axes.margins(x=0.15)
    figures.plain_ticks(axes.xaxis)


def _draw_temperatures(axes: Axes, numbers: Mapping[str, float], options: PictureOptions) -> None:
    """Draw the largest temperature rises of surfaces and film."""
    rises = {
        "surfaces (flash temperature)": (numbers["flash_temperature_rise"], figures.RED),
        "film, above the surfaces": (numbers["film_temperature_rise"], figures.GREEN),
    }
    for place, (value, colour) in zip(_rows(axes, list(rises)), rises.values()):
        axes.barh(place, value, BAR_HEIGHT, color=colour, alpha=0.5)
    axes.set_xlabel("largest temperature rise (K)")
