"""Shear of the film at one moment: Couette and rolling part of the friction force, and the heat of the film."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..contact import ContactState
from ..film import ShearForce, rolling_error, spike_error
from ..oil import carried_stress, shear_stress
from ..scene import Scene
from ..sharing import Heat, point_heat
from .film_active_set import StepSolution
from .film_tail import outside_shear
from .sharing import Sharing


@dataclass(frozen=True)
class FilmNow:
    """The pressurised film of a moment at its nodes x [m], with all that `lubfric.sharing.heat.point_heat` needs."""

    x: np.ndarray
    pressure: np.ndarray
    film_thickness: np.ndarray
    entrainment_speed: float
    rupture: float


@dataclass(frozen=True)
class BalanceNow:
    """Film and contact of a moment; the contact carries ``contact_load`` [N]."""

    film: FilmNow | None
    contact: ContactState
    contact_load: float


def film_shear(
    sharing: Sharing, scene: Scene, time: float, sliding: float, solution: StepSolution
) -> tuple[ShearForce, Heat]:
    """Forces [N] on the upper surface along +x, and the heat that was taken into account.

    They are B ∫ tau dx over the pressurised film, with tau = eta (u2 - u1)/h, and B ∫ (h/2) dp/dx dx. Both leave out
    the share of the width in contact, and include the inlet tails. ``scene``: that of the moment. Film and surfaces are
    taken to be as hot as in steady motion at the speeds of the moment.
    """
    balance = _balance(sharing, scene, solution)
    isothermal = _shear(sharing, scene, time, sliding, solution)
    if balance.film is None:
        return isothermal, Heat()
    boundary = scene.bodies.boundary_friction_coefficient * balance.contact_load * np.sign(sliding)
    heat, warm = point_heat(scene, balance, abs(boundary + isothermal.total), isothermal)
    if warm is None or warm.stress is None:
        return isothermal, heat
    along, heated = math.copysign(1.0, balance.film.entrainment_speed), warm.stress

    def stress(x, pressure, thickness):
        return math.copysign(1.0, sliding) * np.abs(heated(x * along, pressure, thickness))

    return _shear(sharing, scene, time, sliding, solution, stress), heat


def _balance(sharing: Sharing, scene: Scene, solution: StepSolution) -> BalanceNow:
    t, p, contact = solution.terms, sharing.setting.problem, solution.payload
    wet = np.flatnonzero(t.P > 0.0)
    speed = scene.motion.entrainment_speed
    if wet.size < 3 or speed == 0.0:
        return BalanceNow(None, contact.state, contact.load)
    inside = slice(wet[0], wet[-1] + 1)
    x = sharing.setting.grid.x[inside] * p.length_unit
    film = FilmNow(
        x, t.P[inside] * p.pressure_unit, t.H[inside] * p.film_unit, speed, float(x[-1] if speed > 0 else x[0])
    )
    return BalanceNow(film, contact.state, contact.load)


def _shear(sharing: Sharing, scene: Scene, time: float, sliding: float, solution: StepSolution, stress=None):
    """`ShearForce` by trapezes; ``stress(x, pressure, film)`` [Pa]: of the heated film (None: isothermal)."""
    setting, t, lubricant = sharing.setting, solution.terms, scene.lubricant
    p, grid = setting.problem, setting.grid
    x, h, pressure = grid.x * p.length_unit, t.H * p.film_unit, t.P * p.pressure_unit
    free = 1.0 - solution.payload.state.touching(x)
    rolls = 0.25 * (h[1:] + h[:-1]) * np.diff(pressure) * free

    def of(at, pressed, thickness):
        with np.errstate(over="ignore"):
            if stress is not None:
                return stress(at, pressed, thickness)
            return shear_stress(lubricant, pressed, sliding / thickness)

    tau, full = of(x, pressure, h), free * np.diff(x) * full_part(x, pressure)
    couette = float(np.sum(0.5 * (tau[1:] + tau[:-1]) * full))
    middle = of(*(0.5 * (a[1:] + a[:-1]) for a in (x, pressure, h)))
    wet = np.flatnonzero(pressure > 0.0)
    inside = slice(wet[0], wet[-1] + 1) if wet.size else slice(0, 0)
    off = 2 / 3 * abs(float(np.sum((middle - 0.5 * (tau[1:] + tau[:-1])) * full)))
    if wet.size > 4:
        off = max(off, spike_error(x[inside], tau[inside])) + rolling_error(pressure[inside], h[inside], 1.0)
    carried = carried_stress(pressure)
    above = np.maximum(np.abs(tau) - carried, 0.0)
    thinned = tau[[0, -1]] * h[[0, -1]] if stress is not None else np.full(2, lubricant.viscosity * sliding)
    more, rolling = _tails(sharing, time, thinned, solution)
    width = sharing.width
    return ShearForce(
        width * (couette + more),
        width * (float(np.sum(rolls)) + rolling),
        quadrature=width * off,
        rolling_parts=width * max(float(np.sum(rolls[rolls > 0])), -float(np.sum(rolls[rolls < 0]))),
        excess=width * float(np.sum(0.5 * (above[1:] + above[:-1]) * full)),
        stress_ratio=float(np.max(np.where(pressure > 0.0, np.abs(tau) / carried, 0.0))),
    )


def _tails(sharing: Sharing, time: float, drags: np.ndarray, solution: StepSolution) -> tuple[float, float]:
    """Couette and rolling part [N/m] of the parabolic film beyond the ends of the grid. ``drags``: shear stress times
    film [N/m] at both ends. Beyond them it stays the same: at any film, its own heat thins it by the same factor."""
    setting, t = sharing.setting, solution.terms
    p, grid, now = setting.problem, setting.grid, setting.conditions(time)
    couette = rolling = 0.0
    for end, sign, drag in ((0, 1.0, drags[0]), (-1, -1.0, drags[1])):
        if t.P[end] > 0.0:
            flow = sign * t.flux[end] + t.stored[end]
            reach, tail = outside_shear(
                abs(grid.x[end]),
                t.H[end],
                now.curvature,
                now.viscosity,
                sign * now.speed,
                flow,
                t.stored[end] / grid.weights[end],
            )
            couette += float(drag) * reach * p.length_unit / p.film_unit
            rolling -= sign * tail * p.film_unit * p.pressure_unit
    return couette, rolling


def full_part(x: np.ndarray, pressure: np.ndarray) -> np.ndarray:
    """Part of each cell between neighbouring ``x`` that the pressurised film fills. In the cell where it ruptures, the
    pressure falls to zero like a square (p = dp/dx = 0 there); the two nodes before determine where."""
    wet = pressure > 0.0
    root = np.sqrt(np.maximum(pressure, 0.0))
    part = (wet[1:] & wet[:-1]).astype(float)
    for i in np.flatnonzero(wet[1:] != wet[:-1]):
        last, step = (i, 1) if wet[i] else (i + 1, -1)
        before = last - step
        if 0 <= before < x.size and root[before] > root[last]:
            reach = root[last] * (x[last] - x[before]) / (root[before] - root[last])
            part[i] = min(abs(reach / (x[i + 1] - x[i])), 1.0)
    return part
