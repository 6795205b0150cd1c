"""Bodies and map: half-space, small slopes, Reynolds number, sliding. Known before anything is solved."""

from __future__ import annotations

import math

from ..analytic import hertz
from .entry import Validity

WIDE, WIDEST = 0.1, 0.5  # half-width of the Hertz strip over R: half-space
STEEP, STEEPEST = 0.5, 1.5  # rms slope
FEW = 10  # correlation lengths that a patch should be wide
LAMINAR, TURBULENT = 1000.0, 2000.0  # rho U h/eta
INERTIA = 0.1  # (rho U h/eta) h/b
YIELDED = 4.5e9  # Pa, peak Hertz pressure that hard steel does not carry elastically
OPPOSED = 2.0  # slide-roll ratio
DENSITY = 870.0  # kg/m³ of an oil, where none is given


def of_bodies(bodies) -> list[Validity]:
    """Half-space and elasticity of the Hertz contact."""
    found, wide = [], bodies.half_width / bodies.radius
    if wide > WIDE:
        found.append(
            Validity(
                "contact half-width over radius",
                wide,
                WIDEST if wide > WIDEST else WIDE,
                "",
                "the contact is as wide as the body, which is then no half-space",
                "check bodies.load, e_prime and radius; a lighter load or a stiffer body",
                wide > WIDEST,
            )
        )
    if bodies.width < 2 * bodies.half_width:
        found.append(
            Validity(
                "line length over contact width",
                bodies.width / (2 * bodies.half_width),
                1.0,
                "",
                "the contact is wider than long: no line contact",
                "check bodies.width and load",
            )
        )
    peak = hertz.line_peak_pressure(bodies.load / bodies.width, bodies.radius, bodies.e_prime)
    if bodies.hardness is None and peak > YIELDED:
        found.append(
            Validity(
                "peak Hertz pressure",
                peak / 1e9,
                YIELDED / 1e9,
                "GPa",
                "hard steel yields there, the bodies are elastic here",
                "check bodies.load; give bodies.hardness",
            )
        )
    return found


def of_map(slope: float, lengths: float | None) -> list[Validity]:
    """Entries for the map. ``slope``: its rms slope [-]; ``lengths``: its width over its correlation length across
    the motion (None: not known)."""
    found = []
    if slope > STEEP:
        found.append(
            Validity(
                "rms slope of the map",
                slope,
                STEEPEST if slope > STEEPEST else STEEP,
                "",
                "the half-space takes slopes as small: contact area and pressures are off",
                "check the units of heights and spacing; filter the map at the scale that matters",
                slope > STEEPEST,
            )
        )
    if lengths is not None and lengths < FEW:
        found.append(
            Validity(
                "width of the map over its correlation length",
                lengths,
                FEW,
                "",
                "few asperities: another patch of the same surface would give another f",
                "a larger map",
            )
        )
    return found


def of_motion(scene, speed: float, film: float) -> list[Validity]:
    """Entries for sliding, inertia and turbulence at ``speed`` [m/s] and a film thickness [m] (NaN: no film)."""
    found, ratio = [], abs(scene.motion.slide_roll_ratio)
    if ratio > OPPOSED * (1 + 1e-12):
        found.append(
            Validity(
                "slide-roll ratio",
                ratio,
                OPPOSED,
                "",
                "the surfaces move against one another: heat and dimples of such films are not modelled",
                "in percent? give motion.slip_percent; 2 is simple sliding",
            )
        )
    if math.isfinite(film) and film > 0:
        oil = scene.lubricant.oil
        density = DENSITY if oil is None else oil.density_at(scene.lubricant.temperature)
        reynolds = density * abs(speed) * film / scene.lubricant.viscosity
        inertia = reynolds * film / max(scene.bodies.half_width, math.sqrt(2 * scene.bodies.radius * film))
        if reynolds > LAMINAR:
            limit = TURBULENT if reynolds > TURBULENT else LAMINAR
            found.append(
                Validity(
                    "Reynolds number",
                    reynolds,
                    limit,
                    "",
                    "the film is turbulent or near it",
                    "a laminar film needs less speed or more viscosity",
                    reynolds > TURBULENT,
                )
            )
        elif inertia > INERTIA:
            found.append(
                Validity(
                    "inertia over viscous forces in the film",
                    inertia,
                    INERTIA,
                    "",
                    "Reynolds' equation leaves inertia out",
                    "less speed or more viscosity",
                )
            )
    return found
