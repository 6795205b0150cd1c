"""The begin of a run in time: its strip of rough surface, from the needs of steady friction; its histories; its grid;
and its state at t = 0, which is steady, at rest with all load on the contact, or a film without pressure."""

import math
from dataclasses import dataclass, replace
from functools import partial
from typing import cast

import numpy as np

from ..contact import HalfSpaceContact
from ..errors import CONVERGED, ConvergenceError, InputError, LubfricError, WorkLimitError
from ..estimate import solve_to_tolerance
from ..models import prepare
from ..models.load_sharing import PaperModel, PaperSolution, film_under, solve_balance, volume_residual
from ..models.shared import Prepared, contact_on_joined_strips, scene_of
from ..samples import Sample
from ..scene import Constant, Scene, sampled_times
from .film_setting import NODE_FACTORS, LineHistory, make_setting, steady_start
from .load_sharing_solver import ContactStep
from .march import Step
from .model import Start
from .scene_in_time import check_start, inlet_viscosity, scene_at, sliding_at, transient_of
from .transient_load_sharing import TransientLoadSharing, make_load_sharing

# Speeds of a run at which its assumptions are checked: a choice between time and what is seen.
JUDGED_SPEEDS = 4  # number of speeds checked between the fastest and the slowest of a run
SLOWEST_JUDGED = 1e-3  # slowest checked speed over the fastest: slower ones are boundary lubrication
# What a run does of the steady options. The film is deflected by its own pressure, whatever the default says.
SUPPORTED = {
    "film_deflection": ("scaled", "hydrodynamic"),
    "cavitated_shear": ("none",),
}


def start_load_sharing(scene: Scene | Prepared) -> Start:
    """Check a scene with a ``transient``, and return the load-sharing model of its run. Raises `InputError` and
    `ConvergenceError`."""
    base = scene_of(scene)
    transient = transient_of(base)
    check_load_sharing(base)
    run_strip = strip_of_run(scene if isinstance(scene, Prepared) else prepare(scene))
    prepared = run_strip.prepared
    sq = prepared.surface.sq
    line_history = _line_history(prepared.scene)
    if not sq > 0.0 and transient.initial_film is None and line_history.speed.before(0.0) == 0.0:
        ways = "transient.initial_film > 0 m, or an entrainment speed before t = 0"
        raise InputError(f"smooth surfaces at rest have no film to start from; give {ways}")
    reach = float(np.max(np.abs(prepared.rough_contact.x))) if sq > 0.0 else 0.0
    tolerance = base.numerics.tolerance_of("film")
    for finer in NODE_FACTORS:
        setting = make_setting(line_history, tolerance, sq=max(sq, 0.0), reach=reach, finer=finer)
        model = make_load_sharing(
            prepared,
            setting,
            correlation_length=run_strip.correlation_length,
            area=run_strip.area,
            plastic=run_strip.plastic,
        )
        state, grid_error = _first_state(model)
        if not grid_error > tolerance:  # NaN: no steady start to judge by
            break
    return Start(model=model, state=state, grid_error=grid_error)


def check_load_sharing(base: Scene) -> None:
    """Raise `InputError` for a scene that the load-sharing model of a run in time does not take. Nothing is solved."""
    transient = transient_of(base)
    load = transient.load or Constant(base.bodies.load)
    for name, allowed in SUPPORTED.items():
        value = getattr(base.numerics, name)
        if value not in allowed:
            raise InputError(
                f" = {value!r} is not for a run in time", f"numerics.{name}", ", ".join(map(repr, allowed))
            )
    if load.range(transient.duration)[1] > base.bodies.load * (1 + 1e-9):
        message = f" rises to {load.range(transient.duration)[1]:g} N"
        most = f"up to bodies.load = {base.bodies.load:g} N"
        raise InputError(message, "transient.load", f"{most}, for which the surface is long enough")
    for time in sampled_times(base) if base.bodies.boundary_friction_table is not None else ():
        scene_at(base, time)  # raises where the table of f_b has no value
    check_start(base)


def _line_history(scene: Scene) -> LineHistory:
    """Return the line contact of a scene in time, with the scene's constants where nothing changes."""
    bodies = scene.bodies
    transient = transient_of(scene)
    return LineHistory(
        load=transient.load or Constant(bodies.load),
        radius=transient.radius or Constant(bodies.radius),
        e_prime=bodies.e_prime,
        speed=transient.speed or Constant(scene.motion.entrainment_speed),
        viscosity=inlet_viscosity(scene),
        lubricant=scene.lubricant,
        duration=transient.duration,
        initial_film=transient.initial_film,
        width=bodies.width,
        sliding=partial(sliding_at, scene),
    )


