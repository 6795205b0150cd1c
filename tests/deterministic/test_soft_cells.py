"""Soft bodies on few cells in the Hertz half-width: the numerical error holds f on cells of a quarter."""

from dataclasses import replace

import pytest

import lubfric
from lubfric.models.deterministic import solve_strip

# A roller of E' 19 GPa, whose film builds up in the Hertz strip, on waves that are longer than it.
ROLLER = lubfric.load_scene("paper").with_(
    bodies={"radius": 9.43e-3, "width": 0.5, "load": 5570.0, "e_prime": 1.92e10, "boundary_friction_coefficient": 0.1},
    lubricant={"viscosity": 0.0475, "pressure_viscosity_coefficient": 1.16e-8, "eyring_stress": 5e6},
    motion={"slide_roll_ratio": 2.0},
    numerics={"model": "deterministic", "accept": True, "heat": "off"},
)
MAP = lubfric.generate_surface((192, 192), 10e-6, sq=276e-9, correlation_length=160e-6, acf="gaussian", seed=5)


@pytest.mark.parametrize("speed", [0.3, 1.0])
def test_the_numerical_error_of_long_cells_holds_f_on_short_ones(speed: float) -> None:
    """Three cells in the half-width and twelve. The change between long cells is a third of what is left."""
    long = replace(MAP, heights=MAP.heights[2::4, 2::4], spacing=(40e-6, 40e-6))
    result = lubfric.friction(lubfric.prepare(ROLLER, long), speed)
    strip = None
    for factor in (4, 2, 1):
        strip = solve_strip(ROLLER, MAP, speed, map_coarsening=(factor, factor), start=strip)
    short = strip.result.coefficient
    assert result.uncertainty.numerical > abs(result.coefficient / short - 1) > 0.02
