"""Every input of a scene with its unit, in words."""

from __future__ import annotations

from .analytic import hertz
from .oil.describe import estimate_in_words
from .oil.temperature import CELSIUS
from .scene import Scene


def input_lines(scene: Scene) -> list[str]:
    """Bodies, lubricant and motion, one property a line, units spelled out."""
    return [
        *_section("bodies", _bodies(scene)),
        *_section("lubricant", _lubricant(scene)),
        *_section("motion", _motion(scene)),
    ]


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
        yield estimate_in_words(lubricant.oil, lubricant.temperature)
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
