"""What a study will cost, before any of its points is solved."""

from __future__ import annotations

from numbers import Real
from typing import Any

import numpy as np

from ..errors import InputError
from ..scene import Scene
from .adaptive import CHOSEN
from .cost import Ground, by_curve, film_clock, ground_of, in_words, mean_speed, point_seconds
from .journal import Journal
from .span import first_speeds
from .walk import Batch

SAMPLED = 2000  # points at most whose cost is foretold one by one
RECORD = 4000  # bytes of a point on disk
FIELD = 8 * 4  # bytes a cell of the state of a chain under way
LISTED = 4  # values of a key that are named one by one


def explain(plan, store=None) -> str:
    """The points of a `StudyPlan`, what they share, how many of them the folder ``store`` has already, and the
    predicted cost and disk of the rest, in words.

    The maps are made, and one film is solved to time this machine. No point is solved.
    """
    maps = {repr((batch.leader.surface, batch.leader.counterface)): batch.leader for batch in plan.batches}
    about = "" if plan.speeds else "about "
    lines = [f"study of {plan.scene.name}: {about}{plan.points} points"]
    for axis in plan.axes:
        shown = ", ".join(f"{key} {_range(column)}" for key, column in zip(axis.keys, zip(*axis.values)))
        lines.append(f"  {len(axis.values):6d} x {shown}")
    if plan.speeds:
        lines.append(f"  {len(plan.speeds):6d} speeds, {min(plan.speeds):g} to {max(plan.speeds):g} m/s")
        longest = max(len(walk.speeds) for walk in plan.walks)
        started = f"{_count(plan.walks, 'chain')} of up to {longest} speeds, each started from its neighbour"
    else:
        lines.append(f"      about {CHOSEN} speeds that each curve chooses")
        started = "each point started from the nearest of its curve"
    if plan.scene.transient is not None:
        lines.append("  steady   every point; what changes in time in the scene ([transient]) is left out")
    known = {} if store is None else Journal(store).records()
    cells, seconds, failed = _costs(plan, known)
    lines += [
        f"  shared   {_count(maps, 'height map')}, the largest of {cells} cells; "
        f"{_count(plan.batches, 'batch')}, each of one map",
        f"  order    {started}",
        *_kept(plan, known, store),
        f"  time     {_foretold(plan, seconds)}",
        f"  disk     about {_size(plan.points * RECORD)}, and {_size(FIELD * cells)} for each process while it runs",
        *(f"  cannot be solved: {reason}" for reason in failed),
    ]
    return "\n".join(lines)


def _kept(plan, known, store) -> list[str]:
    """How much of the plan the store has, if any."""
    keys = set(plan.keys().flat)
    held = len(keys & known.keys())
    what = "points" if plan.speeds else "curves"
    return [f"  kept     {held} of {len(keys)} {what} are in {store} already"] if held else []


def _foretold(plan, seconds: float) -> str:
    if plan.scene.numerics.model == "deterministic" or plan.scene.numerics.closure == "one-way":
        return "not foretold where the fluid between the asperities is solved for"
    if not seconds:
        return "nothing is left to solve"
    most = len(plan.batches)
    shared = f"; up to {most} processes share it" if most > 1 else ""
    return f"about {in_words(seconds)} on one core (within a factor of 3){shared}"


def _left(batch: Batch, known) -> list[tuple[Scene, tuple[float, ...]]]:
    """Scene and remaining speeds [m/s] of the walks of a batch; no speeds if a walk chooses them."""
    left = [(walk, tuple(u for u, key in zip(walk.speeds, walk.keys) if key not in known)) for walk in batch.walks]
    return [(walk.scene, speeds) for walk, speeds in left if not walk.ended(known)]


def _costs(plan, known: dict[str, Any] | None = None) -> tuple[int, float, list[str]]:
    """(cells of the largest grid, processor seconds, reasons of maps that cannot be made) of what is not ``known``."""
    grounds: dict[str, Ground | None] = {}
    failed: list[str] = []
    walks, seconds = [], 0.0
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
        left = _left(batch, known or {})
        if left and ground is not None:
            seconds += ground.making
            walks += [(scene, ground, speeds) for scene, speeds in left]
    some = walks[:: max(1, sum(len(speeds) for *_, speeds in walks) // SAMPLED)]
    if some:
        seconds += len(walks) / len(some) * _points(some)
    largest = max((int(np.prod(ground.shape)) for ground in grounds.values() if ground is not None), default=0)
    return largest, seconds, failed


def _points(walks: list[tuple[Scene, Ground, tuple[float, ...]]]) -> float:
    """Processor seconds of the points of some walks, at their speeds [m/s]; no speeds if each chooses its own."""
    scene, ground, speeds = walks[len(walks) // 2]
    film = film_clock(scene, mean_speed(speeds or first_speeds(scene, ground.sq)))
    found = 0.0
    for scene, ground, speeds in walks:
        at = speeds or first_speeds(scene, ground.sq)
        found += sum(point_seconds(scene, ground, u, film) for u in at) * (1.0 if speeds else CHOSEN / len(at))
    return found


def _count(things, name: str) -> str:
    plural = "" if len(things) == 1 else "es" if name.endswith("ch") else "s"
    return f"{len(things)} {name}{plural}"


def _range(values: tuple) -> str:
    """The values of a key: all of them if they are few, else the smallest and the largest, or first and last."""
    if len(values) <= LISTED:
        return ", ".join(map(_short, values))
    if all(isinstance(value, Real) for value in values):
        return f"{_short(min(values))} to {_short(max(values))}"
    return f"{_short(values[0])} ... {_short(values[-1])}"


def _short(value) -> str:
    text = f"{value:.4g}" if isinstance(value, float) else str(value)
    return text if len(text) < 50 else text[:47] + "..."


def _size(count: float) -> str:
    for unit, size in (("GB", 1e9), ("MB", 1e6)):
        if count >= size:
            return f"{count / size:.2g} {unit}"
    return f"{max(round(count / 1e3), 1)} kB"
