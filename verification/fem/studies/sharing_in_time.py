"""Load sharing in time by finite elements, compared with `lubfric.transient`: the paper's cylinder slows down and
speeds up."""

from collections.abc import Iterator
from itertools import islice

import numpy as np

import lubfric
from lubfric.models import prepare
from lubfric.scene import Table as History
from lubfric.scene import Transient

from ...check import ABSOLUTE, AT_LEAST, Check, Item, Table
from ..solvers.transient_sharing import SharedMoment, share_in_time
from .load_sharing import LENGTH, averaged, cylinder, rough, scene, strip

FIRST = 0.03  # m/s
LAST = 0.015  # m/s
RAMP = 3.0  # b/U0 that the speed takes from the first to the last
UNTIL = 6.0  # b/U0
CELLS = {"quick": 16, "default": 32, "full": 32}
FINEST = 64  # cells on which the surface is made
STEPS = {"quick": 24, "default": 48, "full": 96}
REFINEMENTS = {"quick": 0, "default": 0, "full": 1}
SOURCE = "film in time and rough contact by finite elements"
LOAD = 0.01  # of the load: difference that is allowed; twice as many cells, or steps, change less
GAP = 0.005  # of the gap: likewise


def sharing_in_time(level: str) -> Iterator[Item]:
    """Contact load and mean gap over time while the speed falls to half within three half-widths of travel.

    The film of the moment is thicker than the steady one at its speed, because it was made when the speed was higher.
    Both programs start from their own steady state and take steps of their own: `lubfric` chooses them by its tolerance,
    the finite elements take equal ones, a half of which changes the contact load by less than the tolerance here.
    """
    cells = CELLS[level]
    heights = rough(FINEST, cells)
    s = scene()
    bodies = cylinder(s, FIRST, strip(cells, 1), heights)
    b = bodies.contact.half_width
    unit = b / FIRST

    def speed(time: float) -> float:
        return FIRST + (LAST - FIRST) * min(time / (RAMP * unit), 1.0)

    count = STEPS[level]
    every = count // 6
    length = UNTIL * unit / count
    moments = list(islice(share_in_time(bodies, speed, length, refinements=REFINEMENTS[level]), count + 1))
    chosen = moments[::every]
    times = [moment.time for moment in chosen]
    history = own_history(s, heights, times, unit)
    rows = []
    for k, moment in enumerate(chosen):
        rows.append(row_of(moment, unit, speed(moment.time), history.contact_load[k], history.mean_gap[k]))
        name = f"t = {moment.time / unit:.1f} b/U0"
        load = Check(
            f"{name}: asperity load over the total load",
            history.contact_load[k] / bodies.load,
            expected=moment.contact_load / bodies.load,
            tolerance=LOAD,
            source=SOURCE,
            kind=ABSOLUTE,
        )
        yield load
        yield Check(
            f"{name}: mean gap", history.mean_gap[k], expected=moment.mean_gap, tolerance=GAP, source=SOURCE, unit="m"
        )
    steady = lubfric.friction(averaged(prepare(s, lubfric.Surface(heights, (LENGTH / cells, LENGTH / cells)))), LAST)
    middle = moments[count // 2]
    ahead = 1 - middle.contact_load / steady.contact_load
    name = "the film lags: contact load below the steady one at the end of the ramp"
    yield Check(
        name,
        ahead,
        expected=0.02,
        tolerance=0.0,
        source="the film was made at a higher speed",
        kind=AT_LEAST,
        grade="B",
    )
    columns = ("t U0/b", "U (m/s)", "F_C (N): elements", "lubfric", "mean gap (nm): elements", "lubfric")
    yield Table("sharing-in-time", "Load sharing while the speed falls to half, by both programs", columns, rows)


def own_history(s: lubfric.Scene, heights: np.ndarray, times: list[float], unit: float) -> lubfric.TransientResult:
    """The run in time by `lubfric`, with displacements that are means over cells as those of the elements are."""
    cell = LENGTH / heights.shape[0]
    end = UNTIL * unit
    history = History(times=(0.0, RAMP * unit, 2 * end), values=(FIRST, LAST, LAST))
    plan = Transient(end, speed=history, tolerance=1e-5)
    moving = s.with_(transient=plan)
    model = prepare(moving, lubfric.Surface(heights, (cell, cell)))
    return lubfric.transient(averaged(model), times)


def row_of(moment: SharedMoment, unit: float, speed: float, contact_load: float, mean_gap: float) -> tuple[str, ...]:
    """A row of the table."""
    return (
        f"{moment.time / unit:.1f}",
        f"{speed:.4g}",
        f"{moment.contact_load:.4f}",
        f"{contact_load:.4f}",
        f"{1e9 * moment.mean_gap:.2f}",
        f"{1e9 * mean_gap:.2f}",
    )
