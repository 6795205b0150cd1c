"""What a scene is, in words: regime numbers and what will be solved."""

from __future__ import annotations

import math

from .analytic import film as film_formulas
from .analytic import hertz
from .levels.forecast import forecast
from .rough_map import contact_map
from .scene import Scene


def describe_scene(scene: Scene) -> str:
    """Regime numbers (Hertz, Moes M and L, lambda at the scene's speeds) and the plan, as text."""
    bodies, lubricant, patch = scene.bodies, scene.lubricant, scene.contact
    surface = contact_map(scene)
    w = bodies.load / bodies.width
    peak = hertz.line_peak_pressure(w, bodies.radius, bodies.e_prime)
    nx, ny = surface.heights.shape
    limit = "elastic" if bodies.hardness is None else f"plastic limit {bodies.hardness / 1e9:g} GPa"
    lines = [
        f"scene {scene.name}",
        f"  Hertz          half-width {bodies.half_width * 1e6:.3f} um, mean pressure "
        f"{bodies.mean_hertz_pressure / 1e6:.1f} MPa, peak {peak / 1e6:.1f} MPa",
        f"  bodies         R = {bodies.radius:g} m, B = {bodies.width:g} m, F_T = {bodies.load:g} N, "
        f"E' = {bodies.e_prime / 1e9:g} GPa, {limit}, f_b = {bodies.boundary_friction_coefficient:g}",
        f"  lubricant      {lubricant.viscosity:g} Pa s, alpha = {lubricant.pressure_viscosity_coefficient * 1e9:g} /GPa, "
        f"{lubricant.viscosity_law}, density {lubricant.density_law}",
        f"  surface        {surface.describe()}",
        "  speed U (m/s)      M        L     h (um)  lambda   (Moes film at full load)",
    ]
    speeds = scene.motion.speeds or (scene.motion.entrainment_speed,)
    for speed in sorted({speeds[0], scene.motion.entrainment_speed, speeds[-1]}):
        if speed == 0:
            lines.append("  0              no entrainment: all contact")
            continue
        regime = dict(load_per_width=w, radius=bodies.radius, e_prime=bodies.e_prime, entrainment_speed=abs(speed),
                      viscosity=lubricant.viscosity,
                      pressure_viscosity_coefficient=lubricant.pressure_viscosity_coefficient)
        m, el = film_formulas.moes_numbers(**regime)
        h = film_formulas.moes_flow_film(**regime)
        ratio = h / surface.sq if surface.sq > 0 else math.inf
        lines.append(f"  {speed:<12.4g} {m:9.3g} {el:8.3g} {h * 1e6:12.4f} {ratio:8.3g}")
    if patch.geometry == "flat":
        plan = f"periodic contact curve on {nx} x {ny} cells, once, then read at every speed"
    else:
        plan = f"semi-periodic contact on {nx} x {ny} cells under the film at every speed"
    lines += [f"  contact        {plan}, or fewer: the coarsest grid and shortest patch for f within "
              f"{100 * scene.numerics.tolerance:g} %; {len(speeds)} speeds"]
    lines += [f"  U = {speed:<10.4g} {forecast(scene, surface, speed)}"
              for speed in sorted({speeds[0], scene.motion.entrainment_speed, speeds[-1]})]
    return "\n".join(lines)
