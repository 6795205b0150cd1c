"""Solved points: limits against the smooth film and the dry contact, what must not change, heavy loads, failures."""

from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

import lubfric
from lubfric.deterministic import Start, dry_contact, estimate, solve_refined, state_on
from lubfric.deterministic.domain import lay_out
from lubfric.deterministic.forces import forces
from lubfric.deterministic.march import march
from lubfric.deterministic.newton import newton
from lubfric.deterministic.solve import Work, solve_point
from lubfric.deterministic.start import dry_start
from lubfric.deterministic.state import FLUID, RUPTURED, look, residuals
from lubfric.deterministic.transfer import refined_start
from lubfric.film import LineContact
from lubfric.oil import Lubricant
from lubfric.surface.height_map import Surface

E_PRIME, WIDTH, RADIUS = 231e9, 6e-3, 2e-3
NEWTONIAN = Lubricant(0.36, 25e-9)
LIMITED = replace(
    NEWTONIAN, density_law="dowson-higginson", limiting_stress_coefficient=0.09, limiting_stress_offset=2e6
)
MAP = lubfric.generate_surface((96, 96), 90e-6 / 96, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=4)


def contact(load, speed, lubricant=NEWTONIAN, radius=RADIUS):
    return LineContact(load, radius, E_PRIME, speed, lubricant)


def rough(cells, load, speed, lubricant=NEWTONIAN, surface=MAP, **more):
    grid = surface.resampled(shape=(cells, cells))
    return lay_out(grid, contact(load, speed, lubricant), sliding=2 * speed, boundary_friction=0.09, **more)


LIGHT = rough(48, 917.0, 0.01)
FOUND = solve_point(LIGHT)


@pytest.mark.parametrize(
    "load, radius, speed, oil",
    [
        (917.0, RADIUS, 0.3, NEWTONIAN),
        (18333.0, RADIUS, 0.1, replace(NEWTONIAN, density_law="dowson-higginson")),
        (1e5, 1e-2, 1.0, Lubricant(0.04, 22e-9, density_law="dowson-higginson")),
    ],
    ids=["M .09 L 27", "M 3 L 20", "M 7 L 12"],
)
def test_smooth_limit_is_the_film_of_solve_ehl(load, radius, speed, oil):
    line = contact(load, speed, oil, radius)
    smooth = Surface(np.zeros((64, 1)), (1e-6, 1e-6), periodic_axes=(True, True))
    from lubfric.deterministic import reach

    step = sum(reach(line, 0.0)) / 512
    found = solve_point(lay_out(replace(smooth, spacing=(step, step)), line, sliding=2 * speed, boundary_friction=0.09))
    film = lubfric.solve_ehl(
        load_per_width=load,
        radius=radius,
        e_prime=E_PRIME,
        entrainment_speed=speed,
        viscosity=oil.viscosity,
        pressure_viscosity_coefficient=oil.pressure_viscosity_coefficient,
        density=oil.density_law,
        tolerance=1e-4,
    )
    assert found.min_gap == pytest.approx(film.min_film, rel=1e-3)
    assert found.flow_film == pytest.approx(film.flow_film, rel=1e-3)
    assert np.interp(0.0, found.x, found.gap[:, 0]) == pytest.approx(film.central_film, rel=1e-3)


def test_dry_limit_is_the_rough_contact():
    problem = rough(64, 917.0, 2e-6, hardness=6e9)
    found, dry = solve_point(problem), dry_contact(problem, tolerance=1e-8)
    difference = np.sqrt(np.mean((found.pressure - dry.pressure) ** 2) / np.mean(dry.pressure**2))
    assert difference < 0.01
    assert found.split.touching == pytest.approx(917.0, rel=1e-2)
    assert found.coefficient == pytest.approx(0.09, rel=1e-2)


