"""A process that solves many points does not grow."""

import subprocess
import sys

import numpy as np
import pytest

import lubfric
from lubfric._base import releasing_memory, resident_memory

linux = pytest.mark.skipif(resident_memory() == 0, reason="the system does not say what is resident")


@linux
def test_freed_blocks_go_back_to_the_system():
    """A heap of 400 MB of small blocks, freed but for the last: without a release it stays resident."""
    script = """
import numpy as np
from lubfric._base import releasing_memory, resident_memory
def work():
    kept = [np.ones(12_000) for _ in range(4000)]
    last = np.ones(12_000)
    del kept
    return last
before = resident_memory()
last = (releasing_memory(work) if {release} else work)()
print(resident_memory() - before)
"""
    enlarged = [
        int(
            subprocess.run(
                [sys.executable, "-c", script.replace("{release}", str(way))], capture_output=True, check=True
            ).stdout
        )
        for way in (True, False)
    ]
    assert enlarged[0] < 50e6 < 200e6 < enlarged[1]


@linux
def test_memory_that_a_step_frees_serves_the_next_step():
    """Steps that each fill and free 4 MB in blocks of 80 kB: the system maps pages for the first one only."""
    script = """
import resource
import numpy as np
from lubfric._base import keep_freed_memory
if {kept}:
    keep_freed_memory()
def step():
    return len([np.ones(10_000) for _ in range(50)])
step()
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
for _ in range(20):
    step()
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""
    faults = [
        int(
            subprocess.run(
                [sys.executable, "-c", script.replace("{kept}", kept)], capture_output=True, check=True
            ).stdout
        )
        for kept in ("True", "False")
    ]
    assert faults[0] < 0.1 * faults[1]


@linux
@pytest.mark.slow
def test_points_of_varied_scenes_grow_by_less_than_200_megabytes():
    """The growth from the 20th to the last of 300 points, each of another surface on another grid."""
    draw = np.random.default_rng(3)
    paper = lubfric.load_scene("paper").with_(numerics={"model": "paper"})
    stood = []
    for number in range(300):
        scene = paper.with_(
            contact={"shape": (int(draw.integers(110, 200)), int(draw.integers(110, 200)))},
            surface={"seed": number, "sq": float(draw.uniform(5e-8, 2e-7)), "correlation_length": 6e-6},
            bodies={"load": float(draw.uniform(2, 60))},
        )
        lubfric.friction(scene, float(10 ** draw.uniform(-2.5, -0.5)))
        stood.append(resident_memory())
    assert max(stood[20:]) - stood[0] < 200e6
    assert releasing_memory(len)(stood) == 300


@linux
@pytest.mark.slow
def test_two_thousand_points_of_varied_scenes_leave_little_behind():
    """Resident memory grows by less than 200 MB (by 6 MB in 400 points when it was written)."""
    script = """
import numpy as np
import lubfric
from lubfric._base import resident_memory

paper = lubfric.load_scene("paper")
rng = np.random.default_rng(0)
for i in range(2000):
    scene = paper.with_(
        bodies={"radius": float(rng.uniform(1e-3, 5e-3)), "load": float(rng.uniform(3, 10))},
        contact={"shape": tuple(map(int, rng.integers(48, 80, 2))), "spacing": 0.9e-6},
        surface={"seed": i, "sq": float(rng.uniform(5e-8, 2e-7)), "correlation_length": float(rng.uniform(3e-6, 5e-6))},
        numerics={"model": "paper", "sampling": ("strips", "patch")[i % 2], "sampling_tolerance": 0.5, "tolerance": 0.05},
    )
    try:
        lubfric.friction(scene, float(10 ** rng.uniform(-3, 0)), raise_on_failure=False)
    except lubfric.LubfricError:
        pass
    if i == 20:
        before = resident_memory()
print(resident_memory() - before)
"""
    enlarged = float(subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout)
    assert enlarged < 200e6
