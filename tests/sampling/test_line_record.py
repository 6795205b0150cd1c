"""Several lines together."""

import numpy as np
import pytest

from lubfric.sampling.line_record import LineRecord, pooled


def test_lines_under_one_film_are_averaged_as_their_gaps_are():
    """Gaps that fall as the logarithm of the load, G = a - c ln P, in closed form: where their mean is the film."""
    film, c, tops, lengths = 3e-7, 4e-8, np.array([4.1e-7, 3.6e-7, 3.8e-7]), np.array([1.0, 2.0, 0.5])
    loads = np.exp((tops - film) / c)
    records = [LineRecord(length, load, spots=np.ones(3)) for length, load in zip(lengths, loads)]
    together = pooled(records)
    right = np.exp((lengths @ tops / lengths.sum() - film) / c)
    assert together.contact_load == pytest.approx(right, rel=1e-12)
    with_none = pooled([*records, LineRecord(1.5)])
    assert with_none.contact_load == pytest.approx(lengths @ loads / 5.0, rel=1e-12)
