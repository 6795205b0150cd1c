"""From the error of a gap to the errors of f and of all reported quantities."""

import math
from dataclasses import dataclass, replace

from ...quantities import depending_on
from ...samples import way_to_longer_line
from ...scene import Scene, budget, has_moving_roughness, why_gap_not_resolved
from ..model_answer import AnswerErrors
from ..shared import (
    BY_HEAT,
    DETERMINISTIC,
    FEW_CONTACTS,
    FREEDOM_NOT_COUNTED,
    REDUCED_BY_DETERMINISTIC,
    UNKNOWN_SIDES,
    ModelErrorPart,
    Sides,
    StandardError,
    added_sides,
    area_needed,
    error_by_heat,
    has_too_few_contacts,
    heat_error_in_words,
    percent,
    sides_of_parts,
    why_map_too_small,
    why_sample_too_short,
)
from .balance import Balance
from .balanced_sample import BalancedSample
from .closure import gap_per_film, relative_gap_per_film
from .error_of_eq8 import error_of_share, largest_film_load_ratio, least_error, load_sharing_error, starved_error
from .forces import Forces
from .response import contact_length
from .scatter import Scatter

# Relative change of the plastic part over that of the load or the area, at most about. Not measured: it enters
# an error alone, where no asperity contacts are counted.
PLASTIC = 3.0
NO_CELLS = "sampling not known: this contact has no cells along y to compare"

# Errors of f towards 0 and away from it where the model has none. By definition.
NO_ERROR = Sides(0.0, 0.0)
BY_EQUATION = "the friction of Eq. (9)"
GAP_NOT_FILLED = "the arriving film does not fill the gap, which Eq. (8) neglects; f may be lower"
NOT_STUDIED = "the model-form error is not known for this contact"
MODEL_ERROR_UNKNOWN = "the model-form error is not known and not in the interval: {}"
TOO_LITTLE = "there was too little of it to estimate"
NOT_WITHOUT_FILM = "not estimated without a film"
UNDETECTED_UNKNOWN = "sampling not known: the patch is too short along y to estimate the undetected contact"


@dataclass(frozen=True, kw_only=True)
class SolverErrors:
    """The errors of solvers and grids.

    Attributes
    ----------
    film_error : of the film, relative
    gap_error : of the mean gap at given load [m], by what the root leaves of it and by the cells of the contact
    shear_error : of the film's shear stress, relative to f: by its sum over nodes, by the heat that it omits, and by
        where the surfaces touch
    area_error : of the contact area, relative
    """

    film_error: float
    gap_error: float
    shear_error: float
    area_error: float


def errors_of(balanced: BalancedSample) -> AnswerErrors:
    """Return the errors of ``balanced``."""
    scene = balanced.prepared.scene
    balance = balanced.corrected_balance
    response = balanced.response
    solver = solver_errors_of(balanced)
    numerical = solver.shear_error
    forces = balance.forces
    scatter = balanced.scatter
    of_sample = balanced.sampling_error.value
    error = StandardError(0.0, FREEDOM_NOT_COUNTED)
    film_sensitivity = forces.film_sensitivity
    if response is not None:
        film_sensitivity = response.per_film(forces, balance.contact_state.mean_film)
    why = TOO_LITTLE
    reasons = dict.fromkeys(depending_on("heat"), forces.heat.reason(scene))
    if balance.film is None:
        # only areas scatter
        errors = _area_errors(balance, scatter)
        why = NOT_WITHOUT_FILM
        of_film = (name for name in depending_on("film") if name != "mean_gap")
        reasons = dict.fromkeys((*of_film, *depending_on("heat")), f"{balance.why_no_film}: there is no film")
        errors |= dict.fromkeys((*depending_on("sharing"), *depending_on("shear")), 0.0)
    elif response is None:
        numerical += film_sensitivity * solver.film_error
        errors = _given_load(balance, solver.film_error)
        of_contact = (*depending_on("sharing"), *depending_on("area"), *depending_on("contacts"))
        reasons |= dict.fromkeys(of_contact, "without asperity contact it has no relative error")
        errors |= {"film_load": 0.0}
    else:
        error = balanced.friction_scatter
        numerical += film_sensitivity * solver.film_error
        numerical += response.relative("coefficient", solver.gap_error)
        errors = _with_error_of_share(balanced, _contact_errors(balanced, solver))
    notes = _notes(balanced)
    if not math.isfinite(of_sample):
        of_sample = math.nan
    by_equation, unknown = model_error_of_eq8(balanced)
    by_inlet = 1 - forces.heat.film_factor**film_sensitivity
    by_heat = error_by_heat(forces.heat, by_inlet)
    of_heat = heat_error_in_words(forces.heat, by_inlet, scene.numerics.tolerance, is_at_most=True)
    parts = _parts_of_model(by_equation, by_heat)
    model_error = sides_of_parts(parts)
    of_f = numerical if math.isnan(of_sample) else math.hypot(numerical, of_sample)
    return AnswerErrors(
        numerical=numerical,
        sampling_error=StandardError(of_sample, error.freedom),
        model_error=model_error,
        parts_of_model=() if math.isnan(max(model_error)) else parts,
        of_numbers=errors | {"coefficient": of_f},
        why_not_known=why,
        reasons=reasons,
        notes=(*notes, *unknown, *filter(None, [of_heat])),
        largest_film_load_ratio=_largest_film_load_ratio(balanced, by_equation),
        area_needed=_area_needed(balanced),
    )


