"""The forces of a point: they add up to f, each within what its load allows, whatever corrected f after the strips were
solved. Oracles: balances of forces and loads, Amontons' law on asperities, and the signs of stresses by sliding."""

import pytest

import lubfric
from lubfric.models.deterministic import pieces, solve_strip, strip_on_two_grids

NEEDLE = lubfric.load_scene("paper").with_(
    bodies={
        "radius": 1.395e-3,
        "width": 20e-3,
        "load": 600.0,
        "e_prime": 2.3e11,
        "hardness": 7e9,
        "boundary_friction_coefficient": 0.12,
    },
    lubricant={
        "viscosity": 0.01,
        "pressure_viscosity_coefficient": 1.5e-8,
        "viscosity_law": "barus",
        "eyring_stress": 5e6,
    },
    motion={"slide_roll_ratio": 0.02},
    surface={"sq": 0.25e-6, "correlation_length": (40e-6, 4e-6), "seed": 8},
    counterface={"sq": 0.12e-6, "correlation_length": (40e-6, 4e-6)},
    contact={"shape": (128, 128), "spacing": (4e-6, 1e-6)},
    numerics={"model": "quick"},
)
DETERMINISTIC = {"model": "deterministic"}
SMOOTHER = {"surface": {"sq": 0.025e-6}, "counterface": {"sq": 0.012e-6}}
RESTING = lubfric.load_scene("paper").with_(
    contact={"shape": (40, 40), "spacing": 3.6e-6},
    lubricant={"limiting_stress_coefficient": "f_b"},
    numerics=DETERMINISTIC | {"sampling_tolerance": 0.2, "model_tolerance": 0.5},
)
MOVING = RESTING.with_(
    motion={"slide_roll_ratio": 0.3},
    contact={"shape": (24, 12), "spacing": 3.75e-6},
    numerics={"sampling": "patch", "tolerance": 0.05},
)
PURE_ROLLING = {"slide_roll_ratio": 0.0}

# Each: the scene, the speed, and between which parts of the load asperities carry.
POINTS = {
    "asperities, roughness moves": (NEEDLE, 0.05, (0.97, 1.0)),
    "asperities, roughness moves, on short cells": (MOVING, 1e-3, (0.9, 1.0)),
    "asperities and film, roughness moves": (NEEDLE, 1.0, (0.9, 0.99)),
    "film, roughness moves": (NEEDLE.with_(**SMOOTHER), 2.0, (0.0, 0.3)),
    "pure rolling, roughness moves": (NEEDLE.with_(motion=PURE_ROLLING), 1.0, (0.9, 1.0)),
    "asperities, roughness rests": (RESTING, 1e-3, (0.9, 1.0)),
    "film, roughness rests": (RESTING, 0.1, (0.0, 0.3)),
    "pure rolling, roughness rests": (RESTING.with_(motion=PURE_ROLLING), 0.01, (0.3, 1.0)),
}


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=[pytest.mark.slow] * (name == "pure rolling, roughness rests")) for name in POINTS],
)
def test_forces_add_up_to_f_within_what_their_loads_allow(name):
    scene, speed, (least, most) = POINTS[name]
    result = lubfric.friction(scene, speed)
    load = scene.bodies.load
    slides = scene.motion.slide_roll_ratio > 0
    f_b = scene.bodies.boundary_friction_coefficient if slides else 0.0
    assert result.coefficient * load == pytest.approx(result.boundary_force + result.shear_force, rel=1e-12)
    parts = result.couette_force + result.rolling_force
    assert result.shear_force == pytest.approx(parts, rel=1e-12, abs=1e-12 * result.coefficient * load)
    assert result.boundary_force == pytest.approx(f_b * result.contact_load, rel=1e-12)
    assert result.contact_load + result.film_load == pytest.approx(load, rel=1e-12)
    assert least * load <= result.contact_load <= most * load
    assert result.film_load >= 0
    if slides:
        assert 0 < result.couette_force < f_b * result.film_load  # the mean stress of these films is below f_b p
    else:
        assert result.couette_force == 0


@pytest.mark.parametrize("speed", [0.003, 0.02])
def test_a_strip_that_is_its_own_piece_has_all_parts_of_the_shorter_cells(speed):
    """The oracle is the strip on the shorter cells itself: asperities carry more of the load on them, and both parts of
    the film's force are smaller."""
    prepared = lubfric.prepare(RESTING.with_(numerics={"sampling": "patch"}))
    surface = lubfric.generate_surface((40, 40), 1.8e-6, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=3)
    longer = solve_strip(prepared.scene, surface, speed, map_coarsening=(2, 2))
    shorter = solve_strip(prepared.scene, surface, speed, start=longer)
    (before, after) = (strip_on_two_grids.numbers_of_strip(prepared, one.result) for one in (longer, shorter))
    changed = pieces.changed_by_pieces(prepared, before, [(longer, shorter)])
    names = ("coefficient", "contact_load", "film_load", "boundary_force", "couette_force", "rolling_force")
    assert {name: changed[name] for name in names} == pytest.approx({name: after[name] for name in names}, rel=1e-9)
    assert changed["min_film"] == min(before["min_film"], after["min_film"])


def test_one_strip_states_the_error_of_its_loads():
    """What asperities do not carry the film does: both loads are off by the same force."""
    result = lubfric.friction(RESTING, 0.01)
    errors = result.errors
    assert 0 < errors.contact_load < 0.5
    assert errors.boundary_force == pytest.approx(errors.contact_load, rel=1e-6)
    assert errors.film_load * result.film_load == pytest.approx(errors.contact_load * result.contact_load, rel=0.2)
