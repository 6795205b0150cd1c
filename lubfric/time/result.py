"""What a run gives: `TransientResult`, with its report, and friction over time and over the speed drawn."""

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base import FloatArray, Renamed, Shown, figures
from ..errors import Report
from ..estimate import (
    CUT_AT_LIMIT,
    CUT_AT_ZERO,
    NAME_OF_INTERVAL,
    MethodUse,
    Uncertainty,
    UncertaintyCurve,
    cited,
    inputs_to_quote,
    methods_of,
)
from ..models.load_sharing import STATIONARY_ROLLING_RATIOS, largest_film_load_ratio, rolling_ratios_of
from ..models.shared import (
    UNKNOWN_SIDES,
    GatheredTexts,
    Prepared,
    Sliding,
    Violation,
    below_and_above,
    beside_asperities,
    gathered_on_curve,
    is_by_sliding,
    is_near_zero,
    largest_of_each,
    percent,
    student,
)
from ..quantities import OF_MOMENT, axis_label, counted
from ..scene import BOUNDARY_FRICTION_KEY, Scene, value_of
from ..units import worded
from .march import Plan, Progress, Residual, grid_residual, report_of
from .model import Output, TimeModel
from .registry import may_move_roughness, run_model_of
from .scene_in_time import roughness_moves, value_at
from .transient_deterministic import REST

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MANY_BLOCKS = 30  # blocks less one: of a strip; a choice: Student's t is 2.04 for 1.96
NOT_IN = (
    "not in the interval, because a run in time is solved with one value; solve it with both ends of the range to "
    "see the change"
)
TINY = 1e-30  # no f is divided by less; a choice: any number below all f does

# Outputs of a run that has a mean: a choice, one may be far from it.
FEWEST_OF_MEAN = 2

# Parts of the uncertainty budget (`lubfric.estimate.PARTS`) that a run in time does not have: the effect of an input
# that the scene does not give is not computed.
PARTS_NOT_IN_TIME = ("not given",)
POWER = ("power_loss", "power_loss_low", "power_loss_high")  # columns whose means are those of the whole run

# Difference of speeds and load, over the largest, below which two moments have the same conditions. A choice: a smaller
# value misses rounded periods.
SAME_CONDITIONS = 1e-3

# Difference of the asperity load ratio, and relative one of the film, from which two moments differ. A choice: what a
# figure shows.
OTHER_RATIO = 0.02
OTHER_FILM = 0.05

# Steps between the ticks of an axis of angles [°], and the most ticks of it. A choice, for round parts of a turn.
DEGREE_STEPS = (1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0, 360.0)
MOST_DEGREE_TICKS = 9.0
ANGLE_PAD = (
    33.0  # pt: from an axis of time to the numbers of the angle below its label; a choice, by looking at figures
)

MASS = 1e-3  # largest residual of a step's mass; a choice: less refuses runs, more leaves an error of the film


@dataclass(frozen=True, kw_only=True)
class TimeAverage:
    """The mean of f over the time in which the surfaces of a run move (at a standstill there is no f) and f is not that
    of rolling resistance (`lubfric.models.shared.is_by_sliding`), the share ``in_motion`` of that time, and relative
    standard deviations.

    - ``sampling``: of ``coefficient``, because one finite line of rough surface represents all of it. The line is the
      same at all times, so a longer run does not make this smaller.
    - ``fixed_scatter``: of the averages of real lines of the contact's width from place to place, if the same asperity
      contacts stay in contact.
    - ``moving_scatter``: the same if the rough surface moves through the contact with the entrainment speed. Then
      other asperities carry the load every `TransientResult.renewal`.

    ``coefficient_of_losses`` is f weighted by load and sliding speed, over all times: the work of sliding is it times
    the integral of the load over the sliding distance.

    ``interval`` is the 95 % interval of ``coefficient``, ``power_loss`` [W] the mean power loss of the whole run, with
    ``power_loss_interval``. The errors of all times are taken as fully correlated: a mean of their ends. ``budget`` has
    the parts of it, relative errors of ``coefficient`` below and above it at 95 %: numerical, sampling, model-form and
    input; NaN where a part is not known at any time.
    """

    coefficient: float
    sampling: float
    fixed_scatter: float
    moving_scatter: float
    in_motion: float = 1.0
    coefficient_of_losses: float = math.nan
    interval: tuple[float, float] = (math.nan, math.nan)
    budget: dict[str, tuple[float, float]] = field(default_factory=dict)
    power_loss: float = math.nan
    power_loss_interval: tuple[float, float] = (math.nan, math.nan)


