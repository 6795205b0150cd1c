"""Smooth contact in time: exact squeeze, orders, reference table, similarity, reversal, jumps, failures."""

import math
from functools import partial

import numpy as np
import pytest

import lubfric
from lubfric.film import solve_ehl
from lubfric.scene import Harmonic, Ramp, Table
from lubfric.time import (
    Memory,
    Spring,
    StepEquations,
    make_fixed_grid,
    outside,
    outside_shear,
    solve_transient_ehl,
    symmetric_nodes,
)
from verification.check import Check
from verification.fem.studies import transient as study
from verification.fem.studies.transient import contact as moes

LOOSE = {"tolerance": 3e-3, "time_tolerance": 1e-4}


def jump(value, factor, at=0.0):
    before = () if at == 0.0 else (0.0,)
    return Table(times=(*before, at, at, 1e3), values=(value,) * (len(before) + 1) + (factor * value,) * 2)


@pytest.mark.parametrize(
    "part",
    [
        pytest.param(partial(study.squeeze, 128), marks=pytest.mark.slow),
        study.halved,
        pytest.param(study.stopped, marks=pytest.mark.slow),
    ],
)
def test_every_check_of_the_study_passes(part):
    """The exact squeeze, orders in time and space, a table by a separate solver, stops."""
    checks = [item for item in part() if isinstance(item, Check)]
    assert len(checks) > 1 and [check for check in checks if not check.passed] == []


@pytest.mark.parametrize("M, L", [(0.01, 1.0), (20, 5), (200, 10)])
def test_a_steady_film_stays(M, L):
    keywords, problem, unit = moes(M, L)
    result = solve_transient_ehl(**keywords, times=unit * np.array([0, 1.0, 10.0]))
    np.testing.assert_allclose(result.film_thickness, np.tile(result.film_thickness[0], (3, 1)), rtol=1e-6)
    steady = solve_ehl(**keywords, tolerance=1e-3)
    assert result.min_film[0] == pytest.approx(steady.min_film, rel=3e-3)
    assert result.central_film[0] == pytest.approx(steady.central_film, rel=3e-3)


def test_direction_and_units_do_not_matter():
    keywords, _, unit = moes(10, 5)
    keywords |= {"tolerance": 3e-3, "viscosity_law": "barus"}
    speed = keywords["entrainment_speed"]
    viscosity = keywords["viscosity"]
    times = unit * np.array([0.0, 1.0, 3.0])

    def film(times=times, **changed):
        return solve_transient_ehl(**keywords | changed, times=times)

    base, back = (film(entrainment_speed=jump(sign * speed, 0.3)) for sign in (1, -1))
    np.testing.assert_allclose(back.pressure[:, ::-1], base.pressure, rtol=1e-6, atol=1e-8 * base.pressure.max())
    np.testing.assert_allclose(back.min_film, base.min_film, rtol=1e-8)
    fast = film(times / 2, entrainment_speed=jump(2 * speed, 0.3), viscosity=viscosity / 2)
    np.testing.assert_allclose(fast.min_film, base.min_film, rtol=1e-6)
    thin = film(30 * times, viscosity=jump(viscosity, 0.5))  # halving the viscosity acts on a film as its own history
    steady = solve_ehl(**keywords | {"viscosity": viscosity / 2, "tolerance": 1e-3})
    assert thin.min_film[-1] == pytest.approx(steady.min_film, rel=3e-3)


@pytest.mark.parametrize(
    "name, factor", [(name, f) for name in ("entrainment_speed", "load_per_width") for f in (0.1, 10.0)]
)
def test_jumps_end_in_the_steady_state(name, factor):
    keywords, _, unit = moes(0.3 if factor == 10.0 else 3.0, 5)
    history = {name: jump(keywords[name], factor, at=unit)}
    result = solve_transient_ehl(**keywords | history, times=unit * np.array([0.5, 1, 100]), **LOOSE)
    ends = keywords, keywords | {name: factor * keywords[name]}
    before, after = (solve_ehl(**end, tolerance=1e-3).min_film for end in ends)
    assert result.report.converged and result.pressure.min() >= 0
    assert result.min_film[1:] == pytest.approx([before, after], rel=5e-3)


def test_a_radius_that_grows_ends_in_the_steady_state():
    keywords, _, unit = moes(3, 5)
    growing = {"radius": Ramp(start=0.01, end=0.02, begin=0.0, until=10 * unit)}
    result = solve_transient_ehl(**keywords | growing, times=unit * np.array([1, 60]), **LOOSE)
    steady = solve_ehl(**keywords | {"radius": 0.02}, tolerance=1e-3)
    assert result.min_film[-1] == pytest.approx(steady.min_film, rel=5e-3)


