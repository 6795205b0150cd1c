"""What a run gives: `TransientResult`, with its report, and friction over time and over the speed drawn."""

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base import FloatArray, Shown, figures, validate
from ..errors import Report
from ..estimate import UncertaintyCurve
from ..models.shared import (
    Validity,
    gathered,
    percent,
    student,
)
from ..quantities import OF_MOMENT, axis_label
from ..scene import FRICTION as FRICTION_KEY
from ..scene import value_of
from ..units import worded
from .march import Plan, Progress, Residual, grid_residual, report_of
from .model import Output, TimeModel

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MANY = 30  # blocks less one: of a strip
NOT_IN = "not in the interval, as a run in time is solved with its value alone; solve it with both ends to see"
TINY = 1e-30  # no f is divided by less
MASS = 1e-3  # largest residual of a step's mass


@dataclass(frozen=True)
class TimeAverage:
    """The mean of f over the time in which the surfaces of a run move (at a standstill there is no f), the share
    ``in_motion`` of that time, and relative standard deviations.

    - ``sampling``: of ``coefficient``, because one finite line of rough surface stands for all of it. The line is the
      same at all times, so a longer run does not make this smaller.
    - ``fixed_scatter``: of the averages of real lines of the contact's width from place to place, if the same spots
      stay in contact.
    - ``moving_scatter``: the same if the rough surface moves through the contact with the entrainment speed. Then other
      spots carry the load every `TransientResult.renewal`.
    """

    coefficient: float
    sampling: float
    fixed_scatter: float
    moving_scatter: float
    in_motion: float = 1.0