@dataclass(frozen=True, repr=False, kw_only=True)
class TransientResult(Renamed, Shown):
    """Numbers of a run over time: one array (nt,) for each name of `lubfric.quantities.OF_MOMENT`, also as attributes.

    Attributes
    ----------
    columns : all of them by name, such as: time [s]; coefficient [-], the tangential force on surface 2 against
        its sliding over the lower one (in pure rolling: against its motion), over F_T; friction_force and its parts
        [N], positive along -x, against a motion along +x; mean_film and mean_gap [m], both sides of Eq. (8); wet_from
        and wet_to [m], the ends of the pressurised film; net_inflow, stored and cavity_growth [m²/s], the balance of
        the lubricant over the last step, per unit width; time_error [-], the local error of the last step over the
        tolerance; sampling_error [-], the relative standard error of f because the line of rough surface is finite
        (`lubfric.models.load_sharing.moment_error`; the line is the same at all times, so this error of f has the same
        sign throughout); inlet_film_factor [-],
        flash_temperature_rise and film_temperature_rise [K], as in `lubfric.FrictionResult`, of the steady motion at
        the speeds of the moment; heat_change [-], the relative change of f by the two rises; shear_error [-], the
        estimated relative error of f by the sum of the film's shear stress; edge_load [-], the share of the contact's
        load on the edge columns of its patch
    x : (nx,) [m]
    pressure, film_thickness : of the smooth film at the output times, (nt, nx) [Pa, m]; in the deterministic model,
        means over y
    report : how the run ended
    violations : the assumptions that do not hold at each output (`lubfric.Violation`); ``validity`` gathers them
    inputs : change of f downwards and upwards by the range of f_b at every time [-], (2, nt)
    not_in : inputs, as text, whose ranges are not in ``uncertainty``: a run is solved with their values alone
    requested : the output times [s] of the run, whether or not they were reached
    model_form_unknown : why the model-form error of f is not known and not in ``uncertainty``; "" where it is
    model : name of the model that answers (`lubfric.models.Model.name`)
    methods : names of the published methods used; ``cite()`` gives the publications
    stated_inputs : the inputs that a publication states, as text; ``cite("methods")`` has them
    rolling_ratios : the smallest and the largest that the rolling part of f may be, over its value; they bound the
        interval
    line_length, width, renewal : length of the line of rough surface, width of the contact, and the distance that a
        surface moves until other asperity contacts carry the load (the Hertz strip and a correlation length) [m]; NaN
        if not known
    """

    columns: dict[str, np.ndarray]
    x: np.ndarray
    pressure: np.ndarray
    film_thickness: np.ndarray
    report: Report
    violations: tuple[tuple[Violation, ...], ...] = ()
    _RENAMED = {"entries": "violations"}
    inputs: np.ndarray | float = 0.0
    not_in: tuple[str, ...] = ()
    line_length: float = math.nan
    width: float = math.nan
    renewal: float = math.nan
    requested: np.ndarray | tuple[float, ...] = ()
    model_form_unknown: str = ""
    model: str = ""
    methods: tuple[str, ...] = ()
    stated_inputs: tuple[str, ...] = ()
    rolling_ratios: tuple[float, float] = STATIONARY_ROLLING_RATIOS

    def cite(self, format: str = "text") -> str:
        """Return the papers behind what was used for this run, the model's first: one a line, or with ``format``
        "bibtex" as BibTeX entries, or "methods" as a paragraph, with the interval of the mean of f."""
        models = [self.model] if self.model else []
        outputs = counted(self.time.size, "outputs")
        errors = [] if self.time.size < FEWEST_OF_MEAN else [self._error_of_mean()]
        return cited(self.methods, format, inputs=(*self.stated_inputs, outputs), models=models, errors=errors)

    def _error_of_mean(self) -> Uncertainty:
        """Return what is known about the error of the mean of f over the run."""
        mean = self.average()
        parts = {name: max(sides) for name, sides in mean.budget.items()}
        return Uncertainty(
            coefficient=mean.coefficient,
            interval=mean.interval,
            numerical=parts.get("numerical", math.nan),
            sampling=mean.sampling,
            model=parts.get("model-form", math.nan),
            model_sides=mean.budget.get("model-form", UNKNOWN_SIDES),
            inputs=parts.get("input", 0.0),
            inputs_in_interval=(BOUNDARY_FRICTION_KEY,),
        )

    @property
    def refused_outputs(self) -> int:
        """How many outputs violate an assumption so strongly that f has no meaning."""
        return sum(any(violation.severe for violation in violations) for violations in self.violations)

    @property
    def is_complete(self) -> bool:
        """Whether all outputs are solved, and f has a meaning at each."""
        return self.report.converged and not self.refused_outputs

    @property
    def status(self) -> str:
        """What was reached, in sentences; the first words are "Converged", "Not converged" or "Refused"."""
        times = self.requested if len(self.requested) else self.time
        count = len(times)
        end = worded(float(times[-1]), "s")
        if not self.report.converged:
            return f"Not converged: {self.report.outcome}."
        if not self.is_complete:
            return (
                f"Refused: all {count} outputs to t = {end} are solved, but at {self.refused_outputs} of them an "
                "assumption is violated so strongly that f has no meaning (see the warnings)."
            )
        return f"Converged: all {count} outputs to t = {end} are solved, and every residual is within its tolerance."

    @property
    def start_in_words(self) -> str:
        """Whether the run is periodic, or contains its start, as a sentence, where its end has the speeds and the load
        of its first output, and other ones in between; else ""."""
        if self.time.size < 2:
            return ""
        conditions = [self.columns[name] for name in ("entrainment_speed", "sliding_speed", "load")]
        same = [SAME_CONDITIONS * np.max(np.abs(values), initial=0.0) for values in conditions]
        if any(abs(values[-1] - values[0]) > most for values, most in zip(conditions, same)):
            return ""
        ratio = self.contact_load / self.load
        film = self.central_film
        by_ratio = abs(ratio[-1] - ratio[0])
        by_film = abs(film[-1] / film[0] - 1.0)
        if by_ratio < OTHER_RATIO and by_film < OTHER_FILM:
            if all(np.ptp(values) <= most for values, most in zip(conditions, same)):
                return ""
            return (
                "The run is periodic: its end has the speeds and the load of its first output, an asperity load ratio "
                f"that differs by {by_ratio:.1g}, and a central separation that differs by {100 * by_film:.1g} %."
            )
        return (
            "The run is not periodic: its end has the speeds and the load of its first output, but an asperity load "
            f"ratio of {ratio[-1]:.3g} instead of {ratio[0]:.3g} and a central separation of "
            f"{worded(float(film[-1]), 'm')} instead of {worded(float(film[0]), 'm')}. So the mean contains the start "
            "of the run; for the periodic motion, solve two periods (transient.duration; repeat = true in a table), "
            "and set transient.first_output to the end of the first."
        )

    def average(self) -> TimeAverage:
        """Return the average of f over the time that `counts_in_average`, by the trapezoidal rule between the outputs
        (which have to be dense enough to resolve f; between an output that counts and one that does not, f is that of
        the first); its error; and its scatter for fixed and for moving roughness."""
        half = 0.5 * np.diff(self.time)
        moving = counts_in_average(self.columns)
        weight = np.append(half, 0.0) + np.append(0.0, half) if half.size else np.ones(1)
        of_motion = half * np.where(moving[1:] == moving[:-1], 1.0, 2.0)
        in_time = np.append(of_motion, 0.0) + np.append(0.0, of_motion) if half.size else weight
        share = float(in_time[moving].sum() / weight.sum())
        of_run = {name: float(np.average(self.columns[name], weights=weight)) for name in POWER if name in self.columns}
        loss, *ends = (of_run.get(name, math.nan) for name in POWER)
        if not share:
            return TimeAverage(
                coefficient=math.nan,
                sampling=math.nan,
                fixed_scatter=math.nan,
                moving_scatter=math.nan,
                in_motion=share,
                power_loss=loss,
                power_loss_interval=(ends[0], ends[1]),
            )
        names = "coefficient", "sampling_error", "entrainment_speed"
        f, error, speed = (self.columns[name][moving] for name in names)
        weight = in_time[moving]
        low, high = (float(np.average(end[moving], weights=weight)) for end in self.uncertainty.interval.T)
        mean = float(np.average(f, weights=weight))
        size = abs(mean) or math.nan
        parts = errors_in_time(self.columns, *np.broadcast_to(self.inputs, (2, self.time.size)))
        sampling = float(np.average(error * np.abs(f), weights=weight)) / size
        fixed = sampling * math.sqrt(self.line_length / self.width)
        moved = float(np.sum(weight * np.abs(speed)))
        slid = self.columns["load"][moving] * np.abs(self.columns["sliding_speed"][moving]) * weight
        return TimeAverage(
            coefficient=mean,
            sampling=sampling,
            fixed_scatter=fixed,
            moving_scatter=fixed / math.sqrt(max(1.0, moved / self.renewal)),
            in_motion=share,
            coefficient_of_losses=float(np.average(f, weights=slid)) if slid.any() else math.nan,
            interval=(low, high),
            budget={
                name: (_mean_known(below[moving], weight) / size, _mean_known(above[moving], weight) / size)
                for name, (below, above) in parts.items()
            },
            power_loss=loss,
            power_loss_interval=(ends[0], ends[1]),
        )

    @property
    def validity(self) -> tuple[str, ...]:
        """One text for each assumption that does not hold at some time, which begins with when."""
        return tuple(each.text_with_head for each in self.gathered)

    @property
    def gathered(self) -> tuple[GatheredTexts, ...]:
        """The violations of all outputs, in one record for each assumption."""
        return gathered_on_curve(list(zip(self.time.tolist(), self.violations)), "s", "outputs")

    @property
    def uncertainty(self) -> UncertaintyCurve:
        """Uncertainty budget and 95 % interval of f at every time.

        It includes the errors by the finite surface, the range of f_b, the sum of the film's shear stress, and the
        model-form error of steady motion at the same film, asperity load ratio and heat, where that is known.
        """
        f = self.coefficient
        error = self.sampling_error
        unknown = np.full(f.size, math.nan)
        below, above = np.broadcast_to(self.inputs, (2, f.size))
        sides = [self.columns.get(f"model_error_{end}", unknown) for end in ("low", "high")]
        interval = interval_in_time(self.columns, below, above, self.rolling_ratios)
        least, most = limits_in_time(self.columns, self.rolling_ratios)
        cuts = [
            tuple(
                text.format(NAME_OF_INTERVAL[True]) for text, is_cut in zip((CUT_AT_ZERO, CUT_AT_LIMIT), both) if is_cut
            )
            for both in zip(interval[:, 0] == least, interval[:, 1] == most)
        ]
        return UncertaintyCurve(
            model_sides=np.stack(sides, axis=1),
            numerical=self.columns.get("shear_error", unknown),
            sampling=error,
            interval=interval,
            line_scatter=error * math.sqrt(self.line_length / self.width),
            effective_contacts=unknown,
            length=np.full(f.size, self.line_length),
            area_needed=unknown,
            model=np.fmax(*sides),
            inputs=unknown if self.not_in else np.maximum(below, above) / np.maximum(np.abs(f), TINY),
            text=tuple(
                "; ".join((f"sampling {percent(each)}", *cut, *self.not_in)) for each, cut in zip(error.tolist(), cuts)
            ),
        )

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw friction over time, with its parts, on ``ax`` or new axes, which are returned."""
        axes = figures.axes_or_new(ax)
        (low, high) = self.uncertainty.interval.T
        if (high > low).any():
            time = self.time * time_scale(self.time[-1])[0]
            axes.fill_between(time, low, high, color=figures.BLUE, alpha=0.2, lw=0, label=band_label(self.columns))
        friction_over_time(axes, self.columns)
        add_angle_axis(axes, self.columns)
        return axes

    def plot_loop(self, ax: "Axes | None" = None) -> "Axes":
        """Draw friction over speed, the hysteresis loop with its start marked, on ``ax`` or new axes, which are
        returned. At a standstill no friction coefficient is defined, and none is drawn."""
        axes = figures.axes_or_new(ax)
        speed = self.entrainment_speed
        moving = in_motion(self.columns)
        friction = np.where(moving, self.coefficient, np.nan)
        begin = np.flatnonzero(moving)[:1]
        axes.plot(speed, friction, color=figures.BLUE)
        axes.plot(speed[begin], friction[begin], "o", color=figures.GREY, label="start")
        axes.set(xlabel=axis_label("speed"), ylabel=figures.FRICTION_LABEL)
        axes.legend(frameon=False)
        return axes

    def _facts(self) -> dict[str, str]:
        facts = {"": f"{self.time.size} times"}
        t = self.time
        if t.size:
            f = self.coefficient[in_motion(self.columns)]
            facts |= {
                "t": f"{t[0]:.4g} to {t[-1]:.4g} s",
                "f": f"{f.min():.4g} to {f.max():.4g}" if f.size else "at rest",
            }
        return facts | {"status": self.report.status}

    def __getattr__(self, name: str) -> FloatArray:
        columns = self.__dict__.get("columns", {})
        return columns[name] if name in columns else self._refuse(name, columns)


def _mean_known(values: np.ndarray, weight: np.ndarray) -> float:
    """Return the mean of ``values`` (n,) with a ``weight`` each, of which those that are not known (NaN) count 0; NaN
    if none is known."""
    return float(np.average(np.nan_to_num(values), weights=weight)) if np.isfinite(values).any() else math.nan


def errors_in_time(
    columns: dict[str, np.ndarray], inputs_below: np.ndarray, inputs_above: np.ndarray
) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Return how far each part of the uncertainty budget moves f at every time, below and above it, (nt,) each; NaN
    where it is not known. ``inputs_below``, ``inputs_above`` (nt,) [-]: how far the range of f_b moves f."""
    f = columns["coefficient"]
    size = np.abs(f)
    sampling = student(MANY_BLOCKS) * columns["sampling_error"] * size
    numerical = columns.get("shear_error", np.zeros(f.size)) * size
    unknown = np.full(f.size, math.nan)
    towards, away = (columns.get(f"model_error_{end}", unknown) * size for end in ("low", "high"))
    return {
        "numerical": (numerical, numerical),
        "sampling": (sampling, sampling),
        "model-form": below_and_above(f, towards, away),
        "input": (inputs_below, inputs_above),
    }


