"""What a result says of its sample: one of few asperities matters where f depends on it."""

import numpy as np
import pytest

import lubfric
from lubfric.models.shared.checks_before import MAP_WIDTH

ROUGHNESS = lubfric.generate_surface((64, 256), 2e-6, sq=3e-8, correlation_length=24e-6, acf="gaussian", seed=3)


@pytest.mark.parametrize(("speed", "matters"), [(0.001, True), (3.0, False)])
def test_a_short_sample_is_a_warning_where_asperities_carry_load(tmp_path, speed, matters):
    np.save(tmp_path / "map.npy", ROUGHNESS.heights[:, :100])
    scene = lubfric.load_scene("paper").with_(
        surface={
            "file": str(tmp_path / "map.npy"),
            "unit": "m",
            "spacing": 2e-6,
            "sq": None,
            "correlation_length": None,
            "acf": None,
        },
        contact={"shape": None, "spacing": None},
        numerics={"model": "paper", "accept": True, "heat": "off"},
    )
    result = lubfric.friction(scene, speed)
    assert (result.contact_load > 0) == matters
    assert (MAP_WIDTH in [violation.what for violation in result.validity]) == matters
