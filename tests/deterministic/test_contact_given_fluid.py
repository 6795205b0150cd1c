"""The finite-element contact given the fluid of the deterministic film: it agrees, and it sees a wrong fluid."""

from dataclasses import replace

import numpy as np
import pytest

from lubfric.models.deterministic import solve_point
from verification.fem.studies.deterministic import LOAD, contact
from verification.fem.studies.given_fluid import GivenFluidCase, contact_by_elements, elements, laid


@pytest.mark.slow  # cases of the study given_fluid
def test_the_contact_is_that_of_finite_elements_given_the_fluid():
    case = GivenFluidCase(cells=32, across=8, speed=0.003, floor=40e-9, hardness=2.5e9, fineness=1)
    problem = laid(case, replace(contact(0.1), load_per_width=5 * LOAD))
    result = solve_point(problem)
    body = elements(problem, case.fineness)
    mine = np.where(result.touching, result.pressure, 0.0)
    judge, load = contact_by_elements(problem, result, body)
    assert np.count_nonzero(mine) > 5 and ((judge.pressure > 0) == (mine > 0)).all()
    assert np.linalg.norm(judge.pressure - mine) < 0.015 * np.linalg.norm(mine)
    assert load == pytest.approx(1, abs=0.01)
    half = replace(result, pressure=np.where(result.touching, result.pressure, 0.5 * result.pressure))
    wrong, _ = contact_by_elements(problem, half, body)
    assert np.linalg.norm(wrong.pressure - mine) > 0.05 * np.linalg.norm(mine)
