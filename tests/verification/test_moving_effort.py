"""The rule of the economical march, against the table of random rolling contacts that a campaign wrote."""

import pytest

from lubfric.models.deterministic import ECONOMICAL, effort_for
from verification.campaigns.moving_effort.table import case_of, differences

MOST_OF_F = 5e-3  # relative
MOST_OF_LOAD = 5e-3  # of the whole load


def test_where_the_march_is_economical_it_was_seen_to_change_little():
    rows = [row for row in differences() if row["variant"] == "economical"]
    assert len(rows) >= 20
    economical = 0
    for row in rows:
        case, _ = case_of(int(row["seed"]))
        contact = case.scene.line_contact(case.speed)
        if effort_for(contact, float(row["sq"]), case.facts["dx"]) is ECONOMICAL:
            economical += 1
            assert row["f"] == pytest.approx(0.0, abs=MOST_OF_F), row
            assert row["share"] == pytest.approx(0.0, abs=MOST_OF_LOAD), row
    assert economical >= len(rows) / 3
