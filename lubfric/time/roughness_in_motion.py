"""What lets a run in time include that its roughness moves, where the load-sharing model treats it as stationary."""

import math
from dataclasses import replace

from ..errors import InputError
from ..models.shared import stated_way_to_motion
from ..scene import Scene, why_gap_not_resolved
from ..studies import in_words
from .transient_deterministic import work_of_run

# Processor time [s] of a run from which on advice to make it states it. A choice: a shorter one is simply tried.
STATED_FROM = 120.0

# Processor time [s] of a run above which it is not recommended. A choice: who wants it finds the time stated.
MOST_ADVISED = 3600.0

NO_MODEL = "no model of a run in time includes this motion"


def way_to_motion_in_time(scene: Scene) -> str:
    """Return what to do so that a run of ``scene`` includes the motion of its roughness, with the processor time if it
    is long; or why no model of a run does so within an hour and ``numerics.max_work``, as text."""
    way = stated_way_to_motion(scene)
    if why_gap_not_resolved(scene):
        return way
    try:
        seconds = work_of_run(replace(scene, numerics=replace(scene.numerics, model="deterministic")))[1]
    except InputError as error:
        return f"{NO_MODEL}: the deterministic model refuses {error.quantity}{error.said}"
    most_work = scene.numerics.max_work or math.inf
    takes = f"about {in_words(seconds)} of processor time"
    if seconds > most_work:
        return f"{NO_MODEL} within numerics.max_work = {most_work:g} s: the deterministic model would take {takes}"
    if seconds > MOST_ADVISED:
        return f"{NO_MODEL} within an hour: the deterministic model would take {takes}"
    return f"{way} ({takes})" if seconds > STATED_FROM else way
