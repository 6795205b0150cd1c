"""Solved points: limits against the smooth film and the dry contact, what must not change, heavy loads, failures."""

from dataclasses import replace

import numpy as np
import pytest

import lubfric
from lubfric.film import LineContact
from lubfric.models.deterministic import (
    Work,
    dry_contact,
    error_by_gap,
    evaluated,
    lay_out,
    march,
    reach,
    residuals,
    solve_point,
)
from lubfric.models.deterministic.linear import CYCLES, MOST_KRYLOV
from lubfric.models.deterministic.newton import newton
from lubfric.models.deterministic.solve import dry_start, refined_start
from lubfric.oil import Lubricant, shear_stress
from lubfric.surface import Surface
from verification.campaigns.stability.whole_map import bearing, check

E_PRIME = 231e9
RADIUS = 2e-3
NEWTONIAN = Lubricant(0.36, 25e-9)
LIMIT = {"limiting_stress_coefficient": 0.09, "limiting_stress_offset": 2e6}
LIMITED = replace(NEWTONIAN, density_law="dowson-higginson", **LIMIT)
MAP = lubfric.generate_surface((96, 96), 90e-6 / 96, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=4)


def contact(load, speed, lubricant=NEWTONIAN, radius=RADIUS):
    return LineContact(
        load_per_width=load, radius=radius, e_prime=E_PRIME, entrainment_speed=speed, lubricant=lubricant
    )


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
    step = sum(reach(line, 0.0)) / 512
    smooth = Surface(np.zeros((64, 1)), (step, step), periodic_axes=(True, True))
    result = solve_point(lay_out(smooth, line, sliding=2 * speed, boundary_friction=0.09))
    film = lubfric.solve_ehl(
        load_per_width=load,
        radius=radius,
        e_prime=E_PRIME,
        entrainment_speed=speed,
        viscosity=oil.viscosity,
        pressure_viscosity_coefficient=oil.pressure_viscosity_coefficient,
        density_law=oil.density_law,
        tolerance=1e-4,
    )
    assert result.min_gap == pytest.approx(film.min_film, rel=1e-3)
    assert result.flow_film == pytest.approx(film.flow_film, rel=1e-3)
    assert np.interp(0.0, result.x, result.gap[:, 0]) == pytest.approx(film.central_film, rel=1e-3)


def test_dry_limit_is_the_rough_contact():
    problem = rough(64, 917.0, 2e-6, hardness=6e9)
    result = solve_point(problem)
    dry = dry_contact(problem, tolerance=1e-8)
    difference = np.sqrt(np.mean((result.pressure - dry.pressure) ** 2) / np.mean(dry.pressure**2))
    assert difference < 0.01
    assert (result.split.touching, result.coefficient) == pytest.approx((917.0, 0.09), rel=1e-2)


def test_a_solution_keeps_every_balance_by_sums_of_its_fields():
    result = FOUND
    dx = LIGHT.spacing[0]
    assert result.pressure.sum() * dx / result.pressure.shape[1] + result.inlet_load == pytest.approx(917.0, rel=1e-5)
    elastic = LIGHT.operator.apply(result.pressure) + LIGHT.rigid_gap + result.approach
    assert np.abs(np.maximum(elastic, LIGHT.floor) - result.gap).max() < 1e-13
    assert result.pressure.min() >= 0
    tau = result.shear * result.wet
    assert (tau.sum() + 0.09 * result.pressure[result.rubbing].sum()) * dx / result.pressure.shape[1] == pytest.approx(
        result.boundary + result.couette, rel=2e-2
    )  # the film far upstream is not in the fields
    assert result.report.residual <= 1e-5 and max(result.report.residuals.values()) == result.report.residual
    assert residuals(evaluated(LIGHT, result.state)) == result.report.residuals


