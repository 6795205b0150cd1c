"""Two rough bodies of which one rests: its roughness scatters from place to place alone, the other's in time too."""

import math

import numpy as np
import pytest

import lubfric
from lubfric.models.deterministic.time_and_place import TimeAndPlace, mean_over_blocks


def test_a_rough_body_at_rest_below_a_rough_one_that_moves_has_an_answer():
    roughness = {"sq": 1e-7, "correlation_length": 16e-6, "acf": "gaussian"}
    scene = lubfric.load_scene("paper").with_(
        bodies={"load": 60.0, "boundary_film": 2e-8},
        lubricant={"viscosity": 0.1, "eyring_stress": 5e6, "limiting_stress_coefficient": 0.06},
        surface=roughness,
        counterface=roughness,
        motion={"slide_roll_ratio": 2.0},
        numerics={"model": "quick", "sampling_tolerance": 0.5, "tolerance": 0.1},
    )
    point = lubfric.friction(scene, 0.3)
    assert point.decision.model == "quick" and 0.02 < point.coefficient < 0.12
    assert math.isfinite(point.uncertainty.sampling) and point.uncertainty.sampling > 0


@pytest.mark.parametrize("moments", [4, 40])
def test_scatter_of_a_resting_body_is_that_between_places_however_long_it_is_followed(moments):
    """Independent places that do not change in time: the standard error of a mean of independent numbers."""
    rng = np.random.default_rng(0)
    errors = []
    for _ in range(200):
        friction = np.repeat(rng.normal(1.0, 0.3, (1, 640)), moments, axis=0)
        load = np.ones_like(friction)
        sample = TimeAndPlace(
            friction=friction,
            load=load + 1e-9 * rng.normal(size=friction.shape),
            contact_load=load,
            couette=load,
            summits=np.zeros_like(friction),
            travelled=0.0,
            spacing=1.0,
            mean_load=1.0,
        )
        errors.append(mean_over_blocks([sample], "friction", 1.0, None).plain.value)
    assert np.sqrt(np.mean(np.square(errors))) == pytest.approx(0.3 / math.sqrt(640), rel=0.12)