def solver_errors_of(balanced: BalancedSample) -> SolverErrors:
    """Return the errors of ``balanced`` by solvers and grids."""
    balance = balanced.corrected_balance
    effect = balanced.effect
    raw_balance = balanced.raw_balance
    film_error = 0.0
    if balance.film is not None:
        residuals = balance.film.report.residuals
        film_error = max(residuals.get("discretisation", 0.0), residuals.get("domain", 0.0))
    forces = balance.forces
    gap_error = 0.0
    if balanced.response is not None and balance.film is not None:
        # on native cells nothing is corrected, so that all that the root leaves is an error
        is_corrected = balanced.gap_change != 0
        by_root = budget.SLOPE * abs(balanced.gap_change) if is_corrected else abs(balanced.left_by_root)
        gap_error = effect.remaining_change + balanced.uncorrected_gap + by_root + raw_balance.contact_state.gap_error
    contact_state = raw_balance.contact_state
    by_area = 0.0
    if contact_state.area_error and forces.total:
        open_fraction = max(1 - contact_state.real_contact_area_fraction, contact_state.area_error)
        by_area = contact_state.area_error / open_fraction * forces.shear.magnitude / forces.total
    return SolverErrors(
        film_error=film_error,
        gap_error=gap_error,
        shear_error=forces.quadrature + forces.heat.left_out + by_area,
        area_error=effect.area_error + contact_state.area_error / max(contact_state.real_contact_area_fraction, 1e-300),
    )


def _contact_errors(balanced: BalancedSample, solver: SolverErrors) -> dict[str, float]:
    """Return the relative errors where film and contact share the load, by the names of `FrictionResult`: the root of
    the sum of squares of the standard error by the surface and of the estimated error by solvers and grids.

    An error of the gap changes the division of the load, and everything with it (`Response.rates`). Films also have the
    error of the film solve. The area also has its own scatter at given load, and what its cells may change.
    """
    balance = balanced.corrected_balance
    response = balanced.response
    assert response is not None
    scattered = balanced.gap_scatter.value if math.isfinite(balanced.gap_scatter.value) else 0.0
    gap_error = math.hypot(
        scattered, solver.gap_error + solver.film_error * gap_per_film(balance.contact_state.mean_film)
    )
    errors = {name: response.relative(name, gap_error) for name in response.rates or ()}
    errors["film_to_roughness_ratio"] = errors.get("central_film", 0.0)
    for name, at_given_load in _given_load(balance, solver.film_error).items():
        errors[name] = errors.get(name, 0.0) + at_given_load
    by_load = errors.get("contact_load", 0.0)
    for name, error in _area_errors(balance, balanced.scatter).items():
        errors[name] = math.hypot(by_load, error, solver.area_error)
    if balance.contact_state.plastic_area_fraction > 0:
        change = balanced.effect.plastic_change / balance.contact_state.plastic_area_fraction
        counted = (
            balanced.scatter.effective_contacts**-0.5
            if balanced.scatter.effective_contacts
            else PLASTIC * math.hypot(by_load, solver.area_error)
        )
        errors["plastic_area_fraction"] = math.hypot(counted, change)
    return errors


def _with_error_of_share(balanced: BalancedSample, errors: dict[str, float]) -> dict[str, float]:
    """Return the relative ``errors``, those of the division of the load with half the error at 95 % that Eq. (8) has in
    it (`error_of_share`), where that is known."""
    balance = balanced.corrected_balance
    scene = balanced.prepared.scene
    sq = balanced.prepared.surface.sq
    load = scene.bodies.load
    if balance.film is None or not sq > 0 or why_gap_not_resolved(scene):
        return errors
    by_model = error_of_share(
        balance.film.central_film / sq,
        balance.contact_load / load,
        may_be_film=scene.lubricant.limit is not None,
    )
    changed = dict(errors)
    for name in depending_on("sharing"):
        part = balance.film_load if name == "film_load" else balance.contact_load
        if part > 0 and name in changed:
            changed[name] = math.hypot(changed[name], 0.5 * by_model * load / part)
    return changed