def test_what_must_not_change_the_coefficient():
    z = LIGHT.heights
    shifted, mirrored, raised = (
        solve_point(replace(LIGHT, heights=heights)) for heights in (np.roll(z, 17, axis=1), z[:, ::-1], z + 3e-6)
    )
    assert np.abs(np.roll(FOUND.pressure, 17, axis=1) - shifted.pressure).max() < 1e-3 * FOUND.pressure.max()
    k = 3.0  # lengths, load a width and speed times 3: every dimensionless group is kept
    similar = Surface(MAP.heights * k, (MAP.spacing[0] * k,) * 2, periodic_axes=(True, True)).resampled(shape=(48, 48))
    line = contact(917.0 * k, 0.03, radius=RADIUS * k)
    laid = lay_out(similar, line, sliding=0.06, boundary_friction=0.09, boundary_film=k * LIGHT.boundary_film)
    larger = solve_point(replace(laid, floor=k * LIGHT.floor))
    for other in (shifted, mirrored, raised, larger):
        assert other.coefficient == pytest.approx(FOUND.coefficient, rel=1e-5)


def test_neither_start_nor_floor_changes_the_answer():
    fast = solve_point(rough(48, 917.0, 0.03))
    assert solve_point(LIGHT, start=fast.state).coefficient == pytest.approx(FOUND.coefficient, rel=1e-4)
    near = solve_point(LIGHT, start=solve_point(rough(48, 917.0, 0.012)).state)
    assert near.report.iterations < FOUND.report.iterations
    assert solve_point(replace(LIGHT, floor=0.5e-9)).coefficient == pytest.approx(FOUND.coefficient, rel=1e-3)
    assert fast.split.rubbing < FOUND.split.rubbing < 917.0


@pytest.mark.parametrize("speed", [0.1, 0.001])
def test_a_heavy_load_is_solved_from_a_cold_start(speed):
    result = solve_point(rough(32, 18333.0, speed, LIMITED, hardness=4e9))
    assert result.report.converged and result.pressure.max() <= 4e9 * (1 + 1e-12)
    assert 0.06 < result.coefficient < 0.1
    assert (result.dent > 0).any() == (speed < 0.01) or result.pressure.max() < 4e9


def test_a_nearly_smooth_film_at_one_gigapascal_opens_touching_cells_together():
    """Sq 25 nm at 1 mm/s: of cells that open those a rounding error below the floor closed again, one a step stayed
    open, and it took 97 factorisations and a faster speed."""
    oil = replace(LIMITED, viscosity=0.04, pressure_viscosity_coefficient=22e-9)
    surface = lubfric.generate_surface((42, 16), 60e-6 / 16, sq=25e-9, correlation_length=10e-6, acf="gaussian", seed=1)
    line = contact(3e5, 1e-3, oil, 1e-2)
    result = solve_point(lay_out(surface, line, sliding=2e-3, boundary_friction=0.1, hardness=6e9))
    assert "from the dry contact" in result.report.notes[0] and result.report.iterations <= 25
    assert result.touching.any() and result.share_given_off < 0.1


def test_the_gap_of_touching_bodies_matters_where_they_give_off_the_lubricant():
    """Note and error against what they are of: f at half of that gap."""
    for problem, drawn, least, most in (
        (bearing(1e-7, 3e5, 1e-3, across=16), True, 2e-3, 0.03),
        (rough(32, 18333.0, 0.01, LIMITED), False, 0.0, 1e-3),
    ):
        result = solve_point(problem)
        moved = abs(solve_point(replace(problem, floor=0.5e-9)).coefficient / result.coefficient - 1)
        assert (result.share_given_off > 0.1) == drawn and least <= moved < most
        parts = {"rubbing": result.split.rubbing / result.load, "boundary": result.boundary / result.load}
        assert moved <= error_by_gap(result.share_given_off, **parts, f=result.coefficient) + 1e-5


