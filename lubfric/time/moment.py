"""The numbers of one moment: film, contact, friction with both parts and its heat, mass balance, validity."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np

from .._base import FloatArray
from ..contact import HalfSpaceContact
from ..errors import ConvergenceError
from ..estimate import full_load_numbers
from ..film import ShearForce, above_carried, rolling_error, smallest, spike_error
from ..models.load_sharing import (
    MomentResponse,
    gap_under,
    moment_error,
    moment_model_error,
    slopes_of,
    volume_residual,
)
from ..models.shared import (
    Assumption,
    Heat,
    Violation,
    error_by_heat,
    inlet_at,
    point_heat,
    typical_heat,
    violations_by_deflection,
    violations_by_ends,
    violations_by_film,
    violations_by_inlet_of_moment,
    violations_by_motion,
    violations_by_typical_heat,
)
from ..oil import shear_stress
from ..scene import Scene
from .film_equations import outside_shear
from .film_setting import WET_PRESSURE
from .load_sharing_solver import ContactOfMoment, LoadSharingSolver
from .march import Progress, Step
from .moment_columns import ends_of_film, motion_columns, sense_of, sense_of_friction
from .scene_in_time import scene_at, sliding_at

# Flow over central film times largest speed, below which the film counts as at rest [-]. A choice: with a smaller value
# the film of a reversal is stated by its flow, which is near 0.
NO_FLOW = 1e-2

STEADY_ONLY = (
    "compare f with that of a steady point with the same values (a scene without [transient]) and "
    "numerics.film_deflection = 'scaled', where the total load deflects the film"
)
# Entrainment speed [m/s] of a film at rest, which was drawn in slowly. A choice: slower films are as thin as molecules.
STANDSTILL_SPEED = 1e-6

# Step of ln F_H [-] for the slope of the film over its load. A choice: the slope changes slowly.
LOG_LOAD_STEP = 0.05


# Part of f_b below which f is as good as 0: the error of its shear is compared with that part of f_b then. A choice: a
# smaller value states relative errors of numbers near 0.
SMALL_FRICTION = 0.01

# Cells beyond the last node with pressure to which the rupture of the film is extrapolated, at most. A choice, against
# noise.
MOST_OF_CELL = 2.0

# Force [N] below which no number is divided by a force. A choice, near the smallest number.
TINY_FORCE = 1e-300


@dataclass(frozen=True, kw_only=True)
class FrictionOfMoment:
    """The friction of a moment of a run by load sharing.

    Attributes
    ----------
    sliding : sliding speed [m/s]
    sense : 1 or -1, the sense in which f is positive
    boundary : friction force of the asperity contacts [N] on surface 2, positive along -x
    shear : friction force of the film
    heat : of inlet, film and surfaces
    film_factor : factor on the film by the heat of its inlet; NaN: not known
    """

    sliding: float
    sense: float
    boundary: float
    shear: ShearForce
    heat: Heat
    film_factor: float

    @property
    def force(self) -> float:
        """The friction force [N] on surface 2, positive along -x."""
        return self.boundary + self.shear.total

    def columns(self, load: float) -> dict[str, float]:
        """Return the columns of friction and heat under the total ``load`` [N]."""
        heat = self.heat
        return {
            "boundary_force": self.boundary,
            "couette_force": self.shear.couette,
            "rolling_force": self.shear.rolling,
            "coefficient": self.force * self.sense / load,
            "shear_error": self.shear.quadrature / abs(self.force) if self.force else 0.0,
            "inlet_film_factor": self.film_factor,
            "flash_temperature_rise": heat.flash,
            "film_temperature_rise": heat.film_rise,
            "heat_change": heat.change if heat.is_evaluated else math.nan,
        }


@dataclass(frozen=True, kw_only=True)
class FilmOfMoment:
    """The pressurised film of a moment, as `lubfric.models.shared.PressurisedFilm`."""

    x: FloatArray
    pressure: FloatArray
    film_thickness: FloatArray
    entrainment_speed: float
    rupture: float


def load_sharing_moment(model: LoadSharingSolver, now: Progress) -> tuple[dict[str, float], tuple[Violation, ...]]:
    """Return the numbers after the last step, by name, and the assumptions that do not hold then."""
    solution = now.solution
    scene = scene_at(model.scene, now.time)
    speed = scene.motion.entrainment_speed
    friction = _friction_of(model, scene, now.time, solution)
    shear = friction.shear
    of_film = _film_columns(model, solution)
    row = {
        **motion_columns(
            now,
            scene,
            sliding=friction.sliding,
            force=friction.force,
            rolling_resistance=2.0 * shear.rolling * sense_of(speed),
        ),
        **friction.columns(scene.bodies.load),
        **of_film,
        **_contact_columns(model, solution, scene.bodies.load, of_film["film_load"]),
        **_errors_of_f(model, model.contact_at(now.time), scene, solution, friction, of_film),
        **full_load_numbers(scene, speed, float(model.prepared.surface.sq), friction.film_factor),
        **_mass(model, solution),
    }
    heat = friction.heat
    not_heated = replace(heat, heated=None, peclet=heat.peclet if heat.heated else math.inf)
    violations = _violated(model, scene, row, shear, not_heated)
    return row, (*violations, *violations_by_typical_heat(scene, heat.typical))


def _friction_of(model: LoadSharingSolver, scene: Scene, time: float, solution: Step) -> FrictionOfMoment:
    """Return the friction of the moment ``time`` [s], at which ``scene`` holds."""
    sliding = sliding_at(model.scene, time)
    boundary = scene.bodies.boundary_friction_coefficient * solution.payload.load * np.sign(sliding)
    shear, heat = film_shear(model, scene, time, sliding, solution, boundary)
    inlet, _ = inlet_at(scene, scene.motion.entrainment_speed)
    is_inlet_heated = model.setting.line_history.viscosity.before(time) != scene.lubricant.viscosity
    film_factor = 1.0
    if inlet is None:
        film_factor = math.nan
    elif is_inlet_heated:
        film_factor = inlet.factor
    return FrictionOfMoment(
        sliding=sliding,
        sense=sense_of_friction(scene, sliding),
        boundary=boundary,
        shear=shear,
        heat=replace(heat, inlet=inlet, is_used=film_factor < 1.0),
        film_factor=film_factor,
    )


def _film_columns(model: LoadSharingSolver, solution: Step) -> dict[str, float]:
    """Return the columns of the smooth film."""
    setting = model.setting
    terms = solution.terms
    problem = setting.problem
    sq = float(model.prepared.surface.sq)
    central_film = terms.H[setting.grid.n // 2] * problem.film_unit
    return {
        "film_load": terms.carried * setting.load_unit,
        "min_film": smallest(setting.grid.x, terms.H) * problem.film_unit,
        "central_film": central_film,
        "film_to_roughness_ratio": central_film / sq if sq else math.inf,
        "max_pressure": terms.P.max() * problem.pressure_unit,
        **ends_of_film(setting.grid.x[terms.P > 0.0] * problem.length_unit),
    }


def _contact_columns(model: LoadSharingSolver, solution: Step, load: float, film_load: float) -> dict[str, float]:
    """Return the columns of the rough contact, and of how it shares the total ``load`` [N] with a film that carries
    ``film_load`` [N]."""
    contact_step = solution.payload
    state = contact_step.state
    touches = contact_step.load > 0.0
    # 0 where nothing is plastic, even if the factor by the cells is not known
    plastic_area = state.plastic_area_fraction * model.plastic if state.plastic_area_fraction else 0.0
    return {
        "contact_load": contact_step.load,
        "mean_film": state.mean_film,
        "mean_gap": state.mean_gap if touches else gap_under(state.mean_film),
        "real_contact_area_fraction": state.real_contact_area_fraction * model.area if touches else 0.0,
        "plastic_area_fraction": plastic_area,
        "edge_load": model.prepared.rough_contact.on_the_ends(state) if touches else math.nan,
        "load_residual": (film_load + contact_step.load) / load - 1.0,
        "volume_residual": volume_residual(state) if touches else math.nan,
    }


def _errors_of_f(
    model: LoadSharingSolver,
    contact: ContactOfMoment,
    scene: Scene,
    solution: Step,
    friction: FrictionOfMoment,
    of_film: dict[str, float],
) -> dict[str, float]:
    """Return the columns with the errors of f by the finite surface and by the model; ``of_film``: those of the
    film."""
    contact_step = solution.payload
    load = scene.bodies.load
    film_load = of_film["film_load"]
    shear = friction.shear
    heat = friction.heat
    response = MomentResponse(
        contact_load=contact_step.load,
        film_load=film_load,
        boundary=friction.boundary,
        viscous=shear.total,
        softness=contact_softness(contact, solution, scene.bodies.width),
        film_load_exponent=film_load_exponent(scene, film_load),
        mean_film=contact_step.state.mean_film,
    )
    sampling_error = moment_error(
        cast(HalfSpaceContact, contact.patch),
        contact_step.state,
        response,
        width=scene.bodies.width,
        correlation_length=model.correlation_length,
    )
    film_sensitivity = response.per_film(shear.magnitude)
    model_error = moment_model_error(
        scene,
        film_to_roughness_ratio=of_film["film_to_roughness_ratio"],
        share=contact_step.load / load,
        film_load=film_load,
        boundary=friction.sense * friction.boundary / load,  # along the sliding
        shear=friction.sense * shear.total / load,
        rolling=friction.sense * shear.rolling / load,
        by_heat=error_by_heat(heat, 1 - heat.film_factor**film_sensitivity),
    )
    return {
        "sampling_error": sampling_error,
        "model_error_low": model_error.towards,
        "model_error_high": model_error.away,
    }


def _violated(
    model: LoadSharingSolver, scene: Scene, row: dict[str, Any], shear: ShearForce, heat: Heat
) -> Iterator[Violation]:
    """Yield the assumptions of the steady model and of a run that do not hold at one moment."""
    speed = row["entrainment_speed"]
    film = row["central_film"]
    force = abs(row["friction_force"])
    prepared = model.prepared
    yield from prepared.violations
    yield from violations_by_ends(prepared.scene, row["edge_load"], prepared.surface)
    yield from violations_by_motion(scene, speed, film)
    yield from violations_by_inlet_of_moment(scene, speed)
    yield from violations_by_film(
        scene, thickness=film, peak=row["max_pressure"], shear=shear, film_load=row["film_load"], force=force, heat=heat
    )
    smallest_force = SMALL_FRICTION * scene.bodies.boundary_friction_coefficient * row["load"]
    shear_error = shear.quadrature / max(force, smallest_force, TINY_FORCE)
    if shear_error > scene.numerics.tolerance:
        yield Violation(
            assumption=Assumption.RESOLVED_SHEAR,
            what="estimated error of f by the sum of the film's shear stress",
            value=shear_error,
            limit=scene.numerics.tolerance,
            unit="",
            consequence="the grid of a run in time does not resolve the pressure spike, or the film is ruptured "
            "where it shears most",
            recommendation="set a tighter numerics.film_tolerance, or solve the steady point at the same speed "
            "(lubfric.friction), which resolves the spike",
        )
    if row["contact_load"] > 0:
        yield from violations_by_deflection(scene, row["mean_gap"], STEADY_ONLY)


def _mass(model: LoadSharingSolver, solution: Step) -> dict[str, float]:
    """Balance of the lubricant per unit width and time [m²/s] where the film carries load (pressure above
    ``WET_PRESSURE`` of the largest): flow into it, lubricant stored there; and the growth of the gap in the cavitated
    zone that nothing fills. mass_residual: what is missing in the balance, over the larger of the flow and
    ``NO_FLOW``."""
    t = solution.terms
    p = model.setting.problem
    unit = p.film_unit * p.line.entrainment_speed
    film = t.P[1:-1] > WET_PRESSURE * t.P.max()
    stored = float(np.sum(t.stored[1:-1][film]))
    inflow = -float(np.sum(np.diff(t.flux)[film]))
    inside = np.abs(t.flux)[1:-1][film[1:] & film[:-1]]
    through = float(np.median(inside)) if inside.size else 0.0
    through = max(through, abs(stored), NO_FLOW * t.H[t.H.size // 2])
    return {
        "net_inflow": inflow * unit,
        "stored": stored * unit,
        "mass_residual": abs(stored - inflow) / through,
        "cavity_growth": float(np.sum(t.r[1:-1][t.P[1:-1] <= 0.0])) * unit,
    }


def contact_softness(contact: ContactOfMoment, solution: Step, width: float) -> float:
    """Return -dG/d ln F_C [m] of the contact in ``solution``, by `lubfric.models.load_sharing.slopes_of`; 0 without
    contact, NaN where the contact at another load was not solved."""
    contact_step = solution.payload
    if contact_step.load <= 0:
        return 0.0
    try:
        slopes = slopes_of(
            contact.patch,
            contact_step.state,
            load=contact_step.load,
            width=width,
            thickness=contact.to_patch @ solution.terms.H,
        )
    except ConvergenceError:
        return math.nan
    return -slopes.gap * contact_step.load / width


def film_shear(
    model: LoadSharingSolver, scene: Scene, time: float, sliding: float, solution: Step, boundary: float
) -> tuple[ShearForce, Heat]:
    """Return the forces [N] on surface 2, positive along -x, and the heat of these and of the ``boundary``
    friction [N].

    They act where the film is pressurised and not touched, and include the inlet tails. ``scene``: that of the moment.
    Film and surfaces are taken to be as hot as in steady motion at the speeds of the moment.
    """
    lubricant = scene.lubricant
    contact_step = solution.payload
    t = solution.terms
    p = model.setting.problem
    wet = np.flatnonzero(t.P > 0.0)
    speed = scene.motion.entrainment_speed

    def cold(x: FloatArray, pressure: FloatArray, thickness: FloatArray) -> FloatArray:
        return shear_stress(lubricant, pressure, sliding / thickness)

    isothermal = _summed(model, time, solution, cold, lubricant.viscosity * sliding)
    if wet.size < 3 or speed == 0.0:
        return isothermal, Heat()
    inside = slice(wet[0], wet[-1] + 1)
    x = model.setting.grid.x[inside] * p.length_unit
    film = FilmOfMoment(
        x=x,
        pressure=t.P[inside] * p.pressure_unit,
        film_thickness=t.H[inside] * p.film_unit,
        entrainment_speed=speed,
        rupture=float(x[-1] if speed > 0 else x[0]),
    )
    force = abs(boundary + isothermal.total)
    point = point_heat(scene, film, contact_step.state, contact_load=contact_step.load, force=force, shear=isothermal)
    heated = point.stress
    if heated is None:
        typical = typical_heat(
            scene, film, contact_step.state, contact_load=contact_step.load, force=force, shear=isothermal
        )
        return isothermal, replace(point.heat, typical=typical)
    along = math.copysign(1.0, speed)

    def hot(x: FloatArray, pressure: FloatArray, thickness: FloatArray) -> FloatArray:
        return math.copysign(1.0, sliding) * np.abs(heated(x * along, pressure, thickness))

    return _summed(model, time, solution, hot), point.heat


def _summed(
    model: LoadSharingSolver, time: float, solution: Step, stress: Callable[..., Any], drag: float | None = None
) -> ShearForce:
    """Return `ShearForce` by trapezes of ``stress(x, pressure, film)`` [Pa]. ``drag``: that times the film [N/m] beyond
    the ends of the grid; None: as at the last node, because at any film its own heat thins it by the same factor."""
    t = solution.terms
    p = model.setting.problem
    grid = model.setting.grid
    x = grid.x * p.length_unit
    h = t.H * p.film_unit
    pressure = t.P * p.pressure_unit
    free = 1.0 - solution.payload.state.touching(x)
    part, part_error = full_part(x, pressure, model.setting.equations(time).dry)
    full = free * np.diff(x) * part
    with np.errstate(over="ignore"):
        tau = stress(x, pressure, h)
        middle = stress(*(_halfway(a) for a in (x, pressure, h)))
    ratio, excess = above_carried(pressure, np.where(pressure > 0.0, tau, 0.0), full)
    rolls = 0.5 * _halfway(h) * np.diff(pressure)
    taken = float(np.sum(rolls * (1.0 - free)))  # by the asperity contacts
    wet = np.flatnonzero(pressure > 0.0)
    error = 2 / 3 * abs(float(np.sum((middle - _halfway(tau)) * full)))
    if wet.size > 4:
        inside = slice(wet[0], wet[-1] + 1)
        error = max(error, spike_error(x[inside], tau[inside])) + rolling_error(pressure[inside], h[inside], 1.0)
    error += float(np.sum(np.abs(_halfway(tau)) * free * np.diff(x) * part_error))
    drags = tau[[0, -1]] * h[[0, -1]] if drag is None else np.full(2, drag)
    more, rolling = _tails(model, time, drags, solution)
    width = model.setting.line_history.width
    return ShearForce(
        couette=width * (float(np.sum(_halfway(tau) * full)) + more),
        rolling=width * (float(np.sum(rolls * free)) + rolling),
        quadrature=width * error,
        rolling_parts=width * (abs(float(np.sum(rolls))) + abs(taken)),
        excess=width * excess,
        stress_ratio=ratio,
    )


def _halfway(nodal: np.ndarray) -> np.ndarray:
    return 0.5 * (nodal[1:] + nodal[:-1])


def _tails(model: LoadSharingSolver, time: float, drags: np.ndarray, solution: Step) -> tuple[float, float]:
    """Return the Couette and rolling part [N/m] of the parabolic film beyond the ends of the grid. ``drags``: shear
    stress times film [N/m] at both ends."""
    setting = model.setting
    t = solution.terms
    p = setting.problem
    grid = setting.grid
    now = setting.equations(time)
    couette = 0.0
    rolling = 0.0
    for end, sign, drag in ((0, 1.0, drags[0]), (-1, -1.0, drags[1])):
        if t.P[end] > 0.0:
            a = abs(grid.x[end])
            flow = sign * t.flux[end] + t.stored[end]
            rate = t.stored[end] / grid.weights[end]
            reach, tail = outside_shear(a, t.H[end], now.curvature, now.viscosity, sign * now.speed, flow, rate)
            couette += float(drag) * reach * p.length_unit / p.film_unit
            rolling -= sign * tail * p.film_unit * p.pressure_unit
    return couette, rolling


def full_part(x: np.ndarray, pressure: np.ndarray, dry: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the part of each cell between neighbouring ``x`` that the pressurised film fills, and its estimated error.

    The cell downstream of the ``dry`` nodes, at which the lubricant begins, is full. Where the film ruptures, the
    pressure falls to zero like a square (p = dp/dx = 0 there), so two nodes determine where; the part is above 1 where
    that is in the next cell. The two nodes before the last one with pressure determine it best, because the last one
    takes what the cut of the cell leaves. The error is the difference from the rupture by the last two.
    """
    wet = pressure > 0.0
    root = np.sqrt(np.maximum(pressure, 0.0))
    part = ((wet[1:] | dry[1:]) & (wet[:-1] | dry[:-1]) & (wet[1:] | wet[:-1])).astype(float)
    error = np.zeros_like(part)
    for i in np.flatnonzero((wet[1:] != wet[:-1]) & (part == 0.0)).tolist():
        last, step = (i, 1) if wet[i] else (i + 1, -1)
        parts = [
            (_rupture(x, root, node, step) - x[last]) / (x[last + step] - x[last])
            for node in (last - step, last)
            if 0 <= node - step < x.size
        ]
        known = [min(max(each, 0.0), MOST_OF_CELL) for each in parts if math.isfinite(each)]
        if known:
            part[i] = known[0]
            error[i] = abs(known[0] - known[-1])
    return part, error


def _rupture(x: np.ndarray, root: np.ndarray, node: int, step: int) -> float:
    """Return where the ``root`` of the pressure at ``node`` and at the one before it, towards which - ``step`` leads,
    falls to zero on a straight line; NaN where it does not fall."""
    before = node - step
    if not root[before] > root[node]:
        return math.nan
    return float(x[node] + root[node] * (x[node] - x[before]) / (root[before] - root[node]))


def film_load_exponent(scene: Scene, film_load: float) -> float:
    """Return -d ln h/d ln F_H [-] of Moes' film that carries ``film_load`` [N]. At rest, that of a film that was drawn
    in slowly; 1 without load."""
    if film_load <= 0.0:
        return 1.0
    line = scene.line_contact(scene.motion.entrainment_speed or STANDSTILL_SPEED)
    more = math.exp(LOG_LOAD_STEP)
    line = replace(line, load_per_width=film_load / scene.bodies.width)
    heavier = replace(line, load_per_width=more * line.load_per_width)
    return math.log(line.moes_film / heavier.moes_film) / LOG_LOAD_STEP
