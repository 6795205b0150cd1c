"""Relations between two runs of moving roughness, by the deterministic model on short cells and on long ones: what must
not change f does not, and similar contacts have one f. Each holds for any implementation of the equations."""

from dataclasses import replace

import numpy as np
import pytest

import lubfric
from lubfric.surface import Surface

SPEED = 0.1
MODELS = ("deterministic", "quick")
SCENE = lubfric.load_scene("paper").with_(
    bodies={"radius": 5e-3, "width": 5e-3, "e_prime": 2.2e11, "load": 60.0, "boundary_film": 20e-9},
    lubricant={
        "viscosity": 0.05,
        "pressure_viscosity_coefficient": 1.5e-8,
        "viscosity_law": "barus",
        "eyring_stress": 5e6,
    },
    motion={"entrainment_speed": SPEED, "slide_roll_ratio": 0.1},
    numerics={"accept": True, "heat": "off"},
)


def heights():
    """Waves of random phases that the map of 24 x 16 cells holds, none shorter than six cells."""
    rng = np.random.default_rng(11)
    waves = np.zeros((24, 16), dtype=complex)
    for i, j in [(1, 0), (2, 0), (3, 1), (2, 2), (4, 1), (1, 2), (-3, 1), (-1, 2), (-2, 1), (-4, 2)]:
        waves[i, j] = rng.standard_normal() * np.exp(2j * np.pi * rng.random())
    z = np.fft.ifft2(waves).real
    return 60e-9 * (z - z.mean()) / z.std()


MAP = Surface(heights(), (2.5e-6, 2.5e-6), periodic_axes=(True, True))


def solved(model, scene=SCENE, surface=MAP, speed=SPEED):
    scene = scene.with_(numerics={"model": model})
    return lubfric.friction(lubfric.prepare(scene, surface), speed)


@pytest.fixture(scope="module")
def results():
    return {model: solved(model) for model in MODELS}


def moved(shift):
    return replace(MAP, heights=shift(MAP.heights).copy())


# Each: what changes, the scene, the map, the speed, and how exactly f is that of before. Rounding errors move Newton's
# method within its tolerance.
SAME = {
    "mirrored across the motion": (SCENE, moved(lambda z: z[:, ::-1]), SPEED, 1e-6),
    "shifted across the motion": (SCENE, moved(lambda z: np.roll(z, 4, axis=1)), SPEED, 1e-6),
    "another datum": (SCENE, moved(lambda z: z + 1e-6), SPEED, 1e-6),
    "mirrored, with the motion reversed": (SCENE, moved(lambda z: z[::-1]), -SPEED, 1e-6),
    "other units": (
        SCENE.with_(
            bodies={"radius": "5000 um", "width": "0.5 cm", "load": "0.06 kN", "e_prime": "220000 MPa"},
            lubricant={"viscosity": "50 mPa s", "eyring_stress": "5 N/mm2"},
        ),
        MAP,
        "10 cm/s",
        1e-12,
    ),
    "twice as wide": (SCENE.with_(bodies={"width": 1e-2, "load": 120.0}), MAP, SPEED, 1e-12),
    "thinner, and faster": (SCENE.with_(lubricant={"viscosity": 0.025}), MAP, 2 * SPEED, 1e-9),
    "all stresses twice as large": (
        SCENE.with_(
            bodies={"e_prime": 4.4e11, "load": 120.0},
            lubricant={"viscosity": 0.1, "pressure_viscosity_coefficient": 0.75e-8, "eyring_stress": 1e7},
        ),
        MAP,
        SPEED,
        1e-9,
    ),
}


# On short cells a run takes twice as long: the relations that no change of the map leaves exact.
ON_SHORT_CELLS = ("mirrored, with the motion reversed", "thinner, and faster", "all stresses twice as large")


# Simpler than a mirror image and a scale of all stresses, which are part of the default run.
SCALED_OR_SHIFTED = ("shifted across the motion", "mirrored across the motion", "other units", "twice as wide")


@pytest.mark.parametrize(
    ("model", "relation"),
    [pytest.param("quick", relation, marks=[pytest.mark.slow] * (relation in SCALED_OR_SHIFTED)) for relation in SAME]
    + [pytest.param("deterministic", relation, marks=pytest.mark.slow) for relation in ON_SHORT_CELLS],
)
def test_what_must_not_change_the_coefficient(model, relation, results):
    scene, surface, speed, tolerance = SAME[relation]
    result = solved(model, scene, surface, speed)
    assert result.coefficient == pytest.approx(results[model].coefficient, rel=tolerance)
    assert result.uncertainty.interval == pytest.approx(
        results[model].uncertainty.interval, rel=10 * tolerance, nan_ok=True
    )
    assert results[model].contact_load > 0


def test_f_is_that_of_the_strip_as_shorter_cells_change_it(results):
    """They act as a thinner boundary film, so f falls where it grows with that film; forces and loads still add up."""
    result = results["deterministic"]
    strip = result.deterministic
    change = result.coefficient / strip.coefficient - 1
    slope = np.log(strip.sliding_at_twice_film / strip.sliding_at_half_film) / np.log(4.0)
    assert slope > 1e-3 and -0.5 * slope < change < 0
    assert f"f is corrected by {100 * change:+.2g} % for shorter cells" in result.decision.text
    assert result.shear_force + result.boundary_force == pytest.approx(result.coefficient * 60.0, rel=1e-9)
    assert result.contact_load + result.film_load == pytest.approx(60.0, rel=1e-9)


@pytest.mark.parametrize("model", MODELS)
def test_similar_contacts_have_one_coefficient(model, results):
    """All lengths twice as long, at the same stresses: but the gap of touching bodies, 1 nm, which iterates of Newton's
    method reach. So both agree to the residual at which steps in time end."""
    scene = SCENE.with_(bodies={"radius": 1e-2, "width": 1e-2, "load": 240.0, "boundary_film": 40e-9})
    surface = replace(MAP, heights=2 * MAP.heights, spacing=(5e-6, 5e-6))
    result = solved(model, scene, surface, 2 * SPEED)
    assert result.coefficient == pytest.approx(results[model].coefficient, rel=1e-3)
    assert result.rolling_force == pytest.approx(4 * results[model].rolling_force, rel=1e-2)


@pytest.mark.parametrize("model", [pytest.param("deterministic", marks=pytest.mark.slow), "quick"])
def test_the_same_roughness_on_the_other_body(model, results):
    """Surface 2 in place of 1, with the speeds exchanged: the same film. Only the force of the pressure on surface 2 is
    that of the other body."""
    keys = {"slide_roll_ratio": -SCENE.motion.slide_roll_ratio}
    rough = {"sq": 60e-9, "correlation_length": 1e-5}
    scene = SCENE.with_(motion=keys, surface={"sq": 0.0}, counterface=rough, numerics={"model": model})
    smooth = replace(MAP, heights=np.zeros_like(MAP.heights))
    result = lubfric.friction(lubfric.prepare(scene, smooth, counterface=MAP), SPEED)
    before = results[model]
    for name in ("contact_load", "film_load", "mean_gap", "central_film", "boundary_force"):
        assert abs(getattr(result, name)) == pytest.approx(abs(getattr(before, name)), rel=1e-5), name


def test_a_map_twice_as_long_across_the_motion(results):
    model = "quick"
    doubled = replace(MAP, heights=np.tile(MAP.heights, (1, 2)))
    result = solved(model, surface=doubled)
    assert result.coefficient == pytest.approx(results[model].coefficient, rel=1e-3)
    assert result.contact_load == pytest.approx(results[model].contact_load, rel=1e-2)
