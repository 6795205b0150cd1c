"""The rough film by finite elements: its limits, and what it keeps in time."""

from itertools import islice

import numpy as np
import pytest

pytest.importorskip("skfem")

from verification.fem.solvers.ehl import LineContact, solve_ehl
from verification.fem.solvers.fluid import Fluid
from verification.fem.solvers.report import InputError
from verification.fem.solvers.rough_ehl import Discretisation, RoughLine, march, solve_rough

STEEL = LineContact(
    load_per_width=1e5,
    radius=1e-2,
    e_prime=2.3e11,
    entrainment_speed=0.5,
    fluid=Fluid(0.04, viscosity_law="roelands", pressure_viscosity_coefficient=18e-9, density_law="dowson-higginson"),
)
B = STEEL.half_width
COARSE = (40, 2)


def line(heights, cells=(56, 4), floor=None) -> RoughLine:
    return RoughLine(contact=STEEL, inlet=-3.5 * B, outlet=1.5 * B, period=B, cells=cells, heights=heights, floor=floor)


@pytest.fixture(scope="module")
def flat():
    return solve_rough(Discretisation(line(lambda x, y, t: 0 * x)))


@pytest.fixture(scope="module")
def coarse():
    return solve_rough(Discretisation(line(lambda x, y, t: 0 * x, COARSE)))


@pytest.mark.slow
def test_a_smooth_surface_has_the_film_of_the_line_contact(flat):
    smooth = solve_ehl(STEEL, refinements=0, fineness=1.0, between=0.05)[-1]
    x = flat.problem.x
    middle = np.abs(x) < 0.8 * B
    film = smooth.at(x[middle])[1]
    assert np.ptp(flat.gap, axis=1).max() < 1e-9 * flat.gap.min()
    assert np.abs(flat.gap[middle, 0] / film - 1).max() < 0.02  # the inlet begins at 3.5 b here
    assert float((flat.weights * flat.pressure).sum()) == pytest.approx(STEEL.load_per_width, rel=1e-6)


@pytest.mark.slow
def test_ridges_along_the_motion_of_small_height_are_linear_in_it(flat):
    """Twice the height has twice the change of the gap, and its mean over y stays."""
    changes = []
    for height in (1e-9, 2e-9):
        ridges = Discretisation(line(lambda x, y, t, height=height: height * np.cos(2 * np.pi * y / B) + 0 * x))
        changes.append(solve_rough(ridges, flat).gap - flat.gap)
    middle = np.abs(flat.problem.x) < 0.5 * B
    once, twice = (change[middle] for change in changes)
    assert np.abs(twice - 2 * once).max() < 0.02 * np.abs(twice).max()
    assert np.abs(once).max() < 1e-9


@pytest.mark.slow
def test_a_surface_at_rest_stays_as_it_is_in_time(flat):
    grid = Discretisation(line(lambda x, y, t: 0 * x))
    later = list(islice(march(grid, flat, 0.1 * B / 0.5), 3))[-1]
    assert np.abs(later.gap / flat.gap - 1).max() < 1e-4


def test_an_odd_number_of_cells_is_refused():
    with pytest.raises(InputError, match="even"):
        line(lambda x, y, t: 0 * x, (63, 4))


def test_a_floor_below_the_film_changes_nothing(coarse):
    film = solve_rough(Discretisation(line(coarse.problem.heights, COARSE, floor=1e-9)), coarse)
    assert not film.touching.any()
    assert np.abs(film.gap / coarse.gap - 1).max() < 0.01  # its rigid gap is interpolated between the nodes


def test_bodies_that_touch_all_over_have_the_dry_contact_of_hertz(coarse):
    """The floor is twenty times the film: hardly any lubricant separates the bodies, and their pressure is Hertz'."""
    floor = 20 * float(coarse.gap.min())
    film = solve_rough(Discretisation(line(coarse.problem.heights, COARSE, floor=floor)), coarse)
    x = coarse.problem.x / B
    hertz = STEEL.hertz_pressure * np.sqrt(np.maximum(1 - x**2, 0))
    middle = np.abs(x) < 0.5
    assert film.touching[middle].all()
    assert np.abs(film.pressure[middle, 0] - hertz[middle]).max() < 0.05 * STEEL.hertz_pressure
    assert float((film.weights * film.pressure).sum()) == pytest.approx(STEEL.load_per_width, rel=1e-6)


@pytest.mark.slow
def test_touching_nodes_are_complementary(flat):
    """Nowhere is the gap below the floor, and where the bodies touch it is the floor."""
    waves = line(lambda x, y, t: 100e-9 * np.cos(2 * np.pi * x / B) * np.cos(2 * np.pi * y / B), (48, 8), floor=140e-9)
    film = solve_rough(Discretisation(waves))
    assert 5 < film.touching.sum() < film.touching.size / 2
    assert film.gap.min() > 140e-9 * (1 - 1e-6)
    assert np.abs(film.gap[film.touching] / 140e-9 - 1).max() < 1e-6
    assert film.pressure.min() >= 0
