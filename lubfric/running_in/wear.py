"""Wear of a rough surface that passes through its lubricated contact, step by step: `worn_in`.

At each step film and contact share the load again (Eq. 8, `lubfric.models.load_sharing`), on windows of the map that
lie a Hertz strip apart. The asperity pressure of that balance wears the map by Archard's law (`lubfric.contact.wear`).
The steps are implicit: their pressure is that at the end of the step. They are as long as the asperity load lets them
be.

The other body wears as well, by its own hardness. Its points meet those of the rough body in ever other pairs, so that
it is lowered evenly, and keeps its shape.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base import FrozenArrays, Shown, figures
from .._base.progress import report_progress
from ..contact import BOUNDARY, HalfSpace, HalfSpaceContact, Passage, half_space, operator_under, passage, solve_contact
from ..errors import ConvergenceError, InputError, WorkLimitError
from ..estimate import estimated_work_of_point, friction
from ..models import ALL_TOUCH, prepare
from ..models.load_sharing import Balance, solve_balance
from ..samples import cylinder_of, flat_contact_of, half_space_contact_of
from ..scene import Scene
from ..surface import Surface
from ..units import converted, printed, unit_of_largest

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Choices between time and error, or scatter.
LIFT_OFF = 0.01  # asperity load ratio at which a surface counts as lifted off
VANISHED = 1e-3  # asperity load ratio below which wear ends: what is left would take as long as all before
CHANGE = 0.1  # relative change of the asperity load that a step aims at
REJECTED = 0.25  # relative change of the asperity load from which a step is made again, shorter
FIRST_WEAR_DEPTH = 0.01  # mean depth of the first step over the Sq of the map, at most
WEAR_STEP_GROWTH = 2.0  # of the length of a step from one to the next, at most
SHRINKAGE = 0.2  # of it, at least
MOST_STEPS = 1000  # of one run: some 70 take the asperity load from the whole load to VANISHED
STEPS_TO_VANISHED = 70.0  # about, that take the asperity load from the whole load to VANISHED
RECORDED = "friction at distances of wear"  # a part of the progress
RECORDS = 9  # distances at which friction and lift-off speed are found: 0, and eight that double
MOST_WINDOW_CELLS = 4_000_000  # of all windows together: memory
SPEED_TOLERANCE = 5e-3  # of ln U, in the search of the lift-off speed
LIFT_OFF_SEARCH = 12.0  # of ln U, each way from the scene's speed, in which the lift-off speed is looked for
NORMAL_95 = 1.96  # half of the 95 % interval of a normal distribution over its standard deviation, by definition
FEWEST_WEAR_WINDOWS = 4  # from which their scatter gives an interval
NM = 1e9  # nanometres in a metre, by definition
# Balances of a record: that of its own speed, and some ten of its lift-off speed (98 were measured in nine records of a
# random run).
BALANCES_OF_RECORD = 11

# Records of a run whose asperities carry nothing, after which wear ends: the first and one after it. A choice: one
# alone may be chance.
RECORDS_WITHOUT_LOAD = 2

# Processor seconds of a balance, whatever its cells; and over its cells. Measured on the runs of
# `verification.campaigns.estimates`.
BALANCE_SECONDS = 0.02
BALANCE_CELL_SECONDS = 6e-7


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Wear(FrozenArrays, Shown):
    """What wear changes over the sliding distance, from `lubfric.run_in`. One entry for each recorded distance.

    Attributes
    ----------
    distance : sliding of each surface point inside the contact since the plastic run-in [m], (n,)
    sq, sk, spk, svk : of the map [m], (n,) each
    depth : mean depth worn off the rough body [m], (n,)
    volume, counterface_volume : worn off the rough body, on the area of the map, and off the same area of the other
        body, by its hardness [m³], (n,) each
    asperity_load_ratio : F_C/F_T [-], (n,)
    coefficient : friction coefficient at the speed of the scene [-], (n,)
    interval : its 95 % interval (lowest, highest) [-], (n, 2); NaN where an end is not known
    lift_off_speed : speed [m/s] at which the asperities carry 1 % of the load, (n,); NaN where none was found
    lift_off_interval : its 95 % interval by the scatter of the windows of the map [m/s], (n, 2); NaN for fewer than
        four
    volume_error : relative error of the worn volume by the length of the steps [-]
    steps : number of steps
    stopped : why the run ended
    notes : why a number is NaN
    """

    distance: np.ndarray
    sq: np.ndarray
    sk: np.ndarray
    spk: np.ndarray
    svk: np.ndarray
    depth: np.ndarray
    volume: np.ndarray
    counterface_volume: np.ndarray
    asperity_load_ratio: np.ndarray
    coefficient: np.ndarray
    interval: np.ndarray
    lift_off_speed: np.ndarray
    lift_off_interval: np.ndarray
    volume_error: float
    steps: int
    stopped: str
    notes: tuple[str, ...] = ()

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw Sq, lift-off speed and asperity load ratio over the distance, each over its first value, on ``ax`` or
        new axes. Without asperity load there is no such ratio to draw."""
        axes = figures.axes_or_new(ax)
        first = self.lift_off_speed[0]
        unit = unit_of_largest(self.distance.tolist(), "m")
        over = converted(self.distance, "m", unit)
        low, high = self.lift_off_interval.T / first
        axes.plot(over, self.sq / self.sq[0], "o-", ms=4, color=figures.GREY, label="Sq")
        axes.plot(over, self.lift_off_speed / first, "s-", ms=4, color=figures.BLUE, label="lift-off speed")
        if np.isfinite(low).any():
            axes.fill_between(over, low, high, color=figures.BLUE, alpha=0.2, lw=0, label="its 95 % interval")
        ratio = self.asperity_load_ratio
        if ratio[0] > 0:
            axes.plot(over, ratio / ratio[0], "^-", ms=4, color=figures.RED, label="asperity load ratio")
        axes.set(xlabel=f"sliding distance in the contact ({printed(unit)})", ylabel="value over its first (-)")
        axes.set_ylim(bottom=0, top=1.05 * axes.get_ylim()[1])
        figures.key_above(axes, 2)
        return axes

    def _facts(self) -> dict[str, str]:
        return {
            "distance": f"{self.distance[-1]:.4g} m",
            "depth": f"{self.depth[-1] * NM:.4g} nm",
            "Sq": f"{self.sq[0] * NM:.4g} to {self.sq[-1] * NM:.4g} nm",
            "lift-off speed": f"{self.lift_off_speed[0]:.4g} to {self.lift_off_speed[-1]:.4g} m/s",
            "f": f"{self.coefficient[0]:.4g} to {self.coefficient[-1]:.4g}",
            "": self.stopped,
        }