def test_a_solution_keeps_every_balance_by_sums_of_its_fields():
    found, dx = FOUND, LIGHT.spacing[0]
    assert found.pressure.sum() * dx / found.pressure.shape[1] + found.inlet_load == pytest.approx(917.0, rel=1e-5)
    elastic = LIGHT.operator.apply(found.pressure) + LIGHT.rigid_gap + found.approach
    assert np.abs(np.maximum(elastic, LIGHT.floor) - found.gap).max() < 1e-13
    assert found.pressure.min() >= 0
    tau = found.shear * found.wet
    assert (tau.sum() + 0.09 * found.pressure[found.spots].sum()) * dx / found.pressure.shape[1] == pytest.approx(
        found.boundary + found.couette, rel=2e-2
    )  # the film far upstream is not in the fields
    assert found.report.residual <= 1e-5 and max(found.report.residuals.values()) == found.report.residual
    assert residuals(LIGHT, look(LIGHT, found.state)) == found.report.residuals


def with_heights(change):
    return replace(LIGHT, heights=change(LIGHT.heights))


def test_what_must_not_change_the_coefficient():
    shifted = solve_point(with_heights(lambda z: np.roll(z, 17, axis=1)))
    mirrored = solve_point(with_heights(lambda z: z[:, ::-1]))
    raised = solve_point(with_heights(lambda z: z + 3e-6))
    for other in (shifted, mirrored, raised):
        assert other.coefficient == pytest.approx(FOUND.coefficient, rel=1e-5)
    assert np.abs(np.roll(FOUND.pressure, 17, axis=1) - shifted.pressure).max() < 1e-3 * FOUND.pressure.max()
    k = 3.0  # all lengths times 3, load times 3 a width, viscosity a third: every dimensionless group is kept
    oil = replace(NEWTONIAN, viscosity=0.36)
    similar = Surface(MAP.heights * k, (MAP.spacing[0] * k,) * 2, periodic_axes=(True, True)).resampled(shape=(48, 48))
    line = LineContact(917.0 * k, RADIUS * k, E_PRIME, 0.03, oil)
    larger = solve_point(lay_out(similar, line, sliding=0.06, boundary_friction=0.09, floor=k * LIGHT.floor))
    assert larger.coefficient == pytest.approx(FOUND.coefficient, rel=1e-4)


def test_neither_start_nor_floor_changes_the_answer():
    fast = solve_point(rough(48, 917.0, 0.03))
    warm = solve_point(LIGHT, starts=[Start(lambda: state_on(LIGHT, fast), fast.speed)])
    assert warm.coefficient == pytest.approx(FOUND.coefficient, rel=1e-4)
    assert warm.report.iterations < FOUND.report.iterations
    low = solve_point(replace(LIGHT, floor=0.5e-9))
    assert low.coefficient == pytest.approx(FOUND.coefficient, rel=1e-3)


def test_fewer_asperities_carry_at_higher_speed():
    shares = [solve_point(rough(48, 917.0, u)).split.spots / 917.0 for u in (0.1, 0.03, 0.003)]
    assert shares[0] < 0.05 < shares[1] < 0.6 < shares[2] < 1


@pytest.mark.parametrize("speed", [0.1, 0.001])
def test_a_heavy_load_is_solved_from_a_cold_start(speed):
    found = solve_point(rough(32, 18333.0, speed, LIMITED, hardness=4e9))
    assert found.report.converged and found.pressure.max() <= 4e9 * (1 + 1e-12)
    assert 0.06 < found.coefficient < 0.1
    assert (found.dent > 0).any() == (speed < 0.01) or found.pressure.max() < 4e9


def test_a_bearing_at_one_gigapascal_is_solved_speed_by_speed():
    """1.05 GPa, Sq 200 nm: cold at the first speed, then speed by speed; every balance by sums of the fields."""
    oil = replace(LIMITED, viscosity=0.04, pressure_viscosity_coefficient=22e-9)
    surface = lubfric.generate_surface(
        (96, 24), 90e-6 / 24, sq=200e-9, correlation_length=10e-6, acf="gaussian", seed=2
    )
    last, shares = None, []
    for speed in (0.3, 0.05):
        line = contact(3e5, speed, oil, 1e-2)
        problem = lay_out(surface, line, sliding=2 * speed, boundary_friction=0.09, hardness=6e9)
        starts = [] if last is None else [Start(partial(state_on, problem, last), last.speed)]
        last = solve_point(problem, starts=starts)
        carried = last.pressure.sum() * problem.spacing[0] / 24 + last.inlet_load
        assert carried == pytest.approx(3e5, rel=1e-5) and last.pressure.max() <= 6e9 * (1 + 1e-12)
        assert last.drawn < 0.1 and 0 <= last.fill.min() and last.fill.max() <= 1
        shares.append(last.split.spots / 3e5)
    assert shares[0] < 0.75 < 0.9 < shares[1] < 1
    assert last.coefficient == pytest.approx(0.09, rel=0.05)


