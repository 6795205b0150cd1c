"""What a study or a fit will take, before a point is solved: its points, and the time of one by the work counted on the
scene."""

import time
from collections.abc import Sequence
from textwrap import shorten

from ..errors import InputError
from ..quantities import KEYS
from ..sampling import forecast
from ..sharing import Prepared, prepare
from ..units import worded
from .choose import CHOSEN, first_speeds
from .points import stored_rows
from .store import Store

SAMPLED = 8  # scenes of a study that are made ready to count their cells
LONGEST = 80  # letters of the values of a key


def curve_seconds(prepared: Prepared, speeds: Sequence[float]) -> float:
    """Processor seconds of the points of a scene at ``speeds`` [m/s] (none: at those that it chooses), within a factor
    of about 4."""
    at = speeds or first_speeds(prepared.scene, prepared.surface.sq)
    found = [forecast(prepared.scene, prepared.strips, prepared.surface, speed).seconds for speed in at]
    return sum(found) * (1.0 if speeds else CHOSEN / len(at))


def in_words(seconds: float) -> str:
    """A time in a suitable unit."""
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds > 2 * size:
            return f"{float(f'{seconds / size:.2g}'):g} {unit}"
    return f"{float(f'{seconds:.2g}'):g} s"


def explain(plan, store=None) -> str:
    """The points of a `StudyPlan`, how many of them the folder ``store`` has already, and about how long the rest will
    take, in words. Some of the maps are made. No point is solved."""
    lines = [f"study of {plan.scene.name}: {'' if plan.speeds else 'about '}{plan.points} points"]
    for axis in plan.axes:
        columns = dict(zip(axis.keys, zip(*axis.values)))
        words = {k: worded(column, KEYS[k].unit if k in KEYS else "-") for k, column in columns.items()}
        shown = ", ".join(f"{key} {shorten(text, LONGEST, placeholder='...')}" for key, text in words.items())
        lines.append(f"  {len(axis.values):6d} x {shown}")
    if plan.speeds:
        lines.append(f"  {len(plan.speeds):6d} speeds, {min(plan.speeds):g} to {max(plan.speeds):g} m/s")
    else:
        lines.append(f"      about {CHOSEN} speeds that each curve chooses")
    if plan.scene.transient is not None:
        lines.append("  steady   every point; what changes in time in the scene ([transient]) is left out")
    rows, ended = stored_rows(Store(store), plan.keys, plan.speeds)
    left = [
        (scene, tuple(u for u in plan.speeds if u not in rows[key]))
        for key, scene in dict(zip(plan.keys, plan.scenes)).items()
        if key not in ended and not (plan.speeds and len(rows[key]) == len(plan.speeds))
    ]
    held = sum(map(len, rows.values())) if plan.speeds else len(ended)
    if held:
        total, what = len(rows) * max(len(plan.speeds), 1), "points" if plan.speeds else "curves"
        lines.append(f"  kept     {held} of {total} {what} are in {store} already")
    if not left:
        return "\n".join([*lines, "  time     nothing is left to solve"])
    some = left[:: -(-len(left) // SAMPLED)]
    seconds, failed = 0.0, []
    for scene, speeds in some:
        try:
            begun = time.process_time()  # of the map, which takes its time as well
            counted = curve_seconds(prepare(scene), speeds) + time.process_time() - begun
            seconds += counted * len(left) / len(some)
        except InputError as error:
            failed.append(f"  cannot be solved: {error}")
    lines.append(f"  time     about {in_words(seconds)} on one core (within a factor of about 4)")
    return "\n".join([*lines, *dict.fromkeys(failed)])