def test_the_error_by_the_gap_of_touching_bodies_vanishes_with_what_they_give_off_and_with_the_film():
    """By hand, at its limits, and without a step; f_b = 0.1, a film of 0.04, and one that rubs more."""

    def at(given_off, share, film=0.04):
        f = 0.1 * share + film * (1 - share)
        return error_by_gap(given_off, rubbing=share, boundary=0.1 * share, f=f)

    assert at(0.0, 0.5) == 0.0 and at(1.0, 1.0) == 0.0
    assert at(0.2, 0.5) == pytest.approx(0.2 * 0.05 / 0.07) and at(0.2, 0.5, 0.3) == pytest.approx(0.2 * 0.15 / 0.2)
    assert error_by_gap(0.3, rubbing=0.0, boundary=0.0, f=-1e-4) == pytest.approx(0.3)  # pure rolling
    shares = np.linspace(1e-9, 1.0, 50)
    assert all(abs(at(g + 1e-6, s) - at(g, s)) < 1e-5 for g in (0.0, 0.1, 0.5) for s in shares)
    assert all(abs(at(0.5, s - 1e-6) - at(0.5, s)) < 1e-5 for s in shares[1:])


@pytest.mark.parametrize(
    "sq, load, speed, across, way, most",
    [(200e-9, 2.72e5, 0.3, 28, "the dry contact", 50), (100e-9, 3e5, 1e-3, 24, "the dry contact", 30)],
)
def test_a_bearing_at_a_gigapascal_is_solved_from_a_cold_start(sq, load, speed, across, way, most):
    """By Newton's method alone, or step by step. In the valleys of the Hertz strip the start has fluid, and the film
    finds its shape in short steps before the residual falls. Cells that are opened although they give off fluid would
    sink below the floor, close those that had to stay open, and so on for ever (114 factorisations in the last case; 18
    where a cell ruptures only under the strongest suction nearby).
    Load, gap and signs are those of the map's own judge."""
    problem = bearing(sq, load, speed, across=across)
    result = solve_point(problem)
    assert f"from {way}; " in result.report.notes[0] and result.report.iterations <= most
    wrong = check(problem, result)
    assert max(wrong["load"], wrong["gap"], wrong["signs"]) <= 1
    assert 0 <= result.fill.min() and result.fill.max() <= 1 and result.touching.any() == (speed < 0.1)


def test_the_film_of_longer_cells_leads_to_shorter_ones_in_a_few_whole_steps():
    """At 1 GPa; to the film that the dry contact leads to. Where no step is allowed, that is where it comes from."""
    oil = replace(LIMITED, viscosity=0.02, pressure_viscosity_coefficient=18e-9, limiting_stress_coefficient=0.06)
    surface = lubfric.generate_surface((64, 32), 2.25e-6, sq=150e-9, correlation_length=10e-6, acf="gaussian", seed=1)
    line = contact(1.6e5, 1.0, oil, 6e-3)
    coarse, fine = (lay_out(surface, line, sliding=2.0, boundary_friction=0.12, map_coarsening=(k, k)) for k in (2, 1))
    start = refined_start(coarse, fine, solve_point(coarse, tolerance=1e-2))
    least = start.least_step
    near, none = (solve_point(fine, start=start.state, least=part) for part in (least, 2.0))
    assert "from a neighbouring state" in near.report.notes[0] and "from the dry contact" in none.report.notes[0]
    assert 0 < least < 1 and near.report.iterations <= min(10, none.report.iterations - 1)
    assert near.coefficient == pytest.approx(none.coefficient, rel=1e-6)


@pytest.mark.parametrize("speed", [10.0, 3.0, 1.0, 0.3])
def test_a_gigapascal_starts_from_half_of_the_film(speed):
    """A roller on long cells takes at most nine factorisations; from the dry contact lifted by all of Moes' film it
    took 11 to 14."""
    oil = Lubricant(0.02, 18e-9, limiting_stress_coefficient=0.06, eyring_stress=5e6)
    surface = lubfric.generate_surface((64, 64), 4e-6, sq=150e-9, correlation_length=10e-6, acf="gaussian", seed=1)
    line = contact(1.6e5, speed, oil, 6e-3)
    problem = lay_out(surface, line, sliding=2 * speed, boundary_friction=0.12, map_coarsening=(2, 2))
    result = solve_point(problem, tolerance=3e-3)
    assert result.report.iterations <= 9 and "from the dry contact" in result.report.notes[0]


