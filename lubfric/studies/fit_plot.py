"""A fit drawn: the curve beside the measured points, and the residuals."""

from __future__ import annotations

import numpy as np

from .._base import BLUE, GREY, RED, axes_or_new, plain_ticks, speed_label
from .measured import SPEED, Measured


def plot_fit(result, ax=None):
    """See `FitResult.plot`."""
    axes = axes_or_new(ax)
    x, (low, high) = np.abs(result.measured.x), result.band
    order = np.argsort(x)
    error = None if result.measured.deviation is None else 1.96 * result.measured.deviation
    axes.errorbar(x, result.measured.coefficient, error, fmt="o", ms=4, color=RED, lw=1, label=result.measured.source)
    axes.plot(x[order], result.predicted[order], color=BLUE, label="fit")
    axes.fill_between(x[order], low[order], high[order], color=BLUE, alpha=0.2, lw=0, label="95 % band of the curve")
    _finish(axes, result, "friction coefficient (-)")
    axes.set_ylim(bottom=0)
    axes.legend(frameon=False)
    return axes


def plot_residuals(result, ax=None):
    """See `FitResult.plot_residuals`."""
    axes = axes_or_new(ax)
    miss = 100 * (result.measured.coefficient / result.predicted - 1)
    axes.axhline(0, color=GREY, lw=0.8)
    axes.plot(np.abs(result.measured.x), miss, "o", ms=4, color=RED)
    reach = 1.15 * max(np.abs(miss).max(), 1e-3)
    axes.set_ylim(-reach, reach)
    _finish(axes, result, "measured - fit (%)")
    return axes


def x_label(measured: Measured) -> str:
    """The label of the x axis of a measured curve."""
    return speed_label(measured.x) if measured.over == SPEED else "slide-roll ratio (-)"


def _finish(axes, result, label: str) -> None:
    if result.measured.over == SPEED:
        axes.set_xscale("log")
        plain_ticks(axes.xaxis)
    axes.set(xlabel=x_label(result.measured), ylabel=label)
