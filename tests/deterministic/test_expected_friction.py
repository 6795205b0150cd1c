"""What the estimates expect of moving roughness: drawn pressures and drawn errors against the closed forms."""

import numpy as np
import pytest

import lubfric
from lubfric.models.deterministic import estimated_work
from lubfric.models.deterministic.expected_friction import expected_friction, solved_ends_of_hardness

SPEED = 0.02
HARDNESSES = 5.5e9, 7.0e9, 8.5e9  # Pa: lowest, given and highest


def rolling(sq=2e-7, slide_roll_ratio=0.5, **numerics):
    low, given, high = HARDNESSES
    hardness = [given, low, high]
    return lubfric.load_scene("paper").with_(
        bodies={"radius": 6e-3, "width": 10e-3, "load": 800.0, "hardness": hardness},
        lubricant={"eyring_stress": 5e6},
        motion={"slide_roll_ratio": slide_roll_ratio, "entrainment_speed": SPEED},
        surface={"sq": sq, "correlation_length": 1e-5, "acf": "gaussian"},
        numerics={"accept": True, **numerics},
    )


@pytest.mark.parametrize("slope", [0.01, 0.08, 0.11, 0.13])
def test_ends_of_the_hardness_are_those_that_drawn_pressures_move(slope):
    """Pressures are lengths of two independent normal numbers; a plane wave of this slope has them, whatever its
    length."""
    scene = rolling()
    x = np.arange(64) / 64
    heights = np.sin(2 * np.pi * x)[:, None] * np.ones((1, 8))
    rms = np.sqrt(np.mean((np.roll(heights, -1, 0) - heights) ** 2))
    surface = lubfric.Surface(slope / rms * 2e-7 * heights, 2e-7, periodic_axes=(True, True))
    expected = expected_friction(scene, surface.sq, SPEED)
    normal = np.random.default_rng(1).standard_normal((2, 1_000_000))
    pressure = np.hypot(*normal) * scene.bodies.e_prime * slope / 4
    low, given, high = HARDNESSES
    f = expected.share * expected.boundary + (1 - expected.share) * expected.film
    changes = [
        2 * expected.share * np.mean(np.clip(pressure - a, 0, b - a)) / pressure.mean() * (expected.boundary - f) / f
        for a, b in ((low, given), (given, high))
    ]
    assert all(abs(change / 0.02 - 1) > 0.05 for change in changes)  # far enough from the threshold for a draw
    assert solved_ends_of_hardness(scene, surface, SPEED) == sum(change > 0.02 for change in changes)


def test_a_thin_film_is_carried_by_asperities_and_a_thick_one_by_itself():
    thin, thick = (expected_friction(rolling(), 2e-7, speed).share for speed in (1e-3, 100.0))
    assert thin > 0.9 and thick < 0.01
    assert expected_friction(rolling(slide_roll_ratio=0.0), 2e-7, SPEED).contrast == 0


def test_needed_strips_fall_with_the_square_of_the_tolerance():
    def needed(tolerance):
        prepared = lubfric.prepare(rolling(sampling_tolerance=tolerance))
        return estimated_work._needed_strips(prepared.scene, prepared.sample, sq=2e-7, speed=SPEED)

    assert needed(2e-3) == pytest.approx(needed(1e-3) / 4, rel=1e-9)


def test_a_lubricant_that_does_not_thicken_carries_as_one_that_hardly_does():
    constant = rolling().with_(lubricant={"viscosity_law": "constant", "pressure_viscosity_coefficient": 0.0})
    hardly = constant.with_(lubricant={"pressure_viscosity_coefficient": 1e-12})
    shares = [expected_friction(scene, 2e-7, SPEED).share for scene in (constant, hardly)]
    assert 0 < shares[0] < 1
    assert shares[0] == pytest.approx(shares[1], rel=1e-2)