@dataclass(frozen=True, kw_only=True)
class _WearRig:
    """What all steps share: the scene at its speed, the map that wears, and the operators of map and windows."""

    scene: Scene
    speed: float
    surface: Surface
    under: HalfSpace
    stack: HalfSpace

    @property
    def flat(self) -> bool:
        """Whether the roughness is spread over the Hertz strip, so that no window is needed."""
        return self.scene.contact.geometry == "flat"


@dataclass(frozen=True, kw_only=True)
class _WearStep:
    """The end of one step: the balance, the heights [m] of the map after it, and the pressure [Pa] by window."""

    balance: Balance
    heights: np.ndarray
    by_window: np.ndarray

    @property
    def ratio(self) -> float:
        """Asperity load ratio F_C/F_T."""
        return self.balance.contact_load / (self.balance.contact_load + self.balance.film_load)


def worn_in(
    scene: Scene, surface: Surface, *, distance: float, coefficient: float, hardness: tuple[float, float]
) -> tuple[Surface, Wear, str]:
    """Return ``surface`` after wear, what changed over the distance, and what was reached, if a limit of counted work
    ended it there ("" if not).

    Parameters
    ----------
    scene : with a speed, sliding, and one rough body on half-spaces
    surface : the map after the plastic run-in, periodic along y
    distance : sliding of each surface point inside the contact [m]
    coefficient : K of V = K F s/H [-]
    hardness : H [Pa] of the rough body, and of the other one

    Raises `InputError` for a map too large, and `ConvergenceError` for a balance that could not be solved.
    """
    rig = _rig(scene, surface)
    heights = surface.heights.copy()
    rows = [_record(rig, heights, 0.0)]
    progress = _WearProgress(
        length=_first_length(rig, rows[0], coefficient, hardness[0]), ratios=(rows[0]["asperity_load_ratio"],)
    )
    stopped = f"the distance of {distance:g} m was reached"
    ended = ""
    for record in range(1, RECORDS):
        aim = distance * 2.0 ** (record - RECORDS + 1)
        try:
            while progress.distance < aim and not progress.has_vanished:
                heights, progress = _advance(rig, heights, progress, aim, coefficient / hardness[0])
                report_progress("wear", round(100 * progress.distance / distance), 100)
            rows.append(_record(rig, heights, progress.distance))
            report_progress(RECORDED, record, RECORDS - 1)
        except WorkLimitError as error:
            ended = f"{progress.distance:.4g} of {distance:g} m of wear are done"
            stopped = f"numerics.max_work = {error.limit:.4g} s: {ended}, and recorded to {rows[-1]['distance']:.4g} m"
            break
        if progress.has_vanished:
            share = f"{100 * VANISHED:g} % of the load"
            stopped = f"the asperities carry less than {share} from {progress.distance:.4g} m on: wear ended there"
            break
    note = f"worn: K {coefficient:g}, {progress.distance:.4g} m"
    after = replace(surface, heights=heights, notes=(*surface.notes, note))
    return after, _history(rig, rows, hardness, progress, stopped), ended


