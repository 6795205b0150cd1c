"""Errors of means along a line: closed forms and independent draws."""

import math

import numpy as np
import pytest
from scipy import stats

from lubfric.models.load_sharing import effective_contacts
from lubfric.models.shared import StandardError, block_error


def correlated(rng, count, length):
    """Unit variance, moving average over ``length`` points: the mean of n has the variance length/n, as that of values
    of the correlation exp(-(y/l)²) with length = sqrt(pi) l."""
    noise = rng.standard_normal(count + length - 1)
    return np.convolve(noise, np.full(length, length**-0.5), "valid")


def test_neighbouring_blocks_are_alike_near_their_common_end():
    """Values of the correlation exp(-(y/l)²), of which the mean over L has the variance sqrt(pi) l/L, for L >> l."""
    rng = np.random.default_rng(7)
    length = 8.0
    count = 180 * 8
    kernel = np.exp(-2 * (np.arange(-40, 41) / length) ** 2)
    kernel /= np.linalg.norm(kernel)
    noise = rng.standard_normal((2000, count + 80))
    result = [block_error(np.convolve(row, kernel, "valid"), 1.0, length).value ** 2 for row in noise]
    exact = math.sqrt(math.pi) * length / count * (1 - 1 / (math.sqrt(math.pi) * 180))
    assert np.mean(result) == pytest.approx(exact, rel=0.02)  # 6 % less without


def test_what_blocks_scatter_by_with_a_quantity_known_exactly_is_no_error():
    """Draws whose covariate is shifted to its known mean, as a line made with exactly its Sq is."""
    rng = np.random.default_rng(6)
    count = 3200
    length = 10
    means = []
    result = []
    blind = []
    for _ in range(300):
        other = correlated(rng, count, length)
        other -= other.mean()
        values = 0.8 * other + 0.6 * correlated(rng, count, length)
        means.append(values.mean())
        result.append(block_error(values, 1.0, length / math.sqrt(math.pi), other))
        blind.append(block_error(values, 1.0, length / math.sqrt(math.pi)))
    reported, unaware = (np.sqrt(np.mean([f.value**2 for f in each])) for each in (result, blind))
    assert result[0].freedom == blind[0].freedom - 1
    assert reported == pytest.approx(np.std(means), rel=0.1)
    assert unaware == pytest.approx(np.std(means) / 0.6, rel=0.1)


def test_a_line_too_short_for_five_blocks_tells_nothing():
    assert block_error(np.arange(240.0), 1.0, 10.0) == StandardError(math.inf, 0)
    lengths = (250.0, 300.0, 400.0, 800.0, 900.0, 1e4)
    assert [block_error(np.arange(n), 1.0, 10.0).freedom for n in lengths] == [4, 5, 7, 7, 9, 31]


@pytest.mark.parametrize("count", [1, 7, 50])
def test_effective_contacts_count_equal_loads(count):
    """Loads 4 cells apart, each of a spot: 1.75 correlation lengths."""
    loads = np.zeros(400)
    loads[: 4 * count : 4] = 3.0
    assert effective_contacts(loads, 1.0, 4 / 1.75) == pytest.approx(count)
    assert effective_contacts(np.zeros(4), 1.0, 1.0) == 0.0


def test_there_are_no_more_blocks_than_places():
    """White noise on a few wide cells, each many correlation lengths long: the standard error of a plain mean."""
    for count in (5, 6, 7):
        values = np.random.default_rng(count).standard_normal(count)
        result = block_error(values, 1.0, 1e-3)
        assert result.value == pytest.approx(stats.sem(values), rel=1e-3) and result.freedom == count - 1
    assert math.isinf(block_error(np.arange(4.0), 1.0, 1e-3).value)
