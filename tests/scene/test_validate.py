"""Checks of values: only real numbers pass, whatever else NumPy would make a number of."""

import datetime
import decimal
import fractions
import sys

import numpy as np
import pytest

from lubfric._base import validate
from lubfric.errors import InputError

NO_NUMBERS = [
    *(True, np.True_, "1", b"1", 1 + 0j, None, {}, object(), float("nan"), float("inf"), 10**400, 10**5000),
    *(np.ma.masked, np.datetime64("2020"), np.timedelta64(1, "s"), datetime.date(2020, 1, 1)),
    *([1], np.array([1.0]), np.array(object=True), decimal.Decimal("1e999")),
]


@pytest.mark.parametrize("value", NO_NUMBERS, ids=lambda v: type(v).__name__)
def test_what_is_no_number_is_refused(value):
    with pytest.raises(InputError, match="length") as caught:
        validate.number("length", value, "m")
    assert len(str(caught.value)) < 300 and "allowed" in str(caught.value)


@pytest.mark.parametrize(
    "value", [2, 2.0, np.float32(2), np.int8(2), np.array(2.0), fractions.Fraction(2), decimal.Decimal(2)]
)
def test_every_kind_of_real_number_is_one(value):
    assert validate.number("length", value, "m") == 2.0


NO_ARRAYS = [
    *([True, 1.0], [1, "2"], ["1"], [1j], [None, 1.0], [b"1"], [10**400], [[1], [1, 2]], [], [float("inf")]),
    {1.0, 2.0},
    *(np.ma.array([1.0, 2.0], mask=[False, True]), [np.ma.masked, 1.0], np.zeros(3, bool), np.zeros(2, [("a", float)])),
    *(np.array(["2020"], "M8[D]"), np.array([1], "m8[s]"), [datetime.date(2020, 1, 1)], "123", object()),
]


@pytest.mark.parametrize("value", NO_ARRAYS, ids=lambda v: type(v).__name__)
def test_what_is_no_array_of_numbers_is_refused(value):
    with pytest.raises(InputError, match="lengths"):
        validate.array("lengths", value, "m", ndim=1)


def test_arrays_of_numbers_of_every_kind_pass():
    for value in ([1, 2], (1.0, 2.0), range(1, 3), np.float32([1, 2]), np.ma.array([1, 2]), np.array([1, 2], object)):
        result = validate.array("lengths", value, "m", ndim=1)
        assert result.dtype == float and result.tolist() == [1.0, 2.0] and type(result) is np.ndarray


@pytest.mark.parametrize("value", [[], np.zeros(3), True, None, 3, "x" * 10**6, {}])
def test_choice_takes_any_rubbish(value):
    with pytest.raises(InputError) as caught:
        validate.choice("axis", value, ("x", "y"))
    assert len(str(caught.value)) < 200


def test_whole_numbers_and_truth_values():
    assert validate.integer("n", np.int16(3), minimum=0, maximum=3) == 3
    assert validate.boolean("b", np.False_) is False
    for value in (1.0, True, "3", 4, -1, 10**5000, np.timedelta64(2, "s"), None):
        with pytest.raises(InputError, match="n = "):
            validate.integer("n", value, minimum=0, maximum=3)
    for value in ("no", 0, None, [True]):
        with pytest.raises(InputError, match="b = "):
            validate.boolean("b", value)
    for value in ((1, 2, 3), [[1], [2, 3]], "1", {1: 2}, [1, True], np.zeros((2, 2))):
        with pytest.raises(InputError, match="spacing"):
            validate.spacing("spacing", value)


def test_a_value_that_cannot_be_shown_is_named_by_its_type():
    assert validate.shown(10**5000) == "<int>" if sys.get_int_max_str_digits() else True
    assert len(validate.shown([1.0] * 10**4)) <= validate.LONGEST_SHOWN
