"""Waviness of small amplitude at rest in an elastic film, against its linear theory.

In a film of thickness h and viscosity eta without a pressure gradient, waves z = A cos(k x) across the motion give
``i k U h1 = -k² h³ p1/(12 eta)`` (Reynolds) and ``h1 = -A + 4 p1/(E' k)`` (half-space), hence

    |h1|/A = 1/sqrt(1 + q²),  q = 48 eta U/(E' k² h³):

long waves are pressed flat, short ones stay (as those of C. H. Venner et al., Tribology Series 32 (1997) 103-112,
doi:10.1016/s0167-8922(08)70440-1, who move theirs with the surface and find one curve over (λ/b) M^(3/4) L^(-1/2)).
"""

from dataclasses import replace

import numpy as np
import pytest

from lubfric.film import LineContact
from lubfric.models.deterministic import lay_out, solve_point
from lubfric.oil import Lubricant, viscosity
from lubfric.surface import Surface
from verification.fem.studies.waviness import STEEL, compared

E_PRIME = 2e9
SPEED = 0.5
CELLS = 1024


@pytest.mark.parametrize(
    "oil", [Lubricant(0.05, viscosity_law="constant"), Lubricant(0.05, 10e-9)], ids=["", "Roelands"]
)
def test_long_waves_are_pressed_flat_and_short_ones_stay(oil):
    line = LineContact(load_per_width=2e4, radius=1e-2, e_prime=E_PRIME, entrainment_speed=SPEED, lubricant=oil)
    b = line.half_width
    flat = Surface(np.zeros((64, 1)), (5 * b / CELLS,) * 2, periodic_axes=(True, True))
    smooth = lay_out(flat, line, sliding=2 * SPEED, boundary_friction=0.09, ends=(3 * b, 2 * b))
    base = solve_point(smooth, tolerance=1e-8)
    x = base.x
    film, pressure = (float(np.interp(0.0, x, f[:, 0])) for f in (base.gap, base.pressure))
    near = np.abs(x) < 0.5 * b
    weight = np.cos(np.pi * x[near] / b) ** 2
    kept = []
    for length, within in ((b / 2, 0.04), (b / 4, 0.01), (b / 8, 0.01)):
        k = 2 * np.pi / length
        wavy = replace(smooth, heights=0.01 * film * np.cos(k * x)[:, None])
        result = solve_point(wavy, start=base.state, tolerance=1e-8)
        waves = np.stack([np.cos(k * x), np.sin(k * x), np.ones_like(x), x], axis=1)[near] * weight[:, None]
        part = np.linalg.lstsq(waves, (result.gap - base.gap)[near, 0] * weight, rcond=None)[0]
        kept.append(np.hypot(part[0], part[1]) / (0.01 * film))
        q = 48 * float(viscosity(oil, pressure)) * SPEED / (E_PRIME * k**2 * film**3)
        assert kept[-1] == pytest.approx(1 / np.hypot(1, q), rel=within)
    assert kept[0] < 0.4 < 0.97 < kept[-1]


@pytest.mark.slow  # a case of the study waviness
def test_waves_in_a_contact_of_steel_follow_the_linear_response_of_finite_elements():
    """Under high pressure the even film keeps nothing, and what the inlet makes of the waves is left."""
    own, _, kept, judge, rms = compared(STEEL, 0.0, 0.5)
    assert kept == pytest.approx(judge, rel=0.01) and rms < 0.003 and own < 0.01 < 0.5 < kept
    assert compared(STEEL, 0.0, 0.5, STEEL.but(viscosity=0.06))[-1] > 0.006
