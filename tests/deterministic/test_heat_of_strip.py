"""Temperatures of a rough strip, against the heat of all its cells."""

import numpy as np
import pytest
from scene_text import paper_scene

from lubfric.film import heated_stress
from lubfric.models.deterministic import heat_of_strips, solve_strip, strip_heat
from lubfric.surface import generate_surface

SLIDING = 2.0  # m/s
SCENE = paper_scene(
    bodies={"radius": 0.01, "hertz_pressure": 0.9e9, "width": 0.01, "e_prime": 2.27e11},
    lubricant={
        "grade": "ISO VG 68",
        "viscosity_index": 95,
        "temperature_celsius": 70,
        "density": 870,
        "eyring_stress": 5e6,
    },
    motion={"slide_roll_ratio": 2.0},
    numerics={"heat": "on"},
)


def strip_of(sq, seed=1, speed=0.5 * SLIDING):
    surface = generate_surface((96, 24), 8e-6, sq=sq, correlation_length=3e-5, acf="gaussian", seed=seed)
    return solve_strip(SCENE, surface, speed)


def rise_by(strip, heat):
    """The rise [K] at the ends of the columns of ``strip`` that make this ``heat`` (nx,) [W/m²], constant in each:
    Jaeger's integral, of which each column has a closed form."""
    bodies = SCENE.bodies
    moving = bodies.effusivity[1] * np.sqrt(SLIDING)
    ends = strip.x + 0.5 * strip.spacing[0]
    behind = np.sqrt(np.maximum(ends[:, None] - (ends - strip.spacing[0])[None, :], 0.0))
    after = np.sqrt(np.maximum(ends[:, None] - ends[None, :], 0.0))
    return (2.0 * (behind - after)) @ heat / (np.sqrt(np.pi) * moving)


def test_the_walls_are_as_hot_as_the_heat_of_all_cells_makes_them():
    """Walls as hot as a film of the mean pressure and gap of each column makes them would be 13 % too cool."""
    strip = strip_of(3e-7, seed=2).result
    heated = strip_heat(SCENE, strip).heated
    walls = heated.wall[:, None]
    stress = np.abs(heated_stress(SCENE.lubricant, strip.pressure, strip.gap, SLIDING, walls)[0])
    made = (stress * strip.wet + np.abs(strip.shear) * strip.rubbing).mean(axis=1) * SLIDING
    assert heated.flash == pytest.approx(rise_by(strip, made).max(), rel=0.07)  # 3 % by the columns


def test_several_strips_have_the_mean_of_their_temperatures():
    strips = [strip_of(2e-7, seed=seed).result for seed in (1, 2)]
    single = [strip_heat(SCENE, strip) for strip in strips]
    both = heat_of_strips(SCENE, strips)
    assert both.change == pytest.approx(np.mean([heat.change for heat in single]))
    assert both.flash == pytest.approx((sum(heat.heated.wall for heat in single) / 2).max() - both.heated.wall[0])
    assert min(heat.film_rise for heat in single) < both.film_rise < max(heat.film_rise for heat in single)
