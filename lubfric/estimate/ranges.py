"""Inputs that are known to a range only: what both ends of each change of f, in its interval."""

import math
from collections.abc import Callable
from dataclasses import replace

from ..contact import RoughContact
from ..errors import ConvergenceError
from ..models.deterministic import Strip, solve_strip
from ..models.load_sharing import solve_balance
from ..models.shared import (
    Prepared,
    on_stack,
    prepare,
)
from ..scene import FRICTION, Scene, moves, value_of
from .heated import strip_heat
from .moving import solved_strip
from .pair import longer_than, strip_of
from .result import FrictionResult
from .uncertainty import Uncertainty

HARDNESS = "bodies.hardness"
LEAST = 5e-4  # of f: a smaller change is not told


def with_ranges(prepared: Prepared, result: FrictionResult) -> FrictionResult:
    """``result`` with the `Scene.ranges` of its inputs in the interval.

    f is linear in f_b at a given division of the load. At both ends of every other range it is solved again, by the
    model of the result: Eq. (8) on the first strips, or the deterministic model on one of them. The changes are
    relative to the middle on the same cells. Those of several inputs add up as squares, up and down for
    themselves. An end that cannot be solved, and the hardness of a contact that is not lubfric's own, leave ``inputs``
    NaN, and a note.
    """
    scene = prepared.scene
    if not scene.ranges:
        return result
    at: Callable[[Scene], float] | None = None
    changes: dict[str, tuple[float, ...] | str] = {}
    for name, *ends in scene.at_ends():
        if name == FRICTION:
            slope = result.contact_load / scene.bodies.load * (scene.motion.slide_roll_ratio != 0)
            changes[name] = tuple(slope * (value_of(end, name) - value_of(scene, name)) for end in ends)
        elif name == HARDNESS and not prepared.own:
            changes[name] = "the contact is not lubfric's own"
        else:
            try:
                at = at or (_resolved if result.deterministic is not None else _shared)(prepared, result)
                changes[name] = tuple(result.coefficient * (at(end) / at(scene) - 1) for end in ends)
            except ConvergenceError:  # the point itself is solved
                changes[name] = "an end was not solved"
    old = result.uncertainty
    known = widened(old, result.coefficient, changes)
    notes = tuple(known.text if note == old.text else note for note in result.report.notes)
    return replace(result, uncertainty=known, report=replace(result.report, notes=notes))


def widened(old: Uncertainty, f: float, changes: dict[str, tuple[float, ...] | str]) -> Uncertainty:
    """``old`` of ``f`` with the ``changes`` of f by the two ends of inputs, by name; words: why they are not known."""
    moved = {name: ends for name, ends in changes.items() if not isinstance(ends, str)}
    down, up = (math.hypot(*(side(0.0, *ends) for ends in moved.values())) for side in (min, max))
    low, high = old.interval
    notes = []
    for name, ends in changes.items():
        begin = f"{name.partition('.')[2]} in its range: "
        if isinstance(ends, str):
            notes.append(f"{begin}not in the interval, as {ends}")
        elif not f:
            notes.append(f"{begin}f {ends[0]:+.2g} to {ends[1]:+.2g}")
        elif max(map(abs, ends)) > LEAST * abs(f):
            percents = [100 * end / f for end in ends]
            notes.append(f"{begin}f {' to '.join(f'{end:+.{2 + (abs(end) >= 99.5)}g}' for end in percents)} %")
    relative = max(down, up) / abs(f) if f else math.inf if max(down, up) else 0.0
    return replace(
        old,
        inputs=relative if len(moved) == len(changes) else math.nan,
        interval=(f - math.hypot(f - low, down), f + math.hypot(high - f, up)),
        notes=(*old.notes, *notes),
    )


def _shared(prepared: Prepared, result: FrictionResult) -> Callable[[Scene], float]:
    """f of scenes alike but for inputs, by Eq. (8) on the first strips of ``prepared``, or on its only contact."""
    strips = prepared.strips
    surface = prepared.surface
    stack = None if strips is None else on_stack(prepared, strips, strips.first)
    contact = prepared.contact if stack is None else stack
    start = solve_balance(prepared.scene, result.speed, contact, surface.sq)

    def f(scene: Scene) -> float:
        there: RoughContact = contact
        if scene.bodies.hardness != prepared.scene.bodies.hardness:
            hardness = scene.bodies.hardness
            there = prepare(scene, surface).contact if stack is None else replace(stack, hardness=hardness)
        return solve_balance(scene, result.speed, there, surface.sq, start).forces.coefficient

    return f


def _resolved(prepared: Prepared, result: FrictionResult) -> Callable[[Scene], float]:
    """The same by the deterministic model, on one strip and its own cells, or on the patch and the cells of the
    ``result``. Cells twice as long make the change of f by the stress of an oil up to three times as large. Only
    roughness that moves is left on them, for the time that it takes."""
    (surface, factors) = strip_of(prepared, 0)
    moving = moves(prepared.scene)
    if prepared.strips is not None and prepared.strips.whole and result.deterministic is not None and not moving:
        cells = result.deterministic.spacing
        factors = round(cells[0] / surface.spacing[0]), round(cells[1] / surface.spacing[1])
    longer = longer_than(surface, factors, moving)

    def heated(scene: Scene) -> float:
        found = solved(scene, start).result
        return found.coefficient * (1 - strip_heat(scene, found).change)

    def solved(scene: Scene, start: Strip | None, factors=longer if moving else factors) -> Strip:
        if moving:
            return solved_strip(replace(prepared, scene=scene), 0, result.speed, factors=factors, start=start)
        return solve_strip(scene, surface, result.speed, factors=factors, start=start)

    start = solved(prepared.scene, None, longer)
    start = start if moving else solved(prepared.scene, start)
    return heated
