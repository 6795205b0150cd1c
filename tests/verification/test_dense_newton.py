"""The plain Newton method of the chart of films: a closed form, and finite elements."""

import pytest

pytest.importorskip("skfem")

from verification.campaigns.dense_newton import dense_newton
from verification.fem.parts import case_of, moes_unit
from verification.fem.solvers.ehl import LineContact, solve_ehl


def test_a_stiff_cylinder_has_the_film_of_martin():
    """Rigid, constant viscosity: smallest film 2.447484/M, flow film 3/M in Moes' units, M to 0."""
    case = case_of(0.02, 0.1)
    film = dense_newton(case | {"viscosity_law": "constant", "density_law": "constant"}, 501)
    unit = moes_unit(case["entrainment_speed"])
    assert film.converged
    assert film.flow_film / unit == pytest.approx(3 / 0.02, rel=0.04)  # its inlet begins at 8 sqrt(2 R h)
    assert film.min_film / unit == pytest.approx(2.447484 / 0.02, rel=0.04)


def test_it_has_the_film_of_finite_elements():
    case = case_of(20, 5)
    film = dense_newton(case, 401)
    elements = solve_ehl(LineContact.of(case), refinements=0)[-1]
    assert film.converged
    assert film.flow_film == pytest.approx(elements.flow_film, rel=0.01)
    assert film.min_film == pytest.approx(elements.min_film, rel=0.01)