def _first_state(model: TransientLoadSharing) -> tuple[Step, float]:
    """Return the state at t = 0 and the grid error of the steady film in it (NaN from another start)."""
    transient = transient_of(model.scene)
    if transient.initial_film is not None:
        return _flying(model, transient.initial_film), math.nan
    still = model.setting.line_history.speed.before(0.0) == 0.0
    if transient.initial == "rest" or (transient.initial == "auto" and still):
        return _resting(model), math.nan
    return _steady(model)


def _untouched(model: TransientLoadSharing, film: Step) -> Step:
    contact = model.contact_at(0.0)
    state = contact.patch.close(contact.to_patch @ film.terms.H, 0.0)
    return replace(film, payload=ContactStep(load=0.0, state=state, touching_gap=state.mean_gap))


def _flying(model: TransientLoadSharing, film: float) -> Step:
    """Return the state without pressure anywhere under a parabola at the height ``film`` [m]."""
    step = _untouched(model, model.setting.undeformed(film))
    state = step.payload.state
    if volume_residual(state) > 0.0:
        message = f": the surfaces touch at {state.mean_film:g} m of mean film"
        raise InputError(
            message, "transient.initial_film", f"above {film_under(state.mean_gap):g} m, or initial = 'rest'"
        )
    return step


def _resting(model: TransientLoadSharing) -> Step:
    """Return the state in which the contact carries the load under the undeformed cylinder, its gap full of lubricant
    without pressure."""
    setting = model.setting
    contact = model.contact_at(0.0)
    patch = contact.patch
    load = model.setting.line_history.load.before(0.0)
    state = patch.close(patch.x**2 / (2.0 * setting.line_history.radius.before(0.0)), load)
    undeformed_gap = setting.undeformed(0.0).terms.H
    film = film_under(state.mean_gap) - float(contact.mean_row @ undeformed_gap)
    if film <= 0.0:
        message = "at rest there is no gap for a film under the undeformed cylinder"
        ways = "initial = 'steady' with an entrainment speed, or transient.initial_film"
        raise InputError(f"{message}; give {ways}")
    undeformed = setting.undeformed(film)
    state = replace(state, mean_film=float(contact.mean_row @ undeformed.terms.H))
    touching_gap = patch.close(contact.to_patch @ undeformed.terms.H, 0.0).mean_gap
    return replace(undeformed, payload=ContactStep(load=load, state=state, touching_gap=touching_gap))


def _steady(model: TransientLoadSharing) -> tuple[Step, float]:
    """Solve the balance of the steady state, and then the same on the grid of the run."""
    setting = model.setting
    scene = model.scene
    c = model.setting.line_history
    viscosity = transient_of(scene).viscosity
    cold = scene.lubricant.viscosity if viscosity is None else viscosity.before(0.0)
    values = scene.with_(
        bodies={"load": c.load.before(0.0), "radius": c.radius.before(0.0)},
        lubricant=replace(scene.lubricant, viscosity=cold),
        numerics={"film_deflection": "hydrodynamic", "accept": True},  # judged with the other moments
    )
    balance = solve_balance(values, c.speed.before(0.0), model.contact_at(0.0).patch, model.prepared.surface.sq)
    film, error = steady_start(setting, balance.film_load)
    if film.status != CONVERGED:
        raise ConvergenceError("transient: no steady film on the grid of the run to start from")
    if balance.contact_load == 0.0:
        return _untouched(model, film), error
    contact = model.contact_at(0.0)
    touching_gap = contact.patch.close(contact.to_patch @ film.terms.H, 0.0).mean_gap
    touch = ContactStep(load=balance.contact_load, state=balance.contact_state, touching_gap=touching_gap)
    step = model.solve(0.0, None, film.z, touch)
    if step.status != CONVERGED:
        raise ConvergenceError("transient: film and contact of the steady start do not balance on the grid of the run")
    return step, error


@dataclass(frozen=True, kw_only=True)
class RunStrip:
    """The strip of rough surface of a run: ``prepared`` has it as its surface, which is ``strips`` of the sample joined;
    the other attributes as in `TransientLoadSharing`."""

    prepared: Prepared
    correlation_length: float
    area: float = 1.0
    plastic: float = 1.0
    strips: int = 1