def interval_in_time(
    columns: dict[str, np.ndarray],
    inputs_below: np.ndarray,
    inputs_above: np.ndarray,
    rolling_ratios: tuple[float, float],
) -> np.ndarray:
    """Return the 95 % interval of f at every time, (nt, 2); arguments as of `errors_in_time`, and as of
    `TransientResult`. A part that is not known is not in it; NaN where sampling is not known, and at rest. Friction
    resists the sliding, so only the rolling part makes the lower end negative."""
    f = columns["coefficient"]
    parts = errors_in_time(columns, inputs_below, inputs_above).values()
    below, above = (np.sqrt(sum(np.nan_to_num(part[side]) ** 2 for part in parts)) for side in (0, 1))
    unknown = np.isnan(columns["sampling_error"]) | ~in_motion(columns)  # at rest there is no f
    least, most = limits_in_time(columns, rolling_ratios)
    ends = np.stack([np.maximum(f - below, least), np.minimum(f + above, most)], axis=1)
    return np.where(unknown[:, None], math.nan, ends)


def limits_in_time(
    columns: dict[str, np.ndarray], rolling_ratios: tuple[float, float]
) -> tuple[np.ndarray, np.ndarray]:
    """Return the smallest f that resists the sliding, and the largest by the limits of the shear stress, at every time,
    (nt,) each, between which an interval ends; arguments as of `TransientResult`."""
    f = columns["coefficient"]
    allowed = columns.get("largest_friction", np.zeros(f.size))  # 0: not known
    most = np.maximum(np.where(allowed > 0, allowed, math.inf), np.abs(f))
    rolling = columns.get("rolling_force", np.zeros(f.size)) * sense_of_friction_over_time(columns) / columns["load"]
    parts = np.multiply.outer(rolling_ratios, np.nan_to_num(rolling))
    by_rolling = np.minimum(np.minimum(parts.min(axis=0), f), 0.0)
    return np.where(columns["sliding_speed"] != 0, by_rolling, -most), most


