"""The study of the levels: what it makes of solves, kept lines and charts, without a solve."""

import json
import math

import pytest

from verification.check import Check
from verification.levels import charts, measure, switches
from verification.report import finite

SHARED = {"index": 3, "cells": 100, "prepare": 1.0, "seconds_full": 3.0, "seconds_reference": 8.0}


def compared(f, tolerance=1e-2, reference=None, **found):
    found = {"f": f, "seconds": 2.0, "film": "ehl", "contact": "none", "film_share": 0.5} | found
    return measure.compared(3, tolerance, found, reference or {"f": 0.1}, SHARED)


def test_three_times_the_tolerance_passes_and_no_more():
    assert compared(0.1029).passed and not compared(0.1031).passed
    assert compared(0.1005).deviation == pytest.approx(0.005)


def test_a_scene_that_was_not_solved_fails_and_says_why():
    lost = compared(None, error="ConvergenceError: x")
    assert lost.failed and lost.refused == "ConvergenceError: x"
    assert "reference" in compared(0.1, reference={"error": "InputError: y", "seconds": 1.0}).refused


def test_kept_lines_come_back():
    for check in (compared(0.1), compared(None, error="ConvergenceError: x")):
        back = Check.from_dict(json.loads(json.dumps(finite(check.as_dict()))))
        assert back.at == check.at and back.passed == check.passed
        assert math.isnan(back.measured) == math.isnan(check.measured)


def test_savings_are_medians_of_ratios():
    found = measure.savings([compared(0.1), compared(0.1, seconds=4.0), compared(0.1, seconds=1.0)])
    assert found == {"reference": 4.0, "reference with the surface made": 3.0, "everything at 1 %": 1.5}


def test_jump_between_levels():
    at = {"scene": "paper", "level": "a", "speed": 1.0}
    rows = [Check("1", 1.0, 1.0, 0.1, "s", at=at), Check("2", 1.01, 1.0, 0.1, "s", at=at | {"level": "b"})]
    assert switches.jumps(rows) == pytest.approx([0.01])
    assert switches.jumps([rows[0], rows[0]]) == []
    assert charts.continuity(rows).data[:4] == b"\x89PNG"


def test_chart_of_the_saving():
    found = [compared(0.1 + 1e-4 * k, tolerance) for tolerance in measure.TOLERANCES for k in range(3)]
    assert charts.error_against_saving(found).data[:4] == b"\x89PNG"
