"""The rule of the economical march, against the table of random rolling contacts that a campaign wrote."""

import numpy as np
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


def test_the_page_states_the_differences_of_the_table(root):
    """Both rows of docs/measurements.md: contacts, f and asperity load ratio (rms, largest), from table.csv."""
    groups = {True: [], False: []}
    for row in differences():
        if row["variant"] == "economical":
            case, _ = case_of(int(row["seed"]))
            effort = effort_for(case.scene.line_contact(case.speed), float(row["sq"]), case.facts["dx"])
            groups[effort is ECONOMICAL].append((row["f"], row["share"]))
    page = (root / "docs" / "measurements.md").read_text(encoding="utf-8")
    for words, is_economical in (("uses economical steps", True), ("uses tight steps", False)):
        values = np.abs(groups[is_economical])
        f, load = np.sqrt(np.mean(values**2, axis=0))
        f_most, load_most = values.max(axis=0)
        numbers = f"{len(values)} | {f:.2%}, {f_most:.2%} | {load:.4f}, {load_most:.4f}".replace("%", " %")
        assert numbers in next(line for line in page.splitlines() if words in line and line.startswith("|"))
