"""Closed forms against published constants, against quadrature and against each other."""

import math

import numpy as np
import pytest
from scipy import integrate

from lubfric import InputError
from lubfric.contact import westergaard
from lubfric.film import LineContact, hertz
from lubfric.film import formulas as film
from lubfric.film import rigid_cylinder as rigid
from lubfric.oil import Lubricant

OIL = {"radius": 2e-3, "e_prime": 231e9, "viscosity": 0.36, "pressure_viscosity_coefficient": 25e-9}


def test_composite_modulus_convention():
    assert hertz.composite_modulus(210e9, 0.3, 210e9, 0.3) == pytest.approx(210e9 / 0.91)
    assert hertz.composite_modulus(210e9, 0.3, math.inf, 0.3) == pytest.approx(2 * 210e9 / 0.91)
    for bad in [(0, 0.3, 1e9, 0.3), (1e9, 0.6, 1e9, 0.3), (1e9, math.nan, 1e9, 0.3), (math.inf, 0.3, math.inf, 0.3)]:
        with pytest.raises(InputError):
            hertz.composite_modulus(*bad)


def test_line_hertz_of_the_paper():
    line = (5.5 / 6e-3, 2e-3, 231e9)
    assert hertz.line_half_width(*line) == pytest.approx(4.5e-6, rel=2e-3)
    assert hertz.line_mean_pressure(*line) == pytest.approx(102e6, rel=2e-3)
    assert hertz.line_peak_pressure(*line) == pytest.approx(4 / math.pi * hertz.line_mean_pressure(*line))


def test_line_hertz_carries_its_load_and_closes_its_gap():
    w, radius, e_prime = 1e5, 0.01, 2e11
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


