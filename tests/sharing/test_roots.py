"""The bracketed root: known roots, its stopping value, and what it does when there is none."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lubfric._base import increasing_root
from lubfric.errors import CONVERGED, ITERATION_LIMIT

BOUNDS = (-40.0, 40.0)


def counted(f):
    calls = []

    def g(x, last):
        calls.append(x)
        return f(x), x

    return g, calls


@pytest.mark.parametrize(
    "f, root",
    [
        (lambda x: x**3 - 2, 2 ** (1 / 3)),
        (lambda x: math.tanh(x - 3), 3.0),
        (lambda x: 1 - math.exp(5 - x), 5.0),
        (lambda x: math.atan(1e6 * (x + 7)), -7.0),
    ],
)
def test_finds_known_roots(f, root):
    g, calls = counted(f)
    found = increasing_root(g, 0.0, step=0.5, bounds=BOUNDS, tolerance=1e-9)
    assert found.status == CONVERGED and abs(found.value) <= 1e-9
    assert found.x == pytest.approx(root, abs=1e-8)
    assert found.payload == found.x and len(calls) == len(found.history)


@settings(max_examples=60)
@given(st.floats(-30, 30), st.floats(-30, 30), st.floats(0.01, 50))
def test_any_shift_and_stiffness(root, guess, stiffness):
    g, calls = counted(lambda x: math.tanh(stiffness * (x - root)))
    found = increasing_root(g, guess, step=1.0, bounds=BOUNDS, tolerance=1e-6)
    assert found.status == CONVERGED and len(calls) <= 60
    assert abs(found.x - root) <= 1.1e-6 / stiffness + 1e-12 * abs(root)


def test_a_function_of_one_sign_is_reported_not_hidden():
    g, calls = counted(lambda x: 1.0 + math.exp(x / 100))
    found = increasing_root(g, 0.0, step=1.0, bounds=BOUNDS, tolerance=1e-9)
    assert found.status == ITERATION_LIMIT and calls[-1] == BOUNDS[0]


def test_the_evaluation_limit_is_reported():
    g, calls = counted(lambda x: x**3 - 2)
    found = increasing_root(g, 0.0, step=0.5, bounds=BOUNDS, tolerance=1e-15, max_evaluations=4)
    assert found.status == ITERATION_LIMIT and len(calls) == 4
    assert abs(found.value) == min(found.history)


def test_a_known_point_is_not_evaluated_again():
    g, calls = counted(lambda x: math.tanh(x - 1.3))
    found = increasing_root(g, 0.0, step=0.5, bounds=BOUNDS, tolerance=1e-9, first=(math.tanh(-1.3), "known"))
    assert found.x == pytest.approx(1.3, abs=1e-8) and 0.0 not in calls and len(found.history) == len(calls) + 1
    found = increasing_root(g, 1.0, step=0.5, bounds=BOUNDS, tolerance=0.4, first=(math.tanh(-0.3), "known"))
    assert found.payload == "known" and found.x == 1.0


def test_a_first_step_that_nearly_hits_goes_on_by_the_secant():
    """Doubled steps would leave the neighbourhood of the root that Newton's step has reached."""
    g, calls = counted(lambda x: x + 0.01 * x**2 - 1)
    found = increasing_root(g, 0.0, step=5.0, bounds=BOUNDS, tolerance=1e-6, slope=1.05)
    assert found.status == CONVERGED and len(calls) <= 5 and max(calls) < 1.1
