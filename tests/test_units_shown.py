"""Numbers with their intervals: one way for all, in a unit of people, without negative zeros or programmers'
exponents."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lubfric.units import (
    as_beside,
    in_unit_of,
    interval_in_words,
    plain_number,
    unit_for,
    unit_of_largest,
    with_interval,
    worded,
)

SIZES = st.floats(1e-9, 1e6) | st.floats(-1e6, -1e-9)


@pytest.mark.parametrize(
    "numbers, unit, text",
    [
        ((0.0443, 0.0413, 0.0473), "-", "0.0443 (0.0413 to 0.0473 at 95 %)"),
        ((0.0004, -1e-8, 0.0032), "-", "0.0004 (0.0000 to 0.0032 at 95 %)"),
        ((-5.6e-8, -6e-8, -5.2e-8), "-", "-5.60·10⁻⁸ (-6.00·10⁻⁸ to -5.20·10⁻⁸ at 95 %)"),
        ((3.39, 3.36, 3.43), "W", "3.390 W (3.360 to 3.430 W at 95 %)"),
        ((0.0004, 0.0003, 0.0005), "W", "0.40 mW (0.30 to 0.50 mW at 95 %)"),
        ((1390.0, 970.0, 1930.0), "W", "1.39 kW (0.97 to 1.93 kW at 95 %)"),
        ((139.0, math.nan, math.nan), "W", "139 W"),
    ],
)
def test_a_value_with_its_interval(numbers, unit, text):
    assert with_interval(*numbers, unit=unit) == text


@pytest.mark.parametrize(
    "part, numbers, text",
    [
        (1.1649, (1.1651, 1.13, 1.20), "1.165 W"),
        (0.25, (2.0, 1.9, 2.1), "0.25 W"),
        (4.16, (10.8, 7.2, 16.1), "4.2 W"),
        (0.0123, (1.1651, 1.13, 1.20), "12 mW"),
        (0.2, (1.0, math.nan, math.nan), "200 mW"),
    ],
)
def test_a_part_has_the_decimals_of_the_whole_unless_the_interval_is_wider(part, numbers, text):
    assert as_beside(part, *numbers, unit="W") == text


def test_a_deviation_is_in_the_unit_of_its_value():
    assert in_unit_of(1.9e-4, 6.5e6, "Pa") == "1.9·10⁻¹⁰ MPa"
    assert in_unit_of(2.13e5, 6.5e6, "Pa") == "0.21 MPa"
    assert in_unit_of(0.013, 0.12, "-") == "0.013"


@given(SIZES, st.floats(1e-9, 10.0), st.sampled_from(["-", "W", "m", "Pa", "m/s"]))
def test_no_text_has_an_exponent_of_a_programmer_or_a_negative_zero(value, width, unit):
    text = with_interval(value, value - width * abs(value), value + width * abs(value), unit=unit)
    words = text.replace("(", "").split()
    assert "e-" not in text and "e+" not in text
    assert not any(word.startswith("-") and not word.strip("-0.") for word in words)


@given(SIZES)
def test_a_plain_number_is_the_number(value):
    text = plain_number(value, "-", 6)
    mantissa, _, power = text.partition("·10")
    digits = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
    shown = float(mantissa) * 10.0 ** (int(power.translate(digits)) if power else 0)
    assert shown == pytest.approx(value, rel=1e-5)


def test_zero_is_in_the_si_unit():
    assert worded(0.0, "m") == "0 m" and unit_for([], "m") == "m" and plain_number(0.0, "W") == "0 W"
    assert interval_in_words(math.nan, math.nan) == "not known"


def test_a_column_is_in_the_unit_in_which_its_largest_number_reads_well():
    assert unit_of_largest([0.002, 0.003, 39.284], "W") == "W" and unit_of_largest([2e-3, 0.5], "W") == "mW"
    assert unit_of_largest([math.nan, math.inf, -4e-3, 1e-6], "m") == "mm" and unit_of_largest([], "m") == "m"


def test_no_number_is_rounded_above_its_unit():
    assert with_interval(536.2, 373.4, 694.8, unit="W") == "536 W (373 to 695 W at 95 %)"
    assert with_interval(289.6, 214.1, 364.2, unit="W") == "290 W (214 to 364 W at 95 %)"
    assert with_interval(0.0443, 0.0413, 0.0473) == "0.0443 (0.0413 to 0.0473 at 95 %)"


def test_a_small_stress_is_in_pascal():
    assert worded(5.0, "Pa") == "5 Pa" and worded(23.0, "Pa") == "23 Pa" and worded(6e6, "Pa") == "6 MPa"