@dataclass(frozen=True, repr=False)
class TransientResult(Shown):
    """Numbers of a run over time: one array (nt,) for each name of `lubfric.quantities.OF_MOMENT`, also as attributes.

    Attributes
    ----------
    columns : all of them by name, such as: time [s]; coefficient [-], the tangential force on the upper surface in the
        direction in which it slides over the lower one (in pure rolling: moves), over F_T; friction_force and its parts
        [N], along +x; mean_film and mean_gap [m], both sides of Eq. (8); wet_from and wet_to [m], the ends of the
        pressurised film; net_inflow, stored and cavity_growth [m²/s], the balance of the lubricant over the last step,
        per unit width; time_error [-], the local error of the last step over the tolerance; sampling_error [-], the
        relative standard error of f because the line of rough surface is finite (`lubfric.estimate.moment_error`; the
        line is the same at all times, so this error of f has the same sign throughout); inlet_film_factor [-],
        flash_temperature_rise and film_temperature_rise [K], as in `lubfric.FrictionResult`, of the steady motion at
        the speeds of the moment; heat_change [-], the relative change of f by the two rises; shear_error [-], the
        estimated relative error of f by the sum of the film's shear stress; edge_load [-], the share of the contact's
        load on the edge columns of its patch
    x : (nx,) [m]
    pressure, film_thickness : of the smooth film at the output times, (nt, nx) [Pa, m]; in the deterministic model, means over y
    report : how the run ended
    entries : the assumptions that do not hold at each output (`lubfric.Validity`); ``validity`` gathers them
    inputs : how far the range of f_b moves f down and up at every time [-], (2, nt)
    not_in : inputs, in words, whose ranges are not in ``uncertainty``: a run is solved with their values alone
    requested : the output times [s] of the run, whether or not they were reached
    line_length, width, renewal : length of the line of rough surface, width of the contact, and the distance that a
        surface moves until other spots carry the load (the Hertz strip and a correlation length) [m]; NaN if not known
    """

    columns: dict[str, np.ndarray]
    x: np.ndarray
    pressure: np.ndarray
    film_thickness: np.ndarray
    report: Report
    entries: tuple[tuple[Validity, ...], ...] = ()
    inputs: np.ndarray | float = 0.0
    not_in: tuple[str, ...] = ()
    line_length: float = math.nan
    width: float = math.nan
    renewal: float = math.nan
    requested: np.ndarray | tuple[float, ...] = ()

    @property
    def status(self) -> str:
        """What was reached, in sentences; the first words are "Converged", "Not converged" or "Refused"."""
        times = self.requested if len(self.requested) else self.time
        count = len(times)
        end = worded(float(times[-1]), "s")
        if not self.report.converged:
            return f"Not converged: {self.report.message.partition(': ')[2]}."
        severe = [any(entry.severe for entry in entries) for entries in self.entries]
        if any(severe):
            return (
                f"Refused: all {count} outputs to t = {end} are solved, but at {sum(severe)} of them an assumption "
                "fails so badly that f means nothing (see the warnings)."
            )
        return f"Converged: all {count} outputs to t = {end} are solved, and every residual is within its tolerance."

    def average(self) -> TimeAverage:
        """The average of f over the time in motion, by trapezes between the outputs (which have to be dense enough to
        show f; one at a standstill counts nothing); its error; and its scatter for fixed and for moving roughness."""
        half = 0.5 * np.diff(self.time)
        moving = in_motion(self.columns)
        weight = np.append(half, 0.0) + np.append(0.0, half) if half.size else np.ones(1)
        share = float(weight[moving].sum() / weight.sum())
        if not share:
            return TimeAverage(math.nan, math.nan, math.nan, math.nan, share)
        names = "coefficient", "sampling_error", "entrainment_speed"
        f, error, speed = (self.columns[name][moving] for name in names)
        weight = weight[moving]
        mean = float(np.average(f, weights=weight))
        sampling = float(np.average(error * np.abs(f), weights=weight)) / abs(mean)
        fixed = sampling * math.sqrt(self.line_length / self.width)
        moved = float(np.sum(weight * np.abs(speed)))
        return TimeAverage(mean, sampling, fixed, fixed / math.sqrt(max(1.0, moved / self.renewal)), share)

    @property
    def validity(self) -> tuple[str, ...]:
        """One sentence for each assumption that does not hold at some time."""
        return gathered(list(zip(self.time.tolist(), self.entries)), "s", "times")

    @property
    def uncertainty(self) -> UncertaintyCurve:
        """Standard error and 95 % interval of f at every time, from the finite surface and the range of f_b alone."""
        f = self.coefficient
        error = self.sampling_error
        half = student(MANY) * error * np.abs(f)
        unknown = np.full(f.size, math.nan)
        down, up = np.broadcast_to(self.inputs, (2, f.size))
        return UncertaintyCurve(
            numerical=unknown,
            sampling=error,
            interval=np.stack([f - np.hypot(half, down), f + np.hypot(half, up)], axis=1),
            line_scatter=error * math.sqrt(self.line_length / self.width),
            spots=unknown,
            length=np.full(f.size, self.line_length),
            area_needed=unknown,
            model=unknown,
            inputs=unknown if self.not_in else np.maximum(down, up) / np.maximum(np.abs(f), TINY),
            text=tuple("; ".join((f"surface {percent(each)}", *self.not_in)) for each in error),
        )

    def plot(self, ax: "Axes | None" = None):
        """Friction over time, with its parts, on ``ax`` or new axes, which are returned."""
        axes = figures.axes_or_new(ax)
        (low, high) = self.uncertainty.interval.T
        if (high > low).any():
            time = self.time * time_scale(self.time[-1])[0]
            label = f"95 % interval: sampling{', range of f_b' * bool(np.any(self.inputs))}"
            axes.fill_between(time, low, high, color=figures.BLUE, alpha=0.2, lw=0, label=label)
        friction_over_time(axes, self.columns)
        return axes

    def plot_loop(self, ax: "Axes | None" = None):
        """Friction over speed, the hysteresis loop with its start marked, on ``ax`` or new axes, which are returned.
        At a standstill no friction coefficient is defined, and none is drawn."""
        axes = figures.axes_or_new(ax)
        speed = self.entrainment_speed
        moving = in_motion(self.columns)
        friction = np.where(moving, self.coefficient, np.nan)
        begin = np.flatnonzero(moving)[:1]
        axes.plot(speed, friction, color=figures.BLUE)
        axes.plot(speed[begin], friction[begin], "o", color=figures.GREY, label="start")
        axes.set(xlabel=axis_label("speed"), ylabel=figures.FRICTION)
        axes.legend(frameon=False)
        return axes

    def _facts(self) -> dict[str, str]:
        facts = {"": f"{self.time.size} times"}
        t = self.time
        f = self.coefficient
        if t.size:
            facts |= {"t": f"{t[0]:.4g} to {t[-1]:.4g} s", "f": f"{f.min():.4g} to {f.max():.4g}"}
        return facts | {"status": self.report.status}

    def __getattr__(self, name: str) -> FloatArray:
        columns = self.__dict__.get("columns", {})
        if name in columns:
            return columns[name]
        raise AttributeError(f"TransientResult has no attribute {name!r}{validate.nearest(name, columns)}")


