"""The equations of the deterministic film against quadrature, differences, closed forms and averaged flows."""

import math

import numpy as np
import pytest
import rigid_cylinder as rigid
from scipy.integrate import quad

from lubfric.contact import half_space
from lubfric.film import LineContact
from lubfric.models.deterministic import (
    Problem,
    derivatives,
    lay_out,
    mass_balance,
    mean_fluidity,
    solve_point,
    thinning,
)
from lubfric.models.deterministic.inlet import inlet
from lubfric.models.deterministic.linear import Patterns
from lubfric.oil import Lubricant
from lubfric.surface import Surface

RADIUS = 2e-3
SPEED = 0.1
LAWS = {
    "Newtonian": Lubricant(0.36, 25e-9),
    "Eyring": Lubricant(0.36, 25e-9, density_law="dowson-higginson", eyring_stress=5e6),
    "Carreau": Lubricant(0.36, 25e-9, carreau=(5e6, 0.6)),
    "limit": Lubricant(
        0.36, 25e-9, viscosity_law="barus", limiting_stress_coefficient=0.09, limiting_stress_offset=2e6
    ),
    "both": Lubricant(0.1, 20e-9, eyring_stress=3e6, limiting_stress_coefficient=0.05),
    "constant": Lubricant(0.1, viscosity_law="constant", density_law="dowson-higginson"),
}


def small(lubricant, shape=(12, 6), step=5e-6, e_prime=231e9, load=900.0):
    random = np.random.default_rng(3)
    x = (np.arange(shape[0]) - 8) * step
    contact = LineContact(
        load_per_width=load, radius=RADIUS, e_prime=e_prime, entrainment_speed=SPEED, lubricant=lubricant
    )
    operator = half_space(shape, step, e_prime, ("free", "periodic"))
    return Problem(
        line=contact,
        sliding=2 * SPEED,
        x=x,
        heights=1e-8 * random.standard_normal(shape),
        operator=operator,
        boundary_friction=0.09,
    )


@pytest.mark.parametrize("left, right", [(0.0, 0.0), (1.0, 1.0004), (3.0, 40.0), (40.0, 3.0), (2.0, 1.0)])
def test_mean_fluidity_is_the_mean_of_the_exponential_and_its_derivatives(left, right):
    result, by_left, by_right = mean_fluidity(np.array([left]), np.array([right]))
    exact = quad(lambda t: np.exp(-(left + t * (right - left))), 0, 1, epsabs=0, epsrel=1e-11, points=[0.02, 0.98])[0]
    assert result[0] == pytest.approx(np.log(exact), abs=1e-7)
    step = 1e-6
    for by, dl, dr in ((by_left, step, 0.0), (by_right, 0.0, step)):
        up = mean_fluidity(np.array([left + dl]), np.array([right + dr]))[0]
        down = mean_fluidity(np.array([left - dl]), np.array([right - dr]))[0]
        assert by[0] == pytest.approx((up - down)[0] / (2 * step), abs=2e-4)


@pytest.mark.parametrize("name", LAWS)
def test_derivatives_are_those_of_the_residual(name):
    problem = small(LAWS[name])
    random = np.random.default_rng(1)
    shape = problem.heights.shape
    p = 1e8 * random.random(shape)
    h = 1e-7 + 1e-7 * random.random(shape)
    p[0] *= 0.1
    h[0] = problem.x[0] ** 2 / (2 * RADIUS)
    by_p, by_h, _ = (
        Patterns.of(*shape).rows(d) for d in derivatives(problem, mass_balance(problem, p, h), np.ones(shape, bool))
    )
    for matrix, base, step, at in (
        (by_p, p, 10.0, lambda v: mass_balance(problem, v, h).residual),
        (by_h, h, 1e-14, lambda v: mass_balance(problem, p, v).residual),
    ):
        d = random.standard_normal(shape)
        numerical = (at(base + step * d) - at(base - step * d)) / (2 * step)
        analytic = (matrix @ d.ravel()).reshape(shape)
        first = 5e-3 if name not in ("Newtonian", "constant") else 1e-6  # the inlet's thinning is taken as it stands
        assert np.abs(analytic - numerical)[1:].max() < 1e-6 * np.abs(numerical).max()
        assert np.abs(analytic - numerical)[0].max() < first * np.abs(numerical).max()


