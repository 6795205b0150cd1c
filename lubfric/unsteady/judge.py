"""Is a run in time an answer? The assumptions of the steady model, and those of its own, at every output."""

from __future__ import annotations

import math

from ..film.shear import ShearForce
from ..heat.point import Heat, inlet_at
from ..prepared import Prepared
from ..scene import Scene
from ..validity.entry import Validity
from ..validity.solution import STRIP_SHARE, of_deflection, of_heat, of_motion, of_pressure, of_shear, of_thickness
from .at_a_time import SceneInTime

STEADY_ONLY = "a transient has no other deflection: compare with the steady f by film_deflection = 'scaled'"


def judged_outputs(prepared: Prepared, in_time: SceneInTime, columns) -> tuple[tuple[Validity, ...], ...]:
    """Entries of every output; ``columns``: the arrays over time of a `TransientResult`."""
    count = columns["time"].size
    rows = ({name: float(values[i]) for name, values in columns.items()} for i in range(count))
    return tuple((*prepared.known, *_of_moment(in_time.at(row["time"]), row)) for row in rows)


def _of_moment(scene: Scene, row: dict[str, float]) -> list[Validity]:
    speed, film, tolerance = row["entrainment_speed"], row["central_film"], scene.numerics.tolerance
    shear = ShearForce(
        row["couette_force"], row["rolling_force"], excess=row["shear_excess"], stress_ratio=row["shear_stress_ratio"]
    )
    entries = [*of_motion(scene, speed, film), *of_pressure(scene.lubricant, row["max_pressure"])]
    entries += of_thickness(scene.bodies, film)
    entries += of_shear(scene, shear, row["film_load"], abs(row["friction_force"]))
    entries += of_heat(_heat(scene, speed, row), scene.motion.slide_roll_ratio, tolerance)
    entries += _of_sum(row["shear_error"], tolerance)
    if row["contact_load"] > 0:
        rise = scene.bodies.half_width**2 / (6 * scene.bodies.radius)
        entries += of_deflection(rise / row["mean_gap"], STRIP_SHARE, STEADY_ONLY)
    return entries


def _heat(scene: Scene, speed: float, row: dict[str, float]) -> Heat:
    inlet, _ = inlet_at(scene, speed)
    used, peclet = row["inlet_film_factor"] < 1, row["peclet"]
    return Heat(inlet, used, row["heat_change"], None, peclet if math.isfinite(peclet) else math.inf)


def _of_sum(error: float, tolerance: float) -> list[Validity]:
    """``error``: of f, relative, by the sum of the shear stress over the nodes, which a pressure spike escapes."""
    if not error > tolerance:
        return []
    return [
        Validity(
            "estimated error of f by the sum of the film's shear stress",
            error,
            tolerance,
            "",
            "the grid of a run in time does not hold the pressure spike, or the film is ruptured where it shears most",
            "a tighter numerics.film_tolerance; the steady f at the same speed (lubfric.friction) resolves the spike",
        )
    ]
