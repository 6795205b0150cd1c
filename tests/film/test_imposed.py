"""A line pressure imposed on a film."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from lubfric import ConvergenceError, InputError, solve_ehl
from lubfric.film import hat_kernel, hertz
from lubfric.film.grid import line_deflection

E, R = 231e9, 10e-3
OIL = {"radius": R, "e_prime": E, "viscosity": 0.1, "pressure_viscosity_coefficient": 2e-8}


def semi_ellipse(load, width=None, centre=0.0, count=65):
    """(x, pressure) of ``load`` over ``width`` (Hertz's)."""
    width = width or hertz.line_half_width(load, R, E)
    angle = np.linspace(-math.pi / 2, math.pi / 2, count)
    p = np.cos(angle)
    p[[0, -1]] = 0.0
    x = centre + width * np.sin(angle)
    return x, p * (load / np.trapezoid(p, x))


# ------------------------------------------------------------------ the deflection


def test_deflection_and_its_slope_are_exact():
    nodes, values = np.array([-1.0, -0.3, 0.2, 0.9]), np.array([0.4, 1.0, 0.7, 0.0])
    points = np.array([-2.0, -0.6, 0.2, 0.5, 3.0])
    found, slope = line_deflection(points, nodes, values)
    for x, u in zip(points, found):
        breaks = [b for b in (*nodes[1:-1], x) if -1 < b < 0.9]
        integral, _ = quad(lambda s, x=x: np.interp(s, nodes, values) * math.log(abs(x - s)), -1.0, 0.9, points=breaks)
        assert u == pytest.approx(-4 / math.pi * integral, abs=1e-7)
    np.testing.assert_allclose(found, hat_kernel(points, nodes) @ values, rtol=1e-12)
    both = [line_deflection(points + d, nodes, values)[0] for d in (1e-5, -1e-5)]
    np.testing.assert_allclose(slope, (both[0] - both[1]) / 2e-5, rtol=1e-4, atol=1e-4)


# ------------------------------------------------------------------ limits


@pytest.mark.parametrize("speed", [1e-3, 0.3])
def test_no_pressure_imposed_is_none_imposed(speed):
    case = OIL | {"load_per_width": 3e4, "entrainment_speed": speed}
    alone, zero = solve_ehl(**case), solve_ehl(**case, imposed_pressure=([-1e-3, 1e-3], [0.0, 0.0]))
    assert np.array_equal(alone.film_thickness, zero.film_thickness) and zero.imposed is None
    assert np.array_equal(alone.pressure, zero.pressure) and alone.approach == zero.approach
    little = solve_ehl(**case, imposed_pressure=semi_ellipse(3e-3))
    assert little.min_film == pytest.approx(alone.min_film, rel=2e-3)


def rigid_film(gap, film, speed, viscosity, ends):
    """Load over a rigid gap + film with Swift-Stieber rupture, by quadrature of Reynolds' equation."""
    from scipy.optimize import brentq

    x = np.linspace(*ends, 40001)
    h = gap(x) + film

    def pressure(rupture):
        slope = 12 * viscosity * speed * (h - (gap(rupture) + film)) / h**3
        slope[x > rupture] = 0.0
        return np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(x))])

    rupture = brentq(lambda e: pressure(e)[-1], 1e-9, ends[1])
    return np.trapezoid(np.where(x <= rupture, pressure(rupture), 0.0), x), rupture


@pytest.mark.parametrize("relative", [0.1, 0.4, 2.0])
def test_a_tiny_own_load_rides_on_the_flattened_cylinder(relative):
    """Hertz pressure imposed, isoviscous oil, little load: Reynolds in the known gap of the dry contact."""
    total, b = 1e5, hertz.line_half_width(1e5, R, E)
    film, speed = relative * b**2 / R * 0.05, 1e-7
    load, rupture = rigid_film(lambda x: hertz.line_gap(x, total, R, E), film, speed, 0.1, (-12 * b, 6 * b))
    found = solve_ehl(
        **OIL | {"viscosity_law": "constant"},
        load_per_width=load,
        entrainment_speed=speed,
        imposed_pressure=semi_ellipse(total, count=257),
    )
    assert load < 1e-4 * total
    assert found.central_film == pytest.approx(film, rel=0.02)
    assert found.rupture == pytest.approx(rupture, rel=0.01)
    x = np.linspace(-4, 3, 30) * b
    np.testing.assert_allclose(found.film_at(x), film + hertz.line_gap(x, total, R, E), rtol=0.02)


