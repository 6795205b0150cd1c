"""[motion]: speeds of the two surfaces, slip in percent, a range of speeds."""

from __future__ import annotations

import numpy as np

from .._base import validate
from ..errors import InputError
from .short_pairs import only_one, pair

KEYS = ("surface_speeds", "slip_percent", "speed_range")
MOST_SPEEDS = 1_000_000


def resolve(given: dict, old) -> dict:
    """Plain fields of [motion].

    - ``surface_speeds = [u1, u2]`` [m/s] become entrainment speed U = (u1 + u2)/2 and slide-roll ratio.
    - ``slip_percent`` is the slide-roll ratio (u2 - u1)/U in percent.
    - ``speed_range = [lowest, highest, count]`` becomes ``speeds``, in a geometric series.
    """
    only_one("motion", given, "surface_speeds", "entrainment_speed")
    only_one("motion", given, "surface_speeds", "slide_roll_ratio", "slip_percent")
    only_one("motion", given, "speeds", "speed_range")
    if "surface_speeds" in given:
        numbers = pair("motion.surface_speeds", given.pop("surface_speeds"), "m/s")
        u1, u2 = (validate.number("motion.surface_speeds", u, "m/s") for u in numbers)
        if u1 + u2 == 0:
            raise InputError("motion.surface_speeds sum to 0 m/s: give entrainment_speed = 0 and a slide_roll_ratio")
        given |= {"entrainment_speed": (u1 + u2) / 2, "slide_roll_ratio": 2 * (u2 - u1) / (u1 + u2)}
    if "slip_percent" in given:
        given["slide_roll_ratio"] = validate.number("motion.slip_percent", given.pop("slip_percent"), "%") / 100
    if not isinstance(given.get("speeds", ()), (list, tuple, np.ndarray)):
        raise InputError(f" = {given['speeds']!r}", "motion.speeds", "a list of numbers in m/s")
    if "speed_range" in given:
        given["speeds"] = speeds_of_range("motion.speed_range", given.pop("speed_range"))
    return given


def speeds_of_range(name: str, value) -> tuple[float, ...]:
    """The speeds [m/s] of [lowest, highest, count], in a geometric series; ``name``: of the key."""
    if not isinstance(value, (list, tuple)) or len(value) != 3:
        raise InputError(f"{name} = {validate.shown(value)} must be [lowest, highest, count] in m/s, m/s, (-)")
    low = validate.positive(f"{name} lowest", value[0], "m/s")
    high = validate.positive(f"{name} highest", value[1], "m/s")
    if high <= low:
        raise InputError(f"{name} highest = {high:g} m/s; it must be above lowest = {low:g} m/s (are they swapped?)")
    count = validate.integer(f"{name} count", value[2], minimum=1, maximum=MOST_SPEEDS)
    return tuple(float(u) for u in np.geomspace(low, high, count))
