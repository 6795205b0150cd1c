"""The numbers of one moment: film, friction with both parts, mass balance."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..film import smallest
from ..sampling import moment_error
from ..scene import Scene
from ..sharing import inlet_at
from .at_a_time import scene_at, sliding_at
from .bdf import Progress
from .film_active_set import StepSolution
from .film_setting import WET
from .film_shear import film_shear
from .sharing import Contact, Sharing

AT_REST, LOAD_STEP = 1e-6, 0.05  # m/s; of ln F_H
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
    "edge_load": "-",
    "net_inflow": "m2/s",
    "stored": "m2/s",
    "mass_residual": "-",
    "cavity_growth": "m2/s",
    "sampling_error": "-",
    "inlet_film_factor": "-",
    "flash_temperature_rise": "K",
    "film_temperature_rise": "K",
    "heat_change": "-",
    "peclet": "-",
    "shear_excess": "N",
    "shear_stress_ratio": "-",
    "shear_error": "-",
    "time_error": "-",
    "steps": "-",
}


def moment(sharing: Sharing, now: Progress) -> dict[str, float]:
    """One row of the result from the last step, by name in the order of ``UNITS``."""
    solution = now.solution
    time, in_time = now.time, sharing.prepared.scene
    scene, sliding = scene_at(in_time, time), sliding_at(in_time, time)
    setting, t, contact = sharing.setting, solution.terms, solution.payload
    p, grid, total = setting.problem, setting.grid, sharing.total(time)
    wet = np.flatnonzero(t.P > 0.0)
    film_load = t.carried * sharing.unit
    shear, heat = film_shear(sharing, scene, time, sliding, solution)
    boundary = scene.bodies.boundary_friction_coefficient * contact.load * np.sign(sliding)
    force = boundary + shear.total
    sense = np.sign(sliding) or np.sign(setting.contact.speed.before(time)) or 1.0
    state = contact.state
    balance = state.volume_residual if contact.load > 0.0 else 0.0
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
        "couette_force": shear.couette,
        "rolling_force": shear.rolling,
        "min_film": smallest(grid.x, t.H) * p.film_unit,
        "central_film": t.H[grid.n // 2] * p.film_unit,
        "mean_film": state.mean_film,
        "mean_gap": state.mean_gap if contact.load > 0.0 else state.mean_film,
        "max_pressure": float(t.P.max()) * p.pressure_unit,
        "wet_from": grid.x[wet[0]] * p.length_unit if wet.size else math.nan,
        "wet_to": grid.x[wet[-1]] * p.length_unit if wet.size else math.nan,
        **_areas(sharing, contact),
        "load_residual": (film_load + contact.load) / total - 1.0,
        "volume_residual": balance,
        "edge_load": sharing.prepared.contact.on_the_ends(state) if contact.load > 0.0 else 0.0,
        **_mass(sharing, solution),
        "sampling_error": moment_error(
            sharing.prepared.contact,
            state,
            (contact.load, film_load),
            contact.softness,
            sharing.width,
            sharing.correlation_length,
            (boundary, shear.total),
            _thinning(scene, film_load),
        ),
        "inlet_film_factor": _inlet_factor(sharing, scene, time),
        "flash_temperature_rise": heat.flash,
        "film_temperature_rise": heat.film,
        "heat_change": heat.change,
        "peclet": heat.peclet if heat.heated else math.nan,
        "shear_excess": shear.excess,
        "shear_stress_ratio": shear.stress_ratio,
        "shear_error": shear.quadrature / abs(force) if force else 0.0,
        "time_error": now.error,
        "steps": now.steps,
    }


def _areas(sharing: Sharing, contact: Contact) -> dict[str, float]:
    """Contact areas on the scene's own cells."""
    touching, plastic = contact.state.real_contact_area_fraction, contact.state.plastic_area_fraction
    return {
        "real_contact_area_fraction": touching * sharing.cells.area if contact.load > 0.0 else 0.0,
        "plastic_area_fraction": plastic * sharing.cells.plastic if plastic else 0.0,
    }


def _thinning(scene: Scene, film_load: float) -> float:
    """-d ln h/d ln F_H [-] of Moes' film that carries ``film_load`` [N]. At rest, that of a film that was drawn in
    slowly; 1 without load."""
    if film_load <= 0.0:
        return 1.0
    line, more = scene.line_contact(scene.motion.entrainment_speed or AT_REST), math.exp(LOAD_STEP)
    line = replace(line, load_per_width=film_load / scene.bodies.width)
    heavier = replace(line, load_per_width=more * line.load_per_width)
    return math.log(line.moes_film / heavier.moes_film) / LOAD_STEP


def _inlet_factor(sharing: Sharing, scene: Scene, time: float) -> float:
    """The factor on the film by the heat of the inlet with which it is solved."""
    if sharing.setting.contact.viscosity.before(time) == scene.lubricant.viscosity:
        return 1.0
    inlet, _ = inlet_at(scene, scene.motion.entrainment_speed)
    return 1.0 if inlet is None else inlet.factor


def _mass(sharing: Sharing, solution: StepSolution) -> dict[str, float]:
    """Balance of the lubricant per unit width and time [m²/s] where the film carries load (pressure above ``WET`` of
    the largest): flow into it, lubricant stored there; and the growth of the gap in the cavitated zone that nothing
    fills. mass_residual: what is missing in the balance, over the larger of the flow and ``NO_FLOW``."""
    t, p = solution.terms, sharing.setting.problem
    unit = p.film_unit * p.contact.entrainment_speed
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
