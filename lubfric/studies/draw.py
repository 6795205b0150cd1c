"""The curves of a study drawn on axes."""

from __future__ import annotations

import numpy as np

from .._base import axes_or_new
from ..quantities import KEYS
from .table_row import SPEED

MOST, NAMED, FINE = 50, 10, 200  # lines, lines with a label, points of a line between solved ones


def curves_axes(result, ax=None, **style):
    """See `StudyResult.plot`: points where they are solved, and the interpolated curve if a curve chose its speeds."""
    axes = axes_or_new(ax)
    indices = list(np.ndindex(*result.status.shape[:-1]))
    shown = [indices[i] for i in np.unique(np.linspace(0, len(indices) - 1, min(MOST, len(indices))).astype(int))]
    colours = _colours(len(shown))
    for index, colour in zip(shown, colours):
        own = {"color": colour, "lw": 1.0} | style
        if len(shown) <= NAMED:
            own = {"label": _label(result, index)} | own
        speed = np.abs(result[SPEED][index] if result.chosen else result.coords[SPEED][1])
        good = np.flatnonzero(np.isfinite(result["coefficient"][index]) & (speed > 0))
        good = good[np.argsort(speed[good])]
        f, curve = result["coefficient"][index][good], result.curve(index) if result.chosen else None
        if curve is None:
            axes.plot(speed[good], f, "o-", ms=3, **own)
            continue
        at = np.geomspace(speed[good][0], speed[good][-1], FINE)
        axes.plot(at, curve.at(at), **own)
        axes.plot(speed[good], f, "o", ms=3, color=own["color"])
    axes.set(xscale="log", xlabel="entrainment speed U (m/s)", ylabel="friction coefficient (-)")
    if 1 < len(shown) <= NAMED:
        axes.legend(frameon=False)
    axes.set_title(f"{result.plan['name']}: {len(shown)} of {len(indices)} curves")
    return axes


def _colours(count: int):
    from matplotlib import colormaps

    return colormaps["viridis"](np.linspace(0.0, 0.9, count))


def _label(result, index) -> str:
    words = []
    for key, (dim, values) in result.coords.items():
        if key != SPEED:
            value = values[index[result.dims.index(dim)]]
            unit = KEYS.get(key, ("",))[0]
            text = f"{value:.4g}" if isinstance(value, float) else str(value)
            words.append(f"{key.rpartition('.')[2]} {text}{' ' + unit if unit not in ('', '-') else ''}")
    return ", ".join(words)
