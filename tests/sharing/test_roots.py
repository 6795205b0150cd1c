"""The bracketed root: known roots, its stopping value, and what it does when there is none."""

import math

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