def test_steps_in_time_lead_from_a_neighbouring_speed_to_the_steady_film():
    """To the same film as Newton's method from the dry contact, which shares none of the way."""
    problem = rough(32, 18333.0, 0.01, LIMITED, hardness=4e9)
    work = Work(300)
    settled = march(problem, solve_point(problem.at_speed(0.1)).state, work, tolerance=1e-5, most=300)
    assert work.steps >= 3 and work.factorisations < 300
    there = solve_point(problem, start=settled, most=5)
    cold = solve_point(problem)
    assert "from a neighbouring state" in there.report.notes[0]
    assert np.abs(there.pressure - cold.pressure).max() < 1e-3 * cold.pressure.max()


def test_plastic_cells_carry_the_limit_and_are_dented():
    problem = rough(48, 917.0, 0.001, hardness=1.5e9)
    result = solve_point(problem)
    dented = result.dent > 0
    assert dented.sum() > 5 and np.all(result.pressure[dented] == 1.5e9)
    dry = lubfric.solve_contact(
        problem.rigid_gap, problem.spacing, E_PRIME, mean_pressure=917.0 / (problem.x.size * problem.spacing[0]),
        hardness=1.5e9, boundary=("free", "periodic"),
    )  # fmt: skip
    assert dented.mean() == pytest.approx(dry.plastic_area_fraction, rel=0.2)


@pytest.mark.parametrize("oil", [NEWTONIAN, replace(LIMITED, limiting_stress_coefficient=0.05)], ids=["", "limited"])
def test_thinner_gaps_than_the_boundary_film_rub_with_f_b_and_the_rest_by_the_oil(oil):
    """Against sums over the fields; half and twice the length are what a solve with it gives."""
    problem = rough(48, 917.0, 0.01, oil, boundary_film=16e-9)
    result = solve_point(problem)
    p = result.pressure
    h = result.gap
    dx = problem.spacing[0]
    law = shear_stress(oil, p, 0.02 / h)
    thin = h < 16e-9
    film = (h >= 16e-9) & (p > 0)
    capped = film & (p > 50e6) & (law > 0.09 * p) if oil is NEWTONIAN else np.zeros_like(film)
    rows = p.shape[1]
    for name, where in (("thin", thin), ("capped", capped)):
        assert getattr(result.split, name) == pytest.approx(p[where].sum() * dx / rows, rel=1e-12)
    assert result.boundary == pytest.approx(0.09 * (result.split.thin + result.split.capped), rel=1e-12)
    assert result.shear[film & ~capped] == pytest.approx(law[film & ~capped], rel=1e-12)
    for film, stated in ((8e-9, result.at_half_film), (32e-9, result.at_twice_film)):
        assert solve_point(replace(problem, boundary_film=film)).coefficient == pytest.approx(stated, rel=1e-12)
    spread = abs(result.at_twice_film - result.at_half_film) / result.coefficient
    assert spread < 0.02 if oil is NEWTONIAN else spread > 0.1


def test_a_failure_is_reported_and_carries_what_was_found():
    """All ways together take no more factorisations than they may."""
    problem = rough(16, 917.0, 0.01)
    with pytest.raises(lubfric.ConvergenceError, match="of 120 factorisations") as failed:
        solve_point(problem, tolerance=1e-17, most=120)
    report = failed.value.report
    for way in ("from the dry contact", "from a faster speed", "in time from"):
        assert way in str(failed.value)
    assert not report.converged and report.residual > 1e-17 and report.iterations == 120
    assert failed.value.result.pressure.shape[1] == 16
    assert solve_point(problem, tolerance=report.residual * 1.01).report.converged


def test_too_many_cells_are_refused_before_any_work():
    flat = Surface(np.zeros((8, 4096)), (1e-8, 1e-8), periodic_axes=(True, True))
    with pytest.raises(lubfric.InputError, match="cells"):
        lay_out(flat, contact(917.0, 0.01), sliding=0.02, boundary_friction=0.09)


