"""Shear of the film at one moment: Couette and rolling part of the friction force."""

from __future__ import annotations

import numpy as np

from ..ehl.transient.active_set import StepSolution
from ..ehl.transient.tail import outside_shear
from ..lubricant import shear_stress, viscosity
from .sharing import Contact, Sharing


def film_shear(
    sharing: Sharing, time: float, sliding: float, solution: StepSolution, contact: Contact
) -> tuple[float, float]:
    """Couette and rolling part [N] of the force on the upper surface along +x: B ∫ eta (u2 - u1)/h dx over
    the pressurised film and B ∫ (h/2) dp/dx dx, both without the share of the width in contact, with the
    inlet tails."""
    setting, t, state = sharing.setting, solution.terms, contact.state
    p, grid, now = setting.problem, setting.grid, setting.conditions(time)
    x, h, pressure = grid.x * p.length_unit, t.H * p.film_unit, t.P * p.pressure_unit
    free = 1.0 - state.touching(x)
    rolling = float(np.sum(0.25 * (h[1:] + h[:-1]) * np.diff(pressure) * free))
    lubricant = setting.contact.lubricant
    rate = sliding * now.viscosity * p.contact.lubricant.viscosity / lubricant.viscosity / h  # the history scales eta
    tau = shear_stress(lubricant, pressure, rate)
    couette = float(np.sum(0.5 * (tau[1:] + tau[:-1]) * free * np.diff(x) * full_part(x, pressure)))
    ambient = float(viscosity(lubricant, 0.0)) * now.viscosity * p.contact.lubricant.viscosity / lubricant.viscosity
    for end, sign in ((0, 1.0), (-1, -1.0)):
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
            couette += ambient * sliding * reach * p.length_unit / p.film_unit
            rolling -= sign * tail * p.film_unit * p.pressure_unit
    return sharing.width * couette, sharing.width * rolling


def full_part(x: np.ndarray, pressure: np.ndarray) -> np.ndarray:
    """Part of each cell between neighbouring ``x`` that the pressurised film fills. In the cell where it
    ruptures the pressure falls to zero like a square (p = dp/dx = 0 there), which the two nodes before
    give."""
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