@pytest.mark.parametrize("share", [0.8, 0.5])
def test_the_inlet_of_a_heavy_piezoviscous_contact_sees_the_total_pressure(share):
    """Grubin: the inlet gap is Hertz's of the total pressure, and of the own one it matters only that it is high."""
    total = 1e6
    x, p = semi_ellipse(total, count=129)
    case = OIL | {"entrainment_speed": 0.1, "viscosity_law": "barus"}
    found = solve_ehl(**case, load_per_width=share * total, imposed_pressure=(x, (1 - share) * p))
    whole = solve_ehl(**case, load_per_width=total)
    assert found.flow_film == pytest.approx(whole.flow_film, rel=0.08)
    inside = np.abs(x) < 0.8 * x[-1]
    np.testing.assert_allclose(np.interp(x, found.x, found.pressure)[inside], share * p[inside], rtol=0.05)


def test_a_heavy_isoviscous_film_grows_as_its_share_to_the_power_of_minus_three_fifths():
    """Inlet of Hertz's gap ~ s^(3/2), pressure share s^(1/2) = eta U s/h² at s ~ h^(2/3): h ~ share^(-3/5)."""
    x, p = semi_ellipse(1e6, count=129)
    case = OIL | {"entrainment_speed": 1e-3, "viscosity_law": "constant"}
    films = [
        solve_ehl(**case, load_per_width=f * 1e6, imposed_pressure=(x, (1 - f) * p)).flow_film for f in (0.8, 0.4, 0.2)
    ]
    np.testing.assert_allclose(np.diff(np.log(films)), 0.6 * math.log(2), rtol=0.12)


def test_more_of_the_pressure_imposed_never_thins_the_film():
    case = OIL | {"entrainment_speed": 0.01, "load_per_width": 5e3}
    films = [solve_ehl(**case, imposed_pressure=semi_ellipse(w, 5e-5)).flow_film for w in (1.0, 1e3, 4e3, 8e3)]
    assert np.all(np.diff(films) > 0)


# ------------------------------------------------------------------ numerics


def test_reversal_mirrors():
    x, p = semi_ellipse(5e4, centre=1e-5)
    p = p * (1 + x / (4 * np.abs(x).max()))
    case = OIL | {"load_per_width": 3e4}
    forth = solve_ehl(**case, entrainment_speed=0.05, imposed_pressure=(x, p))
    back = solve_ehl(**case, entrainment_speed=-0.05, imposed_pressure=(-x[::-1], p[::-1]))
    assert np.array_equal(back.x, -forth.x[::-1]) and np.array_equal(back.film_thickness, forth.film_thickness[::-1])
    places = np.linspace(-10, 10, 51) * forth.half_width
    np.testing.assert_allclose(back.film_at(places), forth.film_at(-places), rtol=1e-12)
    np.testing.assert_allclose(back.imposed_deflection(places), forth.imposed_deflection(-places), rtol=1e-9)


@pytest.mark.parametrize("width, shift", [(0.9, 0.0), (1.0, -0.02), (1.1, 0.02), (1.5, 0.02)])
@pytest.mark.parametrize("share", [1e-3, 0.03, 0.3, 0.9])
def test_converges_for_other_widths_and_off_the_centre(width, shift, share):
    """As long as the gap that is left has one bottom, or one that the film bridges."""
    for total in (1e4, 1e5):
        b = hertz.line_half_width(total, R, E)
        for speed in (1e-3, 1e-2, 0.3) if width >= 1 else (0.3,):
            r = solve_ehl(
                **OIL,
                load_per_width=share * total,
                entrainment_speed=speed,
                tolerance=0.01,
                imposed_pressure=semi_ellipse((1 - share) * total, width * b, shift * b),
            )
            assert r.film_thickness.min() > 0 and r.report.residual <= 0.01


def test_a_gap_with_two_bottoms_has_no_film_that_ruptures_once_and_says_so():
    imposed = semi_ellipse(9e4, 0.9 * hertz.line_half_width(1e5, R, E))
    case = OIL | {"load_per_width": 1e4, "entrainment_speed": 1e-3, "imposed_pressure": imposed}
    with pytest.raises(ConvergenceError, match="line-contact EHL") as caught:
        solve_ehl(**case)
    assert caught.value.report.residual > caught.value.report.tolerance


@pytest.mark.parametrize(
    "bad",
    [
        3,
        ([0.0], [1.0]),
        ([0.0, 1.0], [1.0]),
        ([1.0, 0.0], [1.0, 1.0]),
        ([0.0, 1.0], [1.0, -1.0]),
        ([0.0, 1.0], [1.0, float("nan")]),
    ],
)
def test_bad_input(bad):
    with pytest.raises(InputError, match="imposed_pressure"):
        solve_ehl(**OIL, load_per_width=1e4, entrainment_speed=0.1, imposed_pressure=bad)
