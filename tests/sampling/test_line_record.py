"""Several lines together."""

from dataclasses import replace

import numpy as np
import pytest
from lubfric.sampling.line_record import LineRecord, pooled

import lubfric
from lubfric.sharing import line_contact, solved


def test_loads_are_averaged_by_length():
    records = [LineRecord(length, load, spots=np.ones(3)) for length, load in ((1.0, 2.0), (2.0, 3.0), (0.5, 5.0))]
    assert pooled(records).contact_load == pytest.approx((1.0 * 2.0 + 2.0 * 3.0 + 0.5 * 5.0) / 3.5)
    assert pooled([*records, LineRecord(1.5)]).contact_load == pytest.approx((2.0 + 6.0 + 2.5) / 5.0)


@pytest.mark.parametrize("speed", [0.02, 0.046])
def test_lines_together_carry_what_they_carry_when_joined_to_one(speed):
    """Also where they carry loads as different as 1 to 2 (0.046 m/s)."""
    scene = lubfric.load_scene("paper").with_(numerics={"tolerance": 3e-3, "sampling_tolerance": 0.5})
    model = lubfric.prepare(scene)
    surfaces = [model.lines.line(number, 100 * model.lines.lengths[1]) for number in range(4)]

    def load(surface):
        contact = line_contact(scene, surface)
        return solved(replace(model, contact=contact), speed, given_grid=True).balance.contact_load

    loads = [load(surface) for surface in surfaces]
    joined = load(replace(surfaces[0], heights=np.concatenate([s.heights for s in surfaces], axis=1)))
    scatter = np.std(loads, ddof=1) / np.mean(loads)
    together = pooled([LineRecord(1.0, of_one, spots=np.ones(3)) for of_one in loads]).contact_load
    assert together == pytest.approx(joined, rel=max(0.5 * scatter**2, 0.004))
    if speed > 0.04:  # a mean of the logarithms does not
        assert abs(np.exp(np.mean(np.log(loads))) / joined - 1) > 0.5 * scatter**2
        assert max(loads) > 1.5 * min(loads)


@pytest.mark.parametrize("order", [1, -1])
def test_one_line_that_is_cut_off_is_not_hidden_by_the_others(order):
    records = [LineRecord(1.0, 2.0, spots=np.ones(3), ends=share) for share in (0.04, 0.0, 0.01)]
    assert pooled(records[::order]).ends == 0.04