def test_a_nearly_smooth_film_at_one_gigapascal_opens_touching_cells_together():
    """Sq 25 nm at 1 mm/s: of cells that open those a rounding error below the floor closed again, one a step stayed
    open, and it took 97 factorisations and a faster speed."""
    oil = replace(LIMITED, viscosity=0.04, pressure_viscosity_coefficient=22e-9)
    surface = lubfric.generate_surface((42, 16), 60e-6 / 16, sq=25e-9, correlation_length=10e-6, acf="gaussian", seed=1)
    line = contact(3e5, 1e-3, oil, 1e-2)
    found = solve_point(lay_out(surface, line, sliding=2e-3, boundary_friction=0.1, hardness=6e9))
    assert "from the dry contact" in found.report.notes[0] and found.report.iterations <= 16
    assert found.touching.any() and found.drawn < 0.1


def test_the_gap_of_touching_bodies_matters_where_they_give_off_the_lubricant():
    """The caution against what it warns of: f at half of that gap."""
    from verification.stability.whole_map import bearing

    moved = {}
    for name, problem in (("slow", bearing(1e-7, 3e5, 1e-3, across=16)), ("fast", rough(32, 18333.0, 0.01, LIMITED))):
        found = solve_point(problem)
        moved[name] = found.drawn, abs(solve_point(replace(problem, floor=0.5e-9)).coefficient / found.coefficient - 1)
    assert moved["slow"][0] > 0.1 and 2e-3 < moved["slow"][1] < 0.03
    assert moved["fast"][0] < 0.1 and moved["fast"][1] < 1e-3


def test_cells_that_give_off_fluid_do_not_open_and_close_for_ever():
    """1.05 GPa, Sq 100 nm, 1 mm/s: cells that were opened although they give off fluid sank below the floor, and closed
    those that had to stay open, so that Newton's method went round in a cycle. Load, gap and signs are those of the
    map's own judge."""
    from verification.stability.whole_map import bearing, check

    problem = bearing(1e-7, 3e5, 1e-3, across=24)
    found = solve_point(problem)
    assert found.report.iterations <= 80 and found.report.residual <= 1e-5  # it took 114
    wrong = check(problem, found)
    assert found.touching.any() and max(wrong["load"], wrong["gap"], wrong["signs"]) <= 1


def test_steps_in_time_lead_from_a_neighbouring_speed_to_the_steady_film():
    """To the same film as Newton's method from the dry contact, which shares none of the way."""
    problem = rough(32, 18333.0, 0.01, LIMITED, hardness=4e9)
    fast = solve_point(problem.at_speed(0.1))
    way = march(problem, state_on(problem, fast), most=300)
    there = newton(problem, way.state, tolerance=1e-5, most=5)
    assert there.residual <= 1e-5 and way.steps >= 3 and way.factorisations < 300
    cold = solve_point(problem)
    assert np.abs(there.look.state.pressure - cold.pressure).max() < 1e-3 * cold.pressure.max()


def test_no_speed_is_tried_twice_from_the_same_state(monkeypatch):
    """On the way to another speed, where a step is too long, the next one is half of what was tried."""
    tried: list[tuple[float, float]] = []

    def solved_if_near(self, problem, state, tolerance, most=0):
        tried.append((state, problem.speed))
        near = problem.speed > (0.5 if problem.speed > 0.0105 else 0.9) * state  # at the end only short steps
        return SimpleNamespace(residual=0.0 if near else 1.0, look=SimpleNamespace(state=problem.speed))

    monkeypatch.setattr(Work, "direct", solved_if_near)
    assert Work().walk(rough(16, 917.0, 0.01), 0.1, 0.1, 1e-5).look.state == pytest.approx(0.01)
    assert len(set(tried)) == len(tried) and tried[-1][1] == pytest.approx(0.01)


