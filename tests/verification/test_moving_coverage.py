"""The judge of moving answers, on tables whose coverage is known."""

import math

import numpy as np
import pytest

from lubfric.models.deterministic.cells_in_motion import NARROW_GAPS
from verification.campaigns import table_file
from verification.campaigns.moving_cells.table import COLUMNS, TABLE, errors
from verification.campaigns.moving_controls import variance_left
from verification.campaigns.moving_coverage.items import coverage
from verification.campaigns.moving_coverage.table import ANSWER_COLUMNS, ANSWERS, REFERENCE_COLUMNS, REFERENCES
from verification.check import Check, Table


@pytest.mark.parametrize("inside, passes", [(19, True), (15, False)])
def test_answers_that_miss_the_reference_lower_the_coverage(tmp_path, inside, passes):
    """The reference is .05 times .9, the limit of .925 on cells half as long. Answers .045 and .053 have a half-width
    of 5 %, 30 degrees of freedom."""
    for seed in range(2):
        row = {"contact": "gear flank", "kind": "strip", "seed": seed, "f": 0.05, "error": 1e-6, "failure": ""}
        table_file.append(tmp_path / REFERENCES, REFERENCE_COLUMNS, row, 7)
        row |= {"kind": "cells", "f": 0.925, "error": 0.0}
        table_file.append(tmp_path / REFERENCES, REFERENCE_COLUMNS, row, 7)
    cells = {
        "change": 0.0,
        "film_ratio": 1.0,
        "sliding_share": 1.0,
        "coarse_x": 0.0,
        "coarse_y": 0.0,
        "coarse_b": 0.0,
        "follows_lubricant": 1,
        "is_smooth": 1,
    }
    for seed in range(20):
        f = 0.045 if seed < inside else 0.053
        row = {"contact": "gear flank", "seed": seed, "f": f, "sampling": 0.02, "freedom": 30} | cells
        table_file.append(
            tmp_path / ANSWERS, ANSWER_COLUMNS, row | {"by_longer": 0.09, "seconds": 1.0, "work": 2.0, "failure": ""}, 7
        )
    table, check, _ = coverage("quick", folder=tmp_path)
    assert isinstance(table, Table) and isinstance(check, Check)
    assert check.measured == pytest.approx(inside / 20) and check.passed is passes
    assert list(table.rows[0][:2]) == ["gear flank", "20"]


def test_the_limit_is_that_of_second_order(tmp_path):
    """f = .05 + .004 h² on cells of h = 1, 1/2, 1/4."""
    for halvings in range(3):
        f = 0.05 + 0.004 / 4**halvings
        row = {
            "contact": "gear flank",
            "seed": 0,
            "axis": "x",
            "halvings": halvings,
            "f": f,
            "twice": 1.2 * f,
            "half": f,
            "failure": "",
        }
        row |= {"coarse": 0.25, "follows": 1}
        table_file.append(tmp_path / "table.csv", COLUMNS, row, 12)
    (strip,) = errors(tmp_path / "table.csv")
    assert strip["limit"] == pytest.approx(0.05) and strip["error"] == pytest.approx(0.08)
    assert strip["order"] == pytest.approx(2.0)
    assert strip["expected"] == pytest.approx(1 - math.exp(-NARROW_GAPS[0] * math.log(1.2, 4) / 16))


def test_the_stated_error_holds_that_of_the_cells():
    """On strips of random contacts and of the contacts with names: as often as an error at 95 % should, and it is not
    larger than it has to be: the errors have a root mean square above a quarter of it."""
    strips = [strip for strip in errors(TABLE) if strip["axis"] == "xy"]
    assert len({strip["contact"] for strip in strips}) >= 25
    left = np.array([strip["left"] / strip["stated"] for strip in strips])
    assert np.mean(np.abs(left) <= 1.0) >= 0.85 and np.sqrt(np.mean(left**2)) > 0.25


def test_a_control_leaves_the_variance_that_a_line_in_it_does_not_explain():
    """f = 3 c + noise: the variance of the noise over all, 1/10, on average over samples of eight strips."""
    rng = np.random.default_rng(1)
    left = []
    for _ in range(2000):
        control = rng.standard_normal(8)
        left.append(variance_left(3 * control + rng.standard_normal(8), control))
    assert np.mean(left) == pytest.approx(0.1, rel=0.4)
    assert (
        variance_left(control, 5 - 2 * control) == pytest.approx(0, abs=1e-12)
        and variance_left(control, 0 * control) == 1
    )
