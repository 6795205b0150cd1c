"""The law of the work of a step in time of moving roughness: its constants are the fit of its campaign, whose rows can
be solved again."""

import numpy as np
import pytest

from lubfric.models.deterministic import COEFFICIENTS
from verification.campaigns import table_file
from verification.campaigns.rolling_work.table import TABLE, ContactOnCells, fitted, parts_within


def test_the_constants_of_the_law_are_the_fit_of_the_table():
    assert np.allclose(COEFFICIENTS, fitted(), atol=6e-4)


def test_seven_of_eight_contacts_are_within_a_factor_of_two_of_the_fit_to_the_others():
    assert parts_within()[2.0] >= 7 / 8


def test_a_contact_of_the_table_is_solved_again_with_the_same_work():
    row = next(row for row in table_file.rows(TABLE) if (row["number"], row["cells"]) == ("2", "long"))
    assert ContactOnCells(2, "long").row()["work"] == pytest.approx(float(row["work"]), rel=0.05)
