"""Whether a run in time is an answer: the assumptions of the steady model and of a run, checked at every output."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..film import ShearForce
from ..scene import Scene
from ..sharing import Heat, Prepared, Validity, inlet_at, of_deflection, of_ends, of_film, of_motion
from .at_a_time import scene_at

STEADY_ONLY = "a transient has no other deflection: compare with the steady f by film_deflection = 'scaled'"


def judged_outputs(prepared: Prepared, columns) -> tuple[tuple[Validity, ...], ...]:
    """Entries of every output; ``columns``: the arrays over time of a `TransientResult`."""
    count = columns["time"].size
    rows = ({name: float(values[i]) for name, values in columns.items()} for i in range(count))
    length = prepared.surface.size[0]
    return tuple(
        (*prepared.known, *of_ends(row["edge_load"], length), *_of_moment(scene_at(prepared.scene, row["time"]), row))
        for row in rows
    )


def _of_moment(scene: Scene, row: dict[str, float]) -> Iterator[Validity]:
    speed, film = row["entrainment_speed"], row["central_film"]
    shear = ShearForce(
        row["couette_force"], row["rolling_force"], excess=row["shear_excess"], stress_ratio=row["shear_stress_ratio"]
    )
    force, heat = abs(row["friction_force"]), _heat(scene, speed, row)
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


def _heat(scene: Scene, speed: float, row: dict[str, float]) -> Heat:
    inlet, _ = inlet_at(scene, speed)
    used, peclet = row["inlet_film_factor"] < 1, row["peclet"]
    return Heat(inlet, used, row["heat_change"], None, peclet if math.isfinite(peclet) else math.inf)
