"""A study of many points that is opened: processor time and memory, from records that no solve made.

    python -m verification.campaigns.benchmarks.opened [--points 1000000] [--paired 100000] [--docs docs]

The store returns the encoded record of one solved point, decoded anew, for each point of the plan: curves of 25 speeds,
and operating points with a scene each.
"""

import argparse
import gc
import time
from typing import Any

import numpy as np

import lubfric
from lubfric._base.memory import resident_memory
from lubfric.studies.codec import decode, encode
from lubfric.studies.result import result_of_table
from lubfric.studies.store import Store
from lubfric.studies.study_table import StudyTable

from . import page

# Speeds of a curve.
SPEEDS = 25
# Bytes in a megabyte.
MB = 1e6


class Filled(Store):
    """A store that has the record of one point under every key."""

    def __init__(self, point: Any):
        super().__init__(None)
        self.record = b"".join(encode(point))

    empty = False

    def get(self, key: str, kind: Any = Any) -> Any:
        """Return the point."""
        return decode(self.record, self.classes, kind)


def plan_of(scene: lubfric.Scene, points: int, *, paired: bool) -> lubfric.StudyPlan:
    """Return a plan of so many points."""
    if paired:
        return lubfric.plan_study(
            scene, points={"load [N]": np.linspace(2, 6, points), "speed": np.geomspace(0.01, 1, points)}
        )
    return lubfric.plan_study(
        scene, {"bodies.load": np.linspace(2, 6, points // SPEEDS)}, np.geomspace(0.001, 1, SPEEDS)
    )


def row_of(points: int, *, paired: bool) -> list[str]:
    """Return the row of a study of so many points."""
    scene = lubfric.load_scene("paper").with_(numerics={"sampling": "patch", "model": "paper"})
    store = Filled(lubfric.friction(scene, 0.03).without_fields())
    gc.collect()
    before = resident_memory()
    used = time.process_time()
    plan = plan_of(scene, points, paired=paired)
    planned = time.process_time() - used
    table = StudyTable(plan)
    table.read(store)
    result = result_of_table(table)
    read = time.process_time() - used - planned
    gc.collect()
    memory = resident_memory() - before
    count = result.status.size
    name = "operating points" if paired else f"points, {SPEEDS} on each curve"
    return [
        f"{count} {name}",
        f"{planned:.0f}",
        f"{read:.0f}",
        f"{memory / MB:.0f}",
        f"{memory / count / 1e3:.2f}",
    ]


COLUMNS = ("study", "s for the plan", "s to read", "MB", "kB a point")


def main() -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=1_000_000)
    parser.add_argument("--paired", type=int, default=100_000, help="operating points")
    page.add_option(parser)
    arguments = parser.parse_args()
    rows = []
    for points, paired in ((arguments.points, False), (arguments.paired, True)):
        rows.append(row_of(points, paired=paired))
        print(*rows[-1], sep=" | ", flush=True)
    page.write("opened", COLUMNS, rows[:1], (parser, arguments))


if __name__ == "__main__":
    main()
