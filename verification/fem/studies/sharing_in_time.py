"""Load sharing in time by finite elements, compared with `lubfric.transient`: the paper's cylinder slows down, and is
unloaded, on ever finer grids and in ever shorter steps."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

import lubfric
from lubfric.models import prepare
from lubfric.scene import Table as History
from lubfric.scene import Transient

from ...check import ABSOLUTE, AT_LEAST, Check, Item, Table, bound
from ..convergence import Series, convergence, extrapolated_by, order_of_three
from ..solvers.sharing import Bodies
from ..solvers.transient_sharing import SharedMoment, share_in_time
from .load_sharing import LENGTH, averaged, cylinder, rough, scene, strip

SPEED = 0.03  # m/s, at the start
RAMP = 3.0  # b/U0 within which speed or load fall
UNTIL = 6.0  # b/U0
PARTS = 6  # of the run: the moments that are compared
FINEST = 64  # cells on which the surface is made
GRIDS = {"quick": (16,), "default": (16, 32, 64), "full": (16, 32, 64)}
REFINED = {"quick": 0, "default": 1, "full": 1}  # times that the mesh of the film is refined
STEPS = {"quick": 24, "default": 48, "full": 48}  # on every grid
LONGER = (2.0, 1.0, 0.5)  # steps of the elements on the coarsest grid, over those on every grid
TOLERANCES = (1e-4, 1e-5, 1e-6)  # of a step of lubfric; the last one is that of all comparisons
DURING = 2  # of the moments: two thirds of the ramp
SHOWN = (0, 1, 3, 6)  # moments of the table
SOURCE = "film in time and rough contact by finite elements"
# of the load, and of the gap: the differences fall by half from each grid to the next
LOAD = {"quick": 0.02, "default": 0.002, "full": 0.002}
GAP = {"quick": 0.01, "default": 0.001, "full": 0.001}
SHORT = 5e-4  # of the load: the last change by the tolerance of lubfric's steps


@dataclass(frozen=True)
class Motion:
    """What falls within the ramp: each is the last value over the first one."""

    name: str
    speed: float = 1.0
    load: float = 1.0

    def at(self, last: float, time: float) -> float:
        """Return the value over the first one at a ``time`` [b/U0]."""
        return 1.0 + (last - 1.0) * min(time / RAMP, 1.0)


SLOWER = Motion("speed falls to half", speed=0.5)
LIGHTER = Motion("load falls to 0.8", load=0.8)


@dataclass(frozen=True)
class RampCase:
    """A motion of the cylinder on a grid of the rough contact."""

    motion: Motion
    heights: np.ndarray
    bodies: Bodies

    @property
    def unit(self) -> float:
        """b/U0 [s]."""
        return self.bodies.contact.half_width / SPEED

    @property
    def times(self) -> list[float]:
        """The moments [s] that are compared."""
        return [UNTIL * self.unit * part / PARTS for part in range(PARTS + 1)]


def sharing_in_time(level: str) -> Iterator[Item]:
    """Contact load and mean gap over time while the speed falls to half, or the load to 0.8, within three half-widths
    of travel.

    The film of the moment is thicker than the steady one at its speed, because it was made when the speed was higher.
    When the load falls, the bodies part and the film has to fill the gap. Both programs start from their own steady
    state and take steps of their own: `lubfric` chooses them by its tolerance, the finite elements take equal ones. The
    surface is the same on all grids, averaged over cells.
    """
    rows: list[tuple[str, ...]] = []
    for motion in (SLOWER, LIGHTER):
        runs = [compared_run(motion, cells, level) for cells in GRIDS[level]]
        yield from checks_of(*runs[-1], level)
        rows += rows_of(*runs[-1])
        if len(runs) > 2:
            yield from grids(motion, runs)
            yield from steps(*runs[0], level)
        if motion == SLOWER:
            yield lag(*runs[0])
    columns = ("what falls", "t U0/b", "F_C (N): elements", "lubfric", "mean gap (nm): elements", "lubfric")
    yield Table("sharing-in-time", "Load sharing in time by both programs, on the finest grid", columns, rows)


def case_of(motion: Motion, cells: int) -> RampCase:
    """Return the cylinder with that many cells along and across."""
    heights = rough(FINEST, cells)
    return RampCase(motion, heights, cylinder(scene(), SPEED, strip(cells, 1), heights))


def compared_run(
    motion: Motion, cells: int, level: str
) -> tuple[RampCase, list[SharedMoment], lubfric.TransientResult]:
    """Return the run of both programs on a grid."""
    case = case_of(motion, cells)
    return case, by_elements(case, STEPS[level], REFINED[level]), by_lubfric(case, TOLERANCES[-1])


def by_elements(case: RampCase, count: int, refinements: int) -> list[SharedMoment]:
    """Return the moments of the run by finite elements in ``count`` steps."""
    motion = case.motion
    bodies = case.bodies
    moments = share_in_time(
        bodies,
        lambda time: SPEED * motion.at(motion.speed, time / case.unit),
        UNTIL * case.unit / count,
        load=lambda time: bodies.load * motion.at(motion.load, time / case.unit),
        refinements=refinements,
    )
    return list(islice(moments, count + 1))[:: count // PARTS]


def by_lubfric(case: RampCase, tolerance: float) -> lubfric.TransientResult:
    """Return the run by `lubfric`, with displacements that are means over cells as those of the elements are."""
    motion = case.motion
    cell = LENGTH / case.heights.shape[0]
    end = UNTIL * case.unit
    instants = (0.0, RAMP * case.unit, 2 * end)

    def history(first: float, last: float) -> History:
        return History(times=instants, values=(first, last * first, last * first))

    s = scene()
    plan = Transient(
        end, speed=history(SPEED, motion.speed), load=history(s.bodies.load, motion.load), tolerance=tolerance
    )
    model = prepare(s.with_(transient=plan), lubfric.Surface(case.heights, (cell, cell)))
    return lubfric.transient(averaged(model), case.times)


def checks_of(
    case: RampCase, moments: list[SharedMoment], history: lubfric.TransientResult, level: str
) -> Iterator[Item]:
    """Contact load and mean gap of both programs at each moment."""
    for k, moment in enumerate(moments):
        name = f"{case.motion.name}, t = {moment.time / case.unit:.1f} b/U0"
        yield Check(
            f"{name}: asperity load over the total load at the start",
            history.contact_load[k] / case.bodies.load,
            expected=moment.contact_load / case.bodies.load,
            tolerance=LOAD[level],
            source=SOURCE,
            kind=ABSOLUTE,
        )
        yield Check(
            f"{name}: mean gap",
            history.mean_gap[k],
            expected=moment.mean_gap,
            tolerance=GAP[level],
            source=SOURCE,
            unit="m",
        )


def grids(motion: Motion, runs: list[tuple[RampCase, list[SharedMoment], lubfric.TransientResult]]) -> Iterator[Item]:
    """The largest differences between both programs on each grid, with their orders."""
    sizes = []
    loads = []
    gaps = []
    for case, moments, history in runs:
        sizes.append(1e6 * LENGTH / len(case.heights))
        by_moment = np.array([(moment.contact_load, moment.mean_gap) for moment in moments])
        loads.append(float(np.abs(history.contact_load - by_moment[:, 0]).max()) / case.bodies.load)
        gaps.append(float(np.abs(history.mean_gap / by_moment[:, 1] - 1).max()))
    why = "finite elements as fine as the cells: at least first order at the edges of asperity contacts"
    name = f"{motion.name}: difference in mean gap: order in the cell size"
    series = [Series("asperity load ratio", sizes, errors=loads), Series("mean gap", sizes, errors=gaps)]
    yield replace(series[-1], order=1.0, check=name, tolerance=0.3, source=why, kind=AT_LEAST).check_order()
    caption = f"{motion.name}: largest difference between lubfric and the finite elements over the cell of the contact."
    stem = f"sharing_in_time_{'speed' if motion.speed < 1 else 'load'}"
    yield from convergence(stem, caption, series, "cell (µm)", "difference")


def steps(case: RampCase, moments: list[SharedMoment], history: lubfric.TransientResult, level: str) -> Iterator[Item]:
    """The asperity load during the ramp in ever shorter steps of both programs."""
    name = case.motion.name
    counts = [round(STEPS[level] / longer) for longer in LONGER]
    lengths = [UNTIL / count for count in counts]
    long, short = (by_elements(case, count, REFINED[level]) for count in (counts[0], counts[-1]))
    runs = (long, moments, short)
    loads = [float(run[DURING].contact_load) for run in runs]
    order = order_of_three(lengths, loads)
    why = "BDF2: second order"
    what = f"{name}: order of the asperity load in the step of the elements"
    yield Check(what, order, expected=2.0, tolerance=0.5, source=why, kind=ABSOLUTE, grade="B")
    without_steps = float(extrapolated_by(2.0, lengths, loads))
    looser = [by_lubfric(case, tolerance) for tolerance in TOLERANCES[:-1]]
    own_loads = [float(run.contact_load[DURING]) for run in (*looser, history)]
    changes = np.abs(np.diff(own_loads)) / case.bodies.load
    what = f"{name}: asperity load ratio of lubfric, changed by a ten times smaller tolerance"
    yield bound(what, float(changes[-1]), SHORT, "a tolerance of the steps")
    what = f"{name}: the change over that by the tolerance before"
    yield bound(what, float(changes[-1] / changes[-2]), 0.7, "errors fall with the tolerance")
    what = f"{name}: asperity load ratio of lubfric, and of the elements without steps: difference"
    yield bound(what, abs(own_loads[-1] - without_steps) / case.bodies.load, LOAD[level], SOURCE)


def lag(case: RampCase, moments: list[SharedMoment], _: lubfric.TransientResult) -> Check:
    """Return the contact load at the end of the ramp compared with the steady one at that speed."""
    cell = LENGTH / case.heights.shape[0]
    model = averaged(prepare(scene(), lubfric.Surface(case.heights, (cell, cell))))
    steady = lubfric.friction(model, SPEED * case.motion.speed)
    ahead = 1 - moments[PARTS // 2].contact_load / steady.contact_load
    name = "the film lags: contact load below the steady one at the end of the ramp"
    source = "the film was made at a higher speed"
    return Check(name, ahead, expected=0.02, tolerance=0.0, source=source, kind=AT_LEAST, grade="B")


def rows_of(case: RampCase, moments: list[SharedMoment], history: lubfric.TransientResult) -> list[tuple[str, ...]]:
    """Return the rows of the table."""
    return [
        (
            case.motion.name.split()[0],
            f"{moments[k].time / case.unit:.1f}",
            f"{moments[k].contact_load:.4f}",
            f"{history.contact_load[k]:.4f}",
            f"{1e9 * moments[k].mean_gap:.2f}",
            f"{1e9 * history.mean_gap[k]:.2f}",
        )
        for k in SHOWN
    ]
