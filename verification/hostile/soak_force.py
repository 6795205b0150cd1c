"""The friction force as the judge of the soak sums it: trapezes over the film, every shear law, heat."""

from __future__ import annotations

import math

import numpy as np

from ..stability.film_check import viscosity_ratio
from .soak_heat import heated_stress, heats

HEATED = 1400  # nodes at most on which the heat of the film is found


def friction_force(scene, sides, contact_load: float, speed: float) -> float:
    """f_b F_C + F_sh [N] of ``sides`` (film, x and share in contact), along the sliding; the far inlet in closed
    form."""
    bodies, oil, ratio, film = scene.bodies, scene.lubricant, scene.motion.slide_roll_ratio, sides.film
    sign = math.copysign(1.0, speed)
    order = slice(None) if sign > 0 else slice(None, None, -1)
    x, p, h = film.x[order] * sign, film.pressure[order], film.film_thickness[order]
    wet = x <= sign * film.rupture + 1e-12 * film.half_width
    x, p, h = x[wet], p[wet], h[wet]
    slide = abs(ratio * speed)
    free = 1 - np.interp(sign * x, sides.x, sides.touching, 0.0, 0.0)
    if scene.contact.geometry == "flat":
        free = 1 - np.where(np.abs(x) <= bodies.half_width, sides.touching[0], 0.0)
    couette = 0.0
    if ratio:
        couette = _couette(scene, x, p, h, free, contact_load, speed) + oil.viscosity * slide * 2 * bodies.radius / abs(
            x[0]
        )
    rolling = np.sum(0.25 * (free[1:] + free[:-1]) * (h[1:] + h[:-1]) * np.diff(p)) / 2
    rolling += 1.5 * p[0] * h[0]  # ½∫h dp before the first node, where h ~ x² and p ~ |x|^-3
    sense = -1.0 if ratio < 0 else 1.0  # along the sliding; the pressure flow pushes along the entrainment
    boundary = bodies.boundary_friction_coefficient * contact_load * (ratio != 0)
    return float(boundary + bodies.width * (couette + sense * rolling))


def _couette(scene, x, p, h, free, contact_load, speed) -> float:
    """Couette force over the film per width [N/m]; what heat takes off is summed over fewer nodes."""
    oil, slide = scene.lubricant, abs(scene.motion.slide_roll_ratio * speed)
    log_ratio = viscosity_ratio(oil.viscosity_law, oil.viscosity, oil.pressure_viscosity_coefficient, p)
    eta = oil.viscosity * np.exp(log_ratio)
    tau = eta * slide / h
    if oil.eyring_stress is not None:
        tau = oil.eyring_stress * np.arcsinh(tau / oil.eyring_stress)
    if oil.limiting_stress_coefficient is not None:
        tau = np.minimum(tau, oil.limiting_stress_offset + oil.limiting_stress_coefficient * p)
    force = float(np.trapezoid(free * tau, x))
    if oil.eyring_stress is None and oil.limiting_stress_coefficient is None:
        rate = free * slide / h
        force = float(np.sum(np.diff(x) * _log_mean(eta) * 0.5 * (rate[1:] + rate[:-1])))
    if heats(scene):
        some = np.unique(np.linspace(0, x.size - 1, min(x.size, HEATED)).round().astype(int))
        heated = heated_stress(scene, x[some], p[some], h[some], log_ratio[some], free[some], contact_load, speed)
        force += float(np.trapezoid(free[some] * (heated - tau[some]), x[some]))
    return force


def _log_mean(eta) -> np.ndarray:
    """Mean of a viscosity that is exponential between the nodes."""
    d = np.diff(np.log(eta))
    return eta[:-1] * np.where(np.abs(d) < 1e-6, 1.0, np.expm1(d) / np.where(d == 0, 1.0, d))