def largest_friction_in_time(
    scene: Scene, columns: dict[str, np.ndarray], rolling_ratios: tuple[float, float]
) -> np.ndarray:
    """Return the largest |f| that the limits of the shear stress allow in ``scene`` at every time, (nt,)
    (`lubfric.models.shared.largest_friction`); ``rolling_ratios``: as of `TransientResult`."""
    sliding = columns["sliding_speed"]
    radii = [value_at(scene, "radius", scene.bodies.radius, time) for time in columns["time"]]
    moments = [
        Sliding(load=load, radius=radius, speed=speed)
        for load, radius, speed in zip(columns["load"], radii, np.abs(sliding))
    ]
    if scene.bodies.boundary_friction_table is None:
        by_sliding = largest_of_each(scene, moments)
    else:  # f_b changes with the motion
        by_sliding = [
            largest_of_each(_with_boundary_friction(scene, speed), [moment])[0]
            for moment, speed in zip(moments, sliding.tolist())
        ]
    by_rolling = max(map(abs, rolling_ratios)) * np.abs(np.nan_to_num(columns["rolling_force"])) / columns["load"]
    largest = np.array(by_sliding, float)
    if not run_model_of(scene).solves_rough_film:
        largest = _beside_asperities(largest, _largest_boundary_friction(scene, sliding), columns)
    return largest + by_rolling


