"""Shear of the film at one moment: Couette and rolling part of the friction force, and the heat of the film."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace

import numpy as np

from ..film import ShearForce, rolling_error, spike_error
from ..oil import carried_stress, shear_stress
from ..scene import Scene
from ..sharing import Heat, point_heat
from .film_equations import outside_shear
from .film_newton import FilmStep
from .sharing import Sharing


def film_shear(
    sharing: Sharing, scene: Scene, time: float, sliding: float, solution: FilmStep
) -> tuple[ShearForce, Heat]:
    """Forces [N] along +x on the upper surface, and the heat.

    They act where the film is pressurised and not touched, and include the inlet tails. ``scene``: that of the moment.
    Film and surfaces are taken to be as hot as in steady motion at the speeds of the moment.
    """
    lubricant, film, contact = scene.lubricant, _film_now(sharing, scene, solution), solution.payload

    def cold(x, pressure, thickness):
        return shear_stress(lubricant, pressure, sliding / thickness)

    isothermal = _summed(sharing, time, solution, cold, lubricant.viscosity * sliding)
    if film is None:
        return isothermal, Heat()
    boundary = scene.bodies.boundary_friction_coefficient * contact.load * np.sign(sliding)
    heat, warm = point_heat(scene, film, contact.state, contact.load, abs(boundary + isothermal.total), isothermal)
    if warm is None or warm.stress is None:
        return isothermal, heat
    along, heated = math.copysign(1.0, film.entrainment_speed), warm.stress

    def hot(x, pressure, thickness):
        return math.copysign(1.0, sliding) * np.abs(heated(x * along, pressure, thickness))

    return _summed(sharing, time, solution, hot), heat


def _film_now(sharing: Sharing, scene: Scene, solution: FilmStep) -> SimpleNamespace | None:
    """The pressurised film at its nodes, with all that `lubfric.sharing.point_heat` needs. None where nothing is
    entrained, or hardly a node has pressure."""
    t, p, speed = solution.terms, sharing.setting.problem, scene.motion.entrainment_speed
    wet = np.flatnonzero(t.P > 0.0)
    if wet.size < 3 or speed == 0.0:
        return None
    inside = slice(wet[0], wet[-1] + 1)
    x = sharing.setting.grid.x[inside] * p.length_unit
    return SimpleNamespace(
        x=x,
        pressure=t.P[inside] * p.pressure_unit,
        film_thickness=t.H[inside] * p.film_unit,
        entrainment_speed=speed,
        rupture=float(x[-1] if speed > 0 else x[0]),
    )


def _summed(
    sharing: Sharing, time: float, solution: FilmStep, stress: Callable, drag: float | None = None
) -> ShearForce:
    """`ShearForce` by trapezes of ``stress(x, pressure, film)`` [Pa]. ``drag``: that times the film [N/m] beyond the
    ends of the grid; None: as at the last node, because at any film its own heat thins it by the same factor."""
    t, p, grid = solution.terms, sharing.setting.problem, sharing.setting.grid
    x, h, pressure = grid.x * p.length_unit, t.H * p.film_unit, t.P * p.pressure_unit
    free = 1.0 - solution.payload.state.touching(x)
    full = free * np.diff(x) * full_part(x, pressure)
    with np.errstate(over="ignore"):
        tau = stress(x, pressure, h)
        middle = stress(*(_halfway(a) for a in (x, pressure, h)))
    carried = carried_stress(pressure)
    above = np.maximum(np.abs(tau) - carried, 0.0)
    rolls = 0.5 * _halfway(h) * np.diff(pressure) * free
    wet = np.flatnonzero(pressure > 0.0)
    off = 2 / 3 * abs(float(np.sum((middle - _halfway(tau)) * full)))
    if wet.size > 4:
        inside = slice(wet[0], wet[-1] + 1)
        off = max(off, spike_error(x[inside], tau[inside])) + rolling_error(pressure[inside], h[inside], 1.0)
    drags = tau[[0, -1]] * h[[0, -1]] if drag is None else np.full(2, drag)
    more, rolling = _tails(sharing, time, drags, solution)
    width = sharing.setting.contact.width
    return ShearForce(
        couette=width * (float(np.sum(_halfway(tau) * full)) + more),
        rolling=width * (float(np.sum(rolls)) + rolling),
        quadrature=width * off,
        rolling_parts=width * max(float(np.sum(rolls[rolls > 0])), -float(np.sum(rolls[rolls < 0]))),
        excess=width * float(np.sum(_halfway(above) * full)),
        stress_ratio=float(np.max(np.where(pressure > 0.0, np.abs(tau) / carried, 0.0))),
    )


def _halfway(nodal: np.ndarray) -> np.ndarray:
    return 0.5 * (nodal[1:] + nodal[:-1])


def _tails(sharing: Sharing, time: float, drags: np.ndarray, solution: FilmStep) -> tuple[float, float]:
    """Couette and rolling part [N/m] of the parabolic film beyond the ends of the grid. ``drags``: shear stress times
    film [N/m] at both ends."""
    setting, t = sharing.setting, solution.terms
    p, grid, now = setting.problem, setting.grid, setting.conditions(time)
    couette = rolling = 0.0
    for end, sign, drag in ((0, 1.0, drags[0]), (-1, -1.0, drags[1])):
        if t.P[end] > 0.0:
            a, flow, rate = abs(grid.x[end]), sign * t.flux[end] + t.stored[end], t.stored[end] / grid.weights[end]
            reach, tail = outside_shear(a, t.H[end], now.curvature, now.viscosity, sign * now.speed, flow, rate)
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
