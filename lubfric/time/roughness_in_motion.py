"""What lets a run in time include that its roughness moves, where the load-sharing model treats it as stationary."""

from dataclasses import replace

from ..errors import InputError
from ..models.shared import stated_way_to_motion
from ..scene import Scene
from ..studies import in_words
from .transient_deterministic import work_of_run

# Processor time [s] of a run from which on advice to make it states it. A choice: a shorter one is simply tried.
STATED_FROM = 120.0


def way_to_motion_in_time(scene: Scene) -> str:
    """Return what to do so that a run of ``scene`` includes the motion of its roughness, with the processor time if it
    is long; or why no model of a run does, as text."""
    way = stated_way_to_motion(scene)
    try:
        seconds = work_of_run(replace(scene, numerics=replace(scene.numerics, model="deterministic")))[1]
    except InputError:
        return way
    return f"{way} (about {in_words(seconds)} of processor time)" if seconds > STATED_FROM else way