def test_point_hertz_is_self_consistent():
    load, radius, e_prime = 0.3, 5e-3, 1.2e11
    a = hertz.point_radius(load, radius, e_prime)
    total = 2 * math.pi * integrate.quad(lambda r: r * hertz.point_pressure(r, load, radius, e_prime), 0, a)[0]
    assert total == pytest.approx(load, rel=1e-6)
    assert hertz.point_mean_pressure(load, radius, e_prime) == pytest.approx(load / (math.pi * a**2))
    approach = hertz.point_approach(load, radius, e_prime)
    assert hertz.point_load(approach, radius, e_prime) == pytest.approx(load)
    assert hertz.point_load(-1e-9, radius, e_prime) == 0
    # Boussinesq under the centre: u(0) = 2/(pi E') * integral of p/r dA must be the approach
    centre = 4 / e_prime * integrate.quad(lambda r: hertz.point_pressure(r, load, radius, e_prime), 0, a)[0]
    assert centre == pytest.approx(approach, rel=1e-6)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_westergaard_against_the_fourier_half_space(share):
    """Pressure, contact width and mean gap are one solution: gap >= 0 outside, 0 inside, mean as stated."""
    n, wavelength, amplitude, e_prime = 2**14, 1e-5, 1e-8, 2e11
    x = (np.arange(n) - n // 2) * wavelength / n
    full = westergaard.line_full_contact_pressure(amplitude, wavelength, e_prime)
    p = westergaard.line_pressure(x, wavelength, share * full, full)
    assert p.mean() == pytest.approx(share * full, rel=1e-5)
    assert np.mean(p > 0) == pytest.approx(westergaard.line_contact_fraction(share * full, full), abs=2e-4)
    k = 2 * np.pi * np.fft.rfftfreq(n, wavelength / n)
    u = _displacement(p, k, e_prime)
    gap = u - amplitude * np.cos(2 * np.pi * x / wavelength)
    gap -= gap[p > 0].mean()
    assert np.abs(gap[p > 0]).max() < 1e-4 * amplitude
    assert gap[p == 0].min() > -1e-4 * amplitude
    expected = westergaard.line_mean_gap(amplitude, share * full, full)
    assert gap.mean() == pytest.approx(expected, abs=1e-4 * amplitude)


def _displacement(p, k, e_prime):
    spectrum = np.fft.rfft(p)
    spectrum[0] = 0
    spectrum[1:] *= 4 / (e_prime * k[1:])
    return np.fft.irfft(spectrum, p.size)


def test_square_waviness_asymptotes():
    """Against the contact areas tabulated for the bisinusoid: 512^2 cells, residual 1e-10."""
    assert westergaard.square_contact_fraction_light(0.01, 1.0) == pytest.approx(0.03660, rel=0.04)
    assert westergaard.square_contact_fraction_heavy(0.9, 1.0) == pytest.approx(0.95107, abs=2e-3)
    e_prime, amplitude, wavelength = 2e11, 1e-8, 1e-5
    full = westergaard.square_full_contact_pressure(amplitude, wavelength, e_prime)
    load, radius = 1e-6 * full * wavelength**2 / 2, wavelength**2 / (4 * math.pi**2 * amplitude)
    area = 2 * math.pi * hertz.point_radius(load, radius, e_prime) ** 2 / wavelength**2
    assert westergaard.square_contact_fraction_light(1e-6 * full, full) == pytest.approx(area)


def test_rigid_constants():
    c = rigid.rigid_constants()
    assert c.rupture == pytest.approx(0.4751299, abs=5e-8)
    assert c.load == pytest.approx(4.8950, abs=5e-5)
    assert c.min_film == pytest.approx(2.447484, abs=5e-7)
    assert c.flow_film == pytest.approx(3.0, abs=1e-12)
    assert c.couette == pytest.approx(2.848722, abs=5e-7)
    assert c.rolling == pytest.approx(2.300538, abs=5e-7)
    assert c.piezoviscous_min_film == pytest.approx(1.049701, abs=5e-7)
    assert c.piezoviscous_flow_film == pytest.approx(1.286670, abs=5e-7)


def test_rigid_pressure_satisfies_reynolds_and_gives_the_constants():
    h0, radius, speed, eta = 1e-6, 1e-2, 0.5, 0.05
    args = {"radius": radius, "entrainment_speed": speed, "viscosity": eta}
    scale, c = math.sqrt(2 * radius * h0), rigid.rigid_constants()
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


def test_piezoviscous_limit_is_where_the_reduced_pressure_reaches_one_over_alpha():
    radius, speed, eta, alpha = 1e-2, 0.5, 0.05, 2e-8
    h0 = rigid.piezoviscous_min_film(
        radius=radius, entrainment_speed=speed, viscosity=eta, pressure_viscosity_coefficient=alpha
    )
    x = np.linspace(-1, 0, 200_001) * math.sqrt(2 * radius * h0)
    q = rigid.pressure(x, h0, radius=radius, entrainment_speed=speed, viscosity=eta)
    assert q.max() == pytest.approx(1 / alpha, rel=1e-9)


def test_squeeze_film_sinks_at_the_speed_of_the_squeeze_load():
    args = {"radius": 1e-2, "viscosity": 0.05}
    t, dt = 2e-3, 1e-7
    h = rigid.squeeze_film(np.array([t - dt, t, t + dt]), 5e-6, load_per_width=1e4, **args)
    speed = -(h[2] - h[0]) / (2 * dt)
    assert rigid.squeeze_load(h[1], approach_speed=speed, **args) == pytest.approx(1e4, rel=1e-6)
    x = math.sqrt(2e-2 * h[1]) * np.linspace(-300, 300, 600_001)
    pressure = 6 * 0.05 * speed * 1e-2 / (h[1] + x**2 / 2e-2) ** 2  # integrates d/dx(h^3 p'/12 eta) = -V
    assert integrate.trapezoid(pressure, x) == pytest.approx(1e4, rel=1e-5)


@pytest.mark.parametrize(
    "film_over_contact, constant", [(1e-1, 1.2487), (1e-2, 1.2943), (1e-3, 1.3071), (1e-4, 1.3102), (1e-5, 1.3109)]
)
def test_grubin_inlet_constant(film_over_contact, constant):
    assert film.grubin_constant(film_over_contact) == pytest.approx(constant, abs=5.1e-5)


def test_grubin_integral_against_adaptive_quadrature():
    def integrand(x):
        gap = 0.5 * (x * math.sqrt(x * x - 1) - math.acosh(x))
        return gap / (0.03 + gap) ** 3

    value = integrate.quad(integrand, 1, 3, limit=400)[0] + integrate.quad(integrand, 3, math.inf)[0]
    assert film.inlet_integral(0.03) == pytest.approx(value, rel=1e-8)


def test_grubin_film_solves_its_own_inlet_equation():
    for m, l in [(10, 10), (100, 5), (1000, 20)]:
        h = film.grubin_film(m, l)
        c = film.grubin_constant(h * math.pi / (8 * m))
        assert h == pytest.approx(c * m**-0.125 * l**0.75, rel=1e-10)


@pytest.mark.parametrize(
    "m, l, flow", [(5, 5, 4.082), (10, 5, 3.744), (20, 5, 3.423), (100, 5, 2.758), (10, 10, 5.491), (50, 10, 4.587)]
)
def test_moes_formula_near_converged_flow_films(m, l, flow):
    assert film.moes_film(m, l) == pytest.approx(flow, rel=0.05)


def test_moes_formula_tends_to_its_asymptotes():
    assert film.moes_film(1e-3, 0) == pytest.approx(3 / 1e-3, rel=1e-3)
    assert film.moes_film(1e6, 0) == pytest.approx(2.621 * 1e6**-0.2, rel=1e-3)
    assert film.moes_film(1e12, 100) == pytest.approx(1.311 * 1e12**-0.125 * 100**0.75, rel=1e-3)
    assert film.moes_film(1e-3, 1e6) == pytest.approx(1.287 * 1e6 ** (2 / 3), rel=5e-2)
    assert film.moes_film(3.0, 0) == pytest.approx(film.moes_film(3.0, 1e-12), rel=1e-6)


def test_moes_numbers_out_of_range():
    for bad in [(0, 5), (5, 0), (-1, 5), (math.inf, 5)]:
        with pytest.raises(InputError):
            film.load_and_speed(*bad, **OIL)


def test_fitted_formulas_near_converged_solutions():
    """M = 20, L = 5, compressible: H_min 2.568, H(0) 3.084; the fits lie within 13 %."""
    w, speed = film.load_and_speed(20.0, 5.0, **OIL)
    contact = LineContact(w, OIL["radius"], OIL["e_prime"], speed, Lubricant(0.36, 25e-9))
    numbers = contact.speed_number / 2, 25e-9 * OIL["e_prime"], w / (OIL["e_prime"] * OIL["radius"])
    unit = contact.film_unit / contact.radius
    assert film.dowson_higginson_min_film(*numbers) / unit == pytest.approx(2.568, rel=0.1)
    assert film.dowson_toyoda_central_film(*numbers) / unit == pytest.approx(3.084, rel=0.13)
    assert contact.moes_film / contact.film_unit == pytest.approx(film.moes_film(20.0, 5.0))