def strip_of_run(prepared: Prepared) -> RunStrip:
    """Return the strip of rough surface of a run.

    It has as many strips as `lubfric.friction` needs for ``numerics.sampling_tolerance`` at the worst of four speeds of
    its histories, whatever its duration, or as memory and map allow. Their cells change f by no more than
    ``numerics.tolerance`` at any of these speeds, or are the scene's own: a run in time is not corrected for them. The
    factors of areas are means over the speeds.
    """
    sample = prepared.sample
    speeds = speeds_of_run(prepared.scene)
    if not sample.is_resolved:
        return RunStrip(prepared=prepared, correlation_length=sample.correlation_lengths[1])
    if not sample.represents_more:
        return RunStrip(prepared=_made(prepared, sample.native(), 1), correlation_length=sample.correlation_lengths[1])
    if not speeds:
        known = 1.0 if sample.cells.is_native else math.nan
        return RunStrip(prepared=prepared, correlation_length=sample.correlation_lengths[1], area=known, plastic=known)
    needs = [_need_of(prepared, sample, speed) for speed in speeds]
    while not sample.cells.is_native and max(need.by_cells for need in needs) > prepared.scene.numerics.tolerance:
        sample = sample.halved()
        needs = [_need_of(prepared, sample, speed) for speed in speeds]
    count = min(max(need.strips for need in needs), sample.available_strips)
    return RunStrip(
        prepared=_made(prepared, sample, count),
        strips=count,
        correlation_length=sample.correlation_lengths[1],
        area=_mean([need.area for need in needs]),
        plastic=_mean([need.plastic for need in needs]),
    )


def _made(prepared: Prepared, sample: Sample, count: int) -> Prepared:
    """Return ``prepared`` on the first ``count`` strips of ``sample``, joined to one strip."""
    rough_contact = cast(HalfSpaceContact, contact_on_joined_strips(prepared, sample, count))
    surface = replace(prepared.surface, heights=rough_contact.heights, spacing=rough_contact.spacing, mask=None)
    return replace(prepared, surface=surface, rough_contact=rough_contact, sample=sample)


def speeds_of_run(scene: Scene) -> list[float]:
    """Return some speeds [m/s] of the history of a run, whatever its duration, at which its strip is judged; none
    where nothing is entrained."""
    speed = transient_of(scene).speed or Constant(scene.motion.entrainment_speed)
    low, high = speed.range(speed.horizon)
    fastest = max(abs(low), abs(high))
    if fastest == 0.0:
        return []
    slowest = max(min(abs(low), abs(high)) if low * high > 0 else 0.0, SLOWEST_JUDGED * fastest)
    return np.unique(np.geomspace(fastest, slowest, JUDGED_SPEEDS)).tolist() if slowest < fastest else [fastest]


@dataclass(frozen=True, kw_only=True)
class NeedOfSpeed:
    """What steady friction at one speed of a run needs of its strip.

    Attributes
    ----------
    strips : how many are joined
    by_cells : relative change of f by their cells; infinite if finer ones were needed
    area, plastic : factors as in `TransientLoadSharing`; NaN: not known
    """

    strips: int
    by_cells: float
    area: float = math.nan
    plastic: float = math.nan


def _need_of(prepared: Prepared, sample: Sample, speed: float) -> NeedOfSpeed:
    """Return what ``speed`` [m/s] needs of ``sample``. Without a steady solution it needs the first strips."""
    try:
        balanced = _balanced(replace(prepared, sample=sample), speed)
    except WorkLimitError:
        raise
    except LubfricError:
        return NeedOfSpeed(strips=sample.first_strips, by_cells=0.0)
    plastic = balanced.raw_balance.contact_state.plastic_area_fraction
    corrected = balanced.corrected_balance.contact_state.plastic_area_fraction
    same = balanced.sample.cells.coarsening == sample.cells.coarsening
    return NeedOfSpeed(
        strips=balanced.count,
        by_cells=balanced.relative_change(balanced.effect.gap_change) if same else math.inf,
        area=balanced.effect.area_factor if balanced.response is not None else math.nan,
        plastic=corrected / plastic if plastic else math.nan,
    )


def _balanced(prepared: Prepared, speed: float) -> PaperSolution:
    """Return the strips that load sharing needs at ``speed`` [m/s], in steady balance."""
    solution = solve_to_tolerance(prepared, speed, PaperModel())
    assert isinstance(solution, PaperSolution)
    return solution


def _mean(factors: list[float]) -> float:
    known = [factor for factor in factors if math.isfinite(factor)]
    return float(np.mean(known)) if known else math.nan
