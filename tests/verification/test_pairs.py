"""Pairs of similar designs, and what a study takes of their model-form errors."""

import numpy as np
import pytest

from verification.campaigns.calibration import pairs
from verification.campaigns.calibration.case import drawn


def test_differences_of_designs_are_within_the_error_that_a_study_takes():
    checks = list(pairs.coverage("full"))
    assert all(check.passed for check in checks)
    (with_it, without) = (np.array([check.measured for check in checks[start::2]]) for start in (0, 1))
    assert np.all(with_it <= without)


def test_errors_that_are_equal_differ_by_nothing_and_opposite_ones_by_both_half_widths():
    names = ("error", "half_width", "other_error", "other_half_width")

    def row(*values):
        return {f"quick_{name}": str(value) for name, value in zip(names, values)}

    assert pairs.share_within([row(0.1, 0.1, 0.1, 0.1)], "quick", 1.0) == 1.0
    assert pairs.share_within([row(0.1, 0.1, -0.1, 0.1)], "quick", 0.0) == 0.0
    assert pairs.share_within([row(0.1, 0.1, -0.1, 0.1)], "quick", -1.0) == 1.0


@pytest.mark.parametrize("key", pairs.KEYS)
def test_a_changed_case_has_one_input_changed(key):
    case = drawn("rest", 1)
    other = pairs.changed(case, key, 2.0)
    values = {
        "sq": (case.surface.sq, other.surface.sq),
        "viscosity": (case.scene.lubricant.viscosity, other.scene.lubricant.viscosity),
        "radius": (case.scene.bodies.radius, other.scene.bodies.radius),
        "length": (case.surface.spacing[0], other.surface.spacing[0]),
        "friction": tuple(each.scene.bodies.boundary_friction_coefficient for each in (case, other)),
    }
    for name, (before, after) in values.items():
        assert after == pytest.approx((2.0 if name == key else 1.0) * before)
    assert other.scene.bodies.load == pytest.approx(case.scene.bodies.load)
