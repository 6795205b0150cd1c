"""Secondary physics of a film that heats itself, against the formulas of its sources, written out again."""

import math

import numpy as np
import pytest
from scene_text import paper_scene
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import lubfric
from lubfric.film import heated_stress, inlet_heat, viscosity_at
from lubfric.oil import Lubricant

T0 = 350.0
BETA = 0.035
ETA = 0.05
ALPHA = 2.0e-8
K = 0.15
LAWS = {"temperature": T0, "temperature_coefficient": BETA, "conductivity": K}
OIL = Lubricant(ETA, ALPHA, eyring_stress=5e6, limiting_stress_coefficient=0.06, limiting_stress_offset=2e6, **LAWS)
SCENE = paper_scene(
    bodies={"radius": 0.01, "hertz_pressure": 0.9e9, "width": 0.01, "e_prime": 2.27e11},
    lubricant={"viscosity": 0.03, "pressure_viscosity_coefficient": 2e-8, "eyring_stress": 5e6, **LAWS},
    contact={"shape": (64, 16), "spacing": 8e-6},
    surface={"sq": 0.0, "correlation_length": 3e-5, "acf": "gaussian"},
    numerics={"sampling": "patch", "heat": "on", "accept": True},
)


@pytest.mark.parametrize("temperature", [320.0, 350.0, 420.0])
def test_stresses_and_viscosity_over_temperature(temperature):
    """Houpert et al. (1981), Eyring (1936) and Roelands (1966): hotter oil bears less and thins later."""
    p = np.array([0.0, 5e8, 1.2e9])
    limit = (2e6 + 0.06 * p) * math.exp(585.0 / temperature - 585.0 / T0)
    np.testing.assert_allclose(OIL.limit.critical_at(p, temperature), limit, rtol=1e-12)
    assert OIL.flow_law.critical_at(p, temperature) == pytest.approx(5e6 * temperature / T0)
    pole = math.log(ETA) + 9.67
    z = ALPHA * 1.96e8 / pole
    s0 = BETA * (T0 - 138.0) / pole
    exponent = pole * (1 + p / 1.96e8) ** z * ((temperature - 138.0) / (T0 - 138.0)) ** -s0
    log_viscosity, slope = viscosity_at(OIL, p, temperature)
    np.testing.assert_allclose(log_viscosity, exponent - 9.67, rtol=1e-12)
    np.testing.assert_allclose(slope, exponent * s0 / (temperature - 138.0), rtol=1e-12)
    barus = viscosity_at(Lubricant(ETA, ALPHA, viscosity_law="barus", **LAWS), p, temperature)[0]
    np.testing.assert_allclose(barus, math.log(ETA) + ALPHA * p - BETA * (temperature - T0), rtol=1e-12)


def test_a_film_that_hardly_heats_is_as_hot_in_the_mean_as_a_parabola():
    """Heat tau dU/h in a slab of conductivity k between walls: (tau dU/h) h²/(12 k) in the mean."""
    plain = Lubricant(ETA, 0.0, viscosity_law="constant", **LAWS)
    film = np.array([2e-7])
    sliding = 0.3
    tau, rise = heated_stress(plain, np.zeros(1), film, sliding, np.array([T0]))
    assert tau[0] == pytest.approx(ETA * sliding / 2e-7, rel=1e-2)
    assert rise[0] == pytest.approx(tau[0] * sliding * 2e-7 / (12 * K), rel=1e-9)


def test_a_hot_carreau_film_is_that_of_the_heat_equation_across_it():
    """k T'' = -tau rate, rate = that of the stress in the walls times exp(beta (T - T_w)), from the middle to the wall;
    G goes with the mean temperature."""
    G0 = 2e5
    n = 0.6
    h = 4e-6
    sliding = 12.0
    oil = Lubricant(ETA, 0.0, viscosity_law="constant", carreau=(G0, n), **LAWS)
    (tau,), (rise,) = heated_stress(oil, np.zeros(1), np.array([h]), sliding, np.array([T0]))
    G = G0 * (T0 + rise) / T0
    rate = G / ETA * brentq(lambda r: r * (1 + r * r) ** ((n - 1) / 2) - tau / G, 0.0, (tau / G) ** (1 / n) + 1)

    def across(middle):
        def of(z, y):
            here = rate * math.exp(BETA * y[0])
            return [y[1], -tau * here / K, here]

        return solve_ivp(of, (0.0, h / 2), [middle, 0.0, 0.0], rtol=1e-9, atol=1e-9).y[:, -1]

    middle = brentq(lambda t: across(t)[0], 0.0, 1.8 * rise)  # 1.5 for a parabola
    assert middle > 5 and 2 * across(middle)[2] == pytest.approx(sliding, rel=2e-3)


