"""Constants that no other test would miss, typed here from the sources: what is taken of a base oil, the density under
pressure, and the largest stress that oils carry."""

import math

import numpy as np
import pytest
from scene_text import paper_scene

from lubfric import oil
from lubfric.oil import Lubricant, carried_stress, density_ratio

MM2 = 1e-6
# base: kg/m³ at 15 °C, kg/(m³ K), W/(m K), alpha by Gold et al. (2001) at 100 mm²/s in 1/GPa, largest over it
TYPICAL = {
    "mineral": (880.0, 0.64, 0.13, 18.785, 1.65),
    "pao": (840.0, 0.62, 0.15, 13.651, 1.65),
    "ester": (950.0, 0.72, 0.15, 12.356, 2.1),
    "polyglycol": (1030.0, 0.78, 0.16, 10.876, 1.75),
}


@pytest.mark.parametrize("base", TYPICAL)
def test_what_is_typical_of_a_base_oil(base):
    density, slope, conductivity, alpha, most = TYPICAL[base]
    law = oil.walther((313.15, 400 * MM2), (343.15, 100 * MM2))
    made = oil.Oil(viscosity_law=law, base=base, estimate="gold")
    assert made.density_at(288.15) == density
    assert made.density_at(388.15) == pytest.approx(density - 100 * slope, rel=1e-12)
    assert made.thermal_conductivity == conductivity
    result = made.pressure_viscosity_coefficient(343.15)
    assert result.value * 1e9 == pytest.approx(alpha, rel=1e-4)
    assert (result.low / result.value, result.high / result.value) == pytest.approx((0.85, most))
    keys = {"nu40": 4e-4, "nu100": 3e-5, "temperature_celsius": 70, "base": base}
    scene = paper_scene(lubricant=keys)
    assert scene.lubricant.conductivity == conductivity
    rho = density - 55 * slope
    assert scene.lubricant.viscosity == pytest.approx(rho * scene.lubricant.oil.kinematic_viscosity(343.15), rel=1e-12)


def test_the_viscosity_falls_with_the_law_and_with_the_density():
    """D341 in closed form: d ln(Z)/dT = -n ln(Z)/T, Z = nu + 0.7; and the density falls by its slope."""
    law = oil.walther((313.15, 400 * MM2), (343.15, 100 * MM2))
    t = 333.15
    made = oil.Oil(viscosity_law=law, base="polyglycol")
    nu = made.kinematic_viscosity(t) / MM2
    of_nu = law.n * math.log(nu + 0.7) / t * (nu + 0.7) / nu
    of_density = 0.78 / (1030 - 45 * 0.78)
    assert made.temperature_coefficient(t) == pytest.approx(of_nu + of_density, rel=1e-6)


def test_density_of_dowson_and_higginson():
    lubricant = Lubricant(0.1, 2e-8, density_law="dowson-higginson")
    pressure = np.array([0.0, 5.9e8, 1e9, 3e9])
    expected = (5.9e8 + 1.34 * pressure) / (5.9e8 + pressure)
    np.testing.assert_allclose(density_ratio(lubricant, pressure)[0], expected, rtol=1e-13)


def test_no_oil_is_taken_to_carry_more_than_an_eighth_of_its_pressure():
    np.testing.assert_allclose(carried_stress(np.array([-1e6, 0.0, 1e8, 1e9])), [5e6, 5e6, 17e6, 125e6])
