"""A longer stack of strips goes on from a shorter one."""

import numpy as np
import pytest
from scene_text import paper_scene

from lubfric.contact import strips

PAPER = paper_scene()


@pytest.mark.parametrize("change", [{}, {"counterface": {"sq": 5e-8, "correlation_length": 8e-6}}])
def test_no_strip_is_made_twice_and_each_is_that_of_a_fresh_stack(change, monkeypatch):
    made, original = [], strips.surface_generator

    def counted(*args, **kwargs):
        make = original(*args, **kwargs)
        return lambda seed: (made.append(seed), make(seed))[1]

    fresh = strips.strips_of(PAPER.with_(**change)).stack(5)
    grown = strips.strips_of(PAPER.with_(**change))
    monkeypatch.setattr(strips, "surface_generator", counted)
    stacks = [grown.stack(count) for count in (2, 5, 3)]
    assert len(made) == len(set(made)) == 5 * (2 if change else 1)
    np.testing.assert_array_equal(stacks[1].heights, fresh.heights)
    assert stacks[2].shape[1] * 5 == fresh.shape[1] * 3


def test_strips_beyond_what_is_kept_are_made_again_to_the_bit(monkeypatch):
    monkeypatch.setattr(strips, "KEPT_CELLS", 0)
    again = strips.strips_of(PAPER)
    again.stack(2)
    np.testing.assert_array_equal(again.stack(3).heights, strips.strips_of(PAPER).stack(3).heights)
