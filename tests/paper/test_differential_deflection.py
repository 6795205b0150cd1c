"""Differential deflection against the full integral, the default solver and closed forms."""

import math

import numpy as np
import pytest

import lubfric
from lubfric.film import hat_kernel
from lubfric.paper import differential_equations, solve_differential_deflection
from verification.fem.parts import E_PRIME as E
from verification.fem.parts import RADIUS as R
from verification.fem.parts import case_of

PAPER = {"load_per_width": 5.5 / 6e-3, "radius": 2e-3, "e_prime": 231e9, "viscosity": 0.36}
PAPER |= {"pressure_viscosity_coefficient": 25e-9}


def moes(M, L, **options):
    return case_of(M, L) | options


def numbers(result):
    unit = result.load / (result.e_prime * result.line.M)
    return np.array([result.min_film, result.central_film, result.flow_film]) / unit


def test_the_answer_does_not_depend_on_the_band(monkeypatch):
    kw = moes(50, 10, nodes=401, tolerance=0.1)
    runs = []
    for m in (0, 2, 8, 40, 400):
        monkeypatch.setattr(differential_equations, "BANDWIDTH", m)
        runs.append(solve_differential_deflection(**kw))
    films = np.array([numbers(r) for r in runs])
    assert np.max(np.abs(films / films[-1] - 1)) < 2e-5
    solves = [r.report.evaluations for r in runs]
    assert sorted(solves, reverse=True) == solves and solves[0] > 3 * solves[-1]
    assert solves[-1] == runs[-1].report.iterations  # full band: every step is exact at once


# Against others


@pytest.mark.parametrize("M, L", [(1e-3, 5), (0.1, 0.1), (1, 15), (20, 5), (300, 0.1), (300, 15)])
def test_agrees_with_the_default_solver(M, L):
    ours = solve_differential_deflection(**moes(M, L))
    default = lubfric.solve_ehl(**moes(M, L), tolerance=5e-4)
    np.testing.assert_allclose(numbers(ours), numbers(default), rtol=3.5e-3)
    assert ours.flux == pytest.approx(default.flux, rel=3.5e-3)
    assert abs(ours.approach - default.approach) < 0.01 * default.flow_film
    assert abs(ours.rupture - default.rupture) < 0.05 * math.sqrt(2 * R * default.flow_film)


def test_agrees_with_the_default_solver_to_five_digits():
    kw = moes(20, 5, density_law="dowson-higginson")
    ours = solve_differential_deflection(**kw, tolerance=3e-5)
    np.testing.assert_allclose(numbers(ours), numbers(lubfric.solve_ehl(**kw, tolerance=2e-5)), rtol=4e-5)


@pytest.mark.parametrize("speed", [1e-4, 1e-2, 1.0])
def test_grid_of_the_paper(speed):
    """2000 points at 0.8 micrometres. At 1e-4 m/s six of them span a Hertz half-width: the film is within
    1 %, and the solver says that the grid cannot show it."""
    kw = PAPER | {"entrainment_speed": speed}
    ours = solve_differential_deflection(**kw, nodes=2000, domain=(-1.2e-3, 1999 * 0.8e-6 - 1.2e-3), tolerance=0.1)
    default = lubfric.solve_ehl(**kw, tolerance=3e-4)
    assert np.diff(ours.x)[0] == pytest.approx(0.8e-6)
    error = np.abs(numbers(ours) / numbers(default) - 1)
    assert max(error) < 0.01 and error[2] < 1e-3
    assert ours.report.residuals["discretisation"] + 1e-3 > max(error)


# What the result says of itself


@pytest.fixture(scope="module")
def heavy():
    return solve_differential_deflection(**moes(50, 10), tolerance=1e-3)


def test_the_film_is_that_of_the_full_integral(heavy):
    """Recomputed on the nodes of the result by the dense kernel, whatever the report says."""
    r = heavy
    s = r.x / r.half_width
    bend = hat_kernel(s, s) @ r.pressure * r.half_width / r.e_prime
    h = r.approach + r.x**2 / (2 * R) + bend
    np.testing.assert_allclose(r.film_thickness, h, rtol=2e-4)
    assert np.trapezoid(r.pressure, r.x) == pytest.approx(r.load, rel=2e-4)
    assert r.pressure.min() == 0 and np.all(r.pressure[r.x >= r.rupture] == 0)
    assert np.interp(r.rupture, r.x, r.film_thickness) == pytest.approx(r.flow_film, rel=1e-3)
    assert set(r.report.residuals) == {"discretisation", "domain", "mass", "film", "load", "complementarity"}


def test_reversed_motion_mirrors(heavy):
    kw = moes(50, 10)
    kw["entrainment_speed"] *= -1
    back = solve_differential_deflection(**kw, tolerance=1e-3)
    np.testing.assert_array_equal(back.x, -heavy.x[::-1])
    np.testing.assert_array_equal(back.pressure, heavy.pressure[::-1])
    assert back.flux == -heavy.flux and back.rupture == -heavy.rupture


def test_a_failed_solve_says_so():
    with pytest.raises(lubfric.ConvergenceError) as failure:
        solve_differential_deflection(**moes(20, 5), max_iterations=1)
    assert failure.value.report.status == "iteration_limit" and failure.value.result.x.size > 0
    coarse = solve_differential_deflection(**moes(300, 1), nodes=129, raise_on_failure=False)
    assert not coarse.report.converged


def test_a_domain_that_ends_before_rupture_says_so():
    kw = moes(0.1, 5)
    b = math.sqrt(8 * kw["load_per_width"] * R / (math.pi * E))
    r = solve_differential_deflection(**kw, nodes=401, domain=(-300 * b, 1.5 * b), raise_on_failure=False)
    assert not r.report.converged and "did not rupture" in r.report.notes[-1]


@pytest.mark.parametrize(
    "bad, name",
    [
        ({"nodes": 20}, "nodes"),
        ({"domain": (0, 1e-3)}, "domain"),
        ({"inlet_length": 1e-9}, "inlet_length"),
        ({"domain": (-1e-3, 1e-3), "inlet_length": 1e-3}, "domain"),
        ({"tolerance": 0}, "tolerance"),
    ],
)
def test_bad_input(bad, name):
    with pytest.raises(lubfric.InputError, match=name):
        solve_differential_deflection(**moes(5, 5) | bad)
