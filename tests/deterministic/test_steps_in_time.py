"""How many Newton steps the steps in time of moving roughness take: counted, not timed."""

from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from lubfric.models.deterministic import ECONOMICAL, TIGHT, moments, moving_strip, solve_moving_strip, travelling
from verification.campaigns.calibration.case import drawn


def test_the_first_steps_from_rest_take_no_more_than_twice_those_that_follow():
    """The change from rest to motion does not go on: taken on, the first step took 29 Newton steps, the next ones 8."""
    case = drawn("rolling", 3)
    effort = replace(ECONOMICAL, discarded=0.1)
    rest = moving_strip.strip_at_rest(case.scene, case.bodies, case.speed, effort=effort)
    step = rest.problem.spacing[0] / case.speed
    passing = moments(
        travelling(rest.problem, case.bodies),
        step,
        start=rest.result.state,
        tolerance=effort.residual * rest.problem.x.size,
        carries_imbalance=True,
        linear_accuracy=effort.linear,
        shift=1,
    )
    steps = [moment.work.factorisations for moment in islice(passing, 1, 8)]
    assert max(steps[:2]) <= 2 * np.median(steps[2:])


def test_steps_of_a_narrow_contact_begin_with_the_pressure_moved(monkeypatch):
    """Of five cells in the half-width: a fifth less work than from the pressure where it was, and the same friction."""
    case = drawn("rolling", 1)
    assert case.scene.line_contact(case.speed).half_width < 8 * case.bodies[0].surface.spacing[0]

    def followed():
        effort = replace(TIGHT, discarded=0.4)
        strip = solve_moving_strip(case.scene, case.bodies, case.speed, most_steps=4, effort=effort)
        return strip.work - strip.rest.work, strip.result.coefficient

    moved, friction = followed()
    monkeypatch.setattr(moving_strip, "cells_in_a_step", lambda *_: 0)
    resting, same_friction = followed()
    assert moved < 0.8 * resting
    assert friction == pytest.approx(same_friction, rel=1e-3)
