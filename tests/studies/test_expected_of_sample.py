"""What is known of a sample before the solve: whether f will have an interval, and its sampling error where it is
large."""

import numpy as np
import pytest
from instrument_files import write_x3p
from small_study import SCENE

import lubfric
from lubfric.estimate import WorkOfPoints, expected_of_sample
from lubfric.models.shared import Assumption
from lubfric.samples import sample_of


@pytest.mark.parametrize("cells, speed", [(48, 0.003), (48, 0.3), (120, 0.003)], ids=["short", "separated", "long"])
def test_a_study_states_before_the_solve_that_f_will_have_no_interval(cells, speed):
    """With the settings of the documents no point of 144 had one, and only the result said so."""
    plan = lubfric.plan_study(SCENE.with_(contact={"shape": (48, cells)}), {"bodies.load": [3.0, 4.0]}, [speed])
    known = np.isfinite(lubfric.study(plan)["interval_low"])
    is_announced = "no 95 % interval where asperities touch" in plan.explain()
    assert known.all() or not known.any()
    assert is_announced == (not known.any()) == (cells == 48 and speed == 0.003)


def test_a_sampling_error_far_above_its_target_is_expected_before_the_solve(tmp_path):
    """To a factor of 3, a part of which is the error of an error."""
    surface = lubfric.generate_surface((64, 100), (1e-6, 1e-6), sq=80e-9, correlation_length=4e-6, seed=3)
    path = write_x3p(tmp_path / "short.x3p", surface.heights, steps=surface.spacing)
    rough = {"file": path, "sq": None, "correlation_length": None, "form": "plane"}
    scene = lubfric.load_scene("paper").with_(surface=rough, numerics={"model": "paper"})
    sample = sample_of(scene)
    (stated,) = _expected(scene, sample, 0.02)
    assert stated.assumption == Assumption.LARGE_ENOUGH_MAP
    solved = lubfric.friction(scene, 0.02).uncertainty
    assert 1 / 3 < 0.01 * stated.value / (2.04 * solved.sampling) < 3
    assert not _expected(scene.with_(numerics={"sampling_tolerance": 0.5}), sample, 0.02)


def _expected(scene, sample, speed):
    point = WorkOfPoints(scene, sample, sample.stated_map()).at(speed)
    return [violation for _, violation in expected_of_sample(scene, sample, [point])]
