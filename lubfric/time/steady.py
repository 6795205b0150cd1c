"""What a run in time takes from the steady model: its strip of rough surface, its first balance, and the error of f
because the strip is finite. No other module of this package knows how these are found."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..contact import ContactState, Strips, length_or_half
from ..errors import LubfricError
from ..sampling import UncertaintyCurve, moment_error, percent, sampled, student
from ..scene import Constant, Scene
from ..sharing import Balance, Prepared, on_stack, solve_balance
from .scene_now import changes

SPEEDS = 4  # looked at between the fastest and the slowest of a run
SLOWEST = 1e-3  # of the fastest: slower ones are boundary lubrication
AT_REST, LOAD_STEP = 1e-6, 0.05  # m/s; of ln F_H
MANY = 30  # blocks less one: of a strip


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


def steady_balance(strip: Strip, scene: Scene, speed: float) -> Balance:
    """The balance of ``scene`` in steady motion at ``speed`` [m/s], on the contact of the strip."""
    return solve_balance(scene, speed, strip.prepared.contact, strip.prepared.surface.sq)


def friction_error(
    strip: Strip,
    scene: Scene,
    state: ContactState,
    loads: tuple[float, float],
    softness: float,
    parts: tuple[float, float],
) -> float:
    """Relative standard error of f at one moment, because the strip is finite; NaN: not known. ``loads``: of contact
    and film [N]; ``softness``: -d(gap)/d(ln contact load) [m]; ``parts``: boundary and viscous friction [N]."""
    thinning, width = film_thinning(scene, loads[1]), scene.bodies.width
    patch, length = strip.prepared.contact, strip.correlation_length
    return moment_error(patch, state, loads, softness, width, length, parts, thinning)


def film_thinning(scene: Scene, film_load: float) -> float:
    """-d ln h/d ln F_H [-] of Moes' film that carries ``film_load`` [N]. At rest, that of a film that was drawn in
    slowly; 1 without load."""
    if film_load <= 0.0:
        return 1.0
    line, more = scene.line_contact(scene.motion.entrainment_speed or AT_REST), math.exp(LOAD_STEP)
    line = replace(line, load_per_width=film_load / scene.bodies.width)
    heavier = replace(line, load_per_width=more * line.load_per_width)
    return math.log(line.moes_film / heavier.moes_film) / LOAD_STEP


def strip_facts(prepared: Prepared) -> dict[str, float]:
    """Length, width and renewal of a `lubfric.TransientResult` [m]. The renewal is the Hertz strip and a correlation
    length along the motion; NaN if not known."""
    bodies, renewal = prepared.scene.bodies, math.nan
    if prepared.strips is not None and not prepared.strips.whole:
        renewal = 2 * bodies.half_width + math.sqrt(math.pi) * prepared.strips.lengths[0]
    return {"line_length": prepared.surface.size[1], "width": bodies.width, "renewal": renewal}


def worst_in_words(errors: np.ndarray) -> str:
    """The largest of the standard errors of f over time."""
    worst = float(np.max(errors, initial=0.0))
    return "not known" if math.isnan(worst) else f"standard error of f at most {percent(worst)}"


def uncertainty_in_time(
    coefficient: np.ndarray, error: np.ndarray, line_length: float, width: float
) -> UncertaintyCurve:
    """Standard error and 95 % interval of f at every time, from the finite surface alone."""
    unknown = np.full(error.size, math.nan)
    half = student(MANY) * error * np.abs(coefficient)
    return UncertaintyCurve(
        numerical=unknown,
        sampling=error,
        interval=np.stack([coefficient - half, coefficient + half], axis=1),
        line_scatter=error * math.sqrt(line_length / width),
        participation=unknown,
        length=np.full(error.size, line_length),
        area_needed=unknown,
        model_form=unknown,
        text=tuple(f"surface {percent(each)}" for each in error),
    )