def test_all_ways_together_take_no_more_factorisations_than_they_may():
    with pytest.raises(lubfric.ConvergenceError, match="of 7 factorisations") as failure:
        solve_point(rough(32, 18333.0, 0.001, LIMITED, hardness=4e9), most=7)
    assert failure.value.report.iterations == 7


def test_plastic_cells_carry_the_limit_and_are_dented():
    problem = rough(48, 917.0, 0.001, hardness=1.5e9)
    found = solve_point(problem)
    dented = found.dent > 0
    assert dented.sum() > 5 and np.all(found.pressure[dented] == 1.5e9)
    dry = lubfric.solve_contact(
        problem.rigid_gap, problem.spacing, E_PRIME, mean_pressure=917.0 / (problem.x.size * problem.spacing[0]),
        hardness=1.5e9, boundary=("free", "periodic"),
    )  # fmt: skip
    assert dented.mean() == pytest.approx(dry.plastic_area_fraction, rel=0.2)


def test_the_rule_for_spots_hardly_moves_with_its_two_numbers():
    at = look(LIGHT, FOUND.state)
    reference = forces(LIGHT, at)
    for pressed, close in ((10e6, 0.5), (200e6, 0.5), (50e6, 0.35), (50e6, 0.7)):
        other = forces(LIGHT, at, pressed, close)
        assert other.split.spots == pytest.approx(reference.split.spots, rel=0.03)
    split = reference.split
    assert split.touching <= split.spots <= split.saturated <= split.whole == 917.0


def test_finer_cells_change_little_and_the_estimate_tells():
    grids = [(24, 24), (48, 48), (96, 96)]
    found = solve_refined(lambda shape: rough(shape[0], 917.0, 0.01), grids, tolerance=0.0)
    coarse, middle, fine = (r.coefficient for r in found.results)
    assert abs(fine - middle) < abs(middle - coarse) < 0.1 * fine
    assert found.error == estimate([coarse, middle, fine]) < 0.02
    started = refined_start(rough(24, 917.0, 0.01), LIGHT, found.results[0])
    assert solve_point(LIGHT, starts=[Start(lambda: started, LIGHT.speed)]).report.iterations < FOUND.report.iterations
    assert estimate([1.0, 1.2, 1.3]) == pytest.approx(0.1 / 1.3) and estimate([1.0]) is None


def test_a_failure_is_reported_and_carries_what_was_found():
    problem = rough(16, 917.0, 0.01)
    with pytest.raises(lubfric.ConvergenceError) as failed:
        solve_point(problem, tolerance=1e-17)
    report = failed.value.report
    for way in ("from the dry contact", "in time from"):
        assert way in str(failed.value)
    assert not report.converged and report.residual > 1e-17 and failed.value.result.pressure.shape[1] == 16
    assert solve_point(problem, tolerance=report.residual * 1.01).report.converged


def test_too_many_cells_are_refused_before_any_work():
    flat = Surface(np.zeros((8, 4096)), (1e-8, 1e-8), periodic_axes=(True, True))
    with pytest.raises(lubfric.InputError, match="cells"):
        lay_out(flat, contact(917.0, 0.01), sliding=0.02, boundary_friction=0.09)


def test_a_bearing_at_a_gigapascal_is_solved_from_the_dry_contact():
    """From a cold start by Newton's method alone: in the valleys of the Hertz strip the start has fluid, and the film
    finds its shape in short steps before the residual falls. Load, gap and signs are those of the map's own judge."""
    from verification.stability.whole_map import bearing, check

    heavy = bearing(200e-9, 2.72e5, 0.3, across=32)
    start = dry_start(heavy, dry_contact(heavy), heavy.contact.moes_film)
    inside = np.abs(heavy.x) <= heavy.contact.half_width
    assert (
        heavy.contact.peak_pressure > 0.99e9 and (start.kind[inside] == FLUID).all() and (start.kind == RUPTURED).any()
    )
    found = solve_point(heavy)
    assert "from the dry contact; " in found.report.notes[0] and found.report.iterations <= 50
    wrong = check(heavy, found)
    assert max(wrong["load"], wrong["gap"], wrong["signs"]) <= 1