def _beside_asperities(largest: np.ndarray, boundary: np.ndarray, columns: dict[str, np.ndarray]) -> np.ndarray:
    """Return the ``largest`` sliding part of f (nt,) where asperities carry a part of the load at no more than
    ``boundary`` = f_b (nt,): of the film's largest friction only the part counts that the film may carry by the
    model-form error of the asperity load ratio."""
    shares = columns["contact_load"] / columns["load"]
    ratios = columns["film_to_roughness_ratio"]
    of_film = [largest_film_load_ratio(*each) for each in zip(ratios.tolist(), shares.tolist())]
    return np.array([beside_asperities(*each) for each in zip(largest.tolist(), boundary.tolist(), of_film)])


def _largest_boundary_friction(scene: Scene, sliding: np.ndarray) -> np.ndarray:
    """Return f_b at each ``sliding`` speed [m/s] (nt,), at the upper end of its range if it has one."""
    ends = [most for name, _, most in scene.ranges if name == BOUNDARY_FRICTION_KEY]
    bodies = scene.bodies
    values = [ends[0] if ends else bodies.boundary_friction(at, scene.lubricant.temperature) for at in sliding.tolist()]
    return np.array(values, float)


def _with_boundary_friction(scene: Scene, sliding: float) -> Scene:
    """Return ``scene`` with the f_b that its table has at a ``sliding`` speed [m/s]."""
    value = scene.bodies.boundary_friction(sliding, scene.lubricant.temperature)
    return replace(
        scene, bodies=replace(scene.bodies, boundary_friction_coefficient=value, boundary_friction_table=None)
    )


