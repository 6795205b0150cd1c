"""Which cells rupture between two Newton steps."""

from dataclasses import replace

import numpy as np
import pytest

import lubfric
from lubfric.models.deterministic import RUPTURED, admissible, lay_out, solve_point, state

SCENE = lubfric.load_scene("paper")
MAP = lubfric.generate_surface((48, 24), 2e-6, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=4)
PROBLEM = lay_out(MAP, SCENE.line_contact(0.05), sliding=0.1, boundary_friction=0.09)
SOLVED = solve_point(PROBLEM)


def ruptured(suction):
    """Return which of the neighbours in the middle of the film rupture that are under so much suction over the pressure
    there."""
    pressure = SOLVED.state.pressure.copy()
    row = int(np.argmax(pressure.mean(axis=1)))
    places = [(row, 4 + k) for k in range(len(suction))]
    for place, part in zip(places, suction, strict=True):
        pressure[place] = -part * pressure.max()
    kind = admissible(PROBLEM, replace(SOLVED.state, pressure=pressure)).kind
    return [bool(kind[place] == RUPTURED) for place in places]


@pytest.mark.parametrize(
    "suction, result",
    [
        ([0.1], [True]),
        ([0.1, 0.09], [True, True]),
        ([0.1, 0.01], [True, False]),
        ([0.1, 0.01, 0.003], [True, False, False]),
    ],
)
def test_weak_suction_beside_strong_waits(suction, result):
    assert ruptured(suction) == result


def test_weak_suction_behind_strong_waits_in_a_step_in_time_alone():
    """A rupture takes from the inflow of the cell behind it, so that is under more suction soon."""
    pressure = SOLVED.state.pressure.copy()
    row = int(np.argmax(pressure.mean(axis=1)))
    pressure[row : row + 3, 5] = np.array([-0.1, -0.02, -0.02 * 0.09]) * pressure.max()
    pressure[row - 1, 5] = -0.02 * pressure.max()  # before the strong one
    tried = replace(SOLVED.state, pressure=pressure)
    for in_time, expected in ((False, [False, True, True, False]), (True, [False, True, False, False])):
        kind = admissible(PROBLEM, tried, in_time=in_time).kind
        assert (kind[row - 1 : row + 3, 5] == RUPTURED).tolist() == expected


def test_a_rupture_moves_through_a_steady_film_in_few_steps(monkeypatch):
    """It moves downstream, and by one cell in a step where cells wait for those upstream; f is the same."""
    fine = lubfric.generate_surface((96, 48), 1e-6, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=4)

    def solved():
        films = [lay_out(fine, SCENE.line_contact(v), sliding=0.1, boundary_friction=0.09) for v in (0.05, 0.01, 1e-3)]
        points = [solve_point(film) for film in films]
        return sum(point.report.iterations for point in points), [point.coefficient for point in points]

    (steps, f) = solved()
    monkeypatch.setattr(state, "STRONG_SUCTION_UPSTREAM", state.STRONG_SUCTION)
    (steps_of_waiting, f_of_waiting) = solved()
    assert steps < steps_of_waiting and f == pytest.approx(f_of_waiting, rel=1e-5)


def test_a_solution_has_no_suction_whatever_ruptures_first(monkeypatch):
    monkeypatch.setattr(state, "STRONG_SUCTION", 0.0)
    other = solve_point(PROBLEM)
    assert SOLVED.pressure.min() >= 0 and other.pressure.min() >= 0
    assert SOLVED.coefficient == pytest.approx(other.coefficient, rel=1e-5)
