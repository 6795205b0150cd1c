"""The line of a run in time: as long as the steady balance needs at the speeds of the run."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..errors import LubfricError
from ..history import Constant
from ..lines.length import MOST_CELLS
from ..lines.pieces import line_contact
from ..prepared import Prepared
from ..steady import friction
from .at_a_time import changes

SPEEDS = 4  # looked at between the fastest and the slowest of a run
SLOWEST = 1e-3  # of the fastest: slower ones are boundary lubrication


def long_enough(prepared: Prepared) -> Prepared:
    """``prepared`` on a line as long as `lubfric.friction` needs for ``numerics.sampling_tolerance`` at the worst of
    four speeds of the run, or as memory and map allow.

    ``prepared`` itself if it is on one patch, or if its line is long enough.
    """
    lines, plan = prepared.lines, changes(prepared.scene)
    if lines is None:
        return prepared
    low, high = (plan.speed or Constant(prepared.scene.motion.entrainment_speed)).range(plan.duration)
    fastest = max(abs(low), abs(high))
    if fastest == 0.0:
        return prepared
    slowest = max(min(abs(low), abs(high)) if low * high > 0 else 0.0, SLOWEST * fastest)
    speeds = np.unique(np.geomspace(fastest, slowest, SPEEDS)) if slowest < fastest else [fastest]
    asked = max(_length(prepared, float(speed)) for speed in speeds)
    held = MOST_CELLS / lines.cells.count * lines.cells.coarse[1]
    if asked <= prepared.surface.size[1] * 1.05:
        return prepared
    surface = lines.line(0, min(asked, held, lines.available))
    return replace(prepared, surface=surface, contact=line_contact(prepared.scene, surface))


def _length(prepared: Prepared, speed: float) -> float:
    """Length of the line [m] at a steady speed; 0 if there is no steady solution that tells it."""
    try:
        return friction(prepared, speed, raise_on_failure=False).uncertainty.length
    except LubfricError:
        return 0.0
