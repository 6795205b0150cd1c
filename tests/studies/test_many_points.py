"""Ten thousand points: what a study adds to each in time and memory. The points themselves are canned."""

import os
import time
from pathlib import Path

import numpy as np
import pytest
from small_study import SCENE

import lubfric
from lubfric.studies import points

COUNT = 10_000
MOST_SECONDS = 0.02  # processor time added to a point: a study of a million then adds hours on one core, not days
MOST_BYTES = 4_000  # of memory that grows with the number of points; a result with its uncertainty has some 20,000


def resident():
    """Memory that this process holds now [bytes]."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="needs /proc to read the memory of the process")
def test_a_point_of_a_large_study_costs_little_time_and_memory(monkeypatch, tmp_path):
    prepared = lubfric.prepare(SCENE)
    canned = lubfric.friction(prepared, 0.01).without_fields()
    monkeypatch.setattr(points, "prepare", lambda scene: prepared)
    monkeypatch.setattr(points, "outcome_of", lambda *_, **__: canned)
    loads = np.linspace(3.0, 5.0, COUNT // 4).tolist()
    begun = time.process_time()
    plan = lubfric.plan_study(SCENE, {"bodies.load": loads}, [0.01, 0.02, 0.04, 0.08])
    before = resident()
    result = lubfric.study(plan, store=tmp_path)
    enlarged = resident() - before
    assert result["coefficient"].size == COUNT and (result["coefficient"] == canned.coefficient).all()
    assert (time.process_time() - begun) / COUNT < MOST_SECONDS
    assert enlarged / COUNT < MOST_BYTES
    monkeypatch.setattr(points, "outcome_of", None)  # all of them are kept
    begun = time.process_time()
    assert (lubfric.study(plan, store=tmp_path)["power_loss"] == canned.power_loss).all()
    assert (time.process_time() - begun) / COUNT < MOST_SECONDS