def test_inlet_against_martins_closed_form():
    """A rigid isoviscous film: pressure, load and rolling friction upstream of a point, from the exact pressure."""
    eta = 0.01
    h0 = 1e-6
    oil = Lubricant(eta, viscosity_law="constant")
    problem = small(oil, e_prime=1e13)
    edge = problem.x[0] - 2.5e-6
    pressure = lambda x: rigid.pressure(x, h0, radius=RADIUS, entrainment_speed=SPEED, viscosity=eta)  # noqa: E731
    film = h0 + problem.x[0] ** 2 / (2 * RADIUS)
    result = inlet(problem, pressure(np.full(6, problem.x[0])), np.full(6, film))
    q = SPEED * h0 * rigid.rigid_constants().flow_film_ratio
    assert result.flow == pytest.approx(q, rel=2e-3)  # half a cell of 5 µm is differenced
    load = quad(lambda x: float(pressure(x)), -np.inf, edge, epsrel=1e-10, epsabs=0)[0]
    assert result.load == pytest.approx(load, rel=2e-3)
    gap = lambda x: h0 + x**2 / (2 * RADIUS)  # noqa: E731
    slope = lambda x: 12 * eta * (SPEED * gap(x) - q) / gap(x) ** 3  # noqa: E731
    assert result.rolling == pytest.approx(quad(lambda x: 0.5 * gap(x) * slope(x), -np.inf, edge)[0], rel=2e-3)
    assert result.shearing == pytest.approx(quad(lambda x: 1 / gap(x), -np.inf, edge)[0], rel=1e-4)


def rigid_load(q_of, film_at, eta, x):
    """Load and rupture of a one-dimensional film with the flow factors ``q_of``: flow = a(h) - b(h) dp/dx/(12 eta)."""
    from scipy.optimize import brentq

    fine = np.linspace(x[0], x[-1], 20001)
    a, b = q_of(film_at(fine))

    def pressure(q):
        slope = 12 * eta * (a - q) / b
        p = np.concatenate([[0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(fine))])
        return p, slope

    def at_rupture(q):  # p where its slope vanishes behind the middle
        p, slope = pressure(q)
        behind = np.flatnonzero((fine > 0) & (slope > 0))
        return p[behind[0]] if behind.size else p[-1]

    low = a.min() * 1.0001
    high = a.min() * 1.7
    q = brentq(at_rupture, low, high, xtol=1e-18, rtol=1e-12)
    p, slope = pressure(q)
    end = np.flatnonzero((fine > 0) & (slope > 0))[0]
    return float(np.sum(0.5 * (p[1 : end + 1] + p[:end]) * np.diff(fine)[:end])), q


