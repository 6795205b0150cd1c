"""What a user may choose of a picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .._base import figures
from ..quantities import axis_label

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Panels of a picture from the top, by the table that it is drawn from.
PANELS = {"stribeck": ("friction", "load", "film"), "traction": ("friction", "load", "film", "temperature")}

CONTACT_PANELS = ("pressure", "gap", "shear")  # of the picture of a contact by the deterministic model

# What a Stribeck curve may be over, with its label; {}: that of the speed.
SPEED_AXIS = "speed"
X_LABELS = {
    SPEED_AXIS: "",
    "lambda": axis_label("lambda_ratio"),
    "hersey": "Hersey number $ηU/w$ (-), $w$ the load per length",
}

# Lines of a curve that a user may omit, by their names in its key.
WITHOUT_ADDED = "added speeds"  # of --without: points that were solved in addition to the requested ones
LINES = (figures.ASPERITY_FRICTION, figures.FLUID_FRICTION, figures.OPERATING_POINT_MARK)

# Choices, by looking at the figures.
PICTURE_WIDTH = 7.0  # inch: of a picture
INCH = 0.0254  # m
PRINTED_DPI = 300.0  # of a picture whose width is chosen: what journals ask for
LEAST_SCALE = 0.8  # of the heights: panels of a narrow picture are no lower
NARROW_PICTURE = 4.5  # inch: narrower pictures have smaller fonts
LOWEST = 0.2  # of the smallest f, where a logarithmic axis of f begins
# Size of lines and markers of a narrow picture over that of the usual one, of twice its width. A choice, by looking at
# the figures.
THINNER = 0.6


@dataclass(frozen=True, kw_only=True)
class PictureOptions:
    """What a user may choose of the picture of a curve or a run in time.

    Attributes
    ----------
    panels : of a Stribeck or a traction curve, of its `PANELS`; of a contact, of `CONTACT_PANELS`
    x : what a Stribeck curve is over, of `X_LABELS`
    parts_of : names of those of several curves whose asperity and fluid friction is drawn too
    x_scale, y_scale : "linear" or "log", of the axis of speeds, ratios or times, and of f; None: by the data
    width : of the figure [m]; a journal's column is some 85 mm wide. None: `PICTURE_WIDTH`
    dpi : points of a PNG per inch; None: `PRINTED_DPI` where the width is chosen, else that of the style
    has_warnings : whether points with warnings are marked, and the warnings named below
    has_parts : whether lines show the errors by the model and by the surface alone
    without : names of lines of a curve that are omitted, of `LINES`
    has_title : whether the name of the scene is above
    has_bars : whether the intervals of a curve are bars at its points, in place of a band with those lines
    """

    panels: tuple[str, ...] = PANELS["traction"]
    x: str = SPEED_AXIS
    parts_of: tuple[str, ...] = ()
    x_scale: str | None = None
    y_scale: str | None = None
    width: float | None = None
    dpi: float | None = None
    has_warnings: bool = True
    has_parts: bool = True
    has_title: bool = True
    has_bars: bool = False
    without: tuple[str, ...] = ()

    def size(self, heights: Sequence[float]) -> tuple[float, float]:
        """Return width and height [inch] of a figure with panels of these ``heights`` [inch] at the usual width."""
        width = PICTURE_WIDTH if self.width is None else self.width / INCH
        return width, max(width / PICTURE_WIDTH, LEAST_SCALE) * sum(heights)

    def scale(self, axes: Axes, *, friction: Axes | None = None, f: np.ndarray | None = None) -> None:
        """Set the scales that the user chose: of x on ``axes``, and on the axes ``friction`` that of ``f``."""
        if self.x_scale:
            axes.set_xscale(self.x_scale)
        if friction is not None and self.y_scale:
            if self.y_scale == "log" and f is not None and np.any(f > 0):
                friction.set_ylim(LOWEST * float(np.min(f[f > 0])), 2.0 * float(np.nanmax(f)))
            friction.set_yscale(self.y_scale)
            figures.plain_ticks(friction.yaxis)

    @property
    def is_narrow(self) -> bool:
        """Whether the picture is for a journal's column: its fonts, lines and markers are smaller."""
        return self.width is not None and self.width / INCH <= NARROW_PICTURE

    def thin(self, figure: Figure) -> None:
        """Make lines and markers of a narrow ``figure`` smaller by `THINNER`, as `style` does with its texts."""
        if not self.is_narrow:
            return
        for axes in figure.axes:
            legend = axes.get_legend()
            for line in (*axes.lines, *(() if legend is None else legend.get_lines())):
                line.set_linewidth(THINNER * line.get_linewidth())
                line.set_markersize(THINNER * line.get_markersize())
                line.set_markeredgewidth(THINNER * line.get_markeredgewidth())

    def style(self) -> dict[str, float]:
        """Return what differs from the style of pictures.mplstyle: the resolution, and the sizes of fonts [pt], which
        are smaller in a narrow picture."""
        dpi = PRINTED_DPI if self.dpi is None and self.width is not None else self.dpi
        resolution = {} if dpi is None else {"savefig.dpi": dpi}
        return resolution | self._fonts()

    def _fonts(self) -> dict[str, float]:
        if not self.is_narrow:
            return {}
        small = dict.fromkeys(("font.size", "axes.labelsize", "figure.titlesize"), 8.0)
        return small | dict.fromkeys(("xtick.labelsize", "ytick.labelsize"), 7.0) | {"legend.fontsize": 6.0}
