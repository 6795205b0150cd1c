"""The paper's single loop and the nested alternative, against the load-controlled solver and on their own terms."""

import numpy as np
import pytest

import lubfric
from lubfric.contact import half_space, solve_contact
from lubfric.paper import alternating, single_loop

E = 231e9
D = 1e-6
N = 96
RADIUS = 2e-3
BOUNDARIES = {"flat": ("periodic", "periodic"), "cylinder": ("free", "periodic"), "ball": ("free", "free")}
CASES = [(shape, hardness) for shape in BOUNDARIES for hardness in (None, 2e9)]


def case(shape, hardness, size=None):
    """Heights, film whose volume the load-controlled solution holds, area A, and that solution."""
    z = lubfric.generate_surface((N, N), D, sq=1e-7, correlation_length=6e-6, acf="gaussian", seed=3).heights
    x = (np.arange(N) - (N - 1) / 2) * D
    b = size or 15e-6
    if shape == "flat":
        film = np.zeros((N, N))
        area = np.ones((N, N))
        pressure = size or 300e6
    elif shape == "cylinder":
        film = np.repeat((x**2 / (2 * RADIUS))[:, None], N, 1)
        area = np.repeat((abs(x) <= b)[:, None] * 1.0, N, 1)
        pressure = b**2 * np.pi * E / (8 * RADIUS) / (N * D)
    else:
        square = x[:, None] ** 2 + x**2
        film = square / (2 * RADIUS)
        area = (square <= b**2) * 1.0
        pressure = 2 / 3 * b**3 * E / RADIUS / (N * D) ** 2
    boundary = BOUNDARIES[shape]
    operator = half_space((N, N), D, E, boundary)
    direct = solve_contact(
        film - z, D, E, mean_pressure=pressure, hardness=hardness, boundary=boundary, operator=operator, tolerance=1e-7
    )
    volume = np.sum(area * np.maximum(direct.gap, 0)) / area.sum()
    film = film + volume - np.sum(area * film) / area.sum()
    return z, film, {"weight": area, "hardness": hardness, "boundary": boundary, "operator": operator}, direct


def difference(a, b):
    return np.linalg.norm(a.pressure - b.pressure) / np.linalg.norm(b.pressure)


@pytest.mark.parametrize("shape,hardness", CASES)
@pytest.mark.parametrize("method", [single_loop, alternating])
def test_agrees_with_the_load_controlled_contact(method, shape, hardness):
    z, film, options, direct = case(shape, hardness)
    result = method(z, film, D, E, **options)
    assert result.report.converged and difference(result, direct) < 1e-4
    assert result.mean_pressure == pytest.approx(direct.mean_pressure, rel=1e-5)
    assert result.plastic_area_fraction == pytest.approx(direct.plastic_area_fraction, abs=3 / N**2)
    gap = film - z - result.approach + options["operator"].apply(result.pressure)
    assert np.allclose(gap, result.gap, atol=1e-14)
    area = options["weight"]
    assert np.sum(area * np.maximum(gap, 0)) / area.sum() == pytest.approx(np.sum(area * film) / area.sum(), rel=1e-5)


@pytest.mark.parametrize(
    "shape,size",
    [("flat", 1e6), ("flat", 1.5e9), ("cylinder", 2e-6), ("cylinder", 25e-6), ("ball", 3e-6), ("ball", 25e-6)],
)
def test_from_one_contact_to_most_of_the_area(shape, size):
    z, film, options, direct = case(shape, None, size)
    result = single_loop(z, film, D, E, **options)
    assert difference(result, direct) < 1e-4 and result.report.iterations < 100


def test_the_printed_loop_converges_where_it_can():
    for size in (50e6, 300e6):
        z, film, options, direct = case("flat", None, size)
        printed = single_loop(z, film, D, E, form="printed", **options)
        assert difference(printed, direct) < 1e-4


def test_the_printed_loop_says_where_it_stalls():
    z, film, options, direct = case("flat", 2e9)
    printed = single_loop(z, film, D, E, form="printed", raise_on_failure=False, **options)
    assert printed.report.status == "stagnated" and difference(printed, direct) > 5e-3
    with pytest.raises(lubfric.ConvergenceError, match="printed: stagnated") as failed:
        single_loop(z, film, D, E, form="printed", **options)
    assert failed.value.report.residual > 1e-3 and failed.value.result.pressure.shape == z.shape


def test_the_separation_test_alone_stops_too_early_and_is_not_believed():
    """Eq. (23) is met while the pressure is far off: epsilon is exact from the first iteration when periodic."""
    z, film, options, direct = case("flat", None)
    early = single_loop(z, film, D, E, stop="separation", raise_on_failure=False, **options)
    assert not early.report.converged and early.report.residual > 0.1 and early.report.iterations < 5
    honest = single_loop(z, film, D, E, **options)
    assert "Eq. (23) met at iteration 1" in honest.report.notes[0]
    strict = single_loop(z, film, D, E, form="printed", stop="separation", separation_tolerance=1e-12, **options)
    assert strict.report.converged and difference(strict, direct) < 1e-4


def test_repeating_creeps_where_the_bulk_deflection_follows_the_separation():
    z, film, options, direct = case("cylinder", None, 25e-6)
    repeated = alternating(z, film, D, E, update="repeat", **options)
    root = alternating(z, film, D, E, **options)
    assert difference(repeated, direct) < 1e-4 and difference(root, direct) < 1e-4
    assert repeated.report.iterations > 3 * root.report.iterations
    assert repeated.report.evaluations > 10 * single_loop(z, film, D, E, **options).report.evaluations


def test_a_film_above_the_summits_needs_no_contact():
    z, film, options, _ = case("cylinder", None)
    for method in (single_loop, alternating):
        clear = method(z, film + 1e-6, D, E, **options)
        assert clear.report.converged and not clear.pressure.any() and clear.gap.min() >= 0


@pytest.mark.parametrize(
    "change,match",
    [({"film": 0.0}, "mean of film"), ({"film": np.zeros((3, 4))}, "film has shape")]
    + [({"weight": -1.0}, "weight"), ({"form": "print"}, "printed"), ({"stop": "step"}, "stop")]
    + [({"separation_tolerance": 0}, "separation_tolerance")],
)
def test_bad_input(change, match):
    z = lubfric.generate_surface((32, 32), D, sq=1e-7, correlation_length=3e-6, acf="gaussian", seed=1).heights
    with pytest.raises(lubfric.InputError, match=match):
        single_loop(z, **({"film": 1e-7, "spacing": D, "e_prime": E} | change))
