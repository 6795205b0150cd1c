"""Figures of the report. They have one look, keep no global state, and end as bytes."""

from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .check import Figure
from .types import FloatArray, Option

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import XAxis, YAxis
    from matplotlib.figure import Figure as Canvas
    from matplotlib.typing import RcKeyType

# x, y, style, label, and perhaps the errors of y. `Any`: each has a type of its own.
Curve = Sequence[Any]

STYLE: dict[RcKeyType, object] = {
    "font.size": 9.5,
    "axes.titlesize": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.alpha": 0.25,
    "lines.linewidth": 1.5,
    "lines.markersize": 4.5,
    "svg.hashsalt": "lubfric",
    "figure.constrained_layout.use": True,
    # colours that stay apart for colour-blind readers (Okabe and Ito 2008)
    "axes.prop_cycle": "cycler('color', ['0072B2', 'D55E00', '009E73', 'CC79A7', 'E69F00', '56B4E9', '0'])",
}


def axes(rows: int, columns: int, width: float, height: float, **options: Option) -> tuple[Canvas, np.ndarray]:
    """Return a figure in the report's style and its axes, as ``matplotlib.figure.Figure.subplots`` gives them with
    these ``options``."""
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as Canvas

    with matplotlib.rc_context(STYLE):
        canvas = Canvas(figsize=(width, height))
        FigureCanvasAgg(canvas)
        return canvas, canvas.subplots(rows, columns, **options)


def panel(width: float, height: float) -> tuple[Canvas, Axes]:
    """Return a figure in the report's style and its only panel."""
    canvas, grid = axes(1, 1, width, height, squeeze=False)
    return canvas, grid[0, 0]


def panels(count: int, columns: int, width: float, height: float) -> tuple[Canvas, np.ndarray]:
    """Return a figure of ``count`` panels in rows of at most ``columns``, each row so high, and its axes in a flat
    array."""
    columns = min(columns, count)
    rows = -(-count // columns)
    canvas, grid = axes(rows, columns, width, height * rows + 0.4, squeeze=False)
    for spare in grid.flat[count:]:
        spare.set_axis_off()
    return canvas, grid.ravel()[:count]


def chart(
    name: str,
    caption: str,
    curves: Iterable[Curve],
    width: float = 6.0,
    height: float = 3.8,
    **settings: Option,
) -> Figure:
    """Return one panel of ``curves``, each (x, y, style, label) and perhaps the errors of y, with ``settings`` of its
    axes."""
    canvas, ax = panel(width, height)
    for x, y, style, label, *errors in curves:
        ax.errorbar(x, y, yerr=errors[0] if errors else None, fmt=style, label=label)
    ax.set(**settings)
    canvas.legend(loc="outside lower center", ncols=2, frameon=False)
    return finish(name, canvas, caption)


def image(
    canvas: Canvas,
    ax: Axes,
    field: FloatArray,
    extent: tuple[float, float, float, float],
    label: str,
    **options: Option,
) -> None:
    """A map (nx, ny) with x to the right and a labelled colour bar."""
    shown = ax.imshow(field.T, origin="lower", extent=extent, interpolation="nearest", **options)
    ax.grid(visible=False)
    canvas.colorbar(shown, ax=ax, label=label, shrink=0.85)


def plain_ticks(axis: XAxis | YAxis) -> None:
    """Numbers such as 0.2 and 0.5 on a logarithmic ``axis`` (``ax.xaxis``) of less than two decades, where matplotlib
    would write every tick as a product, one over the other. Ticks that were chosen stay."""
    from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

    low, high = sorted(axis.get_view_interval())
    if axis.get_scale() == "log" and 0 < low and high < 100 * low and isinstance(axis.get_major_locator(), LogLocator):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high > 5 * low else (1, 1.5, 2, 3, 4, 5, 7)))
        axis.set_major_formatter(FormatStrFormatter("%g"))
        axis.set_minor_formatter(NullFormatter())


def finish(name: str, canvas: Canvas, caption: str, format: str = "svg", dpi: int = 160) -> Figure:
    """Return the bytes of a drawn figure; "svg" for lines, "png" for dense fields."""
    import matplotlib

    stream = io.BytesIO()
    for axis in (axis for a in canvas.axes for axis in (a.xaxis, a.yaxis)):
        plain_ticks(axis)
    for legend in filter(None, [a.get_legend() for a in canvas.axes]):
        legend.set_frame_on(False)
    with matplotlib.rc_context(STYLE):
        canvas.savefig(stream, format=format, dpi=dpi, metadata={"Date": None} if format == "svg" else None)
    return Figure(name, caption, stream.getvalue(), format)


def compact(figure: Figure, colours: int = 128) -> Figure:
    """Return the picture with a palette (rare colours are kept as well), in a third of the space."""
    from PIL import Image

    stream = io.BytesIO()
    Image.open(io.BytesIO(figure.data)).convert("RGB").quantize(colours, Image.Quantize.MAXCOVERAGE).save(
        stream, format="png", optimize=True
    )
    return replace(figure, data=stream.getvalue())