def _with_intervals(
    columns: dict[str, np.ndarray], inputs: np.ndarray, rolling_ratios: tuple[float, float]
) -> dict[str, np.ndarray]:
    """Return ``columns`` with the intervals of f and of the power loss [W].

    The sliding part of the power has the interval of f, the rolling part the relative width of that interval, at most
    100 %. Friction takes power and gives none, so the interval of the power ends at 0.
    """
    inputs_below, inputs_above = inputs
    interval = interval_in_time(columns, inputs_below, inputs_above, rolling_ratios)
    f = columns["coefficient"]
    by_sliding = columns["load"] * np.abs(columns["sliding_speed"])
    rolling = columns["power_loss"] - columns["friction_force"] * columns["sliding_speed"]
    ends = []
    resting = ~in_motion(columns)
    for end in np.where(resting, f, interval.T):
        relative = np.minimum(np.abs(end - f) / np.maximum(np.abs(f), TINY), 1.0)
        ends.append(np.hypot((end - f) * by_sliding, relative * rolling))
    return columns | {
        "interval_low": interval[:, 0],
        "interval_high": interval[:, 1],
        "power_loss_low": np.maximum(columns["power_loss"] - ends[0], np.minimum(columns["power_loss"], 0.0)),
        "power_loss_high": columns["power_loss"] + ends[1],
    }


def band_label(columns: dict[str, np.ndarray]) -> str:
    """Return the label of the band of the intervals of f over time."""
    known = np.isfinite(columns.get("model_error_high", np.full(1, math.nan)))
    return "95 % interval" + ("" if known.all() else ", without model-form error")


