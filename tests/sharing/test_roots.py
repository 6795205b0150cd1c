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
