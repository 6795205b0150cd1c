"""What a run in time takes from the steady model: its strip of rough surface, its first balance, and the error of f
because the strip is finite. No other module of this package knows how these are found."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..contact import ContactState
from ..errors import LubfricError
from ..sampling import (
    UncertaintyCurve,
    correlation_along_y,
    friction,
    line_friction,
    lines_of_model,
    mean_of,
    moment_error,
    of_line,
    percent,
    student,
)
from ..scene import Constant, Scene
from ..sharing import MOST_CELLS, Prepared, line_contact, on_halved_cells
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
    """A strip as long as `lubfric.friction` needs for ``numerics.sampling_tolerance`` at the worst of four speeds of
    the run, or as memory and map allow. Its cells change f by no more than ``numerics.tolerance`` at any of these
    speeds, or are the scene's own: a run in time is not corrected for them.

    ``prepared`` itself if it is on one patch, or long enough. The factors of areas are means over the speeds.
    """
    lines, speeds = prepared.lines, _speeds(prepared)
    if lines is None:
        return Strip(prepared, correlation_along_y(prepared))
    if not speeds:
        known = 1.0 if lines.cells.factors == (1, 1) else math.nan
        return Strip(prepared, correlation_along_y(prepared), known, known)
    lengths, by_cells, area, plastic = _needs(prepared, speeds)
    while lines.cells.factors != (1, 1) and max(by_cells) > prepared.scene.numerics.tolerance:
        prepared = on_halved_cells(prepared)
        lines = lines_of_model(prepared)
        lengths, by_cells, area, plastic = _needs(prepared, speeds)
    if max(lengths) > prepared.surface.size[1] * 1.05:
        held = MOST_CELLS / lines.cells.count * lines.cells.coarse[1]
        surface = lines.line(0, min(max(lengths), held, lines.available))
        prepared = replace(prepared, surface=surface, contact=line_contact(prepared.scene, surface))
    return Strip(prepared, correlation_along_y(prepared), _mean(area), _mean(plastic))


def _speeds(prepared: Prepared) -> list[float]:
    """Speeds [m/s] at which the strip is judged; none where nothing is entrained."""
    plan = changes(prepared.scene)
    low, high = (plan.speed or Constant(prepared.scene.motion.entrainment_speed)).range(plan.duration)
    fastest = max(abs(low), abs(high))
    if fastest == 0.0:
        return []
    slowest = max(min(abs(low), abs(high)) if low * high > 0 else 0.0, SLOWEST * fastest)
    return np.unique(np.geomspace(fastest, slowest, SPEEDS)).tolist() if slowest < fastest else [fastest]


def _needs(prepared: Prepared, speeds: list[float]) -> np.ndarray:
    """What each steady speed needs, in rows: the length [m] of the strip, the relative change of f by its cells, and
    the factors of `Strip`. A speed without a steady solution needs nothing."""
    own, found = lines_of_model(prepared).cells.factors, []
    for speed in speeds:
        try:
            chosen, line = line_friction(prepared, speed)
        except LubfricError:
            found.append((0.0, 0.0, math.nan, math.nan))
            continue
        factors = 1.0, 1.0
        if own != (1, 1):
            plastic, corrected = line.together.plastic_fraction, line.point.balance.contact.plastic_area_fraction
            factors = mean_of(line.grid, "area", math.nan), corrected / plastic if plastic else math.nan
        by_cells = line.by_cells if line.cells.factors == own else math.inf
        found.append((of_line(chosen.scene, line)[0].length, by_cells, *factors))
    return np.array(found).T


def _mean(factors: np.ndarray) -> float:
    known = factors[np.isfinite(factors)]
    return float(known.mean()) if known.size else math.nan


def steady_balance(prepared: Prepared, speed: float) -> tuple[float, float, ContactState | None, float]:
    """Loads of film and contact [N] in steady motion, the state of the contact (None: it does not touch), and the mean
    gap [m]."""
    point = friction(prepared, speed, fields=True)
    touching = point.balance.contact if point.balance is not None and point.contact_load > 0.0 else None
    return point.film_load, point.contact_load, touching, point.mean_gap


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
    if prepared.lines is not None:
        renewal = 2 * bodies.half_width + math.sqrt(math.pi) * prepared.lines.lengths[0]
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