def test_reversal_passes_with_the_film_trapped_by_squeeze():
    keywords, problem, unit = moes(20, 5)
    speed = keywords["entrainment_speed"]
    period = 12 * unit
    keywords["entrainment_speed"] = Harmonic(amplitude=speed, frequency=1 / period, phase=math.pi / 2)
    times = period * np.linspace(0, 1.5, 61)
    result = solve_transient_ehl(**keywords, times=times, **LOOSE)
    assert result.pressure.min() >= 0 and result.min_film.min() > 0.2 * result.min_film[0]
    np.testing.assert_allclose(result.load, problem.line.load_per_width, rtol=1e-6)
    half = result.min_film[20:40]
    whole = result.min_film[40:60]
    np.testing.assert_allclose(whole, half, rtol=0.04)  # each half cycle mirrors the one before
    wet = result.pressure > 0
    assert not wet[0, -1] and not wet[20, 0]  # at full speed the outlet has ruptured, on either side in turn
    assert wet[10].all()  # at U = 0 squeeze drives lubricant out on both sides


def rough_state():
    _, problem, _ = moes(5, 8, "dowson-higginson")
    b = problem.half_width
    grid = make_fixed_grid(symmetric_nodes(0.4, (b, b), (3.0, 6.0)))
    rng = np.random.default_rng(1)
    P = np.sqrt(np.maximum(0.05, 1 - (grid.x / b) ** 2)) * (1 + 0.01 * rng.standard_normal(grid.n + 1))
    memory = Memory(0.7, 40 + 0.5 * grid.x**2)
    spring = Spring(weights=rng.random(grid.n + 1) / grid.n, opening=300.0, mean=20.0, load=2.0, power=9.0)
    return StepEquations(
        grid=grid, problem=problem, memory=memory, speed=0.4, load=3.0, curvature=1.2, viscosity=0.8, spring=spring
    ), np.append(P, 30.0)


def test_the_jacobian_is_the_derivative():
    equations, z = rough_state()
    J = equations.jacobian(equations.evaluate(z))
    rng = np.random.default_rng(2)
    for _ in range(4):
        d = rng.standard_normal(z.size)
        d[:-1] *= np.abs(z[:-1])

        def both(step):
            t = equations.evaluate(z + step * d)
            return np.append(t.r, t.balance)

        numerical = (both(1e-6) - both(-1e-6)) / 2e-6
        np.testing.assert_allclose(J @ d, numerical, rtol=2e-5, atol=2e-6 * np.abs(numerical).max())


def test_a_spring_ends_at_its_opening_and_is_straight_where_it_is_compressed():
    spring = Spring(weights=np.ones(1), opening=5.0, mean=3.0, load=7.0, power=1.5)

    def load(film):
        return spring.at(np.array([film]))[0]

    assert load(3.0) == 7.0
    assert load(4.0) == pytest.approx(7.0 / 2.0**1.5)  # of a Hertz contact
    assert spring.at(np.array([5.0])) == spring.at(np.array([6.0])) == (0.0, 0.0)
    bend = 5.0 - 2.0 * np.e ** (2 / 3)
    assert load(bend) == pytest.approx(7.0 * np.e)
    assert load(bend) - 2 * load(bend - 1.0) + load(bend - 2.0) == pytest.approx(0.0, abs=1e-12)
    for film in (bend - 1.0, 2.0, 4.9):
        numerical = (load(film + 1e-6) - load(film - 1e-6)) / 2e-6
        assert spring.at(np.array([film]))[1] == pytest.approx(numerical, rel=1e-6)


def test_the_tail_is_the_integral_of_reynolds_equation():
    from scipy.integrate import quad

    a = 12.0
    film = 71.0
    c = 0.9
    nu = 0.7
    speed = 0.8
    flow = 1.3
    rate = -0.2
    h = lambda s: film + 0.5 * c * (s * s - a * a)  # noqa: E731
    slope = lambda s: 6 * nu * (flow + rate * (s - a) - speed * h(s)) / h(s) ** 3  # noqa: E731
    pressure, load = outside(a, film, c, nu, speed, flow, rate)
    assert pressure[0] == pytest.approx(-quad(slope, a, np.inf, epsrel=1e-11)[0], rel=1e-8)
    assert load[0] == pytest.approx(-quad(lambda s: (s - a) * slope(s), a, np.inf, epsrel=1e-11)[0], rel=1e-8)
    reach, shear = outside_shear(a, film, c, nu, speed, flow, rate)
    assert reach == pytest.approx(quad(lambda s: 1 / h(s), a, np.inf)[0], rel=1e-8)
    assert shear == pytest.approx(quad(lambda s: 0.5 * h(s) * slope(s), a, np.inf)[0], rel=1e-8)


@pytest.mark.parametrize(
    "change, words",
    [
        ({"times": [0.0, 2.0, 1.0]}, "increase"),
        ({"load_per_width": Harmonic(mean=1.0, amplitude=2.0)}, "load_per_width"),
        ({"viscosity": -0.1}, "viscosity"),
        ({"entrainment_speed": 0.0}, "initial_film"),
        ({"entrainment_speed": Table(times=(0.0, 0.1), values=(1.0, 1.0))}, "table ends"),
    ],
)
def test_bad_input_is_refused(change, words):
    keywords, _, _ = moes(10, 5)
    with pytest.raises(lubfric.InputError, match=words):
        solve_transient_ehl(**keywords | {"times": [0.0, 1.0]} | change)