def _area_errors(balance: Balance, scatter: Scatter) -> dict[str, float]:
    """Return the relative standard errors at given load of all that depends on an area: of the area of the complete
    line its own, of the rest that of the fraction of A."""
    contact_state = balance.contact_state
    of_fraction = _relative(scatter.area, contact_state.real_contact_area_fraction)
    of_line = _relative(scatter.contact_length, contact_length(contact_state))
    return dict.fromkeys(depending_on("area"), of_fraction) | {"real_contact_area": of_line}


def _relative(error: StandardError, value: float) -> float:
    """Return the ``error`` of a ``value`` over it: 0 where it is not known, NaN where the value is not above 0."""
    if not value > 0:
        return math.nan
    return error.value / value if math.isfinite(error.value) else 0.0


def _given_load(balance: Balance, film_error: float) -> dict[str, float]:
    """Return the errors of what depends on the film of ``balance`` at a given load, whose relative error is
    ``film_error``. That of the mean gap follows from it by the closure. Where the heat of the inlet is omitted, its
    factor is off by what is known of it; a temperature rise that was omitted has no error (NaN)."""
    forces = balance.forces
    heat = forces.heat
    of_heat = dict.fromkeys(depending_on("heat"), film_error if heat.heated else math.nan)
    of_heat["inlet_film_factor"] = math.nan if heat.inlet is None else film_error + heat.film_factor - heat.inlet.factor
    of_film = dict.fromkeys(depending_on("film"), film_error)
    of_gap = {"mean_gap": film_error * relative_gap_per_film(balance.contact_state.mean_film)}
    return of_film | of_gap | of_heat | _shear_errors(forces, film_error)


def _shear_errors(forces: Forces, film_error: float) -> dict[str, float]:
    """Return the relative errors of the film's friction and its parts, by the relative error ``film_error`` of the film
    and by the sums over its nodes. The rolling part is a small difference of large numbers, so its error is large."""
    shear = forces.shear
    rolling = film_error * max(abs(shear.rolling), shear.rolling_parts)
    heat = forces.heat.left_out * forces.total
    parts = {
        "shear_force": (shear.total, film_error * abs(shear.couette) + rolling + heat),
        "couette_force": (shear.couette, film_error * abs(shear.couette) + heat),
        "rolling_force": (shear.rolling, rolling),
        "rolling_resistance": (shear.rolling, rolling),
    }
    return {n: (error + shear.quadrature) / abs(value) if value else 0.0 for n, (value, error) in parts.items()}


def model_error_of_eq8(balanced: BalancedSample) -> tuple[Sides, tuple[str, ...]]:
    """Return the relative error of f by load sharing itself, at 95 %, towards 0 and away from it; where it is not known
    NaN, and why."""
    balance = balanced.corrected_balance
    scene = balanced.prepared.scene
    if balance.film is None:
        arriving = scene.lubricant.inlet_film
        if arriving is None or balanced.speed == 0:
            return NO_ERROR, ()
        return starved_error(arriving, balance.contact_state.mean_gap), (GAP_NOT_FILLED,)
    if balanced.on_cells is None:
        return UNKNOWN_SIDES, (NOT_STUDIED,)
    if why := why_gap_not_resolved(scene):
        return UNKNOWN_SIDES, (MODEL_ERROR_UNKNOWN.format(why),)

    sq = float(balanced.on_cells.heights.std())
    film = balance.film.central_film
    share = balance.contact_load / scene.bodies.load
    forces = balance.forces
    load = scene.bodies.load
    ratio = film / sq if sq else math.inf
    sides = _error_of_shared_load(
        scene,
        ratio,
        share=share,
        is_shared=share > 0,
        boundary=forces.boundary / load,
        shear=forces.shear.total / load,
        rolling=forces.shear.rolling / load,
    )
    if scene.lubricant.inlet_film is not None and share > 0:
        sides = added_sides([sides, starved_error(scene.lubricant.inlet_film, balance.contact_state.mean_gap)])
    return _of_sliding(scene, sides, forces.shear.rolling), ()


def _largest_film_load_ratio(balanced: BalancedSample, by_equation: Sides) -> float:
    """Return the `largest_film_load_ratio` of ``balanced``; 1 where its model-form error is not known, and where Eq. (8)
    takes a film that arrives for none (`starved_error`)."""
    balance = balanced.corrected_balance
    sq = balanced.prepared.surface.sq
    is_neglected = balance.film is None and max(by_equation) > 0
    if math.isnan(max(by_equation)) or is_neglected or not sq > 0:
        return 1.0
    ratio = math.inf if balance.film is None else balance.film.central_film / sq
    return largest_film_load_ratio(ratio, balance.contact_load / balanced.prepared.scene.bodies.load)


