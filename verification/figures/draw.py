"""Axes in the report's style, and the bytes of a small PNG."""

from __future__ import annotations

import io

from ..plotting import STYLE, axes

DPI = 90
COLOURS = 144  # of the picture: enough for lines and one colour map, and a third of the bytes

__all__ = ["axes", "image", "png"]


def png(canvas) -> bytes:
    """The picture of a drawn figure, small enough for the documents."""
    import matplotlib
    from PIL import Image

    stream, small = io.BytesIO(), io.BytesIO()
    for legend in [a.get_legend() for a in canvas.axes if a.get_legend()]:
        legend.set_frame_on(False)
    with matplotlib.rc_context(STYLE):
        canvas.savefig(stream, format="png", dpi=DPI)
    Image.open(stream).convert("RGB").quantize(COLOURS).save(small, format="png", optimize=True)
    return small.getvalue()


def image(canvas, ax, field, extent, label, **options):
    """A map (nx, ny) with x to the right and a labelled colour bar."""
    shown = ax.imshow(field.T, origin="lower", extent=extent, interpolation="nearest", **options)
    ax.grid(False)
    canvas.colorbar(shown, ax=ax, label=label, shrink=0.85)
