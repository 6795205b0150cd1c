"""The cost that a plan foretells, against the processor time that the study takes."""

import time
from dataclasses import replace

import numpy as np
import pytest

import lubfric
from lubfric.studies.cost import ground_of, point_seconds
from lubfric.studies.explain import _costs

PAPER = lubfric.load_scene("paper")
PATCH = PAPER.with_(numerics={"sampling": "patch"})
SMALL = PATCH.with_(contact={"shape": (48, 48), "spacing": 1.1e-6}, surface={"correlation_length": 4e-6})
SPEEDS = np.geomspace(1e-3, 1.0, 9)


def foretold_over_taken(scene, vary, speeds):
    plan = lubfric.plan_study(scene, vary, speeds)
    seconds, begun = _costs(plan)[1], time.process_time()
    result = lubfric.study(plan)
    assert result.missing == 0
    return seconds / (time.process_time() - begun)


def test_the_time_is_foretold_within_a_factor_of_three():
    assert 1 / 3 < foretold_over_taken(SMALL, {"bodies.load": [3.0, 5.5]}, SPEEDS) < 3


@pytest.mark.slow
@pytest.mark.parametrize(
    "scene, vary, speeds",
    [
        (PATCH, {"lubricant.viscosity": [0.03, 0.36]}, np.geomspace(1e-3, 1.0, 30)),
        (SMALL, {"bodies.load": [1.0, 10.0]}, "auto"),
        (PATCH, {"contact.spacing": [0.225e-6], "surface.seed": [3]}, SPEEDS),
        (lubfric.load_scene("flat"), {"bodies.load": [2.0, 5.5]}, SPEEDS),
        (PAPER, {"numerics.sampling_tolerance": [0.05, 0.02]}, SPEEDS),
        (PAPER.with_(surface={"sq": 3e-7}, numerics={"sampling_tolerance": 0.05}), {"bodies.load": [3.0]}, "auto"),
    ],
)
def test_many_plans(scene, vary, speeds):
    assert 1 / 3 < foretold_over_taken(scene, vary, speeds) < 3


def test_a_longer_line_is_foretold_to_cost_more():
    """A tenth of the error takes up to a hundred times the length; beside it, what every point costs."""
    ground = replace(ground_of(PAPER, False), transform=1e-3)
    dear, cheap = (
        point_seconds(PAPER.with_(numerics={"sampling_tolerance": share}), ground, 0.03, 1e-2) for share in (0.01, 0.1)
    )
    assert 5 * cheap < dear < 100 * cheap


def test_what_is_not_foretold_is_said():
    one_way = PATCH.with_(numerics={"closure": "one-way"})
    assert "not foretold" in lubfric.plan_study(one_way, {}, SPEEDS).explain()
    assert "about 12 speeds that each curve chooses" in lubfric.plan_study(SMALL, {}, "auto").explain()
