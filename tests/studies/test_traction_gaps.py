"""Where the points of a traction curve do not show f between them."""

import numpy as np
import pytest

from lubfric.studies import gaps_of


def eyring(ratio):
    """f of an Eyring oil: linear up to a ratio of 0.001, then with its logarithm."""
    return 0.01 * np.arcsinh(np.asarray(ratio) / 1e-3)


def test_equal_steps_from_0_jump_over_the_knee():
    ratio = np.linspace(0.0, 0.1, 4)
    f = eyring(ratio)
    (gap,) = gaps_of(ratio, f, 0.1 * f)
    assert (gap.low, gap.high) == (0.0, pytest.approx(0.1 / 3))
    assert gap.change > 0.5 * (eyring(gap.at) - gap.at / ratio[1] * f[1]) > 0.0
    assert "between the slide-roll ratios 0 and 0.03333" in gap.text and "0.000333, 0.001" in gap.text
    assert gaps_of(-ratio[::-1], -f[::-1], 0.1 * f[::-1]) == [gap]


@pytest.mark.parametrize("count, low", [(12, 1e-4), (20, 1e-3)])
def test_no_gap_is_claimed_where_the_line_is_within_the_interval(count, low):
    """On a fine grid, at every place between the points, the line differs from the law by less than the interval."""
    ratio = np.geomspace(low, 0.5, count)
    f = eyring(ratio)
    fine = np.geomspace(low, 0.5, 2001)
    assert np.abs(np.interp(np.log(fine), np.log(ratio), f) / eyring(fine) - 1).max() < 0.1
    assert gaps_of(ratio, f, 0.1 * f) == []
    assert gaps_of([-0.1, 0.0, 0.1], np.array([-0.05, 0.0, 0.05]), np.full(3, 0.001)) == []


def test_a_gap_that_the_interval_does_not_cover_is_found_between_any_points():
    ratio = np.array([1e-4, 2e-4, 5e-4, 0.05, 0.1])
    f = eyring(ratio)
    (gap,) = gaps_of(ratio, f, 0.1 * f)
    assert (gap.low, gap.high) == (5e-4, 0.05) and gap.change > 0.0
    assert all(1.05 * gap.low < at < 0.95 * gap.high for at in gap.ratios)  # none is solved already
    f[1] = np.nan
    assert gaps_of(ratio, f, np.full(5, np.nan))
