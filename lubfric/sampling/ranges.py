"""Inputs that are known to a range only: what both ends of each change of f, in its interval."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from ..contact import RoughContact
from ..deterministic import Strip, solve_strip
from ..errors import ConvergenceError
from ..scene import FRICTION, Scene, moves, value_of
from ..sharing import Prepared, on_stack, prepare, solve_balance
from .moving import solved_strip
from .pair import longer_than, strip_of
from .result import FrictionResult
from .uncertainty import Uncertainty

LEAST = 5e-4  # of f: a smaller change is not told


def with_ranges(prepared: Prepared, result: FrictionResult) -> FrictionResult:
    """``result`` with the `Scene.ranges` of its inputs in the interval.

    f is linear in f_b at a given division of the load. At both ends of every other range it is solved again, by the
    model of the result: Eq. (8) on the first strips, or the deterministic model on one of them, on cells twice as long.
    The changes are relative to the middle on the same cells. Those of several inputs add up as squares, up and down for
    themselves. An end that cannot be solved leaves ``inputs`` NaN, and a note.
    """
    scene, f = prepared.scene, result.coefficient
    if not scene.ranges or not f:
        return result
    at: Callable[[Scene], float] | None = None
    changes: dict[str, tuple[float, float]] = {}
    for name, *ends in scene.at_ends():
        if name == FRICTION:
            slope = result.contact_load / scene.bodies.load * (scene.motion.slide_roll_ratio != 0) / f
            low, high = (slope * (value_of(end, name) - value_of(scene, name)) for end in ends)
        else:
            try:
                at = at or (_resolved if result.deterministic is not None else _shared)(prepared, result.speed)
                low, high = (at(end) / at(scene) - 1 for end in ends)
            except ConvergenceError:  # the point itself is solved
                low = high = math.nan
        changes[name] = low, high
    old = result.uncertainty
    known = widened(old, result.coefficient, changes)
    notes = tuple(known.text if note == old.text else note for note in result.report.notes)
    return replace(result, uncertainty=known, report=replace(result.report, notes=notes))


def widened(old: Uncertainty, f: float, changes: dict[str, tuple[float, float]]) -> Uncertainty:
    """``old`` of ``f`` with the relative ``changes`` by the two ends of inputs, by name."""
    unknown = [name for name, ends in changes.items() if math.isnan(sum(ends))]
    changes = {name: ends for name, ends in changes.items() if name not in unknown}
    moved = [(f * low, f * high) for low, high in changes.values()]  # f may be negative
    down, up = math.hypot(*(min(0.0, *ends) for ends in moved)), math.hypot(*(max(0.0, *ends) for ends in moved))
    low, high = old.interval
    told = (
        f"{name.partition('.')[2]} in its range: f {100 * low:+.2g} to {100 * high:+.2g} %"
        for name, (low, high) in changes.items()
        if max(abs(low), abs(high)) > LEAST
    )
    missed = "in its range: not in the interval, as an end was not solved"
    not_in = (f"{name.partition('.')[2]} {missed}" for name in unknown)
    return replace(
        old,
        inputs=math.nan if unknown else max(down, up) / abs(f),
        interval=(f - math.hypot(f - low, down), f + math.hypot(high - f, up)),
        notes=(*old.notes, *told, *not_in),
    )


def _shared(prepared: Prepared, speed: float) -> Callable[[Scene], float]:
    """f of scenes alike but for inputs, by Eq. (8) on the first strips of ``prepared``, or on its only contact."""
    strips, surface = prepared.strips, prepared.surface
    stack = None if strips is None else on_stack(prepared, strips, strips.first)
    contact = prepared.contact if stack is None else stack
    start = solve_balance(prepared.scene, speed, contact, surface.sq)

    def f(scene: Scene) -> float:
        there: RoughContact = contact
        if scene.bodies.hardness != prepared.scene.bodies.hardness:
            hardness = scene.bodies.hardness
            there = prepare(scene, surface).contact if stack is None else replace(stack, hardness=hardness)
        return solve_balance(scene, speed, there, surface.sq, start).forces.coefficient

    return f


def _resolved(prepared: Prepared, speed: float) -> Callable[[Scene], float]:
    """The same by the deterministic model, on one strip or on the patch."""
    surface, factors = strip_of(prepared, 0)
    factors = longer_than(surface, factors)

    def solved(scene: Scene, start: Strip | None = None) -> Strip:
        if moves(scene):
            return solved_strip(replace(prepared, scene=scene), 0, speed, factors=factors, start=start)
        return solve_strip(scene, surface, speed, factors=factors, start=start)

    start = solved(prepared.scene)
    return lambda scene: solved(scene, start).result.coefficient
