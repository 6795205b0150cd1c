"""``python -m verification charts``: error against time, measured on this machine.

Times are processor seconds, which another job on the machine changes less than it changes the time by the clock. What
is measured is kept in the folder: the same command draws it again.
"""

import importlib
from collections.abc import Iterator

from ... import frame
from ...check import Check, Item, Table
from ...kept import Run

CHARTS = {
    "contact": "Dry contact: error against time",
    "film": "Smooth film: error against time",
    "quick_answer": "Load sharing and the deterministic model on random contacts: error against time",
    "models": "Both models on four kinds of surface: error against time per point",
    "rolling": "Rolling contacts: error against time of one strip, before and after, and of load sharing",
}
PARTS = [(name, "charts:chart", title, {"name": name}) for name, title in CHARTS.items()]
COMMAND = frame.campaign("charts", __doc__, PARTS, ("full", "quick"))


def chart(level: str, name: str, run: Run = Run()) -> Iterator[Item]:
    """Every method at every setting, measured in turn on this machine."""
    from . import draw, measure

    module = importlib.import_module(f"verification.campaigns.charts.{name}")
    ((_, where),) = run.solved({"machine": None}, measure.machine, f"{name}-machine")
    rows = run.solved(module.cases(quick=level == "quick"), module.measured)
    points = [Check.from_dict(values) for _, row in rows for values in row]
    yield from points
    yield Table(f"{name}_machine", "Where and when the points were measured", ("machine",), ((where,),))
    if name == "contact":
        yield draw.methods_table(points)
    drawn = getattr(module, "drawn", draw.work_precision)  # a chart of quartiles is drawn by its own module
    yield drawn(name, points, where)
