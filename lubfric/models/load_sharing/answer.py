"""What load sharing says of one operating point: its numbers, their errors, warnings and fields."""

import math
from dataclasses import replace
from functools import partial

import numpy as np

from ...contact import ContactResult, HalfSpaceContact
from ...oil import estimate_in_words
from ...samples import is_measured
from ...scene import Scene, has_moving_roughness
from ..model_answer import AtInputs, ContactFields, ModelAnswer
from ..shared import (
    Assumption,
    Prepared,
    Violation,
    contact_at_inputs,
    contact_on_joined_strips,
    film_and_exponents,
    pictured_contact,
    way_to_shorter_cells,
)
from .balance import Balance, solve_balance
from .balanced_sample import BalancedSample
from .closure import gap_per_film, gap_under, open_gap, volume_residual
from .decision_in_words import decision_of
from .error_of_eq8 import rolling_ratios_of
from .errors_of import errors_of
from .limits import limits_exceeded
from .response import contact_length, point_numbers
from .scatter import film_stress

# What narrows the numerical error, by whether the surface is a map, and not generated.
NARROWS_NUMERICAL = {
    True: "set a smaller numerics.tolerance or give a larger map",
    False: "set a smaller numerics.tolerance",
}


def answer_of(balanced: BalancedSample) -> ModelAnswer:
    """Return the answer of ``balanced``."""
    scene = balanced.prepared.scene
    numbers = _numbers(balanced)
    oil = scene.lubricant.oil
    temperature = scene.lubricant.temperature
    estimated = () if oil is None or temperature is None else (estimate_in_words(oil, temperature),)
    report = balanced.corrected_balance.report
    return ModelAnswer(
        numbers=numbers,
        errors=errors_of(balanced),
        accepts_model_error=scene.numerics.model == "paper",  # a scene that names this model accepts its error
        rolling_ratios=rolling_ratios_of(omits_flanks=has_moving_roughness(scene)),
        report=replace(report, notes=(*report.notes, *estimated)),
        decision=decision_of(
            scene,
            balanced.rough_contact,
            balanced.corrected_balance,
            clearance=numbers["clearance"],
            cells=balanced.sample.cells,
            strips=balanced.count,
            change_by_cells=balanced.relative_change(balanced.effect.gap_change),
        ),
        length=balanced.scatter.length,
        effective_contacts=balanced.scatter.effective_contacts,
        violations=(
            *violations_of_sample(balanced),
            *_violations_by_finer_cells(balanced.prepared, balanced.relative_change(balanced.effect.finer_grid_change)),
        ),
        recommendation=NARROWS_NUMERICAL[balanced.prepared.has_given_map or is_measured(scene)],
        fields=fields_of(balanced),
        fine_fields=None if balanced.on_cells is None else partial(fine_fields_of, balanced),
        details=replace(
            balanced.corrected_balance,
            contact_state=replace(
                balanced.corrected_balance.contact_state, fields=balanced.raw_balance.contact_state.fields
            ),
        ),
        at_inputs=lambda: _at_inputs(balanced),
    )


def violations_of_sample(balanced: BalancedSample) -> tuple[Violation, ...]:
    """Return the limits of load sharing that ``balanced`` exceeds."""
    fields = balanced.raw_balance.contact_state.fields
    return limits_exceeded(
        balanced.prepared,
        balanced.speed,
        balanced.corrected_balance,
        ends=edge_load_share(balanced),
        asperity_pressure=0.0 if fields is None else float(fields.pressure.max()),
    )


def fields_of(balanced: BalancedSample) -> ContactFields | None:
    """Return the fields of the contact as it was solved; None if it has no cells.

    Where nothing touches, the gap is that of the undeformed surface below the film.
    """
    rough_contact = balanced.on_cells
    if rough_contact is None:
        return None
    raw_balance = balanced.raw_balance
    where = balanced.sample.in_words(balanced.count)
    return fields_on(rough_contact, raw_balance, raw_balance.contact_state.fields, balanced.prepared.scene, where)


def fine_fields_of(balanced: BalancedSample) -> ContactFields:
    """Return the fields of a piece of the surface on cells fine enough to look at, under the film and the load of the
    complete sample."""
    prepared = balanced.prepared
    scene = prepared.scene
    sample = balanced.sample
    coarsening = sample.coarsening_to_look_at(scene.bodies.half_width)
    rough_contact = pictured_contact(prepared, sample, coarsening=coarsening)
    balance = balanced.corrected_balance
    if balance.film is None:
        state = rough_contact.close(rough_contact.x**2 / (2 * scene.bodies.radius), balance.contact_load)
    else:
        state = balanced.point.pressed(rough_contact, balance.film, balance.contact_load, None)
    where = sample.piece_on_cells_in_words(rough_contact.spacing)
    return fields_on(rough_contact, balance, state.fields, scene, where)


