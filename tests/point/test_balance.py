"""Load sharing against models whose balance is known in closed form."""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lubfric.balance import share_load
from lubfric.patch.closure import Closure
from lubfric.patch.cylinder import strip_weight
from lubfric.report import CONVERGED, ITERATION_LIMIT, Report

OK = Report("exact", CONVERGED, 0, 0.0, 1e-6)


@dataclass(frozen=True)
class Film:
    thickness: float
    report: Report = OK


def models(speed, stiffness, sigma=1.0, touching=3.0):
    """film = speed/F_H (rigid isoviscous); gap = touching - sigma (F_C/stiffness)^(2/3)."""
    calls = []

    def solve_film(load, start):
        calls.append(load)
        return Film(speed / load)

    def close(film, contact_load, start):
        gap = touching - sigma * min((contact_load / stiffness) ** (2 / 3), touching * 0.999)
        return Closure(gap, film.thickness, np.zeros(1), np.zeros(1), 0.0, 0.0)

    return solve_film, close, calls


@settings(max_examples=80)
@given(st.floats(1e-9, 1e3), st.floats(0.3, 30))
def test_closes_both_balances_for_any_speed(speed, stiffness):
    solve_film, close, calls = models(speed, stiffness)
    balance = share_load(1.0, solve_film, close, guess=0.0, tolerance=1e-6)
    assert balance.report.converged and len(calls) <= 45
    assert balance.film_load + balance.contact_load == pytest.approx(1.0, rel=1e-14)
    if balance.contact_load > 0:
        assert balance.closure.mean_gap == pytest.approx(balance.film.thickness, rel=3e-6)
    else:
        assert speed >= 3.0  # film at full load clears the summits


def test_film_share_grows_with_speed():
    shares = [
        share_load(1.0, *models(u, 1.0)[:2], guess=0.0, tolerance=1e-8).film_load for u in np.geomspace(1e-4, 10, 30)
    ]
    assert np.all(np.diff(shares) >= 0) and shares[0] < 1e-3 and shares[-1] == 1.0


def test_a_neighbour_as_start_saves_evaluations_and_changes_nothing():
    cold = share_load(1.0, *models(0.1, 1.0)[:2], guess=10.0, tolerance=1e-9)
    warm = share_load(1.0, *models(0.101, 1.0)[:2], guess=10.0, tolerance=1e-9, start=cold)
    again = share_load(1.0, *models(0.101, 1.0)[:2], guess=10.0, tolerance=1e-9)
    assert warm.film_load == pytest.approx(again.film_load, rel=1e-7)
    assert warm.report.evaluations < again.report.evaluations


def test_an_unclosable_balance_is_reported():
    def close(film, contact_load, start):
        return Closure(2.0, 1.0, np.zeros(1), np.zeros(1), 0.0, 0.0)  # gap never meets the film

    balance = share_load(1.0, models(1.0, 1.0)[0], close, guess=0.0, tolerance=1e-6)
    assert balance.report.status == ITERATION_LIMIT and balance.report.residual == pytest.approx(1 / 3)


def test_the_strip_counts_cut_cells_by_their_share():
    x = (np.arange(10) - 4.5) * 0.1
    for b in (0.05, 0.12, 0.33, 0.5):
        assert strip_weight(x, 0.1, b).sum() * 0.1 == pytest.approx(2 * b)
    assert math.isclose(strip_weight(x, 0.1, 9.0).sum(), 10)


def test_a_failed_film_of_the_whole_load_does_not_hide_the_balance():
    from lubfric import ConvergenceError

    solve_film, close, _ = models(0.01, 1.0)

    def failing(load, start):
        if load == 1.0:
            raise ConvergenceError("too heavy", Report("film", ITERATION_LIMIT, 1, 1.0, 0.1))
        return solve_film(load, start)

    balance = share_load(1.0, failing, close, guess=0.0, tolerance=1e-8)
    reference = share_load(1.0, solve_film, close, guess=0.0, tolerance=1e-8)
    assert balance.film_load == pytest.approx(reference.film_load, rel=1e-6)
    assert "too heavy" in balance.report.notes[0]
