"""Fig. 2: generated surfaces of two autocorrelation lengths."""

import math
from collections.abc import Iterator

import lubfric
from lubfric.surface.statistics import correlation_length, rms_slope

from ...check import AT_MOST, Check, Item, Table
from ...kept import Run
from ...plotting import axes, image
from .page import picture

LENGTHS = (34e-6, 57e-6)
SQ = 240e-9  # m, of the paper
SPACING = 2e-6  # m, of the cells
COUNT = 816  # cells in a side


def rough(
    length: float, acf: str = "exponential", seed: int = 1, count: int = COUNT, decay_level: float = math.exp(-1)
) -> lubfric.Surface:
    """Return a surface of Sec. 3.1: 816 x 816 points at 2 um, Sq 240 nm."""
    return lubfric.generate_surface(
        (count, count), SPACING, sq=SQ, correlation_length=length, acf=acf, decay_level=decay_level, seed=seed
    )


def generated_surfaces(level: str, run: Run = Run()) -> Iterator[Item]:
    """Both lengths with both autocorrelation functions: the length that the generator was given, and the lengths
    measured on the maps."""
    count = 400 if level == "quick" else COUNT
    canvas, grid = axes(2, 2, width=8.0, height=7.2)
    rows: list[tuple[str, float, float, float, float, float]] = []
    shown = min(count, 256)
    side = shown * SPACING * 1e6
    for row, acf in zip(grid, ("exponential", "gaussian")):
        for ax, length in zip(row, LENGTHS):
            surface = rough(length, acf, count=count)
            along, across = (correlation_length(surface, axis) for axis in (0, 1))
            rows.append((acf, length, surface.sq, along, across, rms_slope(surface)[2]))
            colours = {"vmin": -720, "vmax": 720, "cmap": "cividis"}
            image(canvas, ax, surface.heights[:shown, :shown] * 1e9, (0, side, 0, side), "z (nm)", **colours)
            ax.set(title=f"{acf}, L = {length * 1e6:g} µm (1/e)", xlabel="x (µm)", ylabel="y (µm)")
    off = max(abs(measured / r[1] - 1) for r in rows for measured in (r[3], r[4]))
    headings = ("acf", "L requested [m]", "Sq [m]", "L along x [m]", "L along y [m]", "rms slope [-]")
    yield Check(
        "Sq of the last map", rows[-1][2], expected=SQ, tolerance=1e-9, source="the Sq given to the generator", unit="m"
    )
    yield Check(
        "largest error of a measured length",
        off,
        expected=0.25,
        tolerance=0.0,
        source="scatter of one map",
        kind=AT_MOST,
    )
    title = "Fig. 2: generated surfaces, L = 34 and 57 µm"
    yield Table("fig2", title, headings, rows)
    agrees = "Sq is 240 nm exactly. The measured correlation lengths are within "
    agrees += (
        f"{100 * off:.0f} % of the requested ones (scatter of one map). The longer length gives broader hills and "
    )
    agrees += "smaller slopes."
    differs = (
        "The paper gives neither the shape of the autocorrelation function nor the level at which L is read. With "
    )
    differs += "an exponential function, its fine ripples decide what an asperity is in Figs. 5 and 6."
    yield picture("fig2", title, agrees, differs, canvas)
