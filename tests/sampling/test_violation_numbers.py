"""Numbers in the sentence of a violated assumption."""

import math

import pytest

from lubfric.models.shared import Violation


@pytest.mark.parametrize(
    "value, shown",
    [(8786.0, "8790"), (999.4, "999"), (999.6, "1000"), (0.0305, "0.0305"), (2.5e6, "2.5e+06"), (-4321.0, "-4320")],
)
def test_value_has_three_digits_and_no_power_of_ten_up_to_a_million(value, shown):
    violation = Violation(what="it", value=value, limit=math.nan, unit="%", consequence="why", remedy="")
    assert violation.text == f"warning: it is {shown} %. Why."
