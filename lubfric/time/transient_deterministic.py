"""A run in time by the deterministic model: the rough surfaces move through the film, each by the integral of its
own speed, while load, speed, radius and viscosity change.

It is a solver of `march`, whose y is the mass rho θ h of the cells. A step ends whenever the fastest rough body has
moved by one cell. The fields are kept with x along the scene's; where U < 0, the film is solved in the mirror.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..errors import CONVERGED, ITERATION_LIMIT, InputError, Report
from ..estimate import full_load_numbers
from ..models import prepare
from ..models.deterministic import (
    BOUNDARY_FILM,
    FACTORISATIONS_IN_A_STEP,
    FLUID,
    KRYLOV_IN_A_STEP,
    TOUCHING,
    Iterate,
    MapCoarsening,
    Problem,
    State,
    TimeHistory,
    Work,
    assemble,
    dry_contact,
    evaluated,
    lay_out,
    maps_of_bodies,
    newton,
    numbers_of_strip,
    reach,
    residuals,
    shifted,
    solve_point,
    strip_heat,
    surface_and_map_coarsening,
    work_of_steps,
)
from ..models.shared import (
    Assumption,
    Prepared,
    Violation,
    block_error,
    violations_by_inlet_of_moment,
    violations_by_motion,
    violations_by_thickness,
)
from ..quantities import FRICTION_FORCES, OF_MOMENT
from ..scene import Constant, Scene, longest_contact, moving_bodies, sampled_times
from .film_setting import WET_PRESSURE
from .march import Memory, Progress, Step
from .model import Output, Start
from .moment_columns import ends_of_film, motion_columns, sense_of_friction
from .scene_in_time import SLIDING_PART, check_start, scene_at, sliding_at, surface_speed, transient_of

# Choices between work and error, and limits for time and memory.
TIME_ERROR = 2e-3  # default largest local error of the film in a step, relative
RUN_STEP_RESIDUAL = 1e-3  # residuals of a step
MOST_NEWTON_STEPS_IN_TIME = 25  # Newton steps in a step
# Least entrainment speed over the fastest one (without entrainment, over b/duration) [-]: slower entrainment is set to
# it, and such a result counts as at rest. A choice: a larger value than the rounding errors of a frequency leave at a
# reversal, a smaller one than any flow that matters.
REST = 1e-6
LEAST_FLOW = 1e-3  # least flow to which residuals are relative, over film times speed of the fastest entrainment
FIRST_STEP_CELLS = 0.1  # cells by which the fastest surface moves in the step after a start or a jump
# Steps in addition to those that end at an output or a cell of motion, about: 21 to 26 in all were seen with 20
# outputs.
OTHER_STEPS = 5
# Processor time of a step over its counted work by the steps of a steady point, about. Measured in runs of `python -m
# verification.campaigns.estimates`.
STEP_SECONDS = 0.7
MOST_PASSED_CELLS = 100_000  # by which the roughness may move in a run
TRAVEL_TIMES = 20_001  # times at which the speeds are looked up to find the steps
ISOTHERMAL = "the deterministic model in time is isothermal; a real film is thinner and shears more easily"


@dataclass(frozen=True)
class TransientDeterministic:
    """The solver: ``prepared``, with the strip of the run as its surface; ``base``, its cells; of each rough body, by
    its section, the ``heights`` [m] on these cells, of the distance [m] that it has moved. ``correlation_length``: of
    the heights along y [m]."""

    prepared: Prepared
    base: Problem
    heights: dict[str, Callable[[float], np.ndarray]]
    correlation_length: float
    tolerance = RUN_STEP_RESIDUAL
    time_error = TIME_ERROR
    notes = ()
    model_form_unknown = "in time the deterministic model has one strip, whose cells are not compared with finer ones"

    @property
    def scene(self) -> Scene:
        """The scene, with all that changes in time."""
        return self.prepared.scene

    @property
    def x(self) -> np.ndarray:
        """Return the positions of the columns of cells [m]."""
        return self.base.x

    @property
    def cells(self) -> str:
        """Return the numbers of cells of the grid, as text."""
        return "{} x {} cells".format(*self.base.heights.shape)

    @cached_property
    def fastest(self) -> float:
        """The largest speed of a surface [m/s]."""
        times = np.array(sampled_times(self.scene))
        return max(_body_speed(self.scene, body, times).max() for body in SLIDING_PART)

    @property
    def first_step(self) -> float:
        """Step after a start or a jump [s]."""
        return (
            FIRST_STEP_CELLS * self.base.spacing[0] / self.fastest
            if self.fastest
            else FIRST_STEP_CELLS * transient_of(self.scene).duration
        )

    @cached_property
    def stops(self) -> tuple[float, ...]:
        """Times [s] at which the fastest rough body has moved by one more cell, about."""
        duration = transient_of(self.scene).duration
        dx = self.base.spacing[0]
        times = np.linspace(0.0, duration, TRAVEL_TIMES)
        speed = np.max([0 * times, *(_body_speed(self.scene, body, times) for body in self.heights)], axis=0)
        way = np.append(0.0, np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(times)))
        if way[-1] > MOST_PASSED_CELLS * dx:
            message = f" = {duration:g} s: the roughness would move by {way[-1] / dx:.2g} cells, a step each"
            recommendation = "a shorter run, or numerics.model = 'paper'"
            raise InputError(message, "transient.duration", f"up to {MOST_PASSED_CELLS:g} cells", recommendation)
        return tuple(np.interp(dx * np.arange(1, math.floor(way[-1] / dx) + 1), way, times).tolist())

    def problem_at(self, time: float) -> Problem:
        """Return the problem just before ``time`` [s], in the mirror where U < 0."""
        now = scene_at(self.scene, time)
        sliding = sliding_at(self.scene, time)
        speed = now.motion.entrainment_speed
        transient = transient_of(self.scene)
        motion = self.scene.motion
        along = (transient.speed or Constant(motion.entrainment_speed)).integral(time)
        apart = motion.slide_roll_ratio * along if transient.sliding is None else transient.sliding.integral(time)
        back = -1 if speed < 0 else 1
        rough = {
            name: heights_at(along + SLIDING_PART[name] * apart)[::back] for name, heights_at in self.heights.items()
        }
        pace = max(abs(speed), REST * self.base.speed)
        return replace(
            self.base,
            line=replace(now.line_contact(pace), sliding=abs(sliding)),
            sliding=abs(sliding),
            boundary_friction=now.bodies.boundary_friction_coefficient,
            x=back * self.base.x[::back],
            heights=np.sum([self.base.heights, *rough.values()], axis=0),
            upper=rough.get("counterface"),
            sense=-1.0 if sliding * back < 0 else 1.0,
        )

    def solve(self, time: float, memory: Memory, z: np.ndarray, payload: State) -> Step:
        """Solve the step that ends at ``time`` [s]; the payload is its state."""
        back = self.back(time)
        film = memory.film[::back]
        history = TimeHistory(extrapolated=film, step=1.0 / memory.rate)
        if memory.then is not None:
            last = memory.then[::back]
            part = memory.rate * memory.step - 1.0
            extrapolated = np.maximum((1.0 + part) * film - part * last, 0.5 * last)
            history = TimeHistory(extrapolated=extrapolated, step=memory.step, last=last, part=part)
        start = _turned(replace(payload, approach=float(z[0])), back)
        solution = newton(
            self.problem_at(time),
            start,
            Work(MOST_NEWTON_STEPS_IN_TIME),
            tolerance=RUN_STEP_RESIDUAL,
            most=MOST_NEWTON_STEPS_IN_TIME,
            history=history,
        )
        status = CONVERGED if solution.residual <= RUN_STEP_RESIDUAL else ITERATION_LIMIT
        return self._step(solution.at, back, status)

    def error_of(self, step: Step, difference: np.ndarray) -> float:
        """Return the root mean square, over the pressurised film, of the mean over y of a ``difference`` of masses,
        over the mean there. (Roughness that passes is resolved by the steps of one cell.)"""
        p, lost, film = (f.mean(axis=1) for f in (step.payload.pressure, difference, step.film))
        wet = p > WET_PRESSURE * p.max()
        return float(np.sqrt(np.mean(lost[wet] ** 2)) / film[wet].mean()) if wet.any() else 0.0

    def start(self) -> Step:
        """Return the state at t = 0: steady, of roughness at rest; at rest, with all load on the dry contact; or
        without pressure at a flying height. In the last two the gap is full."""
        transient = transient_of(self.scene)
        problem = self.problem_at(0.0)
        back = self.back(0.0)
        still = (transient.speed or Constant(self.scene.motion.entrainment_speed)).before(0.0) == 0.0
        if transient.initial_film is None and not (
            transient.initial == "rest" or transient.initial == "auto" and still
        ):
            return self._step(evaluated(problem, solve_point(problem, tolerance=RUN_STEP_RESIDUAL).state), back)
        nothing = np.zeros_like(problem.heights)
        kind = np.full(problem.heights.shape, FLUID, np.int8)
        state = State(
            pressure=nothing,
            fill=nothing + 1.0,
            dent=nothing,
            kind=kind,
            yielded=nothing > 0,
            approach=transient.initial_film or 0.0,
        )
        if transient.initial_film is None:
            dry = dry_contact(problem)
            p = dry.pressure
            yielded = dry.pressure >= problem.hardness
            dent = np.where(yielded, np.maximum(-dry.gap, 0.0), 0.0)
            kind = np.where(p > 0, TOUCHING, FLUID).astype(np.int8)
            state = State(
                pressure=p.copy(),
                fill=nothing + 1.0,
                dent=dent,
                kind=kind,
                yielded=yielded,
                approach=problem.floor - dry.approach,
            )
        elif np.min(problem.rigid_gap) + transient.initial_film < problem.floor:
            least = problem.floor - float(np.min(problem.rigid_gap))
            recommendation = f"give more than {least:g} m, or initial = 'rest'"
            raise InputError("transient.initial_film: the surfaces touch", recommendation=recommendation)
        return self._step(evaluated(problem, state), back)

    def record(self, progress: Progress) -> Output:
        """Return the numbers and fields after the last step; the fields are means over y."""
        back = self.back(progress.time)
        terms = progress.solution.terms
        numbers, violations = deterministic_moment(self, progress)
        return Output(
            numbers=numbers,
            violations=violations,
            pressure=terms.state.pressure.mean(axis=1)[::back],
            film_thickness=terms.mass_balance.flow_gap.mean(axis=1)[::back],
        )

    def resumable(self, progress: Progress) -> Progress:
        """Return ``progress`` without its solution, which the next step computes again."""
        return replace(progress, solution=None)

    def back(self, time: float) -> int:
        """Return -1 where the film is solved in the mirror, else 1."""
        return -1 if scene_at(self.scene, time).motion.entrainment_speed < 0 else 1

    def _step(self, at: Iterate, back: int, status: str = CONVERGED) -> Step:
        state = _turned(at.state, back)
        return Step(film=at.mass[::back], z=np.array([state.approach]), status=status, payload=state, terms=at)


def _turned(state: State, back: int) -> State:
    parts = {name: getattr(state, name)[::back] for name in ("pressure", "fill", "dent", "kind", "yielded")}
    return replace(state, **parts)


def _body_speed(scene: Scene, body: str, times: np.ndarray) -> np.ndarray:
    """Return |u| [m/s] of the ``body`` at ``times`` [s]."""
    return np.abs([surface_speed(scene, body, time) for time in times.tolist()])


def start_deterministic(scene: Scene | Prepared) -> Start:
    """Check a scene with a ``transient``, and return the deterministic model of its run. The error of its cells is not
    known. Raises `InputError` and `ConvergenceError`."""
    model = make_deterministic(scene)
    return Start(model=model, state=model.start(), grid_error=math.nan)


def work_of_run(scene: Scene) -> tuple[int, float, tuple[float, ...]]:
    """Return about how many steps a run takes, its processor time [s of a usual core], and the times [s] at which the
    motion of the roughness ends a step."""
    solver = make_deterministic(scene)
    transient = transient_of(scene)
    steps = max(len(solver.stops), transient.outputs) + OTHER_STEPS
    seconds = work_of_steps(solver.base.heights.size, FACTORISATIONS_IN_A_STEP, KRYLOV_IN_A_STEP)
    return steps, STEP_SECONDS * steps * seconds, solver.stops


def check_deterministic(scene: Scene) -> None:
    """Raise `InputError` for a scene that the deterministic model of a run in time does not take. Nothing is solved."""
    if scene.numerics.heat == "on":
        raise InputError(
            " = 'on': the deterministic model in time is isothermal", "numerics.heat", "'auto', which warns, or 'off'"
        )
    check_start(scene)


def make_deterministic(scene: Scene | Prepared) -> TransientDeterministic:
    """Return the solver, on the first strip that a steady point takes, and on the same cells. Raises `InputError`."""
    prepared = scene if isinstance(scene, Prepared) else prepare(scene)
    scene = prepared.scene
    transient = transient_of(prepared.scene)
    sample = prepared.sample
    if not sample.is_resolved:
        raise InputError(" needs a contact of cells under a cylinder", "numerics.model")
    check_deterministic(scene)
    surface, map_coarsening = surface_and_map_coarsening(prepared, 0)
    maps = maps_of_bodies(prepared, 0)
    if len(maps) == 1 and transient.sliding is not None and len(moving_bodies(scene)) > 1:
        raise InputError(
            " moves two rough bodies at different speeds", "transient.sliding", "a map of each body (lubfric.prepare)"
        )
    if not maps:  # smooth
        surface = replace(surface, heights=surface.heights[:, :1], mask=None)
        map_coarsening = MapCoarsening((map_coarsening[0], 1))
    speed = transient.speed or Constant(scene.motion.entrainment_speed)
    low, high = speed.range(transient.duration)
    line = scene.line_contact(max(abs(low), abs(high)) or scene.bodies.half_width / transient.duration)
    longest = longest_contact(scene).bodies
    longest_line = replace(line, load_per_width=longest.load / longest.width, radius=longest.radius)
    upstream, downstream = reach(longest_line, surface.sq)
    base = lay_out(
        replace(surface, heights=0.0 * surface.heights, mask=None),
        line,
        sliding=0.0,
        boundary_friction=0.0,
        hardness=scene.bodies.hardness,
        boundary_film=BOUNDARY_FILM if scene.bodies.boundary_film is None else scene.bodies.boundary_film,
        ends=(upstream, upstream if low <= 0.0 else downstream),
        map_coarsening=map_coarsening,
    )
    base = replace(base, least_flow=LEAST_FLOW * line.entrainment_speed * line.moes_film)
    of_strip = replace(prepared, surface=surface)
    heights = {name: shifted(base, one) for name, one in maps.items()}
    return TransientDeterministic(of_strip, base, heights, sample.correlation_lengths[1])


def deterministic_moment(
    solver: TransientDeterministic, now: Progress
) -> tuple[dict[str, float], tuple[Violation, ...]]:
    """Return the numbers after the last step, by name, and the assumptions that do not hold then. As of `OF_MOMENT`, of
    the rough gap; NaN where this model has no such number."""
    iterate = now.solution.terms
    scene = scene_at(solver.scene, now.time)
    left = residuals(iterate)
    result = assemble(
        iterate,
        Report(
            "film under moving roughness",
            CONVERGED,
            iterations=1,
            residual=max(left.values()),
            tolerance=RUN_STEP_RESIDUAL,
            residuals=left,
        ),
    )
    numbers = numbers_of_strip(replace(solver.prepared, scene=scene), result)
    speed = scene.motion.entrainment_speed
    sliding = sliding_at(solver.scene, now.time)
    total = scene.bodies.load
    f = result.coefficient
    sense = sense_of_friction(scene, sliding)
    places = (result.friction_at - f * result.load_at) / result.load
    scatter = block_error(places, solver.base.spacing[1], solver.correlation_length).value
    wet = solver.x[now.solution.payload.pressure.mean(axis=1) > 0]
    row = {name: numbers.get(name, math.nan) for name in OF_MOMENT} | {
        **{name: sense * numbers[name] for name in FRICTION_FORCES if name in OF_MOMENT},
        **motion_columns(
            now,
            scene,
            sliding=sliding,
            force=sense * f * total,
            rolling_resistance=numbers["rolling_resistance"],
        ),
        "sampling_error": scatter / abs(f) if f and math.isfinite(scatter) else math.nan,
        **full_load_numbers(scene, speed, solver.prepared.surface.sq, math.nan),
        "mass_residual": left["mass"] if now.steps else 0.0,
        "mean_film": result.mean_gap,
        **ends_of_film(wet),
        "max_pressure": float(result.pressure.max()),
    }
    film = result.central_gap
    heat = strip_heat(scene, result)
    violations = [
        *solver.prepared.violations,
        *violations_by_motion(scene, speed, film),
        *violations_by_inlet_of_moment(scene, speed),
        *violations_by_thickness(scene, film),
    ]
    lost = max(heat.change, 1 - heat.inlet.factor if heat.inlet else 0.0)
    if lost > scene.numerics.tolerance:
        recommendation = (
            "set numerics.model = 'paper', which models heat in time; numerics.heat = 'off' neglects heat without "
            "this warning"
        )
        violations.append(
            Violation(
                assumption=Assumption.ISOTHERMAL_RUN,
                what="loss of film or f by heat",
                value=lost,
                limit=scene.numerics.tolerance,
                unit="",
                consequence=ISOTHERMAL,
                recommendation=recommendation,
            )
        )
    return row, tuple(violations)
