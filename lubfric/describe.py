"""What a scene is, in words: regime numbers and what will be solved."""

from __future__ import annotations

import math

from .errors import InputError
from .inputs import input_lines
from .lines.make import lines_of, takes_line
from .lines.outlook import in_words
from .plausible import told_doubts
from .point.outlook import outlook
from .rough.height_map import contact_map
from .scene import Scene
from .surface import correlation_length, rms_slope
from .validity.entry import gathered
from .validity.foretold import foretold

SOLVE_FIELDS = 17  # arrays of 8-byte numbers, one a cell, at the peak of a contact solve (traced: 10 to 16.4)


def describe_scene(scene: Scene) -> str:
    """Regime numbers (Hertz, Moes M and L, lambda at the scene's speeds) and the plan, as text."""
    with told_doubts(scene):
        surface = contact_map(scene)
    nx, ny = surface.heights.shape
    lines = [
        f"scene {scene.name}",
        *input_lines(scene),
        f"  surface        {surface.describe()}",
        *_map_lines(scene, surface),
        "  speed U (m/s)      M        L     h (um)  lambda   (Moes film at full load)",
    ]
    speeds = scene.motion.speeds or (scene.motion.entrainment_speed,)
    for speed in sorted({speeds[0], scene.motion.entrainment_speed, speeds[-1]}):
        if speed == 0:
            lines.append("  0              no entrainment: all contact")
            continue
        line = scene.line_contact(abs(speed))
        h = line.moes_film
        ratio = h / surface.sq if surface.sq > 0 else math.inf
        lines.append(f"  {speed:<12.4g} {line.M:9.3g} {line.L:8.3g} {h * 1e6:12.4f} {ratio:8.3g}")
    if scene.numerics.model == "deterministic":
        plan = "one gap and one pressure, on grids of the map halved and doubled"
    elif scene.contact.geometry == "flat":
        plan = f"periodic contact curve on {nx} x {ny} cells, once, then read at every speed"
    elif takes_line(scene):
        plan = "semi-periodic contact on a line of the roughness (below) under the film at every speed"
    else:
        plan = f"semi-periodic contact on {nx} x {ny} cells under the film at every speed"
    lines += [
        f"  contact        {plan}, or fewer: the coarsest grid and shortest patch for f within "
        f"{100 * scene.numerics.tolerance:g} %; {len(speeds)} speeds"
    ]
    if scene.numerics.model == "deterministic":
        return "\n".join(lines)
    lines += [
        f"  U = {speed:<10.4g} {outlook(scene, surface, speed)}"
        for speed in sorted({speeds[0], scene.motion.entrainment_speed, speeds[-1]})
    ]
    told = foretold(scene, surface, sorted(set(speeds)))
    lines += [f"  {entry.text}" for speed, entry in told if speed is None]
    lines += [f"  {text}" for text in gathered([(speed, (entry,)) for speed, entry in told if speed is not None])]
    lines += [f"  {note}" for note in _no_doubts(told)]
    return "\n".join([*lines, *_sampling_lines(scene, surface.sq)])


def _sampling_lines(scene: Scene, sq: float) -> list[str]:
    """Length of the line and its cost at the speeds of the scene."""
    if not takes_line(scene):
        return []
    found, speeds = lines_of(scene), scene.motion.speeds or (scene.motion.entrainment_speed,)
    return [
        f"  U = {speed:<10.4g} {in_words(scene, found, sq, speed)}"
        for speed in sorted({speeds[0], scene.motion.entrainment_speed, *speeds[:: max(1, len(speeds) // 6)]})
    ]


def _no_doubts(told) -> list[str]:
    return [] if told else ["validity       nothing that could be told before the solve"]


def _map_lines(scene: Scene, surface) -> list[str]:
    """Statistics of the map on its own grid, how well that grid resolves them, and what a contact solve on it holds."""
    (nx, ny), (dx, dy), b = surface.shape, surface.spacing, scene.bodies.half_width
    slopes = rms_slope(surface)
    lengths = [_correlation_length(surface, axis) for axis in range(2)]
    in_um = " x ".join("-" if c is None else f"{c * 1e6:.3g}" for c in lengths)
    in_cells = " x ".join("-" if c is None else f"{c / step:.3g}" for c, step in zip(lengths, (dx, dy)))
    rows = [
        (
            "Sq",
            f"{surface.sq * 1e9:.4g} nm",
            "rms slope",
            f"{slopes[2]:.3g}  ({slopes[0]:.3g} along x, {slopes[1]:.3g} along y)",
        ),
        (
            "cells per b",
            f"{b / dx:.3g}",
            "correlation length",
            f"{in_um} um = {in_cells} cells  (along x and y, to 1/e)",
        ),
        (
            "length / 2b",
            f"{nx * dx / (2 * b):.3g}",
            "cells",
            f"{nx * ny}, about {SOLVE_FIELDS * 8 * nx * ny / 2**20:.3g} MiB at a contact solve on all of them",
        ),
    ]
    return [f"    {left:<12} {value:<11} {right:<19} {text}" for left, value, right, text in rows]


def _correlation_length(surface, axis) -> float | None:
    """Correlation length [m] along an axis. None where a map has none: it is flat, has one cell, or is shorter than
    twice that length."""
    try:
        return correlation_length(surface, axis)
    except InputError:
        return None