def collect(
    model: TimeModel,
    grid_error: float,
    plan: Plan,
    progress: Progress,
    outputs: list[Output],
    ended: str = "",
    most_work: float = math.inf,
) -> TransientResult:
    """Return the result of the ``outputs`` so far. ``grid_error``: of a steady start, or NaN; ``ended``, ``most_work``:
    as in `report_of`."""
    columns = {name: np.array([o.numbers.get(name, math.nan) for o in outputs], float) for name in OF_MOMENT}
    shape = (-1, model.x.size)
    residuals = {
        "mass": _residual(columns, "mass_residual", MASS, "the balance of the lubricant"),
        "volume": _residual(columns, "volume_residual", model.tolerance, "the balance of gap and film"),
    }
    if not math.isnan(grid_error):
        residuals["grid"] = grid_residual(grid_error / model.scene.numerics.tolerance_of("film"))
    near_zero = [
        is_near_zero(*pair) for pair in zip(columns["coefficient"].tolist(), columns["sampling_error"].tolist())
    ]
    relative = columns["sampling_error"][~np.array(near_zero, bool)]  # of f near 0 it says nothing
    sampling = float(np.max(relative, initial=0.0))
    surface = (
        "not known"
        if math.isnan(sampling)
        else f"sampling error of f at 95 % at most {percent(student(MANY_BLOCKS) * sampling)}"
    )
    prepared = model.prepared
    renewal = prepared.sample.renewal_length(prepared.scene.bodies.half_width)
    ends = {name: [end - value_of(prepared.scene, name) for end in both] for name, *both in prepared.scene.ranges}
    by_load = np.where(columns["sliding_speed"] != 0, columns["contact_load"] / columns["load"], 0.0)
    low, high = ends.pop(BOUNDARY_FRICTION_KEY, (0.0, 0.0))
    inputs = np.outer((-low, high), by_load)
    not_in = tuple(f"range of {name.partition('.')[2]}: {NOT_IN}" for name in ends)
    report = report_of("run in time", plan, progress, f"{model.cells}; surface: {surface}", residuals, ended, most_work)
    is_omitted = roughness_moves(prepared.scene) and not may_move_roughness(prepared.scene)
    ratios = rolling_ratios_of(omits_flanks=is_omitted)
    columns["largest_friction"] = largest_friction_in_time(prepared.scene, columns, ratios)
    return TransientResult(
        columns=_with_intervals(columns, inputs, ratios),
        x=model.x,
        pressure=np.array([output.pressure for output in outputs]).reshape(shape),
        film_thickness=np.array([output.film_thickness for output in outputs]).reshape(shape),
        report=replace(report, notes=(*report.notes, *model.notes, *not_in)),
        violations=tuple(output.violations for output in outputs),
        inputs=inputs,
        not_in=not_in,
        line_length=prepared.surface.size[1],
        width=prepared.scene.bodies.width,
        renewal=renewal,
        rolling_ratios=ratios,
        requested=plan.times,
        model_form_unknown=model.model_form_unknown,
        model=run_model_of(prepared.scene).model.name,
        methods=methods_of(prepared, _use(prepared, columns)),
        stated_inputs=inputs_to_quote(
            prepared.scene,
            prepared.sample.maps_before_extension,
            has_given_map=prepared.has_given_map,
            has_sampling_error=bool(np.isfinite(columns["sampling_error"]).any()),
            takes_boundary_film=run_model_of(prepared.scene).model.takes_boundary_film,
        ),
    )


