"""Relations that any solution of a rolling and sliding contact obeys, whatever its method: other units of time and of
stress, the mirror image, a map that is shifted along its period, and bodies that change places."""

import numpy as np
import pytest

import lubfric


def drawn(seed, model="paper"):
    """Return a random scene of rolling and sliding on a patch without heat, its map and a speed."""
    draw = np.random.default_rng(seed)
    scene = lubfric.load_scene("paper").with_(
        bodies={
            "radius": 10 ** draw.uniform(-2.7, -1.5),
            "e_prime": 10 ** draw.uniform(10.8, 11.4),
            "hertz_pressure": 10 ** draw.uniform(8, 9),
            "hardness": 8e9,
        },
        lubricant={
            "viscosity": 10 ** draw.uniform(-2, -0.5),
            "pressure_viscosity_coefficient": draw.uniform(12e-9, 24e-9),
            "viscosity_law": "barus",
            "eyring_stress": 10 ** draw.uniform(6.5, 7.1),
        },
        motion={"slide_roll_ratio": float(draw.choice([-1.5, -0.2, 0.05, 0.5, 1.9]))},
        numerics={"accept": True, "heat": "off", "model": model, "sampling": "patch"},
    )
    length = scene.bodies.half_width / draw.uniform(2, 4)
    sq = 10 ** draw.uniform(-7.3, -6.7)
    scene = scene.with_(
        surface={"sq": sq, "correlation_length": length, "seed": seed},
        contact={"shape": (96, 48), "spacing": length / 4},
    )
    speeds = np.geomspace(1e-4, 10, 200)
    thin = [scene.line_contact(u).moes_film < draw.uniform(0.2, 2) * sq for u in speeds]
    return scene, lubfric.prepare(scene).surface, float(speeds[max(np.count_nonzero(thin) - 1, 0)])


def friction(scene, surface, speed, **more):
    return lubfric.friction(lubfric.prepare(scene, surface, **more), speed)


def like(surface, heights):
    return lubfric.Surface(heights, surface.spacing, periodic_axes=surface.periodic_axes)


@pytest.mark.parametrize("seed", range(3))
def test_time_and_stress_have_no_unit_of_their_own(seed):
    scene, surface, speed = drawn(seed)
    f = friction(scene, surface, speed).coefficient
    oil = scene.lubricant
    bodies = scene.bodies
    thinner = scene.with_(lubricant={"viscosity": oil.viscosity / 3})
    assert friction(thinner, surface, 3 * speed).coefficient == pytest.approx(f, rel=1e-6)
    stiffer = scene.with_(
        bodies={"e_prime": 1.7 * bodies.e_prime, "load": 1.7 * bodies.load, "hardness": 1.7 * bodies.hardness},
        lubricant={
            "viscosity": 1.7 * oil.viscosity,
            "pressure_viscosity_coefficient": oil.pressure_viscosity_coefficient / 1.7,
            "eyring_stress": 1.7 * oil.eyring_stress,
        },
    )
    assert friction(stiffer, surface, speed).coefficient == pytest.approx(f, rel=1e-5)


@pytest.mark.parametrize("seed", range(3))
def test_a_mirror_and_a_shift_along_the_period_change_nothing(seed):
    scene, surface, speed = drawn(seed)
    f = friction(scene, surface, speed).coefficient
    mirrored = friction(scene, like(surface, surface.heights[::-1].copy()), -speed)
    assert abs(mirrored.coefficient) == pytest.approx(f, rel=1e-4)
    shifted = friction(scene, like(surface, np.roll(surface.heights, 17, axis=1)), speed)
    assert shifted.coefficient == pytest.approx(f, rel=1e-4)


@pytest.mark.parametrize("seed", range(3))
def test_bodies_that_change_places_exchange_their_rolling_force(seed):
    """The rough body below at slide-roll ratio S, and above at -S: the force on the other body is that on this one, but
    for the rolling resistance between the two."""
    scene, surface, speed = drawn(seed)
    below = friction(scene, surface, speed)
    smooth = scene.with_(surface={"sq": 0.0}).surface
    ratio = -scene.motion.slide_roll_ratio
    turned = scene.with_(motion={"slide_roll_ratio": ratio}, surface=smooth, counterface=scene.surface)
    above = friction(turned, like(surface, np.zeros(surface.shape)), speed, counterface=surface)
    load = scene.bodies.load
    for result in (below, above):
        assert abs(result.rolling_force) == pytest.approx(0.5 * abs(result.rolling_resistance), rel=1e-6)
    assert above.rolling_force == pytest.approx(-below.rolling_force, rel=1e-5)
    sheared = [result.coefficient - result.rolling_force / load for result in (below, above)]
    assert sheared[1] == pytest.approx(sheared[0], rel=1e-6)
