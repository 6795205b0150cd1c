"""A scene in words: regime numbers, and what will be solved."""

from __future__ import annotations

import math

from ..contact import contact_map, measured
from ..errors import InputError
from ..film import hertz
from ..oil import CELSIUS, estimate_in_words
from ..scene import Scene, told_doubts
from ..sharing import first_line, gathered, lines_of, outlook, takes_line
from ..sharing import lines_outlook as of_lines
from ..sharing.validity_outlook import foretold
from ..surface import correlation_length, rms_slope

SOLVE_FIELDS = 17  # arrays of 8-byte numbers, one a cell, at the peak of a contact solve (traced: 10 to 16.4)


def describe_scene(scene: Scene) -> str:
    """Regime numbers (Hertz, Moes M and L, lambda at the scene's speeds) and the plan, as text."""
    with told_doubts(scene):
        first = first_line(lines_of(scene)) if takes_line(scene) else None
        surface = contact_map(scene) if first is None or measured(scene) else first
    nx, ny = surface.heights.shape
    lines = [
        f"scene {scene.name}",
        *_section("bodies", _bodies(scene)),
        *_section("lubricant", _lubricant(scene)),
        *_section("motion", _motion(scene)),
        f"  surface        {surface.describe()}",
        *_map_lines(scene, surface),
        f"  {'U (m/s)':<12} {'M':>9} {'L':>8} {'h (um)':>10} {'lambda':>8}   film of the whole load, by Moes",
    ]
    speeds = scene.motion.speeds or (scene.motion.entrainment_speed,)
    for speed in sorted({speeds[0], scene.motion.entrainment_speed, speeds[-1]}):
        if speed == 0:
            lines.append(f"  {0:<12} no entrainment: all contact")
            continue
        line = scene.line_contact(abs(speed))
        h = line.moes_film
        ratio = h / surface.sq if surface.sq > 0 else math.inf
        lines.append(f"  {speed:<12.4g} {line.M:9.3g} {line.L:8.3g} {h * 1e6:10.4f} {ratio:8.3g}")
    if scene.numerics.model == "deterministic":
        plan = "one gap and one pressure, on grids of the map halved and doubled"
    elif scene.contact.geometry == "flat":
        plan = f"periodic contact curve on {nx} x {ny} cells, once, then read at every speed"
    elif takes_line(scene):
        plan = "semi-periodic contact on a line of the roughness (below) under the film at every speed"
    else:
        plan = f"semi-periodic contact on {nx} x {ny} cells under the film at every speed"
    lines += [
        f"  contact        {plan}; the coarsest grid and the shortest patch that give f within "
        f"{100 * scene.numerics.tolerance:g} %; {len(speeds)} speeds"
    ]
    if scene.numerics.model == "deterministic":
        return "\n".join(lines)
    lines += [
        f"  U = {speed:<10.4g} {outlook(scene, surface, speed)}"
        for speed in sorted({speeds[0], scene.motion.entrainment_speed, speeds[-1]})
    ]
    told = foretold(scene, surface if first is None else first, sorted(set(speeds)))
    lines += [f"  {entry.text}" for speed, entry in told if speed is None]
    lines += [f"  {text}" for text in gathered([(speed, (entry,)) for speed, entry in told if speed is not None])]
    lines += [f"  {note}" for note in _no_doubts(told)]
    return "\n".join([*lines, *_sampling_lines(scene, surface.sq)])


