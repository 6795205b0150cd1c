"""The numbers of one moment: film, friction with both parts, mass balance."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ..film import ShearForce, smallest
from ..scene import Scene
from ..sharing import Heat, Validity, inlet_at, of_deflection, of_ends, of_film, of_motion
from .film_newton import FilmStep
from .film_setting import WET
from .march import Progress
from .scene_now import scene_at, sliding_at
from .sharing import Sharing
from .shear import film_shear
from .steady import friction_error

NO_FLOW = 1e-2  # of central film x largest speed: less flow than this is a film at rest
STEADY_ONLY = "a transient has no other deflection: compare with the steady f by film_deflection = 'scaled'"
NAMES = {  # of the numbers of a moment, by their units
    "s": "time",
    "m/s": "entrainment_speed sliding_speed",
    "N": "load contact_load film_load friction_force boundary_force couette_force rolling_force",
    "-": "coefficient sampling_error shear_error time_error inlet_film_factor heat_change real_contact_area_fraction "
    "plastic_area_fraction edge_load load_residual volume_residual mass_residual steps",
    "m": "min_film central_film mean_film mean_gap wet_from wet_to",
    "Pa": "max_pressure",
    "K": "flash_temperature_rise film_temperature_rise",
    "m2/s": "net_inflow stored cavity_growth",
}
UNITS = {name: unit for unit, names in NAMES.items() for name in names.split()}


def moment(sharing: Sharing, now: Progress) -> tuple[dict[str, float], tuple[Validity, ...]]:
    """The numbers after the last step, by name, and the assumptions that do not hold then."""
    solution, time, setting, strip = now.solution, now.time, sharing.setting, sharing.strip
    scene, sliding = scene_at(sharing.scene, time), sliding_at(sharing.scene, time)
    t, p, contact, state = solution.terms, setting.problem, solution.payload, solution.payload.state
    total, film_load, speed = scene.bodies.load, t.carried * setting.load_unit, scene.motion.entrainment_speed
    shear, heat = film_shear(sharing, scene, time, sliding, solution)
    boundary = scene.bodies.boundary_friction_coefficient * contact.load * np.sign(sliding)
    loads, parts, force = (contact.load, film_load), (boundary, shear.total), boundary + shear.total
    sense = np.sign(sliding) or np.sign(speed) or 1.0
    inlet, _ = inlet_at(scene, speed)
    heated_inlet = setting.contact.viscosity.before(time) != scene.lubricant.viscosity
    film_factor = inlet.factor if inlet is not None and heated_inlet else 1.0
    touches, wet = contact.load > 0.0, setting.grid.x[t.P > 0.0] * p.length_unit
    row = {
        "time": time,
        "entrainment_speed": speed,
        "sliding_speed": sliding,
        "load": total,
        "contact_load": contact.load,
        "film_load": film_load,
        "friction_force": force,
        "boundary_force": boundary,
        "couette_force": shear.couette,
        "rolling_force": shear.rolling,
        "coefficient": force * sense / total,
        "sampling_error": friction_error(strip, scene, state, loads, contact.softness, parts),
        "shear_error": shear.quadrature / abs(force) if force else 0.0,
        "time_error": now.error,
        "inlet_film_factor": film_factor,
        "flash_temperature_rise": heat.flash,
        "film_temperature_rise": heat.film,
        "heat_change": heat.change,
        "min_film": smallest(setting.grid.x, t.H) * p.film_unit,
        "central_film": t.H[setting.grid.n // 2] * p.film_unit,
        "mean_film": state.mean_film,
        "mean_gap": state.mean_gap if touches else state.mean_film,
        "max_pressure": t.P.max() * p.pressure_unit,
        "wet_from": wet[0] if wet.size else math.nan,
        "wet_to": wet[-1] if wet.size else math.nan,
        "real_contact_area_fraction": state.real_contact_area_fraction * strip.area if touches else 0.0,
        "plastic_area_fraction": state.plastic_area_fraction and state.plastic_area_fraction * strip.plastic,
        "edge_load": sharing.patch.on_the_ends(state) if touches else 0.0,
        "load_residual": (film_load + contact.load) / total - 1.0,
        "volume_residual": state.volume_residual if touches else 0.0,
        **_mass(sharing, solution),
        "steps": now.steps,
    }
    peclet = heat.peclet if heat.heated else math.inf
    heat = replace(heat, inlet=inlet, used=film_factor < 1.0, heated=None, peclet=peclet)
    return row, tuple(_violated(sharing, scene, row, shear, heat))


def _violated(
    sharing: Sharing, scene: Scene, row: dict[str, float], shear: ShearForce, heat: Heat
) -> Iterator[Validity]:
    """The assumptions of the steady model and of a run that do not hold at one moment."""
    speed, film, force = row["entrainment_speed"], row["central_film"], abs(row["friction_force"])
    prepared = sharing.strip.prepared
    yield from prepared.known
    yield from of_ends(row["edge_load"], prepared.surface.size[0])
    yield from of_motion(scene, speed, film)
    yield from of_film(scene, film, row["max_pressure"], shear, row["film_load"], force, heat)
    if row["shear_error"] > scene.numerics.tolerance:
        yield Validity(
            "estimated error of f by the sum of the film's shear stress",
            row["shear_error"],
            scene.numerics.tolerance,
            "",
            "the grid of a run in time does not hold the pressure spike, or the film is ruptured where it shears most",
            "a tighter numerics.film_tolerance; the steady f at the same speed (lubfric.friction) resolves the spike",
        )
    if row["contact_load"] > 0:
        yield from of_deflection(scene, row["mean_gap"], STEADY_ONLY)


def _mass(sharing: Sharing, solution: FilmStep) -> dict[str, float]:
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
    return {
        "net_inflow": inflow * unit,
        "stored": stored * unit,
        "mass_residual": abs(stored - inflow) / through,
        "cavity_growth": float(np.sum(t.r[1:-1][t.P[1:-1] <= 0.0])) * unit,
    }
