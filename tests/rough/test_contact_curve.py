"""What is read off a contact curve, beside the contact solved where it is read."""

import numpy as np
import pytest

import lubfric
from lubfric.rough.contact_curve import contact_curve

E_PRIME, HEAVIEST = 231e9, 2e8


@pytest.fixture(scope="module")
def surface():
    """So small that its summits come into contact one by one."""
    return lubfric.generate_surface((36, 36), 1e-6, sq=1e-7, correlation_length=3e-6, seed=8)


def test_the_error_told_holds_where_the_contact_is_solved(surface):
    curve = contact_curve(surface.heights, surface.spacing, E_PRIME, heaviest=HEAVIEST, accuracy=3e-3)
    gap0 = surface.heights.max() - surface.heights
    pressures = HEAVIEST * np.exp(-np.linspace(0.3, 8.0, 12))
    off, told = [], []
    for pressure in pressures:
        solved = lubfric.solve_contact(gap0, surface.spacing, E_PRIME, mean_pressure=pressure, tolerance=1e-7)
        off.append(abs(curve.at(pressure)[0] - solved.mean_gap))
        told.append(curve.error_at(pressure))
    assert np.mean(np.array(off) <= told) >= 0.75 and np.all(np.array(off) <= 4 * np.array(told))
    assert curve.error_at(curve.mean_pressure[-1] / 2) == 0.0


def test_a_tighter_curve_tells_less_and_is_nearer(surface):
    told = []
    for accuracy in (1e-2, 1e-3):
        curve = contact_curve(surface.heights, surface.spacing, E_PRIME, heaviest=HEAVIEST, accuracy=accuracy)
        told.append([curve.error_at(HEAVIEST * share) for share in (0.5, 0.1, 0.03)])
    assert np.all(np.array(told[1]) < told[0])


def test_the_load_read_off_is_as_near_as_the_friction_asks(surface):
    """Loads at given gaps against those of a curve of many more nodes."""
    rough = contact_curve(surface.heights, surface.spacing, E_PRIME, heaviest=HEAVIEST, accuracy=3e-3)
    fine = contact_curve(surface.heights, surface.spacing, E_PRIME, heaviest=HEAVIEST, accuracy=1e-4)
    gaps = [fine.at(HEAVIEST * share)[0] for share in (0.7, 0.4, 0.2, 0.1, 0.05)]
    loads = np.array([[c.pressure_at(g) for g in gaps] for c in (rough, fine)])
    felt = 1 - loads[1] / HEAVIEST  # near the heaviest the film carries nothing, and f does not feel it
    assert np.all(felt * np.abs(loads[0] / loads[1] - 1) < 0.02)


def test_it_is_part_of_the_numerical_error_of_f():
    """A flat contact whose friction nearly cancels: within what it states of one solved a hundred times tighter."""
    scene = lubfric.load_scene("flat").with_(
        bodies={"radius": 0.026, "width": 1e-2, "load": 16.7, "boundary_friction_coefficient": 0.095},
        lubricant={"viscosity": 5.4e-3, "pressure_viscosity_coefficient": 9.5e-9, "eyring_stress": 5e6},
        motion={"entrainment_speed": 0.63, "slide_roll_ratio": -0.93},
        surface={"sq": 1.1e-7, "correlation_length": 1.27e-5, "seed": 1837620616},
        contact={"shape": (36, 36), "spacing": 2e-4 / 36},
        numerics={"tolerance": 0.01},
    )
    found = lubfric.friction(scene)
    right = lubfric.friction(scene.with_(numerics={"tolerance": 1e-4}))
    assert 0 < found.contact_load < 0.1 * 16.7
    assert abs(found.coefficient - right.coefficient) < found.uncertainty.numerical * abs(right.coefficient)
    without = found.errors.contact_load
    assert without > right.errors.contact_load