def test_a_film_between_soft_rollers_is_solved_from_a_cold_start():
    """E' 19 GPa at 60 MPa, where pressure hardly thickens the oil: Newton's method leads nowhere from the dry contact,
    and the way down from a faster speed took 500 factorisations or failed. To the film that it reaches from half the
    speed, by another way."""
    oil = Lubricant(0.0475, 1.16e-8, eyring_stress=5e6)
    surface = lubfric.generate_surface((64, 48), 12e-6, sq=276e-9, correlation_length=48e-6, acf="gaussian", seed=2)

    def at(speed):
        line = LineContact(
            load_per_width=11200.0, radius=9.4e-3, e_prime=19.2e9, entrainment_speed=speed, lubricant=oil
        )
        return lay_out(surface, line, sliding=2 * speed, boundary_friction=0.1, hardness=1.8e8, map_coarsening=(2, 2))

    result = solve_point(at(2.6e-3))
    assert "in time from the dry contact" in result.report.notes[0] and result.report.iterations <= 150
    slower = solve_point(at(2.0e-3), tolerance=1e-4)
    again = solve_point(at(2.6e-3), start=slower.state, tolerance=1e-4)
    assert "from a neighbouring state" in again.report.notes[0]
    assert again.coefficient == pytest.approx(result.coefficient, rel=3e-3)


@pytest.mark.slow
def test_a_starved_film_is_solved_from_a_cold_start():
    """60 nm arrive on 80 nm of roughness. On cells of 2 um, lifted by half of Moes' film the dry contact led to the
    solution in 50 steps or nowhere. To the film that a thicker one leads to, by another way."""
    oil = Lubricant(0.006, 1.6e-8, eyring_stress=5e6, limiting_stress_coefficient=0.06)
    surface = lubfric.generate_surface((120, 48), 2e-6, sq=80e-9, correlation_length=8e-6, acf="gaussian", seed=3)

    def at(arriving):
        starved = replace(oil, inlet_film=arriving)
        line = LineContact(load_per_width=1e5, radius=12e-3, e_prime=2.27e11, entrainment_speed=1.0, lubricant=starved)
        return lay_out(surface, line, sliding=2.0, boundary_friction=0.11, map_coarsening=(2, 2))

    cold = solve_point(at(60e-9), tolerance=1e-4)
    assert "from the dry contact" in cold.report.notes[0]
    thicker = solve_point(at(64e-9), tolerance=1e-4)
    again = solve_point(at(60e-9), start=thicker.state, tolerance=1e-4)
    assert "from a neighbouring state" in again.report.notes[0]
    assert again.coefficient == pytest.approx(cold.coefficient, rel=3e-3)
    assert cold.coefficient > thicker.coefficient


@pytest.mark.slow
def test_another_lift_of_the_dry_contact_is_the_last_way():
    """A bearing at 1 mm/s on 200 nm of roughness, where all others fail: load and flow are those of its fields."""
    problem = bearing(2e-7, 1e5, 1e-3)
    result = solve_point(problem)
    assert result.report.residual <= 1e-5
    assert max(check(problem, result).values()) < 1


def test_an_attempt_between_soft_bodies_ends_at_a_system_that_is_not_solved():
    """A seal of 21 MPa in water, on 800 nm of roughness whose summits are sharp: from the dry contact a system of
    Newton's method takes all iterations of GMRES. The state is the one before its step, and the steps beyond it lead
    away."""
    water = Lubricant(1e-3, 0.0, viscosity_law="constant")
    surface = lubfric.generate_surface((64, 24), 24e-6, sq=800e-9, correlation_length=80e-6, acf="exponential", seed=3)
    line = LineContact(load_per_width=1e3, radius=RADIUS, e_prime=2.1e7, entrainment_speed=0.5, lubricant=water)
    problem = lay_out(surface, line, sliding=1.0, boundary_friction=0.3)
    cold = dry_start(problem, dry_contact(problem))

    def attempt(**how):
        work = Work(50)
        return newton(problem, cold, work, tolerance=3e-3, **how), work

    ended, work = attempt(most=50, ends_unsolved=True)
    before, solved = attempt(most=work.factorisations - 1)
    beyond, more = attempt(most=work.factorisations + 3)
    assert work.krylov - solved.krylov == MOST_KRYLOV * CYCLES
    assert ended.residual == before.residual and np.array_equal(ended.at.gap, before.at.gap)
    assert more.factorisations > work.factorisations and beyond.residual > ended.residual
