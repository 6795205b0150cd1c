"""Numbers in the sentence of a violated assumption."""

import math
import re
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lubfric.estimate.uncertainty import Uncertainty
from lubfric.models.shared import (
    ModelErrorPart,
    Violation,
    gathered,
    gathered_in_table,
    gathered_on_curve,
    percent_beside,
    percent_or_less,
    rise_in_words,
    violations_by_model_error,
)


@pytest.mark.parametrize(
    "value, shown",
    [(8786.0, "8790"), (999.4, "999"), (999.6, "1000"), (0.0305, "0.0305"), (2.5e6, "2.5e+06"), (-4321.0, "-4320")],
)
def test_value_has_three_digits_and_no_power_of_ten_up_to_a_million(value, shown):
    violation = Violation(what="it", value=value, limit=math.nan, unit="%", consequence="why", recommendation="")
    assert violation.text == f"warning: it is {shown} %. Why."


@given(st.floats(1e-4, 10.0), st.floats(1e-4, 1e-2))
def test_a_value_and_its_target_are_distinguished(target, beyond):
    """A number that is above its target does not print as it."""
    value = target * (1 + beyond)
    (stated, allowed) = percent_beside(value, target)
    assert stated != allowed
    violation = Violation(what="it", value=value, limit=target, unit="%", consequence="why", recommendation="")
    (shown, limit) = re.findall(r"is (\S+) %, above (\S+) %", violation.text)[0]
    assert float(shown) > float(limit)


def test_errors_of_an_f_near_zero_are_in_f_itself():
    """The same numbers as relative to f, and the signs of an f below 0 as of its interval."""
    known = Uncertainty(
        coefficient=-1e-3,
        numerical=0.002,
        sampling=0.0,
        freedom=4.0,
        interval=(-3.5e-3, -8e-4),
        model=2.5,
        model_sides=(0.2, 2.5),
        not_given=0.0,
        inputs=0.0,
        by_limit=0.0,
        line_scatter=0.0,
        effective_contacts=1e3,
        length=1e-3,
        area_needed=1.0,
    )
    assert known.budget_in_words["model-form"] == "-0.0025 to +0.0002"
    assert known.budget_in_words["numerical"] == "2e-06" and "f itself, which is below 0.005" in known.text
    usual = replace(known, model=0.9, model_sides=(0.2, 0.9))
    assert usual.budget_in_words["model-form"] == "-20 to +90 %" and "below 0.005" not in usual.text


def test_a_warning_of_the_error_of_an_f_near_zero_is_in_f_itself():
    (relative,) = violations_by_model_error(0.2, tolerance=0.05, f=0.04, has_interval=True)
    assert "is 20 %, above 5 %" in relative.text and relative.recommendation == "use f with its interval"
    (itself,) = violations_by_model_error(88.0, tolerance=0.05, f=-1e-5, has_interval=False)
    assert "of f below 0.005, in f itself, is 0.00088, above 5e-07." in itself.text
    assert not itself.recommendation  # f has no interval
    assert not list(violations_by_model_error(0.04, tolerance=0.05, f=1e-5, has_interval=True))


@pytest.mark.parametrize("other, is_note", [(0.04, True), (0.06, False)])
def test_an_error_that_is_usual_for_the_model_is_a_note_unless_the_others_are_too_large(other, is_note):
    parts = [
        ModelErrorPart(sides=(0.2, 0.2), cause="long cells", is_usual=True),
        ModelErrorPart(sides=(other, other), cause="heat"),
    ]
    (violation,) = violations_by_model_error(0.21, tolerance=0.05, f=0.04, has_interval=True, parts=parts)
    assert violation.is_note == is_note and "long cells" in violation.text
    assert ("is a warning, because the other parts, 6 %, are above the limit" in violation.text) != is_note
    assert ("is a note, because that part is usual for this model" in violation.text) == is_note


def test_values_on_both_sides_of_a_range_are_two_sentences():
    """A value below the range is not reported as above it."""

    def at(value, limit):
        return (
            Violation(what="lambda ratio", value=value, limit=limit, unit="", consequence="why", recommendation=""),
        )

    lines = gathered([(1.0, at(0.03, 0.05)), (2.0, at(0.04, 0.05)), (3.0, at(5.0, 3.0))])
    assert lines == (
        "at 2 speeds, 1 and 2 m/s: warning: lambda ratio is 0.03 (at 1 m/s) to 0.04 (at 2 m/s), below 0.05. Why.",
        "at 3 m/s: warning: lambda ratio is 5, above 3. Why.",
    )
    rows = [at(*pair) for pair in ((0.03, 0.05), (5.0, 3.0))]
    assert [each.text for each in gathered_in_table(rows)] == [
        "At point 1: lambda ratio is 0.03, below 0.05. Why.",
        "At point 2: lambda ratio is 5, above 3. Why.",
    ]


def test_a_group_states_the_range_of_its_limits_where_they_differ():
    """So that no value of the group is above a limit of another point."""

    def error(value, limit):
        return Violation(what="error", value=value, limit=limit, unit="%", consequence="why", recommendation="")

    rows = [(error(5.48, 5.1),), (error(38.4, 5.55),)]
    words = "above their limits, 5.1 to 5.55 %. Why."
    (in_table,) = gathered_in_table(rows)
    (on_curve,) = gathered_on_curve(list(enumerate(rows)))
    assert in_table.statement == f"error is 5.48 to 38.4 % (at point 2), {words}"
    assert on_curve.statement == f"error is 5.48 % (at 0 m/s) to 38.4 % (at 1 m/s), {words}"
    (alike,) = gathered_in_table([(error(5.48, 5.1),), (error(38.4, 5.1),)])
    assert alike.statement.endswith(", above 5.1 %. Why.")


def test_violations_are_sorted_by_the_size_of_their_effect_on_f():
    """Severe ones first, those of an unknown effect last, on a curve and in a table."""

    def about(what, effect=math.nan, *, severe=False):
        words = {"value": 2.0, "limit": 1.0, "unit": "", "consequence": "why", "recommendation": ""}
        return Violation(what=what, effect=effect, severe=severe, **words)

    rows = [
        (about("no effect known"), about("small", 0.01)),
        (about("large", 0.02), about("small", 0.3), about("b", severe=True)),
    ]
    order = ["b", "small", "large", "no effect known"]
    assert [each.violation.what for each in gathered_on_curve(list(enumerate(rows)))] == order
    assert [each.violation.what for each in gathered_in_table(rows)] == order


@pytest.mark.parametrize(
    "part, text", [(0.0, "0 %"), (9e-5, "less than 0.01 %"), (1e-4, "0.01 %"), (0.123, "12 %"), (0.999, "100 %")]
)
def test_a_part_that_does_not_matter_has_no_digits(part, text):
    assert percent_or_less(part) == text
    assert percent_or_less(part, before="at most ") == (text if "less" in text else f"at most {text}")


@pytest.mark.parametrize("rise, text", [(6e-5, "less than 0.1 K"), (0.1, "up to 0.1 K"), (123.0, "up to 120 K")])
def test_a_temperature_rise_that_does_not_matter_has_no_digits(rise, text):
    assert rise_in_words(rise) == text
