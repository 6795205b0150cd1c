"""Rough contact and load sharing by finite elements: waves, Hertz, balance, and reports that are true."""

import math

import numpy as np
import pytest

from verification.fem.exact import Parabola
from verification.fem.exact_contact import Line, Sphere, Wave
from verification.fem.solvers import ehl
from verification.fem.solvers.compliance import Elastic
from verification.fem.solvers.fluid import Fluid
from verification.fem.solvers.harmonic import HarmonicStrip, compliance, press
from verification.fem.solvers.sharing import FlatBodies, rupture, share_load, shear

E_PRIME = 231e9
CELL = 1e-6
BODY = Elastic.from_e_prime(E_PRIME, 0.3)


@pytest.fixture(scope="module")
def strip():
    return compliance(HarmonicStrip((24, 12), (CELL, CELL), BODY))


def test_compliance_is_symmetric_and_positive(strip):
    c = strip.harmonics
    assert np.abs(c - c.transpose(0, 2, 1)).max() <= 1e-9 * np.abs(c).max()
    assert min(np.linalg.eigvalsh((h + h.T) / 2).min() for h in c) > 0


def test_wave_along_the_line_under_a_wide_band_is_that_of_the_half_space():
    """cos(k y) over |x| < L with k L >> 1 moves its middle by 4/(E' k) cos(k y)."""
    wide = compliance(HarmonicStrip((32, 4), (CELL, 2 * CELL), BODY, fineness=2))
    k = 2 * math.pi / (4 * 2 * CELL)
    wave = np.cos(k * np.arange(4) * 2 * CELL)
    u = wide.apply(np.tile(wave, (32, 1)))
    assert u[15:17] == pytest.approx(np.tile(4 / (E_PRIME * k) * wave, (2, 1)), rel=5e-3, abs=1e-6 * u.max())


def test_hertz_line(strip):
    x = (np.arange(24) - 11.5) * CELL
    exact = Line(E_PRIME, 2e-3, 7.3e-6)
    result = press(strip, np.tile(x[:, None] ** 2 / 4e-3, (1, 12)), exact.load)
    assert result.pressure.max() == pytest.approx(exact.peak, rel=5e-3)
    assert np.ptp(result.pressure, axis=1).max() <= 1e-6 * exact.peak
    assert result.gap[0, 0] == pytest.approx(exact.gap(x[0]), rel=1e-2)
    assert result.pressure.sum() * CELL / 12 == pytest.approx(exact.load, rel=1e-12)


def test_shear_of_a_rigid_film():
    contact = ehl.LineContact(
        load_per_width=20.0, radius=2e-3, e_prime=E_PRIME, entrainment_speed=0.5, fluid=Fluid(0.36)
    )
    film = ehl.solve_ehl(contact, refinements=1)[-1]
    exact = Parabola(viscosity=0.36, speed=0.5, radius=2e-3, film_thickness=film.min_film, inlet=-1e5)
    edges = np.linspace(-2e-5, 2e-5, 11)
    couette, rolling = shear(film, 1.0, edges, np.ones(10))
    assert couette == pytest.approx(exact.couette * 1.0, rel=5e-3)
    assert rolling == pytest.approx(exact.rolling, rel=5e-3)
    assert rupture(film) == pytest.approx(0.4751299 * math.sqrt(4e-3 * film.min_film), rel=2e-2)
    dry, _ = shear(film, 1.0, edges, np.zeros(10))
    assert 0 < dry < couette


