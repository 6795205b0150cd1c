"""What a study will cost, before any of its points is solved."""

from __future__ import annotations

import numpy as np

from ..curve.span import first_speeds
from ..errors import InputError
from ..scene import Scene
from .adaptive import CHOSEN
from .cost import Ground, by_curve, film_clock, ground_of, in_words, mean_speed, point_seconds

SAMPLED = 2000  # points at most whose cost is foretold one by one
RECORD = 4000  # bytes of a point on disk
FIELD = 8 * 4  # bytes a cell of the state of a chain under way


def explain(plan) -> str:
    """The points of a `StudyPlan`, what they share, and their predicted cost and disk, in words.

    The maps are made, and one film is solved as a clock of this machine. No point is solved.
    """
    maps = {repr((batch.leader.surface, batch.leader.counterface)): batch.leader for batch in plan.batches}
    about = "" if plan.speeds else "about "
    lines = [f"study of {plan.scene.name}: {about}{plan.points} points"]
    for axis in plan.axes:
        first, last = axis.values[0], axis.values[-1]
        shown = ", ".join(f"{key} from {_short(a)} to {_short(b)}" for key, a, b in zip(axis.keys, first, last))
        lines.append(f"  {len(axis.values):6d} x {shown}")
    if plan.speeds:
        lines.append(f"  {len(plan.speeds):6d} speeds, {min(plan.speeds):g} to {max(plan.speeds):g} m/s")
        longest = max(len(walk.speeds) for walk in plan.walks)
        started = f"{len(plan.walks)} warm-started chains of at most {longest} points"
    else:
        lines.append(f"      about {CHOSEN} speeds that each curve chooses")
        started = "each point started from the nearest of its curve"
    cells, seconds, failed = _costs(plan)
    lines += [
        f"  shared         {_count(maps, 'height map')} ({cells} cells the largest grid), "
        f"{_count(plan.batches, 'batch')}, each of one map and operator, {started}",
        f"  time           {_foretold(plan, seconds)}",
        f"  disk           about {_size(plan.points * RECORD)}, and {_size(FIELD * cells)} for each process "
        "while it runs",
        *(f"  cannot be solved: {reason}" for reason in failed),
    ]
    return "\n".join(lines)


def _foretold(plan, seconds: float) -> str:
    if plan.scene.numerics.model == "deterministic" or plan.scene.numerics.closure == "one-way":
        return "not foretold where the fluid between the asperities is solved for"
    most = len(plan.batches)
    shared = f", divided by the number of processes up to {most}" if most > 1 else ", in one process: it is one batch"
    return f"about {in_words(seconds)} on one core (within a factor of 3){shared}"


def _costs(plan) -> tuple[int, float, list[str]]:
    """(cells of the largest grid, processor seconds, reasons of maps that cannot be made)."""
    grounds: dict[str, Ground | None] = {}
    failed: list[str] = []
    curves, seconds = [], 0.0
    for batch in plan.batches:
        leader = batch.leader
        name = repr((leader.surface, leader.counterface, leader.contact, leader.numerics, leader.bodies))
        if name not in grounds:
            try:
                grounds[name] = ground_of(leader, by_curve(leader))
            except InputError as error:
                grounds[name] = None
                failed.append(str(error))
        ground = grounds[name]
        if ground is not None:
            seconds += ground.making
            curves += [(scene, ground) for scene in {walk.index: walk.scene for walk in batch.walks}.values()]
    some = curves[:: max(1, len(curves) * len(plan.speeds) // SAMPLED)]
    if some:
        seconds += len(curves) / len(some) * _points(some, plan.speeds)
    largest = max((int(np.prod(ground.shape)) for ground in grounds.values() if ground is not None), default=0)
    return largest, seconds, failed


def _points(curves: list[tuple[Scene, Ground]], speeds: tuple[float, ...]) -> float:
    """Processor seconds of the points of some curves. ``speeds`` [m/s] is empty where each curve chooses its own."""
    scene, ground = curves[len(curves) // 2]
    film = film_clock(scene, mean_speed(speeds or first_speeds(scene, ground.sq)))
    found = 0.0
    for scene, ground in curves:
        at = speeds or first_speeds(scene, ground.sq)
        found += sum(point_seconds(scene, ground, u, film) for u in at) * (1.0 if speeds else CHOSEN / len(at))
    return found


def _count(things, name: str) -> str:
    plural = "" if len(things) == 1 else "es" if name.endswith("ch") else "s"
    return f"{len(things)} {name}{plural}"


def _short(value) -> str:
    text = f"{value:.4g}" if isinstance(value, float) else str(value)
    return text if len(text) < 50 else text[:47] + "..."


def _size(count: float) -> str:
    for unit, size in (("GB", 1e9), ("MB", 1e6)):
        if count >= size:
            return f"{count / size:.2g} {unit}"
    return f"{count / 1e3:.2g} kB"
