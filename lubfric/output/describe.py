"""A scene in words: its inputs with their units, regime numbers, and what will be solved."""

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

import numpy as np

from ..contact import MeasuredStrips, Strips, check_grid, contact_map, strips_of
from ..errors import InputError
from ..quantities import counted
from ..sampling import MOST_WORK, forecast
from ..scene import CHANGING, Harmonic, History, Scene, Table, gap_not_resolved, moves, told_doubts
from ..sharing import expected, gathered, lack_in_words, lacking, takes_strips
from ..studies import CHOSEN, in_words, span
from ..surface import Surface, correlation_length, rms_slope
from ..time import TIME_SHARE, speeds_of_run, work_of_run
from .inputs import FACTS, input_rows

STEP_TOLERANCE, SWING, START = 3e-5, 80.0, 30.0  # of a step; with it, steps in a period of a history; at the start
FILM_STEP, CELL_STEP = 6e-3, 1.5e-7  # s of a step in time: its film, and a cell of its contact
SOME, SHOWN = 25, 6  # speeds at which the work is counted, and that stand in the table, about


def describe_scene(scene: Scene, speeds: Sequence[float] | str = ()) -> str:
    """Inputs, regime numbers (Hertz, Moes M and L, lambda at its speeds) and the plan, as text. Nothing is solved.
    ``speeds`` [m/s]: instead of those of the scene; "auto": about those that a curve would choose."""
    with told_doubts(scene):
        strips = strips_of(scene) if takes_strips(scene) else None
        surface = contact_map(scene) if strips is None else strips.stack(strips.first)
        check_grid(scene, surface)
    whole, own = map_of(surface, strips), scene.motion.entrainment_speed
    chosen = np.geomspace(*span(scene, surface.sq), CHOSEN).tolist() if isinstance(speeds, str) else speeds
    speeds = tuple(chosen) or scene.motion.speeds or (own,)
    told, over = [], counted(len(speeds), "speeds")
    if scene.transient is not None:
        speeds, over = tuple(speeds_of_run(scene)) or (0.0,), "a run in time"
        told, own = [*_histories(scene), *_cost(scene, strips, surface, speeds)], max(speeds)
    at = expected(scene, surface, sorted(set(speeds)))  # None: of bodies and map
    known = [entry.text for speed, entry in at if speed is None]
    known += gathered([(speed, (entry,)) for speed, entry in at if speed is not None])
    lacks = [lack_in_words(lack) for lack in lacking(scene, whole.sq, own)]
    left_out = lacks and [f"likely changes of f at {own:g} m/s, by closed forms:", *lacks]
    sections = {name: [*input_rows(scene, name), *FACTS[name](scene)] for name in FACTS} | {
        "transient": told,
        "surface": [*map_in_words(surface, strips), *(n for n in whole.notes if "nm as it is" in n), *_map_rows(whole)],
        "contact": [f"{_plan(scene, surface)}; {over}"],
        "model": _model(scene, strips, surface, speeds),
        "left out": left_out or ["nothing that would change f by its tolerance"],
        "validity": known or ["no assumption of the model fails by what is known before the solve"],
    }
    rows = [f"  {'' if i else name:<14} {text}" for name, texts in sections.items() for i, text in enumerate(texts)]
    return "\n".join([f"scene {scene.name}", *rows, *_speed_rows(scene, strips, surface, speeds)])


def _plan(scene: Scene, surface: Surface) -> str:
    what = {"flat": "a periodic contact", "cylinder": "a semi-periodic contact"}[scene.contact.geometry]
    if scene.numerics.model == "deterministic":
        what = "one gap and one pressure"
    on = "strips of the roughness" if takes_strips(scene) else "{} x {} cells".format(*surface.shape)
    return f"{what} on {on}; f within {100 * scene.numerics.tolerance:g} % by the numerics"


