"""Friction over time, and over the speed of a run in time, drawn."""

from __future__ import annotations

import numpy as np

from .._base import BLUE, FRICTION, GREY, axes_or_new, friction_lines
from ..quantities import axis_label


def history_axes(history, ax=None):
    """Friction over time of a `lubfric.TransientResult`, with its parts."""
    axes = axes_or_new(ax)
    low, high = history.uncertainty.interval.T
    if (high > low).any():
        time = history.time * time_scale(history.time[-1])[0]
        axes.fill_between(time, low, high, color=BLUE, alpha=0.2, lw=0, label="95 %: finite surface")
    friction_over_time(axes, history.columns)
    return axes


def friction_over_time(axes, c: dict[str, np.ndarray]) -> None:
    """Friction over time with its parts, by the ``c`` of a `lubfric.TransientResult`."""
    sense = np.where(c["sliding_speed"] != 0, c["sliding_speed"], c["entrainment_speed"])
    sense = np.where(sense < 0, -1.0, 1.0)  # of the coefficient
    scale, unit = time_scale(c["time"][-1])
    film = (c["couette_force"] + c["rolling_force"]) * sense / c["load"]
    parts = c["coefficient"], c["boundary_force"] * sense / c["load"], film
    friction_lines(axes, c["time"] * scale, parts)
    axes.set(xlabel=f"time ({unit})", ylabel=FRICTION)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.15 * (high - low))
    axes.legend(frameon=False, ncols=3, fontsize=8, loc="upper center")


def time_scale(longest: float) -> tuple[float, str]:
    """(factor, unit) that shows times up to ``longest`` [s] as numbers above one."""
    for scale, unit in ((1.0, "s"), (1e3, "ms")):
        if longest * scale >= 1.0:
            return scale, unit
    return 1e6, "µs"


def loop_axes(history, ax=None):
    """Friction over entrainment speed of a `lubfric.TransientResult`: its hysteresis loop, the start marked.

    At a standstill no friction coefficient is defined, and none is drawn.
    """
    axes = axes_or_new(ax)
    moving = (history.entrainment_speed != 0) | (history.sliding_speed != 0)
    speed, friction = history.entrainment_speed, np.where(moving, history.coefficient, np.nan)
    axes.plot(speed, friction, color=BLUE)
    begin = np.flatnonzero(moving)[:1]
    axes.plot(speed[begin], friction[begin], "o", color=GREY, label="start")
    middle = history.time.size // 2
    if history.time.size > 2 and moving[middle] and moving[middle + 1]:
        ends = [(speed[i], friction[i]) for i in (middle, middle + 1)]
        axes.annotate("", ends[1], ends[0], arrowprops={"arrowstyle": "->", "color": BLUE, "mutation_scale": 18})
    axes.set(xlabel=axis_label("speed"), ylabel=FRICTION)
    axes.legend(frameon=False)
    return axes