def fields_on(
    rough_contact: HalfSpaceContact, balance: Balance, fields: ContactResult | None, scene: Scene, where: str
) -> ContactFields:
    """Return the ``fields`` of ``rough_contact`` (None: separated) in the ``balance``, on the part of the surface that
    ``where`` says."""
    shape = rough_contact.heights.shape
    film = np.full(rough_contact.x.size, math.nan)
    shear = np.full(rough_contact.x.size, math.nan)
    if balance.film is not None:
        film = balance.film.film_at(rough_contact.x)
        if balance.forces.heat.heated is None:
            shear = film_stress(scene, rough_contact, balance.film)
    slides = scene.motion.slide_roll_ratio != 0
    pressure = np.zeros(shape) if fields is None else fields.pressure
    boundary = scene.bodies.boundary_friction_coefficient * pressure if slides else np.zeros_like(pressure)
    return ContactFields(
        solve=f"load sharing on {where}",
        x=rough_contact.x,
        y=rough_contact.y,
        heights=rough_contact.heights,
        pressure=pressure,
        gap=film[:, None] - rough_contact.heights if fields is None else fields.gap,
        deflection=np.zeros(shape) if fields is None else fields.displacement,
        film=np.broadcast_to(film[:, None], shape),
        shear=np.where(pressure > 0, boundary, shear[:, None]),
        half_width=scene.bodies.half_width,
    )


def _at_inputs(balanced: BalancedSample) -> AtInputs:
    """Return f at other inputs, on the first strips or on the only contact."""
    prepared = balanced.prepared
    sample = prepared.sample
    surface = prepared.surface
    rough_contact = contact_on_joined_strips(prepared, sample, sample.first_strips)
    start = solve_balance(prepared.scene, balanced.speed, rough_contact, surface.sq)

    def coefficient(scene: Scene) -> float:
        is_as_hard = scene.bodies.hardness == prepared.scene.bodies.hardness
        there = rough_contact if is_as_hard else contact_at_inputs(prepared, sample, sample.first_strips, scene)
        return solve_balance(scene, balanced.speed, there, surface.sq, start).forces.coefficient

    return AtInputs(middle=coefficient(prepared.scene), coefficient=coefficient)


def edge_load_share(balanced: BalancedSample) -> float:
    """Return the share of the load on the edge columns of the sample, on native cells: as it was found on these, or
    about as much smaller as they are shorter."""
    sample = balanced.sample
    if sample.refines_in_place and not sample.cells.is_native:
        return balanced.effect.edge_load_share
    return balanced.rough_contact.on_the_ends(balanced.raw_balance.contact_state) / sample.cells.coarsening[0]


def _violations_by_finer_cells(prepared: Prepared, change: float) -> tuple[Violation, ...]:
    """Return the violation where the relative ``change`` of f by cells half as long as the map's own is above
    ``numerics.tolerance``."""
    tolerance = prepared.scene.numerics.tolerance
    if not change > tolerance:
        return ()
    what = "change of f by cells half as long, estimated"
    recommendation = f"use {way_to_shorter_cells(prepared)}"
    consequence = "the cells of the map are too long for its roughness; the interval of f does not include this error"
    return (
        Violation(
            assumption=Assumption.FINE_MAP,
            what=what,
            value=100 * change,
            limit=100 * tolerance,
            unit="%",
            consequence=consequence,
            recommendation=recommendation,
        ),
    )


def _numbers(balanced: BalancedSample) -> dict[str, float]:
    """Return all numbers of the sample that load sharing has, by name."""
    prepared = balanced.prepared
    scene = prepared.scene
    balance = balanced.corrected_balance
    sq = prepared.surface.sq
    contact_state = balance.contact_state
    film = balance.film
    loads = (balance.film_load, balance.contact_load)
    is_separated = balance.contact_load == 0
    length = contact_length(contact_state) * balanced.effect.length_factor / balanced.effect.area_factor
    numbers = point_numbers(
        balance.forces, film, loads, gap_under(contact_state.mean_film) if is_separated else contact_state.mean_gap
    )
    return numbers | {
        "speed": balanced.speed,
        "real_contact_area_fraction": contact_state.real_contact_area_fraction,
        "real_contact_area": length * scene.bodies.width,
        "plastic_area_fraction": contact_state.plastic_area_fraction,
        "film_to_roughness_ratio": numbers["central_film"] / sq if sq > 0 else math.inf,
        "load_residual": (sum(loads) - scene.bodies.load) / scene.bodies.load,
        "volume_residual": 0.0 if film is None or is_separated else volume_residual(balanced.raw_balance.contact_state),
        "clearance": -open_gap(contact_state) / max(sq, 1e-12) if is_separated else math.nan,
        "steepness": _steepness(balanced),
    }


def _steepness(balanced: BalancedSample) -> float:
    """Return d ln(F_H/F_C)/d ln U: at a given division of the load the film grows as U^e, with closed forms at F_H. NaN
    where film and contact do not share the load."""
    response = balanced.response
    balance = balanced.corrected_balance
    if response is None or balance.film is None or balance.contact_load == 0:
        return math.nan
    scene = balanced.prepared.scene
    line = replace(scene.line_contact(balanced.speed), load_per_width=balance.film_load / scene.bodies.width)
    return (
        -film_and_exponents(line)[2] * response.log_load_ratio_per_gap * gap_per_film(balance.contact_state.mean_film)
    )
