"""A Stribeck curve that chooses its speeds: the first ones, and the next one."""

from __future__ import annotations

import math

import numpy as np

from ..sampling import FrictionResult
from ..sharing import Prepared
from .choose import next_speed
from .interpolate import Samples
from .span import first_speeds

AUTO = "auto"
CHOSEN = 12  # speeds that a curve chooses, about
FEWEST = 3  # solved speeds that an interpolation needs
DECIDED = CLEARANCE, STEEPNESS = "clearance", "steepness"  # what an interpolation needs of the decision of a point


def begin_with(prepared: Prepared, wanted=()) -> list[float]:
    """The speeds [m/s] that do not depend on any result, including the ``wanted`` ones, fastest first."""
    return sorted({*first_speeds(prepared.scene, prepared.surface.sq), *wanted}, reverse=True)


def tolerance_between(prepared: Prepared) -> float:
    """The tolerance on f between the points of a curve: that on f itself. On a line of a rough surface, neighbouring
    points may be solved on different lengths of it; there it is the root sum of squares of the tolerance on f and the
    sampling tolerance."""
    numerics = prepared.scene.numerics
    return numerics.tolerance if prepared.lines is None else math.hypot(numerics.tolerance, numerics.sampling_tolerance)


def choose(prepared: Prepared, speeds: list[float], outcomes: list) -> float | None:
    """The next speed [m/s] after those with these ``outcomes``, or None if the curve is known or too few of them are
    solved."""
    good = [o for o in outcomes if isinstance(o, FrictionResult)]
    if len(good) < FEWEST:
        return None
    tried = [u for u, o in zip(speeds, outcomes) if not isinstance(o, FrictionResult)]
    found = next_speed(samples_of(good), tolerance_between(prepared), tried)[0]
    return None if found is None else float(found)


def samples_of(points: list[FrictionResult]) -> Samples:
    """The `Samples` of solved points, by ascending speed."""
    points = sorted(points, key=lambda point: abs(point.speed))
    names = ("contact_load", "film_load", "boundary_force", "coefficient", "film_to_roughness_ratio")
    columns = {name: np.array([getattr(p, name) for p in points]) for name in names}
    columns |= {name: np.array([getattr(p.decision, name, None) for p in points], dtype=float) for name in DECIDED}
    return samples_at(np.abs([p.speed for p in points]), columns)


def samples_at(speed: np.ndarray, columns: dict[str, np.ndarray]) -> Samples:
    """The `Samples` at ascending speeds [m/s], from the numbers of their points by name."""
    total = columns["contact_load"] + columns["film_load"]
    boundary = columns["boundary_force"] / total
    return Samples(
        speed=speed,
        share=columns["contact_load"] / total,
        boundary=boundary,
        film=columns["coefficient"] - boundary,
        thickness=columns["film_to_roughness_ratio"],
        clearance=columns[CLEARANCE],
        steepness=columns[STEEPNESS],
    )