def collect(
    model: TimeModel,
    grid_error: float,
    plan: Plan,
    progress: Progress,
    outputs: list[Output],
    most_work: float = math.inf,
) -> TransientResult:
    """Return the result of the ``outputs`` so far. ``grid_error``: of a steady start, or NaN; ``most_work``: as in
    `report_of`."""
    columns = {name: np.array([o.numbers.get(name, math.nan) for o in outputs], float) for name in OF_MOMENT}
    shape = (-1, model.x.size)
    residuals = {
        "mass": _residual(columns, "mass_residual", MASS, "the balance of the lubricant"),
        "volume": _residual(columns, "volume_residual", model.tolerance, "the balance of gap and film"),
    }
    if not math.isnan(grid_error):
        residuals["grid"] = grid_residual(grid_error / model.scene.numerics.tolerance_of("film"))
    sampling = float(np.max(columns["sampling_error"], initial=0.0))
    surface = "not known" if math.isnan(sampling) else f"standard error of f at most {percent(sampling)}"
    prepared = model.prepared
    renewal = math.nan
    ends = {name: [end - value_of(prepared.scene, name) for end in both] for name, *both in prepared.scene.ranges}
    by_load = columns["contact_load"] / columns["load"] * (columns["sliding_speed"] != 0)
    low, high = ends.pop(FRICTION_KEY, (0.0, 0.0))
    not_in = tuple(f"{name.partition('.')[2]} in its range: {NOT_IN}" for name in ends)
    report = report_of("run in time", plan, progress, f"{model.cells}; surface: {surface}", residuals, most_work)
    if not prepared.sample.is_single_patch:
        renewal = 2 * prepared.scene.bodies.half_width + math.sqrt(math.pi) * prepared.sample.lengths[0]
    return TransientResult(
        columns=columns,
        x=model.x,
        pressure=np.array([output.pressure for output in outputs]).reshape(shape),
        film_thickness=np.array([output.film_thickness for output in outputs]).reshape(shape),
        report=replace(report, notes=(*report.notes, *model.notes, *not_in)),
        entries=tuple(output.entries for output in outputs),
        inputs=np.outer((-low, high), by_load),
        not_in=not_in,
        line_length=prepared.surface.size[1],
        width=prepared.scene.bodies.width,
        renewal=renewal,
        requested=plan.times,
    )


def _residual(columns: dict[str, np.ndarray], name: str, tolerance: float, what: str) -> Residual:
    """Return the largest residual ``name`` of all outputs, over its ``tolerance``; 0 where a model has none (NaN)."""
    size = np.nan_to_num(np.abs(columns[name]))
    if not size.any():
        return Residual(value=0.0, what=what)
    index = int(size.argmax())
    where = f"at output {index + 1}, t = {worded(float(columns['time'][index]), 's')}"
    speed = columns["entrainment_speed"]
    reversals = np.flatnonzero((speed[1:] * speed[:-1] < 0) | (speed[1:] == 0) & (speed[:-1] != 0)) + 1
    earlier = reversals[reversals <= index]
    if earlier.size:
        where += ", after the motion has reversed" if index > earlier[-1] else ", where the motion reverses"
    return Residual(value=float(size[index]) / tolerance, what=what, where=where)


def in_motion(c: dict[str, np.ndarray]) -> np.ndarray:
    """The times (bools) of the ``c`` of a `lubfric.TransientResult` at which a surface moves."""
    return (c["entrainment_speed"] != 0) | (c["sliding_speed"] != 0)


def friction_over_time(axes: "Axes", c: dict[str, np.ndarray]) -> None:
    """Friction over time with its parts, by the ``c`` of a `lubfric.TransientResult`. At rest there is none."""
    sense = np.where(c["sliding_speed"] != 0, c["sliding_speed"], c["entrainment_speed"])
    sense = np.where(sense < 0, -1.0, 1.0)  # of the coefficient
    scale, unit = time_scale(c["time"][-1])
    film = (c["couette_force"] + c["rolling_force"]) * sense / c["load"]
    moving = in_motion(c)
    parts = c["coefficient"], c["boundary_force"] * sense / c["load"], film
    figures.friction_lines(axes, c["time"] * scale, [np.where(moving, part, np.nan) for part in parts])
    if not moving.all():
        rest: dict[str, Any] = {"where": ~moving, "transform": axes.get_xaxis_transform(), "label": "at rest: no f"}
        axes.fill_between(c["time"] * scale, 0, 1, color=figures.GREY, alpha=0.2, lw=0, **rest)
    axes.set(xlabel=f"time ({unit})", ylabel=figures.FRICTION)
    figures.key_above(axes)


def time_scale(longest: float) -> tuple[float, str]:
    """(factor, unit) that shows times up to ``longest`` [s] as numbers above one."""
    for scale, unit in ((1.0, "s"), (1e3, "ms")):
        if longest * scale >= 1.0:
            return scale, unit
    return 1e6, "µs"