def test_closed_forms_of_contact_agree_with_each_other():
    line = Line(E_PRIME, 2e-3, 4e-6)
    ball = Sphere(E_PRIME, 2e-3, 4e-6)
    wave = Wave(E_PRIME, 1e-7, 5e-5, 0.3)
    x = np.linspace(-4e-6, 4e-6, 200001)
    assert np.trapezoid(line.peak * np.sqrt(1 - (x / 4e-6) ** 2), x) == pytest.approx(line.load, rel=1e-6)
    r = x[100000:]
    carried = np.trapezoid(2 * np.pi * r * ball.peak * np.sqrt(1 - (r / 4e-6) ** 2), r)
    assert carried == pytest.approx(ball.load, rel=1e-6)
    assert line.gap(4e-6) == pytest.approx(0, abs=1e-20) and ball.gap(4e-6) == pytest.approx(0, abs=1e-20)
    far = 4e-4
    assert ball.gap(far) == pytest.approx(
        far**2 / 4e-3 - ball.approach + 2 * ball.load / (math.pi * E_PRIME * far), rel=1e-6
    )
    y = (np.arange(100000) + 0.5) * 5e-5 / 100000
    assert wave.pressure(y).mean() == pytest.approx(wave.mean_pressure, rel=1e-6)


def test_shear_laws_of_the_finite_elements():
    newton = Fluid(0.1)
    limited = Fluid(0.1, eyring_stress=2e6, limiting_stress=(1e6, 0.05))
    assert newton.stress(0.0, -1e6) == pytest.approx(-1e5)
    assert limited.stress(0.0, 1e3) == pytest.approx(100.0, rel=1e-8)  # Newtonian far below tau_E
    assert limited.stress(1e9, -1e7) == pytest.approx(-2e6 * math.asinh(0.5), rel=1e-12)
    assert limited.stress(0.0, 1e12) == pytest.approx(1e6)
    assert limited.stress(1e8, -1e12) == pytest.approx(-6e6)


@pytest.mark.parametrize("away", [0, 1, 5])
def test_cell_means_are_double_integrals_of_the_kernel(away):
    """The mean deflection of one cell under a pressure on another, by quadrature, in units of the cell."""
    from scipy.integrate import quad
    from scipy.special import k0

    from lubfric.contact import half_space
    from verification.fem.studies.load_sharing import cell_mean

    dx = 2e-6
    n = 12
    wave = 2
    made = cell_mean(half_space((n, 8), (dx, 1e-6), E_PRIME, ("free", "periodic")))
    kernel = np.fft.irfft(made.symbol, n=made.padded[0], axis=0)[away] * np.pi * E_PRIME / (4 * dx)
    k = 2 * np.pi * wave / 8e-6 * dx
    for column, law in ((0, lambda s: -np.log(s / n)), (wave, lambda s: k0(k * s))):
        # pairs of points of two cells lie s apart as often as a tent of width 2 about ``away`` says
        tent = [quad(lambda s: law(s) * (1 - abs(s - away)), a, a + 1, epsrel=1e-11)[0] for a in (away, abs(away - 1))]
        exact = 2 * tent[0] if away == 0 else sum(tent)
        assert kernel[column] == pytest.approx(exact, rel=1e-8)


@pytest.mark.slow  # a case of the study sharing_cases
def test_flat_balance_of_the_finite_elements():
    """A contact whose gap falls like exp(-p): both balances close, the sense of sliding changes the rolling part
    only."""
    line = ehl.LineContact(
        load_per_width=5.5 / 6e-3,
        radius=2e-3,
        e_prime=E_PRIME,
        entrainment_speed=0.02,
        fluid=Fluid(0.36, viscosity_law="roelands", pressure_viscosity_coefficient=25e-9),
    )
    result = [
        share_load(
            FlatBodies(
                contact=line,
                width=6e-3,
                pressed=lambda p: (3e-7 * math.exp(-p / 5e7), p / 5e9),
                boundary_friction=0.09,
                sliding=sliding,
            ),
            refinements=0,
        )
        for sliding in (0.04, -0.04)
    ]
    for shared in result:
        assert abs(shared.residual) <= 1e-5 and shared.film_load + shared.contact_load == pytest.approx(5.5)
        pressure = shared.contact_load / (2 * line.half_width * 6e-3)
        assert shared.mean_gap == pytest.approx(3e-7 * math.exp(-pressure / 5e7), rel=1e-9)
    fore, back = result
    assert fore.couette == pytest.approx(-back.couette) and fore.rolling == pytest.approx(back.rolling)
    assert (fore.coefficient - back.coefficient) * 5.5 == pytest.approx(2 * fore.rolling, rel=1e-6)
