"""What a neighbouring speed hands on saves work and moves no answer."""

from dataclasses import replace

import pytest

import lubfric
from lubfric.contact import half_space
from lubfric.film import ehl as ehl_solve
from lubfric.sharing import solved


@pytest.fixture(scope="module")
def paper():
    """The paper's scene on its own patch."""
    return lubfric.prepare(lubfric.load_scene("paper").with_(numerics={"sampling": "patch"}))


def test_the_contacts_of_a_neighbours_grids_save_iterations(paper, monkeypatch):
    """Started from the contact on the same grid, each contact needs fewer steps; the balance is the same."""
    iterations = []
    honest = half_space.solve_contact

    def counted(*args, **options):
        found = honest(*args, **options)
        iterations.append(found.report.iterations)
        return found

    monkeypatch.setattr(half_space, "solve_contact", counted)
    first = solved(paper, 0.01).balance
    assert len(first.states) >= 2 and first.states[-1] is first.contact
    ends = {}
    for name, start in (("cold", None), ("last", replace(first, states=())), ("all", first)):
        iterations.clear()
        ends[name] = solved(paper, 0.008, start).balance, sum(iterations)
    assert ends["all"][1] < 0.9 * ends["last"][1] < ends["cold"][1]
    for balance, _ in ends.values():
        assert balance.contact_load == pytest.approx(ends["cold"][0].contact_load, rel=1e-3)


@pytest.mark.parametrize("speed", [0.0316, 0.001])
def test_a_coarsest_grid_closed_loosely_leaves_nothing_open(paper, speed):
    """The volume is closed on the last grid as far as f asks for: the film's load is that of one tight balance."""
    found = solved(paper, speed)
    tight = solved(replace(paper, scene=paper.scene.with_(numerics={"balance_tolerance": 1e-6})), speed)
    assert found.balance.report.converged
    error = abs(found.balance.film_load / tight.balance.film_load - 1) * found.balance.forces.sensitivity
    assert error < 0.2 * paper.scene.numerics.tolerance


def test_one_film_is_solved_from_nothing(paper, monkeypatch):
    """That of the whole load, which tells that the summits touch: the films of the balance start from it."""
    cold = []
    honest = ehl_solve._cold
    monkeypatch.setattr(ehl_solve, "_cold", lambda *args: cold.append(args) or honest(*args))
    found = solved(paper, 0.0316).balance
    assert found.contact_load > 0 and found.film.cells > 0
    assert len(cold) == 1
