"""The finite-element film in a given gap: the rigid cylinder in closed form, and a prescribed part of its own
pressure."""

from dataclasses import replace

import numpy as np
import pytest

from verification.fem.exact import Parabola
from verification.fem.solvers.fluid import Fluid
from verification.fem.solvers.report import InputError
from verification.fem.solvers.rough_film import GivenGap, rough_film

EXACT = Parabola(viscosity=0.01, speed=0.1, radius=2e-3, film_thickness=1e-6)


def given(contact=lambda x: np.zeros(x.shape, bool)):
    x = np.linspace(-1.2e-4, 6e-5, 241)
    wide = np.ones(8)
    gap = EXACT.film([x])[:, None] * wide
    pressure = EXACT.pressure([x])[:, None] * wide
    return GivenGap(
        x=x, dy=7.5e-7, gap=gap, pressure=pressure, contact=contact(x)[:, None] & (wide > 0), radius=2e-3, log=0.0
    )


@pytest.mark.parametrize("contact", [lambda x: x > 1, lambda x: np.abs(x + 2e-5) < 1e-5], ids=["film", "film and spot"])
def test_it_is_the_rigid_cylinder(contact):
    gap = given(contact)
    result = rough_film(gap, Fluid(0.01), 0.1, cells=8)
    carried = result.pressure.sum(axis=0).mean() * (gap.x[1] - gap.x[0]) + result.upstream
    assert carried == pytest.approx(EXACT.load, rel=3e-3)
    assert result.flow == pytest.approx(EXACT.flow, rel=3e-3)
    assert np.abs(result.pressure - EXACT.pressure([gap.x])[:, None]).max() < 4e-3 * result.pressure.max()


def test_a_prescribed_pressure_is_kept_and_pushes_the_film_beside_it():
    gap = given(lambda x: np.abs(x + 2e-5) < 1e-5)
    doubled = replace(gap, pressure=2 * gap.pressure)
    result = rough_film(doubled, Fluid(0.01), 0.1, cells=8)
    inside = np.abs(gap.x + 2e-5) < 0.8e-5
    assert result.pressure[inside] == pytest.approx(doubled.pressure[inside, :4], rel=1e-6)
    assert result.flow < 0.9 * EXACT.flow


def test_a_gap_that_is_not_its_mirror_image_is_refused():
    gap = given()
    with pytest.raises(InputError, match="symmetric"):
        replace(gap, gap=gap.gap * (1 + 0.1 * np.arange(8)))