@dataclass(frozen=True, kw_only=True)
class _WearProgress:
    """How far a run has come.

    distance [m] so far; length [m] of the next step; steps tried; ``ratios``: asperity load ratios at the beginning of
    the last two steps; ``work`` and ``error`` [m]: the ratio summed over the distance, and its error by the length of
    the steps; ``start``: the last balance.
    """

    length: float
    distance: float = 0.0
    steps: int = 0
    ratios: tuple[float, ...] = ()
    work: float = 0.0
    error: float = 0.0
    start: Balance | None = None

    @property
    def has_vanished(self) -> bool:
        """Whether the asperities carried less than `VANISHED` of the load at the beginning of the last two steps."""
        return max(self.ratios) < VANISHED


def estimated_wear(scene: Scene, surface: Surface, distance: float, coefficient: float, hardness: float) -> float:
    """Return the estimated processor seconds of `worn_in` on a map like ``surface`` over a ``distance`` [m]: the
    balances of all its windows, and f of each record by the scene's model. ``coefficient``, ``hardness`` [Pa]: as
    there.

    A step changes the asperity load by `CHANGE`, for which it wears about as large a part of Sq, and there is one to
    each record at least.
    """
    rig = _rig(scene, surface)
    one = BALANCE_SECONDS + BALANCE_CELL_SECONDS * math.prod(rig.stack.shape)
    prepared = prepare(scene, _sample_of(rig, surface))
    point = estimated_work_of_point(scene, prepared.sample, prepared.surface, rig.speed)
    records = RECORDS if point.asperities == ALL_TOUCH else RECORDS_WITHOUT_LOAD
    pressure = scene.bodies.load / cylinder_of(scene).hertz_area
    depth = coefficient * pressure * distance / hardness / max(surface.sq, 1e-12)
    steps = records - 1 + min(depth / CHANGE, STEPS_TO_VANISHED)
    return records * (point.seconds + BALANCES_OF_RECORD * one) + 2 * steps * one


def _sample_of(rig: _WearRig, surface: Surface) -> Surface:
    """Return the map on which f of ``surface`` is found: under a cylinder its windows, side by side."""
    if rig.flat:
        return surface
    stacked = _passage(rig, 0).stacked(surface.heights)
    return replace(surface, heights=stacked, mask=None, periodic_axes=(False, True))


def _first_length(rig: _WearRig, row: dict[str, Any], coefficient: float, hardness: float) -> float:
    """Return the length [m] of the first step: it wears `FIRST_WEAR_DEPTH` of Sq."""
    pressure = row["asperity_load_ratio"] * rig.scene.bodies.load / cylinder_of(rig.scene).hertz_area
    return FIRST_WEAR_DEPTH * max(rig.surface.sq, 1e-12) * hardness / (coefficient * pressure) if pressure else math.inf


def _advance(
    rig: _WearRig, heights: np.ndarray, progress: _WearProgress, aim: float, rate: float
) -> tuple[np.ndarray, _WearProgress]:
    """Return heights [m] and progress after one step towards the distance ``aim`` [m], or after its rejection.

    rate : K/H [1/Pa]. Both ends of a step are solved on the same windows, so that only wear changes the asperity load.
    """
    length = min(progress.length, aim - progress.distance)
    turn = progress.steps + 1
    if turn > MOST_STEPS:
        raise ConvergenceError(
            f"wear: {MOST_STEPS} steps end at {progress.distance:.4g} m, with an asperity load ratio of "
            f"{progress.ratios[-1]:.3g} that still changes. Give a shorter distance or a smaller wear_coefficient"
        )
    begin = _step(rig, heights, 0.0, turn, progress.start)
    ratios = (*progress.ratios[-1:], begin.ratio)
    if begin.ratio == 0:
        return heights, replace(progress, steps=turn, ratios=ratios, distance=progress.distance + length)
    end = _step(rig, heights, rate * length, turn, begin.balance)
    change = abs(end.ratio - begin.ratio) / begin.ratio
    factor = min(max(CHANGE / max(change, 1e-12), SHRINKAGE), WEAR_STEP_GROWTH)
    if change > REJECTED:
        return heights, replace(progress, steps=turn, start=begin.balance, length=factor * length)
    last = aim - progress.distance <= length
    return end.heights, _WearProgress(
        length=max(factor * length, progress.length) if last else factor * length,
        distance=aim if last else progress.distance + length,
        steps=turn,
        ratios=ratios,
        work=progress.work + end.ratio * length,
        error=progress.error + 0.5 * abs(end.ratio - begin.ratio) * length,
        start=end.balance,
    )


