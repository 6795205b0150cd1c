"""Viscosity, density and shear-stress laws."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lubfric import InputError
from lubfric.oil import Lubricant, density_ratio, log_viscosity_ratio, shear_stress, viscosity

OIL = Lubricant(0.04, 2.2e-8)


@pytest.mark.parametrize("law", ["roelands", "barus", "constant"])
@pytest.mark.parametrize("density", ["constant", "dowson-higginson"])
@given(p=st.floats(0.0, 3e9))
def test_derivatives_match_differences(law, density, p):
    oil = Lubricant(0.04, 2.2e-8, viscosity_law=law, density_law=density)
    step = 1e3
    for function in (log_viscosity_ratio, density_ratio):
        _value, slope = function(oil, p + step)
        difference = (function(oil, p + 2 * step)[0] - function(oil, p)[0]) / (2 * step)
        assert float(difference) == pytest.approx(float(slope), rel=1e-4, abs=1e-18)


@pytest.mark.parametrize("law", ["roelands", "barus"])
def test_laws_are_smooth_through_ambient_pressure(law):
    oil = Lubricant(0.04, 2.2e-8, viscosity_law=law, density_law="dowson-higginson")
    for function in (log_viscosity_ratio, density_ratio):
        value, slope = function(oil, np.array([-1.0, 0.0, 1.0]))
        assert np.allclose(np.diff(value), slope[1], rtol=1e-6)
    assert np.ndim(viscosity(oil, np.zeros((2, 3)))) == 2


def test_shear_stress_laws():
    rate = np.array([-1e7, -1.0, 0.0, 1.0, 1e7])
    newtonian = shear_stress(OIL, 5e8, rate)
    assert np.allclose(newtonian, viscosity(OIL, 5e8) * rate)
    eyring = shear_stress(Lubricant(0.04, 2.2e-8, eyring_stress=5e6), 5e8, rate)
    assert np.allclose(np.sinh(eyring / 5e6) * 5e6, newtonian)
    limited = shear_stress(Lubricant(0.04, 2.2e-8, limiting_stress_coefficient=0.05), 5e8, rate)
    assert np.max(np.abs(limited)) == pytest.approx(1e6 + 0.05 * 5e8)
    assert limited[3] == newtonian[3]
    for tau in (newtonian, eyring, limited):
        assert np.allclose(tau, -tau[::-1])


@pytest.mark.parametrize(
    "change, word",
    [
        ({"viscosity": 0.0}, "viscosity"),
        ({"viscosity": 6e-5}, "9.67"),
        ({"pressure_viscosity_coefficient": 0.0}, "constant"),
        ({"pressure_viscosity_coefficient": -1e-9}, "pressure_viscosity_coefficient"),
        ({"viscosity_law": "baros"}, "barus"),
        ({"eyring_stress": 0.0}, "eyring_stress"),
        ({"limiting_stress_coefficient": -1}, "limiting_stress_coefficient"),
        ({"limiting_stress_offset": -1}, "limiting_stress_offset"),
    ],
)
def test_bad_input(change, word):
    with pytest.raises(InputError, match=word):
        Lubricant(**({"viscosity": 0.1, "pressure_viscosity_coefficient": 1e-8} | change))
