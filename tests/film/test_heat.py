"""Heat of the film against closed forms, a boundary-value solver, quadrature and bounds."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scene_text import paper_scene
from scipy.integrate import solve_bvp

import lubfric
from lubfric.film import Surroundings, heated_film, heated_stress, hertz, isothermal_heat
from lubfric.oil import Lubricant, shear_stress
from verification.fem import references

T0 = 343.15
STEEL = math.sqrt(46 * 7850 * 460)
OIL = Lubricant(
    0.0166, 2e-8, temperature=T0, temperature_coefficient=0.034, eyring_stress=5e6, limiting_stress_coefficient=0.08
)
MODULUS = 2.27e11
RADIUS = 0.01


def exponential(**changed):
    return Lubricant(
        **{"viscosity": 0.02, "viscosity_law": "constant", "temperature": T0, "temperature_coefficient": 0.04} | changed
    )


def contact(peak, count=193):
    """x, pressure and film [SI] of a Hertz line contact with a flat film, and its load per width."""
    load = 2 * math.pi * RADIUS * peak**2 / MODULUS
    b = hertz.line_half_width(load, RADIUS, MODULUS)
    x = np.linspace(-1.1 * b, 1.1 * b, count)
    return x, hertz.line_pressure(x, load, RADIUS, MODULUS), np.full(x.size, 2e-7), load


def around(x, speed, ratio, effusivity=STEEL, contact_heat=0.0):
    carried = effusivity * (math.sqrt(speed * abs(1 - ratio / 2)) + math.sqrt(speed * (1 + ratio / 2)))
    return Surroundings(carried, ratio * speed, np.ones(x.size), np.full(x.size, contact_heat))


def swept(heat, x, length):
    """∫ heat(x')/√(x - x') dx' over ``length`` upstream of x, by the midpoint rule in s = √(x - x')."""
    step = math.sqrt(length) / 200_000
    s = (np.arange(200_000) + 0.5) * step
    return 2 * step * np.sum(heat(x - s * s))


@given(st.floats(-3, 5), st.floats(-7.5, -4), st.floats(0.01, 0.1))
def test_newtonian_film_is_nahmes(log_sliding, log_film, beta):
    lubricant = exponential(temperature_coefficient=beta)
    sliding = 10**log_sliding
    film = 10**log_film
    stress, _ = heated_stress(lubricant, np.zeros(3), np.full(3, film), -sliding, np.full(3, T0))
    number = beta * 0.02 * sliding**2 / lubricant.conductivity
    assert stress == pytest.approx(-0.02 * sliding / film * references.nahme(number), rel=1e-8)


@pytest.mark.parametrize("sliding", [0.3, 10.0])
def test_eyring_film_against_a_boundary_value_solver(sliding):
    """k T'' = -tau gamma(T), gamma = (tau_E/eta_w) exp(beta (T - T_w)) sinh(tau/tau_E), mean gamma = dU/h."""
    lubricant = exponential(viscosity=0.5, eyring_stress=4e6)
    film = 3e-7
    pressure = 0.0
    stress, mean = heated_stress(lubricant, pressure, film, sliding, T0)
    eyring = 4e6 * (T0 + float(mean)) / T0
    beta = 0.04
    k = lubricant.conductivity
    wall_rate = eyring / 0.5 * math.sinh(float(stress) / eyring)

    def equations(y, t):
        return np.vstack([t[1], -float(stress) * wall_rate * np.exp(beta * t[0]) * film**2 / k])

    x = np.linspace(0, 1, 21)
    start = np.zeros((2, 21))
    solved = solve_bvp(equations, lambda a, b: np.array([a[0], b[0]]), x, start, tol=1e-8)
    assert solved.success
    y = np.linspace(0, 1, 4001)
    rate = np.trapezoid(wall_rate * np.exp(beta * solved.sol(y)[0]), y)
    assert rate == pytest.approx(sliding / film, rel=1e-6)


@pytest.mark.parametrize("ratio", [0.02, 0.3, 2.0])
def test_stress_and_temperature_satisfy_both_equations(ratio):
    x, p, h, _ = contact(1e9)
    result = heated_film(OIL, x, p, h, around(x, 2.0, ratio, contact_heat=2e7))
    heat = result.stress * ratio * 2.0 + 2e7
    carried = STEEL * (math.sqrt(2 * abs(1 - ratio / 2)) + math.sqrt(2 * (1 + ratio / 2)))
    for i in (60, 96, 150):
        rise = swept(lambda at: np.interp(at, x, heat), x[i], x[i] - x[0])
        assert result.wall[i] - T0 == pytest.approx(rise / math.sqrt(math.pi) / carried, rel=2e-5)
    assert result.stress == pytest.approx(heated_stress(OIL, p, h, ratio * 2.0, result.wall)[0], rel=1e-12)
    assert np.all(result.stress <= OIL.limit.critical_at(p, result.wall + result.film_rise) * (1 + 1e-9))


@settings(max_examples=12)
@given(st.floats(5e8, 1.5e9), st.floats(0.001, 2.0), st.floats(-2, 1))
def test_heated_force_lies_between_one_pass_and_isothermal(peak, ratio, log_speed):
    x, p, h, _ = contact(peak, 65)
    where = around(x, 10**log_speed, ratio)
    heated = heated_film(OIL, x, p, h, where)
    least = isothermal_heat(OIL, x, p, h, where)
    most = shear_stress(OIL, p, ratio * 10**log_speed / h)
    force = np.trapezoid(heated.stress, x)
    assert np.trapezoid(least.stress, x) <= force * (1 + 1e-6)
    assert force <= np.trapezoid(most, x) * (1 + 1e-6)


def test_a_limit_far_below_the_newtonian_stress_is_found():
    """At 6.9 GPa Roelands' viscosity asks for 1e20 times what the film bears; the limit is what it bears."""
    oil = Lubricant(0.033, 2.19e-8, limiting_stress_coefficient=0.06, temperature=365.0, temperature_coefficient=0.034)
    result, _ = heated_stress(oil, np.array([6.9e9]), np.array([1e-6]), 3.5, np.array([365.0]))
    assert 0 < result[0] <= 1e6 + 0.06 * 6.9e9


def test_heat_of_the_inlet_is_modelled_where_parts_of_f_cancel():
    """Film -0.15 % moves an f that is a small difference of large parts by 3 %: beside a hundredth of the tolerance."""
    scene = paper_scene(
        bodies={"radius": 0.0236, "width": 1e-2, "load": 96.15, "boundary_friction_coefficient": 0.0557},
        lubricant={"viscosity": 0.0238, "pressure_viscosity_coefficient": 7.1e-9, "eyring_stress": 5e6}
        | {"temperature": 350.0, "temperature_coefficient": 0.035},
        motion={"entrainment_speed": 0.0923, "slide_roll_ratio": -1.11},
        surface={"sq": 2.6e-8, "correlation_length": 2.2e-5, "seed": 1122854145},
        contact={"shape": (48, 48), "spacing": 6.25e-6},
        numerics={"sampling": "patch", "grid": "given", "film_deflection": "hydrodynamic"},
    )
    result, right = (lubfric.friction(scene.with_(numerics={"tolerance": t})) for t in (1e-2, 1e-4))
    parts = abs(result.couette_force) + abs(result.rolling_force) + result.boundary_force
    assert result.coefficient * 96.15 < 0.2 * parts and 1 - result.inlet_film_factor > 1e-3
    assert result.coefficient == pytest.approx(right.coefficient, rel=1e-2)
