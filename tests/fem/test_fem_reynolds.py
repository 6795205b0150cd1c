"""Finite-element Reynolds solver: closed forms, orders of convergence, relations, failures that must show."""

import numpy as np
import pytest

from verification.fem import exact
from verification.fem.solvers.fluid import STEP, Fluid, slope
from verification.fem.solvers.report import SolveError
from verification.fem.solvers.reynolds import ReynoldsProblem, solve_refined, solve_reynolds
from verification.fem.studies.reynolds import parabola_mesh

OIL = Fluid(0.1)
SLIDER = exact.Slider(viscosity=0.1, speed=1.0, length=0.01, inlet=2e-6, outlet=1e-6)
PARABOLA = exact.Parabola(viscosity=0.1, speed=1.0, radius=0.01, film_thickness=1e-6, inlet=-10.0)


def test_closed_forms_agree_with_quadrature_and_with_the_literature():
    x = np.linspace(0, SLIDER.length, 20_001)[None]
    assert np.isclose(np.trapezoid(SLIDER.pressure(x), x[0]), SLIDER.load, rtol=1e-7)
    e = exact.Parabola(viscosity=0.1, speed=1.0, radius=0.01, film_thickness=1e-6)
    scale = e.viscosity * e.speed * e.radius / e.film_thickness
    root = np.sqrt(e.radius / e.film_thickness)
    assert np.isclose(e.load / scale, 4.8950, rtol=1e-5) and np.isclose(e.exit, 0.4751299, rtol=1e-7)
    assert np.isclose(e.couette / (e.viscosity * root), 2.848722, rtol=1e-6)
    assert np.isclose(e.rolling / (2 * e.viscosity * e.speed * root), 2.300538, rtol=1e-6)
    pad = exact.ExponentialPad(viscosity=0.1, speed=1.0, length=0.01, width=1.0, inlet=2e-6, outlet=1e-6)
    assert np.isclose(pad.load / pad.width, pad.wide_load, rtol=0.01)
    thin = exact.ExponentialPad(viscosity=0.1, speed=1.0, length=0.01, width=1e-5, inlet=2e-6, outlet=1e-6)
    assert np.isclose(thin.load, thin.narrow_load, rtol=2e-3)


def test_the_exact_pad_solves_the_equation():
    pad = exact.ExponentialPad(viscosity=0.1, speed=1.0, length=0.01, width=0.007, inlet=2e-6, outlet=1e-6)
    x = np.array([0.004, 0.001])
    d = 2e-5

    def flow(x, axis):
        step = d * np.eye(2)[axis]
        rise = pad.pressure(x + step) - pad.pressure(x - step)
        return pad.film(x) ** 3 / (12 * pad.viscosity) * rise / (2 * d)

    out = sum((flow(x + d * np.eye(2)[i], i) - flow(x - d * np.eye(2)[i], i)) / (2 * d) for i in (0, 1))
    assert np.isclose(out, -pad.speed * pad.decay * pad.film(x), rtol=1e-4)


@pytest.mark.parametrize("degree", [1, 2])
def test_rupture_under_a_parabola(degree):
    s = solve_refined(
        ReynoldsProblem(
            mesh=parabola_mesh(50, -10.0), film=PARABOLA.film, fluid=OIL, speed=1.0, degree=degree, cavitation=True
        ),
        4,
    )[-1]
    assert np.isclose(s.inflow(s.problem.mesh.p.min()), PARABOLA.flow, rtol=1e-4)
    # complementarity of what comes back: pressure, lost flow, and never both
    inside = (s.basis.doflocs[0] > s.problem.mesh.p.min()) & (s.basis.doflocs[0] < s.problem.mesh.p.max())
    p = s.pressure[inside] / PARABOLA.pressure_scale
    lost = s.reaction[inside] / PARABOLA.flow
    assert p.min() >= 0 and lost.min() > -1e-8 and np.max(p * lost) < 1e-8
    assert lost.max() > 1e-4


def test_slopes_are_derivatives():
    p = np.linspace(0, 5e8, 7)
    d = 1e3
    compressible = Fluid(0.04, density_law="dowson-higginson")
    linear = Fluid(0.04, density_law="linear")
    viscous = (
        Fluid(0.04, viscosity_law=law, pressure_viscosity_coefficient=2e-8).log_viscosity
        for law in ("barus", "roelands")
    )
    for law in (*viscous, compressible.rho, linear.rho):
        assert np.allclose(slope(law, p), (law(p + d) - law(p - d)) / (2 * d), rtol=1e-5, atol=1e-18)
    assert STEP < 1e-30


def test_a_runaway_oil_is_not_solved():
    """Barus above the speed where the pressure becomes infinite: no solution exists, none is returned."""
    q = PARABOLA.pressure(np.linspace(-2, 1, 4001)[None] * PARABOLA.scale).max()
    problem = ReynoldsProblem(
        mesh=parabola_mesh(100, -10.0),
        film=PARABOLA.film,
        fluid=Fluid(0.1, viscosity_law="barus", pressure_viscosity_coefficient=1.2 / q),
        speed=1.0,
        cavitation=True,
    )
    with pytest.raises(SolveError, match="iteration_limit|diverged"):
        solve_reynolds(problem)


def test_laws_at_one_gigapascal():
    """Numbers worked out by hand from the published formulas."""
    assert np.isclose(Fluid(0.1, density_law="dowson-higginson").rho(1e9), (0.59 + 1.34) / 1.59)
    assert np.isclose(Fluid(0.1, density_law="linear", bulk_modulus=2e9).rho(1e9), 1.5)
    assert np.isclose(Fluid(0.1, viscosity_law="barus", pressure_viscosity_coefficient=1e-8).eta(1e9), 0.1 * np.exp(10))
    thick = 9.67 + np.log(0.1)  # Roelands: ln eta + 9.67 grows like (1 + p/p0)^z
    z = 2e-8 * 1.96e8 / thick
    assert np.isclose(
        Fluid(0.1, viscosity_law="roelands", pressure_viscosity_coefficient=2e-8).eta(1e9),
        np.exp(-9.67 + thick * (1 + 1e9 / 1.96e8) ** z),
    )
