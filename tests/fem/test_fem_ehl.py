"""Full-system finite-element EHL against closed forms, its own rates, and numbers from elsewhere."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

pytest.importorskip("skfem")

import lubfric
from verification.fem.parts import ALPHA, VISCOSITY, case_of
from verification.fem.solvers.ehl import EHLSolution, LineContact, solve_ehl
from verification.fem.solvers.ehl_body import Layout, graded_mesh, make_body
from verification.fem.solvers.ehl_film import FilmEquations, assemble
from verification.fem.solvers.fluid import Fluid
from verification.fem.solvers.thinned_film import Law, solve_thinned


def contact(M: float, L: float) -> LineContact:
    """A contact with Moes' numbers M and L; L = 0 is isoviscous."""
    c = case_of(M, L)
    fluid = Fluid(c["viscosity"], viscosity_law=c["viscosity_law"], pressure_viscosity_coefficient=ALPHA)
    return LineContact(
        load_per_width=c["load_per_width"],
        radius=c["radius"],
        e_prime=c["e_prime"],
        entrainment_speed=c["entrainment_speed"],
        fluid=fluid,
    )


def films(solution: EHLSolution) -> tuple[float, float]:
    """Smallest film and flow film in Moes' units."""
    return (solution.min_film / solution.contact.moes_film, solution.flow_film / solution.contact.moes_film)


@settings(deadline=None, max_examples=15)
@given(st.integers(0, 10**6), st.floats(0, 1), st.sampled_from(["constant", "dowson-higginson"]))
def test_tangent_is_the_derivative(seed, upwind, density):
    mesh, layout = graded_mesh(Layout(side=60.0, inlet=-4.0, outlet=3.0, edges=(-1.0, 1.0), fine=0.5, growth=0.8))
    line = make_body(mesh, layout).line
    rng = np.random.default_rng(seed)
    film = FilmEquations(
        line=line,
        fluid=Fluid(VISCOSITY, viscosity_law="roelands", pressure_viscosity_coefficient=ALPHA, density_law=density),
        hertz_pressure=3e8,
        speed_parameter=0.01,
        upwind=upwind,
    )
    P, H, dP, dH = rng.uniform(0.01, 1, (4, line.N)) * [[1], [1], [0.1], [0.1]]
    step = 3e-5
    ahead, behind = (assemble(film, P + s * dP, H + s * dH).residual for s in (step, -step))
    flow = assemble(film, P, H)
    change = (ahead - behind) / (2 * step)
    assert np.abs(flow.by_P @ dP + flow.by_H @ dH - change).max() < 1e-4 * np.abs(change).max()


def test_rigid_isoviscous_limit():
    """Martin (1916) with Reynolds' outlet: h_min M = 2.447484, flow film M = 3, approached at the element's rate."""
    result = np.array([films(s) for s in solve_ehl(contact(1e-3, 0))]) * 1e-3
    errors = np.abs(result / [2.447484, 3.0] - 1)
    assert np.all(errors[-1] < 1e-3)
    assert np.all(errors[-1] < errors[0] / 4)


def test_solution_obeys_its_equations():
    s = solve_ehl(contact(5, 5), refinements=1)[-1]
    c = s.contact
    x = np.linspace(s.layout.inlet, s.layout.outlet, 20001)[1:-1] * c.half_width
    p, h = s.at(x)
    assert np.trapezoid(p, x) == pytest.approx(c.load_per_width, rel=2e-3)  # the rest is the tail of the inlet
    assert np.trapezoid(p, x) < c.load_per_width
    assert p.min() > -1e-3 * p.max()  # between nodes, next to rupture
    assert h.min() == pytest.approx(s.min_film, rel=1e-5)
    ruptured = p < 1e-6 * p.max()
    assert np.all(np.diff(h[ruptured & (x > 0)]) > 0)
    cell = s.cell_length
    before, after = (s.at(x[ruptured & (x > 0)][:1] + d * cell)[1] for d in (-2, 2))
    assert before < s.flow_film < after  # dp/dx = 0 at rupture
    sigma = s.body.stress(s.displacement)
    top = np.abs(s.body.basis.mesh.p[1]) < 1e-9
    at = s.body.basis.mesh.p[0, top] * c.half_width
    middle = np.abs(at) < 0.5 * c.half_width
    assert np.allclose(-sigma[1, top][middle], s.at(at[middle])[0] / c.hertz_pressure, atol=0.05)


def test_a_film_that_shear_thins():
    """The factor of the flow is the tangent of Eyring's law where the pressure drives little; the film is lubfric's."""
    line = contact(20, 10)
    sliding = 2 * line.entrainment_speed
    newtonian, thinned = solve_thinned(line, Law(5e5), sliding, refinements=0)
    zero = np.zeros(3)
    film = np.array([0.5, 1.0, 2.0])
    s = thinned.film.stress_per_film / film / 5e5
    assert thinned.film.factor(zero, zero, film) == pytest.approx(np.hypot(1, s), rel=1e-6)
    own = lubfric.solve_ehl(**case_of(20, 10), sliding=sliding, eyring_stress=5e5)
    assert thinned.flow_film == pytest.approx(own.flow_film, rel=5e-3)
    assert thinned.flow_film < 0.55 * newtonian.flow_film