def _rig(scene: Scene, surface: Surface) -> _WearRig:
    """Return what all steps share."""
    cylinder = cylinder_of(scene)
    workers = scene.numerics.workers
    if scene.contact.geometry == "flat":
        operator = half_space(surface.shape, surface.spacing, cylinder.e_prime, workers=workers)
        return _WearRig(scene=scene, speed=_speed(scene), surface=surface, under=operator, stack=operator)
    under = operator_under(surface.heights, surface.spacing, cylinder, workers)
    windows = len(passage(surface.shape, cylinder, under, periodic=surface.periodic_axes[0]).columns)
    shape = under.shape[0], windows * surface.shape[1]
    if math.prod(shape) > MOST_WINDOW_CELLS:
        raise InputError(
            f"surface: {windows} windows of {under.shape[0]} x {surface.shape[1]} cells are {math.prod(shape):.3g} "
            f"cells; allowed: up to {MOST_WINDOW_CELLS:.3g} (crop the map, or resample it on longer cells)"
        )
    stack = half_space(shape, surface.spacing, cylinder.e_prime, BOUNDARY, workers=workers)
    return _WearRig(scene=scene, speed=_speed(scene), surface=surface, under=under, stack=stack)


def _speed(scene: Scene) -> float:
    return scene.motion.entrainment_speed


def _passage(rig: _WearRig, turn: int) -> Passage:
    periodic = rig.surface.periodic_axes[0]
    return passage(rig.surface.shape, cylinder_of(rig.scene), rig.under, periodic=periodic, turn=turn)


def _contact(rig: _WearRig, heights: np.ndarray, compliance: float, windows: Passage) -> HalfSpaceContact:
    """Return the contact of all windows of the map, whose cells sink by wear as well."""
    stacked = windows.stacked(heights)
    operator = rig.stack.with_layer(windows.dose * compliance) if compliance else rig.stack
    return half_space_contact_of(rig.scene, stacked - stacked.mean(), rig.surface.spacing, operator=operator)


def _step(rig: _WearRig, heights: np.ndarray, compliance: float, turn: int, start: Balance | None) -> _WearStep:
    """Return the end of a step in which a pressure p wears the depth ``compliance`` p, from ``heights`` [m]."""
    if rig.flat:
        return _flat_step(rig, heights, compliance, start)
    windows = _passage(rig, turn)
    contact = _contact(rig, heights, compliance, windows)
    balance = solve_balance(rig.scene, rig.speed, contact, float(contact.heights.std()), start)
    balance.report.raise_if_failed(balance)
    fields = balance.contact_state.fields
    if fields is None:  # separated
        empty = np.zeros((len(windows.columns), contact.heights.shape[0], windows.rows))
        return _WearStep(balance=balance, heights=heights, by_window=empty)
    worn = windows.worn(heights, fields.pressure, compliance) if compliance else heights
    return _WearStep(balance=balance, heights=worn, by_window=windows.by_window(fields.pressure))


def _flat_step(rig: _WearRig, heights: np.ndarray, compliance: float, start: Balance | None) -> _WearStep:
    """Return the end of a step of a flat contact: the load of its beginning, the pressure of its end."""
    scene = rig.scene
    flat = heights - heights.mean()
    contact = flat_contact_of(scene, flat, rig.surface.spacing)
    balance = solve_balance(scene, rig.speed, contact, float(flat.std()), start)
    balance.report.raise_if_failed(balance)
    mean_pressure = balance.contact_load / cylinder_of(scene).hertz_area
    solved = solve_contact(
        -flat,
        rig.surface.spacing,
        scene.bodies.e_prime,
        mean_pressure=mean_pressure,
        hardness=scene.bodies.hardness,
        operator=rig.stack.with_layer(compliance),
        tolerance=scene.numerics.tolerance_of("contact"),
    )
    worn = heights - compliance * solved.pressure
    return _WearStep(balance=balance, heights=worn, by_window=solved.pressure[None])