def _use(prepared: Prepared, columns: dict[str, np.ndarray]) -> MethodUse:
    """Return what the ``columns`` of a run show of the methods that it uses."""
    return MethodUse(
        model=run_model_of(prepared.scene).model,
        has_contact=bool((columns["contact_load"] > 0).any()),
        has_film=bool((columns["film_load"] > 0).any()),
        slides=bool((columns["sliding_speed"] != 0).any()),
        is_sampled=bool((columns["sampling_error"] > 0).any()),
        has_inlet_heat=bool((columns["inlet_film_factor"] < 1.0).any()),
        has_film_heat=bool((columns["film_temperature_rise"] > 0).any()),
        has_flash=bool((columns["flash_temperature_rise"] > 0).any()),
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


def in_motion(c: dict[str, np.ndarray], fastest: float = 0.0) -> np.ndarray:
    """Return the times (bools) of the ``c`` of a `lubfric.TransientResult` at which a surface moves: faster than `REST`
    times the largest speed of the run, so that a reversal is a standstill whatever the rounding errors of a period.
    ``fastest``: a speed [m/s] of the run at another time."""
    speeds = np.abs([c["entrainment_speed"], c["sliding_speed"]])
    return (speeds > REST * np.max(speeds, initial=fastest)).any(axis=0)


def counts_in_average(c: dict[str, np.ndarray]) -> np.ndarray:
    """Return the times (bools) of the ``c`` of a `lubfric.TransientResult` that count in the average of f: the surfaces
    move, and f comes from sliding (`is_by_sliding`), unless it does so at no time."""
    moving = in_motion(c)
    slid = moving & is_by_sliding(c)
    return slid if slid.any() else moving


def rolls(c: dict[str, np.ndarray]) -> np.ndarray:
    """Return the times (bools) at which the surfaces entrain oil, by the limit of `in_motion`; else there is no lambda
    ratio."""
    return in_motion(c | {"sliding_speed": np.zeros(c["entrainment_speed"].size)})


def sense_of_friction_over_time(c: dict[str, np.ndarray]) -> FloatArray:
    """Return the sign of the friction force on surface 2, which is positive along -x, at a positive
    coefficient, by the ``c`` of a `lubfric.TransientResult`."""
    speed = np.where(c["sliding_speed"] != 0, c["sliding_speed"], c["entrainment_speed"])
    return np.where(speed < 0, -1.0, 1.0)


def friction_over_time(axes: "Axes", c: dict[str, np.ndarray]) -> None:
    """Draw friction over time with its parts, by the ``c`` of a `lubfric.TransientResult`. At rest there is none."""
    sense = sense_of_friction_over_time(c)
    scale, unit = time_scale(c["time"][-1])
    film = (c["couette_force"] + c["rolling_force"]) * sense / c["load"]
    moving = in_motion(c)
    parts = c["coefficient"], c["boundary_force"] * sense / c["load"], film
    figures.friction_lines(axes, c["time"] * scale, [np.where(moving, part, np.nan) for part in parts])
    resting = ~moving
    if (resting[1:] & resting[:-1]).any():  # a band between two outputs
        rest_band: dict[str, Any] = {
            "where": resting,
            "transform": axes.get_xaxis_transform(),
            "label": "at rest: no f",
        }
        axes.fill_between(c["time"] * scale, 0, 1, color=figures.GREY, alpha=0.2, lw=0, **rest_band)
    axes.set(xlabel=f"time ({unit})", ylabel=figures.FRICTION_LABEL)
    figures.key_above(axes)


def add_angle_axis(axes: "Axes", c: dict[str, np.ndarray]) -> None:
    """Add an axis of the angle of rotation below that of the time of ``axes``, by the ``c`` of a
    `lubfric.TransientResult`; none where the angle is not known."""
    angle = c.get("angle_of_rotation", np.full(1, np.nan))
    if not np.isfinite(angle).any():
        return
    shown_time = c["time"][-1] * time_scale(c["time"][-1])[0]
    degrees = angle[-1] / shown_time
    axis = axes.secondary_xaxis("bottom", functions=(lambda time: time * degrees, lambda angle: angle / degrees))
    axis.set_xlabel(axis_label("angle_of_rotation"))
    axis.set_xticks(np.arange(*degree_ticks(float(angle[0]), float(angle[-1]))))
    axis.tick_params(length=0.0, pad=ANGLE_PAD)


def degree_ticks(first: float, last: float) -> tuple[float, float, float]:
    """Return the first tick [°] of an axis of angles from ``first`` to ``last``, a number above its last one, and their
    step."""
    least = (last - first) / MOST_DEGREE_TICKS
    turns = DEGREE_STEPS[-1] * math.ceil(least / DEGREE_STEPS[-1])
    step = next((step for step in DEGREE_STEPS if step >= least), turns)
    return step * math.ceil(first / step), last + 0.5 * step * (last % step == 0), step


def time_scale(longest: float) -> tuple[float, str]:
    """Return (factor, unit) that shows times up to ``longest`` [s] as numbers above one."""
    for scale, unit in ((1.0, "s"), (1e3, "ms")):
        if longest * scale >= 1.0:
            return scale, unit
    return 1e6, "µs"
