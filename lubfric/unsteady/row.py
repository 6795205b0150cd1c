"""The numbers of one moment: film, friction with both parts, mass balance."""

from __future__ import annotations

import math

import numpy as np

from ..ehl.active_set import StepSolution
from ..ehl.bdf import Advance
from ..ehl.result import smallest
from ..ehl.tail import outside_shear
from ..ehl.transient import WET
from ..lubricant import shear_stress, viscosity
from .sharing import Contact, Sharing

NO_FLOW = 1e-2  # of central film x largest speed: less flow than this is a film at rest
UNITS = {
    "time": "s",
    "entrainment_speed": "m/s",
    "sliding_speed": "m/s",
    "load": "N",
    "contact_load": "N",
    "film_load": "N",
    "coefficient": "-",
    "friction_force": "N",
    "boundary_force": "N",
    "couette_force": "N",
    "rolling_force": "N",
    "min_film": "m",
    "central_film": "m",
    "mean_film": "m",
    "mean_gap": "m",
    "max_pressure": "Pa",
    "wet_from": "m",
    "wet_to": "m",
    "real_contact_area_fraction": "-",
    "plastic_area_fraction": "-",
    "load_residual": "-",
    "volume_residual": "-",
    "net_inflow": "m2/s",
    "stored": "m2/s",
    "mass_residual": "-",
    "cavity_growth": "m2/s",
    "time_error": "-",
    "steps": "-",
}


def moment(
    sharing: Sharing,
    time: float,
    sliding: float,
    boundary_coefficient: float,
    solution: StepSolution,
    contact: Contact,
    advanced: Advance | None,
    steps: int,
) -> dict[str, float]:
    """One row of the result, by name in the order of ``UNITS``."""
    setting, t = sharing.setting, solution.terms
    p, grid, total = setting.problem, setting.grid, sharing.total(time)
    wet = np.flatnonzero(t.P > 0.0)
    film_load = t.carried * sharing.unit
    couette, rolling = _shear(sharing, time, sliding, solution, contact)
    boundary = boundary_coefficient * contact.load * np.sign(sliding)
    force = boundary + couette + rolling
    sense = np.sign(sliding) if sliding else 1.0
    closure = contact.closure
    balance = closure.volume_residual if contact.load > 0.0 else 0.0
    return {
        "time": time,
        "entrainment_speed": setting.contact.speed.before(time),
        "sliding_speed": sliding,
        "load": total,
        "contact_load": contact.load,
        "film_load": film_load,
        "coefficient": force * sense / total,
        "friction_force": force,
        "boundary_force": boundary,
        "couette_force": couette,
        "rolling_force": rolling,
        "min_film": smallest(grid.x, t.H) * p.film_unit,
        "central_film": t.H[grid.n // 2] * p.film_unit,
        "mean_film": closure.mean_film,
        "mean_gap": closure.mean_gap if contact.load > 0.0 else closure.mean_film,
        "max_pressure": float(t.P.max()) * p.pressure_unit,
        "wet_from": grid.x[wet[0]] * p.length_unit if wet.size else math.nan,
        "wet_to": grid.x[wet[-1]] * p.length_unit if wet.size else math.nan,
        "real_contact_area_fraction": closure.real_contact_area_fraction,
        "plastic_area_fraction": closure.plastic_area_fraction,
        "load_residual": (film_load + contact.load) / total - 1.0,
        "volume_residual": balance,
        **_mass(sharing, solution),
        "time_error": advanced.error if advanced else 0.0,
        "steps": steps,
    }


def _mass(sharing: Sharing, solution: StepSolution) -> dict[str, float]:
    """Lubricant per unit width and time [m²/s] where the film carries load (pressure above ``WET`` of the
    largest): into it, kept there; and the growth of the gap in the cavitated zone that nothing fills.
    mass_residual: what is missing in the balance, of the larger of the flow and of ``NO_FLOW``."""
    t, p = solution.terms, sharing.setting.problem
    unit = p.film_unit * p.speed
    film = t.P[1:-1] > WET * t.P.max()
    stored = float(np.sum(t.stored[1:-1][film]))
    inflow = -float(np.sum(np.diff(t.flux)[film]))
    inside = np.abs(t.flux)[1:-1][film[1:] & film[:-1]]
    through = float(np.median(inside)) if inside.size else 0.0
    through = max(through, abs(stored), NO_FLOW * t.H[t.H.size // 2])
    dry = t.P[1:-1] <= 0.0
    return {
        "net_inflow": inflow * unit,
        "stored": stored * unit,
        "mass_residual": abs(stored - inflow) / through,
        "cavity_growth": float(np.sum(t.r[1:-1][dry])) * unit,
    }


def _shear(
    sharing: Sharing, time: float, sliding: float, solution: StepSolution, contact: Contact
) -> tuple[float, float]:
    """Couette and rolling part [N] of the force on the upper surface along +x: B ∫ eta (u2 - u1)/h dx over
    the pressurised film and B ∫ (h/2) dp/dx dx, both without the share of the width in contact, with the
    inlet tails."""
    setting, t, closure = sharing.setting, solution.terms, contact.closure
    p, grid, now = setting.problem, setting.grid, setting.conditions(time)
    x, h, pressure = grid.x * p.length_unit, t.H * p.film_unit, t.P * p.pressure_unit
    free = 1.0 - closure.touching(x)
    rolling = float(np.sum(0.25 * (h[1:] + h[:-1]) * np.diff(pressure) * free))
    lubricant = setting.contact.lubricant
    rate = sliding * now.viscosity * p.lubricant.viscosity / lubricant.viscosity / h  # the history scales eta
    tau = shear_stress(lubricant, pressure, rate)
    couette = float(np.sum(0.5 * (tau[1:] + tau[:-1]) * free * np.diff(x) * full_part(x, pressure)))
    ambient = float(viscosity(lubricant, 0.0)) * now.viscosity * p.lubricant.viscosity / lubricant.viscosity
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
