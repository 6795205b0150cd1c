"""The line contact as a value: closed forms that follow from it, and what it refuses."""

import math
from dataclasses import replace

import pytest
import rigid_cylinder as rigid

from lubfric import InputError
from lubfric.film import LineContact
from lubfric.oil import Lubricant

OIL = Lubricant(0.04, 2.2e-8)
STEEL = LineContact(1e5, 0.01, 2.2e11, 1.5, OIL)


def test_units_make_the_hertz_contact_dimensionless():
    """In Moes' units b = sqrt(8 M/pi), p_h = 2 M/(pi b) and the parabola x²/2R is X²/2."""
    b = math.sqrt(8 * STEEL.M / math.pi)
    assert STEEL.half_width / STEEL.length_unit == pytest.approx(b, rel=1e-12)
    peak = 2 * STEEL.load_per_width / (math.pi * STEEL.half_width)
    assert peak / STEEL.pressure_unit == pytest.approx(2 * STEEL.M / (math.pi * b), rel=1e-12)
    assert STEEL.length_unit**2 / STEEL.radius == pytest.approx(STEEL.film_unit, rel=1e-12)


def test_light_contact_has_the_rigid_film():
    """Moes' film tends to the rigid flow film, h* = 6/4.895 h0 (up to the rounding of his 3/M)."""
    light = LineContact(1.0, 0.01, 2.2e11, 1.5, Lubricant(0.04, viscosity_law="constant"))
    assert light.L == 0.0
    flow = light.rigid_film * rigid.rigid_constants().flow_film_ratio
    assert light.moes_film == pytest.approx(flow, rel=3e-3)


@pytest.mark.parametrize(
    "name, value",
    [
        ("load_per_width", 0.0),
        ("load_per_width", "1e5"),
        ("e_prime", 0.0),
        ("entrainment_speed", 0.0),
        ("lubricant", 0.04),
    ],
)
def test_refuses(name, value):
    with pytest.raises(InputError, match=name):
        replace(STEEL, **{name: value})