def moment_model_error(
    scene: Scene,
    *,
    film_to_roughness_ratio: float,
    share: float,
    film_load: float,
    boundary: float,
    shear: float,
    rolling: float,
    by_heat: float,
) -> Sides:
    """Return the relative model-form error of f at a moment of a run in time, at 95 %, towards 0 and away from it.

    It is that of steady motion with the same film, asperity load ratio ``share``, ``film_load`` [N], parts of f, and
    error ``by_heat`` (`lubfric.models.shared.error_by_heat`). NaN where it is not known (`why_moment_unknown`).
    """
    if why_moment_unknown(scene):
        return UNKNOWN_SIDES
    sides = _error_of_shared_load(
        scene,
        film_to_roughness_ratio,
        share=share,
        is_shared=share > 0 and film_load > 0,
        boundary=boundary,
        shear=shear,
        rolling=rolling,
    )
    return sides_of_parts(_parts_of_model(_of_sliding(scene, sides, rolling), by_heat))


def _of_sliding(scene: Scene, sides: Sides, rolling: float) -> Sides:
    """Return the relative ``sides`` of f, towards 0 at most all of it: f is beyond 0 only by a ``rolling`` part that
    helps the sliding, below 0, or by pressure on the flanks of moving roughness, which is omitted and has any sign."""
    return sides if rolling < 0 or has_moving_roughness(scene) else sides.capped()


def _parts_of_model(by_equation: Sides, by_heat: float) -> tuple[ModelErrorPart, ...]:
    """Return the parts of the model-form error of f: ``by_equation`` on both sides, and ``by_heat`` on each."""
    return (
        ModelErrorPart(
            sides=by_equation,
            cause=BY_EQUATION,
            recommendation=REDUCED_BY_DETERMINISTIC,
            reduced_by_model=DETERMINISTIC,
        ),
        ModelErrorPart(sides=Sides(by_heat, by_heat), cause=BY_HEAT),
    )


def _error_of_shared_load(
    scene: Scene, ratio: float, *, share: float, is_shared: bool, boundary: float, shear: float, rolling: float
) -> Sides:
    """Return `load_sharing_error` at a film-to-roughness ``ratio``, with the ``rolling`` part of f if roughness moves,
    and at least `least_error` where rough surfaces touch beside a film that carries load (``is_shared``).

    A film may carry so little that the ``share`` of the asperities rounds to 1: it is there nevertheless.
    """
    moving = rolling if has_moving_roughness(scene) else 0.0
    sides = load_sharing_error(ratio, share=share, boundary=boundary, shear=shear, rolling=moving)
    least = least_error(ratio, share) if is_shared and math.isfinite(ratio) else 0.0
    return sides.at_least(least)


def why_moment_unknown(scene: Scene) -> str:
    """Return why the model-form error of f in a run in time of ``scene`` is not known; "" if it is. The error is that
    of steady motion, so only what the deterministic model does not take in steady motion counts."""
    return why_gap_not_resolved(replace(scene, transient=None))


def _area_needed(balanced: BalancedSample) -> float:
    """Return how many times more of a map that ends would be needed (1: enough, or there is more of it; NaN: not
    known)."""
    target = balanced.prepared.scene.numerics.sampling_tolerance
    has_ended = balanced.sample.ends_after(balanced.count)
    return area_needed(balanced.sampling_error.value, target, has_ended=has_ended)


def _notes(balanced: BalancedSample) -> tuple[str, ...]:
    """Return why the sampling error is not known or above its tolerance, and whether few asperity contacts carry the
    load."""
    scene = balanced.prepared.scene
    error = balanced.sampling_error.value
    tolerance = scene.numerics.sampling_tolerance
    sample = balanced.sample
    notes = []
    needed = _area_needed(balanced)
    if not math.isfinite(error):
        if balanced.on_cells is None:
            return (NO_CELLS,)
        if balanced.response is None:
            return (f"{UNDETECTED_UNKNOWN}; give {way_to_longer_line(scene, sample.whole_map)}",)
        return (why_sample_too_short(scene, balanced.scatter.length / sample.correlation_lengths[1], sample),)
    if error > tolerance and needed > 1:
        notes.append(why_map_too_small(tolerance, needed))
    elif error > tolerance:
        notes.append(f"more than the requested {percent(tolerance)}")
    if has_too_few_contacts(balanced.scatter.effective_contacts, error, tolerance):
        notes.append(
            f"few asperity contacts carry the load (effective number {balanced.scatter.effective_contacts:.2g}, below "
            f"{FEW_CONTACTS:g}), so the interval may be too narrow"
        )
    return tuple(notes)
