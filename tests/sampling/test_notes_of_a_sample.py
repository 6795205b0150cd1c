"""What a result says of its sample: one of few asperities matters where f
depends on it."""

import pytest

import lubfric
from lubfric.models.shared.checks_before import MAP_WIDTH

PATCH = lubfric.load_scene("paper").with_(contact={"shape": (100, 100)}, numerics={"sampling": "patch", "model": "paper"})


@pytest.mark.parametrize(("speed", "matters"), [(0.01, True), (30.0, False)])
def test_a_short_sample_is_a_warning_where_asperities_carry_load(speed, matters):
    result = lubfric.friction(PATCH.with_(numerics={"accept": True, "heat": "off"}), speed)
    assert (result.contact_load > 0) == matters
    assert (MAP_WIDTH in [violation.what for violation in result.validity]) == matters