def _sampling_lines(scene: Scene, sq: float) -> list[str]:
    """Length of the line and its cost at the speeds of the scene."""
    if not takes_line(scene):
        return []
    speeds = scene.motion.speeds or (scene.motion.entrainment_speed,)
    some = sorted({speeds[0], scene.motion.entrainment_speed, *speeds[:: max(1, len(speeds) // 6)], speeds[-1]})
    return [f"  {row}" for row in of_lines.table(scene, lines_of(scene), sq, some)]


def _no_doubts(told) -> list[str]:
    return [] if told else ["validity       no assumption of the model fails by what is known before the solve"]


def _map_lines(scene: Scene, surface) -> list[str]:
    """Statistics of the map on its own grid, how well that grid resolves them, and the memory of a contact solve on
    it."""
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


def _section(name: str, rows) -> list[str]:
    return [f"  {name if i == 0 else '':<14} {text}" for i, text in enumerate(rows)]


def _bodies(scene: Scene):
    bodies = scene.bodies
    peak = hertz.line_peak_pressure(bodies.load / bodies.width, bodies.radius, bodies.e_prime)
    yield (
        f"reduced radius R = {bodies.radius:.4g} m ({bodies.radius * 1e3:.4g} mm), "
        f"line length B = {bodies.width:.4g} m ({bodies.width * 1e3:.4g} mm)"
    )
    yield (
        f"load F_T = {bodies.load:.4g} N ({bodies.load / bodies.width / 1e3:.4g} N/mm), "
        f"reduced modulus E' = {bodies.e_prime / 1e9:.4g} GPa"
    )
    yield (
        f"Hertz: half-width {bodies.half_width * 1e6:.3f} um, "
        f"mean pressure {bodies.mean_hertz_pressure / 1e6:.1f} MPa, peak {peak / 1e6:.1f} MPa"
    )
    limit = "none (elastic)" if bodies.hardness is None else f"{bodies.hardness / 1e9:.3g} GPa"
    friction = bodies.boundary_friction_coefficient
    yield f"plastic limit of the contact spots: {limit}; their friction coefficient f_b = {friction:g} (-)"
    if scene.lubricant.heats:
        conductivity = " and ".join(f"{k:.3g}" for k in bodies.conductivity)
        capacity = " and ".join(f"{c / 1e6:.3g}" for c in bodies.volumetric_heat)
        yield f"thermal conductivity {conductivity} W/(m K), heat capacity {capacity} MJ/(m³ K)"


def _lubricant(scene: Scene):
    lubricant = scene.lubricant
    if lubricant.oil is not None and lubricant.temperature is not None:
        yield from estimate_in_words(lubricant.oil, lubricant.temperature).replace(", alpha", "; alpha").split("; ")
    else:
        at = (
            ""
            if lubricant.temperature is None
            else f" at {lubricant.temperature:.5g} K ({lubricant.temperature - CELSIUS:.4g} °C)"
        )
        yield (
            f"viscosity {lubricant.viscosity:.4g} Pa s ({lubricant.viscosity * 1e3:.4g} mPa s){at}, pressure-viscosity "
            f"coefficient {lubricant.pressure_viscosity_coefficient * 1e9:.4g} /GPa"
        )
    yield f"viscosity over pressure: {lubricant.viscosity_law}; density over pressure: {lubricant.density_law}"
    if lubricant.newtonian:
        yield "shear: Newtonian at any stress (no eyring_stress, no limiting_stress_coefficient)"
    else:
        eyring = "none" if lubricant.eyring_stress is None else f"{lubricant.eyring_stress / 1e6:.4g} MPa"
        limit = "none"
        if lubricant.limiting_stress_coefficient is not None:
            limit = f"{lubricant.limiting_stress_offset / 1e6:.4g} MPa + {lubricant.limiting_stress_coefficient:g} p"
        yield f"shear: Eyring stress {eyring}, limiting stress {limit}"
    if lubricant.heats and lubricant.temperature_coefficient is not None:
        yield (
            f"viscosity falls by {100 * lubricant.temperature_coefficient:.3g} % a K, "
            f"film conductivity {lubricant.conductivity:.3g} W/(m K); heat: {scene.numerics.heat}"
        )
    else:
        yield "heat: isothermal, how the viscosity falls with the temperature is not given"


def _motion(scene: Scene):
    motion = scene.motion
    u, ratio = motion.entrainment_speed, motion.slide_roll_ratio
    u1, u2 = u * (1 - ratio / 2), u * (1 + ratio / 2)
    yield f"entrainment speed U = {u:.4g} m/s, slide-roll ratio (u2 - u1)/U = {ratio:.4g} ({100 * ratio:.4g} %)"
    yield f"surface speeds {u1:.4g} and {u2:.4g} m/s, sliding speed {abs(u2 - u1):.4g} m/s"
    if motion.speeds:
        yield f"{len(motion.speeds)} speeds of the curve, {min(motion.speeds):.4g} to {max(motion.speeds):.4g} m/s"
