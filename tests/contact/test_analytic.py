"""Closed forms against published constants and against quadrature."""

import math

import numpy as np
import pytest
import rigid_cylinder as rigid
from scipy import integrate

from lubfric import InputError
from lubfric.film import formulas as film
from lubfric.film import hertz


def test_composite_modulus_convention():
    assert hertz.composite_modulus(210e9, 0.3, 210e9, 0.3) == pytest.approx(210e9 / 0.91)
    assert hertz.composite_modulus(210e9, 0.3, math.inf, 0.3) == pytest.approx(2 * 210e9 / 0.91)
    for bad in [(0, 0.3, 1e9, 0.3), (1e9, 0.6, 1e9, 0.3), (1e9, math.nan, 1e9, 0.3), (math.inf, 0.3, math.inf, 0.3)]:
        with pytest.raises(InputError):
            hertz.composite_modulus(*bad)


def test_line_hertz_carries_its_load_and_closes_its_gap():
    w = 1e5
    radius = 0.01
    e_prime = 2e11
    b = hertz.line_half_width(w, radius, e_prime)
    load = integrate.quad(lambda x: hertz.line_pressure(x, w, radius, e_prime), -b, b)[0]
    assert load == pytest.approx(w, rel=1e-6)

    def displacement(x):
        """u(x) - u(0) of the line kernel; x = b sin(t) removes the root from the pressure."""

        def integrand(t):
            source = b * math.sin(t)
            return -math.log(abs((x - source) / source)) * math.cos(t) ** 2

        points = [0.0] + ([math.asin(x / b)] if abs(x) < b else [])
        value = integrate.quad(integrand, -math.pi / 2, math.pi / 2, points=points, limit=400)[0]
        return 4 / (math.pi * e_prime) * hertz.line_peak_pressure(w, radius, e_prime) * b * value

    for x in (0.5 * b, 1.5 * b, 3 * b):
        gap = x**2 / (2 * radius) + displacement(x)
        assert gap == pytest.approx(float(hertz.line_gap(x, w, radius, e_prime)), abs=1e-6 * b**2 / radius)


def test_rigid_constants():
    c = rigid.rigid_constants()
    assert c.rupture == pytest.approx(0.4751299, abs=5e-8)
    assert c.load == pytest.approx(4.8950, abs=5e-5)
    assert c.min_film == pytest.approx(2.447484, abs=5e-7)
    assert c.flow_film == pytest.approx(3.0, abs=1e-12)
    assert c.couette == pytest.approx(2.848722, abs=5e-7)
    assert c.rolling == pytest.approx(2.300538, abs=5e-7)


def test_rigid_pressure_satisfies_reynolds_and_gives_the_constants():
    h0 = 1e-6
    radius = 1e-2
    speed = 0.5
    eta = 0.05
    args = {"radius": radius, "entrainment_speed": speed, "viscosity": eta}
    scale = math.sqrt(2 * radius * h0)
    c = rigid.rigid_constants()
    x = np.linspace(-2, c.rupture, 400_001)[1:-1] * scale
    p = rigid.pressure(x, h0, **args)
    h = h0 + x**2 / (2 * radius)
    flux = -(h**3) / (12 * eta) * np.gradient(p, x) + speed * h
    assert np.allclose(flux[2:-2], speed * c.flow_film_ratio * h0, rtol=1e-6)
    assert rigid.pressure(2 * scale, h0, **args) == 0

    def pressure(t):
        return float(rigid.pressure(scale * math.tan(t), h0, **args))

    ends = -math.pi / 2, math.atan(c.rupture)
    load = integrate.quad(lambda t: pressure(t) * scale / math.cos(t) ** 2, *ends)[0]
    assert rigid.isoviscous_min_film(load_per_width=load, **args) == pytest.approx(h0, rel=1e-7)
    rolling = -integrate.quad(lambda t: pressure(t) * h0 * math.tan(t) / math.cos(t) ** 2, *ends)[0]  # -1/2 p dh
    assert rolling == pytest.approx(rigid.rolling_friction(h0, **args), rel=1e-6)
    couette = integrate.quad(lambda s: eta * 0.3 / (h0 + s**2 / (2 * radius)), -math.inf, c.rupture * scale)[0]
    expected = rigid.couette_friction(h0, radius=radius, speed_difference=0.3, viscosity=eta)
    assert couette == pytest.approx(expected)


def test_moes_formula_tends_to_its_asymptotes():
    assert film.moes_film(1e-3, 0) == pytest.approx(3 / 1e-3, rel=1e-3)
    assert film.moes_film(1e6, 0) == pytest.approx(2.621 * 1e6**-0.2, rel=1e-3)
    assert film.moes_film(1e12, 100) == pytest.approx(1.311 * 1e12**-0.125 * 100**0.75, rel=1e-3)
    assert film.moes_film(1e-3, 1e6) == pytest.approx(1.287 * 1e6 ** (2 / 3), rel=5e-2)
    assert film.moes_film(3.0, 0) == pytest.approx(film.moes_film(3.0, 1e-12), rel=1e-6)
