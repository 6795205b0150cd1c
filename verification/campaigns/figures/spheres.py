"""Figs. 3 and 4: a square array of spherical asperities against a flat. Load per asperity over separation."""

import math
from collections.abc import Iterator

import numpy as np

from lubfric.contact import find_asperities
from lubfric.contact.solve import solve_contact

from ...check import AT_LEAST, AT_MOST, Check, Item, Table
from ...kept import Run
from ...plotting import axes, image
from ...types import FloatArray, Keywords
from .page import picture

RADIUS = 30e-6  # m, of a sphere of the paper
HEIGHT = 500e-9  # m, of a sphere above the plane
E_PRIME = 231e9  # Pa, E' of the paper's steel
SPACINGS = (14e-6, 20e-6, 30e-6, 40e-6)
CELL = 115e-9  # m: the paper's grid has 2000 points of this spacing
BOX = 230e-6  # m, side of the paper's grid
MEAN_OF_BOX = 8 / math.pi * math.asinh(1.0)  # u E'/(p a) at the centre of a square of side a under the pressure p


def unit_cell(distance: float, cell: float = CELL) -> tuple[np.ndarray, float]:
    """Return heights [m] of one period around a sphere, on an even number of cells, and their length [m]."""
    count = 2 * round(distance / cell / 2)
    step = distance / count
    x = (np.arange(count) - count // 2) * step
    square = x[:, None] ** 2 + x**2
    cap = np.sqrt(np.maximum(RADIUS**2 - square, 0.0)) - (RADIUS - HEIGHT)
    return np.maximum(cap, 0.0), step


def approaches(distance: float, loads: FloatArray, cell: float = CELL) -> tuple[np.ndarray, np.ndarray]:
    """Return approach [m] below first touch at each load per asperity [N], without and with the mean deflection of the
    paper's box.
    """
    heights, step = unit_cell(distance, cell)
    free = []
    start = None
    for load in loads:
        pressed: Keywords = {"mean_pressure": load / distance**2, "tolerance": 1e-6, "start": start}
        start = solve_contact(HEIGHT - heights, step, E_PRIME, **pressed)
        free.append(start.approach)
    return np.array(free), np.array(free) + MEAN_OF_BOX * np.asarray(loads) / distance**2 * BOX / E_PRIME


def hertz_load(approach: FloatArray) -> FloatArray:
    """Return load [N] of one isolated sphere."""
    return 2 / 3 * E_PRIME * np.sqrt(RADIUS) * np.asarray(approach) ** 1.5


def sphere_array(level: str, run: Run = Run()) -> Iterator[Item]:
    """Load per asperity against the approach below first touch, by both models and with both conventions."""
    count, cell = (4, 4 * CELL) if level == "quick" else (9, CELL)
    loads = np.geomspace(5e-4, 2e-2, count)
    canvas, grid = axes(2, 2, width=9.0, height=7.6)
    (sketch, asperities), (without_mean, with_mean) = grid
    heights, step = unit_cell(20e-6, cell)
    side = 3 * heights.shape[0] * step * 1e6
    image(canvas, sketch, np.tile(heights, (3, 3)) * 1e9, (0, side, 0, side), "z (nm)", cmap="cividis")
    sketch.set(title="Fig. 3: part of the array, 20 µm apart", xlabel="x (µm)", ylabel="y (µm)")
    rows = []
    grows = []
    falls = []
    worst = 0.0
    for distance in SPACINGS:
        free, held = approaches(distance, loads, cell)
        result = find_asperities(*unit_cell(distance, cell), E_PRIME, definition="summits")
        alone = np.array([result(HEIGHT - a).load for a in free])
        for ax, approach, load in ((asperities, free, alone), (without_mean, free, loads), (with_mean, held, loads)):
            ax.plot(approach * 1e9, load * 1e3, "o-", label=f"{distance * 1e6:g} µm")
        rows += [(distance, *row) for row in zip(loads.tolist(), free.tolist(), held.tolist(), alone.tolist())]
        grows.append(float(np.median(loads / hertz_load(free))))
        falls.append(float(np.median(loads / hertz_load(held))))
        worst = max(worst, float(np.max(np.abs(alone / hertz_load(free) - 1))))
    titles = (
        "asperity model (any spacing)",
        "half-space, without the mean deflection",
        "half-space, with the mean deflection",
    )
    for ax, title in zip((asperities, without_mean, with_mean), titles):
        a = np.linspace(0, ax.get_xlim()[1] * 1e-9, 60)
        ax.plot(a * 1e9, hertz_load(a) * 1e3, "k:", lw=1, label="one sphere (Hertz)")
        ax.set(title=title, xlabel="approach below first touch, 500 nm - $h_s$ (nm)", ylabel="load per asperity (mN)")
        ax.set_ylim(0, 21)
        ax.legend(title="spacing")
    conventions = ("approach without mean deflection [m]", "approach with mean deflection [m]")
    last = "asperity model at the approach without mean deflection [N]"
    headings = ("spacing [m]", "load per asperity [N]", *conventions, last)
    yield Check(
        "asperity model against Hertz, any spacing",
        worst,
        expected=0.02,
        tolerance=0.0,
        source="Hertz 1882",
        kind=AT_MOST,
    )
    name = "load over Hertz with the mean deflection falls as spheres come closer: smallest step"
    step = np.diff(falls).min()
    yield Check(name, step, expected=0.0, tolerance=0.0, source="Fig. 4 of the paper", kind=AT_LEAST)
    title = "Figs. 3 and 4: spheres of 30 µm, 14 to 40 µm apart"
    yield Table("fig4", title, headings, rows)
    kept_words, free_words = (", ".join(f"{r:.2f}" for r in ratios) for ratios in (falls, grows))
    agrees = f"The asperity model does not depend on the spacing; it differs from Hertz by {100 * worst:.1f} %. In the "
    agrees += "half-space model *with the mean deflection of the box*, the load at a given separation falls when the "
    agrees += f"spheres come closer: {kept_words} of Hertz at 14, 20, 30, 40 µm, as in Fig. 4."
    differs = "In a periodic cell the mean deflection is a convention. Without it, the same solutions give "
    differs += f"{free_words} of Hertz: closer spheres carry slightly *more*. The mean deflection grows with the box "
    differs += (
        "(here 2.24 p a/E', Love's kernel summed over 230 µm). So Fig. 4 depends on the size of the box as much as "
    )
    differs += "on the interaction. In the friction model Eq. (8) removes the mean."
    yield picture("fig4", title, agrees, differs, canvas)