def _model(scene: Scene, strips: Strips | None, surface: Surface, speeds) -> list[str]:
    """Which model will answer at the ``speeds`` [m/s], why, and what all of them cost (`lubfric.sampling.friction`)."""
    asked, why = scene.numerics.model, gap_not_resolved(scene)
    unknown = "its error is not known, and not in the interval"
    if scene.transient is not None and asked == "deterministic":
        return ["one gap and one pressure (the deterministic model) at all times, as asked"]
    if scene.transient is not None:
        more = "; it does not see that the roughness moves, as numerics.model = 'deterministic' does" * moves(scene)
        return [f"load sharing, Eq. (8), at all times; {unknown}{more}"]
    moving = sorted({abs(u) for u in speeds if u != 0})
    some = moving[:: max(1, len(moving) // 25)]
    found = [forecast(scene, strips, surface, speed) for speed in some]
    resolved = [one.speed for one in found if one.resolved]
    if asked == "deterministic":
        rows = ["one gap and one pressure (the deterministic model), as asked"]
    elif asked == "load-sharing":
        rows = [f"load sharing, Eq. (8), as asked: the fast way; {unknown if why else 'its interval is wide'}"]
    elif why:
        rows = [f"load sharing, Eq. (8), alone; {unknown}:", f"  {why}"]
    elif not resolved and max((one.moving for one in found), default=0.0) > MOST_WORK:
        rows = ["load sharing, Eq. (8), alone; its interval is wide: the other model would take too long"]
    elif not resolved:
        rows = ["load sharing, Eq. (8), alone: the film is thick, or there is no roughness, and the models agree"]
    else:
        ends = dict.fromkeys(f"{speed:.3g}" for speed in (resolved[0], resolved[-1]))
        rows = [
            f"load sharing, Eq. (8), on strips of the roughness; at {' to '.join(ends)} m/s",
            f"  corrected by strips with one gap and one pressure to {100 * scene.numerics.model_tolerance:g} % of f",
            "  (not where heat takes more than a fifth of f, or three tenths of the film)",
        ]
    if strip := max((one.moving for one in found), default=0.0):
        unseen = ", which Eq. (8) does not see" * (asked == "load-sharing")
        beyond = f"; beyond {MOST_WORK:g} s Eq. (8) answers alone, unless numerics.model = 'deterministic'"
        takes = f"one strip with one gap and one pressure takes about {in_words(strip)}"
        rows.append(f"the roughness moves{unseen}: {takes}{beyond * (asked == 'auto')}")
    if found:
        seconds = in_words(sum(one.seconds for one in found) * len(moving) / len(some))
        count = counted(len(moving), "speeds")
        rows.append(f"cost: about {seconds} of processor time for {count} (an order of magnitude)")
    return rows


def _histories(scene: Scene) -> list[str]:
    """What changes in time, how, how often, and between which values; and the largest speeds."""
    plan, rows = scene.transient, []
    assert plan is not None
    for name, unit in CHANGING.items():
        history = getattr(plan, name)
        if history is not None:
            low, high = history.range(plan.duration)
            laps = _laps(history, plan.duration)
            reverses = ": the motion reverses" if name == "speed" and low < 0 < high else ""
            said = f"{name}: {type(history).__name__.lower()}, {low:.4g} to {high:.4g} {unit}"
            rows.append(f"{said}{f', {laps:.3g} periods' if laps else ''}{reverses}")
    start = "steady, where there is entrainment, else at rest" if plan.initial == "auto" else plan.initial
    return [*rows, f"start: {start if plan.initial_film is None else f'film of {plan.initial_film:.4g} m'}"]


def _laps(history: History, duration: float) -> float:
    """How often a history repeats itself; 0 for one that does not."""
    if isinstance(history, Harmonic):
        return history.frequency * duration
    return duration / history.times[-1] if isinstance(history, Table) and history.repeat else 0.0


def _cost(scene: Scene, strips: Strips | None, surface: Surface, speeds) -> list[str]:
    """Steps, time and sample of a run, whose film is judged at the ``speeds`` [m/s]; by what runs of the paper's scene
    took (8 to 17 ms a step on 200 x 200 cells)."""
    assert (plan := scene.transient) is not None
    found, cells, sample = [forecast(scene, strips, surface, speed) for speed in speeds], surface.heights.size, []
    if strips is not None and scene.numerics.model != "deterministic":
        most = max(found, key=lambda one: one.strips)
        cells = round(strips.cells.count * most.length / strips.cells.coarse[1])
        asked = f"f within {100 * scene.numerics.sampling_tolerance:g} % at {most.speed:.3g} m/s, which needs most"
        sample = [f"sample: {counted(most.strips, 'strips')} of the roughness, at all times: for {asked}"]
    if scene.numerics.model == "deterministic":
        steps, seconds = work_of_run(scene)
    else:
        tolerance = plan.tolerance or TIME_SHARE * scene.numerics.tolerance_of("film")
        swings = max((_laps(h, plan.duration) or 1.0 for h in plan.histories), default=0.5)
        steps = max(plan.outputs, SWING * swings * (STEP_TOLERANCE / tolerance) ** (1 / 3)) + START
        seconds = sum(one.seconds for one in found) + steps * (FILM_STEP + CELL_STEP * cells)
    top = f"top speed {max(speeds):.4g} m/s" if max(speeds) else "no entrainment"
    course = f"{plan.duration:.4g} s in about {steps:.2g} steps, {counted(plan.outputs, 'outputs')}"
    return [f"{top}; {course}; about {in_words(seconds)} (orders of magnitude)", *sample]


def _speed_rows(scene: Scene, strips: Strips | None, surface: Surface, speeds) -> list[str]:
    """At some of the ``speeds`` [m/s]: Moes numbers and the expected film under the whole load, whether the summits
    touch, and, unless a run in time has one sample for all, what the sample costs."""
    steady = scene.transient is None
    sampled = steady and strips is not None
    head = f"  {'U (m/s)':<12} {'M':>9} {'L':>8} {'h (nm)':>10} {'lambda':>8}  {'summits':<22}"
    head += f" {'strips':>8} {'one gap':>8} {'length (mm)':>12} {'time (s)':>9}" * sampled
    rows = ["  film of the whole load by closed forms, and whether it clears the summits (orders of magnitude)", head]
    own = (scene.motion.entrainment_speed,) if steady else ()
    for speed in sorted({*speeds[:: max(1, len(speeds) // SHOWN)], *own, speeds[-1]}):
        one, film = forecast(scene, strips, surface, speed), f"{'no entrainment' + ': all contact' * steady:<38}"
        if speed != 0:
            line = scene.line_contact(abs(speed))
            ratio = line.expected_film / surface.sq if surface.sq > 0 else math.inf
            film = f"{line.M:9.3g} {line.L:8.3g} {line.expected_film * 1e9:10.4g} {ratio:8.3g}"
        row = f"  {speed:<12.4g} {film}  {one.touching:<22}"
        row += f" {one.strips:>8} {one.resolved:>8} {1e3 * one.length:>12.2g} {one.seconds:>9.1g}" * sampled
        rows.append(row)
    return rows


def map_of(surface: Surface, strips: Strips | None) -> Surface:
    """The map that the scene has: measured, the whole of it; else ``surface``, which is solved first."""
    return strips.surface if isinstance(strips, MeasuredStrips) else surface


def map_in_words(surface: Surface, strips: Strips | None) -> list[str]:
    """The map that the scene has; and where ``strips`` of it are solved, ``surface``, the first of them."""
    if strips is None or strips.whole:
        return [surface.describe()]
    made = "" if strips.windows else f"{surface.source}: as many strips as are needed"
    first = replace(surface, source="").describe()
    joined = f"{counted(strips.first, 'strips')} of it, joined along the line" if strips.first > 1 else "a strip of it"
    return [made or map_of(surface, strips).describe(), f"solved first: {joined}: {first}"]


def _map_rows(surface: Surface) -> list[str]:
    """Slopes and correlation lengths of the map, on its own grid."""
    along_x, along_y, total = rms_slope(surface)
    lengths = []
    for axis, step in enumerate(surface.spacing):
        with suppress(InputError):  # flat, one cell, or too short
            length = correlation_length(surface, axis)
            lengths.append(f"{length * 1e6:.3g} µm = {length / step:.3g} cells along {'xy'[axis]}")
    slopes = f"rms slope {total:.3g} ({along_x:.3g} along x, {along_y:.3g} along y)"
    return [f"{slopes}; correlation length (to 1/e) {' and '.join(lengths) or 'not known'}"]
