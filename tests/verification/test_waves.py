"""Waves through the finite-element film: published amplitudes, steps in time, and the limits of the formulas."""

import itertools

import numpy as np
import pytest

from verification.fem import references
from verification.fem.parts import case_of
from verification.fem.solvers.ehl import LineContact, solve_ehl
from verification.fem.solvers.fluid import Fluid
from verification.fem.solvers.moving import march
from verification.fem.solvers.report import InputError
from verification.fem.solvers.ripple import ripple


@pytest.fixture(scope="module")
def smooth():
    """M = 100, L = 11, as in the published table."""
    case = case_of(100, 11)
    fluid = Fluid(
        case["viscosity"],
        viscosity_law="roelands",
        pressure_viscosity_coefficient=case["pressure_viscosity_coefficient"],
        density_law="dowson-higginson",
    )
    contact = LineContact(
        load_per_width=case["load_per_width"],
        radius=case["radius"],
        e_prime=case["e_prime"],
        entrainment_speed=case["entrainment_speed"],
        fluid=fluid,
    )
    return solve_ehl(contact, refinements=0, fineness=1.0, between=0.06)[-1]


@pytest.mark.slow
def test_in_pure_rolling_the_published_part_of_a_wave_is_left(smooth):
    middle = smooth.body.line.probes(np.zeros((1, 1)))
    for length in (2, 1, 0.5):
        film = middle @ ripple(smooth, length * smooth.contact.half_width, 1.0)
        assert abs(film[0]) == pytest.approx(references.AMPLITUDES[length][0], rel=0.05)


def test_a_low_wave_in_time_is_the_linear_response(smooth):
    """Complex amplitudes of one frequency, and steps of BDF2, which lag by a phase of (w dt)²/3 each."""
    count = 24
    height = 1e-3 * smooth.H.min()
    middle = smooth.body.line.probes(np.zeros((1, 1)))
    films = [
        (m.time, (middle @ m.H)[0])
        for m in itertools.islice(
            march(smooth, lambda x, t: height * min(t, 1.0) * np.cos(2 * np.pi * (x - t)), 1 / count), 4 * count
        )
    ][-count:]
    result = sum(2 / count * h * np.exp(2j * np.pi * t) for t, h in films) / height
    expected = (middle @ ripple(smooth, smooth.contact.half_width, 1.0))[0]
    assert abs(result) == pytest.approx(abs(expected), rel=0.03)
    assert abs(np.angle(result / expected)) < 2 * np.pi * (2 * np.pi / count) ** 2 / 3 * 1.5
    with pytest.raises(InputError, match="step = 0"):
        next(march(smooth, lambda x, t: 0 * x, 0))


def test_waves_in_an_even_film_have_the_limits_of_the_theory():
    k = 1e5
    film = 2e-7
    e_prime = 2.3e11
    stiff = 15e9
    kept, inlet = references.hooke(k, 1.0 + 1e-9, film, 0.0 + 1e-30, stiff, e_prime)
    assert kept == pytest.approx(1.0)  # nothing slides, nothing drags
    c = film * e_prime * k / (4 * stiff)
    kept, inlet = references.hooke(k, 1.5, film, 1e12, stiff, e_prime)
    assert kept == pytest.approx(c / (1 + c), rel=1e-3)  # solid: what the density takes is left
    assert inlet == pytest.approx(1.5 * k, rel=1e-3)  # and the wave from the inlet goes with the flow
    q = 1.0  # of an incompressible fluid
    kept, _ = references.hooke(k, 2.0, film, q * e_prime * film**3 * k**2 / 48, 1e30, e_prime)
    assert abs(kept) == pytest.approx(1 / np.sqrt(2))


def test_the_rolling_torque_goes_from_the_rigid_to_the_elastic_law():
    assert references.rolling_torque(0.01) == pytest.approx(references.RIGID_TORQUE * 0.1, rel=1e-6)
    assert references.rolling_torque(100) == pytest.approx(references.ELASTIC_TORQUE, rel=1e-6)
    assert references.starved_torque(1e5) == pytest.approx(1.0, abs=1e-3)
