"""Pictures of roughness that moves: moments side by side, an animation, and film and asperity contacts over time."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..._base import figures
from .moving_strip import Moment, MovingStripSolution, film_half_width

MOST_MOMENTS = 8  # moments side by side; a choice, by looking at the figures
TIME = "time since the roughness began to move (ms)"


def plot_moments(path: Path | str, moments: Sequence[Moment]) -> None:
    """Draw gap and pressure at up to eight ``moments``, one column each."""
    shown = moments[:: -(-len(moments) // MOST_MOMENTS)]
    figure = figures.new_figure(figsize=(2.4 * len(shown) + 1, 6))
    for column, moment in zip(figure.subplots(2, len(shown), squeeze=False, sharex=True, sharey="row").T, shown):
        _fields(column, moment, *_limits(shown))
    figure.savefig(path, dpi=130)


def animate_moments(path: Path | str, moments: Sequence[Moment], frames_per_second: int = 10) -> None:
    """Write gap and pressure as an animated GIF, one frame a moment."""
    figure = figures.new_figure(figsize=(5, 5.5))
    limits = _limits(moments)

    def draw(number: int) -> list[Any]:
        figure.clear()
        _fields(figure.subplots(2, 1, sharex=True), moments[number], *limits)
        return []

    figures.animated(path, figure, draw, range(len(moments)), frames_per_second, 90)


def plot_passing(path: Path | str, strip: MovingStripSolution) -> None:
    """Draw film, share of the load that rubs with f_b, and f over time; what does not count is grey."""
    figure = figures.new_figure(figsize=(7, 6.5))
    film, share, f = figure.subplots(3, 1, sharex=True)
    series = strip.series
    t = 1e3 * strip.times
    for name, label, color in (
        ("mean_gap", "mean gap", figures.BLUE),
        ("central_gap", "at x = 0", figures.GREEN),
        ("min_gap", "smallest", figures.GREY),
    ):
        film.plot(t, 1e9 * series[name], color=color, label=label, lw=1)
    share.plot(t, series["share"], color=figures.RED, lw=1)
    f.plot(t, series["coefficient"], color=figures.BLUE, lw=1)
    rest = strip.rest.result
    share.axhline(rest.split.rubbing / rest.load, color=figures.GREY, ls="--", lw=0.8, label="roughness at rest")
    f.axhline(rest.coefficient, color=figures.GREY, ls="--", lw=0.8)
    for axes, label in ((film, "gap (nm)"), (share, "share of the load\nthat rubs with f_b (-)"), (f, "f (-)")):
        axes.axvspan(0, t[strip.discarded - 1], color=figures.GREY, alpha=0.2, lw=0)
        axes.set(ylabel=label, xlim=(0, t[-1]), ylim=(0, None))
    figures.key_above(film)
    figures.key_above(share)
    f.set_xlabel(TIME)
    figure.savefig(path, dpi=130)


def _limits(moments: Sequence[Moment]) -> tuple[float, float]:
    """Return the largest gap [nm] and pressure [GPa] that are drawn."""
    near = np.abs(moments[0].at.problem.x) < 1.2 * film_half_width(moments[0].at.problem.line)
    gap = 1.3 * max(np.quantile(moment.at.gap[near], 0.98) for moment in moments)
    return 1e9 * float(gap), 1e-9 * float(max(moment.at.state.pressure.max() for moment in moments))


def _fields(axes: Any, moment: Moment, gap: float, pressure: float) -> None:
    """Return both fields of a ``moment``; lines, if there is one row of cells."""
    problem = moment.at.problem
    y = np.arange(moment.at.gap.shape[1]) * problem.spacing[1]
    for one, values, most, colours, label in (
        (axes[0], 1e9 * moment.at.mass_balance.flow_gap, gap, "viridis", "gap (nm)"),
        (axes[1], 1e-9 * moment.at.state.pressure, pressure, "magma_r", "pressure (GPa)"),
    ):
        if y.size == 1:
            one.plot(1e6 * problem.x, values[:, 0], color=figures.BLUE, lw=1)
            one.set(ylim=(0, most), xlabel="x (µm)", ylabel=label)
        else:
            figures.field_image(one, problem.x, y, values, colours, label, vmin=0, vmax=most)
        one.label_outer()
    axes[0].set_title(f"{1e3 * moment.time:.3g} ms", fontsize=9)
