"""The friction force in the check of random scenes: by the trapezoidal rule over the film, with every shear law and
heat."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from lubfric.film import EHLResult
from lubfric.scene import Scene

from ...fem.solvers.fluid import Fluid
from ...types import FloatArray
from .soak_heat import heated_stress, heats, inlet_viscosity

if TYPE_CHECKING:
    from .soak_judge import Sides

MOSTLY = 0.5  # of the isothermal force: below it the heated one is summed by itself
HEATED = 1400  # nodes at most on which the heat of the film is found


def friction_force(scene: Scene, sides: Sides, contact_load: float, speed: float) -> tuple[float, float, float]:
    """Return the friction force f_b F_C + F_sh [N] along the sliding, and how well it is known.

    ``sides`` has the film, x and the share in contact. The far inlet is in closed form. Returned are the force, the
    size [N] of the parts of the film's share (of which f may be a small difference), and how much less [N] its stress
    sums to on half of the nodes, which shows a pressure spike that the nodes do not resolve.
    """
    bodies = scene.bodies
    ratio = scene.motion.slide_roll_ratio
    film = sides.film
    sign = math.copysign(1.0, speed)
    order = slice(None) if sign > 0 else slice(None, None, -1)
    x = film.x[order] * sign
    p = film.pressure[order]
    h = film.film_thickness[order]
    wet = x <= sign * film.rupture + 1e-12 * film.half_width
    x = x[wet]
    p = p[wet]
    h = h[wet]
    cells = 1 - _touched(sign * x, sides)
    if scene.contact.geometry == "flat":
        cells = 1 - sides.touching[0] * _inside(x, bodies.half_width)
    free = np.concatenate([cells[:1], 0.5 * (cells[1:] + cells[:-1]), cells[-1:]])
    couette = 0.0
    if ratio:
        couette = _couette(scene, x, p, h, free, contact_load, speed)
    rolling = np.sum(0.5 * cells * (h[1:] + h[:-1]) * np.diff(p)) / 2
    rolling += _rolling_upstream(film, x[0], h[0], bodies.radius, inlet_viscosity(scene, speed) * abs(speed))
    parts = couette + np.sum(0.5 * cells * (h[1:] + h[:-1]) * np.abs(np.diff(p))) / 2
    sense = -1.0 if ratio < 0 else 1.0  # along the sliding; the pressure flow pushes along the entrainment
    boundary = bodies.boundary_friction_coefficient * contact_load * (ratio != 0)
    coarse = _couette(scene, x[::2], p[::2], h[::2], free[::2], contact_load, speed, hot=False)
    spike = abs(_couette(scene, x, p, h, free, contact_load, speed, hot=False) - coarse)
    force, parts, spike = (bodies.width * v for v in (couette + sense * rolling, parts, spike))
    return float(boundary + force), float(parts), float(spike)


def _upstream(x0: float, h0: float, radius: float) -> float:
    """Return ∫dx/h before the first node [-], where h is a parabola."""
    share = np.linspace(0, 1, 4001)[1:]  # x0/x
    return float(np.trapezoid(abs(x0) / share**2 / (h0 + x0**2 * (share**-2.0 - 1) / (2 * radius)), share))


def _rolling_upstream(film: EHLResult, x0: float, h0: float, radius: float, viscosity_speed: float) -> float:
    """Return ½∫h dp before the first node [N/m].

    Reynolds' equation has dp = 12 eta U (h - h*)/h³ dx there, and h is a parabola.
    """
    share = np.linspace(0, 1, 4001)[1:]  # x0/x
    gap = h0 + x0**2 * (share**-2.0 - 1) / (2 * radius)
    rate = (1 - film.flow_film / gap) / gap * abs(x0) / share**2
    return 6 * viscosity_speed * float(np.trapezoid(rate, share))


def _touched(x: FloatArray, sides: Sides) -> np.ndarray:
    """Return share of the width in contact over each cell between neighbouring ``x``; columns are even inside."""
    step = sides.x[1] - sides.x[0]
    edges = np.concatenate([sides.x - step / 2, sides.x[-1:] + step / 2])
    return np.diff(np.interp(x, edges, np.concatenate([[0.0], step * np.cumsum(sides.touching)]))) / np.diff(x)


def _inside(x: np.ndarray, half: float) -> np.ndarray:
    """Return part of each cell that lies within ``half`` of the middle."""
    return np.diff(np.clip(x, -half, half)) / np.diff(x)


def _couette(
    scene: Scene,
    x: FloatArray,
    p: FloatArray,
    h: FloatArray,
    free: FloatArray,
    contact_load: float,
    speed: float,
    *,
    hot: bool = True,
) -> float:
    """Return couette force over the film per width [N/m], and upstream of it, where a film is as much thinned by its
    own heat as at its first node. That of a film that heats itself is taken from fewer nodes."""
    oil = scene.lubricant
    slide = abs(scene.motion.slide_roll_ratio * speed)
    upstream = oil.viscosity * slide * _upstream(x[0], h[0], scene.bodies.radius) if slide else 0.0
    fluid = Fluid.of(vars(oil))
    pressed = np.maximum(p, 0.0)
    log_ratio = fluid.log_viscosity(pressed)
    eta = fluid.eta(pressed)
    tau = fluid.stress(pressed, slide / h)
    force = float(np.trapezoid(free * tau, x))
    if oil.eyring_stress is None and oil.limiting_stress_coefficient is None:
        rate = free * slide / h
        force = float(np.sum(np.diff(x) * _log_mean(eta) * 0.5 * (rate[1:] + rate[:-1])))
    if hot and heats(scene):
        some = _where_it_varies(tau)
        x, p, h, log_ratio, free, tau = (a[some] for a in (x, p, h, log_ratio, free, tau))
        heated = free * heated_stress(scene, x, p, h, log_ratio, free, contact_load, speed)
        hot = np.trapezoid(heated, x)
        cold = np.trapezoid(free * tau, x)
        upstream *= heated[0] / (free[0] * tau[0])
        return float((hot if hot < MOSTLY * cold else force + hot - cold) + upstream)
    return force + upstream


def _where_it_varies(tau: FloatArray) -> np.ndarray:
    """Return indices of at most `HEATED` nodes, half of them spread evenly and half where the stress changes."""
    steps = np.abs(np.diff(np.log(np.maximum(tau, 1e-300))))
    measure = np.concatenate([[0.0], np.cumsum(1 / steps.size + steps / max(steps.sum(), 1e-300))])
    return np.unique(np.searchsorted(measure, np.linspace(0, measure[-1], HEATED)).clip(0, tau.size - 1))


def _log_mean(eta: FloatArray) -> np.ndarray:
    """Return mean of a viscosity that is exponential between the nodes."""
    d = np.diff(np.log(eta))
    return eta[:-1] * np.where(np.abs(d) < 1e-6, 1.0, np.expm1(d) / np.where(d == 0, 1.0, d))
