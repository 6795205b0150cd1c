"""What a study or a fit will take, before a point is solved: its points, and the time of one by the work counted on the
scene."""

from __future__ import annotations

import time
from collections.abc import Sequence
from numbers import Real
from textwrap import shorten

import numpy as np

from ..errors import InputError
from ..sharing import Prepared, prepare, takes_strips
from .choose import CHOSEN, film_ratio, first_speeds
from .points import stored_rows
from .store import Store

FILM, HOT = 0.012, 5.0  # processor seconds of the films of a point, about; how many times as many with heat
CELL, FLAT = 8e-6, 1e-7  # processor seconds of a cell of a point in contact, about; of a flat one
FINE = 6  # cells along a correlation length on which a contact is solved, about
SCARCE, LIFTED = 2.0, 6.0  # Moes' film of the whole load over Sq between which few summits touch; beyond it hardly any
MORE = 3.0  # times more work on strips where few summits touch: more of them are needed
SAMPLED = 8  # scenes of a study that are made ready to count their cells
LISTED = 4  # values of a key that are named one by one


def curve_seconds(prepared: Prepared, speeds: Sequence[float]) -> float:
    """Processor seconds of the points of a scene at ``speeds`` [m/s] (none: at those that it chooses), within a factor
    of about 4: by the films, and by the cells of the contacts where summits touch."""
    scene, surface = prepared.scene, prepared.surface
    at = speeds or first_speeds(scene, surface.sq)
    cells, given = float(surface.heights.size), scene.surface.correlation_length
    if given is not None:  # a contact is solved on fewer cells than the map has
        for step, length in zip(surface.spacing, np.broadcast_to(given, 2)):
            cells *= min(1.0, FINE * step / length)
    seconds = FILM * len(at) * (HOT if scene.lubricant.heats and scene.numerics.heat != "off" else 1.0)
    for speed in at if surface.sq > 0 else ():
        ratio = film_ratio(scene, surface.sq, abs(speed)) if speed else 0.0
        if ratio < LIFTED:
            more = MORE if ratio > SCARCE and takes_strips(scene) else 1.0
            seconds += (FLAT if scene.contact.geometry == "flat" else CELL) * cells * more
    return seconds if speeds else seconds * CHOSEN / len(at)


def in_words(seconds: float) -> str:
    """A time in a suitable unit."""
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds > 2 * size:
            return f"{float(f'{seconds / size:.2g}'):g} {unit}"
    return f"{float(f'{seconds:.2g}'):g} s"


def explain(plan, store=None) -> str:
    """The points of a `StudyPlan`, how many of them the folder ``store`` has already, and about how long the rest will
    take, in words. Some of the maps are made. No point is solved."""
    lines = [f"study of {plan.scene.name}: {'' if plan.speeds else 'about '}{plan.points} points"]
    for axis in plan.axes:
        shown = ", ".join(f"{key} {_range(column)}" for key, column in zip(axis.keys, zip(*axis.values)))
        lines.append(f"  {len(axis.values):6d} x {shown}")
    if plan.speeds:
        lines.append(f"  {len(plan.speeds):6d} speeds, {min(plan.speeds):g} to {max(plan.speeds):g} m/s")
    else:
        lines.append(f"      about {CHOSEN} speeds that each curve chooses")
    if plan.scene.transient is not None:
        lines.append("  steady   every point; what changes in time in the scene ([transient]) is left out")
    rows, ended = stored_rows(Store(store), plan.keys, plan.speeds)
    left = [
        (scene, tuple(u for u in plan.speeds if u not in rows[key]))
        for key, scene in dict(zip(plan.keys, plan.scenes)).items()
        if key not in ended and not (plan.speeds and len(rows[key]) == len(plan.speeds))
    ]
    held = sum(map(len, rows.values())) if plan.speeds else len(ended)
    if held:
        total, what = len(rows) * max(len(plan.speeds), 1), "points" if plan.speeds else "curves"
        lines.append(f"  kept     {held} of {total} {what} are in {store} already")
    if not left:
        return "\n".join([*lines, "  time     nothing is left to solve"])
    some = left[:: -(-len(left) // SAMPLED)]
    seconds, failed = 0.0, []
    for scene, speeds in some:
        try:
            begun = time.process_time()  # of the map, which takes its time as well
            counted = curve_seconds(prepare(scene), speeds) + time.process_time() - begun
            seconds += counted * len(left) / len(some)
        except InputError as error:
            failed.append(f"  cannot be solved: {error}")
    lines.append(f"  time     about {in_words(seconds)} on one core (within a factor of about 4)")
    return "\n".join([*lines, *dict.fromkeys(failed)])


def _range(values: tuple) -> str:
    """The values of a key: all of them if they are few, else the smallest and the largest, or first and last."""
    if len(values) > LISTED:
        ends = (min(values), max(values)) if all(isinstance(v, Real) for v in values) else (values[0], values[-1])
        return " to ".join(_range((end,)) for end in ends)
    words = (f"{value:.4g}" if isinstance(value, float) else str(value) for value in values)
    return ", ".join(shorten(text, 50, placeholder="...") for text in words)