def test_a_film_at_its_limit_bears_what_its_mean_temperature_allows():
    p = 1.0e9
    h = 3e-7
    sliding = 0.5
    wall = 360.0

    def left(tau):
        return tau - (2e6 + 0.06 * p) * math.exp(585 / (wall + tau * sliding * h / (12 * K)) - 585 / T0)

    expected = brentq(left, 1e6, 1e9)
    limited = Lubricant(ETA, ALPHA, limiting_stress_coefficient=0.06, limiting_stress_offset=2e6, **LAWS)
    result, rise = heated_stress(limited, np.array([p]), np.array([h]), sliding, np.array([wall]))
    assert result[0] == pytest.approx(expected, rel=1e-9) and rise[0] == pytest.approx(
        expected * sliding * h / (12 * K)
    )


@pytest.mark.parametrize("ratio", [0.0, 0.1, -0.7, 2.0])
@pytest.mark.parametrize("number", [0.01, 0.3, 1.0, 6.0])
@pytest.mark.parametrize("pressure_ratio", [0.001, 0.006])
def test_inlet_factors_over_the_thermal_number_and_the_sliding(number, ratio, pressure_ratio):
    """Gupta et al. (1992); and Wilson and Sheu (1983) as Olver and Spikes use it."""
    speed = math.sqrt(number * 0.15 / (0.05 * 0.035))
    result = inlet_heat(
        viscosity=0.05,
        temperature_coefficient=0.035,
        conductivity=0.15,
        speed=speed,
        slide_roll_ratio=ratio,
        pressure_ratio=pressure_ratio,
    )
    s = abs(ratio) ** 0.83
    gupta = (1 - 13.2 * pressure_ratio * number**0.42) / (1 + 0.213 * (1 + 2.23 * s) * number**0.64)
    assert result.thermal_number == pytest.approx(number) and result.factor == pytest.approx(gupta, rel=1e-12)
    assert result.other == pytest.approx(1 / (1 + 0.1 * (1 + 14.8 * s) * number**0.64), rel=1e-12)


def at(speed, ratio, **bodies):
    return lubfric.friction(SCENE.with_(bodies=bodies, motion={"slide_roll_ratio": ratio}), speed)


def test_the_inlet_of_a_scene_has_its_own_numbers():
    result = at(2.0, 0.5)
    bodies = SCENE.bodies
    peak = math.sqrt(bodies.load / bodies.width * bodies.e_prime / (2 * math.pi * bodies.radius))
    number = 0.03 * BETA * 2.0**2 / K
    gupta = (1 - 13.2 * peak / bodies.e_prime * number**0.42) / (1 + 0.213 * (1 + 2.23 * 0.5**0.83) * number**0.64)
    assert peak == pytest.approx(0.9e9, rel=1e-6)
    assert result.inlet_film_factor == pytest.approx(gupta, rel=1e-9)


@pytest.mark.parametrize("key, other", [("conductivity", 1.1), ("volumetric_heat", 2e5)])
def test_unlike_bodies_carry_the_heat_of_their_own_surface(key, other):
    """At a slide-roll ratio of 2 the first surface stands still and carries none away, at -2 the second. In between
    both do, the faster one more."""
    steel = getattr(SCENE.bodies, key)[0]
    first = {key: (other, steel)}
    second = {key: (steel, other)}
    for ratio, idle, moving in ((2.0, first, second), (-2.0, second, first)):
        plain = at(1.0, ratio)
        assert at(1.0, ratio, **idle).coefficient == plain.coefficient
        assert at(1.0, ratio, **moving).flash_temperature_rise > 1.3 * plain.flash_temperature_rise
    slow, fast = (at(1.0, 1.0, **bodies).flash_temperature_rise for bodies in (first, second))
    assert at(1.0, 1.0).flash_temperature_rise < slow < fast


def test_half_the_effusivity_is_a_flash_of_twice_the_heat():
    """Flash over stress and speed goes with 1/(e1 √u1 + e2 √u2), e = √(k rho c) (Jaeger 1942)."""
    like = at(1.0, 0.02)
    quarter = at(1.0, 0.02, conductivity=(11.5, 11.5))
    made = like.couette_force / quarter.couette_force
    assert quarter.flash_temperature_rise * made == pytest.approx(2 * like.flash_temperature_rise, rel=0.02)
