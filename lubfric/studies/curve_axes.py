"""Stribeck curves drawn on axes, several on the same ones."""

from __future__ import annotations

from collections.abc import Collection, Container, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

import numpy as np

from .._base import figures, validate
from .curve import columns_of_curve, models_of_points
from .points import MODEL
from .tables import FrictionLines, friction_over_speed

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Forms of the intervals of a curve.
INTERVALS = ("band", "bars", "none")


@dataclass(frozen=True, kw_only=True)
class DrawnCurve:
    """A curve on axes: its ``lines``, the name of its ``scene``, whether it has a label of its own (``is_named``),
    whether its thin lines are for a lone curve alone, and the ``lowest`` end of the axis of f."""

    lines: FrictionLines
    scene: str
    is_named: bool
    has_lone_errors: bool
    lowest: float

    @property
    def color(self) -> Any:
        """The colour of the curve."""
        return self.lines.f.get_color()


# The curves that are on axes, which the next one must differ from.
_DRAWN: WeakKeyDictionary[Axes, list[DrawnCurve]] = WeakKeyDictionary()


def curve_axes(
    curve: Any,
    ax: Axes | None = None,
    *,
    label: str | None = None,
    parts: bool = True,
    interval: str = "band",
    error_parts: bool | None = None,
    **style: Any,
) -> Axes:
    """Draw friction over speed, with its parts and its intervals, on ``ax`` or new axes, which are returned.

    A further curve on the same axes takes the next colour, and its parts have that colour too. All curves are named,
    and the key above the axes says once what dashes and bands mean.

    Parameters
    ----------
    ax : axes to draw on; None: those of a new figure
    label : name of the curve in the key. Default: "friction coefficient", of several curves the names of their scenes
    parts : whether to draw the parts of f by asperity and by fluid friction
    interval : form of the 95 % intervals: "band", "bars" at the points, or "none"
    error_parts : whether thin lines in the band show the model-form and the sampling error alone. Default: where no
        other curve is on the axes
    style : of the line of f: color, linestyle, linewidth, marker, markersize, alpha, zorder

    Raises
    ------
    InputError : another keyword, or another form of the intervals
    """
    style = figures.line_style(style, ("ax", "label", "parts", "interval", "error_parts"))
    validate.choice("interval", interval, INTERVALS)
    axes = figures.axes_or_new(ax)
    without = () if parts else (figures.ASPERITY_FRICTION, figures.FLUID_FRICTION)
    shown: dict[str, Any] = {"interval": interval, "error_parts": error_parts, "without": without}
    columns = columns_of_curve(curve) | {MODEL: models_of_points(curve)}
    draw_curve(axes, columns, curve.scene.name, label, **shown, **style)
    figure = axes.get_figure(root=True)
    if figure is not None and figure.get_figwidth() <= figures.NARROW_FIGURE:
        figures.fit_labels(figure, [axes])
    return axes


def draw_curve(
    axes: Axes,
    columns: Mapping[str, np.ndarray],
    scene: str,
    label: str | None = None,
    *,
    interval: str = "band",
    error_parts: bool | None = None,
    without: Container[str] = (),
    models: Collection[str] = (),
    **style: Any,
) -> None:
    """Draw the curve in the ``columns`` of a `lubfric.StribeckResult` on ``axes``, unlike those that are there;
    ``scene``: the name of its scene; ``without``: the names of parts that are omitted; ``models``: as of
    `mark_models`; the others: as of `curve_axes`."""
    before = _DRAWN.setdefault(axes, [])
    for place, each in enumerate(before):
        before[place] = _beside_others(each, [other.scene for other in before[:place]])
    if label is not None:
        name = str(label)
    elif before:
        name = _unlike(scene, [each.lines.f.get_label() for each in before])
    else:
        name = figures.FRICTION_COEFFICIENT
    if before:
        axes.autoscale(enable=True, axis="y")
    lines = friction_over_speed(
        axes,
        columns,
        has_parts=not before if error_parts is None else error_parts,
        as_bars=interval == "bars",
        has_interval=interval != "none",
        without=without,
        others=len(before),
        models=models,
        **{"color": _next_colour(before)} | style | {"label": figures.plain_words(name)},
    )
    drawn = DrawnCurve(
        lines=lines,
        scene=scene,
        is_named=label is not None or bool(before),
        has_lone_errors=error_parts is None,
        lowest=min([axes.get_ylim()[0], *(each.lowest for each in before)]),
    )
    axes.set_ylim(bottom=drawn.lowest)
    before.append(_beside_others(drawn, []) if before else drawn)
    figure = axes.get_figure(root=True)
    for part in lines.parts if figure is not None and figure.get_figwidth() <= figures.NARROW_FIGURE else ():
        part.set_linewidth(figures.NARROW_PART_WIDTH)
    figures.key_above(axes)


def _beside_others(drawn: DrawnCurve, others: list[Any]) -> DrawnCurve:
    """Return a curve that is not alone on its axes: with the name of its scene, unlike those of the ``others``, parts
    in its colour, and without the thin lines of a lone one."""
    if not drawn.is_named:
        drawn.lines.f.set_label(figures.plain_words(_unlike(drawn.scene, others)))
    for part in drawn.lines.parts:
        part.set_color(drawn.color)
    for error in drawn.lines.errors if drawn.has_lone_errors else ():
        error.remove()
    lines = replace(drawn.lines, errors=()) if drawn.has_lone_errors else drawn.lines
    return replace(drawn, lines=lines, is_named=True)


def _unlike(name: str, others: list[Any]) -> str:
    """Return ``name``, with a number behind it where one of the ``others`` has it."""
    number = 1 + sum(str(other).rpartition(" (")[0] == name or other == name for other in others)
    return name if number == 1 else f"{name} ({number})"


def _next_colour(before: list[DrawnCurve]) -> Any:
    """Return the first colour of curves that those ``before`` do not have."""
    used = [each.color for each in before]
    free = [color for color in figures.CURVE_COLOURS if color not in used]
    return free[0] if free else figures.CURVE_COLOURS[len(before) % len(figures.CURVE_COLOURS)]
