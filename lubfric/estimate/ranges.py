"""Inputs that are known to a range only: what both ends of each change of f, in its interval."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

from .._base.jobs import map_parts
from ..contact import RoughContact
from ..errors import ConvergenceError
from ..models.deterministic import (
    HARDNESS,
    DeterministicResult,
    MovingStrip,
    Strip,
    bodies_of,
    continued_strip,
    solve_strip,
    strip_heat,
    strip_of,
)
from ..models.load_sharing import solve_balance
from ..models.shared import (
    Prepared,
    contact_on,
    on_stack,
    prepare,
)
from ..scene import FRICTION, Scene, value_of
from .result import FrictionResult
from .uncertainty import Uncertainty

LEAST = 5e-4  # of f: a smaller change is not told


def with_ranges(prepared: Prepared, result: FrictionResult, strip: Strip | None = None) -> FrictionResult:
    """Return ``result`` with the `Scene.ranges` of its inputs in its interval.

    f is linear in f_b at a given division of the load. At both ends of every other range it is solved again, by the
    model of the result: load sharing on the first strips, or the deterministic model on one of them. The changes are
    relative to the middle on the same cells. Those of several inputs add up as squares, up and down for
    themselves. An end that cannot be solved, and the hardness of a contact that is not lubfric's own, leave ``inputs``
    NaN, and a note.

    ``strip``: a strip of the deterministic model at the middle of all ranges, on the cells on which the ends are solved
    (None: the result is by load sharing). A hardness at both ends above every pressure of that strip changes nothing,
    and is not solved.
    """
    scene = prepared.scene
    if not scene.ranges:
        return result
    changes: dict[str, tuple[float, ...] | str] = {}
    solved: dict[str, list[Scene]] = {}
    for name, *ends in scene.at_ends():
        if name == FRICTION:
            slope = result.contact_load / scene.bodies.load * (scene.motion.slide_roll_ratio != 0)
            changes[name] = tuple(slope * (value_of(end, name) - value_of(scene, name)) for end in ends)
        elif name == HARDNESS and not prepared.own:
            changes[name] = "the contact is not lubfric's own"
        elif name == HARDNESS and strip is not None and _stays_elastic(strip, scene, *ends):
            changes[name] = (0.0, 0.0)
        else:
            changes[name] = "an end was not solved"  # unless it is
            solved[name] = ends
    for name, relative in _changes_at(prepared, result, strip, solved).items():
        if all(map(math.isfinite, relative)):
            changes[name] = tuple(result.coefficient * change for change in relative)
    old = result.uncertainty
    known = widened(old, result.coefficient, changes)
    notes = tuple(known.text if note == old.text else note for note in result.report.notes)
    return replace(result, uncertainty=known, report=replace(result.report, notes=notes))


def _stays_elastic(strip: Strip, *scenes: Scene) -> bool:
    """Return whether the solution of ``strip`` reaches the hardness of none of ``scenes`` in any cell, at any moment."""
    return all(strip.peak_pressure < value_of(scene, HARDNESS) for scene in scenes)


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
        largest_input=max(moved, key=lambda name: max(map(abs, moved[name])), default=""),
    )


def _changes_at(
    prepared: Prepared, result: FrictionResult, strip: Strip | None, ends: dict[str, list[Scene]]
) -> dict[str, list[float]]:
    """Return the relative change of f from the middle to the ``ends`` of each input, by the model of the ``result``; NaN
    where an end is not solved."""
    scenes = [scene for both in ends.values() for scene in both]
    if not scenes:
        return {}
    try:
        if strip is None:
            coefficient = _load_sharing(prepared, result)
            middle = coefficient(prepared.scene)
            values = [_or_nan(coefficient, scene) for scene in scenes]
        else:
            middle = _unchanged(prepared, strip)
            at_end = partial(_at_end, prepared, strip, result.speed)
            values = map_parts(_or_nan, scenes, at_end)
    except ConvergenceError:  # the middle, on other cells than the point itself
        middle = math.nan
        values = [math.nan] * len(scenes)
    changes = iter(value / middle - 1 for value in values)
    return {name: [next(changes) for _ in both] for name, both in ends.items()}


def _or_nan(coefficient: Callable[[Scene], float], scene: Scene) -> float:
    """Return f of ``scene``; NaN where it is not solved."""
    try:
        return coefficient(scene)
    except ConvergenceError:
        return math.nan


def _load_sharing(prepared: Prepared, result: FrictionResult) -> Callable[[Scene], float]:
    """Return f of scenes that differ from the prepared one in inputs only, by load sharing on the first strips of
    ``prepared``, or on its only contact."""
    sample = prepared.sample
    surface = prepared.surface
    contact = contact_on(prepared, sample, sample.first)
    start = solve_balance(prepared.scene, result.speed, contact, surface.sq)

    def f(scene: Scene) -> float:
        there: RoughContact = contact
        if scene.bodies.hardness != prepared.scene.bodies.hardness:
            hardness = scene.bodies.hardness
            if sample.is_resolved:
                there = replace(on_stack(prepared, sample, sample.first), hardness=hardness)
            else:
                there = prepare(scene, surface).contact
        return solve_balance(scene, result.speed, there, surface.sq, start).forces.coefficient

    return f


def _unchanged(prepared: Prepared, strip: Strip) -> float:
    """Return f of ``strip`` as the ends of ranges are compared with it (`_at_end`)."""
    result = strip.result
    if isinstance(strip, MovingStrip):
        assert strip.early is not None
        result = strip.early
    return _with_heat(prepared.scene, result)


def _at_end(prepared: Prepared, strip: Strip, speed: float, scene: Scene) -> float:
    """Return f at ``speed`` [m/s] of a ``scene`` that differs from the prepared one in inputs only, by the deterministic
    model on the cells of ``strip``, which is solved at the prepared one and from which it begins.

    These are the cells of the answer, because the change of f by the stress of an oil is up to three times as large on
    cells twice as long. Where the roughness moves, it is a continuation of the strip (`continued_strip`), to be compared
    with the same moments of the strip itself.
    """
    if isinstance(strip, MovingStrip):
        result, _ = continued_strip(scene, bodies_of(prepared, 0, speed), speed, strip)
        return _with_heat(scene, result)
    surface, _ = strip_of(prepared, 0)
    spacing = strip.problem.spacing
    factors = (round(spacing[0] / surface.spacing[0]), round(spacing[1] / surface.spacing[1]))
    return _with_heat(scene, solve_strip(scene, surface, speed, factors=factors, start=strip).result)


def _with_heat(scene: Scene, result: DeterministicResult) -> float:
    """Return f of ``result`` with the share that the temperatures of film and surfaces take away."""
    return result.coefficient * (1 - strip_heat(scene, result).change)
