"""How many Newton steps the steps in time of moving roughness take: counted, not timed."""

from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

import lubfric
from lubfric.contact import HalfSpace
from lubfric.models.deterministic import (
    ECONOMICAL,
    TIGHT,
    RoughBody,
    evaluated,
    lay_out,
    mass_balance,
    moments,
    moving,
    moving_strip,
    newton,
    solve_moving_strip,
    state,
    travelling,
)
from verification.campaigns.calibration.case import drawn


def test_the_first_steps_from_rest_take_no_more_than_twice_those_that_follow():
    """The change from rest to motion does not go on: taken on, the first step took 29 Newton steps, the next ones 8."""
    case = drawn("rolling", 3)
    effort = replace(ECONOMICAL, discarded=0.1)
    rest = moving_strip.strip_at_rest(case.scene, case.bodies, case.speed, effort=effort)
    step = rest.problem.spacing[0] / case.speed
    passing = moments(
        travelling(rest.problem, case.bodies),
        step,
        start=rest.result.state,
        tolerance=effort.residual * rest.problem.x.size,
        carries_imbalance=True,
        linear_accuracy=effort.linear,
        shift=1,
    )
    steps = [moment.work.factorisations for moment in islice(passing, 1, 8)]
    assert max(steps[:2]) <= 2 * np.median(steps[2:])


def test_steps_of_a_narrow_contact_begin_with_the_pressure_moved(monkeypatch):
    """Of five cells in the half-width: a fifth less work than from the pressure where it was, and the same friction."""
    case = drawn("rolling", 1)
    assert case.scene.line_contact(case.speed).half_width < 8 * case.bodies[0].surface.spacing[0]

    def followed():
        effort = replace(TIGHT, discarded=0.4)
        strip = solve_moving_strip(case.scene, case.bodies, case.speed, most_steps=4, effort=effort)
        return strip.work - strip.rest.work, strip.result.coefficient

    moved, friction = followed()
    monkeypatch.setattr(moving_strip, "cells_in_a_step", lambda *_: 0)
    resting, same_friction = followed()
    assert moved < 0.8 * resting
    assert friction == pytest.approx(same_friction, rel=1e-3)


def test_steps_begin_with_roughness_moved_by_a_part_of_a_cell(monkeypatch):
    """Of 0.58 of a cell in a step: less than 0.7 of the work from complete cells, and the same friction."""
    case = drawn("rolling", 2)

    def followed():
        effort = replace(ECONOMICAL, discarded=0.3)
        strip = solve_moving_strip(case.scene, case.bodies, case.speed, most_steps=8, effort=effort)
        return strip.work - strip.rest.work, strip.result.coefficient

    by_parts, friction = followed()
    cells = moving_strip.cells_in_a_step
    monkeypatch.setattr(moving_strip, "cells_in_a_step", lambda *given: float(round(cells(*given))))
    by_cells, same_friction = followed()
    assert by_parts < 0.7 * by_cells
    assert friction == pytest.approx(same_friction, rel=2e-3)


def test_a_step_begins_with_the_load_and_the_mean_gap_of_the_moment_before(monkeypatch):
    """Where roughness moves by a complete cell, that gap moves with it."""
    case = drawn("rolling", 2)
    effort = replace(ECONOMICAL, discarded=0.1)
    rest = moving_strip.strip_at_rest(case.scene, case.bodies, case.speed, effort=effort)
    begun = []

    def noted(problem, state, *given, **how):
        begun.append(evaluated(problem, state))
        return newton(problem, state, *given, **how)

    monkeypatch.setattr(moving, "newton", noted)
    bodies = [body._replace(speed=case.speed) for body in case.bodies]
    passing = moments(
        travelling(rest.problem, bodies), rest.problem.spacing[0] / case.speed, start=rest.result.state, shift=1.0
    )
    before, after = (moment.at for moment in islice(passing, 2))
    start = begun[0].state.pressure
    assert start.sum() == pytest.approx(before.state.pressure.sum(), rel=1e-12)
    assert not np.allclose(start, before.state.pressure) and not np.allclose(start, after.state.pressure)
    is_pressed = start > 0.1 * start.max()
    moved = np.concatenate([before.gap[:1], before.gap[:-1]])
    assert begun[0].gap[is_pressed].mean() == pytest.approx(moved[is_pressed].mean(), rel=1e-9)


def test_a_step_takes_no_mass_balance_or_product_with_k_that_its_newton_steps_do_not_need(monkeypatch):
    """Where no Newton step is halved. Its start needs the gap alone, which takes no mass balance. The products with K
    are those of the start, of its gap, of each iteration of GMRES, and of each change and new state."""
    surface = lubfric.generate_surface((48, 24), 2e-6, sq=50e-9, correlation_length=8e-6, acf="gaussian", seed=1)
    line = lubfric.load_scene("paper").line_contact(0.3)
    problem = lay_out(surface, line, sliding=0.03, boundary_friction=0.1)
    counted = []
    apply = HalfSpace.apply

    def noted(*given, **how):
        counted.append("balance")
        return mass_balance(*given, **how)

    def noted_product(*given):
        counted.append("product")
        return apply(*given)

    monkeypatch.setattr(state, "mass_balance", noted)
    monkeypatch.setattr(HalfSpace, "apply", noted_product)
    passing = moments(travelling(problem, [RoughBody(surface, 0.3)]), problem.spacing[0] / 0.3, shift=1.0)
    next(passing)
    counted.clear()
    moment = next(passing)
    assert counted.count("balance") == 1 + moment.work.factorisations
    assert counted.count("product") == 2 + 2 * moment.work.factorisations + moment.work.krylov