def _record(rig: _WearRig, heights: np.ndarray, distance: float) -> dict[str, Any]:
    """Return the numbers of one recorded distance [m], of the map with these ``heights`` [m]."""
    surface = replace(rig.surface, heights=heights)
    state = _step(rig, heights, 0.0, 0, None)
    result = friction(prepare(rig.scene, _sample_of(rig, surface)), rig.speed)
    curve = surface.bearing()
    speed, ends, note = _lift_off(rig, state)
    return {
        "distance": distance,
        "mean_height": float(heights.mean()),
        "sq": surface.sq,
        "sk": curve.sk,
        "spk": curve.spk,
        "svk": curve.svk,
        "asperity_load_ratio": state.ratio,
        "coefficient": result.coefficient,
        "interval": result.uncertainty.interval,
        "lift_off_speed": speed,
        "lift_off_interval": ends,
        "note": note,
    }


def _lift_off(rig: _WearRig, state: _WearStep) -> tuple[float, tuple[float, float], str]:
    """Return the speed [m/s] at which the asperities carry `LIFT_OFF` of the load, its 95 % interval, and a note.

    The interval is by the scatter of the load over the windows of the map, and how the load falls with the speed. The
    note says why there is no speed, where there is none.
    """
    from scipy.optimize import brentq

    sense = math.copysign(1.0, rig.speed)
    solved: dict[float, _WearStep] = {}

    def excess(log_speed: float) -> float:
        """Return the logarithm of the asperity load ratio over `LIFT_OFF`; no asperity load counts as a millionth."""
        near = min(solved, key=lambda other: abs(other - log_speed), default=None)
        start = state.balance if near is None else solved[near].balance
        there = replace(rig, speed=sense * math.exp(log_speed))
        solved[log_speed] = _step(there, state.heights, 0.0, 0, start)
        return math.log(max(solved[log_speed].ratio, 1e-6) / LIFT_OFF)

    unknown = (math.nan, math.nan)
    try:
        bracket = _bracket(excess, math.log(abs(rig.speed)))
        if bracket is None:
            return math.nan, unknown, "no speed was found at which the asperities carry 1 % of the load"
        root = float(brentq(excess, *bracket, xtol=SPEED_TOLERANCE))
    except WorkLimitError:
        raise
    except ConvergenceError as error:
        return math.nan, unknown, f"lift-off speed: a balance on the way was not solved ({error})"
    speed = sense * math.exp(root)
    exponent = _load_ratio_exponent(solved, root)
    loads = solved[min(solved, key=lambda at: abs(at - root))].by_window.sum(axis=(1, 2))
    if loads.size < FEWEST_WEAR_WINDOWS or not exponent or not loads.any():
        return speed, unknown, ""
    scatter = float(loads.std(ddof=1) / math.sqrt(loads.size) / loads.mean())
    half = NORMAL_95 * scatter / exponent
    return speed, (speed * math.exp(-half), speed * math.exp(half)), ""


def _load_ratio_exponent(solved: dict[float, _WearStep], root: float) -> float:
    """Return -d ln(F_C/F_T)/d ln U between the two solved speeds next to ``root``; 0 if there are none with load."""
    loaded = [(log_speed, step.ratio) for log_speed, step in solved.items() if step.ratio > 0]
    (first, *others) = sorted(loaded, key=lambda point: abs(point[0] - root))
    apart = [point for point in others if abs(point[0] - first[0]) > SPEED_TOLERANCE]
    return abs(math.log(apart[0][1] / first[1]) / (apart[0][0] - first[0])) if apart else 0.0


def _bracket(excess: Callable[[float], float], start: float) -> tuple[float, float] | None:
    """Return two logarithms of a speed between which ``excess``, falling, is zero; None if there are none."""
    value = excess(start)
    step = math.copysign(1.0, value)
    before = start
    while abs(before + step - start) <= LIFT_OFF_SEARCH:
        here = before + step
        if excess(here) * value <= 0:
            return min(before, here), max(before, here)
        before = here
    return None


def _history(
    rig: _WearRig, rows: list[dict[str, Any]], hardness: tuple[float, float], progress: _WearProgress, stopped: str
) -> Wear:
    """Return the record of a run."""
    area = math.prod(rig.surface.size)
    column = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    mean_height = column.pop("mean_height")
    reasons = [note for note in column.pop("note").tolist() if note]
    depth = mean_height[0] - mean_height
    return Wear(
        depth=depth,
        volume=depth * area,
        counterface_volume=depth * area * hardness[0] / hardness[1],
        volume_error=progress.error / progress.work if progress.work else 0.0,
        steps=progress.steps,
        stopped=stopped,
        notes=tuple(dict.fromkeys(reasons)),
        **column,
    )