@pytest.mark.parametrize("along", [True, False], ids=["along", "across"])
def test_rigid_waviness_against_christensens_averages(along):
    """Short waves of 0.4 h0: longitudinal ones average h and h³, transverse ones 1/h² and 1/h³ (Christensen 1969)."""
    eta = 0.01
    h0 = 2e-6
    amplitude = 0.8e-6
    oil = Lubricant(eta, viscosity_law="constant")
    phase = 2 * np.pi * (np.arange(64) + 0.5) / 64

    def factors(h):
        wavy = h[:, None] + amplitude * np.cos(phase)
        if along:
            return SPEED * wavy.mean(axis=1), (wavy**3).mean(axis=1)
        return SPEED * (wavy**-2).mean(axis=1) / (wavy**-3).mean(axis=1), 1 / (wavy**-3).mean(axis=1)

    ends = (4.5e-4, 1.5e-4)
    n = 1200
    waves = 100
    dx = sum(ends) / n
    if along:
        heights = amplitude * np.cos(2 * np.pi * (np.arange(32) + 0.5) / 32) * np.ones((4, 1))
        surface = Surface(heights, (dx * 4, 4e-7), periodic_axes=(True, True))
    else:
        heights = amplitude * np.cos(2 * np.pi * waves * (np.arange(n) + 0.5) / n)[:, None]
        surface = Surface(heights, (dx, dx), periodic_axes=(True, True))
    x = np.linspace(-20 * ends[0], ends[1], 3)
    load, q = rigid_load(factors, lambda s: h0 + s**2 / (2 * RADIUS), eta, x)
    contact = LineContact(load_per_width=load, radius=RADIUS, e_prime=1e13, entrainment_speed=SPEED, lubricant=oil)
    problem = lay_out(surface, contact, sliding=2 * SPEED, boundary_friction=0.09, ends=ends)
    result = solve_point(problem)
    lift = result.gap + problem.heights - (problem.x**2 / (2 * RADIUS))[:, None]
    assert result.flow_film == pytest.approx(q / SPEED, rel=0.02)
    assert np.median(lift) == pytest.approx(h0, rel=0.02)


def test_a_film_ruptures_and_refills_where_its_flow_says():
    """Two rigid humps: behind the first the gap holds what passed it, and the second film begins where the flow fills
    enough of its inlet: q = U h where it ruptures, ∫ (U h - q)/h³ dx = 0 over its length (Jakobsson-Floberg-Olsson)."""
    from scipy.optimize import brentq

    n = 600
    step = 1e-6
    x = (np.arange(n) - 400) * step
    oil = Lubricant(0.01, viscosity_law="constant")
    contact = LineContact(load_per_width=12.0, radius=RADIUS, e_prime=1e13, entrainment_speed=SPEED, lubricant=oil)
    heights = 2.4e-6 * np.exp(-(((x - 100e-6) / 25e-6) ** 2))[:, None]
    operator = half_space((n, 1), step, 1e13, ("free", "periodic"))
    problem = Problem(line=contact, sliding=2 * SPEED, x=x, heights=heights, operator=operator, boundary_friction=0.09)
    result = solve_point(problem)
    h = result.gap[:, 0]
    p = result.pressure[:, 0]
    fill = result.fill[:, 0]
    q = result.flow_film
    carried = np.where(fill < 1, fill * (h + np.diff(h, prepend=h[0]) / 2), q)
    assert np.count_nonzero(np.abs(carried / q - 1) > 1e-6) <= 1  # but where the second film pushes back into a cell
    second = np.flatnonzero((p > 0) & (x > x[np.argmax(fill < 1)]))
    fine = np.linspace(x[0], x[-1], 200001)
    gap = np.interp(fine, x, h)
    narrowest = fine[np.argmin(np.where(fine > 50e-6, gap, np.inf))]
    behind = fine > narrowest
    end = fine[behind][np.argmax(gap[behind] > q)]

    def mean_slope(begin):
        inside = (fine >= begin) & (fine <= end)
        return np.trapezoid((gap[inside] - q) / gap[inside] ** 3, fine[inside])

    begin = brentq(mean_slope, 40e-6, narrowest)
    assert x[second[0]] == pytest.approx(begin, abs=3 * step) and x[second[-1]] == pytest.approx(end, abs=3 * step)
    assert (fill[second[0] - 10 : second[0] - 2] < 1).all() and fill.min() > 0


ETA = 0.1
U = 0.4
DX = 4e-6
DY = 9e-6
SHAPE = (40, 24)
WATER = Lubricant(ETA, viscosity_law="constant")


