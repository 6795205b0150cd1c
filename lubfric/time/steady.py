"""The strip of rough surface of a run in time, from the needs of steady friction, and the softness of its film."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..contact import Strips, length_or_half
from ..errors import LubfricError
from ..sampling import sampled
from ..scene import Constant, Scene
from ..sharing import Prepared, on_stack
from .scene_now import changes

SPEEDS = 4  # looked at between the fastest and the slowest of a run
SLOWEST = 1e-3  # of the fastest: slower ones are boundary lubrication
AT_REST, LOAD_STEP = 1e-6, 0.05  # m/s; of ln F_H


@dataclass(frozen=True)
class Strip:
    """The rough surface of a run, as ``prepared``.

    ``correlation_length``: of its heights along y [m]; ``area``, ``plastic``: factors by which contact area and plastic
    area on its cells are those on the scene's own (NaN: not known).
    """

    prepared: Prepared
    correlation_length: float
    area: float = 1.0
    plastic: float = 1.0


def strip_for(prepared: Prepared) -> Strip:
    """Strips as many as `lubfric.friction` needs for ``numerics.sampling_tolerance`` at the worst of four speeds of the
    run, or as memory and map allow. Their cells change f by no more than ``numerics.tolerance`` at any of these speeds,
    or are the scene's own: a run in time is not corrected for them. The factors of areas are means over the speeds.
    """
    strips, speeds = prepared.strips, _speeds(prepared)
    if strips is None:
        return Strip(prepared, length_or_half(prepared.surface, 1))
    if strips.whole:
        while not strips.cells.own:
            strips = strips.halved()
        return Strip(_made(prepared, strips, 1), strips.lengths[1])
    if not speeds:
        known = 1.0 if strips.cells.own else math.nan
        return Strip(prepared, strips.lengths[1], known, known)
    needs = _needs(prepared, strips, speeds)
    while not strips.cells.own and max(needs[1]) > prepared.scene.numerics.tolerance:
        strips = strips.halved()
        needs = _needs(prepared, strips, speeds)
    made = _made(prepared, strips, min(int(max(needs[0])), strips.available))
    return Strip(made, strips.lengths[1], _mean(needs[2]), _mean(needs[3]))


def _made(prepared: Prepared, strips: Strips, count: int) -> Prepared:
    contact = on_stack(prepared, strips, count)
    surface = replace(prepared.surface, heights=contact.heights, spacing=contact.spacing, mask=None)
    return replace(prepared, surface=surface, contact=contact, strips=strips)


def _speeds(prepared: Prepared) -> list[float]:
    """Speeds [m/s] at which the strip is judged; none where nothing is entrained."""
    plan = changes(prepared.scene)
    low, high = (plan.speed or Constant(prepared.scene.motion.entrainment_speed)).range(plan.duration)
    fastest = max(abs(low), abs(high))
    if fastest == 0.0:
        return []
    slowest = max(min(abs(low), abs(high)) if low * high > 0 else 0.0, SLOWEST * fastest)
    return np.unique(np.geomspace(fastest, slowest, SPEEDS)).tolist() if slowest < fastest else [fastest]


def _needs(prepared: Prepared, strips: Strips, speeds: list[float]) -> np.ndarray:
    """What each steady speed needs, in rows: the number of strips, the relative change of f by their cells (infinite if
    finer ones were needed), and the factors of `Strip`. A speed without a steady solution needs the first strips."""
    found = []
    for speed in speeds:
        try:
            one = sampled(replace(prepared, strips=strips), speed)
        except LubfricError:
            found.append((strips.first, 0.0, math.nan, math.nan))
            continue
        assert one.strips is not None
        plastic, corrected = one.solved.contact.plastic_area_fraction, one.balance.contact.plastic_area_fraction
        area = one.effect.area if one.response is not None else math.nan
        same = one.strips.cells.factors == strips.cells.factors
        by_cells = one.change("gap") if same else math.inf
        found.append((one.count, by_cells, area, corrected / plastic if plastic else math.nan))
    return np.array(found, dtype=float).T


def _mean(factors: np.ndarray) -> float:
    known = factors[np.isfinite(factors)]
    return float(known.mean()) if known.size else math.nan


def film_thinning(scene: Scene, film_load: float) -> float:
    """-d ln h/d ln F_H [-] of Moes' film that carries ``film_load`` [N]. At rest, that of a film that was drawn in
    slowly; 1 without load."""
    if film_load <= 0.0:
        return 1.0
    line, more = scene.line_contact(scene.motion.entrainment_speed or AT_REST), math.exp(LOAD_STEP)
    line = replace(line, load_per_width=film_load / scene.bodies.width)
    heavier = replace(line, load_per_width=more * line.load_per_width)
    return math.log(line.moes_film / heavier.moes_film) / LOAD_STEP