def even(lubricant=WATER):
    x = (np.arange(SHAPE[0]) - 30) * DX
    contact = LineContact(load_per_width=900.0, radius=RADIUS, e_prime=231e9, entrainment_speed=U, lubricant=lubricant)
    return Problem(
        line=contact,
        sliding=2 * U,
        x=x,
        heights=np.zeros(SHAPE),
        operator=half_space(SHAPE, (DX, DY), 231e9, ("free", "periodic")),
        boundary_friction=0.09,
    )


@pytest.mark.parametrize("axis, waves", [(0, 2), (1, 2), (1, 3)])
def test_a_wave_of_pressure_drives_its_flow_along_its_own_axis(axis, waves):
    """In an even gap: div(-h³/(12 eta) grad p), with the difference of neighbours for the derivative."""
    h = 2e-7
    step = (DX, DY)[axis]
    places = np.arange(SHAPE[axis])
    line = 1e7 * (2 + np.sin(2 * np.pi * waves * places / SHAPE[axis]))
    p = np.broadcast_to(line[:, None] if axis == 0 else line[None, :], SHAPE)
    result = mass_balance(even(), p, np.full(SHAPE, h)).residual[2:-1]
    second = (np.roll(line, -1) - 2 * line + np.roll(line, 1)) / step**2
    expected = -(h**3) / (12 * ETA) * (second[2:-1, None] if axis == 0 else second[None, :])
    everywhere = np.broadcast_to(expected, result.shape)
    most = abs(expected).max()
    np.testing.assert_allclose(result, everywhere, rtol=1e-8, atol=1e-8 * most)


def test_a_wedge_takes_in_what_it_is_dragged():
    """U dh/dx without pressure, for a gap that falls in a straight line; across the motion a slope drags nothing."""
    x = np.arange(SHAPE[0]) * DX
    h = 4e-7 - 1e-3 * np.broadcast_to(x[:, None], SHAPE)
    np.testing.assert_allclose(mass_balance(even(), np.zeros(SHAPE), h).residual[3:], -U * 1e-3, rtol=1e-9)
    across = np.broadcast_to(3e-7 + 1e-8 * np.arange(SHAPE[1])[None, :], SHAPE)
    np.testing.assert_allclose(mass_balance(even(), np.zeros(SHAPE), across).residual[3:], 0.0, atol=1e-12)


def test_the_narrowest_place_limits_the_flow():
    """Between two cells with h linear the mean of 1/h³ is (h1 + h2)/(2 h1² h2²)."""
    p = np.full(SHAPE, 1e7)
    h = np.full(SHAPE, 4e-7)
    p[:, 5] = 3e7
    h[:, 5] = 1e-7
    flow = mass_balance(even(), p, h).across.flow
    mean = (1e-7 + 4e-7) / (2 * 1e-14 * 16e-14)
    np.testing.assert_allclose(flow[:, 5], 2e7 / DY / (12 * ETA * mean), rtol=1e-9)
    np.testing.assert_allclose(flow[:, 4], -2e7 / DY / (12 * ETA * mean), rtol=1e-9)


@pytest.mark.parametrize("s", [0.3, 3.0, 40.0])
def test_sliding_thins_by_eyrings_law_and_by_the_limit(s):
    """Conry et al. (1987): the tangent √(1 + s²) along the sliding, the secant s/asinh(s) across; a limit adds s."""
    oil = Lubricant(ETA, 1e-8, eyring_stress=5e6)
    tau = np.array([s * 5e6])
    along, across = (float(thinning(oil, tau, [5e6], along=way)[0][0]) for way in (True, False))
    assert along == pytest.approx(math.sqrt(1 + s * s)) and across == pytest.approx(s / math.asinh(s))
    limited = Lubricant(ETA, 1e-8, limiting_stress_coefficient=0.05)
    assert float(thinning(limited, tau, [2e7], along=True)[0][0]) == pytest.approx(1 + s * 5e6 / 2e7)
